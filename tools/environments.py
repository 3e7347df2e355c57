# SPDX-License-Identifier: GPL-3.0-or-later
"""Python environments for ./demo, ./test and tools/build.py, made when missing and kept in .venv/.

Runs on any Python from 3.9 with nothing installed. A system that lacks something is mended through apt
where that is possible without asking for a password, and told the exact command otherwise.
"""

from __future__ import annotations

import ctypes
import os
import shutil
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path
from typing import NoReturn

ROOT = Path(__file__).resolve().parent.parent
PROGRAM = Path(sys.argv[0]).stem

#: The SciPy that travels inside the extension, see blender_manifest.toml.
SCIPY = "scipy==1.15.3"
PYTEST = "pytest==9.2.0"
#: What makes meshes up for tests/fuzz.
HYPOTHESIS = "hypothesis==6.170.15"
#: What the tests check the JSON with.
JSONSCHEMA = "jsonschema==4.26.0"

#: Blender as a module may crash or wait for ever while it is torn down at the end of Python: 4.2 as soon as anything
#: has registered a callback (a command, a handler, an update function), 4.5 in a thread of its own. So it is left.
PYTEST_AND_LEAVE = "import os, sys, pytest; status = pytest.main(); sys.stdout.flush(); os._exit(status)"

#: Shared libraries that Blender as a Python module loads, and the Debian package of each.
LIBRARIES = {
    "libGL.so.1": "libgl1",
    "libICE.so.6": "libice6",
    "libSM.so.6": "libsm6",
    "libX11.so.6": "libx11-6",
    "libXext.so.6": "libxext6",
    "libXfixes.so.3": "libxfixes3",
    "libXi.so.6": "libxi6",
    "libXrender.so.1": "libxrender1",
    "libXxf86vm.so.1": "libxxf86vm1",
    "libgomp.so.1": "libgomp1",
    "libxkbcommon.so.0": "libxkbcommon0",
}


@dataclass(frozen=True)
class Environment:
    """A virtual environment: its folder name, its Python and what is installed into it."""

    name: str
    python: str
    packages: tuple[str, ...]

    @property
    def blender(self) -> bool:
        """Whether Blender as a module is part of it."""
        return any(package.startswith("bpy==") for package in self.packages)


# NumPy as in the official build of each Blender; SciPy as shipped, pytest for the tests.
BLENDER_42 = Environment("blender-4.2", "3.11", ("bpy==4.2.23", "numpy==1.24.3", SCIPY, PYTEST))
BLENDER_45 = Environment("blender-4.5", "3.11", ("bpy==4.5.15", "numpy==1.26.4", SCIPY, PYTEST))
BLENDER_52 = Environment("blender-5.2", "3.13", ("bpy==5.2.3", "numpy==2.3.4", SCIPY, PYTEST))
BLENDER_53 = Environment("blender-5.3", "3.13", ("bpy==5.3.0", "numpy==2.3.4", SCIPY, PYTEST))


def say(text: str) -> None:
    """One line of progress, on standard error."""
    print(f"{PROGRAM}: {text}", file=sys.stderr, flush=True)


def fail(text: str) -> NoReturn:
    """Say what is wrong and stop."""
    say(text)
    sys.exit(1)


def find_python(version: str) -> Path | None:
    """The interpreter of a Python version such as "3.11", or None."""
    candidates = [sys.executable, f"python{version}", "python3"]
    if shutil.which("pyenv"):
        # Its "python3.13" on the PATH answers only for the versions that are switched on.
        versions = _output("pyenv", "versions", "--bare").split()
        root = Path(_output("pyenv", "root"))
        candidates += [
            str(root / "versions" / name / "bin" / "python")
            for name in versions
            if name.startswith(version + ".") and name.replace(".", "").isdigit()
        ]
    for candidate in candidates:
        # sys.executable rather than the candidate: that may be a shim that depends on the working folder.
        code = "import sys; print('%d.%d' % sys.version_info[:2], sys.executable)"
        found, _, path = _output(candidate, "-c", code).partition(" ")
        if found == version:
            return Path(path)
    return None


def any_python(name: str, *packages: str) -> Environment:
    """An environment on the newest Python here that the product is tested with."""
    for version in ("3.13", "3.11"):
        if find_python(version):
            return Environment(name, version, packages)
    fail("Python 3.11 or 3.13 is needed; on Debian and Ubuntu: apt install python3")


def any_blender() -> Environment:
    """Blender as a module for the first Python that is here, the older first."""
    for environment in (BLENDER_45, BLENDER_52):
        if find_python(environment.python):
            return environment
    fail("Python 3.11 or 3.13 is needed; on Debian and Ubuntu: apt install python3")


def lint() -> Environment:
    """What checks the style and the types; NumPy for what its functions take and return."""
    return any_python("lint", "ruff==0.17.5", "mypy==2.4.1", "numpy==2.3.4")


def package() -> Environment:
    """What the Python package and its command are built and tested with; reeb_parts itself is built by the tests."""
    lines = (ROOT / "tests" / "package" / "requirements.txt").read_text(encoding="utf-8").splitlines()
    return any_python("package", *(line for line in lines if line and not line.startswith("#")), PYTEST, JSONSCHEMA)


def benchmarks() -> Environment:
    """What the programs in benchmarks/ import."""
    lines = (ROOT / "benchmarks" / "requirements.txt").read_text(encoding="utf-8").splitlines()
    return any_python("benchmarks", *(line for line in lines if line and not line.startswith("#")))


def prepare(environment: Environment) -> Path:
    """Make the environment unless it is there; returns its interpreter."""
    folder = ROOT / ".venv" / environment.name
    python = folder / "bin" / "python"
    # The libraries are looked for every time: a system may have been set up anew around a kept folder.
    interpreter = find_python(environment.python)
    if interpreter is None:
        fail(f"Python {environment.python} was not found.")
    _mend_system(environment, interpreter)
    # What a finished environment was made of; one that was interrupted or is of another time has none such.
    stamp = folder / "made-of.txt"
    content = "\n".join((environment.python, *environment.packages)) + "\n"
    if stamp.is_file() and stamp.read_text() == content and not _run([str(python), "-c", ""], quiet=True):
        return python
    if folder.exists():
        shutil.rmtree(folder)
    size = " (Blender alone is a download of about 370 MB, once)" if environment.blender else ""
    content_words = ", ".join(environment.packages) or "nothing but pip"
    say(f"making .venv/{environment.name}: {content_words}{size}")
    if _run([str(interpreter), "-m", "venv", str(folder)]):
        fail(f"{interpreter} could not make a virtual environment in {folder}.")
    quiet = [] if sys.stderr.isatty() else ["--quiet", "--quiet"]
    # Of all modules most are never imported; those that are get compiled then.
    pip = [str(python), "-m", "pip", "install", "--disable-pip-version-check", "--only-binary=:all:", "--no-compile",
           *quiet]
    if environment.packages and _run([*pip, *environment.packages]):
        fail("pip could not install these packages, see above; is there a network, and space on the disk?")
    stamp.write_text(content)
    return python


def _mend_system(environment: Environment, interpreter: Path) -> None:
    """Install the Debian packages that the environment needs and the system lacks."""
    packages = []
    if _run([str(interpreter), "-c", "import ensurepip, venv"], quiet=True):
        # Debian's own Python comes without the means to make environments.
        packages.append(f"python{environment.python}-venv")
    if environment.blender:
        packages += [package for library, package in LIBRARIES.items() if not _loads(library)]
    if not packages:
        return
    if not _apt_installs(packages):
        command = f"apt-get update && apt-get install --no-install-recommends {' '.join(packages)}"
        fail(f"some system packages are missing; as root, run: {command}")


def browser() -> str | None:
    """A Chromium for the tests of pages, installed through apt where that is possible; None if there is none."""
    names = ("chromium", "chromium-browser", "google-chrome")
    found = next(filter(None, map(shutil.which, names)), None)
    if found is None and _apt_installs(["chromium"]):
        found = shutil.which("chromium")
    return found


def _apt_installs(packages: list[str]) -> bool:
    """Install Debian packages without asking for a password; whether that was possible."""
    install = ["apt-get", "install", "--yes", "--no-install-recommends", *packages]
    sudo = [] if os.geteuid() == 0 else ["sudo", "-n"]
    allowed = not sudo or (shutil.which("sudo") and not _run(["sudo", "-n", "true"], quiet=True))
    if not (shutil.which("apt-get") and allowed):
        return False
    say(f"installing system packages: {' '.join(packages)}")
    os.environ["DEBIAN_FRONTEND"] = "noninteractive"
    # Of what apt prints only its complaints.
    apt = [["apt-get", "update", "-qq"], [*install, "-qq"]]
    return not any(subprocess.run([*sudo, *words], stdout=subprocess.DEVNULL, check=False).returncode for words in apt)


def _loads(library: str) -> bool:
    """Whether the dynamic loader finds a shared library."""
    try:
        ctypes.CDLL(library)
    except OSError:
        return False
    return True


def _run(command: list[str], quiet: bool = False) -> int:
    """Exit status of a command; its output goes to standard error, or nowhere."""
    sink = subprocess.DEVNULL if quiet else sys.stderr
    return subprocess.run(command, stdin=subprocess.DEVNULL, stdout=sink, stderr=sink, check=False).returncode


def _output(*command: str) -> str:
    """What a command prints, or nothing if it fails or does not exist."""
    try:
        return subprocess.run(command, capture_output=True, text=True, check=True).stdout.strip()
    except (OSError, subprocess.CalledProcessError):
        return ""

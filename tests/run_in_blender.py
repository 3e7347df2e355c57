# SPDX-License-Identifier: GPL-3.0-or-later
"""Install the built extension into a full Blender and test the installed package.

    python3 tests/run_in_blender.py --blender PATH [--part install|inside|command|window|speed] [--gui PATH] [-k WORDS]

Run tools/build.py first. Nothing of the user's Blender settings is touched: the extension goes into a
settings folder of its own, which --resources keeps. The parts are

install  nothing more than that
inside   the stored answers of tests/unit, and tests/blender, in Blender's own Python, on the shipped files
command  tests/installed: "blender --command reeb_parts" and scripts, as processes
window   tests/window: buttons pressed with the real pointer; --gui names the program that opens the window
speed    of those, what measures how long a person waits, for which nothing else may run

Blender executes this file too, to run pytest in itself.
"""

import argparse
import importlib.util
import os
import platform
import shlex
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
SPEED = ["tests/window/test_fluid.py"]
PARTS = {"inside": ["tests/unit/test_everywhere.py", "tests/blender"], "command": ["tests/installed"],
         "window": ["tests/window", *(f"--ignore={path}" for path in SPEED)], "speed": SPEED}
PACKAGE = "bl_ext.user_default.reeb_parts"


def main() -> int:
    """Install, then run one part; returns the exit status of pytest."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--blender", required=True, metavar="PATH")
    parser.add_argument("--gui", metavar="PATH", help="opens Blender in a window, see tests/window/driver.py")
    parser.add_argument("--part", choices=("install", *PARTS), default="inside")
    parser.add_argument("--resources", type=Path, metavar="DIR", help="settings folder, used again if it exists")
    parser.add_argument("--junit", type=Path, metavar="FILE", help="also write the results as XML")
    parser.add_argument("-k", metavar="WORDS", help="only the tests whose names have these words")
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as scratch:
        resources = (arguments.resources or Path(scratch) / "resources").resolve()
        os.environ["BLENDER_USER_RESOURCES"] = str(resources)
        # Blender speaks the language of the system, but tests compare English sentences.
        os.environ["LC_ALL"] = "C.UTF-8"
        if not resources.exists():
            resources.mkdir(parents=True)
            install(arguments.blender, resources)
        if arguments.part == "install":
            return 0
        pytest_arguments = ["-q", "-p", "no:cacheprovider", *PARTS[arguments.part]]
        pytest_arguments += ["-k", arguments.k] if arguments.k else []
        if arguments.junit:
            pytest_arguments.append(f"--junitxml={arguments.junit.resolve()}")
        if arguments.part == "inside":
            command = [arguments.blender, "--background", "--python-exit-code", "9", "--python", __file__, "--"]
            return subprocess.run([*command, str(resources), *pytest_arguments], cwd=ROOT, check=False).returncode
        os.environ["BLENDER"] = arguments.blender
        os.environ["BLENDER_GUI"] = arguments.gui or ""
        command = [sys.executable, "-m", "pytest", *pytest_arguments]
        return subprocess.run(command, cwd=ROOT, check=False).returncode


def install(blender: str, resources: Path) -> None:
    """Install the zip for this machine and, beside it, what the tests need in Blender's Python."""
    code = "import sys; print('python', *sys.version_info[:2])"
    print_version = [blender, "--background", "--python-expr", code]
    output = subprocess.run(print_version, check=True, capture_output=True, text=True).stdout
    version = next(line.split()[1:] for line in output.splitlines() if line.startswith("python "))
    system = {"Linux": "linux", "Windows": "windows", "Darwin": "macos"}[platform.system()]
    machine = {"x86_64": "x64", "AMD64": "x64", "arm64": "arm64"}[platform.machine()]
    # Of all builds only Debian's has so new a Python.
    system = "debian" if system == "linux" and version == ["3", "14"] else system
    (package,) = (ROOT / "dist").glob(f"reeb_parts-*-{system}_{machine}.zip")
    install_file = ["--command", "extension", "install-file", "--repo", "user_default", "--enable"]
    subprocess.run([blender, *install_file, str(package)], check=True)
    pip = [sys.executable, "-m", "pip", "install", "--quiet", "--disable-pip-version-check"]
    target = ["--target", str(resources / "pytest"), "--python-version", ".".join(version)]
    subprocess.run([*pip, *target, "--only-binary=:all:", "pytest", "jsonschema"], check=True)


def inside_blender(resources: str, *pytest_arguments: str) -> int:
    """Run pytest in this Blender; the tests import core from the installed package."""
    specification = importlib.util.find_spec(PACKAGE)
    if PACKAGE not in sys.modules or specification is None:
        print(f"{PACKAGE} is not enabled in this Blender", file=sys.stderr)
        return 1
    sys.dont_write_bytecode = True
    sys.path.append(os.path.join(resources, "pytest"))
    import pytest

    paths = [str(Path(specification.origin).parent), str(ROOT / "tests")]
    return int(pytest.main(["-o", f"pythonpath={shlex.join(paths)}", *pytest_arguments]))


if __name__ == "__main__":
    if "bpy" in sys.modules:
        sys.exit(inside_blender(*sys.argv[sys.argv.index("--") + 1 :]))
    sys.exit(main())

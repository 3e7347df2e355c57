# SPDX-License-Identifier: GPL-3.0-or-later
"""Check the style (ruff) and the types (mypy) of the code; the settings are in pyproject.toml.

    python3 tools/lint.py [ruff] [mypy]
"""

from __future__ import annotations

import argparse
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

import environments
from environments import ROOT, say

PACKAGES = ("core", "scene", "viewport", "operators", "ui", "batch")


def main() -> int:
    """Run the chosen checks; returns the exit status."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("checks", nargs="*", metavar="CHECK", help=f"{' or '.join(CHECKS)}; default: all")
    arguments = parser.parse_args()
    if unknown := set(arguments.checks) - set(CHECKS):
        parser.error(f"no such check: {', '.join(sorted(unknown))}")
    python = str(environments.prepare(environments.lint()))
    failed = [name for name in arguments.checks or CHECKS if CHECKS[name](python)]
    if failed:
        say(f"{', '.join(failed)} failed")
    return int(bool(failed))


def ruff(python: str) -> int:
    """Exit status of the check of the style."""
    return subprocess.run([python, "-m", "ruff", "check", "--quiet", str(ROOT)], check=False).returncode


def mypy(python: str) -> int:
    """Exit status of the check of the types.

    The checkout is a package with relative imports, whatever its folder is called: mypy sees it as ``reeb_parts``. The
    Python package of that name is seen as it is installed, with core/ in it.
    """
    with tempfile.TemporaryDirectory() as folder, tempfile.TemporaryDirectory() as installed:
        (Path(folder) / "reeb_parts").symlink_to(ROOT)
        inside = Path(installed) / "reeb_parts"
        inside.mkdir()
        for path in (*(ROOT / "package").iterdir(), ROOT / "core"):
            (inside / path.name).symlink_to(path)
        extension = [word for name in PACKAGES for word in ("-p", f"reeb_parts.{name}")]
        # Whoever imports the package checks it with options of their own, at worst the strict ones.
        client = ["--strict", "--follow-imports=silent", str(ROOT / "tests" / "package" / "typed_client.py")]
        return (_mypy(python, folder, "mypy", extension)
                or _mypy(python, installed, "mypy-package", ["-p", "reeb_parts"])
                or _mypy(python, installed, "mypy-client", client))


def _mypy(python: str, folder: str, cache: str, packages: list[str]) -> int:
    """Exit status of mypy on packages in a folder."""
    known = Path(python).parents[1] / cache
    first = known.with_name("mypy")
    if first.is_dir() and not known.exists():  # most of it is the same, which is half of the time
        shutil.copytree(first, known)
    options = ["--config-file", str(ROOT / "pyproject.toml"), "--cache-dir", str(known)]
    command = [python, "-m", "mypy", "--no-error-summary", *options, *packages]
    return subprocess.run(command, cwd=folder, check=False).returncode


CHECKS = {"ruff": ruff, "mypy": mypy}

if __name__ == "__main__":
    sys.exit(main())

# SPDX-License-Identifier: GPL-3.0-or-later
"""What a benchmark imports is there: core/ from this checkout, and the packages that it names.

``need`` is called before anything else is imported. In a Python that lacks a package the benchmark starts again, in an
environment in .venv/ that is made when it is missing, as those of ./demo and ./test are; if all that is asked for is
help, it is the benchmark's docstring.
"""

from __future__ import annotations

import importlib.util
import os
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT))


def need(*modules: str) -> None:
    """Return if all modules can be imported; else run the same command in the environment that has them."""
    if all(importlib.util.find_spec(module) for module in modules):
        return
    if {"-h", "--help"} & set(sys.argv[1:]):  # not worth 400 MB
        print(sys.modules["__main__"].__doc__)
        sys.exit()
    sys.path.insert(0, str(ROOT / "tools"))
    import environments

    environment = environments.any_blender() if "bpy" in modules else environments.benchmarks()
    python = environments.prepare(environment)
    if Path(sys.prefix).resolve() == python.parent.parent.resolve():
        environments.fail(f"{', '.join(modules)} are not all in {sys.prefix}; see benchmarks/requirements.txt")
    os.execv(python, [str(python), *sys.argv])

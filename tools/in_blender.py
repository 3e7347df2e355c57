# SPDX-License-Identifier: GPL-3.0-or-later
"""Run the command of this checkout in Blender as a Python module: what "blender --command reeb_parts" does.

    .venv/blender-4.5/bin/python tools/in_blender.py --help
"""

import sys
import tempfile
from pathlib import Path

import bpy

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "tests"))
import checkout


def main() -> int:
    """Switch the checkout on as an extension and run its command; returns the exit status."""
    bpy.ops.wm.read_homefile(use_empty=True)
    with tempfile.TemporaryDirectory() as folder:
        package = checkout.enable(Path(folder))
        return sys.modules[f"{package}.batch.command"].main(sys.argv[1:])


if __name__ == "__main__":
    checkout.leave(main())

# SPDX-License-Identifier: GPL-3.0-or-later
"""Run the command of this checkout in Blender as a Python module: what "blender --command reeb_parts" does.

    .venv/blender-4.5/bin/python tools/in_blender.py --help
"""

import os
import sys
import tempfile
from pathlib import Path

import bpy

ROOT = Path(__file__).resolve().parent.parent
PACKAGE = "bl_ext.checkout.reeb_parts"


def main() -> int:
    """Switch the checkout on as an extension and run its command; returns the exit status."""
    import addon_utils  # comes with bpy

    bpy.ops.wm.read_homefile(use_empty=True)
    with tempfile.TemporaryDirectory() as folder:
        (Path(folder) / "reeb_parts").symlink_to(ROOT)
        repositories = bpy.context.preferences.extensions.repos
        repositories.new(name="checkout", module="checkout", custom_directory=folder)
        if addon_utils.enable(PACKAGE, default_set=True) is None:
            return 1
        return sys.modules[f"{PACKAGE}.batch.command"].main(sys.argv[1:])


if __name__ == "__main__":
    status = main()
    sys.stdout.flush()
    sys.stderr.flush()
    # Blender as a module may crash while Python tears it down, long after all is written.
    os._exit(status)

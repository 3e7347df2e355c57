# SPDX-License-Identifier: GPL-3.0-or-later
"""Switch the extension on in Blender: the installed one, or else this checkout."""

import sys
from pathlib import Path

import bpy

ROOT = Path(__file__).resolve().parents[1]


def enable(folder) -> str:
    """The name of the package that is switched on; an empty folder is for a link to the checkout."""
    for name in sys.modules:
        if name.startswith("bl_ext.") and name.endswith(".reeb_parts"):
            return name
    import addon_utils

    (folder / "reeb_parts").symlink_to(ROOT)
    bpy.context.preferences.extensions.repos.new(
        name="development", module="development", custom_directory=str(folder)
    )
    name = "bl_ext.development.reeb_parts"
    assert addon_utils.enable(name, default_set=True) is not None
    return name

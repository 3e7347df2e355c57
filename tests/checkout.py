# SPDX-License-Identifier: GPL-3.0-or-later
"""For programs that run in Blender or with Blender as a module: their arguments, and the extension switched on."""

import os
import shutil
import sys
from pathlib import Path

import bpy

ROOT = Path(__file__).resolve().parents[1]


def arguments() -> list[str]:
    """What was typed for the program: in Blender what follows --, which its own arguments end with."""
    if "--" in sys.argv:
        return sys.argv[sys.argv.index("--") + 1 :]
    return [] if bpy.app.binary_path else sys.argv[1:]


def leave(status: int):
    """End the program; at once with Blender as a module, which may hang when it frees what is still held."""
    sys.stdout.flush()
    sys.stderr.flush()
    if not bpy.app.binary_path:
        os._exit(status)
    sys.exit(status)


def enable(folder) -> str:
    """Switch on the installed extension, or else the checkout, linked into an empty folder; its package's name."""
    for name in sys.modules:
        if name.startswith("bl_ext.") and name.endswith(".reeb_parts"):
            return name
    import addon_utils

    if os.name == "nt":  # links are for administrators there
        shutil.copytree(ROOT, folder / "reeb_parts", ignore=shutil.ignore_patterns(".*", "tests"))
    else:
        (folder / "reeb_parts").symlink_to(ROOT)
    bpy.context.preferences.extensions.repos.new(
        name="development", module="development", custom_directory=str(folder)
    )
    name = "bl_ext.development.reeb_parts"
    assert addon_utils.enable(name, default_set=True) is not None
    return name

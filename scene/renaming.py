# SPDX-License-Identifier: GPL-3.0-or-later
"""Data blocks are renamed, thousands of them, too."""

from __future__ import annotations

import bpy


def rename(block: bpy.types.ID, name: str) -> None:
    """Give a data block a name, or the nearest that is free.

    Where ``name`` is set, Blender keeps a message about this very block until the windows are drawn, and goes through
    all of them whenever a block is removed; with ``rename`` there is one for all.
    """
    if bpy.app.version < (4, 5):
        block.name = name
    else:
        block.rename(name)

# SPDX-License-Identifier: GPL-3.0-or-later
"""Reeb Parts: cut a mesh into the parts a person would name.

Blender is imported inside ``register`` and ``unregister`` only, so that ``core`` can be used, and tested,
without it.
"""


def register() -> None:
    """Called by Blender when the extension is switched on; raises RuntimeError if it is, from another repository."""
    import bpy

    from . import batch, operators, scene, ui, viewport

    # Classes of the second copy would take the places of those of the first, which could not be switched off any more.
    if hasattr(bpy.types, "REEB_PARTS_OT_decompose"):
        raise RuntimeError("Reeb Parts of another repository is enabled: disable that first.")
    for folder in (scene, viewport, operators, ui, batch):
        folder.register()


def unregister() -> None:
    """Called by Blender when the extension is switched off; leaves nothing behind."""
    from . import batch, operators, scene, ui, viewport

    for folder in (batch, ui, operators, viewport, scene):
        folder.unregister()

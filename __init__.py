# SPDX-License-Identifier: GPL-3.0-or-later
"""Reeb Parts: cut a mesh into the parts a person would name.

Blender is imported inside ``register`` and ``unregister`` only, so that ``core`` can be used, and tested,
without it.
"""


def register() -> None:
    """Called by Blender when the extension is switched on."""
    from . import batch, operators, scene, ui, viewport

    for folder in (scene, viewport, operators, ui, batch):
        folder.register()


def unregister() -> None:
    """Called by Blender when the extension is switched off; leaves nothing behind."""
    from . import batch, operators, scene, ui, viewport

    for folder in (batch, ui, operators, viewport, scene):
        folder.unregister()

# SPDX-License-Identifier: GPL-3.0-or-later
"""Reeb Parts: cut a mesh into the parts a person would name.

Blender is imported inside ``register`` and ``unregister`` only, so that ``core`` can be used, and tested,
without it.
"""


def register():
    """Called by Blender when the extension is switched on."""
    from . import batch, operators, ui

    ui.register_properties()
    operators.register()
    ui.register()
    batch.register()


def unregister():
    """Called by Blender when the extension is switched off; leaves nothing behind."""
    from . import batch, operators, ui

    batch.unregister()
    ui.unregister()
    operators.unregister()
    ui.unregister_properties()

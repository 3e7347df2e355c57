# SPDX-License-Identifier: GPL-3.0-or-later
"""The settings of the panel Use Parts, given to an operator that is started from it."""

from __future__ import annotations

import bpy


def use_panel_settings(operator: bpy.types.Operator, properties: type, context: bpy.types.Context) -> None:
    """Give an operator the panel's settings, but for what its caller has set."""
    names = {name for cls in properties.__mro__ for name in getattr(cls, "__annotations__", {})}
    for name in names:
        if not operator.properties.is_property_set(name):
            setattr(operator, name, getattr(context.scene.reeb_parts_use, name))

# SPDX-License-Identifier: GPL-3.0-or-later
"""What the operators under Use Parts have in common."""

from ..operators import parts


def use_panel_settings(operator, properties, context):
    """Give an operator the panel's settings, but for what its caller has set."""
    names = {name for cls in properties.__mro__ for name in getattr(cls, "__annotations__", {})}
    for name in names:
        if not operator.properties.is_property_set(name):
            setattr(operator, name, getattr(context.scene.reeb_parts_use, name))


def wanted(mesh, which) -> list[int]:
    """Numbers of all parts, or of those chosen in the list. which : "ALL" or "CHOSEN"."""
    if which == "CHOSEN":
        return parts.chosen_numbers(mesh)
    return [part.number for part in mesh.reeb_parts.parts]

# SPDX-License-Identifier: GPL-3.0-or-later
"""Show the parts' colours in the viewport that Decompose was pressed in."""

# Former colour setting by viewport, for the time that Blender runs.
_former: dict[int, str] = {}


def show_colors(context):
    """Colour the solid view by the active colour attribute."""
    space = context.space_data
    if space is None or space.type != "VIEW_3D" or space.shading.type != "SOLID":
        return
    if space.shading.color_type != "VERTEX":
        _former[space.as_pointer()] = space.shading.color_type
        space.shading.color_type = "VERTEX"


def restore_colors(context):
    """Colour the view as before ``show_colors``."""
    space = context.space_data
    if space is not None and space.type == "VIEW_3D" and space.as_pointer() in _former:
        former = _former.pop(space.as_pointer())
        if space.shading.color_type == "VERTEX":
            space.shading.color_type = former

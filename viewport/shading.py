# SPDX-License-Identifier: GPL-3.0-or-later
"""Show the parts' colours in the viewport that Decompose was pressed in."""

from dataclasses import dataclass


@dataclass
class Former:
    """What a viewport was set to before."""

    color_type: str
    relationship_lines: bool


# By viewport, for the time that Blender runs.
_former: dict[int, Former] = {}


def show_colors(context):
    """Colour the solid view by the active colour attribute, without lines from each node to its parent."""
    space = _solid_view(context)
    if space is None:
        return
    _former.setdefault(space.as_pointer(), Former(space.shading.color_type, space.overlay.show_relationship_lines))
    space.shading.color_type = "VERTEX"
    space.overlay.show_relationship_lines = False


def show_pieces(context):
    """Colour the solid view by object, where it showed the parts: now these are objects."""
    space = _solid_view(context)
    if space is not None and space.as_pointer() in _former and space.shading.color_type == "VERTEX":
        space.shading.color_type = "OBJECT"


def restore_colors(context):
    """Show the view as before ``show_colors``; what somebody has set since stays."""
    space = context.space_data
    if space is None or space.type != "VIEW_3D" or space.as_pointer() not in _former:
        return
    former = _former.pop(space.as_pointer())
    if space.shading.color_type in {"VERTEX", "OBJECT"}:
        space.shading.color_type = former.color_type
    if not space.overlay.show_relationship_lines:
        space.overlay.show_relationship_lines = former.relationship_lines


def _solid_view(context):
    space = context.space_data
    return space if space is not None and space.type == "VIEW_3D" and space.shading.type == "SOLID" else None

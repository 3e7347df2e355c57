# SPDX-License-Identifier: GPL-3.0-or-later
"""Show the parts' colors in the viewport that Decompose was pressed in."""

from __future__ import annotations

from dataclasses import dataclass

import bpy
from bpy.app.handlers import persistent

from ..scene import handlers, modes, redraw, store, targets, transaction
from ..scene.pieces import origins


@dataclass
class ViewSettings:
    """What a viewport was set to before its parts were shown."""

    color_type: str
    relationship_lines: bool


# By viewport, for the time that Blender runs.
_before: dict[int, ViewSettings] = {}

# Viewports that were turned to the colors of pieces, and whether the pieces were there when that was last looked at.
_of_pieces: dict[int, bool] = {}


def show_colors(context: bpy.types.Context) -> None:
    """Color the solid view by the active color attribute, without lines from each node to its parent."""
    space = _solid_view(context)
    if space is not None:
        _show_colors(space, targets.active_object(context))


def turn_to_colors(context: bpy.types.Context) -> None:
    """Show the parts' colors in the viewport, whatever it shows now; in all, if the pointer is in none."""
    space = context.space_data
    for view in [space] if space is not None and space.type == "VIEW_3D" else redraw.view_spaces():
        transaction.keep(view.shading, "type")
        view.shading.type = "SOLID"
        _show_colors(view, targets.active_object(context))


def _show_colors(space: bpy.types.SpaceView3D, obj: bpy.types.Object | None) -> None:
    """Color a solid view by the active color attribute, or by materials where none is shown."""
    before = ViewSettings(space.shading.color_type, space.overlay.show_relationship_lines)
    _before.setdefault(space.as_pointer(), before)
    _keep(space)
    space.shading.color_type = "MATERIAL" if modes.lacks_colors(obj) else "VERTEX"
    space.overlay.show_relationship_lines = False


def show_pieces(context: bpy.types.Context) -> None:
    """Color the solid view by object, where it showed the parts: now these are objects."""
    space = _solid_view(context)
    if space is not None and space.as_pointer() in _before and space.shading.color_type == "VERTEX":
        _keep(space)
        space.shading.color_type = "OBJECT"
        _of_pieces[space.as_pointer()] = True


def restore_colors(context: bpy.types.Context) -> None:
    """Show the view as before ``show_colors``, unless models still have parts; what the user has set since stays."""
    space = context.space_data
    if space is None or space.type != "VIEW_3D" or space.as_pointer() not in _before:
        return
    if any(store.has_parts(obj) for obj in context.view_layer.objects):
        return
    before = _before.pop(space.as_pointer())
    transaction.on_failure(_before.__setitem__, space.as_pointer(), before)
    _keep(space)
    if space.shading.color_type in {"VERTEX", "OBJECT"}:
        space.shading.color_type = before.color_type
    if not space.overlay.show_relationship_lines:
        space.overlay.show_relationship_lines = before.relationship_lines


@persistent
def _follow_pieces(*_: object) -> None:
    """Pieces were taken away or brought back, as by undo: the view follows, which is no part of undo."""
    if not _of_pieces:
        return
    objects = [obj for obj in bpy.context.view_layer.objects if obj is not None]  # after removals some are none
    there = bool(origins.originals(obj for obj in objects if obj.visible_get()))
    for space in redraw.view_spaces():
        if _of_pieces.get(space.as_pointer(), there) == there:
            continue
        _of_pieces[space.as_pointer()] = there
        was, now = ("VERTEX", "OBJECT") if there else ("OBJECT", "VERTEX")
        if space.shading.color_type == was:  # else the user has set it since
            space.shading.color_type = now


@persistent
def _changed(scene: bpy.types.Scene, depsgraph: bpy.types.Depsgraph) -> None:
    """Pieces may have been deleted, in whose place the original is seen again."""
    if _of_pieces and depsgraph.id_type_updated("COLLECTION"):
        _follow_pieces()


def register() -> None:
    for those in (bpy.app.handlers.undo_post, bpy.app.handlers.redo_post):
        those.append(_follow_pieces)
    bpy.app.handlers.depsgraph_update_post.append(_changed)


def unregister() -> None:
    for those in (bpy.app.handlers.undo_post, bpy.app.handlers.redo_post):
        handlers.remove(those, _follow_pieces)
    handlers.remove(bpy.app.handlers.depsgraph_update_post, _changed)
    _of_pieces.clear()


def _keep(space: bpy.types.SpaceView3D) -> None:
    transaction.keep(space.shading, "color_type")
    transaction.keep(space.overlay, "show_relationship_lines")


def _solid_view(context: bpy.types.Context) -> bpy.types.SpaceView3D | None:
    space = context.space_data
    return space if space is not None and space.type == "VIEW_3D" and space.shading.type == "SOLID" else None

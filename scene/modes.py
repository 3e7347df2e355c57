# SPDX-License-Identifier: GPL-3.0-or-later
"""Leave Edit, Sculpt or a paint mode to write to a mesh, and return to it; what is not shown in one."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager

import bpy
from bpy.app.translations import pgettext_rpt as rpt_

from .errors import SceneError


def why_not_left(obj: bpy.types.Object | None) -> str:
    """Why the mode of an object cannot be left without a loss, empty where it can."""
    if obj is None or obj.mode != "SCULPT" or not obj.use_dynamic_topology_sculpting:
        return ""
    return rpt_("{name} is being sculpted with dynamic topology, which keeps its own mesh. Switch Dyntopo "
                "off, or leave Sculpt Mode, and try again.").format(name=obj.name)


def check_mode(obj: bpy.types.Object) -> None:
    """Raise SceneError in a mode that cannot be left without a loss."""
    if words := why_not_left(obj):
        raise SceneError(words)


def is_object_mode(context: bpy.types.Context) -> bool:
    """Whether the active object is in Object Mode; ``context.mode`` does not tell where there is no window."""
    active = context.view_layer.objects.active
    return active is None or active.mode == "OBJECT"


@contextmanager
def object_mode(context: bpy.types.Context) -> Iterator[None]:
    """Write in Object Mode whatever the mode was; the mode is as before afterwards."""
    if is_object_mode(context):
        yield
        return
    active = context.view_layer.objects.active
    mode = active.mode
    together = edited_together(context.view_layer) if mode == "EDIT" else []
    set_mode(active, "OBJECT")
    try:
        yield
    finally:
        return_to(context.view_layer, active, mode, together)


def edited_together(layer: bpy.types.ViewLayer) -> list[bpy.types.Object]:
    """The objects that are in Edit Mode, which all leave it together."""
    return [obj for obj in layer.objects if obj is not None and obj.mode == "EDIT"]


def return_to(layer: bpy.types.ViewLayer, active: bpy.types.Object, mode: str,
              together: list[bpy.types.Object]) -> None:
    """Go from Object Mode to the mode that the active object had; to Edit Mode for those objects that were in it.

    Blender enters it for all that are selected, and for these only.
    """
    # After removals some places are empty.
    selected = [obj for obj in layer.objects.selected if obj is not None] if mode == "EDIT" else []
    wrong = [obj for obj in {*selected, *together} if (obj in selected) != (obj in together)]
    for obj in wrong:
        obj.select_set(obj in together, view_layer=layer)
    try:
        set_mode(active, mode)
    finally:
        for obj in wrong:
            obj.select_set(obj not in together, view_layer=layer)


def leave_edit_mode(context: bpy.types.Context) -> None:
    """Go from Edit Mode, in which a scene may have been saved, to Object Mode for good."""
    active = context.view_layer.objects.active
    if active is not None and active.mode == "EDIT":
        set_mode(active, "OBJECT")


def set_mode(obj: bpy.types.Object, mode: str) -> None:
    """Change the mode of the active object."""
    call_with(bpy.ops.object.mode_set, obj, mode=mode)


def call_with(operator: Callable[..., set[str]], obj: bpy.types.Object, **arguments: str | float) -> set[str]:
    """Call one of Blender's operators with an object as the active one, whatever the window shows; its result."""
    edited = {"edit_object": obj} if obj.mode == "EDIT" else {}
    # In no area, since some of them refuse in an editor that shows other things. On one line, so that nothing can be
    # raised before the override ends: Blender would keep it for ever.
    with bpy.context.temp_override(area=None, active_object=obj, object=obj, **edited): done = operator(**arguments)  # noqa: E701
    return done


def lacks_colors(obj: bpy.types.Object | None) -> bool:
    """Whether Blender shows no color attribute of an object, but black: while levels of Multires are sculpted."""
    return obj is not None and obj.mode == "SCULPT" and any(
        modifier.type == "MULTIRES" and modifier.show_viewport and modifier.sculpt_levels
        and not modifier.use_sculpt_base_mesh for modifier in obj.modifiers)

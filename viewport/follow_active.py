# SPDX-License-Identifier: GPL-3.0-or-later
"""The list follows the active object: a node or an arc of a graph that is selected chooses its part."""

from __future__ import annotations

import bpy
from bpy.app.handlers import persistent

from ..scene import handlers, redraw
from ..scene.graph import graph_finding
from ..scene.result.part_list import choose

_owner = object()


def _follow_active() -> None:
    """The active object changed: if it belongs to a graph, the list of its object follows."""
    item = bpy.context.view_layer.objects.active if bpy.context.view_layer else None
    found = graph_finding.part_of(item)
    if item is None or not item.select_get():
        return
    if found is not None and found[0].data.is_editable:
        choose(found[0].data, [found[1]])
    elif graph_finding.source_of_arcs(item) is not None and not bpy.app.background:
        # Not within Blender's own click, which has yet to become a step of undo.
        bpy.app.timers.register(_ask_pointer, first_interval=0.0)


def _ask_pointer() -> None:
    """Which arc it was, only the pointer knows, by where its button was pressed."""
    for window in bpy.context.window_manager.windows:
        for area in redraw.viewports_of(window):
            region = next(region for region in area.regions if region.type == "WINDOW")
            with bpy.context.temp_override(window=window, area=area, region=region):
                operator = bpy.ops.reeb_parts.from_arc
                if operator.poll() and "FINISHED" in operator("INVOKE_DEFAULT", True):
                    return


@persistent
def _subscribe(*_: object) -> None:
    # Subscriptions do not outlive the file.
    bpy.msgbus.subscribe_rna(
        key=(bpy.types.LayerObjects, "active"), owner=_owner, args=(), notify=_follow_active
    )


def register() -> None:
    _subscribe()
    bpy.app.handlers.load_post.append(_subscribe)


def unregister() -> None:
    handlers.remove(bpy.app.handlers.load_post, _subscribe)
    bpy.msgbus.clear_by_owner(_owner)
    if bpy.app.timers.is_registered(_ask_pointer):
        bpy.app.timers.unregister(_ask_pointer)

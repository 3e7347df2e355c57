# SPDX-License-Identifier: GPL-3.0-or-later
"""What is drawn over the model and pointed at in the 3D viewport."""

from __future__ import annotations

import bpy

from . import brush, follow_active, graph_overlay, highlight, hover, pointing, shading

_OVERLAYS = (highlight, graph_overlay)  # drawn in this order
_handles: list[object] = []


def register() -> None:
    brush.register()
    hover.register()
    follow_active.register()
    shading.register()
    if not bpy.app.background:  # there is nothing to draw on
        _handles.extend(bpy.types.SpaceView3D.draw_handler_add(overlay.draw, (), "WINDOW", "POST_VIEW")
                        for overlay in _OVERLAYS)
        _handles.append(bpy.types.SpaceView3D.draw_handler_add(hover.draw_name, (), "WINDOW", "POST_PIXEL"))


def unregister() -> None:
    while _handles:
        bpy.types.SpaceView3D.draw_handler_remove(_handles.pop(), "WINDOW")
    for module in (*_OVERLAYS, hover, pointing):
        module.forget()
    shading.unregister()
    follow_active.unregister()
    hover.unregister()
    brush.unregister()

# SPDX-License-Identifier: GPL-3.0-or-later
"""What is drawn over the model and pointed at in the 3D viewport."""

from __future__ import annotations

import bpy

from . import brush, follow_active, graph_overlay, highlight

_OVERLAYS = (highlight, graph_overlay)  # drawn in this order
_handles: list[object] = []


def register() -> None:
    brush.register()
    follow_active.register()
    if not bpy.app.background:  # there is nothing to draw on
        _handles.extend(bpy.types.SpaceView3D.draw_handler_add(overlay.draw, (), "WINDOW", "POST_VIEW")
                        for overlay in _OVERLAYS)


def unregister() -> None:
    while _handles:
        bpy.types.SpaceView3D.draw_handler_remove(_handles.pop(), "WINDOW")
    for overlay in _OVERLAYS:
        overlay.forget()
    follow_active.unregister()
    brush.unregister()

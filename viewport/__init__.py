# SPDX-License-Identifier: GPL-3.0-or-later
"""What is drawn over the model and pointed at in the 3D viewport.

- ``highlight``: the outline of the chosen parts, and all cuts
- ``graph_overlay``: the graph in the colors of its parts
- ``graph_lines``: its arcs as lines to draw and to point at
- ``hover``: the part under the pointer, filled and named
- ``lines``: lines and surfaces that are drawn
- ``clipping``: what Alt+B leaves of a view
- ``shading``: shows the parts' colors in a viewport
- ``framing``: looks at something from near
- ``follow_active``: has the list follow the active object
- ``idle``: what takes too long to be found at each move
- ``pointing``: what lies under the pointer
- ``modal``: tools, which are used with the pointer until they are confirmed
"""

from __future__ import annotations

import bpy

from . import follow_active, graph_overlay, highlight, hover, pointing, shading
from .modal import brush

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

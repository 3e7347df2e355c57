# SPDX-License-Identifier: GPL-3.0-or-later
"""The newcomer's path, in a real window: from Blender's default scene to separate parts of Suzanne.

Executed inside Blender as driver.py is, which says how. Each picture is taken while the pointer rests where the
next click goes. Those of docs/user.md, in docs/images/first, are copies of them. Then tasks.py goes on
in the same window.
"""

import json
import os
import sys

import bpy
from mathutils import Euler, Vector

sys.path.append(os.path.dirname(__file__))
import pointer
import tasks

CLICKS = []  # what was clicked since Suzanne was selected


def steps():
    """One step after the other; yields the seconds to wait."""
    seen = {}
    yield from add_suzanne()
    seen["added"] = facts()
    pointer.shot("2_added.png")
    yield from pointer.tap("n")
    yield from pointer.until(lambda: pointer.region("UI").width > 1)
    tab = yield from pointer.open_tab()
    pointer.region("UI").active_panel_category = "Item"  # and away, to be opened by one click
    yield 0.3
    yield from click_on("the tab", tab)
    seen["tab"] = pointer.region("UI").active_panel_category
    place = yield from pointer.find("reeb_parts.decompose")
    yield 0.1
    pointer.shot("3_tab.png", (300, 60, 1050, 500))
    yield from click_on("Decompose", place)
    yield from pointer.until(lambda: "reeb_part" in suzanne().data.attributes, pointer.PATIENCE)
    yield 0.5
    seen["decomposed"] = facts()
    place = yield from pointer.find("reeb_parts.separate")
    yield 0.1
    pointer.shot("4_decomposed.png", (300, 60, 1050, 700))
    yield from click_on("Separate", place)
    yield from pointer.rest(*pointer.in_view(0.3, 0.75))
    seen["separated"] = facts()
    seen["clicks"] = CLICKS
    pointer.shot("5_separated.png", (300, 60, 1280, 560))
    tasks.TAB = tab
    yield from tasks.steps(seen)
    (pointer.OUT / "seen.json").write_text(json.dumps(seen, indent=2))


def add_suzanne():
    """Delete the default cube; Shift+A, and type what to add; look at its face from near."""
    x, y = pointer.in_view(0.3, 0.6)
    yield from pointer.rest(x, y)
    yield from pointer.tap("Delete")
    yield 0.3
    yield from pointer.tap("shift+a")
    yield 0.3
    yield from pointer.write("monkey")
    yield 0.5
    pointer.shot("1_add.png", (x - 16, y - 12, x + 520, y + 98))
    yield from pointer.tap("Return")
    yield 0.8
    view = pointer.view_area().spaces.active.region_3d
    view.view_rotation = Euler((1.25, 0.0, 0.4)).to_quaternion()
    view.view_location = view.view_rotation @ Vector((0.6, 0.0, 0.0))
    view.view_distance = 6.5
    yield 0.5


def facts():
    """What the test compares between the steps."""
    mesh = suzanne().data
    pieces = [obj for obj in bpy.data.objects if obj.type == "MESH" and obj.data != mesh]
    mesh.calc_loop_triangles()
    return {
        "hidden": suzanne().hide_get(),
        "selected": sorted(obj.name for obj in bpy.context.selected_objects),
        "points": [round(x, 6) for vertex in mesh.vertices for x in vertex.co],
        "faces": [list(face.vertices) for face in mesh.polygons],
        "matrix": [round(x, 6) for row in suzanne().matrix_world for x in row],
        "parts": [part.name for part in mesh.reeb_parts.parts],
        "pieces": {obj.name: sum(polygon.area for polygon in obj.data.polygons) for obj in pieces},
        "area": sum(polygon.area for polygon in mesh.polygons),
        "area of triangles": sum(triangle.area for triangle in mesh.loop_triangles),
        "shown": sorted(obj.name for obj in pieces if obj.visible_get()),
    }


def click_on(what, place):
    """A click, counted."""
    yield from pointer.press(*place)
    CLICKS.append(what)
    yield 0.3


def suzanne():
    return bpy.data.objects["Suzanne"]

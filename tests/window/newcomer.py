# SPDX-License-Identifier: GPL-3.0-or-later
"""The newcomer's path, in a real window: from Blender's default scene to separate parts of Suzanne.

Executed inside Blender as driver.py is, which says how. Each picture is taken while the pointer rests where the
next click goes. Those of docs/user.md, in docs/images/first, are copies of them.
"""

import json
import os
import sys

import bpy
from mathutils import Euler, Vector

sys.path.append(os.path.dirname(__file__))
import pointer

# Rows below the top of the sidebar.
DECOMPOSE, TAB, USE_PARTS, SEPARATE = 3.7, 12.0, 26.45, 29.0
CLICKS = []  # what was clicked since Suzanne was selected


def steps():
    """One step after the other; yields the seconds to wait."""
    seen = {}
    yield from add_suzanne()
    seen["added"] = facts()
    pointer.shot("2_added.png")
    yield from pointer.tap("n")
    yield 0.8
    yield from click_on("the tab", *pointer.in_sidebar(TAB, 0.96))
    seen["tab"] = pointer.region("UI").active_panel_category
    yield from pointer.rest(*pointer.in_sidebar(DECOMPOSE))
    pointer.shot("3_tab.png", (300, 60, 1050, 500))
    yield from click_on("Decompose", *pointer.in_sidebar(DECOMPOSE))
    yield from pointer.until(lambda: "reeb_part" in suzanne().data.attributes, pointer.PATIENCE)
    yield 1.0
    seen["decomposed"] = facts()
    yield from pointer.rest(*pointer.in_sidebar(USE_PARTS))
    pointer.shot("4_decomposed.png", (300, 60, 1050, 700))
    yield from click_on("Use Parts", *pointer.in_sidebar(USE_PARTS))
    yield from pointer.rest(*pointer.in_sidebar(SEPARATE))
    pointer.shot("5_use.png", (300, 60, 1050, 720))
    yield from click_on("Separate", *pointer.in_sidebar(SEPARATE))
    yield from pointer.rest(*pointer.in_view(0.3, 0.75))
    seen["separated"] = facts()
    seen["clicks"] = CLICKS
    pointer.shot("6_separated.png", (300, 60, 1280, 560))
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
    return {
        "hidden": suzanne().hide_get(),
        "selected": sorted(obj.name for obj in bpy.context.selected_objects),
        "points": [round(x, 6) for vertex in mesh.vertices for x in vertex.co],
        "faces": [list(face.vertices) for face in mesh.polygons],
        "matrix": [round(x, 6) for row in suzanne().matrix_world for x in row],
        "parts": [part.name for part in mesh.reeb_parts.parts],
        "pieces": {obj.name: len(obj.data.polygons) for obj in pieces},
        "shown": sorted(obj.name for obj in pieces if obj.visible_get()),
    }


def click_on(what, x, y):
    """A click, counted."""
    yield from pointer.press(x, y)
    CLICKS.append(what)
    yield 0.8


def suzanne():
    return bpy.data.objects["Suzanne"]

# SPDX-License-Identifier: GPL-3.0-or-later
"""The newcomer's path, in a real window: from Blender's default scene to separate parts of Suzanne.

Executed inside Blender as driver.py is, which says how; what was seen goes to newcomer.json. The pictures are
those of docs/user.md, cropped there: each is taken while the pointer rests where the next click goes.
"""

import json
import os
import time
from pathlib import Path

import bpy
from mathutils import Euler, Vector

OUT = Path(os.environ["GUI_OUT"])
PATIENCE = 60.0  # seconds for a decomposition
# Rows below the top of the sidebar.
DECOMPOSE, TAB, USE_PARTS, SEPARATE = 3.7, 12.0, 24.7, 27.3
CLICKS = []  # what was clicked since Suzanne was selected


def steps():
    """One step after the other; yields the seconds to wait."""
    seen = {}
    yield from add_suzanne()
    seen["added"] = facts()
    shot("2_added.png")
    key("n")
    yield 1.0
    yield from click_on("the tab", *in_sidebar(TAB, 0.96))
    seen["tab"] = region("UI").active_panel_category
    yield from rest_on(*in_sidebar(DECOMPOSE))
    shot("3_tab.png")
    yield from click_on("Decompose", *in_sidebar(DECOMPOSE))
    start = time.monotonic()
    while "reeb_part" not in suzanne().data.attributes and time.monotonic() - start < PATIENCE:
        yield 0.1
    yield 1.0
    seen["decomposed"] = facts()
    yield from rest_on(*in_sidebar(USE_PARTS))
    shot("4_decomposed.png")
    yield from click_on("Use Parts", *in_sidebar(USE_PARTS))
    yield from rest_on(*in_sidebar(SEPARATE))
    shot("5_use.png")
    yield from click_on("Separate", *in_sidebar(SEPARATE))
    yield from rest_on(*middle_of_view())
    seen["separated"] = facts()
    seen["clicks"] = CLICKS
    shot("6_separated.png")
    (OUT / "newcomer.json").write_text(json.dumps(seen, indent=2))


def add_suzanne():
    """Delete the default cube; Shift+A, and type what to add; look at its face from near."""
    yield from rest_on(*middle_of_view())
    key("Delete")
    yield 0.5
    key("shift+a")
    yield 0.5
    for letter in "monkey":
        key(letter)
        yield 0.1
    yield 0.5
    shot("1_add.png")
    key("Return")
    yield 1.0
    view = view_area().spaces.active.region_3d
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
    """A click that a button notices, counted."""
    yield from rest_on(x, y)
    click(x, y)
    CLICKS.append(what)
    yield 1.0


def rest_on(x, y):
    """The pointer goes there and stays, too short for a tooltip."""
    move(x - 2, y)
    yield 0.2
    move(x, y)
    yield 0.2


def suzanne():
    return bpy.data.objects["Suzanne"]


def in_sidebar(rows, across=0.5):
    """Pixels from the top left of a place in the sidebar."""
    ui = region("UI")
    unit = 20.0 * bpy.context.preferences.system.ui_scale
    return from_top(ui.x + across * ui.width, ui.y + ui.height - rows * unit)


def middle_of_view():
    area = view_area()
    return from_top(area.x + 0.3 * area.width, area.y + 0.6 * area.height)


def from_top(x, y):
    return round(x), round(bpy.context.window.height - y)


def view_area():
    return next(area for area in bpy.context.window.screen.areas if area.type == "VIEW_3D")


def region(kind):
    return next(region for region in view_area().regions if region.type == kind)

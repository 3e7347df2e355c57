# SPDX-License-Identifier: GPL-3.0-or-later
"""Hands on the parts, in a real window: cancel, drag Detail, click in the list, slide a boundary, undo.

Executed inside Blender as driver.py is, which says how; what was seen goes to hands.json.
"""

import json
import os
import subprocess
import time
from pathlib import Path

import bpy

ROOT = Path(__file__).resolve().parents[2]
OUT = Path(os.environ["GUI_OUT"])


def steps():
    """One step after the other; yields the seconds to wait."""
    seen = {}
    for obj in list(bpy.data.objects):
        bpy.data.objects.remove(obj)
    bpy.ops.wm.obj_import(filepath=str(ROOT / "models" / "spot.obj"))
    area = view_area()
    area.spaces.active.show_region_ui = True
    with bpy.context.temp_override(area=area, region=region("WINDOW")):
        bpy.ops.view3d.view_selected()
        bpy.ops.ed.undo_push(message="Import")
    yield 0.5
    region("UI").active_panel_category = "Reeb Parts"
    yield 1.0
    yield from cancelled(seen)
    yield from decomposed(seen)
    yield from dragged(seen)
    yield from undone(seen, "drag undone")
    yield from clicked(seen)
    yield from slid(seen)
    yield from undone(seen, "slide undone")
    (OUT / "hands.json").write_text(json.dumps(seen, indent=2))


def cancelled(seen):
    """Esc while it computes; fine base vertices make that long enough."""
    bpy.context.scene.reeb_parts.base_spacing = 0.0005
    yield from press(3.7)
    yield 0.3
    start = time.monotonic()
    key("Escape")
    while bpy.ops.reeb_parts.cancel.poll():
        yield 0.02
    seen["cancelled after"] = time.monotonic() - start
    seen["cancelled"] = facts()
    bpy.context.scene.reeb_parts.base_spacing = 0.005


def decomposed(seen):
    """Decompose with the pointer."""
    yield from press(3.7)
    start = time.monotonic()
    while "reeb_part" not in mesh().attributes and time.monotonic() - start < 60.0:
        yield 0.1
    yield 1.0
    seen["decomposed"] = facts()
    shot("5_decomposed.png")


def dragged(seen):
    """Drag the Detail slider to the right."""
    x, y = in_sidebar(7.1)
    move(x, y)
    yield 0.5
    subprocess.run(["xdotool", "mousedown", "1"], check=True)
    yield 0.2
    for step in range(1, 9):
        move(x + 4 * step, y)
        yield 0.05
    subprocess.run(["xdotool", "mouseup", "1"], check=True)
    yield 0.5
    seen["dragged"] = facts()
    shot("6_dragged.png")


def undone(seen, name):
    """Ctrl+Z over the view."""
    move(*middle_of_view())
    key("ctrl+z")
    yield 1.0
    seen[name] = facts()


def clicked(seen):
    """Click a part in the list that is not the first."""
    yield from press(15.0, 0.3)
    yield 0.5
    seen["active"] = mesh().reeb_parts.active
    shot("7_clicked.png")


def slid(seen):
    """Slide the part's boundary with the mouse, and confirm with a click."""
    x, y = middle_of_view()
    move(x, y)
    yield 0.3
    with bpy.context.temp_override(area=view_area(), region=region("WINDOW")):
        bpy.ops.reeb_parts.slide("INVOKE_DEFAULT")
    for step in range(1, 11):
        move(x + 6 * step, y)
        yield 0.05
    yield 0.5
    click(x + 60, y)
    yield 1.0
    seen["slid"] = facts()
    shot("8_slid.png")


def facts():
    """What the test compares between the steps."""
    result = mesh().reeb_parts
    return {
        "detail": round(result.detail, 4),
        "shares": {part.name: round(part.share, 4) for part in result.parts},
        "groups": sorted(group.name for group in bpy.data.objects["spot"].vertex_groups),
        "attributes": sorted(a.name for a in mesh().attributes),
        "objects": sorted(obj.name for obj in bpy.data.objects),
    }


def press(rows, across=0.5):
    """Click in the sidebar, a number of rows below its top."""
    move(*in_sidebar(rows, across))
    yield 0.5
    click(*in_sidebar(rows, across))


def in_sidebar(rows, across=0.6):
    """Pixels from the top left of a place in the sidebar."""
    ui = region("UI")
    unit = 20.0 * bpy.context.preferences.system.ui_scale
    return from_top(ui.x + across * ui.width, ui.y + ui.height - rows * unit)


def middle_of_view():
    area = view_area()
    return from_top(area.x + 0.3 * area.width, area.y + 0.5 * area.height)


def from_top(x, y):
    return round(x), round(bpy.context.window.height - y)


def mesh():
    """Looked up anew, since undo replaces it."""
    return bpy.data.objects["spot"].data


def view_area():
    return next(area for area in bpy.context.window.screen.areas if area.type == "VIEW_3D")


def region(kind):
    return next(region for region in view_area().regions if region.type == kind)

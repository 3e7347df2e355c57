# SPDX-License-Identifier: GPL-3.0-or-later
"""What a person does first, in a real window: import a model, open the tab, press Decompose, undo.

Executed inside Blender by a program that opens the window and gives this file four functions: click(x, y),
move(x, y) and key("ctrl+z") send real pointer and keyboard events, in window pixels from the top left;
shot("name.png") takes a picture of the window into the folder of the environment variable GUI_OUT. Each value
that steps() yields is the seconds to wait while the window lives on. What was seen is written to seen.json
there, for test_window.py to judge.
"""

import json
import os
import time
from pathlib import Path

import bpy

ROOT = Path(__file__).resolve().parents[2]
OUT = Path(os.environ["GUI_OUT"])
TAB = "Reeb Parts"
PATIENCE = 60.0  # seconds for a decomposition


def steps():
    """One step after the other; yields the seconds to wait."""
    seen = {"version": bpy.app.version_string}
    yield from import_model()
    seen["before"] = scene_facts()
    yield from open_tab()
    seen["tab"] = sidebar().active_panel_category
    shot("1_tab.png")
    yield from press_decompose(seen)
    seen["after"] = scene_facts()
    shot("2_decomposed.png")
    move(*middle_of_view())
    key("ctrl+z")
    yield 1.0
    seen["undone"] = scene_facts()
    shot("3_undone.png")
    key("ctrl+shift+z")
    yield 1.0
    seen["redone"] = scene_facts()
    shot("4_redone.png")
    (OUT / "seen.json").write_text(json.dumps(seen, indent=2))


def import_model():
    """The bundled model alone in the scene, filling the view."""
    for obj in list(bpy.data.objects):
        bpy.data.objects.remove(obj)
    bpy.ops.wm.obj_import(filepath=str(ROOT / "models" / "spot.obj"))
    yield 0.5
    with bpy.context.temp_override(area=view_area()):
        bpy.ops.screen.screen_full_area()
    yield 0.5
    area = view_area()
    area.spaces.active.region_3d.view_rotation = (0.21, 0.14, 0.53, 0.81)
    region = next(region for region in area.regions if region.type == "WINDOW")
    with bpy.context.temp_override(area=area, region=region):
        bpy.ops.view3d.view_selected()
        bpy.ops.ed.undo_push(message="Import")
    yield 1.0


def open_tab():
    """N over the view, then the tabs from the last one up until ours is open."""
    move(*middle_of_view())
    key("n")
    yield 1.0
    region = sidebar()
    x = region.x + region.width - unit() * 0.6
    for row in range(region.height // 12):
        if region.active_panel_category == TAB:
            break
        click(*from_top(x, region.y + 12 * row + 6))
        yield 0.1
    yield 0.5


def press_decompose(seen):
    """Press the large button below the preset menu and wait for the parts."""
    region = sidebar()
    x = region.x + 0.4 * region.width
    button = from_top(x, region.y + region.height - 3.7 * unit())
    # A button takes a click only after it has noticed the pointer.
    move(*button)
    yield 0.3
    click(*button)
    start = time.monotonic()
    yield 0.3
    while "reeb_part" not in model().data.attributes and time.monotonic() - start < PATIENCE:
        yield 0.1
    seen["seconds"] = time.monotonic() - start
    if seen["seconds"] >= PATIENCE:
        shot("failed.png")
        raise TimeoutError("no parts after a click on Decompose, see failed.png")
    move(*middle_of_view())
    yield 1.5


def scene_facts():
    """What the test compares between the steps."""
    obj = model()
    mesh = obj.data
    return {
        "vertices": len(mesh.vertices),
        "faces": len(mesh.polygons),
        "groups": [group.name for group in obj.vertex_groups],
        "attributes": sorted(attribute.name for attribute in mesh.attributes),
        "active_color": mesh.color_attributes.active_color_name,
        "parts": sorted({item.value for item in mesh.attributes["reeb_part"].data})
        if "reeb_part" in mesh.attributes else [],
        "collections": sorted(collection.name for collection in bpy.data.collections),
        "objects": sorted(obj.name for obj in bpy.data.objects),
    }  # fmt: skip


def model():
    """The imported object, looked up anew since undo replaces it."""
    return bpy.data.objects["spot"]


def view_area():
    """The 3D viewport."""
    return next(area for area in bpy.context.window.screen.areas if area.type == "VIEW_3D")


def sidebar():
    """The region that N opens."""
    return next(region for region in view_area().regions if region.type == "UI")


def middle_of_view():
    """A point on the model, in pixels from the top left."""
    area = view_area()
    return from_top(area.x + 0.4 * area.width, area.y + area.height / 2)


def from_top(x, y):
    """Window coordinates, which count from the bottom, as pixels from the top left."""
    return round(x), round(bpy.context.window.height - y)


def unit():
    """Height of a row of buttons, in pixels."""
    return 20.0 * bpy.context.preferences.system.ui_scale

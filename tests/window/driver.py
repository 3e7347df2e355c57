# SPDX-License-Identifier: GPL-3.0-or-later
"""What a person does first, in a real window: import a model, open the tab, press Decompose, undo; separate, adjust.

Executed inside Blender by a program that opens its window on a display of its own, where ``xdotool`` and
ImageMagick's ``import`` are at hand (pointer.py uses them). Each value that steps() yields is the seconds to
wait while the window lives on. Pictures go to the folder of the environment variable GUI_OUT, and what was seen
to seen.json there, for the test to judge. The other drivers here work in the same way.
"""

import json
import os
import sys
import time

import bpy

sys.path.append(os.path.dirname(__file__))
import pointer
from spot import spot


def steps():
    """One step after the other; yields the seconds to wait."""
    seen = {"version": bpy.app.version_string}
    yield from pointer.spot_alone(maximised=True, symmetry=True)
    turn_view()
    seen["before"] = scene_facts()
    yield from open_tab()
    seen["tab"] = pointer.region("UI").active_panel_category
    pointer.shot("1_tab.png")
    yield from press_decompose(seen)
    seen["after"] = scene_facts()
    pointer.shot("2_decomposed.png", (0, 82, 1280, 770))  # the one of the README, images/window.png
    yield from pointer.rest(*pointer.in_view(0.4))
    yield from pointer.tap("ctrl+z")
    yield from pointer.until(lambda: scene_facts() == seen["before"])
    seen["undone"] = scene_facts()
    pointer.shot("3_undone.png")
    yield from pointer.tap("ctrl+shift+z")
    yield from pointer.until(lambda: scene_facts() == seen["after"])
    seen["redone"] = scene_facts()
    yield 0.5
    pointer.shot("4_redone.png")
    yield from repeat_hulls(seen)
    yield from rename_in_edit_mode(seen)
    yield from adjust_separate(seen)
    (pointer.OUT / "seen.json").write_text(json.dumps(seen, indent=2))


def turn_view():
    """Look at the model from the side; the sidebar is closed, as it is at first."""
    area = pointer.view_area()
    area.spaces.active.show_region_ui = False
    area.spaces.active.region_3d.view_rotation = (0.21, 0.14, 0.53, 0.81)
    with bpy.context.temp_override(area=area, region=pointer.region("WINDOW")):
        bpy.ops.view3d.view_selected()
        bpy.ops.ed.undo_push(message="Import")


def open_tab():
    """N over the view, then our tab."""
    yield from pointer.rest(*pointer.in_view(0.4))
    yield from pointer.tap("n")
    yield from pointer.until(lambda: pointer.region("UI").width > 1)
    pointer.region("UI").active_panel_category = "Item"
    yield 0.3
    yield from pointer.open_tab()
    yield 0.5


def press_decompose(seen):
    """Press the large button at the top and wait for the parts."""
    yield from pointer.push("reeb_parts.decompose")
    start = time.monotonic()
    yield from pointer.until(lambda: "reeb_part" in spot().data.attributes, pointer.PATIENCE)
    seen["seconds"] = time.monotonic() - start
    if seen["seconds"] >= pointer.PATIENCE:
        pointer.shot("failed.png")
        raise TimeoutError("no parts after a click on Decompose, see failed.png")
    yield from pointer.rest(*pointer.in_view(0.4))
    yield 1.0


def repeat_hulls(seen):
    """Make hulls of the scaled model, and make them again as the panel of what was done last does; undo all of it."""
    spot().scale = (2.0, 1.0, 0.5)
    bpy.ops.ed.undo_push(message="Scale")
    bpy.ops.reeb_parts.hulls("EXEC_DEFAULT", True)
    seen["hulls"] = hulls()
    with bpy.context.temp_override(area=pointer.view_area(), region=pointer.region("WINDOW")):
        bpy.ops.ed.undo_redo("EXEC_DEFAULT", True)
    yield 0.3
    seen["hulls again"] = hulls()
    for _ in range(2):
        bpy.ops.ed.undo()
    yield 0.3


def rename_in_edit_mode(seen):
    """Choose a part in Edit Mode, rename it, and change the name as the panel of what was done last does; undo that."""
    with bpy.context.temp_override(area=pointer.view_area(), region=pointer.region("WINDOW")):
        bpy.ops.object.mode_set("INVOKE_DEFAULT", True, mode="EDIT")
        result = spot().data.reeb_parts
        result.active = 2
        result.parts[1].selected = True
        bpy.ops.ed.undo_push(message="Click")  # as Blender does after one in the list
        bpy.ops.reeb_parts.rename("EXEC_DEFAULT", True, new_name="One")
        bpy.context.window_manager.operators[-1].properties.new_name = "Two"
        bpy.ops.ed.undo_redo("EXEC_DEFAULT", True)
        seen["names"] = [part.name for part in spot().data.reeb_parts.parts]
        bpy.ops.ed.undo()
        result = spot().data.reeb_parts
        seen["chosen"] = [result.active, [part.selected for part in result.parts][:3]]
        for _ in range(2):
            bpy.ops.ed.undo()
    yield 0.3


def hulls():
    """The box of each hull, and its scale."""
    return {obj.name: [[round(x, 5) for x in (*obj.dimensions, *obj.scale)]] for obj in bpy.data.objects
            if obj.name.startswith("UCX_")}


def adjust_separate(seen):
    """Press Separate, open the panel of what was done last, and have the holes closed there."""
    yield from pointer.push("reeb_parts.separate")
    yield from pointer.until(lambda: pieces(), pointer.PATIENCE)
    yield 1.0
    seen["separated"] = pieces()
    panel = pointer.region("HUD")
    yield from pointer.press(*pointer.from_top(panel.x + pointer.unit(), panel.y + 0.5 * panel.height))
    yield from pointer.until(lambda: panel.height > 10 * pointer.unit())
    yield 0.5
    # Under its title, the parts and the cuts.
    row = pointer.from_top(panel.x + 0.45 * panel.width, panel.y + panel.height - 4.5 * pointer.unit())
    yield from pointer.press(*row)
    yield from pointer.until(lambda: any(pieces().values()), pointer.PATIENCE)
    yield 0.5
    seen["adjusted"] = pieces()
    pointer.shot("5_adjusted.png")
    bpy.context.view_layer.objects.active = None
    with bpy.context.temp_override(area=pointer.view_area(), region=pointer.region("WINDOW")):
        try:
            bpy.ops.reeb_parts.separate("INVOKE_DEFAULT")
        except RuntimeError as error:
            seen["separated nothing"] = str(error).splitlines()


def pieces():
    """The pieces that there are, and whether each has closed holes."""
    return {obj.name: "reeb_cap" in obj.data.attributes for obj in bpy.data.objects if "reeb_parts_number" in obj}


def scene_facts():
    """What the test compares between the steps."""
    obj = spot()
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
    }

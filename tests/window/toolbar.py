# SPDX-License-Identifier: GPL-3.0-or-later
"""The tool of the toolbar, in a real window: hover, click, Shift and click, a box, and each of its keys; undo of each.

Executed inside Blender as driver.py is, which says how.
"""

import importlib
import json
import os
import sys

import bpy
import gpu
import numpy as np
from mathutils import Matrix

sys.path += [os.path.dirname(__file__), os.path.dirname(os.path.dirname(__file__))]
import pointer
from snapshot import snapshot
from spot import SEEN, at_work, chosen, differences, note, number, shares, spot, undo_to


def steps():
    """One step after the other; yields the seconds to wait."""
    yield from pointer.spot_alone()
    yield from pointer.search("Decompose into Parts")
    yield from pointer.until(lambda: "reeb_part" in spot().data.attributes, pointer.PATIENCE)
    yield 0.5
    pointer.view_area().spaces.active.show_region_toolbar = True
    note("a thin wall", filled())
    for scene in (started, hovered, clicked, boxed, boxed_where_seen, merged, cut, painted, grown, slid, renamed,
                  hidden, framed, kept, elsewhere):
        yield from scene()
        (pointer.OUT / "seen.json").write_text(json.dumps(SEEN, indent=2))


def filled():
    """How bright a fill is of both sides of a thin wall, the far one drawn last and first, over black."""
    lines = importlib.import_module("bl_ext.user_default.reeb_parts.viewport.lines")
    half = np.array([[[-9, -9, 0], [9, -9, 0], [0, 9, 0]]], np.float32)
    wall, shades = np.concatenate([half - [0, 0, 1], half - [0, 0, 1.0005]]), []
    for triangles in (wall, wall[::-1]):
        offscreen = gpu.types.GPUOffScreen(8, 8)
        with offscreen.bind(), gpu.matrix.push_pop(), gpu.matrix.push_pop_projection():
            frame = gpu.state.active_framebuffer_get()
            frame.clear(color=(0.0, 0.0, 0.0, 0.0), depth=1.0)
            gpu.matrix.load_matrix(Matrix())
            perspective = (1, 0, 0, 0), (0, 1, 0, 0), (0, 0, -1.02, -0.202), (0, 0, -1, 0)
            gpu.matrix.load_projection_matrix(Matrix(perspective))
            lines.Surface(triangles.astype(np.float32)).draw(Matrix(), (1.0, 1.0, 1.0, 0.25), True)
            shades.append(frame.read_color(4, 4, 1, 1, 4, 0, "FLOAT").to_list()[0][0][0])
        offscreen.free()
    return shades


def started():
    """From the button of the sidebar."""
    yield from pointer.push("wm.tool_set_by_id", "reeb_parts.cut")
    yield 0.3
    note("tool", active_tool())


def hovered():
    """The part under the pointer is filled and named; beside the model nothing is."""
    places = pointer.surface_places(spot())
    for name in ("Part 06", "Part 01"):
        yield from pointer.rest(*places[number(name)])
        yield 0.3
        note(f"hover {name}", pointed())
        pointer.shot(f"1_hover_{name[-2:]}.png")
    yield from pointer.rest(*pointer.in_view(0.1, 0.1))
    yield 0.2
    note("hover beside", pointed())
    pointer.shot("1_hover_beside.png")


def clicked():
    """A click, Shift and a click, a click beside everything."""
    places = pointer.surface_places(spot())
    before = snapshot()
    yield from pointer.press(*places[number("Part 06")])
    note("clicked", chosen())
    yield from pointer.press(*places[number("Part 03")], "Shift_L")
    note("shift-clicked", chosen())
    pointer.shot("2_clicked.png")
    yield from pointer.press(*pointer.in_view(0.1, 0.1))
    note("clicked beside", [chosen(), spot().select_get()])
    yield from undo_to("clicks undone", before, 2)


def boxed():
    """A box around the head; Ctrl takes parts away."""
    places = pointer.surface_places(spot(), step=2)
    before = snapshot()
    left, right = min(x for x, _ in places.values()), max(x for x, _ in places.values())
    top, bottom = min(y for _, y in places.values()), max(y for _, y in places.values())
    note("seen", sorted(part.name for part in spot().data.reeb_parts.parts if part.number in places))
    yield from pointer.drag([(left - 90, top - 60), (left, top), (right + 60, bottom + 90)])
    yield 0.3
    note("box", chosen())
    pointer.shot("3_box.png")
    yield from undo_to("box undone", before)


def boxed_where_seen():
    """A box around a part that a modifier has moved away."""
    before = snapshot()
    modifier = spot().modifiers.new("Away", "DISPLACE")
    modifier.direction, modifier.mid_level, modifier.strength = "Z", 0.0, 0.8
    modifier.vertex_group = "Part 06"
    bpy.ops.ed.undo_push(message="Displace")
    yield 0.5
    x, y = pointer.surface_places(spot())[number("Part 06")]
    yield from pointer.drag([(x - 20, y - 20), (x, y), (x + 20, y + 20)])
    yield 0.3
    note("box where it is seen", chosen())
    pointer.shot("3_box_where_seen.png")
    yield from undo_to("box where it is seen undone", before, 2)


def merged():
    """Two parts that touch, M."""
    before = snapshot()
    yield from choose("Part 01", "Part 06")
    ready = snapshot()
    yield from pointer.tap("m")
    yield from pointer.until(lambda: len(shares()) < 10)
    note("merged", shares())
    pointer.shot("4_merged.png")
    yield from undo_to("merge undone", ready)
    yield from undo_to("choice undone", before, 2)


def cut():
    """C, a click; C, Esc."""
    yield from choose("Part 06")
    before = snapshot()
    yield from pointer.tap("c")
    note("C", at_work())
    (tool,) = bpy.context.window.modal_operators
    note("ring after C", tool.preview.lines is not None)
    yield from pointer.press(*pointer.surface_places(spot())[number("Part 06")])
    yield from pointer.until(lambda: len(shares()) > 10)
    note("cut", sorted(shares()))
    yield from undo_to("cut undone", before)
    yield from pointer.tap("c", "Escape")
    note("cut escaped", differences(before))


def painted():
    """P, a stroke, Enter."""
    yield from choose("Part 01")
    note("before painting", shares()["Part 01"])
    before = snapshot()
    places = pointer.surface_places(spot())
    (x, y), (u, v) = places[number("Part 01")], places[number("Part 06")]
    yield from pointer.tap("p")
    note("P", at_work())
    yield from pointer.drag([(round(x + (u - x) * s / 8), round(y + (v - y) * s / 8)) for s in range(9)])
    pointer.shot("5_painting.png")
    yield from pointer.tap("Return")
    yield 0.3
    note("painted", shares()["Part 01"])
    yield from undo_to("paint undone", before)


def grown():
    """G, the wheel, a number, Enter; then G, the wheel backwards, Esc."""
    yield from choose("Part 03")
    before = snapshot()
    note("before growing", shares())
    yield from pointer.tap("g")
    yield 0.2
    note("G", [at_work(), rings()])
    view = pointer.view_area().spaces.active.region_3d.view_distance
    for _ in range(3):
        pointer.xdo("click", 4)
        yield 0.1
    yield 0.2
    note("G and the wheel", [rings(), pointer.view_area().spaces.active.region_3d.view_distance == view])
    pointer.shot("10_rings.png")
    yield from pointer.tap("1", "0")
    yield 0.2
    note("G and a number", rings())
    pointer.shot("10_ten_rings.png")
    yield from pointer.tap("Return")
    yield 0.3
    note("grown", shares())
    yield from undo_to("grow undone", before)
    yield from pointer.tap("g")
    for _ in range(3):
        pointer.xdo("click", 5)
        yield 0.1
    note("G and the wheel back", rings())
    pointer.shot("10_rings_inwards.png")
    yield from pointer.tap("x", "Delete")  # nothing but what it says
    yield from pointer.tap("Escape")
    yield 0.2
    note("grow escaped", differences(before))


def slid():
    """S over a leg, with the body chosen: only the leg's boundary slides."""
    yield from choose("Part 01")
    before = snapshot()
    note("before sliding", shares())
    x, y = pointer.surface_places(spot())[number("Part 03")]
    yield from pointer.rest(x, y)
    yield from pointer.tap("s")
    yield 0.2
    for step in range(16):
        pointer.xdo("mousemove", x + 8 * step, y)
        yield 0.05
    pointer.shot("11_sliding.png")
    yield from pointer.tap("Return")
    yield 0.3
    note("slid", shares())
    yield from undo_to("slide undone", before)


def rings():
    (operator,) = bpy.context.window.modal_operators
    return operator.properties.rings


def renamed():
    """F2 over a part that is not the active one; Enter."""
    before = snapshot()
    yield from pointer.rest(*pointer.surface_places(spot())[number("Part 06")])
    yield from pointer.tap(pointer.F2)
    yield 0.4
    pointer.shot("6_rename.png")
    yield from pointer.tap("ctrl+a")
    yield from pointer.write("Head")
    yield from pointer.tap("Return")
    yield 0.4
    note("name beside the pointer", pointed())
    pointer.shot("6_named.png")
    yield from pointer.rest(*pointer.in_view(0.1, 0.1))
    yield 0.4
    note("renamed", [sorted(shares()), chosen()[0]])
    pointer.shot("6_renamed.png")
    yield from undo_to("rename undone", before)


def hidden():
    """H; Alt and H."""
    yield from choose("Part 06")
    before = snapshot()
    yield from pointer.tap("h")
    yield 0.3
    note("hidden", hidden_parts())
    pointer.shot("12_hidden.png")
    yield from pointer.tap("alt+h")
    yield 0.3
    note("shown again", hidden_parts())
    yield from undo_to("hiding undone", before, 2)


def framed():
    """The dot of the numeric pad."""
    view = pointer.view_area().spaces.active.region_3d
    before = view.view_distance, view.view_location[:]
    yield from pointer.tap("KP_Decimal")
    yield 0.5
    note("framed", view.view_distance < before[0])
    pointer.shot("7_framed.png")
    view.view_distance, view.view_location = before
    yield 0.5


def kept():
    """The object stays where it is, and stays, whatever key that moves or deletes objects is pressed."""
    before = snapshot()
    for key in ("r", "x", "Delete"):
        yield from pointer.rest(*pointer.in_view())
        yield from pointer.tap(key)
        yield 0.2
        note(f"{key} at work", at_work())
    pointer.shot("8_kept.png")
    note("kept", differences(before))


def elsewhere():
    """On an object without parts, the keys are Blender's."""
    bpy.ops.mesh.primitive_cube_add(size=0.3, location=(-0.8, -0.8, 0.0))
    bpy.ops.ed.undo_push(message="Cube")
    yield 0.3
    yield from pointer.rest(*pointer.in_view())
    yield from pointer.tap("g")
    yield 0.2
    note("g on a cube", at_work())
    yield from pointer.tap("Escape")
    pointer.shot("9_cube.png")
    spot().select_set(True)
    bpy.context.view_layer.objects.active = spot()
    yield 0.3
    yield from pointer.press(*pointer.over((-0.8, -0.8, 0.0)))
    yield 0.2
    note("to the cube", bpy.context.view_layer.objects.active.name)


def choose(*names):
    """Click parts."""
    places = pointer.surface_places(spot())
    yield from pointer.press(*places[number(names[0])])
    for name in names[1:]:
        yield from pointer.press(*places[number(name)], "Shift_L")


def hidden_parts():
    """The parts of which all faces are hidden."""
    numbers = {}
    for polygon, item in zip(spot().data.polygons, spot().data.attributes["reeb_part"].data, strict=True):
        numbers.setdefault(item.value, set()).add(polygon.hide)
    return sorted(part.name for part in spot().data.reeb_parts.parts if numbers[part.number] == {True})


def pointed():
    """The name of the part that is filled, None for none."""
    return sys.modules["bl_ext.user_default.reeb_parts.viewport.hover"].name(spot()) or None


def active_tool():
    return bpy.context.workspace.tools.from_space_view3d_mode("OBJECT", create=False).idname

# SPDX-License-Identifier: GPL-3.0-or-later
"""Hands on the sidebar, in a real window: cancel, drag Detail, all that the list can do, sliders and menus.

Executed inside Blender as driver.py is, which says how.
"""

import json
import os
import sys

import bpy
from mathutils import Vector

sys.path += [os.path.dirname(__file__), os.path.dirname(os.path.dirname(__file__))]
import pointer
from snapshot import changes, snapshot
from spot import mesh, spot

# In pixels, where Blender's own popups have something: from a chip to the field of its popup; from a right
# click to an entry of the menu.
HEX, MERGE = (99, 299), (-60, 259)


def steps():
    """One step after the other; yields the seconds to wait."""
    seen = {}
    yield from pointer.spot_alone()
    yield from cancelled(seen)
    yield from decomposed(seen)
    yield from dragged(seen)
    yield from undone(seen, "drag undone", "decomposed")
    yield from clicked(seen)
    yield from slid(seen)
    yield from undone(seen, "slide undone", "drag undone")
    for scene in (numbered, recolored, renamed, locked, swept, framed, merged_by_menu, exploded, graph_hidden,
                  palette_chosen):
        if scene in PANELS:  # Blender makes settings where there are none when it draws them
            yield from pointer.fold(PANELS[scene])
        bpy.context.view_layer.update()  # undo leaves that for the next redraw
        before = snapshot()
        yield from scene(seen)
        yield from all_undone(seen, scene.__name__, before)
        if scene in PANELS:
            yield from pointer.fold(PANELS[scene])
    yield from painted_fast(seen)
    yield from sculpted(seen)
    (pointer.OUT / "seen.json").write_text(json.dumps(seen, indent=2))


def cancelled(seen):
    """Esc while it computes; fine base vertices make that long enough."""
    bpy.context.scene.reeb_parts.base_spacing = 0.0005
    yield from pointer.push("reeb_parts.decompose")
    pointer.xdo("key", "Escape")
    yield from pointer.until(lambda: not bpy.ops.reeb_parts.cancel.poll())
    seen["goes on"] = bpy.ops.reeb_parts.cancel.poll()
    seen["cancelled"] = facts()
    bpy.context.scene.reeb_parts.base_spacing = 0.005


def decomposed(seen):
    """Decompose with the pointer."""
    yield from pointer.push("reeb_parts.decompose")
    yield from pointer.until(lambda: "reeb_part" in mesh().attributes, pointer.PATIENCE)
    yield 1.0
    seen["decomposed"] = facts()
    pointer.shot("5_decomposed.png")


def dragged(seen):
    """Drag the Detail slider to the right."""
    x, y = yield from pointer.find("detail")
    yield from pointer.drag([(x + 4 * step, y) for step in range(9)])
    yield 0.5
    seen["dragged"] = facts()
    pointer.shot("6_dragged.png")


def undone(seen, name, before):
    """Ctrl+Z over the view."""
    yield from pointer.rest(*pointer.in_view())
    yield from pointer.tap("ctrl+z")
    yield from pointer.until(lambda: facts() == seen[before])
    seen[name] = facts()


def clicked(seen):
    """Click a part in the list that is not the first."""
    yield from press_entry(3, "name")
    yield from pointer.until(lambda: mesh().reeb_parts.active > 0)
    seen["active"] = mesh().reeb_parts.active
    pointer.shot("7_clicked.png")


def slid(seen):
    """Slide the part's boundary with the mouse, turn the view meanwhile, and confirm with a click."""
    x, y = pointer.in_view()
    yield from pointer.rest(x, y)
    with bpy.context.temp_override(area=pointer.view_area(), region=pointer.region("WINDOW")):
        bpy.ops.reeb_parts.slide("INVOKE_DEFAULT")
    yield 0.2
    yield from sweep(x, y)
    seen["slide"] = [slide_now()]
    yield from pointer.drag([(x + 60 + 10 * step, y + 4 * step) for step in range(9)], button=2)
    seen["slide"].append(slide_now())
    pointer.xdo("click", 4)  # the wheel
    yield from pointer.tap("KP_4")
    yield 0.5
    seen["slide"].append(slide_now())
    yield from pointer.tap("ctrl+z", "Delete")
    yield from sweep(x + 140, y + 32)
    seen["slide"].append(slide_now())
    pointer.xdo("click", 1)
    yield 1.0
    seen["slid"] = facts()
    pointer.shot("8_slid.png")


def sweep(x, y):
    """To the right, slowly."""
    for step in range(11):
        pointer.xdo("mousemove", x + 6 * step, y)
        yield 0.05
    yield 0.3


def slide_now():
    """How far the boundary was slid, and from where it is looked at."""
    (operator,) = bpy.context.window.modal_operators
    view = pointer.view_area().spaces.active.region_3d
    return [operator.properties.offset, list(view.view_rotation), view.view_distance]


def numbered(seen):
    """Type a number of parts."""
    yield from pointer.type_into("n_parts", "4")
    seen["typed"] = facts()


def recolored(seen):
    """The chip of a part, and a color typed into Blender's popup."""
    before = corner_colors()
    x, y = yield from press_entry(1, "color")
    yield 0.4
    pointer.shot("9_popup.png")
    yield from pointer.type_over(x + HEX[0], y + HEX[1], "#FF00FF")
    yield from pointer.press(*pointer.in_view(0.1, 0.1))  # beside the popup, which closes
    yield from pointer.until(lambda: corner_colors() != before)
    after = corner_colors()
    seen["color"] = [round(channel, 3) for channel in mesh().reeb_parts.parts[1].color]
    seen["recolored"] = sorted({after[i] for i in after if after[i] != before[i]})
    seen["recolored parts"] = sorted({part_of_corner(i) for i in after if after[i] != before[i]})
    pointer.shot("10_recolored.png")


def renamed(seen):
    """A double click on a name."""
    place = yield from press_entry(2, "name")
    yield from pointer.type_over(*place, "Leg", clicks=2)
    seen["renamed"] = facts()["groups"]


def locked(seen):
    """The lock, and two boxes ticked."""
    for index, key in ((1, "locked"), (3, "selected"), (5, "selected")):
        yield from press_entry(index, key)
    parts = mesh().reeb_parts.parts
    seen["locked"] = [part.name for part in parts if part.locked]
    seen["ticked"] = [part.name for part in parts if part.selected]
    pointer.shot("11_locked.png")


def swept(seen):
    """Press on a box and draw the pointer over those below it."""
    x, y = yield from pointer.entry(1, "selected")
    _, last = yield from pointer.entry(4, "selected")
    yield from pointer.drag([(x, y + 4 * step) for step in range((last - y) // 4 + 1)])
    seen["swept"] = [part.name for part in mesh().reeb_parts.parts if part.selected]
    seen["swept over"] = [part.name for part in mesh().reeb_parts.parts[1:5]]


def framed(seen):
    """A double click in the row of a part, beside its name."""
    view = pointer.view_area().spaces.active.region_3d
    before = view.view_distance, view.view_location.copy()
    x, y = yield from pointer.entry(4, "locked")
    yield from pointer.rest(x - round(1.5 * pointer.unit()), y)
    pointer.xdo("click", "--repeat", 2, "--delay", 60, 1)
    yield from pointer.until(lambda: view.view_distance != before[0])
    yield 0.3
    part = mesh().reeb_parts.parts[4]
    middle = spot().matrix_world @ Vector(part.middle)
    seen["framed"] = {"nearer": before[0] / view.view_distance, "share": part.share, "name": part.name,
                      "off": (view.view_location - middle).length / view.view_distance,
                      "active": mesh().reeb_parts.active, "names": facts()["groups"]}
    pointer.shot("12_framed.png")
    view.view_distance, view.view_location = before


def merged_by_menu(seen):
    """Tick two parts, right click on the list, Merge Parts."""
    n_parts = len(mesh().reeb_parts.parts)
    for index in (3, 5):
        yield from press_entry(index, "selected")
    x, y = yield from press_entry(5, "name", button=3)
    yield 0.4
    pointer.shot("13_menu.png")
    yield from pointer.press(x + MERGE[0], y + MERGE[1])
    yield from pointer.until(lambda: len(mesh().reeb_parts.parts) < n_parts)
    seen["merged"] = facts()["shares"]


def exploded(seen):
    """The slider, away and back."""
    x, y = yield from pointer.find("explode")
    yield from pointer.drag([(x + 6 * step, y) for step in range(9)])
    yield 0.3
    seen["exploded"] = [modifier.name for modifier in spot().modifiers]
    nodes = [obj for obj in bpy.data.objects if obj.get("reeb_parts_role") == "node"]
    yield from pointer.until(lambda: any(any(node.delta_location) for node in nodes))
    seen["nodes apart"] = sum(any(node.delta_location) for node in nodes) / len(nodes)
    pointer.shot("14_exploded.png")
    yield from pointer.type_over(x, y, "0")
    seen["together"] = [modifier.name for modifier in spot().modifiers]
    yield from pointer.until(lambda: not any(any(node.delta_location) for node in nodes))
    seen["nodes together"] = [list(node.delta_location) for node in nodes if any(node.delta_location)]


def graph_hidden(seen):
    """The eye beside Detail, off and on."""
    seen["graph"] = [graph_shown()]
    for _ in range(2):
        yield from pointer.push("reeb_parts.show_graph", "detail")
        yield from pointer.until(lambda: graph_shown() != seen["graph"][-1])
        seen["graph"].append(graph_shown())


def palette_chosen(seen):
    """The menu of palettes under Output: Pastel, by its letter."""
    before = corner_colors()
    yield from pointer.push("palette")
    yield 0.4
    pointer.shot("15_palettes.png")
    yield from pointer.tap("p")
    yield from pointer.until(lambda: corner_colors() != before)
    seen["palette"] = [mesh().reeb_parts.palette, corner_colors() != before]
    pointer.shot("16_palette.png")


PANELS = {exploded: "Use Parts", palette_chosen: "Output"}  # what is open for them


def all_undone(seen, name, before):
    """Ctrl+Z until the file is as it was; what is not, if it never is."""
    pointer.xdo("mousemove", *pointer.in_view())
    for _ in range(6):
        if changes(before, snapshot()):
            yield from pointer.tap("ctrl+z")
            yield 0.2
            bpy.context.view_layer.update()
    seen[f"{name}, undone"] = [str(change)[:300] for change in changes(before, snapshot())]


def painted_fast(seen):
    """A stroke of which Blender sees places that are further apart than the brush is wide."""
    result, before, settings = mesh().reeb_parts, face_numbers(), bpy.context.scene.reeb_parts
    symmetry, settings.symmetry = settings.symmetry, False  # the mirror image would be another piece
    result.active = 5  # the head, which is larger than the stroke and stays what it is
    yield from pointer.search("Paint into")
    yield 0.3
    x, y = pointer.in_view(0.43)
    yield from pointer.rest(x, y)
    pointer.xdo("mousedown", 1)
    for step in (0, 100, 200):
        pointer.xdo("mousemove", x + step, y)
        yield 0.05
    pointer.xdo("mouseup", 1)
    yield 0.2
    yield from pointer.tap("Return")
    yield from pointer.until(lambda: face_numbers() != before)
    after = face_numbers()
    painted = {index for index in range(len(after)) if after[index] != before[index]}
    seen["fast stroke"] = pieces(painted)
    pointer.shot("17_fast_stroke.png")
    yield from pointer.tap("ctrl+z")
    yield from pointer.until(lambda: face_numbers() == before)
    bpy.context.scene.reeb_parts.symmetry = symmetry


def face_numbers():
    return [item.value for item in mesh().attributes["reeb_part"].data]


def pieces(faces):
    """How many pieces some faces are in, by their edges."""
    beside = {}
    for index in faces:
        for key in mesh().polygons[index].edge_keys:
            beside.setdefault(key, []).append(index)
    count, waiting = 0, set(faces)
    while waiting:
        count, at = count + 1, [waiting.pop()]
        while at:
            new = {other for key in mesh().polygons[at.pop()].edge_keys for other in beside[key]} & waiting
            waiting -= new
            at += new
    return count


def sculpted(seen):
    """In Sculpt Mode: a name and a number typed, Detail dragged; each is undone by itself, and done again."""
    with bpy.context.temp_override(area=pointer.view_area(), region=pointer.region("WINDOW")):
        bpy.ops.object.mode_set("INVOKE_DEFAULT", True, mode="SCULPT")
    yield 1.0
    pointer.PLACES.clear()
    states = [shown()]
    place = yield from pointer.entry(1, "name")
    yield from pointer.type_over(*place, "Hoof")
    yield 0.8
    states.append(shown())
    yield from pointer.type_into("n_parts", "4")
    yield 0.8
    states.append(shown())
    x, y = yield from pointer.find("detail")
    yield from pointer.drag([(x + 4 * step, y) for step in range(9)])
    yield 0.8
    states.append(shown())
    seen["sculpted"] = states
    yield from pointer.rest(*pointer.in_view(0.1, 0.2))
    for key in ("ctrl+z", "ctrl+shift+z"):
        seen[f"sculpted, {key}"] = []
        for _ in states[1:]:
            yield from pointer.tap(key)
            yield 0.8
            seen[f"sculpted, {key}"].append(shown())
    with bpy.context.temp_override(area=pointer.view_area(), region=pointer.region("WINDOW")):
        bpy.ops.object.mode_set("INVOKE_DEFAULT", True, mode="OBJECT")
    yield 0.3


def shown():
    return [spot().mode, [part.name for part in mesh().reeb_parts.parts]]


def corner_colors():
    """The color of each corner, by its index."""
    return {i: tuple(round(c, 2) for c in item.color_srgb)
            for i, item in enumerate(mesh().color_attributes["Reeb Parts"].data)}


def part_of_corner(index):
    if not PARTS:
        for polygon in mesh().polygons:
            for corner in polygon.loop_indices:
                PARTS[corner] = mesh().attributes["reeb_part"].data[polygon.index].value
    return PARTS[index]


PARTS = {}


def graph_shown():
    return bpy.data.collections["Reeb Graph spot"].objects[0].visible_get()


def press_entry(index, key, button=1):
    """Click something in an entry of the list; where it is."""
    place = yield from pointer.entry(index, key)
    yield from pointer.press(*place, button=button)
    return place


def facts():
    """What the test compares between the steps."""
    result = mesh().reeb_parts
    return {
        "detail": round(result.detail, 4),
        "shares": {part.name: round(part.share, 4) for part in result.parts},
        "groups": sorted(group.name for group in spot().vertex_groups),
        "attributes": sorted(a.name for a in mesh().attributes),
        "objects": sorted(obj.name for obj in bpy.data.objects),
    }

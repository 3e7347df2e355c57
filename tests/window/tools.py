# SPDX-License-Identifier: GPL-3.0-or-later
"""The tools that are used over the model, in a real window: pick, cut, paint, and the graph as a handle.

And what people do while a tool is at work: undo, another command, delete the object, close the sidebar, Esc.
Executed inside Blender as driver.py is, which says how.
"""

import json
import os
import sys

import bpy
from mathutils import Euler, Vector

sys.path += [os.path.dirname(__file__), os.path.dirname(os.path.dirname(__file__))]
import pointer
from snapshot import snapshot
from spot import SEEN, at_work, chosen, differences, keys_to, note, number, shares, spot, undo_to

PACKAGE = "bl_ext.user_default.reeb_parts"
TOOLS = ("Pick Parts", "Cut Part", "Paint into", "Slide Boundary")
PARTS_ENTRY = 10  # entries of the menu above that of the parts, whose letter the first has taken
# The buttons that start them, and what is beside those in the sidebar.
BUTTONS = {"Cut": None, "Slide": "reeb_parts.paint", "Paint": None}


def steps():
    """One step after the other; yields the seconds to wait."""
    yield from pointer.spot_alone()
    yield from by_menu()
    yield from pointer.search("Decompose into Parts")
    yield from pointer.until(lambda: "reeb_part" in spot().data.attributes, pointer.PATIENCE)
    yield 0.5
    yield from by_submenu()
    yield from hidden()
    for scene in (picked, picked_again, cut, painted, escaped, held, by_graph, disturbed, elsewhere, clipped, next_door,
                  deleted, switched_off):
        yield from scene()
        (pointer.OUT / "seen.json").write_text(json.dumps(SEEN, indent=2))


def by_menu():
    """Ctrl+Alt+P over the view and the letter of Decompose, for fewer parts than usual; undo."""
    bpy.context.scene.reeb_parts.detail = 0.1
    with bpy.context.temp_override(area=pointer.view_area(), region=pointer.region("WINDOW")):
        bpy.ops.ed.undo_push(message="Detail")
    yield from pointer.rest(*pointer.in_view())
    yield from pointer.tap("ctrl+alt+p")
    yield 0.4
    yield from pointer.tap("d")
    yield from pointer.until(lambda: "reeb_part" in spot().data.attributes, pointer.PATIENCE)
    yield 0.5
    note("by menu", round(spot().data.reeb_parts.detail, 3))
    yield from pointer.rest(*pointer.in_view())
    yield from pointer.tap("ctrl+z", "ctrl+z")
    yield 0.5
    note("by menu undone", "reeb_part" in spot().data.attributes)


def by_submenu():
    """Ctrl+Alt+P, then the letter of "Cut Part" in the menu of parts: a tool, which would not start if it executed."""
    yield from pointer.rest(*pointer.in_view())
    yield from pointer.tap("ctrl+alt+p")
    yield 0.4
    yield from pointer.tap(*["Down"] * PARTS_ENTRY, "Right")
    yield 0.4
    pointer.shot("0_menu.png")
    yield from pointer.tap("c")
    yield 0.5
    note("by submenu", at_work())
    yield from pointer.tap("Escape")
    yield 0.3
    note("by submenu, escaped", at_work())


def hidden():
    """H over the view with the model alone selected, then Alt+H: whether anything of the graph is seen after each."""
    for key in ("h", "alt+h"):
        yield from pointer.rest(*pointer.in_view())
        yield from pointer.tap(key)
        yield 0.5
        note(f"graph after {key}", any(item.visible_get() for item in spot().children))
        pointer.shot(f"0_{key}.png")


def picked():
    """A click, Shift and a click, a click on the graph; Enter ends; undo."""
    places = pointer.surface_places(spot())
    before = snapshot()
    yield from pointer.search("Pick Parts")
    yield from pointer.press(*places[number("Part 06")])
    note("picked one", chosen())
    yield from pointer.press(*places[number("Part 03")], "Shift_L")
    note("picked two", chosen())
    pointer.shot("1_pick.png")
    yield from pointer.press(*on_arc("Part 02"))
    note("picked on an arc", chosen())
    yield from pointer.tap("Return")
    yield from pointer.press(*pointer.in_view(0.1, 0.1))  # beside everything: what a click means without a tool
    note("after Enter", chosen())
    yield from undo_to("pick undone", before, 2)


def picked_again():
    """Several clicks; then what the panel of what was done last and Repeat Last make of them."""
    places = pointer.surface_places(spot())
    before = snapshot()
    yield from pointer.search("Pick Parts")
    yield from pointer.press(*places[number("Part 06")])
    for place in (places[number("Part 03")], on_arc("Part 02"), places[number("Part 06")]):
        yield from pointer.press(*place, "Shift_L")
    yield from pointer.tap("Return")
    yield 0.2
    note("picked several", chosen())
    in_view(lambda: bpy.ops.ed.undo_redo("EXEC_DEFAULT", True))
    note("picked several, adjusted", chosen())
    choose("Part 01")
    bpy.ops.ed.undo_push(message="ready")
    in_view(lambda: bpy.ops.screen.repeat_last("EXEC_DEFAULT", True))
    note("picked several, repeated", chosen())
    yield from undo_to("several picks undone", before, 3)


def cut():
    """The ring under the pointer; a click cuts; undo and redo."""
    before = snapshot()
    yield from pointer.search("Cut Part")
    x, y = pointer.surface_places(spot())[number("Part 06")]
    yield from pointer.rest(x, y)
    pointer.shot("2_ring.png")
    yield from pointer.tap("Escape")
    note("cut escaped", differences(before))
    yield from pointer.search("Cut Part")
    yield from pointer.rest(x, y)
    yield from pointer.press(x, y)
    yield 0.3
    after = snapshot()
    note("cut", [part.name for part in spot().data.reeb_parts.parts])
    pointer.shot("3_cut.png")
    yield from undo_to("cut undone", before)
    yield from keys_to("cut redone", after, "ctrl+shift+z")
    yield from undo_to("cut undone again", before)


def painted():
    """A stroke with a larger brush, Enter; then another with Esc."""
    choose("Part 01")
    before = snapshot()
    note("before painting", shares())
    yield from pointer.search("Paint into")
    path = stroke("Part 01", "Part 06")
    yield from pointer.rest(*path[0])
    pointer.shot("4_brush.png")
    for _ in range(3):
        yield from pointer.press(*path[0], "Control_L", button=4)  # the wheel, up
    yield 0.3
    pointer.shot("5_larger_brush.png")
    yield from pointer.drag(path)
    pointer.shot("6_painted.png")
    yield from pointer.tap("Return")
    yield 0.3
    after = snapshot()
    note("painted", shares())
    yield from undo_to("paint undone", before)
    yield from keys_to("paint redone", after, "ctrl+shift+z")
    yield from undo_to("paint undone again", before)
    yield from pointer.search("Paint into")
    yield from pointer.drag(path)
    yield from pointer.tap("Escape")
    yield 0.3
    note("paint escaped", differences(before))


def escaped():
    """Esc right after the start, with the pointer where it was."""
    for name in TOOLS:
        before = snapshot()
        yield from pointer.search(name)
        yield from pointer.tap("Escape")
        note(f"{name} escaped at once", differences(before))


def held():
    """With Alt held, a drag with the left button, as on a mouse with two, and a click with the right one; then Esc."""
    inputs, view = bpy.context.preferences.inputs, pointer.view_area().spaces.active.region_3d
    inputs.use_mouse_emulate_3_button = True
    for name in TOOLS:
        yield from pointer.search(name)
        before = view.view_rotation.copy()
        yield from pointer.rest(*pointer.in_view(0.4))
        pointer.xdo("keydown", "Alt_L")
        yield 0.1
        yield from pointer.drag([pointer.in_view(across) for across in (0.4, 0.45, 0.5)])
        pointer.xdo("click", 3)
        yield 0.1
        pointer.xdo("keyup", "Alt_L")
        yield 0.2
        note(f"{name} with Alt", (view.view_rotation != before, at_work()))
        view.view_rotation = before
        yield from pointer.tap("Escape")
    inputs.use_mouse_emulate_3_button = False


def by_graph():
    """A click on a node, on an arc, and on another arc right after; no tool is at work."""
    node = next(item for item in spot().children if item.get("part") == number("Part 02"))
    clicked = node.name
    yield from pointer.press(*pointer.over(node.matrix_world.translation))
    yield 0.3
    note("a node", [*chosen_by_click(), clicked])
    pointer.shot("7_node.png")
    for name in ("Part 06", "Part 03"):
        yield from pointer.press(*on_arc(name))
        pointer.xdo("mousemove", *pointer.in_view(0.1, 0.1))  # and away, before the view is drawn again
        yield from pointer.until(lambda name=name: chosen_by_click() == [[name, []], "spot"])
        note(f"an arc of {name}", chosen_by_click())
    pointer.shot("8_arc.png")
    before = snapshot()
    choose("Part 06")
    bpy.ops.ed.undo_push(message="ready")
    ready = snapshot()
    yield from pointer.press(*on_arc("Part 02"))
    yield from pointer.until(lambda: chosen_by_click() == [["Part 02", []], "spot"])
    yield from undo_to("arc undone", ready, 2)
    yield from undo_to("choice undone", before)


def chosen_by_click():
    """What is chosen after a click on the graph, and which object is active then."""
    return [chosen(), bpy.context.view_layer.objects.active.name]


def disturbed():
    """Ctrl+Z, another command and N while a tool is at work."""
    places = pointer.surface_places(spot())
    before = snapshot()
    for name in TOOLS:
        choose("Part 01")
        bpy.ops.ed.undo_push(message="ready")
        ready = snapshot()
        yield from pointer.search("Split Parts")
        yield from pointer.until(lambda ready=ready: snapshot() != ready)
        split = snapshot()
        yield from pointer.search(name)
        yield from pointer.rest(*places[number("Part 06")])
        left = split if name == "Slide Boundary" else ready  # sliding takes all keys for itself
        yield from pointer.tap("ctrl+z")
        yield from pointer.until(lambda left=left: snapshot() == left, 2.0)
        yield from pointer.rest(*places[number("Part 03")])
        yield from pointer.tap("Escape")
        yield from pointer.until(lambda: not at_work())
        note(f"undo within {name}", differences(left))
        note(f"at work after {name}", at_work())
        for _ in range(4):
            if differences(before):
                bpy.ops.ed.undo()
    yield from detail_while_painting()
    yield from pointer.search("Pick Parts")
    yield from pointer.push("reeb_parts.decompose")
    yield from pointer.until(lambda: at_work() == ["REEB_PARTS_OT_pick"])
    yield from pointer.press(*places[number("Part 06")])
    note("picked after Decompose", chosen())
    yield from pointer.tap("n")
    yield from pointer.press(*places[number("Part 03")])
    note("picked without the sidebar", chosen())
    yield from pointer.tap("n", "Return")
    note("at work after Enter", at_work())


def detail_while_painting():
    """Another detail is typed over what a stroke shows."""
    choose("Part 01")
    bpy.ops.ed.undo_push(message="ready")
    ready = snapshot()
    yield from pointer.type_into("detail", "0.7")
    wanted = snapshot()
    note("more parts", [len(shares())])
    yield from undo_to("Detail undone", ready)
    note("more parts", [*SEEN["more parts"], len(shares())])
    yield from pointer.search("Paint into")
    yield from pointer.drag(stroke("Part 01", "Part 06"))
    yield from pointer.type_into("detail", "0.7")
    yield from pointer.rest(*pointer.in_view(0.1, 0.1))
    yield from pointer.tap("Escape")
    note("Detail within Paint into", differences(wanted))
    yield from undo_to("Detail within Paint into undone", ready)


def in_view(operator):
    """Call an operator as if the pointer were over the viewport."""
    with bpy.context.temp_override(area=pointer.view_area(), region=pointer.region("WINDOW")):
        operator()


def graph_in_local_view():
    """Whether the graph of the model that is seen alone is seen with it."""
    space = pointer.view_area().spaces.active
    items = [item for item in spot().children if item.get("reeb_parts_role") in ("node", "arcs")]
    return [bool(items) and space.local_view is not None and all(item.visible_get(viewport=space) for item in items)]


def in_this_view():
    """What of the model's graph is seen in the viewport."""
    space = pointer.view_area().spaces.active
    return [item.name for item in spot().children if item.visible_get(viewport=space)]


def pressed_in_edit_mode():
    """A click on each of the buttons, and which of them did anything."""
    places, started = [], []
    for name, beside in BUTTONS.items():
        places += [(yield from pointer.find(f"reeb_parts.{name.lower()}", beside))]
    tool = sys.modules[f"{PACKAGE}.viewport.modal.view_tool"].ViewTool
    own, tool.invoke = tool.invoke, lambda self, *_: started.append(self.bl_idname) or {"CANCELLED"}
    for mode in ("EDIT", "OBJECT"):
        in_view(lambda mode=mode: bpy.ops.object.mode_set(mode=mode))
        yield 0.5
        for place in places:
            yield from pointer.press(*place)
        note(f"pressed in {mode}", started[:])
        started.clear()
    tool.invoke = own


def elsewhere():
    """From the button in the sidebar; in local view; in a maximised area; in each of four views."""
    for name, beside in BUTTONS.items():
        yield from pointer.push(f"reeb_parts.{name.lower()}", beside)
        yield from pointer.until(at_work)
        note(f"button {name}", at_work())
        yield from pointer.rest(*pointer.in_view())
        yield from pointer.tap("Escape")
    yield from pressed_in_edit_mode()
    in_view(bpy.ops.view3d.localview)  # the key, numpad /, is not on all keyboards
    yield 2.0  # it comes along once Blender has time
    note("graph in local view", graph_in_local_view())
    pointer.shot("10_local_view.png")
    for _ in range(2):
        in_view(bpy.ops.reeb_parts.show_graph)
        yield 2.0
        note("graph in local view", [*SEEN["graph in local view"], *graph_in_local_view()])
    yield from pointer.search("Pick Parts")
    yield from pointer.press(*pointer.surface_places(spot())[number("Part 02")])
    note("picked in local view", chosen())
    yield from pointer.tap("Return")
    in_view(bpy.ops.view3d.localview_remove_from)
    yield from pointer.until(lambda: not in_this_view())
    note("graph in local view without its model", in_this_view())
    in_view(bpy.ops.view3d.localview)
    spot().select_set(True)
    bpy.context.view_layer.objects.active = spot()
    yield from pointer.tap("n")
    yield 0.5
    yield from pointer.search("Pick Parts")
    yield from pointer.tap("ctrl+space")  # the viewport fills the window
    yield 1.0
    yield from pointer.press(*pointer.surface_places(spot())[number("Part 06")])
    note("picked while maximised", chosen())
    yield from pointer.tap("Return", "ctrl+space")
    yield 1.0
    area = pointer.view_area()
    with bpy.context.temp_override(area=area, region=pointer.region("WINDOW")):
        bpy.ops.screen.region_quadview()
    yield 1.0
    yield from pointer.search("Pick Parts")
    found = []
    for window in [region for region in area.regions if region.type == "WINDOW"]:
        places = pointer.surface_places(spot(), window=window)
        for name in ("Part 06", "Part 01"):
            if number(name) in places:
                yield from pointer.press(*places[number(name)])
                found.append([name, chosen()[0]])
    pointer.shot("9_four_views.png")
    note("picked in four views", found)
    yield from pointer.tap("Return", "n")
    with bpy.context.temp_override(area=area, region=pointer.region("WINDOW")):
        bpy.ops.screen.region_quadview()
    yield 0.5


def clipped():
    """Parts are picked in the left half of the view; the right half is left out, as by Alt+B."""
    window = pointer.region("WINDOW")
    places = pointer.surface_places(spot())
    places = {spot().data.reeb_parts.parts[i].name: places[part.number]
              for i, part in enumerate(spot().data.reeb_parts.parts) if part.number in places}
    left, right = min(places, key=lambda name: places[name][0]), max(places, key=lambda name: places[name][0])
    middle = (places[left][0] + places[right][0]) // 2 - window.x
    with bpy.context.temp_override(area=pointer.view_area(), region=window):
        bpy.ops.view3d.clip_border(xmin=0, xmax=middle, ymin=0, ymax=window.height)
    in_view(bpy.ops.reeb_parts.show_graph)  # it is not left out
    yield 0.5
    yield from pointer.search("Pick Parts")
    found = []
    for name in (left, right):
        yield from pointer.press(*places[name])
        found.append(chosen()[0])
    pointer.shot("11_clipped.png")
    note("picked where the view is clipped", [left, right, *found])
    yield from pointer.tap("Return")
    in_view(bpy.ops.view3d.clip_border)
    in_view(bpy.ops.reeb_parts.show_graph)
    bpy.ops.ed.undo_push(message="The graph is back")  # of a script's commands nothing else does
    yield 0.3


def next_door():
    """Started in one viewport and carried into another, which looks from the other side."""
    area = pointer.view_area()
    with bpy.context.temp_override(area=area, region=pointer.region("WINDOW")):
        bpy.ops.screen.area_split(direction="VERTICAL", factor=0.5)
    yield 0.5
    other = next(item for item in bpy.context.screen.areas if item.type == "VIEW_3D" and item != area)
    for space in (area.spaces.active, other.spaces.active):
        space.show_region_ui = False
    other.spaces.active.region_3d.view_rotation = Euler((1.2, 0.0, 3.9)).to_quaternion()
    yield 0.5
    window = pointer.region("WINDOW", other)
    places = pointer.surface_places(spot(), window=window)
    note("seen next door", sorted(part.name for part in spot().data.reeb_parts.parts if part.number in places))
    before = snapshot()
    yield from pointer.search("Pick Parts")
    yield from pointer.press(*places[number("Part 01")])
    yield from pointer.press(*places[number("Part 06")], "Shift_L")
    note("picked next door", chosen())
    yield from pointer.tap("Escape")
    note("at work after Pick Parts next door", at_work())
    yield from undo_to("pick next door undone", before)
    for name in ("Cut Part", "Paint into", "Slide Boundary"):
        choose("Part 01")
        bpy.ops.ed.undo_push(message="ready")
        before = snapshot()
        yield from pointer.search(name)
        yield from pointer.rest(*places[number("Part 06")])
        note(f"{name} next door", shown_lines(window, places[number("Part 06")]))
        pointer.shot(f"10_next_door_{name.split()[0].lower()}.png")
        yield from pointer.tap("Escape")
        note(f"at work after {name} next door", at_work())
        note(f"{name} next door escaped", differences(before))
    yield from pointer.search("Cut Part")
    yield from pointer.press(*places[number("Part 06")])
    yield 0.3
    note("cut next door", shares())
    yield from undo_to("cut next door undone", before)
    yield from pointer.search("Paint into")
    yield from pointer.drag(stroke("Part 01", "Part 06", window))
    pointer.shot("10_painted_next_door.png")
    yield from pointer.tap("Return")
    note("painted next door", shares())
    yield from undo_to("paint next door undone", before)
    with bpy.context.temp_override(area=other):
        bpy.ops.screen.area_close()
    yield 0.5
    pointer.view_area().spaces.active.show_region_ui = True
    yield 0.5


def shown_lines(window, place):
    """How far the lines that a tool shows are from what is seen at a place, and how large they are."""
    (tool,) = bpy.context.window.modal_operators
    if tool.preview.lines is None:
        return None
    x, y = pointer.from_top(*place)
    _, there, _ = pointer.seen_at(window, (x - window.x, y - window.y))
    points = [spot().matrix_world @ Vector(point) for point in tool.preview.lines.reshape(-1, 3).tolist()]
    middle = sum(points, Vector()) / len(points)
    return {"nearest": min((point - there).length for point in points), "middle": (middle - there).length,
            "size": max((point - middle).length for point in points)}


def deleted():
    """The object is deleted while a tool is at work."""
    for name in TOOLS:
        before = snapshot()
        yield from pointer.search(name)
        yield 0.2
        note(f"at work before deleting within {name}", at_work())
        yield from pointer.tap("Delete")
        yield from pointer.rest(*pointer.in_view())
        note(f"deleted within {name}", ["spot" not in bpy.context.scene.objects, at_work()])
        yield from pointer.tap("Escape", "Escape")
        note(f"at work after deleting within {name}", at_work())
        for _ in range(2):
            if differences(before):
                bpy.ops.ed.undo()
        note(f"deletion within {name} undone", differences(before))


def switched_off():
    """The extension is switched off, as an update does, while a stroke has yet to be confirmed and a run goes on."""
    bpy.context.scene.reeb_parts.base_spacing *= 1.01  # nothing of this is known
    before = snapshot()
    yield from pointer.search("Paint into")
    yield from pointer.drag(stroke("Part 01", "Part 06"))
    in_view(lambda: bpy.ops.reeb_parts.decompose("INVOKE_DEFAULT"))
    note("at work before it is switched off", at_work())
    bpy.ops.preferences.addon_disable(module=PACKAGE)
    yield 0.2
    note("at work when it is switched off", at_work())
    bpy.ops.preferences.addon_enable(module=PACKAGE)
    note("switched off and on again", differences(before))
    note("ready when it is on again", bpy.ops.reeb_parts.decompose.poll())
    pointer.shot("11_switched_off.png")


def choose(name):
    result = spot().data.reeb_parts
    result.active = result.parts.find(name)


def on_arc(name):
    """A place on an arc within a part, away from nodes."""
    obj = spot()
    places = pointer.graph_places(obj)
    node = [place for key, place in places.items() if isinstance(key, str)]
    from_nodes = lambda p: min((p[0] - q[0]) ** 2 + (p[1] - q[1]) ** 2 for q in node)  # noqa: E731
    curve = next(item for item in obj.children if item.type == "CURVE")
    inside = []
    for key, place in places.items():
        if not isinstance(key, str):
            point = curve.matrix_world @ curve.data.splines[key[0]].points[key[1]].co.to_3d()
            hit, _, _, face = obj.closest_point_on_mesh(obj.matrix_world.inverted() @ point)
            if hit and obj.data.attributes["reeb_part"].data[face].value == number(name):
                inside.append(place)
    return max(inside, key=from_nodes)


def stroke(start, end, window=None):
    places = pointer.surface_places(spot(), window=window)
    (x, y), (u, v) = places[number(start)], places[number(end)]
    return [(round(x + (u - x) * s / 8), round(y + (v - y) * s / 8)) for s in range(9)]

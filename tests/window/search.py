# SPDX-License-Identifier: GPL-3.0-or-later
"""Every command by its plain name, in a real window: F3, its name, Enter; then undo and redo by keys.

Executed inside Blender as driver.py is, which says how.
"""

import json
import os
import sys
from collections.abc import Callable
from dataclasses import dataclass

import bpy

sys.path += [os.path.dirname(__file__), os.path.dirname(os.path.dirname(__file__))]
import pointer
from snapshot import activate, changes, snapshot
from spot import spot


@dataclass(frozen=True)
class Command:
    """What is typed, on which scene, and what hands do then.

    Attributes
    ----------
    name : str
        As the menu has it.
    ready : callable(obj)
        Makes the scene that it is for, of a model that was just decomposed.
    hands : callable(obj), a generator
        Whether it takes the pointer or the keyboard after Enter.
    undo : bool
        Whether it is a step of undo.
    """

    name: str
    ready: Callable = lambda obj: None
    hands: Callable = lambda obj: ()
    undo: bool = True


def mark(*names):
    """Mark parts in the list; the first is the active one."""
    def ready(obj):
        result = obj.data.reeb_parts
        result.active = result.parts.find(names[0])
        for part in result.parts:
            part.selected = len(names) > 1 and part.name in names
    return ready


def mode(name, ready=lambda obj: None):
    def there(obj):
        ready(obj)
        bpy.ops.object.mode_set(mode=name)
    return there


def pinned(obj):
    """A part that was changed by hand."""
    mark(HEAD)(obj)
    bpy.ops.reeb_parts.split()


def some_faces(obj):
    """Faces of the head selected in Edit Mode."""
    mark(BODY)(obj)
    part = obj.data.attributes["reeb_part"].data
    of_head = [polygon for polygon in obj.data.polygons if part[polygon.index].value == number(obj, HEAD)][:40]
    corners = {vertex for polygon in of_head for vertex in polygon.vertices}
    for polygon in obj.data.polygons:
        polygon.select = False
    for polygon in of_head:
        polygon.select = True
    for vertex in obj.data.vertices:
        vertex.select = vertex.index in corners
    bpy.ops.object.mode_set(mode="EDIT")


def at_node(obj):
    """The node in the middle of the head is the active object."""
    nodes = [item for item in obj.children if item.get("kind") == "saddle" and item["part"] == number(obj, HEAD)]
    activate(nodes[0])


def painted_sets(obj):
    """A face set of somebody's own over those of the parts."""
    bpy.ops.reeb_parts.face_sets()
    for face in list(obj.data.polygons)[:40]:
        obj.data.attributes[".sculpt_face_set"].data[face.index].value = 77


def no_parts(obj):
    bpy.ops.reeb_parts.clear()


def separated(obj):
    bpy.ops.reeb_parts.separate()


def separated_and_back(obj):
    bpy.ops.reeb_parts.separate()
    bpy.ops.reeb_parts.show_original()


def other_parameters(obj):
    bpy.context.scene.reeb_parts.band_ratio = 0.9


def other_overlay(obj):
    bpy.context.scene.reeb_parts.node_size = 0.2


def number(obj, name):
    return obj.data.reeb_parts.parts[name].number


def click_part(obj):
    """A click on the head, and the tool ends."""
    yield from pointer.press(*pointer.surface_places(obj)[number(obj, HEAD)])
    yield from pointer.tap("Return")


def click_cut(obj):
    yield from pointer.press(*pointer.surface_places(obj)[number(obj, BODY)])


def stroke(obj):
    """From the body over the head."""
    places = pointer.surface_places(obj)
    (x, y), (u, v) = places[number(obj, BODY)], places[number(obj, HEAD)]
    yield from pointer.drag([(round(x + (u - x) * s / 8), round(y + (v - y) * s / 8)) for s in range(9)])
    yield from pointer.tap("Return")


def slide(obj):
    x, y = pointer.in_view()
    for step in range(1, 9):
        pointer.xdo("mousemove", x + 8 * step, y)
        yield 0.05
    pointer.xdo("click", 1)


def confirm(obj):
    """Enter, once the tool is at work."""
    yield from pointer.until(lambda: len(bpy.context.window.modal_operators) > 0)
    yield from pointer.tap("Return")


def to_folder(obj):
    """In the file browser: the folder, Enter."""
    yield from pointer.until(lambda: pointer.browser() is not None)
    yield 0.5
    folder = pointer.OUT / "export"
    folder.mkdir(exist_ok=True)
    pointer.browser().spaces.active.params.directory = os.fsencode(str(folder))
    yield 0.5
    pointer.shot("export.png")
    yield from pointer.tap("Return")
    yield from pointer.until(lambda: any(folder.iterdir()))


MODES = ("EDIT", "SCULPT", "WEIGHT_PAINT", "VERTEX_PAINT")
BODY, LEG, HEAD, EAR = "Part 01", "Part 02", "Part 06", "Part 04"

COMMANDS = (
    Command("Pick Parts", hands=click_part),
    Command("Select Faces of Parts", mark(LEG, EAR)),
    Command("Isolate Parts", mark(LEG)),
    Command("Show All Parts", lambda obj: (mark(LEG)(obj), bpy.ops.reeb_parts.isolate())),
    Command("Reeb Parts Invert", mark(LEG)),
    Command("Merge Parts", mark(HEAD, EAR)),
    Command("Merge into Neighbor", mark(EAR)),
    Command("Split Parts", mark(HEAD)),
    Command("Cut Part at Point", mark(HEAD), click_cut),
    Command("Grow Parts", mark(EAR), confirm),
    Command("Shrink Parts", mark(HEAD), confirm),
    Command("Slide Boundary", mark(HEAD), slide),
    Command("Paint into Part", mark(BODY), stroke),
    Command("Assign Faces to Part", some_faces),
    Command("New Part of Selected Faces", some_faces),
    Command("Parts from Face Sets", painted_sets),
    Command("Release Parts", pinned),
    Command("Release All Parts", pinned),
    Command("Nodes of Chosen Parts", mark(HEAD)),
    Command("Parts of Selected Nodes", at_node),
    Command("Split at Graph Node", at_node),
    Command("Mark Seams between Parts"),
    Command("Make Face Sets of Parts"),
    Command("Give Each Part a Material"),
    Command("Unwrap along Cuts"),
    Command("Make Armature from Parts"),
    Command("Make Collision Hulls of Parts"),
    Command("Separate Parts into Objects"),
    Command("Show Original of Part", separated),
    Command("Show Separated Parts", separated_and_back),
    Command("Use Preferences in This Scene", other_overlay),
    Command("Reset Parameters to Preset", other_parameters),
    Command("More Parts"),
    Command("Clear Parts"),
    *(Command("Decompose into Parts", mode(name, no_parts)) for name in MODES),
    Command("Cut Part at Point", mode("EDIT")),
    Command("Paint into Part", mode("SCULPT")),
    Command("Slide Boundary", mode("WEIGHT_PAINT")),
    Command("Pick Parts", mode("VERTEX_PAINT")),
    Command("Export Parts to Files", hands=to_folder, undo=False),
)


def steps():
    """One step after the other; yields the seconds to wait."""
    seen = {}
    bpy.context.preferences.view.filebrowser_display_type = "SCREEN"  # not a window beside this one
    yield from pointer.spot_alone()
    yield from pointer.search("Decompose into Parts")
    yield from pointer.until(lambda: "reeb_part" in spot().data.attributes, pointer.PATIENCE)
    yield 0.5
    for name in (*MODES, "OBJECT"):  # each brings its brushes along
        bpy.ops.object.mode_set(mode=name)
    bpy.ops.ed.undo_push(message="Decomposed")
    start = look()
    for command in COMMANDS:
        yield from tried(command, seen)
        back = changes(start, look())
        if back:
            raise AssertionError(f"{command.name} left {back}")
    (pointer.OUT / "seen.json").write_text(json.dumps(seen, indent=2))


def tried(command, seen):
    """One command from the scene it is for to redo, and back."""
    command.ready(spot())
    yield 0.05  # the list follows the active object
    bpy.ops.ed.undo_push(message="ready")
    yield 0.05
    key = f"{command.name}, {bpy.context.mode}"
    before, said = look(), len(bpy.context.window_manager.reports)
    yield from pointer.search(command.name)
    yield from command.hands(spot())
    yield from pointer.until(lambda: len(bpy.context.window_manager.reports) > said)
    after = look()
    seen[key] = {
        "changed": [path for path, *_ in changes(before, after)],
        "said": [f"{r.type}: {r.message}" for r in list(bpy.context.window_manager.reports)[said:]],
    }
    if any(line.startswith("ERROR") for line in seen[key]["said"]):
        yield from pointer.tap("Escape")  # what pops up
    if command.undo and seen[key]["changed"]:
        pointer.xdo("mousemove", *pointer.in_view())
        for name, keys, wanted in (("undone", "ctrl+z", before), ("redone", "ctrl+shift+z", after)):
            pointer.xdo("key", keys)
            yield from pointer.until(lambda wanted=wanted: look() == wanted, 2.0)
            seen[key][name] = [str(change)[:200] for change in changes(wanted, look())]
        bpy.ops.ed.undo()
    bpy.ops.ed.undo()
    yield 0.05


def look():
    """The file as it is, with all that depends on what was changed."""
    bpy.context.view_layer.update()
    return snapshot()

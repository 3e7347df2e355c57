# SPDX-License-Identifier: GPL-3.0-or-later
"""Three tasks of an artist, in as few actions as the window asks for: every click, key and typed text counts as one.

Part of newcomer.py, so that Blender starts once for both; with a horse of our own (tests/shapes.py).
"""

import os
import sys

import bpy
from mathutils import Euler, Vector

sys.path += [os.path.dirname(__file__), os.path.dirname(os.path.dirname(__file__))]
import pointer
import shapes


class Hands:
    """Does what a person does, and counts it."""

    def __init__(self):
        self.done = []

    def click(self, what, place):
        yield from pointer.press(*place)
        self.done.append(f"click {what}")
        yield 0.4

    def push(self, name, beside=None):
        """A click on a button of the sidebar, which pointer.find() names."""
        yield from self.click(name, (yield from pointer.find(name, beside)))

    def key(self, name):
        yield from pointer.tap(name)
        self.done.append(f"key {name}")
        yield 0.4

    def type(self, text):
        yield from pointer.write(text)
        self.done.append(f"type {text}")


def steps(seen):
    """One task after the other; yields the seconds to wait."""
    yield from add_horse()
    for task in (named_pieces, merged_and_cut, few_of_many):
        hands = Hands()
        yield from task(hands, seen)
        seen[f"{task.__name__}, actions"] = hands.done


def add_horse():
    """Alone in the scene, seen from the side; the sidebar is closed."""
    for obj in list(bpy.data.objects):
        bpy.data.objects.remove(obj)
    vertices, faces = shapes.horse()
    mesh = bpy.data.meshes.new("Horse")
    mesh.from_pydata(vertices.tolist(), [], faces.tolist())
    obj = bpy.data.objects.new("Horse", mesh)
    bpy.context.scene.collection.objects.link(obj)
    obj.select_set(True)
    bpy.context.view_layer.objects.active = obj
    area = pointer.view_area()
    pointer.region("UI").active_panel_category = "Item"
    area.spaces.active.show_region_ui = False
    view = area.spaces.active.region_3d
    view.view_rotation = Euler((1.25, 0.0, 0.5)).to_quaternion()
    view.view_location, view.view_distance = view.view_rotation @ Vector((0.7, -0.2, 0.0)), 8.0
    with bpy.context.temp_override(area=area, region=pointer.region("WINDOW")):
        bpy.ops.ed.undo_push(message="Import")
    yield 0.7


def named_pieces(hands, seen):
    """From a horse and a closed sidebar to head, legs and tail as objects of those names."""
    yield from pointer.rest(*pointer.in_view(0.3, 0.8))
    yield from hands.key("n")
    yield from pointer.until(lambda: pointer.region("UI").width > 1)
    yield 0.3
    yield from hands.click("the tab", TAB)
    yield from hands.push("reeb_parts.decompose")
    yield from pointer.until(lambda: horse().data.reeb_parts.parts, pointer.PATIENCE)
    yield 0.5
    seen["ten"] = parts()
    yield from hands.push("reeb_parts.suggest_names", "reeb_parts.separate")
    yield from pointer.until(lambda: "head" in names())
    pointer.shot("6_horse_named.png", PICTURE)
    yield from hands.push("reeb_parts.separate")
    yield from pointer.until(lambda: horse().hide_get(), pointer.PATIENCE)
    yield from pointer.rest(*pointer.in_view(0.3, 0.8))
    yield 0.5
    seen["pieces"] = sorted(obj.name for obj in bpy.context.selected_objects)
    pointer.shot("7_horse_pieces.png", PICTURE)
    yield from pointer.tap("ctrl+z")
    yield from pointer.until(lambda: not horse().hide_get())
    yield 0.7
    seen["shown after undo"] = pointer.view_area().spaces.active.shading.color_type


def merged_and_cut(hands, seen):
    """The tail joins the body, and a leg is cut in two, with its twin."""
    seen["before"] = parts()
    pointer.PLACES.clear()  # the first row of the list is looked for from the top
    for name in ("body", "tail"):
        yield from hands.click(f"the box of {name}", (yield from pointer.entry(names().index(name), "selected")))
    sidebar, (_, y) = pointer.region("UI"), (yield from pointer.entry(0, "color"))
    column = sidebar.x + sidebar.width - round(2.6 * pointer.unit()), y - round(pointer.unit())
    yield from hands.click("Merge", (yield from pointer.find("reeb_parts.merge", below=column)))
    yield from pointer.until(lambda: len(parts()) == len(seen["before"]) - 1)
    seen["merged"] = parts()
    place = pointer.surface_places(horse())[horse().data.reeb_parts.parts[names().index(LEG)].number]
    yield from hands.push("reeb_parts.cut")
    yield from hands.click(LEG, place)
    yield from pointer.until(lambda: len(parts()) == len(seen["before"]))
    yield 0.5
    seen["cut"] = parts()
    pointer.shot("8_horse_cut.png", PICTURE)
    yield from pointer.tap("Escape")  # the tool would cut more
    yield 0.3


def few_of_many(hands, seen):
    """65 parts, of which the ten that stand out most are wanted."""
    bpy.ops.reeb_parts.clear()
    bpy.ops.reeb_parts.decompose(n_parts=65)
    yield 0.7
    seen["65"] = len(parts())
    pointer.shot("9_horse_65.png", PICTURE)
    yield from hands.click("the number of parts", (yield from pointer.find("n_parts")))
    yield from hands.type("10")
    yield from hands.key("Return")
    yield from pointer.until(lambda: len(parts()) == 10)
    yield from pointer.rest(*pointer.in_view(0.3, 0.8))
    yield 0.5
    seen["few"] = parts()
    pointer.shot("10_horse_10.png", PICTURE)


LEG = "front leg.R"
PICTURE = (300, 60, 1280, 700)
TAB = None  # where our tab is, as newcomer.py has found it


def parts():
    """Share of the surface of each part, by name."""
    return {part.name: round(part.share, 5) for part in horse().data.reeb_parts.parts}


def names():
    return [part.name for part in horse().data.reeb_parts.parts]


def horse():
    return bpy.data.objects["Horse"]

# SPDX-License-Identifier: GPL-3.0-or-later
"""The frames of the tour at the top of the README, taken with the real pointer and keyboard; made anew by

    GUI_OUT=FOLDER GUI --size 960x600 --seconds 300 --driver tests/window/tour.py
    python3 tools/tour.py FOLDER

where GUI is the program that opens Blender's window with the extension installed (driver.py says what it does). What is
said stands in the header of the viewport; frames.json says how long each frame is shown, and where the pointer was.
"""

import json
import os
import subprocess
import sys

import bpy
from mathutils import Euler, Quaternion, Vector

sys.path.append(os.path.dirname(__file__))
import pointer
from spot import spot

FRAMES = []  # file, seconds, place of the pointer, whether it is pressed
AT = [480, 300]  # the pointer


def steps():
    """One scene after the other; yields the seconds to wait."""
    yield from pointer.spot_alone(maximised=True, symmetry=True)
    settle_view()
    for scene in (opened, decomposed, dragged, stepped, named, cut, exploded, separated, boned):
        yield from scene()
    (pointer.OUT / "frames.json").write_text(json.dumps(FRAMES))


def settle_view():
    """Little but the model: what else is drawn changes with every turn."""
    area = pointer.view_area()
    space = area.spaces.active
    overlay = space.overlay
    overlay.show_floor = overlay.show_axis_x = overlay.show_axis_y = overlay.show_cursor = overlay.show_text = False
    space.show_region_toolbar = space.show_region_tool_header = space.show_gizmo = False
    space.show_region_ui = False
    look((1.28, 0.0, 2.4))


def look(euler=None, turn=0.0, distance=3.4):
    """From where the model is seen, left of the sidebar."""
    view = pointer.view_area().spaces.active.region_3d
    if euler:
        view.view_rotation = Euler(euler).to_quaternion()
    view.view_rotation = Quaternion((0, 0, 1), turn) @ view.view_rotation
    view.view_distance = distance
    view.view_location = view.view_rotation @ Vector((0.42, -0.05, 0.0)) + Vector((0.0, 0.0, 0.05))


def say(text):
    pointer.view_area().header_text_set(text)
    yield 0.3


def frame(seconds, pressed=False):
    """Take a picture, to be shown for some seconds."""
    name = f"{len(FRAMES):03d}.ppm"
    subprocess.run(["import", "-window", "root", "-depth", "8", str(pointer.OUT / name)], check=True)
    FRAMES.append([name, seconds, list(AT), pressed])


def go(place, steps=3):
    """Move the pointer there by some frames."""
    start = list(AT)
    for step in range(1, steps + 1):
        AT[:] = [round(a + (b - a) * step / steps) for a, b in zip(start, place, strict=True)]
        yield from pointer.rest(*AT)
        frame(0.12)


def click(place, seconds=0.3):
    yield from go(place)
    frame(seconds, pressed=True)
    pointer.xdo("click", 1)
    yield 0.3


def aside():
    """Away from the buttons, before their tooltips come."""
    yield from go(pointer.in_view(0.08, 0.3), 2)
    yield 0.5


def opened():
    """N, and the tab."""
    yield from say("A mesh in one piece")
    frame(2.5)
    yield from say("Press N, and choose the tab Reeb Parts")
    pointer.view_area().spaces.active.show_region_ui = True
    yield 0.5
    pointer.region("UI").active_panel_category = pointer.TAB
    yield 0.6
    frame(2.5)


def decomposed():
    yield from say("Decompose: one button, no number of parts to give")
    place = yield from pointer.find("reeb_parts.decompose")
    yield from click(place, 0.8)
    yield 0.1
    frame(0.6)
    yield from aside()
    yield from pointer.until(lambda: spot().data.reeb_parts.parts, pointer.PATIENCE)
    yield 0.6
    frame(2.5)
    yield from say("Its parts in colors, and why: the Reeb graph")
    frame(2.5)
    for turn in (0.2,) * 6 + (-0.2,) * 6:
        look(turn=turn)
        yield 0.2
        frame(0.3)
    frame(1.0)


def dragged():
    yield from say("Detail: fewer or more parts, at once")
    x, y = yield from pointer.find("detail")
    yield from go((x, y))
    yield from pointer.rest(*pointer.in_view(0.05, 0.1))  # no tooltip
    for percent in (50, 30, 15, 8, 2, 8, 15, 30, 50, 70, 80, 90, 70, 50):
        spot().data.reeb_parts.detail = percent / 100
        AT[:] = [x + percent - 50, y]
        yield 0.4
        frame(0.5, pressed=True)
    frame(1.0)


def stepped():
    yield from say("Fewer and More: to the next number of parts that stands out")
    for name, seconds in (("Fewer", 1.5), ("More", 1.5)):
        sidebar = pointer.region("UI")
        _, y = yield from pointer.find("n_parts")
        yield from click((sidebar.x + round((0.2 if name == "Fewer" else 0.7) * sidebar.width), y))
        yield 0.5
        frame(seconds)
    spot().data.reeb_parts.detail = 0.5
    yield from aside()


def named():
    yield from say("Suggest Names: body, head, legs, tail, with their sides")
    place = yield from pointer.find("reeb_parts.suggest_names", beside="reeb_parts.separate")
    yield from click(place)
    yield from aside()
    frame(3.5)


def cut():
    yield from say("Cut: a ring shows where; both sides follow")
    place = yield from find_tool()
    yield from click(place)
    number = next(part.number for part in spot().data.reeb_parts.parts if part.name.endswith("head"))
    x, y = pointer.surface_places(spot())[number]
    for shift in (0, 14, 28, 42):
        yield from go((x + shift, y + shift // 2), 1)
        yield 0.3
        frame(0.5)
    yield from click((x + 42, y + 21))
    yield 0.6
    frame(2.5)
    yield from pointer.tap("Escape", "ctrl+z")
    yield 0.6


def find_tool():
    """Where the button Cut is: in the right half of the sidebar."""
    sidebar = pointer.region("UI")
    x, y = pointer.from_top(sidebar.x + 0.7 * sidebar.width, sidebar.y + 0.8 * sidebar.height)
    return (yield from pointer.find("reeb_parts.cut", below=(x, y)))


def exploded():
    yield from say("Explode: the parts drift apart in the view, the graph with them")
    made = spot().reeb_parts_made
    for amount in (0.1, 0.2, 0.35, 0.5, 0.6):
        made.explode = amount
        yield 0.5
        frame(0.3)
    frame(1.5)
    for amount in (0.3, 0.0):
        made.explode = amount
        yield 0.5
        frame(0.3)


def separated():
    yield from say("Separate: each part is an object, cut smoothly")
    place = yield from pointer.find("reeb_parts.separate")
    yield from click(place)
    yield from pointer.until(lambda: spot().hide_get(), pointer.PATIENCE)
    yield from aside()
    frame(2.0)
    head = next(obj for obj in bpy.data.objects if obj.name.endswith(" head"))
    for obj in bpy.context.selected_objects:
        obj.select_set(obj == head)
    bpy.context.view_layer.objects.active = head
    for _ in range(5):
        head.location.z += 0.08
        yield 0.25
        frame(0.25)
    frame(2.0)


def boned():
    yield from say("Make Armature: a bone for each part, to pose it")
    head = next(obj for obj in bpy.data.objects if obj.name.endswith(" head"))
    head.location.z -= 0.4
    bpy.ops.reeb_parts.show_original()
    yield 0.5
    bpy.ops.reeb_parts.armature()
    pointer.view_area().spaces.active.shading.color_type = "VERTEX"
    yield 0.7
    frame(2.5)
    (rig,) = [obj for obj in bpy.data.objects if obj.type == "ARMATURE"]
    bpy.context.scene.reeb_parts.highlight = False
    for turn in (0.25, 0.5, 0.25, 0.0, -0.25, -0.5, -0.25, 0.0, 0.25, 0.5, 0.25, 0.0):
        for bone in (bone for bone in rig.pose.bones if "leg" in bone.name):
            sideways = (rig.matrix_world @ bone.bone.matrix_local).to_3x3().inverted() @ Vector((1.0, 0.0, 0.0))
            bone.rotation_mode = "QUATERNION"
            way = 1 if ("front" in bone.name) == bone.name.endswith("L") else -1
            bone.rotation_quaternion = Quaternion(sideways, way * turn)
        yield 0.4
        frame(0.3)
    yield from say("The mesh itself is never changed; Clear Parts takes off it all that was written")
    frame(4.0)

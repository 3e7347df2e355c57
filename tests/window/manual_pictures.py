# SPDX-License-Identifier: GPL-3.0-or-later
"""The pictures of docs/user.md, taken with the real pointer and keyboard; made anew by

    GUI_OUT=docs/images/user GUI --size 1280x800 --seconds 240 --driver tests/window/manual_pictures.py

where GUI is the program that opens Blender's window with the extension installed (driver.py says what it does).
Those of the first steps are what newcomer.py leaves, and images/window.png is 2_decomposed.png of driver.py.
"""

import os
import sys
import tempfile
from pathlib import Path

import bpy
from mathutils import Quaternion, Vector

sys.path.append(os.path.dirname(__file__))
import pointer
from spot import number, spot

HEX = (99, 299)  # from a chip to the field of its popup
BODY, LEG, HEAD, EAR = "Part 01", "Part 02", "Part 06", "Part 04"
MODEL = (350, 110, 850, 690)  # what is seen of the model
ALL = (350, 60, 1270, 690)  # and the sidebar


def steps():
    """One picture after the other; yields the seconds to wait."""
    yield from pointer.spot_alone(maximised=True)
    overlay = pointer.view_area().spaces.active.overlay
    overlay.show_floor = overlay.show_axis_x = overlay.show_axis_y = overlay.show_cursor = False
    yield from found_by_name()
    for scene in (looked, few_and_many, colored, palettes, listed, picked, grown, cut, painted, slid, by_graph, changed,
                  exploded, joined, boned, exported, folded_out, seamed, unwrapped, face_sets):
        yield from scene()


def found_by_name():
    """F3, and the menu under Object."""
    pointer.xdo("mousemove", *pointer.in_view(0.3, 0.6))
    pointer.xdo("key", pointer.F3)
    yield 0.4
    yield from pointer.write("decompose")
    yield 0.3
    x, y = pointer.in_view(0.3, 0.6)
    pointer.shot("search.png", (x - 20, y - 30, x + 400, y + 110))
    yield from pointer.tap("Return")
    yield from pointer.until(lambda: "reeb_part" in spot().data.attributes, pointer.PATIENCE)
    yield 0.5
    look()
    yield 0.5


def looked():
    """All of it; the marks of the graph from near."""
    choose(HEAD)
    yield from pointer.rest(*pointer.in_view(0.1, 0.1))
    yield 0.5
    pointer.shot("parts.png", ALL)
    inside = [item.matrix_world.translation for item in spot().children if item.get("part") == number(HEAD)]
    look(0.55, sum(inside, Vector()) / len(inside))
    yield 0.7
    pointer.shot("marks.png", MODEL)
    look()
    yield 0.5


def few_and_many():
    for name, detail in (("few.png", 0.1), ("many.png", 0.8)):
        spot().data.reeb_parts.detail = detail
        yield 0.6
        pointer.shot(name, MODEL)
    spot().data.reeb_parts.detail = 0.5
    yield 0.4


def colored():
    """The popup of a chip, and a color typed into it."""
    x, y = yield from pointer.entry(1, "color")
    yield from pointer.press(x, y)
    yield 0.4
    yield from pointer.rest(x + HEX[0], y + HEX[1])
    pointer.xdo("click", 1)
    yield 0.1
    yield from pointer.tap("ctrl+a")
    yield from pointer.write("#FF00FF")
    yield from pointer.tap("Return")
    yield 0.3
    pointer.shot("colour.png", ALL)
    yield from pointer.press(*pointer.in_view(0.1, 0.1))  # beside the popup, which closes
    yield from pointer.tap("ctrl+z")
    yield 0.3


def palettes():
    for palette in ("Pastel", "Bright"):
        bpy.context.scene.reeb_parts.palette = palette
        yield 0.5
        pointer.shot(f"{palette.lower()}.png", MODEL)
    bpy.context.scene.reeb_parts.palette = "Colour-blind safe"
    yield 0.3


def listed():
    """A name being changed; the menu of the list; isolated."""
    place = yield from pointer.entry(5, "name")
    yield from pointer.press(*place)
    yield from pointer.press(*place, button=3)
    yield 0.5
    pointer.shot("menu.png", (830, 130, 1280, 800))
    yield from pointer.tap("Escape")
    yield 0.3
    yield from pointer.rest(*pointer.in_view(0.1, 0.1))
    yield from pointer.search("Isolate Parts")
    yield 0.4
    bpy.ops.object.mode_set(mode="EDIT")
    yield 0.6
    pointer.shot("isolated.png", MODEL)
    bpy.ops.object.mode_set(mode="OBJECT")
    yield from pointer.search("Show All Parts")
    yield 0.3


def picked():
    """With the tool: two parts chosen, a third one under the pointer."""
    places = pointer.surface_places(spot())
    yield from pointer.push("wm.tool_set_by_id", "reeb_parts.cut")
    yield from pointer.press(*places[number(HEAD)])
    yield from pointer.press(*places[number(LEG)], "Shift_L")
    yield from pointer.rest(*places[number(BODY)])
    yield 0.5
    pointer.shot("pick.png", ALL)


def grown():
    """By four rings, with the tool's key."""
    yield from pointer.press(*pointer.surface_places(spot())[number(LEG)])
    yield from pointer.tap("g", "4")
    yield 3.0  # at rest, the line is the one of Separate
    pointer.shot("grow.png", MODEL)
    yield from pointer.tap("Escape")
    yield 0.3
    bpy.ops.wm.tool_set_by_id(name="builtin.select_box", space_type="VIEW_3D")
    yield 0.3


def cut():
    """The ring, and what a click makes of it."""
    yield from pointer.search("Cut Part")
    x, y = pointer.surface_places(spot())[number(BODY)]
    yield from pointer.rest(x, y)
    yield 3.0
    pointer.shot("cut_ring.png", MODEL)
    yield from pointer.press(x, y)
    yield 1.0
    pointer.shot("cut_done.png", MODEL)
    yield from pointer.tap("ctrl+z")
    yield 0.4


def painted():
    choose(BODY)
    places = pointer.surface_places(spot())
    (x, y), (u, v) = places[number(BODY)], places[number(HEAD)]
    yield from pointer.search("Paint into")
    yield from pointer.press(x, y, "Control_L", button=4)
    yield from pointer.drag([(round(x + (u - x) * s / 8), round(y + (v - y) * s / 8)) for s in range(9)])
    pointer.shot("paint.png", MODEL)
    yield from pointer.tap("Escape")
    yield 0.3


def slid():
    choose(HEAD)
    yield from pointer.search("Slide Boundary")
    x, y = pointer.in_view()
    for step in range(1, 13):
        pointer.xdo("mousemove", x + 10 * step, y)
        yield 0.05
    yield 0.3
    pointer.shot("slide.png", MODEL)
    yield from pointer.tap("Escape")
    yield 0.3


def by_graph():
    """A click on an arc."""
    curve = next(item for item in spot().children if item.type == "CURVE")
    longest = max(curve.data.splines, key=lambda spline: len(spline.points))
    middle = longest.points[len(longest.points) // 2].co.to_3d()
    yield from pointer.press(*pointer.over(curve.matrix_world @ middle))
    yield from pointer.rest(*pointer.in_view(0.1, 0.1))
    yield 1.5  # panels open slowly
    pointer.shot("arc.png", ALL)


def face_sets():
    """The parts as face sets, and a stroke of Blender's brush over them."""
    yield from pointer.search("Make Face Sets")
    yield 0.3
    bpy.ops.object.mode_set(mode="SCULPT")
    yield 0.3
    with bpy.context.temp_override(area=pointer.view_area(), region=pointer.region("WINDOW")):
        bpy.ops.brush.asset_activate(asset_library_type="ESSENTIALS", relative_asset_identifier=FACE_SET_BRUSH)
    yield 0.5
    places = pointer.surface_places(spot())
    x, y = places[number(BODY)]
    yield from pointer.drag([(x - 60 + 20 * step, y - 30) for step in range(8)])
    yield 0.5
    pointer.shot("face_sets.png", MODEL)
    yield from pointer.search("Parts from Face Sets")
    yield 0.3
    bpy.ops.object.mode_set(mode="OBJECT")
    yield 0.5
    pointer.shot("from_face_sets.png", ALL)


def changed():
    """Advanced, with the button that appears beside the preset."""
    bpy.context.scene.reeb_parts.band_ratio = 0.8
    _, y = yield from pointer.fold("Advanced")
    yield from pointer.rest(*pointer.in_view(0.1, 0.1))
    yield 0.3
    ui = pointer.region("UI")
    left, _ = pointer.from_top(ui.x, ui.y)
    pointer.shot("reset.png", (left, y - 12, left + ui.width, y + 210))
    yield from pointer.fold("Advanced")
    yield from pointer.search("Reset Parameters")
    yield 0.3


def exploded():
    spot().reeb_parts_made.explode = 0.2
    yield 0.6
    pointer.shot("explode.png", MODEL)
    spot().reeb_parts_made.explode = 0.0
    yield 0.3


def joined():
    """Pieces with pegs, moved apart; then all is as it was."""
    space = pointer.view_area().spaces.active
    original, before = spot(), (space.shading.color_type, space.region_3d.view_rotation.copy())
    with bpy.context.temp_override(area=pointer.view_area(), region=pointer.region("WINDOW")):
        bpy.ops.reeb_parts.separate(joints="ROUND", joint_count=2)
    pieces = [obj for obj in bpy.data.objects if "reeb_parts_number" in obj]
    middle = sum((piece.location for piece in pieces), Vector()) / len(pieces)
    for piece in pieces:
        piece.location += 0.7 * (piece.location - middle)
        piece.select_set(False)
    space.shading.color_type = "OBJECT"
    look(1.6)
    yield 0.7
    pointer.shot("joints.png", MODEL)
    for piece in pieces:
        bpy.data.objects.remove(piece)
    original.hide_set(False)
    original.hide_render = False
    bpy.context.view_layer.objects.active = original
    original.select_set(True)
    space.shading.color_type = before[0]
    look()
    yield 0.5


def boned():
    """Without the graph, which would lie over the bones."""
    yield from pointer.search("Show or Hide Graph")
    yield 0.3
    yield from pointer.search("Make Armature")
    yield 0.6
    pointer.shot("armature.png", MODEL)
    yield from pointer.tap("ctrl+z", "ctrl+z")
    yield 0.4


def exported():
    """The top of the file browser, with what it asks; in the whole window, not in one of its own."""
    bpy.context.preferences.view.filebrowser_display_type = "SCREEN"
    folder = Path(tempfile.gettempdir()) / "Spot"
    folder.mkdir(exist_ok=True)
    yield from pointer.search("Export Parts to Files")
    yield from pointer.until(lambda: pointer.browser() is not None)
    yield 0.5
    pointer.browser().spaces.active.params.directory = os.fsencode(str(folder))
    yield 0.7
    area = pointer.browser()
    left, top = pointer.from_top(pointer.region("WINDOW", area).x, area.y + area.height)
    pointer.shot("export.png", (left, top, 1280, top + 135))
    yield from pointer.tap("Escape")
    yield 0.7
    folder.rmdir()


def folded_out():
    """The panels Output and Overlay, with the sidebar scrolled to its end."""
    ui = pointer.region("UI")
    left, top = pointer.from_top(ui.x, ui.y + ui.height)
    for label in ("Output", "Overlay"):
        yield from pointer.fold(label)
        yield from scroll(5)
        pointer.shot(f"{label.lower()}.png", (left + 9, top + 0.4 * ui.height, left + 0.88 * ui.width, top + ui.height))
        yield from scroll(4)
        yield from pointer.fold(label)


def scroll(button):
    """Turn the wheel over the sidebar, to its end (5) or its beginning (4)."""
    ui = pointer.region("UI")
    yield from pointer.rest(*pointer.from_top(ui.x + 0.04 * ui.width, ui.y + 0.5 * ui.height))
    for _ in range(15):
        pointer.xdo("click", button)
        yield 0.05
    pointer.PLACES.clear()
    yield 0.5


def seamed():
    """The seams, in Edit Mode."""
    yield from pointer.search("Mark Seams")
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.ops.mesh.select_all(action="DESELECT")
    yield 0.6
    pointer.shot("seams.png", (370, 480, 720, 680))
    bpy.ops.object.mode_set(mode="OBJECT")
    yield 0.3


def unwrapped():
    """The islands, in the UV editor."""
    yield from pointer.search("Unwrap along Cuts")
    yield 0.5
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.ops.mesh.select_all(action="SELECT")
    area = pointer.view_area()
    area.ui_type = "UV"
    yield 1.0
    pointer.shot("unwrap.png", (490, 270, 790, 565))
    area.ui_type = "VIEW_3D"
    bpy.ops.object.mode_set(mode="OBJECT")
    yield 1.0
    look()


FACE_SET_BRUSH = os.path.join("brushes", "essentials_brushes-mesh_sculpt.blend", "Brush", "Face Set Paint")


def look(distance=1.0, middle=(0.0, 0.0, 0.0)):
    """From the side, the model left of the sidebar. distance : as a share of that to see all of it."""
    view = pointer.view_area().spaces.active.region_3d
    view.view_rotation = Quaternion((0.75, 0.48, 0.25, 0.38))
    view.view_location = Vector(middle) + view.view_rotation @ Vector((0.1 * distance, 0.0, 0.0))
    view.view_distance = 3.6 * distance


def choose(name):
    spot().data.reeb_parts.active = spot().data.reeb_parts.parts.find(name)

# SPDX-License-Identifier: GPL-3.0-or-later
"""Hands and eyes of the window drivers: the real pointer, the real keyboard, and where things are in the window.

Imported by the drivers beside it, inside Blender. Places are in pixels of the window, from its top left. What
takes time is a generator that yields the seconds to wait while the window lives on: ``yield from`` it.
"""

import os
import subprocess
import time
from pathlib import Path

import bpy
from bpy_extras import view3d_utils
from mathutils import Vector

ROOT = Path(__file__).resolve().parents[2]
OUT = Path(os.environ["GUI_OUT"])
PATIENCE = 60.0  # seconds for a decomposition
TAB = "Reeb Parts"
F2, F3 = 68, 69  # codes of keys; by their names, xdotool holds Alt as well


def draw_quickly():
    """Leave out what takes most of the time where views are drawn in software: smooth edges, and the floor."""
    system = bpy.context.preferences.system
    system.viewport_aa, system.use_overlay_smooth_wire = "OFF", False
    for area in (area for screen in bpy.data.screens for area in screen.areas if area.type == "VIEW_3D"):
        overlay = area.spaces.active.overlay
        overlay.show_floor = overlay.show_axis_x = overlay.show_axis_y = False


if "GUI_QUICK" in os.environ:
    draw_quickly()


# The pointer and the keyboard


def xdo(*words):
    """Real events, by xdotool."""
    subprocess.run(["xdotool", *map(str, words)], check=True)


def rest(x, y):
    """The pointer goes there and stays, too short for a tooltip; a button takes a click only after that."""
    xdo("mousemove", x - 2, y)
    yield 0.05
    xdo("mousemove", x, y)
    yield 0.05


def press(x, y, *held, button=1):
    """A click that a button notices, with keys held down."""
    yield from rest(x, y)
    # Blender asks which keys are down when it comes to the click, not when it was made.
    for key in held:
        xdo("keydown", key)
        yield 0.1
    xdo("click", button)
    for key in held:
        yield 0.1
        xdo("keyup", key)
    yield 0.1


def drag(places, button=1):
    """Press at the first place, go through the others, let go at the last."""
    yield from rest(*places[0])
    xdo("mousedown", button)
    yield 0.1
    for place in places[1:]:
        xdo("mousemove", *place)
        yield 0.05
    xdo("mouseup", button)
    yield 0.1


def tap(*keys):
    """Keys like "ctrl+z", one after the other."""
    for key in keys:
        xdo("key", key)
        yield 0.1


def write(text):
    """Type into the field that is open."""
    xdo("type", "--delay", 4, text)
    yield 0.2


def push(name, beside=None):
    """A click on a button of the sidebar, which find() names."""
    yield from find(name, beside)
    xdo("click", 1)
    yield 0.1


def type_into(name, text):
    """Type over what is in a field of the sidebar, which find() names."""
    place = yield from find(name)
    yield from type_over(*place, text)


def type_over(x, y, text, clicks=2):
    """Open a field by clicks, and type over what is in it."""
    yield from rest(x, y)
    # At once: between them a slow machine would draw the view, and they would be two single clicks.
    xdo("click", "--repeat", clicks, "--delay", 60, 1)
    yield 0.2
    yield from tap("ctrl+a")
    yield from write(text)
    yield from tap("Return")
    yield 0.3


def search(text):
    """F3 over the view, a command's name, Enter."""
    xdo("mousemove", *in_view())
    yield 0.05
    xdo("key", F3)
    yield 0.2
    yield from write(text)
    xdo("key", "Return")
    yield 0.05


def until(condition, patience=5.0):
    """Wait until something has happened, or until patience ends; who asks looks at what there is then."""
    end = time.monotonic() + patience
    while not condition() and time.monotonic() < end:
        yield 0.02


# Pictures


def shot(name, box=None):
    """A picture of the window into the folder for them.

    With a box (left, top, right, bottom) only of that, in few colors: small enough for the documentation.
    """
    crop = []
    if box:
        left, top, right, bottom = (round(edge) for edge in box)
        crop = ["-crop", f"{right - left}x{bottom - top}+{left}+{top}", "+repage", "-dither", "None", "-colors", "128"]
    path = OUT / name
    path.parent.mkdir(parents=True, exist_ok=True)
    subprocess.run(["import", "-window", "root", *crop, str(path)], check=True)


# Places


def view_area():
    """The first 3D viewport."""
    return next(area for area in bpy.context.window.screen.areas if area.type == "VIEW_3D")


def browser():
    """The area that shows files, if there is one."""
    areas = bpy.context.window.screen.areas
    return next((area for area in areas if area.type == "FILE_BROWSER"), None)


def region(kind, area=None):
    return next(region for region in (area or view_area()).regions if region.type == kind)


def in_view(across=0.3, up=0.5):
    """A place in the viewport, by shares of its width and height."""
    area = view_area()
    return from_top(area.x + across * area.width, area.y + up * area.height)


def over(point, window=None):
    """Where a point of the world is seen. window : a region of a viewport."""
    window = window or region("WINDOW")
    x, y = view3d_utils.location_3d_to_region_2d(window, window.data, Vector(point))
    return from_top(window.x + x, window.y + y)


def surface_places(obj, away=14, window=None, step=8):
    """Where each part can be clicked, by its number: the place nearest to the middle of what is seen of it.

    Beside the graph by some pixels, and not under the sidebar. window : a region of four views, or of another
    viewport that has no sidebar. step : pixels between the places that are looked at.
    """
    edge = (80, 120) if window is None else (20, 20)
    sidebar = region("UI").x - 60 if window is None and view_area().spaces.active.show_region_ui else None
    window = window or region("WINDOW")
    right = min(window.width - edge[0], sidebar - window.x if sidebar else window.width)
    graph = [Vector(point) for point in graph_places(obj, window).values()]
    found = {}
    for x in range(edge[0], right, step):
        for y in range(edge[0], window.height - edge[1], step):
            item, _, face = seen_at(window, (x, y))
            if item == obj.name:
                number = obj.data.attributes["reeb_part"].data[face].value
                found.setdefault(number, []).append(Vector(from_top(window.x + x, window.y + y)))
    for number, places in found.items():
        middle = sum(places, Vector((0.0, 0.0))) / len(places)
        beside = [p for p in places if all((p - q).length > away for q in graph)] or places
        found[number] = tuple(map(round, min(beside, key=lambda p: (p - middle).length)))
    return found


def seen_at(window, place):
    """What is seen at a place of a region: name of the object, or None; place in the world; face."""
    start = view3d_utils.region_2d_to_origin_3d(window, window.data, place)
    ahead = view3d_utils.region_2d_to_vector_3d(window, window.data, place)
    depsgraph = bpy.context.evaluated_depsgraph_get()
    hit, location, _, face, item, _ = bpy.context.scene.ray_cast(depsgraph, start, ahead)
    return item.name if hit else None, location, face


def graph_places(obj, window=None):
    """Where the points of an object's graph are seen: by name of the node, or (spline, point) of the arcs."""
    found = {}
    for item in obj.children:
        if item.type == "EMPTY":
            found[item.name] = over(item.matrix_world.translation, window)
        elif item.type == "CURVE":
            for i, spline in enumerate(item.data.splines):
                for j, point in enumerate(spline.points):
                    found[i, j] = over(item.matrix_world @ point.co.to_3d(), window)
    return found


def from_top(x, y):
    """Blender's coordinates of a window count from its bottom."""
    return round(x), round(bpy.context.window.height - y)


def unit():
    """Height of a row of buttons."""
    return 20.0 * bpy.context.preferences.system.ui_scale


# The sidebar, where Blender is asked what is under the pointer


def find(name, beside=None, below=None):
    """Where a button or a field of the sidebar is; the pointer is moved over the sidebar until it rests there.

    name : id of an operator, as "reeb_parts.decompose"; or the end of the path of a property, as "detail" or
    "parts[0].color". Looked for from the top down, in the middle of the sidebar; in the row of another one that
    is ``beside`` it; or straight ``below`` a place.
    """
    place = yield from _known(name)
    if place:
        return place
    ui, reach = region("UI"), int(0.75 * unit())
    if beside is not None:
        _, y = yield from find(beside)
        line = [(x, y) for x in range(ui.x + reach, ui.x + ui.width, reach)]
    else:
        x, top = below or from_top(ui.x + 0.5 * ui.width, ui.y + ui.height - reach)
        line = [(x, y) for y in range(top, top + ui.height, reach)]
    for place in line:
        if (yield from _shows(place, name)):
            return place
    shot("not_found.png")
    raise LookupError(f"{name} is not in the sidebar, see not_found.png")


def _known(name):
    """Where it was seen last, if it is still there: what was opened or closed since may have moved it."""
    for shown in [shown for shown in PLACES if _is(shown, name)]:
        place = PLACES.pop(shown)
        if (yield from _shows(place, name)):
            return place
    return None


PLACES = {}  # of all that was seen, by what under() said


def under():
    """What the pointer is over in the sidebar, or None: a call of an operator, or the path of a property.

    Blender tells it of the button that is highlighted, by its commands that copy it to the clipboard.
    """
    with bpy.context.temp_override(window=bpy.context.window, area=view_area(), region=region("UI")):
        if bpy.ops.ui.copy_python_command_button.poll():
            bpy.ops.ui.copy_python_command_button()
        elif bpy.ops.ui.copy_data_path_button.poll():
            bpy.ops.ui.copy_data_path_button(full_path=True)
        else:
            return None
    return bpy.context.window_manager.clipboard


def _shows(place, name):
    """Go there; whether a button or field is there, once Blender has seen the pointer arrive."""
    xdo("mousemove", *place)
    x, y = place[0], bpy.context.window.height - place[1]
    yield from until(lambda: max(abs(Arrival.at[0] - x), abs(Arrival.at[1] - y)) < 2, 0.5)
    yield 0.02  # a button that is left is highlighted until the next round
    shown = under()
    if shown:
        PLACES[shown] = place
    return _is(shown, name)


def _is(shown, name):
    return shown is not None and (shown.endswith(f".{name}") or f".{name}(" in shown)


class Arrival(bpy.types.Operator):
    """Notes where the pointer is whenever it moves over buttons."""

    bl_idname = "window_test.arrival"
    bl_label = "Arrival"
    bl_options = {"INTERNAL"}
    at = (0, 0)

    def invoke(self, context, event):
        Arrival.at = event.mouse_x, event.mouse_y
        return {"PASS_THROUGH"}


bpy.utils.register_class(Arrival)
_KEYS = bpy.context.window_manager.keyconfigs.addon.keymaps.new("User Interface")
_KEYS.keymap_items.new(Arrival.bl_idname, "MOUSEMOVE", "ANY")


def entry(index, key):
    """Where something of an entry in the list of parts is: its "color", "name", "locked" or "selected"."""
    if key == "name":
        x, y = yield from entry(index, "color")
        return x + round(2 * unit()), y
    place = yield from _known(f"parts[{index}].{key}")
    if not place:
        first = yield from find("parts[0].color", beside="reeb_parts.active")
        _, y = yield from find(f"parts[{index}].color", below=first)
        x, _ = yield from find(f"parts[0].{key}", beside="parts[0].color")
        place = yield from find(f"parts[{index}].{key}", below=(x, y))
    return place


def title(label):
    """Where the title of a sub-panel is; the panels above it on its level are closed.

    Blender tells nothing about titles. In its layout each is a row and a quarter high, and the middle of the first
    is a row below the last thing above them: the button Separate, or, in Advanced, the two lines below the preset.
    """
    inner = label in INNER_TITLES
    x, y = yield from find(below := "preset" if inner else "reeb_parts.separate")
    while (yield from _shows((x, y + 2), below)):
        y += 2
    closed = (INNER_TITLES if inner else TITLES).index(label)
    return x, round(y + ((2.9 if inner else 1.0) + 1.25 * closed) * unit())


def fold(label):
    """Open or close a sub-panel by its title(); where that is. Those in Advanced are open together with it."""
    if label in INNER_TITLES and label not in OPEN:
        yield from press(*(yield from title("Advanced")))
        yield 0.4
    place = yield from title(label)
    ui = region("UI")
    if place[1] > from_top(ui.x, ui.y + 0.5 * unit())[1]:  # below the window
        yield from rest(*from_top(ui.x + 0.04 * ui.width, ui.y + 0.5 * ui.height))
        for _ in range(15):
            xdo("click", 5)
            yield 0.05
        PLACES.clear()
        yield 0.5
        place = yield from title(label)
    yield from press(*place)
    yield 0.4  # panels slide open and shut
    OPEN.symmetric_difference_update({label})
    if label in INNER_TITLES and label not in OPEN:
        yield from press(*(yield from title("Advanced")))
        yield 0.4
    return place


TITLES = ("Use Parts", "Advanced")
INNER_TITLES = ("Field", "Graph", "Boundaries", "Output", "Overlay")
OPEN = set()  # by fold()


def open_tab():
    """Click the tabs of the sidebar from the top down until ours is open; where it is."""
    sidebar = region("UI")
    x, top = from_top(sidebar.x + sidebar.width - 0.6 * unit(), sidebar.y + sidebar.height)
    for y in range(round(top + unit()), top + sidebar.height, round(1.5 * unit())):
        yield from press(x, y)
        if sidebar.active_panel_category == TAB:
            return x, y
    raise LookupError(f"no tab {TAB}")


# What most drivers begin with


def spot_alone(maximised=False, symmetry=False):
    """The bundled model alone in the scene, filling the view, with our tab open.

    Without symmetry tools change what is under the pointer only, and no part has a name with a side.
    """
    bpy.context.scene.reeb_parts.symmetry = symmetry
    for obj in list(bpy.data.objects):
        bpy.data.objects.remove(obj)
    bpy.ops.wm.obj_import(filepath=str(ROOT / "models" / "spot.obj"))
    if maximised:
        with bpy.context.temp_override(area=view_area()):
            bpy.ops.screen.screen_full_area()
        yield 0.5
    view_area().spaces.active.show_region_ui = True
    yield 0.3
    region("UI").active_panel_category = TAB
    with bpy.context.temp_override(area=view_area(), region=region("WINDOW")):
        bpy.ops.view3d.view_selected()
        bpy.ops.ed.undo_push(message="Import")
    yield 0.7

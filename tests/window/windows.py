# SPDX-License-Identifier: GPL-3.0-or-later
"""A window is closed in which something is at work, in Blender's real windows.

Executed inside Blender as driver.py is, which says how.
"""

import importlib
import json
import os
import subprocess
import sys

import bpy

sys.path += [os.path.dirname(__file__), os.path.dirname(os.path.dirname(__file__))]
import pointer
from snapshot import snapshot
from spot import SEEN, at_work, differences, note, spot

PACKAGE = "bl_ext.user_default.reeb_parts"


def steps():
    """One step after the other; yields the seconds to wait."""
    importlib.import_module(f"{PACKAGE}.scene.stepped")._BREATH = 0.001  # or all is over at the first look
    yield from pointer.spot_alone()
    for when in ("computing", "reading", "writing"):
        if when == "reading":
            refine()
        bpy.context.scene.reeb_parts.base_spacing *= 1.01  # nothing of this is known
        bpy.ops.ed.undo_push(message="Ready")
        ready = snapshot()
        yield from closed(f"while {when}", "decompose", whether(when))
        yield from pointer.until(lambda: "reeb_part" in spot().data.attributes and not at_work(), 2 * pointer.PATIENCE)
        note(f"parts, closed while {when}", len(spot().data.reeb_parts.parts))
        note(f"at work after what was closed while {when}", at_work())
        if when == "writing":
            yield from separated()
            bpy.ops.ed.undo()
        bpy.ops.ed.undo()
        note(f"undone, closed while {when}", differences(ready))
        save()
    yield from another_scene()
    save()
    yield from another_workspace()
    save()


def save():
    (pointer.OUT / "seen.json").write_text(json.dumps(SEEN, indent=2))


def refine():
    """So many vertices that reading and writing take a while."""
    with bpy.context.temp_override(window=main(), area=pointer.view_area()):
        bpy.ops.object.mode_set(mode="EDIT")
        bpy.ops.mesh.select_all(action="SELECT")
        bpy.ops.mesh.subdivide(number_cuts=3)
        bpy.ops.object.mode_set(mode="OBJECT")
        bpy.ops.ed.undo_push(message="Subdivide")


def whether(when):
    """A function that tells whether Decompose is at it."""
    def computing():
        current = jobs().current
        return isinstance(current, jobs().Job) and current.pid is not None

    def doing(stage):
        return lambda: getattr(jobs().current, "stage", None) == stage and jobs().current.share > 0.0

    return {"computing": computing, "reading": doing("reading the mesh"), "writing": doing("writing the parts")}[when]


def separated():
    """Separate, too, which Blender does itself."""
    yield 0.5  # the graph is seen
    bpy.ops.ed.undo_push(message="Ready")
    ready = snapshot()
    yield from closed("while separating", "separate", lambda: getattr(jobs().current, "share", 0.0) > 0.0)
    yield from pointer.until(lambda: pieces() and not at_work(), 2 * pointer.PATIENCE)
    note("pieces", [len(pieces()), len(spot().data.reeb_parts.parts)])
    bpy.ops.ed.undo()
    note("undone, closed while separating", differences(ready))


def another_scene():
    """The window that stays shows another scene."""
    yield from opened(bpy.ops.wm.window_new_main)
    main().scene = bpy.data.scenes.new("Other")
    bpy.data.scenes["Scene"].reeb_parts.base_spacing *= 1.01
    yield 0.5
    ready = snapshot()
    yield from closed("beside another scene", "decompose", whether("computing"), new=False)
    yield 1.0
    pointer.shot("another_scene.png")
    note("beside another scene", differences(ready))
    note("computing beside another scene", jobs().current is not None)
    yield from pointer.tap("Escape")
    main().scene = bpy.data.scenes["Scene"]


def another_workspace():
    """The window shows another workspace while it computes, and then the first one again."""
    yield from pointer.rest(*pointer.in_view())
    yield 1.0
    before = status_bar()
    first = main().workspace
    spot().select_set(True)
    bpy.context.scene.reeb_parts.base_spacing *= 1.01
    with bpy.context.temp_override(area=pointer.view_area(), region=pointer.region("WINDOW")):
        bpy.ops.reeb_parts.decompose("INVOKE_DEFAULT", True)
    yield from pointer.until(whether("computing"), pointer.PATIENCE)
    main().workspace = bpy.data.workspaces["UV Editing"]
    yield from pointer.until(lambda: not at_work(), pointer.PATIENCE)
    yield 0.5
    main().workspace = first
    yield 0.5
    yield from pointer.rest(*pointer.in_view())  # Blender may still take it to be at the edge that it crossed there
    yield 1.0
    pointer.shot("another_workspace.png")
    note("status bar after another workspace", status_bar() == before)


def status_bar():
    """The left of it as it is seen."""
    width, height = bpy.context.window.width, bpy.context.window.height
    crop = f"{round(0.3 * width)}x{round(pointer.unit())}+0+{round(height - pointer.unit())}"
    command = ["import", "-window", "root", "-crop", crop, "+repage", "ppm:-"]
    return subprocess.run(command, check=True, capture_output=True).stdout


def opened(new=bpy.ops.wm.window_new):
    """A second window, and time to draw it."""
    with bpy.context.temp_override(window=main()):
        new()
    yield 1.0


def closed(name, operator, when, new=True):
    """Start an operator in a second window, which is closed when something is so."""
    if new:
        yield from opened()
    second = windows()[-1]
    area = next(area for area in second.screen.areas if area.type == "VIEW_3D")
    region = next(region for region in area.regions if region.type == "WINDOW")
    with bpy.context.temp_override(window=second, area=area, region=region):
        getattr(bpy.ops.reeb_parts, operator)("INVOKE_DEFAULT", True)
    yield from pointer.until(when, pointer.PATIENCE)
    note(f"at work {name}", [when(), *(operator.bl_idname for operator in second.modal_operators)])
    with bpy.context.temp_override(window=second):
        bpy.ops.wm.window_close()
    yield from pointer.until(lambda: len(windows()) == 1)
    note(f"windows {name}", len(windows()))


def pieces():
    return [obj for obj in bpy.data.objects if "reeb_parts_number" in obj]


def windows():
    return bpy.context.window_manager.windows[:]


def main():
    return windows()[0]


def jobs():
    return importlib.import_module(f"{PACKAGE}.scene.runs.jobs")

# SPDX-License-Identifier: GPL-3.0-or-later
"""A mesh of a million vertices is decomposed while somebody turns the view, in a real window: how often it is drawn,
and what Esc leaves.

Executed inside Blender as driver.py is, which says how.
"""

import json
import os
import signal
import sys
import time

import bpy
from mathutils import Quaternion

sys.path.append(os.path.dirname(__file__))
import pointer
from spot import mesh

CUTS = 18  # of every edge: 1,060,000 vertices
SECONDS = float(os.environ.get("FLUID_SECONDS", "15"))  # how long it is watched

drawn = []  # when the view was drawn


def steps():
    """One step after the other; yields the seconds to wait."""
    seen = {}
    yield from pointer.spot_alone()
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.ops.mesh.select_all(action="SELECT")
    bpy.ops.mesh.subdivide(number_cuts=CUTS)
    bpy.ops.object.mode_set(mode="OBJECT")
    draw_little()
    yield 2.0
    seen["vertices"] = len(mesh().vertices)
    handle = bpy.types.SpaceView3D.draw_handler_add(lambda: drawn.append(time.monotonic()), (), "WINDOW", "POST_PIXEL")
    yield from turned(6.0)
    seen["idle"] = rates()
    yield from started()
    begin = time.monotonic()
    yield from turned(SECONDS, lambda: job() is not None)
    seen["computing"] = rates()
    seen["watched"] = time.monotonic() - begin
    pointer.shot("1_computing.png")
    if job() is not None:  # it may be over by then if FLUID_SECONDS says so
        seen["stage"], pid = job().stage, job().pid
        seen["files"] = sorted(os.listdir(job()._tasks[0].worker.folder))
        pointer.xdo("mousemove", *pointer.in_view())
        yield 0.1
        begin = time.monotonic()
        pointer.xdo("key", "Escape")
        while job() is not None:
            yield 0.01
        seen["ended after"] = time.monotonic() - begin
        seen["process"] = os.path.exists(f"/proc/{pid}")
        seen["cancelled"] = facts()
    yield from turned(3.0)
    seen["afterwards"] = rates()
    bpy.types.SpaceView3D.draw_handler_remove(handle, "WINDOW")
    yield from started()
    os.kill(job().pid, signal.SIGSEGV)
    yield from pointer.until(lambda: job() is None)
    yield 0.5
    pointer.shot("2_crashed.png")
    seen["crashed"] = facts()
    yield from pointer.tap("Escape")  # the sentence, which lies over the button
    yield from pointer.rest(*pointer.in_view())
    yield from started()
    # Blender quits now.
    seen["last"] = {"pid": job().pid, "folder": str(job()._tasks[0].worker.folder)}
    (pointer.OUT / "seen.json").write_text(json.dumps(seen, indent=2))


def started():
    """Press Decompose, and wait until something is being computed."""
    yield from pointer.push("reeb_parts.decompose")
    yield from pointer.until(lambda: job() is not None and job().stage, pointer.PATIENCE)


def facts():
    """What is left in the file and on the disk."""
    return {
        "folders": [name for name in os.listdir(bpy.app.tempdir) if name.startswith("reeb_parts_")],
        "parts": len(mesh().reeb_parts.parts),
        "attributes": [a.name for a in mesh().attributes if a.name.lower().startswith("reeb")],
        "objects": [obj.name for obj in bpy.data.objects],
    }


def draw_little():
    """Where there is no graphics card, drawing two million faces takes a second, whatever else happens."""
    if "FLUID_ALL" not in os.environ:
        bpy.data.objects["spot"].display_type = "BOUNDS"


def job():
    """What a process of its own is computing, or None."""
    current = sys.modules["bl_ext.user_default.reeb_parts.scene.runs.jobs"].current
    return current if hasattr(current, "pid") else None


def turned(seconds, going=lambda: True):
    """Turn the view a little at every chance, as a drag does; counting begins anew."""
    view = pointer.view_area().spaces.active.region_3d
    drawn.clear()
    end = time.monotonic() + seconds
    while time.monotonic() < end and going():
        view.view_rotation = view.view_rotation @ Quaternion((0.0, 0.0, 1.0), 0.02)
        pointer.region("WINDOW").tag_redraw()
        yield 0.0


def rates():
    """Redraws per second, the longest time between two of them, and that which 95 of 100 do not exceed."""
    gaps = sorted(b - a for a, b in zip(drawn, drawn[1:], strict=False))
    return {"count": len(drawn), "per second": len(gaps) / sum(gaps), "longest": gaps[-1],
            "95 %": gaps[int(0.95 * len(gaps))]}

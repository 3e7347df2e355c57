# SPDX-License-Identifier: GPL-3.0-or-later
"""Hands on the parts, in a real window: cancel, drag Detail, click in the list, slide a boundary, undo.

Executed inside Blender as driver.py is, which says how.
"""

import json
import os
import sys
import time

import bpy

sys.path.append(os.path.dirname(__file__))
import pointer

# Rows below the top of the sidebar.
DECOMPOSE, DETAIL, LIST = 3.7, 7.0, 12.6


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
    (pointer.OUT / "seen.json").write_text(json.dumps(seen, indent=2))


def cancelled(seen):
    """Esc while it computes; fine base vertices make that long enough."""
    bpy.context.scene.reeb_parts.base_spacing = 0.0005
    yield from pointer.press(*pointer.in_sidebar(DECOMPOSE))
    start = time.monotonic()
    pointer.xdo("key", "Escape")
    while bpy.ops.reeb_parts.cancel.poll():
        yield 0.02
    seen["cancelled after"] = time.monotonic() - start
    seen["cancelled"] = facts()
    bpy.context.scene.reeb_parts.base_spacing = 0.005


def decomposed(seen):
    """Decompose with the pointer."""
    yield from pointer.press(*pointer.in_sidebar(DECOMPOSE))
    yield from pointer.until(lambda: "reeb_part" in mesh().attributes, pointer.PATIENCE)
    yield 1.0
    seen["decomposed"] = facts()
    pointer.shot("5_decomposed.png")


def dragged(seen):
    """Drag the Detail slider to the right."""
    x, y = pointer.in_sidebar(DETAIL, 0.6)
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
    yield from pointer.press(*in_list(3))
    yield 0.5
    seen["active"] = mesh().reeb_parts.active
    pointer.shot("7_clicked.png")


def slid(seen):
    """Slide the part's boundary with the mouse, and confirm with a click."""
    x, y = pointer.in_view()
    yield from pointer.rest(x, y)
    with bpy.context.temp_override(area=pointer.view_area(), region=pointer.region("WINDOW")):
        bpy.ops.reeb_parts.slide("INVOKE_DEFAULT")
    for step in range(1, 11):
        pointer.xdo("mousemove", x + 6 * step, y)
        yield 0.05
    yield 0.5
    pointer.xdo("click", 1)
    yield 1.0
    seen["slid"] = facts()
    pointer.shot("8_slid.png")


def in_list(index, across=0.3):
    """A place in an entry of the list."""
    return pointer.in_sidebar(LIST + 1.01 * index, across)


def facts():
    """What the test compares between the steps."""
    result = mesh().reeb_parts
    return {
        "detail": round(result.detail, 4),
        "shares": {part.name: round(part.share, 4) for part in result.parts},
        "groups": sorted(group.name for group in bpy.data.objects["spot"].vertex_groups),
        "attributes": sorted(a.name for a in mesh().attributes),
        "objects": sorted(obj.name for obj in bpy.data.objects),
    }


def mesh():
    """Looked up anew, since undo replaces it."""
    return bpy.data.objects["spot"].data

# SPDX-License-Identifier: GPL-3.0-or-later
"""Detail of a larger mesh, typed and dragged in a real window: one with more than 200,000 corners, whose colors
Blender's own operator converts.

Executed inside Blender as driver.py is, which says how.
"""

import hashlib
import json
import os
import sys

import bpy
import numpy as np

sys.path.append(os.path.dirname(__file__))
import pointer
from spot import mesh


def steps():
    """One step after the other; yields the seconds to wait."""
    seen = {}
    yield from pointer.spot_alone()
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.ops.mesh.select_all(action="SELECT")
    bpy.ops.mesh.subdivide(number_cuts=3)
    bpy.ops.object.mode_set(mode="OBJECT")
    bpy.ops.ed.undo_push(message="Subdivide")
    yield from pointer.push("reeb_parts.decompose")
    shares = []

    def done():
        shares.append(jobs().current.share if jobs().current else None)
        return len(mesh().reeb_parts.parts)

    yield from pointer.until(done, pointer.PATIENCE)
    yield 1.0
    seen["decomposed"] = {**facts(), "shares": shares}
    yield from pointer.type_into("detail", "0.9")
    yield 1.0
    seen["typed"] = facts()
    pointer.shot("1_typed.png")
    for step, keys in (("undone", "ctrl+z"), ("redone", "ctrl+shift+z")):
        pointer.xdo("mousemove", *pointer.in_view())
        yield 0.2
        yield from pointer.tap(keys)
        yield 1.0
        seen[step] = facts()
    x, y = yield from pointer.find("detail")
    yield from pointer.drag([(x - 3 * step, y) for step in range(12)])
    yield 1.0
    seen["dragged"] = facts()
    pointer.xdo("mousemove", *pointer.in_view())
    yield 0.2
    yield from pointer.tap("ctrl+z")
    yield 1.0
    seen["drag undone"] = facts()
    yield from separated(seen)
    (pointer.OUT / "seen.json").write_text(json.dumps(seen))


def separated(seen):
    """Separate ended by Esc, then left to its end, and undone."""
    for name, key in (("ended", "Escape"), ("separated", None)):
        yield from pointer.push("reeb_parts.separate")
        if key:
            pointer.xdo("key", key)
        shares = set()
        while bpy.ops.reeb_parts.cancel.poll():
            shares.add(jobs().current.share)
            if len(shares) == 2:
                pointer.shot(f"2_{name}.png")
            yield 0.01
        yield 0.5
        seen[name] = {**facts(), "shares": sorted(shares), "objects": sorted(bpy.data.objects.keys()),
                      "meshes": sorted(bpy.data.meshes.keys())}
    pointer.shot("3_separated.png")
    pointer.xdo("mousemove", *pointer.in_view())
    yield 0.2
    yield from pointer.tap("ctrl+z")
    yield 1.0
    seen["separation undone"] = {**facts(), "objects": sorted(bpy.data.objects.keys()),
                                 "meshes": sorted(bpy.data.meshes.keys())}


def jobs():
    """The extension's module, wherever it is installed."""
    return next(module for name, module in sys.modules.items() if name.endswith("reeb_parts.scene.runs.jobs"))


def facts():
    """What the test compares between the steps."""
    result, attributes = mesh().reeb_parts, mesh().attributes
    colors = np.empty(4 * len(mesh().loops), np.float32)
    attributes["Reeb Parts"].data.foreach_get("color_srgb", colors)
    numbers = np.empty(len(mesh().polygons), np.int32)
    attributes["reeb_part"].data.foreach_get("value", numbers)
    own = np.zeros((numbers.max() + 1, 3))
    for part in result.parts:
        own[part.number] = part.color
    face = np.repeat(numbers, [polygon.loop_total for polygon in mesh().polygons])
    return {
        "detail": round(result.detail, 3),
        "corners": len(face),
        "parts": len(result.parts),
        "groups": sorted(group.name for group in bpy.data.objects["spot"].vertex_groups),
        "names": sorted(part.group for part in result.parts),
        "wrong color": float(np.abs(colors.reshape(-1, 4)[:, :3] - own[face]).max()),
        "digest": hashlib.sha256(colors.tobytes() + numbers.tobytes()).hexdigest(),
        "attributes": sorted((a.name, a.data_type, a.domain) for a in attributes),
        "active": [attributes.active_color_name, attributes.default_color_name],
    }

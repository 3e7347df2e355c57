# SPDX-License-Identifier: GPL-3.0-or-later
"""Makes saved_by_0_1_0.blend and what was to be seen in it: run with version 0.1.0 switched on, in Blender 4.2.

    blender --background --python tests/data/saved_by_0_1_0.py

A tree in seven parts: one named, one with a colour of its own, one locked, three pinned by a split; the parameters
of scene and result by the names that they had then.
"""

import json
import sys
from pathlib import Path

import bpy
import numpy as np

HERE = Path(__file__).resolve().parent
sys.path.append(str(HERE.parent))

import shapes  # noqa: E402

bpy.ops.wm.read_homefile(use_empty=True)
vertices, faces = shapes.tube_tree()
mesh = bpy.data.meshes.new("Tree")
mesh.from_pydata([tuple(v) for v in vertices], [], [tuple(map(int, f)) for f in faces])
obj = bpy.data.objects.new("Tree", mesh)
bpy.context.scene.collection.objects.link(obj)
bpy.context.view_layer.objects.active = obj
obj.select_set(True)
bpy.context.scene.reeb_parts.levels = 80
bpy.ops.reeb_parts.decompose(levels=80, alpha=0.4, face_sets=True)
result = mesh.reeb_parts
result.parts[1].name = "Arm"
result.parts[2].color = (1.0, 0.5, 0.25)
result.parts[3].locked = True
result.active = 1
bpy.ops.reeb_parts.split()
levels = {}
for detail in (0.2, 0.9, 0.6):
    result.detail = detail
    levels[detail] = [part.number for part in result.parts]
labels = np.empty(len(mesh.polygons), np.int32)
mesh.attributes["reeb_part"].data.foreach_get("value", labels)
seen = {
    "parts": [{"number": part.number, "name": part.name, "color": [round(c, 6) for c in part.color],
               "share": part.share, "locked": part.locked, "pinned": part.pinned, "group": part.group}
              for part in result.parts],
    "labels": labels.tolist(), "detail": round(result.detail, 6), "levels": levels,
    "nodes": [[*(round(x, 5) for x in item.location), item["part"]]
              for item in bpy.data.objects if item.get("reeb_parts_role") == "node"],
}
(HERE / "saved_by_0_1_0.json").write_text(json.dumps(seen))
bpy.ops.wm.save_as_mainfile(filepath=str(HERE / "saved_by_0_1_0.blend"), compress=True)

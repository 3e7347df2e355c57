# SPDX-License-Identifier: GPL-3.0-or-later
"""Makes made_in_4_2.blend: what we make of a model, and one of each setting, marked as made in Blender 4.2.

    .venv/blender-4.2/bin/python tests/data/made_in_4_2.py

The model has pieces that are rigid bodies, hulls, an armature and a graph.
"""

import importlib
import shutil
import sys
import tempfile
from pathlib import Path

import bpy

HERE = Path(__file__).resolve().parent
sys.path.append(str(HERE.parent))

import checkout  # noqa: E402
import one_of_each  # noqa: E402
import shapes  # noqa: E402
from snapshot import activate  # noqa: E402

with tempfile.TemporaryDirectory() as folder:
    package = checkout.enable(Path(folder))
    bpy.ops.wm.read_homefile(use_empty=True)
    made_objects = importlib.import_module(f"{package}.scene.ours.made_objects")
    made_objects.mark(one_of_each.add_one_of_each())
    vertices, faces = shapes.tube_tree(step=0.25)
    mesh = bpy.data.meshes.new("Tree")
    mesh.from_pydata([tuple(v) for v in vertices], [], [tuple(map(int, f)) for f in faces])
    tree = bpy.data.objects.new("Tree", mesh)
    bpy.context.scene.collection.objects.link(tree)
    activate(tree)
    bpy.ops.reeb_parts.decompose()
    bpy.ops.reeb_parts.hulls()
    bpy.ops.reeb_parts.armature()
    bpy.ops.reeb_parts.separate(hide=False, center=False)
    bpy.ops.reeb_parts.rigid_bodies()
    saved = Path(folder) / "made_in_4_2.blend"  # which is in the file, too
    bpy.ops.wm.save_as_mainfile(filepath=str(saved), compress=True)
    shutil.copy(saved, HERE)
checkout.leave(0)

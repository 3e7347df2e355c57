# SPDX-License-Identifier: GPL-3.0-or-later
"""Blender's importers, and what they leave beside a model."""

from __future__ import annotations

from pathlib import Path

import bpy

IMPORTERS = {
    ".obj": lambda path: bpy.ops.wm.obj_import(filepath=path),
    ".ply": lambda path: bpy.ops.wm.ply_import(filepath=path),
    ".stl": lambda path: bpy.ops.wm.stl_import(filepath=path),
    ".glb": lambda path: bpy.ops.import_scene.gltf(filepath=path),
    ".gltf": lambda path: bpy.ops.import_scene.gltf(filepath=path),
    ".fbx": lambda path: bpy.ops.import_scene.fbx(filepath=path),
}
#: Models that can be read besides scenes.
MODELS = tuple(IMPORTERS)
#: Those of them whose lengths are in no unit.
WITHOUT_UNIT = (".obj", ".ply", ".stl")


def import_model(path: Path) -> list[bpy.types.Object]:
    """Import a model into the scene; returns its meshes. Raises what Blender's operators raise, RuntimeError."""
    before = set(bpy.context.scene.objects)
    IMPORTERS[path.suffix.lower()](str(path.resolve()))
    bones = _leave_out_bones()
    return [obj for obj in bpy.context.scene.objects if obj.type == "MESH" and obj not in before and obj not in bones]


def _leave_out_bones() -> set[bpy.types.Object]:
    """Exclude what is no part of a model, but how Blender's importer of glTF shows bones; these objects."""
    layers = [layer for layer in bpy.context.view_layer.layer_collection.children
              if layer.name.startswith("glTF_not_exported")]
    for layer in layers:
        layer.exclude = True
    return {obj for layer in layers for obj in layer.collection.objects}

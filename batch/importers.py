# SPDX-License-Identifier: GPL-3.0-or-later
"""Blender's importers: what they are asked for, and what they leave beside a model."""

from __future__ import annotations

import re
from collections.abc import Iterator
from contextlib import contextmanager
from itertools import takewhile
from pathlib import Path

import bpy
import numpy as np

from ..core.fbx_nodes import is_believable

_USD = dict.fromkeys((".usd", ".usda", ".usdc", ".usdz"), bpy.ops.wm.usd_import)
#: The importer of each kind of model that can be read besides scenes.
IMPORTERS = {
    ".obj": bpy.ops.wm.obj_import, ".ply": bpy.ops.wm.ply_import, ".stl": bpy.ops.wm.stl_import,
    ".glb": bpy.ops.import_scene.gltf, ".gltf": bpy.ops.import_scene.gltf, ".fbx": bpy.ops.import_scene.fbx,
    **_USD, ".abc": bpy.ops.wm.alembic_import,
}
#: Kinds of models whose lengths are in no unit.
WITHOUT_UNIT = (".obj", ".ply", ".stl", ".abc")
_DAMAGED = "it is damaged or cut short"


def import_model(path: Path) -> list[bpy.types.Object]:
    """Import a model into the scene; returns its meshes, also those that nothing but instances shows.

    Raises RuntimeError, as Blender's operators do, and OSError.
    """
    kind, before = path.suffix.lower(), set(bpy.context.scene.objects)
    if kind == ".abc":
        _check_end(path)
    elif kind == ".ply":
        _check_counts(path)
    elif kind == ".fbx" and not is_believable(path):
        raise RuntimeError(_DAMAGED)
    try:
        ended = IMPORTERS[kind](filepath=str(path.resolve()))
    except AttributeError as error:  # the operator is not there: an add-on is off, or Blender was built without
        raise RuntimeError(f"this Blender has no importer of {kind}") from error
    if ended != {"FINISHED"}:  # that of Alembic says why on standard error alone
        raise RuntimeError(f"it is damaged, or no {kind}")
    if kind in _USD:
        bpy.context.scene.frame_set(0)  # the time of which meshes are read; places would be those of frame 1
    bones = _leave_out_bones()
    meshes = [obj for obj in bpy.context.scene.objects if obj.type == "MESH" and obj not in before | bones]
    for obj in meshes:
        _mend_corners(obj.data)
    return meshes


@contextmanager
def all_or_nothing() -> Iterator[None]:
    """Remove what is made inside if something goes wrong there: importers leave what they had of a damaged model."""
    there = {block.session_uid for block in bpy.data.user_map()}
    try:
        yield
    except BaseException:
        # Shape keys go with their meshes.
        bpy.data.batch_remove([block for block in bpy.data.user_map()
                               if block.session_uid not in there and not isinstance(block, bpy.types.Key)])
        raise


def _check_end(path: Path) -> None:
    """Raise RuntimeError if an Alembic file does not reach its end, at which Blender would crash.

    A file in Alembic's own format says where its outermost group is: written last, a number and so many places.
    """
    with path.open("rb") as file:
        head = file.read(16)
        if not head.startswith(b"Ogawa"):
            return
        file.seek(min(int.from_bytes(head[8:], "little"), path.stat().st_size))
        size = file.read(8)
        rest = path.stat().st_size - file.tell()
    if head[5:6] != b"\xff" or len(size) < 8 or rest < 8 * int.from_bytes(size, "little"):
        raise RuntimeError("it is cut short")


def _check_counts(path: Path) -> None:
    """Raise RuntimeError if the head of a .ply has no number of some element, or a larger one than the file has bytes.

    Blender would crash there, or take all memory for them first.
    """
    size = path.stat().st_size
    with path.open("rb") as file:
        for line in takewhile(lambda line: not line.startswith(b"end_header"), file):
            if line.startswith(b"element"):
                count = re.match(rb"\S+\s+\S+\s+([+-]?\d{1,18})(?!\d)", line)
                if count is None or abs(int(count[1])) > size:
                    raise RuntimeError(_DAMAGED)


def _mend_corners(mesh: bpy.types.Mesh) -> None:
    """Drop faces with corners that do not exist, at which Blender would crash; not all its importers do."""
    corner = np.empty(len(mesh.loops), np.int32)
    mesh.loops.foreach_get("vertex_index", corner)
    if (corner.view(np.uint32) >= len(mesh.vertices)).any():
        mesh.validate()


def _leave_out_bones() -> set[bpy.types.Object]:
    """Exclude what is no part of a model, but how Blender's importer of glTF shows bones; these objects."""
    layers = [layer for layer in bpy.context.view_layer.layer_collection.children
              if layer.name.startswith("glTF_not_exported")]
    for layer in layers:
        layer.exclude = True
    return {obj for layer in layers for obj in layer.collection.objects}

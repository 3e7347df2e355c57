# SPDX-License-Identifier: GPL-3.0-or-later
"""Parts as files, by Blender's own exporters."""

from __future__ import annotations

import os
import re
import tempfile
from collections.abc import Iterable
from pathlib import Path

import bpy
from bpy.app.translations import pgettext_rpt as rpt_

from . import part_names, store
from .errors import SceneError
from .part_meshes import part_meshes
from .selection import nothing_selected
from .temporary import removed

EXPORTERS = {
    "obj": lambda path: bpy.ops.wm.obj_export(filepath=path, export_selected_objects=True),
    "ply": lambda path: bpy.ops.wm.ply_export(filepath=path, export_selected_objects=True),
    "stl": lambda path: bpy.ops.wm.stl_export(filepath=path, export_selected_objects=True),
    "glb": lambda path: bpy.ops.export_scene.gltf(filepath=path, use_selection=True, export_format="GLB"),
}


def export_parts(obj: bpy.types.Object, folder: Path, kind: str, numbers: Iterable[int] | None = None,
                 close: bool = False) -> list[Path]:
    """Write each part of an object as a file of its own; the scene stays as it is.

    Parameters
    ----------
    obj : bpy.types.Object
        In Object Mode, with parts.
    folder : Path
        Exists.
    kind : str
        Of EXPORTERS.
    numbers : iterable of int, optional
        Only these parts.
    close : bool
        Close the holes that the cuts leave.

    Returns
    -------
    paths : list of Path

    Raises
    ------
    SceneError
        The parts are out of date, or two parts would get the same file name.
    """
    face_numbers = store.load(obj.data).face_numbers
    numbers = sorted(set(face_numbers.tolist()) if numbers is None else numbers)
    names = [_file_name(f"{obj.name} {part_names.part_name(obj.data, number)}") for number in numbers]
    if len({name.lower() for name in names}) < len(names):
        raise SceneError(
            rpt_("Two parts have the same name; give them different ones to write them as files."))
    meshes, _ = part_meshes(obj.data, face_numbers, numbers, close)
    with removed(bpy.data.meshes, *meshes.values()), nothing_selected(bpy.context.view_layer):
        return [_export(obj, meshes[number], folder / f"{name}.{kind}", kind)
                for number, name in zip(numbers, names, strict=True)]


def _export(obj: bpy.types.Object, mesh: bpy.types.Mesh, path: Path, kind: str) -> Path:
    """Write a mesh in the place of an object as a file, whole or not at all."""
    piece = bpy.data.objects.new(path.stem, mesh)
    with removed(bpy.data.objects, piece):
        bpy.context.scene.collection.objects.link(piece)
        piece.matrix_world = obj.matrix_world
        piece.select_set(True)
        bpy.context.view_layer.objects.active = piece
        with tempfile.TemporaryDirectory(dir=path.parent, prefix=".reeb_parts_") as made:
            EXPORTERS[kind](str(Path(made) / path.name))
            for file in Path(made).iterdir():  # an .obj comes with an .mtl
                os.replace(file, path.parent / file.name)
    return path


def _file_name(text: str) -> str:
    """The text without what a file system might not like."""
    return re.sub(r"[^\w .()+-]", "_", text).strip(" .") or "part"

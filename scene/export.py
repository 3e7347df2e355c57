# SPDX-License-Identifier: GPL-3.0-or-later
"""Parts as files, by Blender's own exporters."""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Iterable
from pathlib import Path

import bpy

from . import complete, part_names, store
from .part_meshes import part_meshes
from .selection import nothing_selected
from .temporary import removed
from .whole_files import WholeFiles

EXPORTERS = {
    "obj": lambda path: bpy.ops.wm.obj_export(filepath=path, export_selected_objects=True),
    "ply": lambda path: bpy.ops.wm.ply_export(filepath=path, export_selected_objects=True),
    "stl": lambda path: bpy.ops.wm.stl_export(filepath=path, export_selected_objects=True),
    "glb": lambda path: bpy.ops.export_scene.gltf(filepath=path, use_selection=True, export_format="GLB"),
}


def export_parts(files: WholeFiles, objects: Iterable[tuple[bpy.types.Object, Iterable[int] | None]], folder: Path,
                 kind: str, close: bool = False) -> list[Path]:
    """Write each part of some objects as a file of its own; the scene stays as it is.

    Parameters
    ----------
    files : WholeFiles
        Puts the files in their places when all is written.
    objects : iterable of (bpy.types.Object, iterable of int or None)
        In Object Mode, with parts; which parts, None for all.
    folder : Path
        Made if it is not there.
    kind : str
        Of EXPORTERS.
    close : bool
        Close the holes that the cuts leave.

    Returns
    -------
    paths : list of Path

    Raises
    ------
    SceneError
        The parts are out of date, or a file cannot be written.
    """
    files.folder(folder)
    names = FileNames()
    paths = []
    for obj, wanted in objects:
        face_numbers = store.load(obj.data).face_numbers
        numbers = sorted(set(face_numbers.tolist()) if wanted is None else wanted)
        meshes, _ = part_meshes(obj.data, face_numbers, numbers, close)
        with removed(bpy.data.meshes, *meshes.values()), nothing_selected(bpy.context.view_layer):
            for number in numbers:
                path = folder / f"{names.free(part_names.piece_name(obj, number))}.{kind}"
                with files.writing(path, complete.model(meshes[number], kind), alone=True) as place:
                    _export(obj, meshes[number], place, kind)
                paths.append(path)
    return paths


def _export(obj: bpy.types.Object, mesh: bpy.types.Mesh, path: Path, kind: str) -> None:
    """Write a mesh in the place of an object as a file."""
    piece = bpy.data.objects.new(path.stem, mesh)
    with removed(bpy.data.objects, piece):
        bpy.context.scene.collection.objects.link(piece)
        piece.matrix_world = obj.matrix_world
        piece.select_set(True)
        bpy.context.view_layer.objects.active = piece
        EXPORTERS[kind](str(path))


class FileNames:
    """Names of files that differ from each other on every file system."""

    def __init__(self) -> None:
        self._taken: set[str] = set()

    def free(self, text: str) -> str:
        """The text without what a file system might not like, and with a number if that is taken already."""
        # Blender cuts its own names at 255 bytes, and a file has a suffix, too.
        plain = re.sub(r"[^\w .()+-]", "_", text).encode()[:200].decode(errors="ignore").strip(" .") or "part"
        name = next(name for name in (plain, *(f"{plain} ({n})" for n in range(2, len(self._taken) + 3)))
                    if unicodedata.normalize("NFKC", name).casefold() not in self._taken)
        self._taken.add(unicodedata.normalize("NFKC", name).casefold())
        return name

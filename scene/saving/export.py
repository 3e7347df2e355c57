# SPDX-License-Identifier: GPL-3.0-or-later
"""Parts as files, by Blender's own exporters; as 3MF by ours."""

from __future__ import annotations

import unicodedata
from collections.abc import Iterable, Iterator
from contextlib import AbstractContextManager, contextmanager, nullcontext
from dataclasses import dataclass
from pathlib import Path

import bpy
import numpy as np
from bpy.app.translations import pgettext_rpt as rpt_
from mathutils import Color

from ...core.file_names import file_name
from ...core.uses.threemf import Assembly, ColoredMesh, write_3mf
from .. import bridge, store, targets
from ..errors import SceneError
from ..pieces import origins, piece_objects
from ..pieces.part_meshes import piece_meshes
from ..reading import mesh_arrays, placing
from ..result import part_names
from ..temporary import removed
from . import file_checks
from .run_files import RunFiles

EXPORTERS = {
    "obj": lambda path: bpy.ops.wm.obj_export(filepath=path, export_selected_objects=True),
    "ply": lambda path: bpy.ops.wm.ply_export(filepath=path, export_selected_objects=True),
    "stl": lambda path: bpy.ops.wm.stl_export(filepath=path, export_selected_objects=True),
    "glb": lambda path: bpy.ops.export_scene.gltf(filepath=path, use_selection=True, use_active_scene=True,
                                                  export_format="GLB"),
}
#: Kinds of files that parts are written as, as items of a property: those of EXPORTERS, and ours. Each has a check in
#: ``file_checks``.
KINDS = (
    ("obj", "OBJ", "Wavefront, with materials"), ("ply", "PLY", "Stanford, with the colors of the mesh"),
    ("stl", "STL", "For 3D printing"), ("glb", "glTF Binary", "With materials and textures"),
    ("3mf", "3MF", "For slicers: all parts of an object as one assembly, with names and colors"),
)
# The color of a dowel.
_PLAIN = (0.8, 0.8, 0.8)


@dataclass(frozen=True)
class ExportStyle:
    """How parts are written to files.

    Attributes
    ----------
    kind : str
        Of KINDS.
    close : bool
        Close the holes that the cuts leave.
    one_file : bool
        All parts of an object in one file, as 3MF always has them.
    separated : bool
        Write the pieces that were separated, with their caps and joints, and their dowels, as they are now; ``close``
        and ``cut`` do not count then.
    cut : str
        Where parts are cut from each other: properties.SeparateProperties.cut.
    """

    kind: str
    close: bool = False
    one_file: bool = False
    separated: bool = False
    cut: str = "FACES"


def export_parts(files: RunFiles, objects: Iterable[tuple[bpy.types.Object, Iterable[int] | None]], folder: Path,
                 style: ExportStyle) -> list[Path]:
    """Write each part of some objects as a file of its own, or each object as one; the scene stays as it is.

    Parameters
    ----------
    files : RunFiles
        Puts the files in their places when all is written.
    objects : iterable of (bpy.types.Object, iterable of int or None)
        In Object Mode, with parts; which parts, None for all.
    folder : Path
        Made if it is not there.
    style : ExportStyle

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
    with _stage() as stage:
        for obj, wanted in objects:
            pieces = _separated(obj, wanted) if style.separated else _parts(obj, wanted, style.close, style.cut)
            by_file = ([(obj.name, pieces)] if style.one_file or style.kind == "3mf"
                       else [(name, {name: piece}) for name, piece in pieces.items()])
            with _removed(pieces):
                for name, of_file in by_file:
                    path = folder / f"{names.free(name)}.{style.kind}"
                    paths.append(_write(files, path, obj, of_file, style.kind, stage))
    return paths


@contextmanager
def _stage() -> Iterator[bpy.types.Scene]:
    """A scene for nothing but what goes into a file: exporters evaluate all that is in the scene, for each file anew.

    It has the time and the units of the one that is open, on which shapes and their keyframes depend.
    """
    scene = bpy.context.scene
    stage = bpy.data.scenes.new(scene.name)
    with _in_a_window(), removed(bpy.data.scenes, stage):
        for name in ("frame_start", "frame_end", "frame_step"):
            setattr(stage, name, getattr(scene, name))
        stage.frame_set(scene.frame_current, subframe=scene.frame_subframe)
        for name in ("fps", "fps_base"):
            setattr(stage.render, name, getattr(scene.render, name))
        for name in ("system", "scale_length"):
            setattr(stage.unit_settings, name, getattr(scene.unit_settings, name))
        yield stage


def _parts(obj: bpy.types.Object, wanted: Iterable[int] | None, close: bool,
           cut: str) -> dict[str, bpy.types.Object]:
    """New objects of parts, all without ``wanted``, by their names."""
    face_numbers = store.load(obj.data).face_numbers
    numbers = sorted(set(face_numbers.tolist()) if wanted is None else wanted)
    stretch = None if cut == "FACES" else bridge.world_stretch(obj)
    meshes = piece_meshes(obj.data, face_numbers, numbers, close, stretch, cut == "PLANAR").meshes
    names = part_names.all_names(obj.data)
    return {name: _stand_in(name, meshes[number], obj) for number in numbers
            for name in [part_names.with_object(obj, names[number], names.values())]}


def _stand_in(name: str, mesh: bpy.types.Mesh, source: bpy.types.Object) -> bpy.types.Object:
    """A new object in no scene, which shows the shape keys of its mesh as another one does."""
    item = bpy.data.objects.new(name, mesh)
    if mesh.shape_keys is not None:
        item.show_only_shape_key = source.show_only_shape_key
        item.active_shape_key_index = source.active_shape_key_index
    return item


@contextmanager
def _removed(pieces: dict[str, bpy.types.Object]) -> Iterator[None]:
    """Remove objects and their meshes once they have been used."""
    meshes = [piece.data for piece in pieces.values()]
    with removed(bpy.data.meshes, *meshes), removed(bpy.data.objects, *pieces.values()):
        yield


def _separated(obj: bpy.types.Object, wanted: Iterable[int] | None) -> dict[str, bpy.types.Object]:
    """Copies of an object's pieces, and of their dowels, by their names, with meshes in its coordinates.

    Of what is being edited, as it is by now. Raises SceneError where one is no mesh any more.
    """
    bpy.context.view_layer.update()  # pieces made just now do not know where they are
    numbers = None if wanted is None else set(wanted)
    pieces, dowels = ([item for item in items if numbers is None or piece_objects.is_of(item, numbers)]
                      for items in (piece_objects.piece_objects(obj), piece_objects.dowels(obj)))
    if not pieces:
        raise SceneError(rpt_("There are no separated parts of {name}. Separate them first.").format(name=obj.name))
    for piece in (*pieces, *dowels):
        if piece.type != "MESH":
            targets.check_object(piece)  # which says what to do
    to_object = placing.world_matrix(obj).inverted_safe()
    copies = {}
    for piece in (*pieces, *dowels):
        piece.update_from_editmode()
        mesh = piece.data.copy()
        placing.move(mesh, to_object @ placing.world_matrix(piece))
        copies[piece.name] = _stand_in(piece.name, mesh, piece)
    return copies


def _write(files: RunFiles, path: Path, obj: bpy.types.Object, pieces: dict[str, bpy.types.Object],
           kind: str, stage: bpy.types.Scene) -> Path:
    """Write pieces, by their names, as one file; returns its path. stage : a scene with nothing in it."""
    with files.writing(path, file_checks.model([piece.data for piece in pieces.values()], kind), alone=True) as place:
        if kind == "3mf":
            write_3mf(place, [Assembly(obj.name, _bodies(obj, pieces))])
        else:
            _export(obj, pieces, place, kind, stage)
    return path


def _bodies(obj: bpy.types.Object, pieces: dict[str, bpy.types.Object]) -> tuple[ColoredMesh, ...]:
    """Pieces in the place of an object as bodies of a 3MF file, in the colors of their parts."""
    world = np.array(placing.world_matrix(obj), np.float64)
    mirrored = np.linalg.det(world[:3, :3]) < 0
    colors = _colors(obj)
    bodies = []
    for name, piece in pieces.items():
        points = placing.transformed(mesh_arrays.shown_points(piece), world)
        triangles = mesh_arrays.triangles(piece.data)[0].astype(np.int64)[:, :: -1 if mirrored else 1]
        bodies.append(ColoredMesh(name, colors.get(name, _PLAIN), points * placing.millimeters(), triangles))
    return tuple(bodies)


def _colors(obj: bpy.types.Object) -> dict[str, tuple[float, ...]]:
    """The color, sRGB, of each part and of each piece of an object, by the name that it has as an object."""
    listed = {part.number: part.color[:] for part in obj.data.reeb_parts.parts}
    names, colors = part_names.all_names(obj.data), {}
    for piece in piece_objects.piece_objects(obj):
        # Parts that are not shown now are not in the list; pieces of them have the color that these had.
        own = Color(piece.color[:3]).from_scene_linear_to_srgb()[:]
        colors[piece.name] = listed.get(piece[origins.NUMBER], own)
    return colors | {part_names.with_object(obj, names[number], names.values()): color
                     for number, color in listed.items()}


def write_assemblies(files: RunFiles, objects: Iterable[bpy.types.Object], path: Path, separated: bool,
                     cut: str) -> None:
    """Write the parts of some objects, closed, as one 3MF file with an assembly for each object.

    separated : bool, whether to write the pieces that were separated instead. cut : str, as for ``export_parts``.

    Raises
    ------
    SceneError
        The parts are out of date, or the file cannot be written.
    """
    assemblies = []
    for obj in objects:
        pieces = _separated(obj, None) if separated else _parts(obj, None, True, cut)
        with _removed(pieces):
            assemblies.append(Assembly(obj.name, _bodies(obj, pieces)))
    with files.writing(path, file_checks.model([], "3mf")) as place:
        write_3mf(place, assemblies)


def _export(obj: bpy.types.Object, pieces: dict[str, bpy.types.Object], path: Path, kind: str,
            stage: bpy.types.Scene) -> None:
    """Write pieces in the place of an object as a file, by way of a scene with nothing in it."""
    layer, world = stage.view_layers[0], placing.world_matrix(obj)
    with _named(pieces):
        for piece in pieces.values():
            stage.collection.objects.link(piece)
            placing.put(piece, world)
            if kind == "ply" and piece.matrix_basis.determinant() < 0:
                # The other exporters turn the faces of what is mirrored by themselves.
                piece.data.flip_normals()
            piece.select_set(True, view_layer=layer)
            layer.objects.active = piece
        try:
            # On one line, so that nothing can be raised before the override ends, see modes.call_with.
            with bpy.context.temp_override(scene=stage, view_layer=layer): EXPORTERS[kind](str(path))  # noqa: E701
        finally:
            for piece in pieces.values():
                stage.collection.objects.unlink(piece)


def _in_a_window() -> AbstractContextManager:
    """A context with a window, without which Blender exports nothing.

    None is at hand in a timer, and while a command runs on the scene that Blender's own command line names.
    """
    if bpy.context.window is not None:
        return nullcontext()
    return bpy.context.temp_override(window=next(iter(bpy.context.window_manager.windows), None))


@contextmanager
def _named(pieces: dict[str, bpy.types.Object]) -> Iterator[None]:
    """Lend pieces their names, which the objects that they were copied from have."""
    changed: list[tuple[bpy.types.Object, str]] = []
    try:
        for name, piece in pieces.items():
            if piece.name != name:
                holder, own = bpy.data.objects.get((name, None)), piece.name  # None: of this file
                if holder is None:  # the name is too long for an object
                    continue
                changed += [(holder, name), (piece, own)]
                holder.name = f"{own} "  # any that is free
                piece.name = name
        yield
    finally:
        for item, name in reversed(changed):
            item.name = name


class FileNames:
    """Names of files that differ from each other on every file system."""

    def __init__(self) -> None:
        self._taken: set[str] = set()

    def free(self, text: str) -> str:
        """The text without what a file system might not like, and with a number if that is taken already."""
        # Blender cuts its own names at 255 bytes, and a file has a suffix, too.
        plain = file_name(text, "part")
        name = next(name for name in (plain, *(f"{plain} ({n})" for n in range(2, len(self._taken) + 3)))
                    if unicodedata.normalize("NFKC", name).casefold() not in self._taken)
        self._taken.add(unicodedata.normalize("NFKC", name).casefold())
        return name

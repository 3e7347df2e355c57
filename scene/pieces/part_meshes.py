# SPDX-License-Identifier: GPL-3.0-or-later
"""Parts as meshes of their own.

They carry what the user's mesh carries, and nothing that Reeb Parts wrote to it but the materials of the parts, if
these were asked for, and what modifiers work by.
"""

from __future__ import annotations

from collections.abc import Callable, Container, Iterable
from dataclasses import dataclass, replace
from functools import partial

import bpy
import numpy as np

from ...core.arrays.indexing import stable_order
from ...core.arrays.int64 import arange
from ...core.arrays.pairs import are_among, distinct_pairs
from ...core.mesh.corners import CornerTable, edge_labels
from ...core.steps import Steps, finished, stretched
from ...core.surface.orientation import against_neighbors
from .. import outputs, property_updates, targets
from ..outputs import kept_aside, materials
from ..reading import element_layers, mesh_arrays, mesh_groups
from ..reading.elements import CORNER, Elements
from ..showing import hidden
from ..temporary import removed
from . import smooth_faces, welding
from .closing import cap_looks, caps
from .closing.cut_holes import Holes
from .named_outputs import KeptAttributes, groups_in_use
from .sculpted_pieces import SculptedMesh, is_sculpted

_CUSTOM = "custom_normal"  # Blender's own
_NORMAL = "reeb_parts_normal"  # corner attribute: the user's normals, while faces are taken apart


def plain_copy(mesh: bpy.types.Mesh) -> bpy.types.Mesh:
    """A copy of a mesh without anything of ours but the parts' materials, and what modifiers work by; Object Mode."""
    copy, stay, attributes = mesh.copy(), _moved_groups(mesh) | groups_in_use(mesh), KeptAttributes(mesh)
    result = copy.reeb_parts
    twin = bpy.data.objects.new(copy.name, copy)
    with removed(bpy.data.objects, twin), property_updates.quiet():
        result.has_materials = False
        for part in result.parts:
            part.material = None
            part.group = "" if part.group in stay else part.group
        outputs.remove_outputs(twin)
        attributes.write(copy)
        copy.property_unset("reeb_parts")
    for key in [key for key in copy.keys() if key.startswith("reeb_parts")]:
        del copy[key]
    is_hidden = any(a.name.startswith(hidden.ATTRIBUTE) for a in copy.attributes)  # then it is we who hid faces
    ours = (kept_aside.PREFIX, hidden.ATTRIBUTE, *([".hide_"] if is_hidden else []))
    for name in [a.name for a in copy.attributes if a.name.startswith(ours)]:
        copy.attributes.remove(copy.attributes[name])
    return copy


def _moved_groups(mesh: bpy.types.Mesh) -> set[str]:
    """The names of our vertex groups by which an armature moves a mesh."""
    bones = outputs.vertex_groups.bones_that_move(targets.users(mesh), ours=True)
    return {part.group for part in mesh.reeb_parts.parts if part.group in bones} | set(mesh_groups.of_weights(mesh))


@dataclass(frozen=True, eq=False)
class PieceMeshes:
    """Meshes of parts.

    Attributes
    ----------
    meshes : dict of int -> bpy.types.Mesh
        By the number of the part. UVs, colors, vertex groups, shape keys, normals and materials are kept.
    left_open : int
        Edges of holes that could not be filled.
    along_faces : int
        Borders that were to be smooth and still run along faces.
    crossing : (k, 2) int64
        Numbers of parts between which caps cross the mesh or themselves.
    n_crossings : int
        How often.
    n_apart : int
        Border vertices of holes to be closed that lie on others and could not be made one with them.
    """

    meshes: dict[int, bpy.types.Mesh]
    left_open: int
    along_faces: int
    crossing: np.ndarray
    n_crossings: int
    n_apart: int = 0


def piece_meshes(mesh: bpy.types.Mesh, face_numbers: np.ndarray, wanted: Iterable[int], close: bool = False,
                 smooth: np.ndarray | None = None, planar: bool = False) -> PieceMeshes:
    """A mesh for each of some parts, with all that its faces carry.

    Parameters
    ----------
    mesh : bpy.types.Mesh
        In Object Mode; stays as it is.
    face_numbers : (p,) int64
        Number of each face's part.
    wanted : iterable of int
        Numbers of the parts; loose edges and vertices belong to none.
    close : bool
        Fill the holes that the cuts leave; for that, border vertices that are one for Decompose are made one, and faces
        are turned so that neighbors agree, and closed pieces look outwards.
    smooth : (3, 3) float64, optional
        What the object does to its mesh, see bridge.world_stretch: faces are divided where smooth cuts run. Without
        it, cuts run along the edges of faces.
    planar : bool
        Smooth cuts lie in planes wherever they can.

    Returns
    -------
    made : PieceMeshes
    """
    made = finished(making_pieces(mesh, face_numbers, wanted, close, smooth, planar))
    for piece in made.meshes.values():
        cap_looks.map_caps(piece)
    return made


def making_pieces(mesh: bpy.types.Mesh, face_numbers: np.ndarray, wanted: Iterable[int], close: bool,
                  smooth: np.ndarray | None, planar: bool) -> Steps[PieceMeshes]:
    """What ``piece_meshes`` does, in steps; caps have no place in UV maps yet, see cap_looks.map_caps."""
    plain = plain_copy(mesh)
    others = [(part.number, part.material) for part in mesh.reeb_parts.parts if part.material is not None]
    wanted = [number for number in wanted if (face_numbers == number).any()]
    with removed(bpy.data.meshes, plain), mesh_groups.one_twin():
        _keep_normals(plain)
        whole, n_apart, sculpted = element_layers.read(plain), 0, is_sculpted(mesh)
        if close:
            whole, n_apart = _welded(whole, np.isin(face_numbers, wanted), sculpted)
            whole = whole if sculpted else _agreeing(whole)
        source = (partial(SculptedMesh, plain, planar) if sculpted
                  else partial(PlainMesh, plain, whole, planar, _moved_groups(mesh) - groups_in_use(mesh)))
        yield 0.1
        made = yield from stretched(_made(source(), face_numbers, wanted, close, smooth, np.empty((0, 2), np.int64)),
                                    0.1, 0.8)
        if smooth is not None and len(made.crossing):
            made = yield from stretched(_with_whole_faces(source, face_numbers, wanted, smooth, made), 0.8, 1.0)
        for number, piece in made.meshes.items():
            materials.drop_slots(piece, [material for other, material in others if other != number])
    return replace(made, n_apart=n_apart)


def _welded(whole: Elements, faces: np.ndarray, sculpted: bool) -> tuple[Elements, int]:
    """The elements with border vertices welded, and how many at some faces, (p,) bool, stay on others.

    What is sculpted is no array, see sculpted_pieces: all of its vertices stay.
    """
    if sculpted:
        twin = welding.border_twins(whole)
        welded, apart = whole, np.flatnonzero(twin != arange(len(twin)))
    else:
        kept = whole.layers.get(_NORMAL) or whole.layers.get(_CUSTOM)
        welded, apart = welding.welded(whole, kept.values if kept and kept.domain == CORNER else None)
    return welded, len(np.intersect1d(apart, whole.corner_vertex[faces[whole.corner_face]]))


def _agreeing(whole: Elements) -> Elements:
    """The elements with faces turned so that neighbors agree: caps and joints go by what is outside."""
    table = whole.corner_table()
    flip = against_neighbors(table)
    return _turned(whole, table, flip) if flip.any() else whole


def _outwards(piece: Elements, whole: Elements, faces: np.ndarray) -> Elements:
    """The elements of a piece, all of its faces turned if it is inside out. faces : (k,) int64, where in the whole."""
    table = piece.corner_table()
    return _turned(piece, table, np.ones(table.n_faces, bool)) if whole.is_inside_out(table, faces) else piece


def _turned(whole: Elements, table: CornerTable, flip: np.ndarray) -> Elements:
    """The elements, whose corners are given, too, with some faces turned, (p,) bool."""
    for name in {_NORMAL, _CUSTOM} & whole.layers.keys():
        layer = whole.layers[name]
        if layer.domain == CORNER:
            # Normals that look to the side of their face go to the other one with it; others show that it was wrong.
            along = table.face_vectors()[table.corner_face] * layer.values
            with_face = np.bincount(table.corner_face, along.sum(axis=1), table.n_faces) > 0
            sign = np.where((flip & with_face)[table.corner_face], -1, 1).astype(np.float32)
            whole = whole.with_layer(name, replace(layer, values=layer.values * sign[:, None]))
    return whole.turned(flip)


def _with_whole_faces(source: Callable[[], PlainMesh | SculptedMesh], face_numbers: np.ndarray, wanted: list[int],
                      smooth: np.ndarray, made: PieceMeshes) -> Steps[PieceMeshes]:
    """The pieces with some borders along faces, if fewer of their caps cross something then; else those given."""
    along = made.crossing
    for start in (0.0, 0.5):
        other = yield from stretched(_made(source(), face_numbers, wanted, True, smooth, along), start, start + 0.5)
        better = other.n_crossings < made.n_crossings
        worse = made if better else other
        bpy.data.batch_remove(list(worse.meshes.values()))
        made = other if better else made
        # Where it does not help to leave faces whole, the smooth cut is the better one.
        helped = along[~are_among(along, other.crossing)]
        if not len(helped) or len(helped) == len(along):
            break
        along = helped
    return made


class PlainMesh:
    """A mesh without anything of ours, of which pieces are made; ``free`` removes what that takes.

    whole : its elements; they are read if not given. few : names of vertex groups that a piece has only where it has
    vertices in them: of thousands of bones each hangs on a few.
    """

    def __init__(self, mesh: bpy.types.Mesh, whole: Elements | None = None, planar: bool = False,
                 few: Container[str] = ()) -> None:
        self._mesh, self._planar = mesh, planar
        self.whole = whole or element_layers.read(mesh)
        self._groups, self._like = mesh_groups.names_of(mesh) if few else None, mesh.copy() if few else mesh
        if few:
            mesh_groups.empty_without(self._like, few)

    def divide(self, face_numbers: np.ndarray, stretch: np.ndarray, along: np.ndarray) -> Steps[tuple[np.ndarray, int]]:
        """Divide faces where smooth cuts run, see smooth_faces.divide_faces.

        Returns the number of each face's part, of the faces that there are now, and how many borders stay along faces.
        """
        self.whole, face_numbers, cuts = yield from smooth_faces.divide_faces(
            self.whole, self._mesh, face_numbers, stretch, along, self._planar)
        return face_numbers, cuts.kept

    def piece(self, faces: np.ndarray, holes: Holes | None) -> tuple[bpy.types.Mesh, int]:
        """A mesh of some faces, (k,) int64, rising, with its holes filled, and how many edges were not."""
        chosen, left = self.whole.selection(faces), 0
        piece = self.whole.taken(chosen)
        if holes is not None:
            piece, left = holes.closed(piece, chosen, self._mesh)
            piece = _outwards(piece, self.whole, faces)
        return element_layers.made(piece, self._like, self._groups), left

    def free(self) -> None:
        """Remove the copy that has no groups of bones."""
        if self._like != self._mesh:
            bpy.data.meshes.remove(self._like)


def _made(source: PlainMesh | SculptedMesh, face_numbers: np.ndarray, wanted: list[int], close: bool,
          smooth: np.ndarray | None, along: np.ndarray) -> Steps[PieceMeshes]:
    """The pieces of a mesh; along : (k, 2), parts whose border stays along faces."""
    along_faces = 0
    try:
        if smooth is not None:
            steps = source.divide(face_numbers, smooth, along)
            face_numbers, along_faces = yield from stretched(steps, 0.0, 0.3)
        yield 0.3
        order = stable_order(face_numbers)
        first = np.searchsorted(face_numbers[order], [[number, number + 1] for number in wanted])
        holes = Holes.of(source.whole, face_numbers) if close else None
        made, left_open = {}, 0
        for number, (start, end) in zip(wanted, first.tolist(), strict=True):
            made[number], left = source.piece(order[start:end], holes)
            left_open += left
            _set_normals(made[number])
            yield 0.3 + 0.7 * end / len(order)
        if holes is None:
            return PieceMeshes(made, left_open, along_faces, np.empty((0, 2), np.int64), 0)
        crossing = _pairs(source.whole, face_numbers, holes.discs.crossing)
        return PieceMeshes(made, left_open, along_faces, crossing, holes.discs.n_crossings)
    finally:
        source.free()


def _pairs(whole: Elements, face_numbers: np.ndarray, curves: list[np.ndarray]) -> np.ndarray:
    """The parts on both sides of some curves, vertices each, the lower number first; (k, 2) int64, each pair once."""
    if not curves:
        return np.empty((0, 2), np.int64)
    low, high = edge_labels(whole.corner_edge, whole.corner_face, face_numbers, len(whole.ends))
    on = np.zeros(len(whole.points), bool)
    for curve in curves:
        on[curve] = True
    here = on[whole.ends].all(axis=1) & (low < high)
    return distinct_pairs(low[here], high[here])[0]


def _keep_normals(mesh: bpy.types.Mesh) -> None:
    """Keep the normal of each corner where the user has set them.

    Blender keeps them relative to the faces around the vertex, of which a cut takes some away.
    """
    if not mesh.has_custom_normals:
        return
    kept = mesh.attributes.get(_CUSTOM)
    if kept is not None and kept.data_type == "FLOAT_VECTOR":
        return  # Blender 4.5 and later can keep them as they are
    normals = mesh_arrays.read(mesh.corner_normals, "vector", np.float32, 3)
    if kept is not None:
        mesh.attributes.remove(kept)
    mesh.attributes.new(_NORMAL, "FLOAT_VECTOR", "CORNER").data.foreach_set("vector", normals.ravel())


def _set_normals(mesh: bpy.types.Mesh) -> None:
    """Set the normals that were kept; corners of caps, which have none, keep those of their faces."""
    kept = mesh.attributes.get(_NORMAL)
    if kept is None:
        return
    normals = mesh_arrays.read(kept.data, "vector", np.float32, 3)
    normals[np.repeat(caps.is_cap(mesh), mesh_arrays.face_sizes(mesh))] = 0
    mesh.attributes.remove(kept)
    mesh.normals_split_custom_set(normals)

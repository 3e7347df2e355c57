# SPDX-License-Identifier: GPL-3.0-or-later
"""Parts as meshes of their own.

They carry what the user's mesh carries, and nothing that Reeb Parts wrote to it but the materials of the parts, if
these were asked for.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING

import bmesh
import bpy
import numpy as np

from ..core.surface.corners import edge_labels
from . import caps, mesh_arrays, outputs, quiet, smooth_faces
from .outputs import kept_aside, materials
from .temporary import freed, removed

if TYPE_CHECKING:
    from .discs import Discs

_NORMAL = "reeb_parts_normal"  # corner attribute: the user's normals, while faces are taken apart


def plain_copy(mesh: bpy.types.Mesh) -> bpy.types.Mesh:
    """A copy of a mesh without anything of ours but the parts' materials; Object Mode."""
    copy = mesh.copy()
    result = copy.reeb_parts
    twin = bpy.data.objects.new(copy.name, copy)
    with removed(bpy.data.objects, twin), quiet.quiet():
        result.has_materials = False
        for part in result.parts:
            part.material = None
        outputs.remove_outputs(twin)
        copy.property_unset("reeb_parts")
    for key in [key for key in copy.keys() if key.startswith("reeb_parts")]:  # noqa: SIM118
        del copy[key]
    for name in [a.name for a in copy.attributes if a.name.startswith(kept_aside.PREFIX)]:
        copy.attributes.remove(copy.attributes[name])
    return copy


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
    """

    meshes: dict[int, bpy.types.Mesh]
    left_open: int
    along_faces: int
    crossing: np.ndarray
    n_crossings: int


def part_meshes(mesh: bpy.types.Mesh, face_numbers: np.ndarray, wanted: Iterable[int],
                close: bool = False) -> tuple[dict[int, bpy.types.Mesh], int]:
    """What ``piece_meshes`` makes along faces: meshes, and edges left open."""
    made = piece_meshes(mesh, face_numbers, wanted, close)
    return made.meshes, made.left_open


def piece_meshes(mesh: bpy.types.Mesh, face_numbers: np.ndarray, wanted: Iterable[int], close: bool = False,
                 smooth: np.ndarray | None = None) -> PieceMeshes:
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
        Fill the holes that the cuts leave.
    smooth : (3, 3) float64, optional
        What the object does to its mesh, see bridge.world_stretch: faces are divided where smooth cuts run. Without
        it, cuts run along the edges of faces.

    Returns
    -------
    made : PieceMeshes
    """
    plain = plain_copy(mesh)
    others = [(part.number, part.material) for part in mesh.reeb_parts.parts if part.material is not None]
    wanted = [number for number in wanted if (face_numbers == number).any()]
    with removed(bpy.data.meshes, plain):
        _keep_normals(plain)
        made = _made(plain, face_numbers, wanted, close, smooth, np.empty((0, 2), np.int64))
        if smooth is not None and len(made.crossing):
            made = _with_whole_faces(plain, face_numbers, wanted, smooth, made)
    for number, piece in made.meshes.items():
        materials.drop_slots(piece, [material for other, material in others if other != number])
    return made


def _with_whole_faces(plain: bpy.types.Mesh, face_numbers: np.ndarray, wanted: list[int], smooth: np.ndarray,
                      made: PieceMeshes) -> PieceMeshes:
    """The pieces with some borders along faces, if fewer of their caps cross something then; else those given."""
    along = made.crossing
    for _ in range(2):
        other = _made(plain, face_numbers, wanted, True, smooth, along)
        better = other.n_crossings < made.n_crossings
        worse = made if better else other
        bpy.data.batch_remove(list(worse.meshes.values()))
        made = other if better else made
        # Where it does not help to leave faces whole, the smooth cut is the better one.
        helped = along[~_rows_in(along, other.crossing)]
        if not len(helped) or len(helped) == len(along):
            break
        along = helped
    return made


def _rows_in(rows: np.ndarray, others: np.ndarray) -> np.ndarray:
    """Whether each row of two numbers is among others, (k,) bool."""
    return (rows[:, None] == others[None]).all(axis=2).any(axis=1)


def _made(mesh: bpy.types.Mesh, face_numbers: np.ndarray, wanted: list[int], close: bool, smooth: np.ndarray | None,
          along: np.ndarray) -> PieceMeshes:
    """The pieces of a mesh without anything of ours; along : (k, 2), parts whose border stays along faces."""
    plain, along_faces = mesh.copy(), 0
    with removed(bpy.data.meshes, plain):
        if smooth is not None:
            face_numbers, cuts = smooth_faces.divide_faces(plain, face_numbers, smooth, along)
            along_faces = cuts.kept
        edge, (vertex, face) = mesh_arrays.corner_edges(plain), mesh_arrays.face_corners(plain)
        cut = mesh_arrays.cut_edges(plain, face_numbers)
        meeting, joined, middles = _around_cuts(plain, cut)
        made, left_open, discs = {}, 0, _discs(plain) if close else None
        for number, piece in _divide(plain, face_numbers, wanted, _has_loose(plain)):
            if discs is not None:
                # Elements keep their order, so that those of the piece are those of its faces, rising.
                corner = (face_numbers == number)[face]
                mine = np.unique(vertex[corner])
                here = np.searchsorted(mine, joined[np.isin(joined, mine).all(axis=1)])
                opened = cut[np.unique(edge[corner])]
                left_open += caps.close_cuts(piece, opened, meeting[mine], here, middles[mine], discs)[1]
            _set_normals(piece)
            made[number] = piece
        crossing = _pairs(plain, face_numbers, discs.crossing) if discs is not None else np.empty((0, 2), np.int64)
    return PieceMeshes(made, left_open, along_faces, crossing, discs.n_crossings if discs is not None else 0)


def _pairs(mesh: bpy.types.Mesh, face_numbers: np.ndarray, curves: list[np.ndarray]) -> np.ndarray:
    """The parts on both sides of some curves, vertices each, the lower number first; (k, 2) int64, each pair once."""
    low, high = edge_labels(mesh_arrays.corner_edges(mesh), mesh_arrays.face_corners(mesh)[1], face_numbers,
                            len(mesh.edges))
    on = np.zeros(len(mesh.vertices), bool)
    for curve in curves:
        on[curve] = True
    here = on[mesh_arrays.edge_ends(mesh)].all(axis=1) & (low < high)
    return np.unique(np.stack([low[here], high[here]], axis=1), axis=0)


def _discs(mesh: bpy.types.Mesh) -> Discs:
    """Surfaces across the cuts of a mesh."""
    from .discs import Discs  # imports SciPy

    return Discs(mesh_arrays.basis_points(mesh).astype(np.float64), mesh_arrays.triangles(mesh)[0])


def _around_cuts(mesh: bpy.types.Mesh, cut: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Vertices where more than two edges of cuts meet, (v,) bool; edges from cut to cut, (k, 2); and middles, (v, 3).

    cut : (e,) bool. A middle is that of all such vertices that cuts connect with a vertex.
    """
    ends = mesh_arrays.edge_ends(mesh)
    count = np.bincount(ends[cut].ravel(), minlength=len(mesh.vertices))
    meeting = count > 2
    middles = mesh_arrays.basis_points(mesh).astype(np.float64)
    if meeting.any():
        from ..core.surface.arrays import components, renumbered, sums_by

        used, place = renumbered(ends[cut])
        n_networks, network = components(len(used), *place.T)
        here = meeting[used]
        total = sums_by(network[here], middles[used[here]], n_networks)
        total /= np.maximum(np.bincount(network[here], minlength=n_networks), 1)[:, None]
        middles[used[here]] = total[network[here]]
    return meeting, ends[(count[ends] > 0).all(axis=1)], middles


def _divide(mesh: bpy.types.Mesh, face_numbers: np.ndarray, wanted: list[int],
            loose: bool) -> Iterator[tuple[int, bpy.types.Mesh]]:
    """Number and mesh of each part, by halves: every face is copied log(number of parts) times."""
    for half in (wanted[: len(wanted) // 2], wanted[len(wanted) // 2 :]):
        if not half:
            continue
        mask = np.isin(face_numbers, half)
        some = _with_faces(mesh, mask, loose)
        if len(half) == 1:
            yield half[0], some
        else:
            yield from _divide(some, face_numbers[mask], half, False)
            bpy.data.meshes.remove(some)


def _with_faces(mesh: bpy.types.Mesh, mask: np.ndarray, loose: bool) -> bpy.types.Mesh:
    """A copy of a mesh with some of its faces only; elements keep their order.

    mask : (p,) bool. loose : whether there are edges and vertices of no face, which are left out.
    """
    copy = mesh.copy()
    with freed(bmesh.new()) as bm:
        bm.from_mesh(copy, face_normals=False, vertex_normals=False)
        bm.faces.ensure_lookup_table()
        bmesh.ops.delete(bm, geom=[bm.faces[i] for i in np.flatnonzero(~mask).tolist()], context="FACES")
        if loose:
            bmesh.ops.delete(bm, geom=[edge for edge in bm.edges if edge.is_wire], context="EDGES")
            bmesh.ops.delete(bm, geom=[v for v in bm.verts if not v.link_faces], context="VERTS")
        bm.to_mesh(copy)
    return copy


def _has_loose(mesh: bpy.types.Mesh) -> bool:
    """Whether there are edges or vertices of no face."""
    vertex, _ = mesh_arrays.face_corners(mesh)
    return any(
        np.bincount(corner, minlength=len(items)).min(initial=1) == 0
        for corner, items in ((mesh_arrays.corner_edges(mesh), mesh.edges), (vertex, mesh.vertices))
    )


def _keep_normals(mesh: bpy.types.Mesh) -> None:
    """Keep the normal of each corner where the user has set them.

    Blender keeps them relative to the faces around the vertex, of which a cut takes some away.
    """
    if not mesh.has_custom_normals:
        return
    kept = mesh.attributes.get("custom_normal")
    if kept is not None and kept.data_type == "FLOAT_VECTOR":
        return  # Blender 4.5 and later can keep them as they are
    normals = mesh_arrays.read(mesh.corner_normals, "vector", np.float32, 3)
    mesh.attributes.new(_NORMAL, "FLOAT_VECTOR", "CORNER").data.foreach_set("vector", normals.ravel())


def _set_normals(mesh: bpy.types.Mesh) -> None:
    """Set the normals that were kept; corners of caps, which have none, keep those of their faces."""
    kept = mesh.attributes.get(_NORMAL)
    if kept is None:
        return
    normals = mesh_arrays.read(kept.data, "vector", np.float32, 3)
    if caps.CAP in mesh.attributes:
        cap = mesh_arrays.read(mesh.attributes[caps.CAP].data, "value", np.int32) == 1
        normals[np.repeat(cap, mesh_arrays.read(mesh.polygons, "loop_total", np.int32))] = 0
    mesh.attributes.remove(kept)
    mesh.normals_split_custom_set(normals)

# SPDX-License-Identifier: GPL-3.0-or-later
"""Parts as meshes of their own.

They carry what the user's mesh carries, and nothing that Reeb Parts wrote to it but the materials of the parts, if
these were asked for.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator

import bmesh
import bpy
import numpy as np

from . import caps, mesh_arrays, outputs, quiet
from .outputs import kept_aside, materials
from .temporary import freed, removed


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


def part_meshes(mesh: bpy.types.Mesh, face_numbers: np.ndarray, wanted: Iterable[int],
                close: bool = False) -> tuple[dict[int, bpy.types.Mesh], int]:
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

    Returns
    -------
    meshes : dict of int -> bpy.types.Mesh
        UVs, colours, vertex groups, shape keys, normals and materials are kept.
    left_open : int
        Edges of holes that could not be filled.
    """
    plain = plain_copy(mesh)
    normals = _custom_normals(plain)
    edge, (vertex, face) = mesh_arrays.corner_edges(plain), mesh_arrays.face_corners(plain)
    cut = mesh_arrays.cut_edges(plain, face_numbers)
    meeting, joined = _around_cuts(plain, cut)
    wanted = [number for number in wanted if (face_numbers == number).any()]
    made, left_open = {}, 0
    for number, piece in _divide(plain, face_numbers, wanted, _has_loose(plain)):
        corner = (face_numbers == number)[face]
        if close:
            # Elements keep their order, so that those of the piece are those of its faces, rising.
            mine = np.unique(vertex[corner])
            here = np.searchsorted(mine, joined[np.isin(joined, mine).all(axis=1)])
            left_open += caps.close_cuts(piece, cut[np.unique(edge[corner])], meeting[mine], here)[1]
        if normals is not None:
            _set_normals(piece, normals[corner])
        others = [part for part in mesh.reeb_parts.parts if part.number != number]
        materials.drop_slots(piece, [part.material for part in others if part.material is not None])
        made[number] = piece
    bpy.data.meshes.remove(plain)
    return made, left_open


def _around_cuts(mesh: bpy.types.Mesh, cut: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Vertices where more than two edges of cuts meet, (v,) bool, and edges from cut to cut, (k, 2).

    cut : (e,) bool.
    """
    ends = mesh_arrays.edge_ends(mesh)
    count = np.bincount(ends[cut].ravel(), minlength=len(mesh.vertices))
    return count > 2, ends[(count[ends] > 0).all(axis=1)]


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


def _custom_normals(mesh: bpy.types.Mesh) -> np.ndarray | None:
    """The normal of each corner, (c, 3) float32, where the user has set them; None otherwise.

    Blender keeps them relative to the faces around the vertex, of which a cut takes some away.
    """
    if not mesh.has_custom_normals:
        return None
    kept = mesh.attributes.get("custom_normal")
    if kept is not None and kept.data_type == "FLOAT_VECTOR":
        return None  # Blender 4.5 and later can keep them as they are
    return mesh_arrays.read(mesh.corner_normals, "vector", np.float32, 3)


def _set_normals(mesh: bpy.types.Mesh, normals: np.ndarray) -> None:
    """Set custom normals; corners of caps, which come last, keep those of their faces."""
    every = np.zeros((len(mesh.loops), 3), np.float32)
    every[: len(normals)] = normals
    mesh.normals_split_custom_set(every)

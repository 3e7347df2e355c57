# SPDX-License-Identifier: GPL-3.0-or-later
"""Closed pieces that are longer than a box cut further, in planes across them, so that each fits into the box."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass

import bmesh
import bpy
import numpy as np
from bmesh.types import BMEdge, BMesh, BMLoop, BMVert
from bpy.app.translations import pgettext_rpt as rpt_
from mathutils.bvhtree import BVHTree
from mathutils.geometry import delaunay_2d_cdt

from ...core.arrays.components import components
from ...core.arrays.vectors import across, box_diagonal
from ..errors import SceneError
from ..reading import mesh_arrays, mesh_groups
from ..reading.matrix_layers import as_bmesh
from ..temporary import freed
from .closing import caps

_SHARED = "reeb_parts_shared"  # face layer, while caps are divided
# So many more pieces at most: a box in other units than the model is a mistake.
_MOST = 200
# A plane that cannot be cut along is moved by such shares of the length of a piece.
_MOVES = (0.0, -0.003, -0.007, -0.013)
# A corner that turns by less than this, in radians, is straight.
_STRAIGHT = 1e-3


@dataclass(frozen=True, eq=False)
class Fitted:
    """Pieces that fit into a box.

    Attributes
    ----------
    meshes : dict of int -> bpy.types.Mesh
        By their keys.
    part : dict of int -> int
        For the key of each piece that is new, that of the piece it comes from.
    left : list of int
        Keys of pieces that do not fit and could not be cut: they are not closed.
    """

    meshes: dict[int, bpy.types.Mesh]
    part: dict[int, int]
    left: list[int]


def fitted(meshes: dict[int, bpy.types.Mesh], stretch: np.ndarray, box: np.ndarray) -> Fitted:
    """Cut pieces until they fit into a box, turned in any way; Object Mode.

    Each is cut across the longest of its axes that is too long, into as few pieces of one length as fit. What falls
    into several bodies then is as many pieces. All attributes, weights and shape keys go on; cuts are closed by caps.

    Parameters
    ----------
    meshes : dict of int -> bpy.types.Mesh
        By their keys. Those that are cut are removed.
    stretch : (3, 3) float64
        What the object does to its mesh, see bridge.world_stretch.
    box : (3,) float64
        In units of the world.

    Returns
    -------
    fitted : Fitted

    Raises
    ------
    SceneError
        There would be too many pieces.
    """
    from ...core.uses.sections import planes_to_fit

    if sum(_least(mesh, stretch, box) for mesh in meshes.values()) > _MOST:
        raise _too_many()
    done: dict[int, bpy.types.Mesh] = {}
    part: dict[int, int] = {}
    left = []
    new = max(meshes, default=0) + 1
    todo = [(key, mesh, np.empty((0, 3, 3))) for key, mesh in sorted(meshes.items())]
    while todo:
        key, mesh, axes = todo.pop(0)
        found = planes_to_fit(*_surface(mesh, stretch), box, axes)
        if found is None:
            done[key] = mesh
            continue
        some, planes = _slices(mesh, stretch.T @ found[0], found[1])
        if len(some) == 1:
            left.append(key)
            done[key] = some[0]
            continue
        if len(part) + len(some) > _MOST:
            raise _too_many()
        _imprint_all((*done.values(), *(waiting for _, waiting, _ in todo)), mesh, planes)
        bpy.data.meshes.remove(mesh)
        keys = [key, *range(new, new + len(some) - 1)]
        part.update(dict.fromkeys(keys[1:], part.get(key, key)))
        new += len(some) - 1
        todo = [*((name, one, found[2][None]) for name, one in zip(keys, some, strict=True)), *todo]
    return Fitted(done, part, left)


def _too_many() -> SceneError:
    return SceneError(rpt_("There would be more than {n} pieces. Is the bed in millimeters?").format(n=_MOST))


def _least(mesh: bpy.types.Mesh, stretch: np.ndarray, box: np.ndarray) -> int:
    """How many pieces a mesh makes at least, if it is closed: none is longer than the box from corner to corner."""
    if (np.bincount(mesh_arrays.corner_edges(mesh), minlength=len(mesh.edges)) != 2).any():
        return 0
    extent = np.ptp(mesh_arrays.basis_points(mesh).astype(np.float64) @ stretch.T, axis=0)
    return math.ceil(extent.max() / np.linalg.norm(box))


def _surface(mesh: bpy.types.Mesh, stretch: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """The corners of the faces of a mesh, along the axes of the object, and the area that each stands for."""
    vertex, face = mesh_arrays.face_corners(mesh)
    total = mesh_arrays.face_sizes(mesh)
    area = mesh_arrays.read(mesh.polygons, "area", np.float32).astype(np.float64) / total
    return mesh_arrays.basis_points(mesh)[vertex].astype(np.float64) @ stretch.T, area[face]


def _slices(mesh: bpy.types.Mesh, normal: np.ndarray,
            levels: np.ndarray) -> tuple[list[bpy.types.Mesh], list[tuple[np.ndarray, float]]]:
    """A closed mesh cut in planes, from below, or the mesh itself where none of them cuts it; and these planes."""
    rest, made, planes = mesh, [], []
    length = float(normal @ normal) ** 0.5
    step = levels[0] - float((mesh_arrays.basis_points(mesh) @ normal).min())
    for level in levels.tolist():
        for move in _MOVES:
            plane = normal / length, (level + move * step) / length
            halves = _halves(rest, *plane)
            if halves is not None:
                if rest is not mesh:
                    bpy.data.meshes.remove(rest)
                made += _bodies(halves[0])
                rest = halves[1]
                planes.append(plane)
                break
    return [*made, *(_bodies(rest) if rest is not mesh else [mesh])], planes


def _imprint_all(others: Iterable[bpy.types.Mesh], mesh: bpy.types.Mesh,
                 planes: list[tuple[np.ndarray, float]]) -> None:
    """Divide the caps that others have in common with a mesh that is cut in planes."""
    triangles, _ = _cap_triangles(mesh)
    if not len(triangles):
        return
    points = mesh_arrays.basis_points(mesh)
    shared = BVHTree.FromPolygons(points.tolist(), triangles.tolist(), all_triangles=True)
    corners = points[triangles].reshape(-1, 3)
    for other in others:
        if _meets(other, corners.min(axis=0), corners.max(axis=0)):
            _imprint(other, shared, planes)


def _meets(mesh: bpy.types.Mesh, low: np.ndarray, high: np.ndarray) -> bool:
    """Whether a mesh comes near to a box, as it must where they share caps; of many pieces, most do not."""
    points = mesh_arrays.basis_points(mesh)
    if not len(points):
        return False
    margin = 1e-5 * box_diagonal(points)  # twice as far as caps that lie on each other
    return bool((points.min(axis=0) <= high + margin).all() and (points.max(axis=0) >= low - margin).all())


def _cap_triangles(mesh: bpy.types.Mesh) -> tuple[np.ndarray, np.ndarray]:
    """The triangles of the caps of a mesh, and their faces."""
    triangles, face = mesh_arrays.triangles(mesh)
    here = caps.is_cap(mesh)[face]
    return triangles[here], face[here]


def _imprint(mesh: bpy.types.Mesh, shared: BVHTree, planes: list[tuple[np.ndarray, float]]) -> None:
    """Divide the caps of a mesh that lie on shared ones as these are, so that they stay alike."""
    triangles, face = _cap_triangles(mesh)
    points = mesh_arrays.basis_points(mesh)
    near = 1e-6 * box_diagonal(points)
    middle = points[triangles].mean(axis=1)
    on = [shared.find_nearest(place, 5 * near)[0] is not None for place in middle.tolist()]
    wanted = np.unique(face[np.array(on, bool)])
    if not len(wanted):
        return
    with as_bmesh(mesh) as bm:
        bm.faces.ensure_lookup_table()
        own = bm.faces.layers.int.new(_SHARED)
        for index in wanted.tolist():
            bm.faces[index][own] = 1
        for normal, level in planes:
            faces = [f for f in bm.faces if f[own]]
            edges, verts = {e for f in faces for e in f.edges}, {v for f in faces for v in f.verts}
            bmesh.ops.bisect_plane(bm, geom=[*verts, *edges, *faces], dist=near, plane_co=normal * level,
                                   plane_no=normal)
        bm.faces.layers.int.remove(own)
        _split_straight(bm)
        mesh_groups.write(bm, mesh)


def _split_straight(bm: BMesh) -> None:
    """Split quads with a straight corner there: drawn as two triangles, one of these might be none.

    Both pieces that have such a face split it alike. Larger faces are split if they are no caps.
    """
    layer = bm.faces.layers.int.get(caps.CAP)
    odd = []
    for face in [face for face in bm.faces if len(face.verts) > 3]:
        straight = [loop for loop in face.loops if _is_straight(loop)]
        if straight and len(face.verts) == 4:
            bmesh.utils.face_split(face, straight[0].vert, straight[0].link_loop_next.link_loop_next.vert)
        elif straight and not (layer is not None and face[layer]):
            odd.append(face)
    if odd:
        bm.normal_update()
        bmesh.ops.triangulate(bm, faces=odd)


def _is_straight(loop: BMLoop) -> bool:
    """Whether a face does not turn at a corner."""
    back, ahead = loop.vert.co - loop.link_loop_prev.vert.co, loop.link_loop_next.vert.co - loop.vert.co
    return back.cross(ahead).length <= _STRAIGHT * back.length * ahead.length


def _halves(mesh: bpy.types.Mesh, normal: np.ndarray, level: float) -> tuple[bpy.types.Mesh, bpy.types.Mesh] | None:
    """What is below a plane and what is above, both closed; None where the plane makes no clean section."""
    near = 1e-6 * box_diagonal(mesh_arrays.basis_points(mesh))
    with as_bmesh(mesh) as bm:
        bmesh.ops.bisect_plane(bm, geom=[*bm.verts, *bm.edges, *bm.faces], dist=near, plane_co=normal * level,
                               plane_no=normal)
        _split_straight(bm)
        for items in (bm.verts, bm.faces):
            items.index_update()
        height = np.array([vertex.co[:] for vertex in bm.verts]) @ normal - level
        height[np.abs(height) <= 2 * near] = 0
        above = np.array([max((height[v.index] for v in face.verts), key=abs) for face in bm.faces])
        section = [edge for edge in bm.edges if _is_section(edge, height, above)]
        cap = _cap([(edge.verts[0], edge.verts[1]) for edge in section], normal) if above.all() else None
        if cap is None:
            return None
        layer = caps.cap_layer(bm)
        material = section[0].link_faces[0].material_index
        return (_half(mesh, bm, above < 0, cap, layer.name, material),
                _half(mesh, bm, above > 0, cap[:, ::-1], layer.name, material))


def _is_section(edge: BMEdge, height: np.ndarray, above: np.ndarray) -> bool:
    """Whether an edge lies in the plane, and its faces on both sides.

    height : (v,) float64, of each vertex. above : (f,) float64, less than 0 for a face below the plane.
    """
    if len(edge.link_faces) != 2 or any(height[vertex.index] for vertex in edge.verts):
        return False
    one, other = edge.link_faces
    return bool(above[one.index] * above[other.index] < 0)


def _cap(edges: list[tuple[BMVert, BMVert]], normal: np.ndarray) -> np.ndarray | None:
    """Triangles that fill a section, by the indices of vertices, looking along the normal; None without a clean one."""
    from ...core.uses.sections import inside_section

    vertices = list({vertex: None for edge in edges for vertex in edge})
    if len(vertices) < 3:
        return None
    place = {vertex: i for i, vertex in enumerate(vertices)}
    u = across(normal)
    flat = np.array([vertex.co[:] for vertex in vertices]) @ np.stack([u, np.cross(normal, u)], axis=1)
    flat = (flat - flat.mean(axis=0)) / max(float(np.ptp(flat, axis=0).max()), 1e-30)
    ends = [(place[a], place[b]) for a, b in edges]
    found, _, faces, origin, _, _ = delaunay_2d_cdt(flat.tolist(), ends, [], 0, 1e-9)
    if len(found) != len(flat) or any(len(source) != 1 for source in origin):
        return None
    name = np.array([source[0] for source in origin])
    chosen = inside_section(flat, np.array(ends), name[np.array(faces, np.int64).reshape(-1, 3)])
    return None if chosen is None else np.array([vertex.index for vertex in vertices])[chosen]


def _half(mesh: bpy.types.Mesh, bm: BMesh, kept: np.ndarray, cap: np.ndarray, layer_name: str,
          material: int) -> bpy.types.Mesh:
    """A mesh of some faces and a cap."""
    made = mesh.copy()
    with freed(bm.copy()) as half:
        half.verts.ensure_lookup_table()
        half.faces.ensure_lookup_table()
        layer = half.faces.layers.int[layer_name]
        vertices = list(half.verts)
        gone = [half.faces[i] for i in np.flatnonzero(~kept).tolist()]
        for triangle in cap.tolist():
            face = half.faces.new([vertices[i] for i in triangle])
            face[layer], face.material_index = 1, material
        bmesh.ops.delete(half, geom=gone, context="FACES")
        half.normal_update()
        mesh_groups.write(half, made)
    return made


def _bodies(mesh: bpy.types.Mesh) -> list[bpy.types.Mesh]:
    """A mesh for each body of a mesh, which is removed; all in one if some of them are hollows in others."""
    table = mesh_arrays.corner_table(mesh)
    pairs, _ = table.face_pairs()
    count, label = components(table.n_faces, *pairs.T)
    triangles, face = mesh_arrays.triangles(mesh)
    a, b, c = (table.vertices - table.vertices.mean(axis=0))[triangles].transpose(1, 0, 2)
    volume = np.bincount(label[face], (a * np.cross(b, c)).sum(axis=1), count)
    if count == 1 or (volume <= 0).any():
        return [mesh]
    made = []
    for index in range(count):
        body = mesh.copy()
        with as_bmesh(body) as bm:
            bm.faces.ensure_lookup_table()
            gone = [bm.faces[i] for i in np.flatnonzero(label != index).tolist()]
            bmesh.ops.delete(bm, geom=gone, context="FACES")
            mesh_groups.write(bm, body)
        made.append(body)
    bpy.data.meshes.remove(mesh)
    return made

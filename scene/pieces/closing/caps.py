# SPDX-License-Identifier: GPL-3.0-or-later
"""Caps: faces that close what a cut has opened."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING

import bmesh
import bpy
import numpy as np
from bmesh.types import BMEdge, BMesh, BMFace, BMLoop, BMVert
from mathutils.geometry import tessellate_polygon

from ....core.arrays.int64 import arange
from ....core.arrays.vectors import box_diagonal
from ....core.uses.caps.surfaces import common_order
from ...reading import mesh_arrays, mesh_groups
from ...reading.matrix_layers import as_bmesh
from .hole_walks import holes_with
from .new_vertices import between, inner_vertices, moved_to

if TYPE_CHECKING:
    from .disc import Disc
    from .discs import Discs

#: Face attribute: 1 on a cap.
CAP = "reeb_cap"

Pairs = dict[BMVert, set[BMVert]]  # what each vertex is paired with
Triple = tuple[int, int, int]  # corners of a triangle, by their place around the hole

# A loop that leaves its plane by less than this share of its size is filled with one face.
_FLAT = 1e-3


def is_cap(mesh: bpy.types.Mesh) -> np.ndarray:
    """Which faces of a mesh are caps, (p,) bool; Object Mode."""
    attribute = mesh.attributes.get(CAP)
    if attribute is None:
        return np.zeros(len(mesh.polygons), bool)
    return mesh_arrays.read(attribute.data, "value", np.int32) == 1


def cap_layer(bm: BMesh) -> bmesh.types.BMLayerItem:
    """The layer that says which faces are caps, a new one if there is none."""
    return bm.faces.layers.int.get(CAP) or bm.faces.layers.int.new(CAP)


def close_cuts(mesh: bpy.types.Mesh, opened: np.ndarray, joined: np.ndarray, ways: dict[int, np.ndarray],
               rings: list[list[np.ndarray]], discs: Discs) -> tuple[int, int]:
    """Fill the holes that a cut has left; borders that were there before stay open.

    A cut that ends on a border makes one hole together with a stretch of it: that is filled as a whole.
    Where several cuts meet, each stretch between two such places is filled by itself, up to the middle of all that
    meet, so that the part on its other side can be filled alike.

    Parameters
    ----------
    mesh : bpy.types.Mesh
        In Object Mode.
    opened : (e,) bool
        Edges that had faces on both sides before the cut.
    joined : (k, 2) int64
        Vertices that an edge joined before the cut, whether it is in this piece or in another.
    ways : dict of int -> (s, 3) float64
        For each vertex where more than two cuts meet points from there to the middle of all that cuts connect with it.
    rings : list of lists of (j,) int64
        Vertices of rims between which one cap lies, the outer one first; all of them are rims of the mesh.
    discs : Discs
        Surfaces across closed curves, the same for both sides of a cut.

    Returns
    -------
    closed, left : int
        Holes that were filled; edges that were not, because there is no telling which faces go on there.
    """
    with as_bmesh(mesh) as bm:
        bm.edges.ensure_lookup_table()
        edges = [edge for i in np.flatnonzero(opened).tolist() if (edge := bm.edges[i]).is_boundary]
        bm.verts.ensure_lookup_table()
        meets = {bm.verts[i]: way for i, way in ways.items()}
        pairs = _both_ways((bm.verts[a], bm.verts[b]) for a, b in joined.tolist())
        holes, left = holes_with(edges)
        if not holes:
            return 0, left
        count, layer = len(holes), cap_layer(bm)
        # By their places in the table of vertices, which does not outlive the first new vertex.
        rims = [[[bm.verts[i] for i in rim.tolist()] for rim in ring] for ring in rings]
        made, holes = _fill_between_rims(bm, holes, rims, discs)
        for hole in holes:
            for sheet in _sheets(bm, hole, meets, set(edges)):
                made += _fill(bm, sheet, _polygons(bm, sheet, pairs, discs))
        for face in made:
            face[layer] = 1
        mesh_groups.write(bm, mesh)
    return count, left


def _both_ways(pairs: Iterable[tuple[BMVert, BMVert]]) -> Pairs:
    """What each is paired with."""
    found: Pairs = {}
    for a, b in pairs:
        found.setdefault(a, set()).add(b)
        found.setdefault(b, set()).add(a)
    return found


def _sheets(bm: BMesh, hole: list[BMVert], meeting: dict[BMVert, np.ndarray],
            opened: set[BMEdge]) -> list[list[BMVert]]:
    """Take a hole apart where cuts meet: a closed walk for each stretch between two such places."""
    at = [i for i, vertex in enumerate(hole) if vertex in meeting]
    if len(at) < 2 or _has_border(hole, opened):
        return [hole]
    # Round the hole from the first place where cuts meet, back to it.
    around = hole[at[0] :] + hole[: at[0] + 1]
    at = [i - at[0] for i in at] + [len(hole)]
    stretches = [around[i : j + 1] for i, j in zip(at, at[1:], strict=False)]
    return _to_the_middle(bm, stretches, [meeting[stretch[0]] for stretch in stretches])


def _has_border(hole: list[BMVert], opened: set[BMEdge]) -> bool:
    """Whether an edge of the hole was a border before the cut: no other piece lies on its other side."""
    return any(_edge(a, b) not in opened for a, b in zip(hole, [*hole[1:], hole[0]], strict=True))


def _to_the_middle(bm: BMesh, stretches: list[list[BMVert]], ways: list[np.ndarray]) -> list[list[BMVert]]:
    """A closed walk for each stretch, by new vertices on the ways from both of its ends to the middle.

    These are the same for all parts that meet. So each stretch is closed alike on both sides, and nothing is left out
    between the parts.
    """
    from .cap_junctions import apart

    starts = [stretch[0] for stretch in stretches]
    n = len(starts)
    made = {ways[0][-1].tobytes(): moved_to(bm, between(bm, starts, np.full(n, 1 / n)), ways[0][-1])}
    spokes = []
    for index, way in enumerate(ways):
        around = starts[index:] + starts[:index]
        for place, share in zip(way, arange(1, len(way) + 1) / len(way), strict=True):
            if place.tobytes() not in made:
                weights = np.full(n, share / n)
                weights[0] += 1 - share
                made[place.tobytes()] = moved_to(bm, between(bm, around, weights), place)
        spokes.append([made[place.tobytes()] for place in way])
    walks = []
    for index, stretch in enumerate(stretches):
        ahead = (index + 1) % n
        onwards, back = apart(ways[ahead], ways[index])
        walks.append([*stretch, *spokes[ahead][: len(onwards)], *reversed(spokes[index][: len(back) - 1])])
    return walks


def _edge(vertex: BMVert, other: BMVert) -> BMEdge:
    return next(edge for edge in vertex.link_edges if edge.other_vert(vertex) == other)


def _fill_between_rims(bm: BMesh, holes: list[list[BMVert]], rings: list[list[list[BMVert]]],
                       discs: Discs) -> tuple[list[BMFace], list[list[BMVert]]]:
    """Fill the holes between rims where one cap does; its faces, and the other holes."""
    made = []
    for rims in rings:
        found = _between_rims(bm, holes, rims, discs)
        if found is not None:
            polygons, used = found
            made += _fill(bm, [vertex for rim in rims for vertex in rim], polygons)
            holes = [hole for index, hole in enumerate(holes) if index not in used]
    return made, holes


def _between_rims(bm: BMesh, holes: list[list[BMVert]], rims: list[list[BMVert]],
                  discs: Discs) -> tuple[list[tuple[BMVert, ...]], set[int]] | None:
    """The corners of the faces between some rims, and which holes they are; None unless each is a hole."""
    place = {vertex: index for index, hole in enumerate(holes) for vertex in hole}
    used = {place.get(vertex, -1) for rim in rims for vertex in rim}
    disc = discs.across(*(np.array([vertex.co[:] for vertex in rim], np.float64) for rim in rims))
    if disc is None or -1 in used or len(used) != len(rims):
        return None
    rim = [vertex for rim in rims for vertex in rim]
    corners = [*rim, *inner_vertices(bm, rim, disc)]
    hole = holes[place[rim[0]]]
    step = 1 if hole[(hole.index(rim[0]) + 1) % len(hole)] == rim[1] else -1
    return _triangles_of(disc, corners, step), used


def _fill(bm: BMesh, hole: list[BMVert], polygons: list[tuple[BMVert, ...]]) -> list[BMFace]:
    """Faces on a hole, or on several of which all vertices are given, with what corners beside them carry."""
    beside = _edge(hole[0], hole[1]).link_loops[0]
    corners = {vertex: _border_corner(vertex, beside) for vertex in hole}
    faces = [bm.faces.new(polygon) for polygon in polygons]
    layers = [*bm.loops.layers.color.values(), *bm.loops.layers.float_color.values()]
    for face in faces:
        face.material_index = beside.face.material_index
        for loop in face.loops:
            for layer in layers:
                loop[layer] = corners.get(loop.vert, beside)[layer]
    return faces


def _polygons(bm: BMesh, hole: list[BMVert], joined: Pairs, discs: Discs) -> list[tuple[BMVert, ...]]:
    """The corners of the faces that fill a hole; never an edge with three faces.

    One face if the hole is flat; else a smooth surface of triangles over its plane. Where the hole as seen from there
    crosses itself, a fan around its middle if that can be seen from all of the rim, else triangles between its corners.
    The other side of the cut is filled alike, so that pieces fit together.
    """
    points = np.array([vertex.co[:] for vertex in hole], np.float64)
    if _is_flat(points) and bm.faces.get(hole) is None and discs.is_free(points[common_order(points)]):
        return [tuple(hole)]
    surface = _surface(bm, hole, points, discs)
    if surface:
        return surface
    triangles = None if _is_star(points) else _triangles(hole, points, joined)
    return triangles or _fan(bm, hole)


def _surface(bm: BMesh, hole: list[BMVert], points: np.ndarray, discs: Discs) -> list[tuple[BMVert, ...]] | None:
    """Triangles of a smooth surface, with new vertices inside; None if there is none over the plane of the hole."""
    order = common_order(points)
    disc = discs.across(points[order])
    if disc is None:
        return None
    rim = [hole[i] for i in order]
    corners = [*rim, *inner_vertices(bm, rim, disc)]
    # The triangles go round as the points do in the common order, which may be against the hole.
    step = -1 if order[1] != (order[0] + 1) % len(order) else 1
    return _triangles_of(disc, corners, step)


def _triangles_of(disc: Disc, corners: list[BMVert], step: int) -> list[tuple[BMVert, ...]]:
    """The corners of each triangle of a surface, forwards, 1, or backwards, -1."""
    return [(corners[i], corners[j], corners[k]) for i, j, k in disc.triangles[:, ::step].tolist()]


def _border_corner(vertex: BMVert, otherwise: BMLoop) -> BMLoop:
    """A corner at the vertex whose face lies on the border."""
    corners = (c for c in vertex.link_loops if c.edge.is_boundary or c.link_loop_prev.edge.is_boundary)
    return next(corners, otherwise)


def _middle(points: np.ndarray) -> np.ndarray:
    """Shares of the points in their middle: short edges count less, so that dense stretches do not draw it."""
    length = np.linalg.norm(points - np.roll(points, 1, axis=0), axis=1)
    weight = length + np.roll(length, -1)
    return weight / weight.sum() if weight.any() else np.full(len(points), 1 / len(points))


def _spokes(points: np.ndarray) -> np.ndarray:
    """Normals of the triangles of a fan, twice their area long, (n, 3)."""
    out = points - _middle(points) @ points
    return np.cross(out, np.roll(out, -1, axis=0))


def _is_flat(points: np.ndarray) -> bool:
    normal = _spokes(points).sum(axis=0)
    height = (points - points[0]) @ normal
    return np.ptp(height) <= _FLAT * np.linalg.norm(normal) * box_diagonal(points)


def _is_star(points: np.ndarray) -> bool:
    spokes = _spokes(points)
    return bool((spokes @ spokes.sum(axis=0) > 0).all())


def _triangles(hole: list[BMVert], points: np.ndarray, joined: Pairs) -> list[tuple[BMVert, ...]] | None:
    """Triangles between the corners of a hole, or None if some edge would meet a third face on either side."""
    n = len(hole)
    order = common_order(points)
    triples = [tuple(order[i] for i in t) for t in tessellate_polygon([[hole[i].co for i in order]])]
    rim = {(i, (i + 1) % n) for i in range(n)}
    if any((b, a) in rim for triple in triples for a, b in _edges_of(triple)):
        triples = [triple[::-1] for triple in triples]
    inner = _inner_edges(triples, rim)
    if n == 3 or inner is None or _is_joined(hole, inner, joined):
        return None
    return [tuple(hole[i] for i in triple) for triple in triples]


def _edges_of(triple: Triple) -> tuple[tuple[int, int], ...]:
    a, b, c = triple
    return (a, b), (b, c), (c, a)


def _inner_edges(triples: list[Triple], rim: set[tuple[int, int]]) -> set[tuple[int, int]] | None:
    """The edges between triangles, in both directions; None unless the triangles are one sheet that fills the rim."""
    directed = {edge for triple in triples for edge in _edges_of(triple)}
    inner = directed - rim
    is_sheet = (
        len(directed) == 3 * len(triples) == 3 * (len(rim) - 2)
        and rim <= directed
        and all((b, a) in inner for a, b in inner)
    )
    return inner if is_sheet else None


def _is_joined(hole: list[BMVert], inner: set[tuple[int, int]], joined: Pairs) -> bool:
    """Whether an edge joins two of these pairs of corners already, in this piece or in another."""
    near = [{edge.other_vert(v) for edge in v.link_edges} | joined.get(v, set()) for v in hole]
    return any(hole[b] in near[a] for a, b in inner)


def _fan(bm: BMesh, hole: list[BMVert]) -> list[tuple[BMVert, ...]]:
    """Triangles to a new vertex in the middle of a hole."""
    share = _middle(np.array([vertex.co[:] for vertex in hole], np.float64))
    middle = between(bm, hole, share)
    return [(a, b, middle) for a, b in zip(hole, [*hole[1:], hole[0]], strict=True)]

# SPDX-License-Identifier: GPL-3.0-or-later
"""Borders that run along each other and do not meet: T-junctions, where a fine surface goes on coarsely, and gaps.

Modelers, reducers of faces and makers of tiles leave them: what looks like one surface is open there, and neither paths
nor cuts would find over.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..arrays.indexing import begins_run, place_among, renumbered, stable_order, sums_by, taken
from ..arrays.int64 import arange
from ..arrays.pairs import are_among, distinct_pairs, edge_keys
from ..arrays.ties import rounded
from ..arrays.vectors import distances_between, lengths, row_products, unit
from ..mesh.borders import GAP, SAME_SIDE, joined_nearby
from ..mesh.triangles import TriMesh, next_side

# What is still at a border is one with what is within WIDE of the diagonal, if that is no more than OF_EDGE of the
# shortest edge there: patches that never met, as of curved surfaces, and of scans put together.
WIDE, OF_EDGE = 6e-4, 0.2
MOST_ENDS = 8  # at a vertex each border edge is compared with so many that are longer
MOST_ROUNDS = 1_000  # an edge is split once in each


@dataclass(frozen=True, eq=False)
class Stitched:
    """A mesh whose borders meet, vertex by vertex, where they run along each other.

    Attributes
    ----------
    mesh : TriMesh
        m' faces, and the n vertices given, of which some have no face any more, and others were moved into a gap.
    parent : (m',) int64
        Face given in which each face lies, rising.
    joined : (n,) int64
        The vertex that each of those given was joined to, itself for most.
    pairs : (k, 2) int64
        Faces given that share an edge here and none there, the lower one first.
    """

    mesh: TriMesh
    parent: np.ndarray
    joined: np.ndarray
    pairs: np.ndarray


def stitched(mesh: TriMesh) -> Stitched:
    """Join borders that run along each other: first those that do so exactly, then those with a narrow gap between.

    Where the edges of one are longer, they are split where vertices of the other lie on them. Closed surfaces that
    touch stay apart.

    Parameters
    ----------
    mesh : TriMesh
        m faces, border vertices at one place joined.

    Returns
    -------
    stitched : Stitched
        A split face has its corners in the order they had.
    """
    joined = arange(mesh.n_vertices)
    nothing = Stitched(mesh, arange(mesh.n_faces), joined, np.empty((0, 2), np.int64))
    if (mesh.edges.n_faces != 1).all():
        return nothing
    size = mesh.diagonal
    result, parent = _split_at_ends(mesh, size, wide=False)
    joined = _across_gaps(result, size)
    if (joined != arange(mesh.n_vertices)).any():
        result = TriMesh(_midway(mesh.vertices, joined), joined[result.faces])
    result, step = _split_at_ends(result, size, wide=True)
    parent = parent[step]
    if result is mesh:
        return nothing
    pairs = np.sort(parent[result.edges.pairs], axis=1)
    known = are_among(pairs, np.sort(mesh.edges.pairs, axis=1)) | (pairs[:, 0] == pairs[:, 1])
    return Stitched(result, parent, joined, distinct_pairs(*pairs[~known].T)[0])


def _reach(size: float, length: np.ndarray) -> np.ndarray:
    """How far from border edges another border is one with them, (k,) float64.

    size : diagonal of the mesh. length : (k,) float64, of the edges.
    """
    return np.maximum(GAP * size, np.minimum(WIDE * size, OF_EDGE * length))


def _across_gaps(mesh: TriMesh, size: float) -> np.ndarray:
    """The vertex that each vertex is joined to, (n,) int64, where border vertices are within reach of each other.

    Edges within the surface count, too: both borders of a blade of grass are near each other, and so is its spine.
    """
    at_border = np.zeros(mesh.n_vertices, bool)
    at_border[mesh.edges.vertices[mesh.edges.n_faces == 1]] = True
    near = np.flatnonzero(at_border[mesh.edges.vertices].any(axis=1))
    shortest = np.full(mesh.n_vertices, np.inf)
    np.minimum.at(shortest, mesh.edges.vertices[near], mesh.edge_length[near][:, None])
    place = np.flatnonzero(at_border)
    # Sheets that lie on each other have their borders near each other, too, but are on the same side of these.
    face = np.flatnonzero(at_border[mesh.faces].any(axis=1))
    corner = mesh.faces[face]
    way = unit((mesh.face_centroids[face, None] - mesh.vertices[corner]).reshape(-1, 3))
    inward = unit(sums_by(corner.ravel(), way, mesh.n_vertices)[place])
    return joined_nearby(mesh.vertices, place, _reach(size, shortest[place]), mesh.faces.ravel(),
                         np.repeat(arange(mesh.n_faces), 3), inward)


def _midway(points: np.ndarray, joined: np.ndarray) -> np.ndarray:
    """The places of vertices, (n, 3) float64, those that others were joined to midway between them.

    At the place of one of them a mesh with a gap on its plane of symmetry would be symmetric no more.
    """
    count = np.bincount(joined, minlength=len(points))
    several = count > 1
    middle = points.copy()
    middle[several] = sums_by(joined, points, len(points))[several] / count[several, None]
    return middle


def _split_at_ends(mesh: TriMesh, size: float, wide: bool) -> tuple[TriMesh, np.ndarray]:
    """Split border edges where another border runs along them, so that both have the same edges there.

    From each vertex that two borders share, edges that go the same way are followed: the longer one is split where
    the shorter ends, if that is within GAP of it, or reach where ``wide``, and so on. size : diagonal of the mesh.
    Returns the mesh and the face given in which each face lies, (m',) int64, rising.
    """
    side = np.flatnonzero(taken(mesh.edges.n_faces, mesh.edges.face_edges.ravel()) == 1)
    at_border = np.zeros(mesh.n_faces, bool)
    at_border[side // 3] = True
    faces, parent = mesh.faces[at_border], np.flatnonzero(at_border)
    side = 3 * place_among(parent, mesh.n_faces)[side // 3] + side % 3
    awake = np.ones(mesh.n_vertices, bool)
    for _ in range(MOST_ROUNDS):
        split, vertex = _on_sides(mesh.vertices, faces, side, awake, size, wide)
        if not len(split):
            break
        faces, side = _split(faces, side, split, vertex)
        parent = np.concatenate([parent, parent[split // 3]])
        awake[:] = False
        awake[faces[split // 3]] = awake[faces[-len(split):]] = True
    if len(faces) == at_border.sum():
        return mesh, arange(mesh.n_faces)
    # In an order that does not hang on that of the splits.
    order = np.lexsort(np.sort(faces, axis=1).T[::-1])
    faces, parent = faces[order], np.concatenate([np.flatnonzero(~at_border), parent[order]])
    order = stable_order(parent)
    return TriMesh(mesh.vertices, np.concatenate([mesh.faces[~at_border], faces])[order]), parent[order]


@dataclass(frozen=True, eq=False)
class _Ends:
    """Ends of border sides: where each begins and ends, its length, its side, and the vertex across; (k,) each.

    A side is 3 times the face + 0..2; each is there twice, from both of its vertices, sorted by these and by length.
    """

    at: np.ndarray
    to: np.ndarray
    length: np.ndarray
    side: np.ndarray
    apex: np.ndarray

    @classmethod
    def of(cls, points: np.ndarray, corner: np.ndarray, side: np.ndarray) -> _Ends:
        """Of sides, (b,) int64. points : (n, 3) float64. corner : (3f,) int64, the vertex at each corner."""
        begin, end = corner[side], corner[next_side(side)]
        at, to = np.concatenate([begin, end]), np.concatenate([end, begin])
        length = distances_between(points, at, to)
        order = np.lexsort((length, at))
        side = np.tile(side, 2)[order]
        return cls(at[order], to[order], length[order], side, corner[next_side(next_side(side))])

    def lie_on(self, points: np.ndarray, short: np.ndarray, long: np.ndarray, size: float, wide: bool) -> np.ndarray:
        """Whether some sides, (q,) int64, end on others that begin where they do, (q,) bool. size, wide : as above."""
        gap, length = GAP * size, self.length
        start = points[self.at[short]]
        way, along = points[self.to[short]] - start, points[self.to[long]] - start
        along = along / np.maximum(length[long], gap)[:, None]
        ahead = row_products(way, along)
        off = lengths(way - ahead[:, None] * along)
        # A place within GAP of an end of a side is that end.
        lies = (ahead > 0) & (length[short] > gap) & (length[long] - ahead > gap) & (self.apex[long] != self.to[short])
        if not wide:
            return lies & (off <= gap)
        # The faces of both are to be on either side of the edge: those on both borders of a blade of grass are not.
        across = [points[self.apex[which]] - start for which in (short, long)]
        one, other = (way - row_products(way, along)[:, None] * along for way in across)
        return (lies & (off <= _reach(size, length[short]))
                & (row_products(one, other) < SAME_SIDE * lengths(one) * lengths(other)))


def _on_sides(
    points: np.ndarray, faces: np.ndarray, side: np.ndarray, awake: np.ndarray, size: float, wide: bool
) -> tuple[np.ndarray, np.ndarray]:
    """Border sides on which others end that begin where they do: of each face the longest.

    points : (n, 3) float64. faces : (f, 3) int64. side : (b,) int64, all sides at borders, 3 times the face + 0..2.
    awake : (n,) bool, vertices where sides begin that are looked at. size, wide : as above.

    Returns such sides and the vertices at which others end on them, (k,) int64 each.
    """
    corner = faces.ravel()
    ends = _Ends.of(points, corner, side[awake[corner[side]] | awake[corner[next_side(side)]]])
    found = [np.empty((0, 2), np.int64)]
    for step in range(1, min(MOST_ENDS, len(ends.at))):
        short = np.flatnonzero(ends.at[step:] == ends.at[:-step])
        lies = ends.lie_on(points, short, short + step, size, wide)
        found.append(np.stack([short[lies], short[lies] + step], axis=1))
    short, long = np.concatenate(found).T
    # Where two sides are equally long, the vertices across from them decide, not rounding.
    face = ends.side[long] // 3
    first = np.lexsort((ends.length[short], ends.apex[long], -rounded(ends.length[long]), face))
    first = first[begins_run(face[first])]
    return ends.side[long[first]], ends.to[short[first]]


def _split(
    faces: np.ndarray, side: np.ndarray, split: np.ndarray, vertex: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Split sides, (k,) int64, of k faces at vertices, (k,) int64: the faces, and those of their sides at borders.

    The half of a face at the beginning of its side keeps its number, the others come last.
    """
    following, last = next_side(split), next_side(next_side(split))
    added = np.stack([vertex, faces.ravel()[following], faces.ravel()[last]], axis=1)
    first_added = 3 * (len(faces) + arange(len(split)))
    corner = faces.ravel().copy()
    corner[following] = vertex
    corner = np.concatenate([corner, added.ravel()])
    # What was the following side is one of the new face, and the one that keeps its number lies between the two.
    moved = np.isin(following, side)
    side = np.concatenate([side[~np.isin(side, following)], first_added, first_added[moved] + 1])
    _, edge = renumbered(edge_keys(corner[side], corner[next_side(side)], count=int(corner.max()) + 1))
    return corner.reshape(-1, 3), side[np.bincount(edge)[edge] == 1]

# SPDX-License-Identifier: GPL-3.0-or-later
"""The working copy: the caller's surface, repaired and refined so that a field can be computed on it.

The caller's arrays are never changed. [Berretti2009] triangulates and regularizes the surface first (section 3), and so
does this module. ``polygon`` and ``vertex_source`` say to which of the caller's faces and vertices those of the copy
belong, so that labels found on the copy can be brought back.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from ..arrays.components import components
from ..arrays.indexing import frozen, inverse, place_among, renumbered, stable_order, taken
from ..arrays.int64 import arange, cumsum, full
from ..arrays.pairs import distinct_pairs, pair_keys
from ..arrays.ties import TIE
from ..arrays.vectors import distances_between
from ..mesh.borders import border_note, joined_borders
from ..mesh.polygons import MIN_FACES, PolygonMesh
from ..mesh.triangles import TriMesh, next_side
from ..sentence import Sentence
from .contact import Bridges, bridges
from .ordering import Ordering
from .orientation import turn_outwards
from .stitching import stitched

# Longest edge of the copy, in units of the square root of the component's area: half the radius of the disc that a base
# vertex stands for, so that the field can vary within every disc.
MAX_EDGE = 0.5 * np.sqrt(0.005)
# Refinement stops when it has multiplied the number of faces by this factor: needles (long, thin triangles) become
# too many, and a coarser copy is better.
MAX_GROWTH = 4
MIN_BUDGET = 25_000  # number of faces up to which it never stops early; several bodies share them
# A body of few faces takes as long as hundreds of faces of a large one. So of very many bodies only those of more faces
# are decomposed: this number of bodies, and one more for so many faces of the whole.
MANY_BODIES, FACES_PER_BODY = 20, 300
MOST_AROUND = 32  # number of faces around a vertex that are walked along; of more, all are looked at together


@dataclass(frozen=True, eq=False)
class WorkingMesh:
    """A repaired triangle copy of the caller's mesh.

    Attributes
    ----------
    mesh : TriMesh
        Every vertex has a face, no face has a repeated vertex, no two fans of faces touch in a vertex only, and
        neighbors are turned the same way where that is possible. m faces and n vertices.
    polygon : (m,) int64
        The caller's face in which each triangle lies.
    vertex_source : (n,) int64
        The caller's vertex at each vertex.
    joined : (v,) int64
        The vertex that each of the caller's v vertices was joined to, itself for most.
    stitches : (k, 2) int64
        The caller's faces that share an edge here and none there: see ``stitched``.
    notes : tuple of Sentence
        What is odd about the caller's mesh and what was repaired, one sentence each.
    vertex_rank : (n,) int64, optional
        Place of each vertex in the caller's order, if this is another.
    """

    mesh: TriMesh
    polygon: np.ndarray
    vertex_source: np.ndarray
    joined: np.ndarray
    stitches: np.ndarray
    notes: tuple[Sentence, ...] = ()
    vertex_rank: np.ndarray | None = None

    @cached_property
    def polygon_piece(self) -> np.ndarray:
        """(p,) int64, the connected piece of the mesh in which each of the caller's faces lies; -1 for none."""
        piece = full(int(self.polygon.max()) + 1, -1)
        piece[self.polygon] = self.mesh.face_components[1]
        return piece


@dataclass(frozen=True, eq=False)
class Component:
    """One connected component of the working mesh, its long edges split.

    Attributes
    ----------
    faces : (k,) int64
        Faces of the working mesh that form the component, in the order of its own mesh before edges were split.
    mesh : TriMesh
        The component with its long edges split: m faces and n vertices.
    polygon : (m,) int64
        The caller's face in which each triangle lies.
    vertex_source : (n,) int64
        The caller's vertex at each vertex; -1 for a vertex that splitting added.
    bridges : Bridges
        Between its pieces.
    """

    faces: np.ndarray
    mesh: TriMesh
    polygon: np.ndarray
    vertex_source: np.ndarray
    bridges: Bridges

    @classmethod
    def of(cls, working: WorkingMesh, faces: np.ndarray, connected: bool = True, n_bodies: int = 1) -> Component:
        """Cut some pieces out of the working mesh, split their long edges and link the pieces.

        Parameters
        ----------
        working : WorkingMesh
        faces : (k,) int64
            All faces of these pieces, rising.
        connected : bool
            Whether all pieces are to hang together; see ``bridges``.
        n_bodies : int
            Among how many bodies the mesh is divided, which share the faces that splitting may add.

        Returns
        -------
        component : Component
        """
        mesh, source = working.mesh, working.vertex_source
        if len(faces) < mesh.n_faces:
            # Sorted by places of its own, so that it is what it would be without the others.
            part, index = mesh.submesh(faces)
            names, polygon = renumbered(working.polygon[faces])
            rank = working.vertex_source if working.vertex_rank is None else working.vertex_rank
            ordering = Ordering.of(part, polygon, len(names), rank[index])
            mesh, triangle = ordering.sorted(part, polygon)
            source, faces = source[index][ordering.vertex], faces[triangle]
        fine, parent = split_long_edges(mesh, MAX_EDGE * np.sqrt(mesh.area), MIN_BUDGET // n_bodies)
        added = full(fine.n_vertices - len(source), -1)
        return cls(faces, fine, working.polygon[faces][parent], np.concatenate([source, added]),
                   bridges(fine, connected, len(faces)))


@dataclass(frozen=True, eq=False)
class Bodies:
    """The bodies of a working mesh: pieces that touch, or nearly so.

    Attributes
    ----------
    decomposed : list of Component
        Those that are large enough to have parts.
    contacts : (k, 2) int64
        Of the caller's faces, where two pieces of another body come near each other: one place for each such two.
    """

    decomposed: list[Component]
    contacts: np.ndarray


def bodies(working: WorkingMesh, together: bool, loose_part: float) -> Bodies:
    """Cut the working mesh into what is decomposed as one: bodies of pieces that touch, or single pieces.

    Parameters
    ----------
    working : WorkingMesh
    together : bool
        Whether pieces that touch, or nearly so, are one body; otherwise each is decomposed on its own.
    loose_part : float
        Share of the whole area below which a piece or a body on its own is not decomposed.

    Returns
    -------
    bodies : Bodies
    """
    count, piece = working.mesh.face_components
    body, contacts = arange(count), np.empty((0, 2), np.int64)
    if together and count > 1:
        every = Component.of(working, arange(working.mesh.n_faces), connected=False)
        contacts = every.polygon[every.bridges.faces]
        n_bodies, body = components(count, *working.polygon_piece[contacts].T)
        if n_bodies == 1:
            return Bodies([every], contacts[:0])
    chosen = worth_cutting(working, body[piece], loose_part)
    touching = working.polygon_piece[contacts]
    contacts, touching = (pairs[~np.isin(body[touching[:, 0]], chosen)] for pairs in (contacts, touching))
    first = np.unique(pair_keys(np.sort(touching, axis=1), count), return_index=True)[1]
    return Bodies([Component.of(working, np.flatnonzero(body[piece] == label), n_bodies=len(chosen))
                   for label in chosen], contacts[first])


def worth_cutting(working: WorkingMesh, label: np.ndarray, loose_part: float) -> list[int]:
    """List the components that are decomposed: those large enough, and of enough faces, to have parts.

    Parameters
    ----------
    working : WorkingMesh
        m faces.
    label : (m,) int64
        Component, a piece or a body, of each face, 0 or more, all in use.
    loose_part : float
        Least share of the whole area, 0..1, that such a component has.

    Returns
    -------
    labels : list of int
        Rising.
    """
    area = np.bincount(label, working.mesh.face_area)
    pairs, _ = distinct_pairs(label, working.polygon)
    n_polygons = np.bincount(pairs[:, 0], minlength=len(area))
    # A component a million times shorter than the largest one is a rounding error of coordinates.
    large = (area >= max(loose_part * area.sum(), 1e-12 * area.max())) & (n_polygons >= MIN_FACES)
    most = MANY_BODIES + int(n_polygons.sum()) // FACES_PER_BODY
    if large.sum() > most:
        # All bodies of one number of faces are decomposed, or none.
        large &= n_polygons > np.sort(n_polygons[large])[-most - 1]
    return np.flatnonzero(large).tolist()


def repair(given: PolygonMesh) -> WorkingMesh:
    """Copy the caller's mesh without the defects that would disturb the field.

    The copy's coincident border vertices are joined (seams of imported files), faces with a repeated vertex are
    dropped, border edges are split where another border runs along them, fans of faces that touch in one vertex only
    are separated, and faces are turned outwards.

    Parameters
    ----------
    given : PolygonMesh

    Returns
    -------
    working : WorkingMesh
    """
    mesh = given.triangles
    joined, note_joined = _join_coincident_borders(mesh)
    faces = joined[mesh.faces]
    whole = (faces != np.roll(faces, -1, axis=1)).all(axis=1)
    # A mesh that needs no repair keeps the tables that were already computed for it.
    copy = mesh if whole.all() and not note_joined else TriMesh(mesh.vertices, faces[whole])
    seams = stitched(copy)
    polygon = given.polygon[whole]
    stitches, polygon = distinct_pairs(*np.sort(polygon[seams.pairs], axis=1).T)[0], polygon[seams.parent]
    stitches = stitches[stitches[:, 0] != stitches[:, 1]]
    joined = seams.joined[joined]
    note_stitched = _note_of_stitches(len(np.unique(stitches)))
    copy, vertex_source = _separate_fans(seams.mesh)
    copy, note_turned = turn_outwards(copy)
    return WorkingMesh(copy, frozen(polygon, np.int64),
                       frozen(vertex_source, np.int64), frozen(joined, np.int64), frozen(stitches, np.int64),
                       _notes(given) + note_joined + note_stitched + note_turned,
                       None if given.vertex_rank is None else given.vertex_rank[vertex_source])


def split_long_edges(mesh: TriMesh, max_length: float, least_budget: int = MIN_BUDGET) -> tuple[TriMesh, np.ndarray]:
    """Split edges at their middle until none is longer than a limit.

    An edge is split for all its faces at once, so that no gaps appear; the shape of the surface does not change.
    Splitting stops early, with longer edges, before the mesh has more than MAX_GROWTH times its faces and more than
    ``least_budget``.

    Parameters
    ----------
    mesh : TriMesh
        m faces.
    max_length : float
        In the unit of the vertices, above 0.
    least_budget : int
        Number of faces up to which splitting never stops early.

    Returns
    -------
    mesh : TriMesh
        m' faces. The vertices given come first, in order, then the new ones.
    parent : (m',) int64
        Face given in which each face lies.
    """
    parent = arange(mesh.n_faces)
    budget = max(least_budget, MAX_GROWTH * mesh.n_faces)
    while True:
        long = _longest(mesh, max_length, budget - mesh.n_faces)
        if not long.any():
            return mesh, parent
        mesh, step = split_edges(mesh, long)
        parent = parent[step]


def _longest(mesh: TriMesh, max_length: float, most: int) -> np.ndarray:
    """Edges longer than a limit, (e,) bool: the longest, as many as add no more faces than allowed."""
    long = mesh.edge_length > (1 + TIE) * max_length
    if mesh.edges.n_faces[long].sum() <= most:
        return long
    order = np.argsort(-mesh.edge_length, kind="stable")
    fits = int(np.searchsorted(cumsum(mesh.edges.n_faces[order]), most, side="right"))
    # Edges of one length are split all, or none.
    limit = max(max_length, mesh.edge_length[order[min(fits, len(order) - 1)]])
    return mesh.edge_length > (1 + TIE) * limit


def split_edges(mesh: TriMesh, marked: np.ndarray) -> tuple[TriMesh, np.ndarray]:
    """Split the marked edges at their middle, and each of their faces into two to four triangles.

    Parameters
    ----------
    mesh : TriMesh
        m faces, e edges.
    marked : (e,) bool
        Edges to split.

    Returns
    -------
    mesh : TriMesh
        m' faces. The vertices given come first, in order, then the middles of the marked edges, in order.
    parent : (m',) int64
        Face given in which each face lies.
    """
    begin, end = taken(mesh.edges.vertices, marked).T
    middle = full(len(marked), -1)
    middle[marked] = mesh.n_vertices + arange(len(begin))
    vertices = np.concatenate([mesh.vertices, (taken(mesh.vertices, begin) + taken(mesh.vertices, end)) / 2])
    mids = middle[mesh.edges.face_edges]
    n_split = (mids >= 0).sum(axis=1)
    # Each face is turned so that its only split edge, or its only whole edge, is the first, or its first vertex.
    odd_one = np.where((n_split == 1)[:, None], mids >= 0, mids < 0)
    first = np.where(n_split == 3, mesh.faces.argmin(axis=1), odd_one.argmax(axis=1))
    turn = (first[:, None] + arange(3)) % 3
    a, b, c = np.take_along_axis(mesh.faces, turn, axis=1).T
    ab, bc, ca = np.take_along_axis(mids, turn, axis=1).T
    # Where two edges are split, a quadrangle is left, which is cut along its shorter diagonal. If both are equal, and
    # for the order of what a face becomes, numbers of vertices decide, not the way round the face: the mirror image of
    # a mesh is to become its mirror image.
    from_a, from_b = (distances_between(vertices, p, q) for p, q in ((a, bc), (b, ca)))
    at_a = (from_a < (1 - TIE) * from_b) | ((from_a <= (1 + TIE) * from_b) & (a < b))
    patterns = (
        (n_split == 0, ((a, b, c),)),
        (n_split == 1, (_either(a < b, (a, ab, c), (ab, b, c)), _either(a > b, (a, ab, c), (ab, b, c)))),
        (n_split == 2, (_either(at_a, (a, b, bc), (a, b, ca)), _either(at_a, (a, bc, ca), (b, bc, ca)), (ca, bc, c))),
        (n_split == 3, ((a, ab, ca), _either(b < c, (ab, b, bc), (ca, bc, c)),
                        _either(b > c, (ab, b, bc), (ca, bc, c)), (ab, bc, ca))),
    )
    faces, parent = [], []
    for chosen, triangles in patterns:
        for corners in triangles:
            faces.append(taken(np.stack(corners, axis=1), chosen))
            parent.append(np.flatnonzero(chosen))
    return TriMesh(vertices, np.concatenate(faces)), np.concatenate(parent)


def _either(which: np.ndarray, one: tuple[np.ndarray, ...], other: tuple[np.ndarray, ...]) -> tuple[np.ndarray, ...]:
    """Corners of triangles, (k,) each: of the one where ``which``, (k,) bool, is true, else of the other."""
    return tuple(np.where(which, *pair) for pair in zip(one, other, strict=True))


def _join_coincident_borders(mesh: TriMesh) -> tuple[np.ndarray, tuple[Sentence, ...]]:
    """Vertex that each vertex is joined to, (n,) int64, see ``joined_borders``, and a note of how many were joined."""
    joined = joined_borders(mesh.vertices, mesh.edges.vertices, mesh.edges.n_faces, mesh.faces.ravel(),
                            np.repeat(arange(mesh.n_faces), 3))
    n_joined = int((joined != arange(len(joined))).sum())
    if not n_joined:
        return joined, ()
    return joined, (
        Sentence("{n} coincident border {n:vertex is|vertices are} treated as joined.", n=n_joined),)


def _note_of_stitches(n_faces: int) -> tuple[Sentence, ...]:
    """How many of the caller's faces share an edge with another in the copy only, if there are some."""
    return (Sentence("{n} faces whose borders run along each other, but do not meet, are treated as joined.",
                     n=n_faces),) if n_faces else ()


def _separate_fans(mesh: TriMesh) -> tuple[TriMesh, np.ndarray]:
    """Give each fan of faces around a vertex a vertex of its own, and drop vertices without a face.

    Returns the mesh and the vertex given at each of its vertices, (n',) int64, rising.
    """
    corner_vertex = mesh.faces.ravel()
    unsure = ~_has_one_fan(mesh)
    if not unsure.any():
        return mesh, arange(mesh.n_vertices)
    # Of all other vertices all corners are one fan.
    loose = np.flatnonzero(unsure[corner_vertex])
    a, b = place_among(loose, len(corner_vertex))[_joined_corners(mesh)].T
    kept = a >= 0
    count, fan = components(len(loose), a[kept], b[kept])
    own = np.empty(count, np.int64)
    own[fan] = corner_vertex[loose]
    single = np.flatnonzero(mesh.used & ~unsure)
    source = np.concatenate([single, own])
    order = stable_order(source)
    number, at = inverse(order), full(mesh.n_vertices, -1)
    at[single] = number[:len(single)]
    faces = at[corner_vertex]
    faces[loose] = number[len(single) + fan]
    return TriMesh(mesh.vertices[source[order]], faces.reshape(-1, 3)), source[order]


def _joined_corners(mesh: TriMesh) -> np.ndarray:
    """Corners at one vertex, of two faces that touch there along an edge, (2p, 2) int64: 3 times the face + corner."""
    sides = mesh.edges.pair_sides
    begin, end = sides, next_side(sides)
    same_way = mesh.same_way
    return np.concatenate([np.stack([begin[:, 0], np.where(same_way, begin[:, 1], end[:, 1])], axis=1),
                           np.stack([end[:, 0], np.where(same_way, end[:, 1], begin[:, 1])], axis=1)])


def _has_one_fan(mesh: TriMesh) -> np.ndarray:
    """Whether the faces around each vertex are known to be one fan, (n,) bool.

    A walk around each vertex, from face to face, is to come past as many faces as it has. Where faces are turned
    against each other, more than two meet at an edge, or more than MOST_AROUND at a vertex, it is not known.
    """
    corner_vertex, n = mesh.faces.ravel(), mesh.n_vertices
    known = mesh.used.copy()
    known[mesh.edges.vertices[mesh.edges.pair_edge[mesh.same_way]]] = False
    known[mesh.edges.vertices[mesh.edges.n_faces > 2]] = False
    first, second = mesh.edges.pair_sides.T
    following = full(len(corner_vertex), -1)
    following[first] = next_side(second)
    following[second] = next_side(first)
    begins = np.ones(len(corner_vertex), bool)  # a corner at a border, where a walk has to begin
    begins[following[following >= 0]] = False
    begins = np.flatnonzero(begins)
    start = np.empty(n, np.int64)
    start[corner_vertex] = arange(len(corner_vertex))
    start[corner_vertex[begins]] = begins
    walking = np.flatnonzero(known)
    at, passed = start[walking], known.astype(np.int64)
    for _ in range(MOST_AROUND):
        at = following[at]
        goes_on = (at >= 0) & (at != start[walking])
        walking, at = walking[goes_on], at[goes_on]
        passed[walking] += 1
    return known & (passed == np.bincount(corner_vertex, minlength=n))


def _notes(given: PolygonMesh) -> tuple[Sentence, ...]:
    """One sentence for each oddity of the caller's mesh."""
    mesh = given.triangles
    n_lost = int((~mesh.used).sum())
    flat = np.ones(given.n_polygons, bool)
    longest = np.maximum.reduce([mesh.edge_length[side] for side in mesh.edges.face_edges.T])
    # The area of three corners on a line is rarely exactly 0.
    flat[given.polygon[mesh.face_area > 1e-12 * longest**2]] = False
    notes = (
        Sentence("{n} {n:edge joins|edges join} more than two faces (non-manifold).",
                 n=int((mesh.edges.n_faces > 2).sum())),
        border_note(int((mesh.edges.n_faces == 1).sum())),
        Sentence("{n} {n:vertex belongs to no face; it gets|vertices belong to no face; they get} no part.", n=n_lost),
        Sentence("{n} {n:face has zero area; it follows its|faces have zero area; they follow their} neighbors.",
                 n=int(flat.sum())),
    )
    return tuple(note for note in notes if note.values["n"])

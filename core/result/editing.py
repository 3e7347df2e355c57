# SPDX-License-Identifier: GPL-3.0-or-later
"""Parts changed by hand: where a part would split, what it would take or give, whether it is in one piece.

Everything works on candidate parts, the grains of a decomposition; ``split_candidates`` makes finer ones
where a grain is not fine enough. Masks are (c,) bool over the candidates.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from scipy.sparse.csgraph import dijkstra

from ..cuts.hierarchy import Dendrogram, Hierarchy
from ..graph.contours import contours
from ..graph.critical import SADDLE
from ..surface.arrays import components, symmetric_matrix
from ..surface.corners import CornerTable
from ..surface.labels import FaceGraph, majority
from .decomposition import Decomposition


def pieces(decomposition: Decomposition, mask: np.ndarray) -> np.ndarray:
    """Connected pieces of some candidates.

    Returns
    -------
    piece : (c,) int64
        0 for the largest piece by area, 1 for the next; -1 outside the mask.
    """
    pairs = _inside(decomposition, mask)
    _, label = components(decomposition.n_candidates, *pairs.T)
    label = np.where(mask, label, -1)
    found = np.unique(label[mask])
    area = np.array([decomposition.candidate_area[label == piece].sum() for piece in found])
    result = np.full(len(mask), -1, np.int64)
    for place, index in enumerate(np.argsort(-area, kind="stable")):
        result[label == found[index]] = place
    return result


def best_split(decomposition: Decomposition, mask: np.ndarray) -> np.ndarray | None:
    """The two sides of the best cut within a part: of all cuts inside, the last to be merged.

    Parameters
    ----------
    decomposition : Decomposition
    mask : (c,) bool
        Candidates of one connected part.

    Returns
    -------
    side : (c,) bool or None
        The smaller side; None for a part of a single candidate.
    """
    if mask.sum() < 2:
        return None
    pairs, tree = _merging_inside(decomposition, mask)
    return _smaller_side(decomposition, mask, _side_without(pairs, tree.rows[:-1], tree.order[tree.joins[-1, 0]], mask))


def node_split(decomposition: Decomposition, mask: np.ndarray, node: int) -> np.ndarray | None:
    """The two sides of the best cut within a part that lies along the arcs of a node in it.

    Of all cuts between the node's candidate and those that its arcs reach inside the part, the last to be
    merged; where the arcs reach no other, between it and the rest of the part.

    Parameters
    ----------
    decomposition : Decomposition
    mask : (c,) bool
        Candidates of one connected part, with that of the node.
    node : int
        Of the graph.

    Returns
    -------
    side : (c,) bool or None
        The node's side; None for a part of a single candidate.
    """
    start = decomposition.node_candidate[node]
    graph = decomposition.graph
    ours = (graph.arcs == node).any(axis=1)
    reached = np.zeros(len(mask), bool)
    reached[decomposition.point_candidate[ours[graph.point_arc]]] = True
    reached[decomposition.node_candidate[graph.arcs[ours].ravel()]] = True
    rest = mask & (np.arange(len(mask)) != start)
    return _strongest_cut(decomposition, mask, start, rest & reached if (rest & reached).any() else rest)


def _strongest_cut(
    decomposition: Decomposition, mask: np.ndarray, start: int, targets: np.ndarray
) -> np.ndarray | None:
    """The side of a candidate at the last merge that joins it with one of some others in a part."""
    pairs, tree = _merging_inside(decomposition, mask)
    targets = np.flatnonzero(targets)
    rows = tree.row_of(np.full(len(targets), start), targets)
    rows = rows[np.isin(rows, tree.rows)]
    if not len(rows):
        return None
    return _side_without(pairs, tree.rows[tree.rows != rows.max()], start, mask)


def _merging_inside(decomposition: Decomposition, mask: np.ndarray) -> tuple[np.ndarray, Dendrogram]:
    """Pairs of candidates that touch inside a part, weakest cut first, and how they merge."""
    pairs = _inside(decomposition, mask)
    pairs = pairs[np.argsort(decomposition.hierarchy.merge_of(*pairs.T), kind="stable")]
    return pairs, Dendrogram.of(decomposition.n_candidates, pairs)


def _side_without(pairs: np.ndarray, joins: np.ndarray, start: int, mask: np.ndarray) -> np.ndarray:
    """What is together with a candidate when only some of the pairs are joined, (c,) bool."""
    label = components(len(mask), *pairs[joins].T)[1]
    return label == label[start]


def _smaller_side(decomposition: Decomposition, mask: np.ndarray, side: np.ndarray) -> np.ndarray:
    """A side of a part, or what it leaves of the part if that has less area."""
    other = mask & ~side
    area = decomposition.candidate_area
    return side if area[side].sum() <= area[other].sum() else other


def growth(decomposition: Decomposition, mask: np.ndarray, allowed: np.ndarray) -> int | None:
    """The candidate that a part takes next: the one beyond the weakest piece of its boundary.

    Parameters
    ----------
    decomposition : Decomposition
    mask : (c,) bool
        Candidates of the part.
    allowed : (c,) bool
        Candidates that may be taken.

    Returns
    -------
    candidate : int or None
        None if nothing allowed touches the part.
    """
    inner, outer = _border(decomposition, mask)
    usable = allowed[outer]
    inner, outer = inner[usable], outer[usable]
    if not len(outer):
        return None
    return int(outer[_weakest(decomposition, inner, outer)])


def shrinkage(
    decomposition: Decomposition, mask: np.ndarray, allowed: np.ndarray
) -> tuple[int, int] | None:
    """The candidate that a part gives away next, and the one beyond the boundary that it goes to.

    The part stays in one piece, and is never given away whole.

    Parameters
    ----------
    decomposition : Decomposition
    mask : (c,) bool
        Candidates of the part.
    allowed : (c,) bool
        Candidates whose parts may receive one.

    Returns
    -------
    given, receiver : int
        None if nothing can be given.
    """
    inner, outer = _border(decomposition, mask)
    usable = allowed[outer]
    inner, outer = inner[usable], outer[usable]
    time = decomposition.hierarchy.merge_of(inner, outer)
    for index in np.argsort(time, kind="stable").tolist():
        rest = mask.copy()
        rest[inner[index]] = False
        if rest.any() and pieces(decomposition, rest).max() == 0:
            return int(inner[index]), int(outer[index])
    return None


def boundary_distance(
    inside: np.ndarray, face_pairs: np.ndarray, pair_length: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """How far each face is from the boundary of some faces, and what lies nearest across it.

    Parameters
    ----------
    inside : (p,) bool
    face_pairs : (e, 2) int64
        Faces that share an edge.
    pair_length : (e,) float64
        Distance of their centers, not negative.

    Returns
    -------
    distance : (p,) float64
        Along the surface, from the center of the nearest face on the other side: positive outside,
        negative inside, infinite where the boundary cannot be reached.
    across : (p,) int64
        That face; -1 where there is none.
    """
    count = len(inside)
    sides = inside[face_pairs]
    distance = np.full(count, np.inf)
    across = np.full(count, -1, np.int64)
    # A path leaves the boundary and stays on its side; 0 would mean "no edge" to a sparse graph.
    length = np.maximum(pair_length, 1e-12 * pair_length.max(initial=1.0))
    for side in (False, True):
        usable = ~(sides != side).all(axis=1)
        border = np.unique(face_pairs[sides[:, 0] != sides[:, 1]])
        border = border[inside[border] != side]
        if not len(border):
            continue
        graph = symmetric_matrix(face_pairs[usable], length[usable], count)
        found, _, source = dijkstra(
            graph, directed=True, indices=border, min_only=True, return_predecessors=True)
        here = (inside == side) & np.isfinite(found)
        distance[here] = -found[here] if side else found[here]
        across[here] = source[here]
    return distance, across


def split_candidates(
    decomposition: Decomposition, faces: np.ndarray, graph: FaceGraph, table: CornerTable
) -> Decomposition:
    """Cut candidates in two along the outline of some faces.

    The two halves of a candidate are the first to merge again, so that no level of detail shows the new cuts unless
    the halves are pinned to different parts.

    Parameters
    ----------
    decomposition : Decomposition
        Of p faces, with c candidates.
    faces : (p,) bool
        Faces to be separable from the others.
    graph : FaceGraph
        Which of the p faces touch, and their areas.
    table : CornerTable
        Of the same faces, in the coordinates of the decomposition's graph.

    Returns
    -------
    finer : Decomposition
        Old candidates keep their number, less the faces, vertices, nodes and center points of the graph that now
        belong to new ones from c on.
    """
    old = decomposition.candidates
    size = np.bincount(old, minlength=decomposition.n_candidates)
    inside = np.bincount(old, faces, decomposition.n_candidates)
    cut = np.flatnonzero((inside > 0) & (inside < size))
    if not len(cut):
        return decomposition
    half = np.arange(decomposition.n_candidates)  # the candidate of those of its faces that are to be separable
    half[cut] = decomposition.n_candidates + np.arange(len(cut))
    candidates = np.where(faces, half[old], old)
    count = decomposition.n_candidates + len(cut)
    pairs, length = graph.boundaries(candidates)
    area = np.bincount(candidates, graph.area, count)
    area *= decomposition.candidate_area.sum() / area.sum()
    hierarchy = decomposition.hierarchy
    merges = np.concatenate([np.stack([cut, half[cut]], axis=1), hierarchy.merges])
    salience = np.concatenate([np.zeros(len(cut)), hierarchy.salience])
    nodes, points = _graph_halves(decomposition, faces, cut, half, table)
    return replace(
        decomposition, candidates=candidates, candidate_area=area, candidate_pairs=pairs,
        vertex_candidates=_vertex_halves(decomposition, candidates, graph.area, table),
        candidate_pair_length=length, hierarchy=Hierarchy.of(count, merges, salience),
        node_candidate=nodes, point_candidate=points)


def _vertex_halves(
    decomposition: Decomposition, candidates: np.ndarray, area: np.ndarray, table: CornerTable
) -> np.ndarray:
    """The candidate of each vertex: of the two halves of its former one, that with more area around it."""
    vertex, face = table.corner_vertex, table.corner_face
    former = decomposition.vertex_candidates
    votes = decomposition.candidates[face] == former[vertex]
    vertex, face = vertex[votes], face[votes]
    # Faces without area vote, too, after all others.
    winner = majority(vertex, candidates[face], area[face] + 1e-12 * area.sum(), len(former))
    return np.where(winner >= 0, winner, former)


def _graph_halves(
    decomposition: Decomposition, faces: np.ndarray, cut: np.ndarray, half: np.ndarray, table: CornerTable
) -> tuple[np.ndarray, np.ndarray]:
    """The candidate of each node and of each center point of the graph, after candidates were cut.

    A center point goes where most of its contour lies, and so does a saddle; an extremum lies on the surface.
    """
    graph = decomposition.graph
    nodes, points = decomposition.node_candidate.copy(), decomposition.point_candidate.copy()
    for candidate in cut.tolist():
        mine = table.within(decomposition.candidates == candidate)
        for place in np.flatnonzero(points == candidate):
            if _contour_is_on(mine, decomposition, graph.point_position[place], graph.point_value[place], faces):
                points[place] = half[candidate]
        for node in np.flatnonzero(nodes == candidate):
            position = graph.node_position[node]
            on = (_contour_is_on(mine, decomposition, position, graph.node_value[node], faces)
                  if graph.node_kind[node] == SADDLE else _nearest_is_on(mine, position, faces))
            if on:
                nodes[node] = half[candidate]
    return nodes, points


def _contour_is_on(
    table: CornerTable, decomposition: Decomposition, position: np.ndarray, level: float, faces: np.ndarray
) -> bool:
    """Whether most of the contour of a level around a position, within a table, lies on some faces."""
    found = contours(decomposition.field, level, table)
    chosen = found.label == found.around(position)
    if not chosen.any():
        return _nearest_is_on(table, position, faces)
    length = found.length[chosen]
    return bool(length[faces[found.face[chosen]]].sum() > length.sum() / 2)


def _nearest_is_on(table: CornerTable, position: np.ndarray, faces: np.ndarray) -> bool:
    """Whether most of the faces of a table that meet at the vertex nearest to a position are among some faces."""
    offset = table.vertices[table.corner_vertex] - position
    nearest = table.corner_vertex[np.einsum("ij,ij->i", offset, offset).argmin()]
    around = faces[table.corner_face[table.corner_vertex == nearest]]
    return bool(around.sum() > len(around) / 2)


def _inside(decomposition: Decomposition, mask: np.ndarray) -> np.ndarray:
    """Pairs of touching candidates with both in a mask, (k, 2)."""
    pairs = decomposition.candidate_pairs
    return pairs[mask[pairs].all(axis=1)]


def _border(decomposition: Decomposition, mask: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Pairs of touching candidates across the boundary: inner and outer ones."""
    pairs = decomposition.candidate_pairs
    across = pairs[mask[pairs].sum(axis=1) == 1]
    first_inside = mask[across[:, 0]]
    return (np.where(first_inside, across[:, 0], across[:, 1]),
            np.where(first_inside, across[:, 1], across[:, 0]))


def _weakest(decomposition: Decomposition, a: np.ndarray, b: np.ndarray) -> int:
    """Which of some pairs of candidates merges first."""
    return int(decomposition.hierarchy.merge_of(a, b).argmin())

# SPDX-License-Identifier: GPL-3.0-or-later
"""Parts changed by hand: where a part would split, what it would take or give, whether it is in one piece.

Everything works on candidate parts, the grains of a decomposition; ``split_candidates`` makes finer ones
where a grain is not fine enough. Masks are (c,) bool over the candidates.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from scipy.sparse import coo_array
from scipy.sparse.csgraph import dijkstra

from ..cuts.hierarchy import Hierarchy
from ..surface.arrays import components
from ..surface.labels import label_boundaries
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
    pairs = _inside(decomposition, mask)
    order = np.argsort(decomposition.hierarchy.merge_of(*pairs.T), kind="stable")
    part = np.arange(decomposition.n_candidates)
    for a, b in pairs[order].tolist():
        if part[a] != part[b]:
            last = part == part[b]
            part[last] = part[a]
    # The last two sides to be joined; nothing else was left to join.
    other = mask & ~last
    area = decomposition.candidate_area
    return last if area[last].sum() <= area[other].sum() else other


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


def _strongest_cut(decomposition, mask, start, targets) -> np.ndarray | None:
    """The side of a candidate at the last merge that joins it with one of some others in a part."""
    pairs = _inside(decomposition, mask)
    pairs = pairs[np.argsort(decomposition.hierarchy.merge_of(*pairs.T), kind="stable")]
    part = np.arange(decomposition.n_candidates)
    joins, cut = [], None
    for a, b in pairs.tolist():
        if part[a] == part[b]:
            continue
        other = {part[a]: part[b], part[b]: part[a]}.get(part[start])
        if other is not None and targets[part == other].any():
            cut = len(joins)
        joins.append((a, b))
        part[part == part[b]] = part[a]
    if cut is None:
        return None
    # All joins but that one leave two sides.
    kept = np.array(joins[:cut] + joins[cut + 1 :], np.int64).reshape(-1, 2)
    label = components(decomposition.n_candidates, *kept.T)[1]
    return label == label[start]


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
        a, b = face_pairs[usable].T
        graph = coo_array((length[usable], (a, b)), shape=(count, count)).tocsr()
        found, _, source = dijkstra(
            graph, directed=False, indices=border, min_only=True, return_predecessors=True)
        here = (inside == side) & np.isfinite(found)
        distance[here] = -found[here] if side else found[here]
        across[here] = source[here]
    return distance, across


def split_candidates(
    decomposition: Decomposition,
    faces: np.ndarray,
    face_area: np.ndarray,
    face_pairs: np.ndarray,
    pair_length: np.ndarray,
) -> Decomposition:
    """The same decomposition with candidates cut along the outline of some faces.

    The new candidates are the first to merge again, so that no level of detail shows the new cuts unless
    somebody ties the candidates to different parts.

    Parameters
    ----------
    decomposition : Decomposition
        Of p faces, with c candidates.
    faces : (p,) bool
        Faces to be separable from the others.
    face_area : (p,) float64
    face_pairs : (e, 2) int64
        Faces that share an edge.
    pair_length : (e,) float64
        Length of the edge.

    Returns
    -------
    finer : Decomposition
        Old candidates keep their number, less the faces that now belong to new ones from c on.
    """
    old = decomposition.candidates
    size = np.bincount(old, minlength=decomposition.n_candidates)
    inside = np.bincount(old, faces, decomposition.n_candidates)
    cut = np.flatnonzero((inside > 0) & (inside < size))
    if not len(cut):
        return decomposition
    new_index = np.arange(decomposition.n_candidates)
    new_index[cut] = decomposition.n_candidates + np.arange(len(cut))
    candidates = np.where(faces, new_index[old], old)
    count = decomposition.n_candidates + len(cut)
    pairs, length = label_boundaries(candidates, face_pairs, pair_length)
    area = np.bincount(candidates, face_area, count)
    area *= decomposition.candidate_area.sum() / area.sum()
    hierarchy = decomposition.hierarchy
    merges = np.concatenate([np.stack([cut, new_index[cut]], axis=1), hierarchy.merges])
    salience = np.concatenate([np.zeros(len(cut)), hierarchy.salience])
    return replace(
        decomposition, candidates=candidates, candidate_area=area, candidate_pairs=pairs,
        candidate_pair_length=length, hierarchy=Hierarchy.of(count, merges, salience))


def _inside(decomposition, mask) -> np.ndarray:
    pairs = decomposition.candidate_pairs
    return pairs[mask[pairs].all(axis=1)]


def _border(decomposition, mask) -> tuple[np.ndarray, np.ndarray]:
    """Pairs of touching candidates across the boundary: inner and outer ones."""
    pairs = decomposition.candidate_pairs
    across = pairs[mask[pairs].sum(axis=1) == 1]
    first_inside = mask[across[:, 0]]
    return (np.where(first_inside, across[:, 0], across[:, 1]),
            np.where(first_inside, across[:, 1], across[:, 0]))


def _weakest(decomposition, a, b) -> int:
    return int(decomposition.hierarchy.merge_of(a, b).argmin())

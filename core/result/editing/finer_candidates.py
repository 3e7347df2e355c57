# SPDX-License-Identifier: GPL-3.0-or-later
"""Candidates cut along faces that are given one by one, where they are not fine enough for a change by hand."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ...arrays.indexing import last_of_each
from ...arrays.int64 import arange
from ...arrays.pairs import both_ways, distinct_pairs
from ...arrays.vectors import row_products
from ...cuts.hierarchy import Dendrogram, Hierarchy
from ...graph.critical import SADDLE
from ...mesh.corners import CornerTable
from ...mesh.face_graph import FaceGraph
from ...mesh.labels import majority, spread
from ...mesh.triangles import vote_weights
from ..decomposition import Decomposition
from ..junctions import FaceSides, boundaries, junctions
from .contour_cut import contours

SCRAP = 0.03  # share of a part below which a candidate of it is a scrap beside a pinned part


def ranked_pieces(decomposition: Decomposition, number: np.ndarray, graph: FaceGraph) -> np.ndarray:
    """Rank the pieces that a change makes of each candidate, as of a limb with a ring around its middle.

    Parameters
    ----------
    decomposition : Decomposition
        p faces.
    number : (p,) int64
        0 for faces that stay in their candidate, 1 or more for those that get to a part.
    graph : FaceGraph
        Of the p faces.

    Returns
    -------
    rank : (p,) int64
        Of the pieces in which a candidate's faces of one number are: 0 for the faces of the largest, 1 for the next ...
        Each piece of a candidate that was in several before has ranks of its own.
    """
    candidates = decomposition.candidates
    partly = (np.bincount(candidates, number, decomposition.n_candidates) > 0)[candidates]
    touching = graph.with_contacts(decomposition.contacts)
    _, piece = touching.regions(np.where(partly, distinct_pairs(candidates, number)[1], -1))
    _, whole = touching.regions(np.where(partly, candidates, -1))
    pieces, face = np.unique(piece[partly], return_index=True)
    of = distinct_pairs(whole[partly][face], number[partly][face])[1]
    order = np.lexsort((-np.bincount(piece, graph.area)[pieces], of))
    rank = np.zeros(int(piece.max()) + 1, np.int64)
    rank[pieces[order]] = arange(len(order)) - np.searchsorted(of[order], of[order])
    return np.where(partly, rank[piece], 0)


def split_around(
    decomposition: Decomposition, number: np.ndarray, graph: FaceGraph, table: CornerTable
) -> Decomposition:
    """Cut candidates so that faces can become parts that are given face by face.

    Parameters
    ----------
    decomposition : Decomposition
        p faces and c candidates.
    number : (p,) int64
        Faces of one number, 1 or more, shall be separable from all others. 0 for faces that stay as they are.
    graph, table
        As of ``split_candidates``.

    Returns
    -------
    finer : Decomposition
        As of ``split_candidates``; no candidate has faces of two numbers. What is of one number in several pieces of a
        candidate becomes several candidates.
    """
    _, place = distinct_pairs(number, ranked_pieces(decomposition, number, graph))
    sides, touching = _sides_of(table), graph.with_contacts(decomposition.contacts)
    # Two places differ in a bit: a cut for each bit, ten for a thousand places, parts all of them.
    for bit in range(int(place.max(initial=0)).bit_length()):
        decomposition = _split(decomposition, (place >> bit) & 1 == 1, touching, table, sides)
    return decomposition


def scraps_joined(finer: Decomposition, number: np.ndarray, before: np.ndarray) -> Decomposition:
    """Have scraps beside pinned parts merge first with what they were one part with.

    Scraps are small and would merge with what is pinned before anything else: where new cuts are not those of before,
    each would be a part of its own.

    Parameters
    ----------
    finer : Decomposition
        p faces and c candidates, as ``split_around`` returns it.
    number : (p,) int64
        What ``split_around`` was given: 0 for faces that are in no pinned part.
    before : (p,) int64
        Number of the part that each face was in until now.

    Returns
    -------
    decomposition : Decomposition
        With other merges. Scraps that touch nothing that was in their part, but what is pinned, stay as they are.
    """
    count, area, pairs = finer.n_candidates, finer.candidate_area, finer.candidate_pairs
    pinned = np.bincount(finer.candidates, number, count) > 0
    was = majority(finer.candidates, before, np.ones(len(before)), count)
    joins = ~pinned[pairs].any(axis=1) & (was[pairs[:, 0]] == was[pairs[:, 1]])
    one, other = both_ways(pairs).T
    # One merge may join it with what is pinned and with another scrap there.
    first = last_of_each(one, -np.tile(finer.pair_merge, 2), pinned[other], count=count)
    goes = np.append(other, -1)[first]
    small = area < SCRAP * np.bincount(was, area)[was]
    scrap = ~pinned & small & (goes >= 0) & pinned[goes]
    longest_last = np.argsort(np.tile(finer.candidate_pair_length[joins], 2), kind="stable")
    goal = spread(np.where(scrap, -1, arange(count)), *both_ways(pairs[joins])[longest_last].T)
    scraps = np.flatnonzero(scrap & (goal >= 0))
    if not len(scraps):
        return finer
    without = arange(count)
    without[scraps] = goes[scraps]
    old = finer.hierarchy
    merges = np.concatenate([np.stack([goal[scraps], scraps], axis=1), without[old.merges]])
    salience = np.concatenate([np.zeros(len(scraps)), old.salience])
    rows = Dendrogram.of(count, merges).rows
    return replace(finer, hierarchy=Hierarchy.of(count, merges[rows], salience[rows]))


def split_candidates(
    decomposition: Decomposition, faces: np.ndarray, graph: FaceGraph, table: CornerTable
) -> Decomposition:
    """Cut candidates in two along the outline of some faces, so that these faces can become a part.

    The two halves of a candidate merge before all other candidates. A level of detail therefore never shows the new
    cuts, unless the halves are pinned to different parts.

    Parameters
    ----------
    decomposition : Decomposition
        p faces and c candidates.
    faces : (p,) bool
        Faces that shall be separable from the others.
    graph : FaceGraph
        Which of the p faces touch, and their areas.
    table : CornerTable
        Corners of the p faces, in the coordinates of ``decomposition.graph``.

    Returns
    -------
    finer : Decomposition
        Candidates below c are the old ones. Candidates from c on are the halves that consist of the given faces; the
        vertices, nodes and center points in these halves belong to them. The given decomposition if no candidate
        has to be cut.
    """
    return _split(decomposition, faces, graph.with_contacts(decomposition.contacts), table, _sides_of(table))


def _sides_of(table: CornerTable) -> FaceSides:
    """The sides of all faces, each by its corner."""
    return FaceSides(table.corner_face, table.corner_edge, table.edge_length(arange(len(table.edges))))


def _split(
    decomposition: Decomposition, faces: np.ndarray, touching: FaceGraph, table: CornerTable, sides: FaceSides
) -> Decomposition:
    """What ``split_candidates`` does. touching : the graph with the contacts. sides : of all faces."""
    old = decomposition.candidates
    size = np.bincount(old, minlength=decomposition.n_candidates)
    inside = np.bincount(old, faces, decomposition.n_candidates)
    cut = np.flatnonzero((inside > 0) & (inside < size))
    if not len(cut):
        return decomposition
    half = arange(decomposition.n_candidates)  # for each candidate, the one of its given faces
    half[cut] = decomposition.n_candidates + arange(len(cut))
    candidates = np.where(faces, half[old], old)
    count = decomposition.n_candidates + len(cut)
    pairs, length = boundaries(touching, candidates, sides)
    members, at_junction = junctions(candidates, sides)
    area = np.bincount(candidates, touching.area, count)
    area *= decomposition.candidate_area.sum() / area.sum()
    hierarchy = decomposition.hierarchy
    merges = np.concatenate([np.stack([cut, half[cut]], axis=1), hierarchy.merges])
    salience = np.concatenate([np.zeros(len(cut)), hierarchy.salience])
    nodes, points = _graph_halves(decomposition, faces, cut, half, table)
    return replace(
        decomposition, candidates=candidates, candidate_area=area, candidate_pairs=pairs,
        vertex_candidates=_vertex_halves(decomposition, candidates, touching.area, table),
        candidate_pair_length=length, hierarchy=Hierarchy.of(count, merges, salience),
        node_candidate=nodes, point_candidate=points, junctions=members, junction_length=at_junction)


def _vertex_halves(
    decomposition: Decomposition, candidates: np.ndarray, area: np.ndarray, table: CornerTable
) -> np.ndarray:
    """Candidate of each vertex, (n,): of the two halves of its former candidate, the one with more area around it."""
    vertex, face = table.corner_vertex, table.corner_face
    former = decomposition.vertex_candidates
    votes = decomposition.candidates[face] == former[vertex]
    vertex, face = vertex[votes], face[votes]
    winner = majority(vertex, candidates[face], vote_weights(area)[face], len(former))
    return np.where(winner >= 0, winner, former)


def _graph_halves(
    decomposition: Decomposition, faces: np.ndarray, cut: np.ndarray, half: np.ndarray, table: CornerTable
) -> tuple[np.ndarray, np.ndarray]:
    """Candidate of each node, (k,), and of each center point, (r,), of the graph after candidates were cut.

    A center point or a saddle belongs to the half in which most of its contour lies, a minimum or a maximum to the half
    in which the nearest vertex lies. cut : candidates that were cut. half : (c,), the new candidate of each old one.
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
    """Whether most of the contour of a level around a position, on the faces of a table, lies on faces of a mask."""
    found = contours(decomposition.field, level, table)
    chosen = found.label == found.around(position)
    if not chosen.any():
        return _nearest_is_on(table, position, faces)
    length = found.length[chosen]
    return bool(length[faces[found.face[chosen]]].sum() > length.sum() / 2)


def _nearest_is_on(table: CornerTable, position: np.ndarray, faces: np.ndarray) -> bool:
    """Whether most faces of a table that meet at the vertex nearest to a position are faces of a mask, (p,) bool."""
    offset = table.vertices[table.corner_vertex] - position
    nearest = table.corner_vertex[row_products(offset, offset).argmin()]
    around = faces[table.corner_face[table.corner_vertex == nearest]]
    return bool(around.sum() > len(around) / 2)

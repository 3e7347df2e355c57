# SPDX-License-Identifier: GPL-3.0-or-later
"""Which curves are used: those that are smoother than the border, and tear no part."""

from __future__ import annotations

import numpy as np

from ...arrays.components import components
from ...arrays.indexing import last_of_each, renumbered, sums_by
from ...arrays.int64 import arange, full
from ...mesh.corners import next_of_owner
from .band import Band
from .division import Division
from .sides import Sides
from .turning import turning

# A curve is used if it turns at most such a share of what the border along edges turns.
WORTH = 0.85


def judged(band: Band, sides: Sides, division: Division,
           planar: bool = False) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Put together what must be divided or left as a whole, and find what is better divided.

    planar : bool, groups whose curves all lie in planes are good whatever they turn, and no others.

    Returns
    -------
    group : (v,) int64
        Group of each vertex of a face that is at a border before or after; -1 of others.
    good : (groups,) bool
        Whether the curves of the group turn less than its borders do, and no part is lost or torn by them.
    broken : (groups,) bool
        Whether a part would be lost or torn, or the borders branch into several surfaces.
    """
    table = band.table
    low, high = band.edge_labels
    faces = division.concerned(band.labels)
    faces[table.corner_face[(low < high)[table.corner_edge]]] = True
    group = _groups(band, faces)
    before = _turning_by(group, band, low < high)
    after = _turning_after(group, band, sides, division)
    broken = np.zeros(len(before), bool)
    branching = (low < high) & (table.n_edge_faces > 2)
    broken[group[table.edges[branching]]] = True
    here = (faces & _torn(band, division))[table.corner_face]
    broken[group[table.corner_vertex[here]]] = True
    if not planar:
        return group, (after <= WORTH * before) & ~broken, broken
    crossed = ~np.isnan(sides.share)
    bent = np.zeros(len(before), bool)
    bent[group[table.edges[crossed & (sides.plane[table.edges] < 0).any(axis=1)]]] = True
    flat = np.zeros(len(before), bool)
    flat[group[table.edges[crossed]]] = True
    return group, flat & ~bent & ~broken, broken


def _groups(band: Band, faces: np.ndarray) -> np.ndarray:
    """Connected groups of faces that share vertices: number of the group of each vertex, -1 for none, (v,) int64."""
    table = band.table
    corner = np.flatnonzero(faces[table.corner_face])
    used, vertex = renumbered(table.corner_vertex[corner])
    same = table.corner_face[corner[1:]] == table.corner_face[corner[:-1]]
    _, label = components(len(used), vertex[1:][same], vertex[:-1][same])
    group = full(len(band.vertices), -1)
    group[used] = label
    return group


def _turning_by(group: np.ndarray, band: Band, cut: np.ndarray) -> np.ndarray:
    """How much the cut edges of each group turn, (groups,) float64."""
    point, angle = turning(band.table.vertices, band.table.edges[cut])
    return np.bincount(group[point], angle, int(group.max(initial=-1)) + 1)


def _turning_after(group: np.ndarray, band: Band, sides: Sides, division: Division) -> np.ndarray:
    """How much the curves of each group turn, (groups,) float64."""
    table = band.table
    n, edges = len(band.vertices), len(table.edges)
    a, b = table.edges.T
    at = np.nan_to_num(sides.share, nan=0.5)[:, None]
    crossings = (1 - at) * table.vertices[a] + at * table.vertices[b]
    points = np.concatenate([table.vertices, crossings, np.zeros((len(band.faces), 3))])
    segments, inner = _segments(band, division)
    middle = sums_by(inner[:, 0], points[inner[:, 1]], len(band.faces))
    points[n + edges :] = middle / np.maximum(np.bincount(inner[:, 0], minlength=len(middle)), 1)[:, None]
    first = np.zeros(len(band.faces), np.int64)
    first[table.corner_face] = table.corner_vertex
    vertex = np.concatenate([arange(n), a, first])
    point, angle = turning(points, segments)
    of = group[vertex[point]]
    return np.bincount(of[of >= 0], angle[of >= 0], int(group.max(initial=-1)) + 1)


def _segments(band: Band, division: Division) -> tuple[np.ndarray, np.ndarray]:
    """What curves consist of, (s, 2) points, and the faces with a point inside, each with its marks, (m, 2)."""
    start = division.point[division.begins]
    face = division.face[division.begins]
    count = division.n_fragments[face]
    two, three = count == 2, count == 3
    chords = start[two].reshape(-1, 2)
    inner = np.stack([face[three], start[three]], axis=1)
    spokes = np.stack([len(band.vertices) + len(band.edges) + face[three], start[three]], axis=1)
    one, other = division.beside
    along = one[division.label[one] != division.label[other]]
    stretch = np.stack([division.point[along], division.point[next_of_owner(division.face)[along]]], axis=1)
    return np.concatenate([chords, spokes, stretch]), inner


def _torn(band: Band, division: Division) -> np.ndarray:
    """Faces of parts that are lost, and faces in what is torn off a part, (f,) bool."""
    one, other = division.beside
    a, b = division.face[one], division.face[other]
    kept = band.labels[a] == band.labels[b]
    count, before = components(len(band.faces), a[kept], b[kept])
    name = np.zeros(count, np.int64)
    name[before] = band.labels
    n_before = np.bincount(name, minlength=len(band.names))
    # In each try the largest of what hangs together of a part keeps some of its own faces: if one of two islands were
    # lost in one try, and the other in the next, nothing of the part would be left.
    alive = np.zeros(count, bool)
    alive[before[division.face[division.label == band.labels[division.face]]]] = True
    largest = last_of_each(name, np.bincount(before, minlength=count), -arange(count), count=len(band.names))
    lost = np.zeros(count, bool)
    lost[largest] = ~alive[largest]
    label = division.label[division.begins]
    kept = division.label[one] == division.label[other]
    count, after = components(len(label), division.fragment[one[kept]], division.fragment[other[kept]])
    name = np.zeros(count, np.int64)
    name[after] = label
    # Of each part as many of the largest as there were before are what is left of it; others are torn off.
    size = np.bincount(after, minlength=count)
    order = np.lexsort((-size, name))
    first = np.searchsorted(name[order], name[order])
    off = np.zeros(count, bool)
    off[order] = arange(count) - first >= n_before[name[order]]
    torn = lost[before]
    torn[division.face[off[after[division.fragment]]]] = True
    return torn

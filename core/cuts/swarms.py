# SPDX-License-Identifier: GPL-3.0-or-later
"""Small pieces that are there in numbers and stand alone are one part: the leaves of a tree, the shingles of a roof.

What joins pieces judges two of them by how they touch, and leaves that touch nothing have not been judged at all: a
tree of leaf cards came in 85 parts, a cactus of spines in 41. People who name the parts of a tree say "leaves" and do
not count them.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ..arrays.components import components
from ..arrays.int64 import arange, full
from ..arrays.nearest import nearest, nearest_larger, nearest_to_middle, search_tree
from ..arrays.ties import TIE
from ..arrays.vectors import distances_between, middles_of_each
from ..mesh.triangles import TriMesh
from .face_candidates import FaceCandidates
from .hierarchy import Dendrogram, Hierarchy

# A swarm has so many members - one more than an insect has legs -, none of more than SMALL of the area of the largest
# part: a heap of stones stays what it is.
LEAST, SMALL = 7, 0.02
# Two of its members are alike and near each other: the larger has at most ALIKE times the area of the smaller, their
# extents, in units of their size, differ by less than a factor exp(SHAPE), and their middles are at most NEAR of the
# mean of their sizes apart. A size is the root of an area.
ALIKE, SHAPE, NEAR = 4.0, 0.4, 10.0
THIN = 0.03  # added to extents, in units of the size, as those of a leaf are 0 but for rounding
SALIENCE = 0.45  # of what parts its members: more than half of whoever looks sees one part
AROUND = 16  # number of small pieces nearest to each that are looked at


def find_swarms(area: np.ndarray, center: np.ndarray, extent: np.ndarray, largest: float) -> np.ndarray:
    """Find pieces that are small, alike and near each other.

    Parameters
    ----------
    area : (q,) float64
        Of each piece, at least one.
    center : (q, 3) float64
        Its middle.
    extent : (q, 3) float64
        How far its surface spreads along its principal axes, in units of its size, rising.
    largest : float
        Area of the largest part.

    Returns
    -------
    swarm : (q,) int64
        Number of the swarm that each piece is in; -1 for none.
    """
    swarm = full(len(area), -1)
    small = np.flatnonzero(_are_small(area, largest))
    if len(small) < LEAST:
        return swarm
    size, center, extent = np.sqrt(area[small]), center[small], extent[small]
    _, near = nearest(search_tree(center), center, list(range(1, min(AROUND + 1, len(small)) + 1)))
    a, b = np.repeat(arange(len(small)), near.shape[1]), near.ravel()
    less, more = np.minimum(size[a], size[b]), np.maximum(size[a], size[b])
    apart = distances_between(center, a, b)
    unlike = np.abs(np.log((extent[a] + THIN) / (extent[b] + THIN))).max(axis=1)
    joins = (more <= (1 + TIE) * np.sqrt(ALIKE) * less) & (unlike <= (1 + TIE) * SHAPE)
    joins &= apart <= (1 + TIE) * NEAR * (less + more) / 2
    _, group = components(len(small), a[joins], b[joins])
    many = np.bincount(group)[group] >= LEAST
    swarm[small[many]] = group[many]
    return swarm


def joined_swarms(candidates: FaceCandidates, mesh: TriMesh, polygon: np.ndarray) -> FaceCandidates:
    """Let the members of each swarm that stand alone merge with each other.

    A member stands alone if, at detail 0.5, nothing but members of its swarm is in a part with any of it.

    Parameters
    ----------
    candidates : FaceCandidates
        Of p faces; each candidate is connected by edges, and some may have no face.
    mesh : TriMesh
        m triangles.
    polygon : (m,) int64
        Of the p faces, the one in which each triangle lies.

    Returns
    -------
    candidates : FaceCandidates
        With contacts that link the members, after all others. What merges within a member does so before that. The very
        object that was given if nothing stands alone.
    """
    count, piece = candidates.graph.pieces
    if count <= LEAST:
        return candidates
    of_triangle = piece[polygon]
    area, center = middles_of_each(of_triangle, mesh.face_centroids, mesh.face_area, count)
    part = candidates.parts(0.5)
    largest = np.bincount(part[polygon], mesh.face_area).max()
    extent = _extents(mesh, of_triangle, area, center, _are_small(area, largest))
    swarm = _standing_alone(part, piece, find_swarms(area, center, extent, largest))
    links = _links(area, center, swarm)
    if not len(links):
        return candidates
    face = polygon[nearest_to_middle(of_triangle, mesh.face_centroids, center)[links]]
    hierarchy, label = candidates.hierarchy, candidates.label
    of_candidate = full(hierarchy.n_candidates, -1)
    of_candidate[label] = swarm[piece]
    within = (of_candidate[hierarchy.merges] >= 0).all(axis=1)
    within &= of_candidate[hierarchy.merges[:, 0]] == of_candidate[hierarchy.merges[:, 1]]
    merges = np.concatenate([hierarchy.merges[within], label[face], hierarchy.merges[~within]])
    salience = np.concatenate([np.minimum(hierarchy.salience[within], SALIENCE), np.full(len(links), SALIENCE),
                               hierarchy.salience[~within]])
    order = np.argsort(salience, kind="stable")
    rows = order[Dendrogram.of(hierarchy.n_candidates, merges[order]).rows]
    return replace(candidates, contacts=np.concatenate([candidates.contacts, face]),
                   hierarchy=Hierarchy.of(hierarchy.n_candidates, merges[rows], salience[rows]))


def _are_small(area: np.ndarray, largest: float) -> np.ndarray:
    """Which pieces are small enough for a swarm, (q,) bool. area : (q,) float64. largest : area of the largest part."""
    return (area > 0) & (area <= (1 + TIE) * SMALL * largest)


def _extents(
    mesh: TriMesh, piece: np.ndarray, area: np.ndarray, center: np.ndarray, small: np.ndarray
) -> np.ndarray:
    """How far each small piece spreads along its principal axes, in units of its size, (q, 3) float64; 0 for others.

    piece : (m,) int64, of each triangle. area, small : (q,). center : (q, 3).
    """
    some = np.flatnonzero(small[piece])
    piece, weight = piece[some], mesh.face_area[some] / 12
    # Second moments of a triangle are those of its corners, with a twelfth of the area each, and of its middle, with
    # the rest.
    points = np.concatenate([mesh.corners[some], 3 * mesh.face_centroids[some, None]], axis=1)
    points -= np.array([1.0, 1.0, 1.0, 3.0])[:, None] * center[piece, None]
    moments = np.zeros((len(area), 3, 3))
    for i, j in ((0, 0), (1, 0), (1, 1), (2, 0), (2, 1), (2, 2)):  # the lower half is all that eigvalsh reads
        moments[:, i, j] = np.bincount(piece, weight * (points[:, :, i] * points[:, :, j]).sum(axis=1), len(area))
    # The root of a second moment over the area, in units of the root of the area.
    return np.sqrt(np.maximum(np.linalg.eigvalsh(moments), 0.0)) / np.where(small, area, 1.0)[:, None]


def _standing_alone(part: np.ndarray, piece: np.ndarray, swarm: np.ndarray) -> np.ndarray:
    """The swarm of each piece, (q,) int64; -1 for a piece that is in none, or in a part with what is not in it.

    part, piece : (p,) int64, of each face. swarm : (q,) int64.
    """
    mine = swarm[piece]
    own = full(int(part.max()) + 1, -1)
    own[part] = mine
    mixed = np.zeros(len(own), bool)
    mixed[part[mine != own[part]]] = True
    joined = np.zeros(len(swarm), bool)
    joined[piece[mixed[part]]] = True
    return np.where(joined, -1, swarm)


def _links(area: np.ndarray, center: np.ndarray, swarm: np.ndarray) -> np.ndarray:
    """Each member of a swarm but the largest and the nearest of the larger ones, (l, 2) int64.

    area, swarm : (q,). center : (q, 3).
    """
    links = [np.empty((0, 2), np.int64)]
    for number in np.unique(swarm[swarm >= 0]):
        member = np.flatnonzero(swarm == number)
        links.append(member[nearest_larger(area[member], center[member])])
    return np.concatenate(links)

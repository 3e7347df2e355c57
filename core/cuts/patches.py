# SPDX-License-Identifier: GPL-3.0-or-later
"""Patches that end at creases: what the methods "perceptual" and "liu" start from, and how small ones join others.

Seeds are spread over the faces, each as far as possible from the others, and every face joins its nearest seed. The way
from face to face is longer where the surface turns, and longest where it turns in a concavity. Borders between patches
therefore come to lie in concave creases, where people cut.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from ..arrays.components import roots
from ..arrays.indexing import last_of_each, renumbered
from ..arrays.int64 import arange
from ..arrays.nearest_seeds import nearest_seeds
from ..arrays.pairs import symmetric_matrix
from ..arrays.ties import first_largest, rounded, whole_steps
from ..arrays.vectors import row_products, weighted_sum
from ..mesh.face_graph import FaceGraph
from ..mesh.labels import label_boundaries, longest_neighbor
from ..mesh.triangles import TriMesh

if TYPE_CHECKING:
    from scipy.sparse import csr_array

N_PATCHES = 220  # number of seeds; patches are fewer, as small ones join their neighbors
ROUNDS = 3  # number of rounds in which two thirds of the seeds are added; the first third is spread before
# Length of the way between two faces, in units of the square root of the area: the distance of their centroids across
# the shared edge, plus TURN per radian of a convex turn, or TURN * CONCAVE per radian of a concave turn.
TURN = 0.1
CONCAVE = 20.0
# Ways are measured in whole steps of so much of that unit: a hundredth of most ways, and more than rounding changes
# turns by.
WAY_STEP = 2.0**-14
SMALLEST = 0.0004  # share of the area of the surface below which a patch joins a neighbor


def concave_patches(mesh: TriMesh, count: int = N_PATCHES) -> np.ndarray:
    """Divide a surface into patches that end in concave creases.

    Parameters
    ----------
    mesh : TriMesh
        m faces, one connected component.
    count : int
        Upper bound of the number of patches, 1 or more.

    Returns
    -------
    label : (m,) int64
        Patch of each face, 0..c-1; every patch is connected.

    Notes
    -----
    ROUNDS + 1 searches for shortest paths from all seeds at once, O(m log m) each.
    """
    distances = _crease_graph(mesh)
    seeds = _first_seeds(mesh, max(count // 3, 1))
    # A piece without a seed gets one: the first of its largest faces.
    n_pieces, piece = mesh.face_components
    without = np.setdiff1d(arange(n_pieces), piece[seeds])
    seeds = np.concatenate([seeds, last_of_each(
        piece, mesh.face_area, -arange(mesh.n_faces), count=n_pieces)[without]])
    added = np.diff(np.linspace(len(seeds), max(count, len(seeds)), ROUNDS + 1).astype(np.int64))
    for more in [*added, 0]:
        distance, cell = nearest_seeds(distances, seeds)
        # In each of the widest cells, the face farthest from the seed becomes a seed.
        numbers, cell_number = renumbered(cell)
        farthest = last_of_each(cell_number, distance, -arange(len(cell)), count=len(numbers))
        widest = farthest[np.argsort(-distance[farthest], kind="stable")][:more]
        seeds = np.concatenate([seeds, np.setdiff1d(widest, seeds)])
    return absorb_small(mesh, FaceGraph.of(mesh).regions(cell)[1], SMALLEST)


def absorb_small(mesh: TriMesh, label: np.ndarray, least_share: float) -> np.ndarray:
    """Let small patches join the neighbor with which they share their longest border.

    Parameters
    ----------
    mesh : TriMesh
        m faces.
    label : (m,) int64
        Patch of each face, 0..c-1; every patch is connected.
    least_share : float
        Share of the area below which a patch joins a neighbor that is larger.

    Returns
    -------
    label : (m,) int64
        Patch of each face, numbered anew from 0.
    """
    while True:
        area = rounded(np.bincount(label, mesh.face_area) / mesh.area)
        goal = longest_neighbor(*label_boundaries(label, mesh.edges.pairs, mesh.pair_length), len(area))
        goal = np.where(goal >= 0, goal, arange(len(area)))
        # A patch joins larger patches only, so that two patches never join each other.
        larger = (area[goal] > area) | ((area[goal] == area) & (goal > arange(len(area))))
        goal = np.where((area < least_share) & larger, goal, arange(len(area)))
        if (goal == arange(len(area))).all():
            return label
        label = renumbered(roots(goal)[label])[1]


def _crease_graph(mesh: TriMesh) -> csr_array:
    """Symmetric (m, m) matrix of the lengths of the ways between neighboring faces; TURN has the formula."""
    turn = mesh.dihedral
    length = mesh.pair_distance / np.sqrt(mesh.area) + TURN * np.where(turn < 0, -CONCAVE * turn, turn)
    return symmetric_matrix(mesh.edges.pairs, whole_steps(length, WAY_STEP), mesh.n_faces)


def _first_seeds(mesh: TriMesh, count: int) -> np.ndarray:
    """Faces found by farthest-point sampling with straight distances, (count,) int64 or fewer."""
    center = mesh.face_centroids
    middle = weighted_sum(mesh.face_area, center) / mesh.area
    seeds = [first_largest(_squares(center - middle))]
    nearest = np.full(mesh.n_faces, np.inf)
    while len(seeds) < min(count, mesh.n_faces):
        nearest = np.minimum(nearest, _squares(center - center[seeds[-1]]))
        farthest = first_largest(nearest)
        if nearest[farthest] <= 0:
            break
        seeds.append(farthest)
    return np.array(seeds, np.int64)


def _squares(vectors: np.ndarray) -> np.ndarray:
    """Squares of the lengths of vectors, (n, 3): (n,) float64."""
    return row_products(vectors, vectors)

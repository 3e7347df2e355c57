# SPDX-License-Identifier: GPL-3.0-or-later
"""Patches that stop at creases: the smallest pieces a part can be made of.

Farthest-point seeds and their geodesic cells on the faces, where turning costs, and turning in a
concavity most: borders of patches come to lie in the concave creases where people cut.
"""

from __future__ import annotations

import numpy as np
from scipy.sparse.csgraph import dijkstra

from ...graph.level_sets import LevelSets, cut_at_levels, uniform_levels
from ...surface.arrays import components, first_largest, last_of_each, renumbered, symmetric_matrix
from ...surface.labels import label_boundaries, longest_neighbor, majority
from ...surface.mesh import TriMesh

N_PATCHES = 220
ROUNDS = 3  # a third of the seeds are spread by straight distance, the others in so many rounds
TURN = 0.1  # one radian of convex turning is as far as this share of the square root of the area
CONCAVE = 20.0  # how much more a concave turn costs
SLABS = 24  # where patches are to follow level sets
SMALLEST = 0.0004  # share of the area below which a patch joins a neighbor


def concave_patches(mesh: TriMesh, count: int = N_PATCHES) -> np.ndarray:
    """Cut a connected surface into about ``count`` patches.

    Parameters
    ----------
    mesh : TriMesh
        m faces, one connected component.
    count : int
        At most so many.

    Returns
    -------
    label : (m,) int64
        0..c-1; every patch is connected.
    """
    distances = _crease_graph(mesh)
    seeds = _first_seeds(mesh, max(count // 3, 1))
    added = np.diff(np.linspace(len(seeds), max(count, len(seeds)), ROUNDS + 1).astype(int))
    for more in [*added, 0]:
        distance, _, cell = dijkstra(
            distances, directed=True, indices=seeds, min_only=True, return_predecessors=True)
        # The farthest face of each of the widest cells becomes a seed.
        numbers, cell_number = renumbered(cell)
        farthest = last_of_each(cell_number, distance, -np.arange(len(cell)), count=len(numbers))
        widest = farthest[np.argsort(-distance[farthest], kind="stable")][:more]
        seeds = np.concatenate([seeds, np.setdiff1d(widest, seeds)])
    return absorb_small(mesh, _connected(mesh, cell), SMALLEST * mesh.area)


def level_set_patches(sets: LevelSets) -> np.ndarray:
    """Patches that end at level sets only: pieces of SLABS slabs, (m,) int64 as above."""
    coarse = cut_at_levels(sets.mesh, sets.values, uniform_levels(SLABS))
    area = coarse.element_area + 1e-12 * sets.mesh.area
    piece = majority(coarse.element_face, coarse.element_piece, area, sets.mesh.n_faces)
    return absorb_small(sets.mesh, _connected(sets.mesh, piece), SMALLEST * sets.mesh.area)


def absorb_small(mesh: TriMesh, label: np.ndarray, least_area: float) -> np.ndarray:
    """Let regions below an area join the neighbor along the longest border.

    Parameters
    ----------
    mesh : TriMesh
    label : (m,) int64
        0..c-1; every region is connected.
    least_area : float

    Returns
    -------
    label : (m,) int64
        Numbered anew from 0.
    """
    while True:
        area = np.bincount(label, mesh.face_area)
        goal = longest_neighbor(*label_boundaries(label, mesh.edges.pairs, mesh.pair_length), len(area))
        goal = np.where(goal >= 0, goal, np.arange(len(area)))
        # Only into the larger one, so that no two swap.
        larger = (area[goal] > area) | ((area[goal] == area) & (goal > np.arange(len(area))))
        goal = np.where((area < least_area) & larger, goal, np.arange(len(area)))
        if (goal == np.arange(len(area))).all():
            return label
        while (goal[goal] != goal).any():
            goal = goal[goal]
        label = renumbered(goal[label])[1]


def _crease_graph(mesh: TriMesh):
    """Symmetric (m, m) lengths between faces: way plus turning, which add up along any path."""
    turn = mesh.dihedral
    length = mesh.pair_distance / np.sqrt(mesh.area) + TURN * np.where(turn < 0, -CONCAVE * turn, turn)
    # A stored zero would read as "no edge".
    return symmetric_matrix(mesh.edges.pairs, np.maximum(length, 1e-9), mesh.n_faces)


def _first_seeds(mesh: TriMesh, count: int) -> np.ndarray:
    """Faces far from each other in a straight line."""
    center = mesh.face_centroids
    middle = mesh.face_area @ center / mesh.area
    seeds = [first_largest(((center - middle) ** 2).sum(axis=1))]
    nearest = np.full(mesh.n_faces, np.inf)
    while len(seeds) < min(count, mesh.n_faces):
        nearest = np.minimum(nearest, ((center - center[seeds[-1]]) ** 2).sum(axis=1))
        farthest = first_largest(nearest)
        if nearest[farthest] <= 0:
            break
        seeds.append(farthest)
    return np.array(seeds, np.int64)


def _connected(mesh: TriMesh, cell: np.ndarray) -> np.ndarray:
    """Connected components of cells, numbered by their lowest face."""
    a, b = mesh.edges.pairs[cell[mesh.edges.pairs[:, 0]] == cell[mesh.edges.pairs[:, 1]]].T
    return components(mesh.n_faces, a, b)[1]

# SPDX-License-Identifier: GPL-3.0-or-later
"""Coarser copies of a dense mesh, for fields that are smooth at the scale of its edges.

The average geodesic distance of a million vertices is that of a few thousand, interpolated:
searching paths on a coarse copy makes its cost nearly independent of the size of the mesh.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from .arrays import both_ways, sums_by
from .mesh import TriMesh

SMOOTHING_STEPS = 3  # rounds of averaging that close the seams between cells
_MIX = np.uint64(0x9E3779B97F4A7C15)  # golden ratio, as in splitmix64


@dataclass(frozen=True, eq=False)
class Coarsening:
    """A coarse mesh over an independent set of a mesh's vertices.

    With n fine and c coarse vertices:

    Attributes
    ----------
    mesh : TriMesh
        c vertices. Thin places may lose their triangles, never their links.
    links : (l, 2) int64
        Coarse vertices whose cells touch: the edges of ``mesh`` and more.
    fine_links : (k, 2) int64
        Fine vertices that touch.
    owner : (n,) int64
        The coarse vertex whose cell each fine vertex lies in.
    area : (c,) float64
        Area of the cells.
    """

    mesh: TriMesh
    links: np.ndarray
    fine_links: np.ndarray
    owner: np.ndarray
    area: np.ndarray


def coarsen(
    mesh: TriMesh, vertex_area: np.ndarray, links: np.ndarray | None = None
) -> Coarsening:
    """Keep a maximal independent set of the vertices: about one in four.

    Parameters
    ----------
    mesh : TriMesh
        n vertices, one connected component.
    vertex_area : (n,) float64
    links : (l, 2) int64, optional
        Which vertices touch; the edges of the mesh without.

    Returns
    -------
    coarsening : Coarsening

    Notes
    -----
    O(n + m), whole arrays. The choice hashes the coordinates: it does not depend on the order
    of vertices or faces.
    """
    links = mesh.edges.vertices if links is None else links
    a, b = both_ways(links).T
    order = np.argsort(a, kind="stable")
    a, b = a[order], b[order]
    length = np.linalg.norm(mesh.vertices[a] - mesh.vertices[b], axis=1)
    seed = _independent_set(a, b, _priority(mesh.vertices))
    name = np.where(seed, np.cumsum(seed) - 1, -1)
    owner = name.copy()
    near = seed[b] & ~seed[a]
    by_length = np.lexsort((length[near], a[near]))[::-1]
    owner[a[near][by_length]] = name[b[near][by_length]]  # the last one written is the nearest
    faces = owner[mesh.faces]
    faces = faces[(faces != np.roll(faces, 1, axis=1)).all(axis=1)]
    _, once = np.unique(np.sort(faces, axis=1), axis=0, return_index=True)
    between = np.sort(owner[links], axis=1)
    between = np.unique(between[between[:, 0] != between[:, 1]], axis=0)
    return Coarsening(TriMesh(mesh.vertices[seed], faces[np.sort(once)]), between, links, owner,
                      np.bincount(owner, vertex_area, int(seed.sum())))


class Pyramid:
    """Coarser and coarser copies of one mesh, each made when it is first asked for and then kept.

    Parameters
    ----------
    mesh : TriMesh
        One connected component.
    """

    def __init__(self, mesh: TriMesh):
        self.mesh = mesh
        self._steps: list[Coarsening] = []

    def until(self, coarse_enough: Callable[[TriMesh], bool]) -> list[Coarsening]:
        """The steps from the mesh to the first copy that is coarse enough; none if the mesh itself is."""
        chosen: list[Coarsening] = []
        mesh = self.mesh
        while not coarse_enough(mesh):
            if len(chosen) == len(self._steps):
                last = self._steps[-1] if self._steps else None
                self._steps.append(coarsen(mesh, last.area, last.links) if last else coarsen(mesh, mesh.vertex_area))
            chosen.append(self._steps[len(chosen)])
            mesh = chosen[-1].mesh
        return chosen


def prolong(mesh: TriMesh, coarsening: Coarsening, values: np.ndarray) -> np.ndarray:
    """Bring a smooth field from the coarse vertices to the fine ones.

    A plane is fitted through each coarse vertex and those its cell touches; fine vertices read
    the plane of their cell, and a little averaging closes the seams.

    Parameters
    ----------
    mesh : TriMesh
        The fine mesh, n vertices.
    coarsening : Coarsening
        Of it.
    values : (c,) float64

    Returns
    -------
    fine : (n,) float64
    """
    coarse = coarsening.mesh
    gradient = _gradients(coarse, coarsening.links, values)
    offset = mesh.vertices - coarse.vertices[coarsening.owner]
    fine = values[coarsening.owner] + (gradient[coarsening.owner] * offset).sum(axis=1)
    a, b = coarsening.fine_links.T
    degree = np.bincount(a, minlength=len(fine)) + np.bincount(b, minlength=len(fine))
    for _ in range(SMOOTHING_STEPS):
        around = np.bincount(a, fine[b], len(fine)) + np.bincount(b, fine[a], len(fine))
        fine = 0.5 * fine + 0.5 * around / degree
    return fine


def _gradients(mesh: TriMesh, links: np.ndarray, values: np.ndarray) -> np.ndarray:
    """(c, 3) least-squares gradient of the values over each vertex's linked neighbors."""
    a, b = both_ways(links).T
    step = mesh.vertices[b] - mesh.vertices[a]
    rise = values[b] - values[a]
    weight = 1.0 / np.maximum((step**2).sum(axis=1), np.finfo(float).tiny)
    n = len(values)
    weighted = weight[:, None] * step
    normal = sums_by(a, (weighted[:, :, None] * step[:, None, :]).reshape(-1, 9), n).reshape(n, 3, 3)
    right = sums_by(a, weighted * rise[:, None], n)
    # A flat neighborhood says nothing about the normal direction: damp it to zero.
    damping = 1e-3 * np.trace(normal, axis1=1, axis2=2) + np.finfo(float).tiny
    return np.linalg.solve(normal + damping[:, None, None] * np.eye(3), right[:, :, None])[:, :, 0]


def _priority(points: np.ndarray) -> np.ndarray:
    """(n,) distinct whole numbers that look random and depend on the coordinates alone."""
    bits = (np.ascontiguousarray(points) + 0.0).view(np.uint64)
    mixed = np.zeros(len(points), np.uint64)
    for column in bits.T:
        mixed = (mixed ^ column) * _MIX
        mixed ^= mixed >> np.uint64(29)
    rank = np.empty(len(points), np.int64)
    rank[np.lexsort((*points.T, mixed))] = np.arange(len(points))
    return rank


def _independent_set(a: np.ndarray, b: np.ndarray, priority: np.ndarray) -> np.ndarray:
    """Maximal independent set after [Luby1986]; edges in both directions, sorted by ``a``.

    Returns a mask. A vertex joins when its priority is the highest of the undecided around it.
    """
    n = len(priority)
    chosen = np.zeros(n, bool)
    open_ = np.ones(n, bool)
    start = np.searchsorted(a, np.arange(n))
    while open_.any():
        rivals = np.maximum.reduceat(np.where(open_[b], priority[b], -1), start)
        winner = open_ & (priority > rivals)
        chosen |= winner
        open_ &= ~winner
        open_[b[winner[a]]] = False
    return chosen



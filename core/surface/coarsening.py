# SPDX-License-Identifier: GPL-3.0-or-later
"""Coarser copies of a dense mesh, for fields that are smooth at the scale of its edges.

The average geodesic distance (AGD) at a million vertices can be interpolated from that at a few thousand. If paths
are searched on a coarse copy, the cost of the AGD is nearly independent of the size of the mesh.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from ..arrays.hashes import GOLDEN
from ..arrays.indexing import (
    first_of_rows,
    inverse,
    largest_of_each,
    place_among,
    run_starts,
    stable_order,
    sums_by,
    taken,
)
from ..arrays.int64 import arange, full
from ..arrays.pairs import both_ways
from ..arrays.ties import TIE
from ..arrays.vectors import distances_between, row_products
from ..mesh.triangles import TriMesh
from .ordering import rank_by_place

SLIM = 3.0  # ratio of two lengths of links from which on cells grow along the shorter ones only
MOST_RISE = 4.0  # upper bound of what a value rises within a cell, in units of its largest rise to a neighbor
MOST_LEFT = 0.9  # share of the vertices above which a coarse copy has too many; about 0.25 of them are usual
SMOOTHING_STEPS = 3  # rounds in which ``prolong`` averages neighbors, to close the seams between cells


@dataclass(frozen=True, eq=False)
class Coarsening:
    """A coarse mesh whose vertices are some of the vertices of a fine mesh.

    Every fine vertex belongs to the cell of one coarse vertex: to its own cell, or to that of the nearest coarse vertex
    beside it. With n fine and c coarse vertices:

    Attributes
    ----------
    mesh : TriMesh
        The coarse mesh, c vertices. It may lack triangles where the fine mesh is thin.
    links : (l, 2) int64
        Coarse vertices whose cells touch, also where ``mesh`` lacks triangles: its edges and more.
    fine_links : (k, 2) int64
        Fine vertices that touch: the edges of the fine mesh, or the links of an earlier coarsening.
    owner : (n,) int64
        Coarse vertex in whose cell each fine vertex lies.
    area : (c,) float64
        Area of each cell, in squared units of the vertices.
    """

    mesh: TriMesh
    links: np.ndarray
    fine_links: np.ndarray
    owner: np.ndarray
    area: np.ndarray


def coarsen(
    mesh: TriMesh, vertex_area: np.ndarray, links: np.ndarray | None = None, kept: np.ndarray | None = None
) -> Coarsening:
    """Coarsen a mesh to a maximal independent set of its vertices, about one in four [Luby1986].

    Parameters
    ----------
    mesh : TriMesh
        n vertices, one connected component of m faces.
    vertex_area : (n,) float64
        Area that each vertex stands for, in squared units of the vertices.
    links : (l, 2) int64, optional
        Pairs of vertices that touch. Without it, the edges of the mesh.
    kept : (n,) bool, optional
        Vertices that are all chosen, whatever touches them.

    Returns
    -------
    coarsening : Coarsening

    Notes
    -----
    O(n log n + m), whole arrays. The vertices are chosen by a hash of their rank by place, see ``ordering``: neither
    order nor pose nor scale change the choice.
    """
    links = mesh.edges.vertices if links is None else links
    a, b = both_ways(links).T
    order = stable_order(a)
    a, b = _near(mesh.vertices, a[order], b[order])
    kept = np.zeros(mesh.n_vertices, bool) if kept is None else kept
    seed = _seeds(a, b, _priority(mesh.vertices, vertex_area), kept)
    owner, count = _owners(mesh.vertices, a, b, seed), int(seed.sum())
    p, q, r = owner[mesh.faces.T]
    whole = np.flatnonzero((p != q) & (q != r) & (r != p))
    faces = taken(np.stack([p, q, r], axis=1), whole)
    once = np.sort(first_of_rows(np.sort(faces, axis=1), count))
    p, q = owner[links.T]
    apart = np.flatnonzero(p != q)
    between = taken(np.stack([np.minimum(p, q), np.maximum(p, q)], axis=1), apart)
    between = between[first_of_rows(between, count)]
    return Coarsening(TriMesh(taken(mesh.vertices, seed), taken(faces, once)), between, links, owner,
                      np.bincount(owner, vertex_area, count))


def _owners(points: np.ndarray, a: np.ndarray, b: np.ndarray, seed: np.ndarray) -> np.ndarray:
    """Coarse vertex in whose cell each vertex lies, (n,) int64: of several beside it the nearest.

    seed : (n,) bool, the coarse vertices. a, b : links in both directions, sorted by ``a``.
    """
    name = place_among(np.flatnonzero(seed), len(seed))
    owner = name.copy()
    near = np.flatnonzero(seed[b] & ~seed[a])
    a, b = a[near], b[near]
    length = distances_between(points, a, b)
    start = run_starts(a)
    least = np.minimum.reduceat(length, start) if len(start) else length
    nearest = np.flatnonzero(length <= np.repeat((1 + TIE) * least, np.diff(np.append(start, len(a)))))[::-1]
    owner[a[nearest]] = name[b[nearest]]  # NumPy keeps what is written last: the first of those equally near
    return owner


class Pyramid:
    """Coarser and coarser copies of one mesh, each made when it is first asked for and then kept.

    Parameters
    ----------
    mesh : TriMesh
        Of one component.
    bridges : (l, 2) int64, optional
        Vertices of different pieces between which distances run, too.
    """

    def __init__(self, mesh: TriMesh, bridges: np.ndarray | None = None) -> None:
        self.mesh = mesh
        self.bridges = bridges
        self._steps: list[Coarsening] = []

    def _first_links(self) -> np.ndarray | None:
        """Pairs of vertices between which distances run in the mesh, (e, 2) int64; None where these are its edges."""
        if self.bridges is None or not len(self.bridges):
            return None
        return np.concatenate([self.mesh.edges.vertices, self.bridges])

    def until(self, coarse_enough: Callable[[TriMesh], bool]) -> list[Coarsening]:
        """Coarsen until a copy is coarse enough.

        Parameters
        ----------
        coarse_enough : callable
            Called with a mesh, first with the finest; returns whether to stop there. It must accept a mesh
            without faces.

        Returns
        -------
        steps : list of Coarsening
            From the mesh to the first copy that is coarse enough; empty if the mesh itself is.
        """
        chosen: list[Coarsening] = []
        mesh = self.mesh
        while not coarse_enough(mesh):
            if len(chosen) == len(self._steps):
                last = self._steps[-1] if self._steps else None
                self._steps.append(coarsen(mesh, last.area, last.links) if last else
                                   coarsen(mesh, mesh.vertex_area, self._first_links()))
            chosen.append(self._steps[len(chosen)])
            mesh = chosen[-1].mesh
        return chosen

    def after(self, steps: list[Coarsening]) -> tuple[TriMesh, np.ndarray, np.ndarray | None]:
        """The mesh that some steps lead to, as paths are searched on it.

        steps : as ``until`` returns them. Returns the mesh, the area that each vertex stands for, (n,) float64, and
        pairs of vertices between which distances run besides its edges, (l, 2) int64 or None.
        """
        if not steps:
            return self.mesh, self.mesh.vertex_area, self.bridges
        return steps[-1].mesh, steps[-1].area, steps[-1].links


def prolong(mesh: TriMesh, coarsening: Coarsening, values: np.ndarray) -> np.ndarray:
    """Bring a smooth field from the coarse vertices to the fine ones.

    For every cell, a linear function is fitted to the values at its coarse vertex and at the coarse vertices whose
    cells it touches. Each fine vertex gets the value of its cell's function; SMOOTHING_STEPS rounds of averaging
    with the neighbors then close the seams between cells.

    Parameters
    ----------
    mesh : TriMesh
        The fine mesh, n vertices.
    coarsening : Coarsening
        Made of ``mesh``, c coarse vertices.
    values : (c,) float64
        The field at the coarse vertices, in any unit.

    Returns
    -------
    fine : (n,) float64
        The field at the fine vertices, in the unit of ``values``.
    """
    coarse = coarsening.mesh
    gradient = _gradients(coarse, coarsening.links, values)
    offset = mesh.vertices - taken(coarse.vertices, coarsening.owner)
    # Neighbors almost on a line, of which the cell's vertices are not, do not tell how it rises across.
    most = MOST_RISE * _largest_rise(coarsening.links, values)[coarsening.owner]
    fine = values[coarsening.owner] + np.clip(row_products(taken(gradient, coarsening.owner), offset), -most, most)
    a, b = coarsening.fine_links.T
    degree = np.bincount(a, minlength=len(fine)) + np.bincount(b, minlength=len(fine))
    for _ in range(SMOOTHING_STEPS):
        around = np.bincount(a, fine[b], len(fine)) + np.bincount(b, fine[a], len(fine))
        fine = 0.5 * fine + 0.5 * around / degree
    return fine


def _largest_rise(links: np.ndarray, values: np.ndarray) -> np.ndarray:
    """The largest difference, (c,), of the value at each vertex to those at its linked neighbors."""
    rise = np.abs(values[links[:, 0]] - values[links[:, 1]])
    return largest_of_each(links.ravel(), np.repeat(rise, 2), len(values))


def _gradients(mesh: TriMesh, links: np.ndarray, values: np.ndarray) -> np.ndarray:
    """Least-squares gradient, (c, 3), of the values at each vertex and its linked neighbors."""
    a, b = both_ways(links).T
    step = taken(mesh.vertices, b) - taken(mesh.vertices, a)
    rise = values[b] - values[a]
    weight = 1.0 / np.maximum(row_products(step, step), np.finfo(float).tiny)
    n = len(values)
    weighted = weight[:, None] * step
    normal = sums_by(a, (weighted[:, :, None] * step[:, None, :]).reshape(-1, 9), n).reshape(n, 3, 3)
    right = sums_by(a, weighted * rise[:, None], n)
    # Neighbors in one plane do not determine the gradient across that plane; the damping makes it 0.
    damping = 1e-3 * np.trace(normal, axis1=1, axis2=2) + np.finfo(float).tiny
    return np.linalg.solve(normal + damping[:, None, None] * np.eye(3), right[:, :, None])[:, :, 0]


def _near(points: np.ndarray, a: np.ndarray, b: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """The links that are short for one of their ends; a, b : (k,) int64, in both directions, sorted by ``a``.

    Across needles vertices are much nearer to each other than along them. As in algebraic multigrid, cells grow across
    only, until they are about as wide as long; else the way around a cylinder of many sides would zigzag.
    """
    length = distances_between(points, a, b)
    shortest = np.minimum.reduceat(length, np.searchsorted(a, arange(len(points))))
    short = length <= (1 + TIE) * SLIM * np.maximum(shortest[a], shortest[b])
    return a[short], b[short]


def _priority(points: np.ndarray, weight: np.ndarray) -> np.ndarray:
    """The whole numbers below n, (n,) int64, in an order that looks random: that of a hash of each point's rank."""
    # After the hash splitmix64, with one factor for all of its steps.
    mixed = (rank_by_place(points, weight).astype(np.uint64) + np.uint64(1)) * GOLDEN
    for shift in (30, 27, 31):
        mixed = (mixed ^ (mixed >> np.uint64(shift))) * GOLDEN
    return inverse(np.argsort(mixed, kind="stable"))


def _seeds(a: np.ndarray, b: np.ndarray, priority: np.ndarray, kept: np.ndarray) -> np.ndarray:
    """Mask, (n,) bool, of the vertices of the coarse copy; see ``_independent_set``.

    Of a vertex with thousands of neighbors that have no others, as the ends of an edge on which the pages of a book
    meet, the neighbors would nearly always be chosen, all of them, and one vertex less be left after each coarsening.
    Where so few go, those with the most neighbors are chosen first.
    """
    seed = _independent_set(a, b, priority, kept)
    if (seed & ~kept).sum() > MOST_LEFT * (~kept).sum():
        degree = np.bincount(a, minlength=len(priority))
        seed = _independent_set(a, b, inverse(np.lexsort((priority, degree))), kept)
    return seed


def _independent_set(a: np.ndarray, b: np.ndarray, priority: np.ndarray, kept: np.ndarray) -> np.ndarray:
    """Mask, (n,) bool, of a maximal independent set of vertices after [Luby1986], and those that are kept anyway.

    In each round every undecided vertex joins the set whose priority is higher than that of all undecided
    neighbors. a, b : edges in both directions, sorted by ``a``.
    """
    chosen = kept.copy()
    open_ = ~chosen
    while open_.any():
        both = np.flatnonzero(open_[a] & open_[b])
        a, b = a[both], b[both]
        rivals, start = full(len(priority), -1), run_starts(a)
        if len(start):
            rivals[a[start]] = np.maximum.reduceat(priority[b], start)
        winner = open_ & (priority > rivals)
        chosen |= winner
        open_ &= ~winner
        open_[b[winner[a]]] = False
    return chosen

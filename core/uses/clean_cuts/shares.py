# SPDX-License-Identifier: GPL-3.0-or-later
"""Each part's share of the surface around a vertex, diffused [Merriman1992]."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from scipy.sparse import coo_array, csr_array, diags_array, eye_array

from ...arrays.indexing import last_of_each, sums_by
from ...arrays.int64 import arange
from ...arrays.pairs import distinct_pairs, symmetric_matrix
from ...arrays.vectors import cross, lengths, row_products
from ...mesh.triangles import corner_sides
from ...steps import Steps
from .band import Band
from .pins import Pins

# Cotangents of the angles of needles are kept within the first; where angles are obtuse, the weight of an edge could be
# negative, and shares would not stay between 0 and 1: it is at least the second.
STEEPEST, LEAST_WEIGHT = 10.0, 0.05


@dataclass(frozen=True, eq=False)
class Shares:
    """How much of the surface around each vertex is in each part: an entry for each vertex and part nearby.

    Attributes
    ----------
    n_labels : int
    key : (s,) int64
        Vertex times n_labels plus label, rising.
    value : (s,) float64
    """

    n_labels: int
    key: np.ndarray
    value: np.ndarray

    def of(self, vertex: np.ndarray, label: np.ndarray) -> np.ndarray:
        """Shares of some vertices in some parts, (k,) float64."""
        key = vertex * self.n_labels + label
        place = np.minimum(np.searchsorted(self.key, key), len(self.key) - 1)
        return np.where(self.key[place] == key, self.value[place], 0.0)

    @cached_property
    def top(self) -> np.ndarray:
        """(v,) int64, the label with the largest share at each vertex."""
        vertex, label = np.divmod(self.key, self.n_labels)
        return label[last_of_each(vertex, self.value, -label, count=int(vertex[-1]) + 1)]

    def crossing(self, ends: np.ndarray) -> np.ndarray:
        """Where between two vertices of different parts their shares are equal, (k,) float64 in 0..1.

        ends : (k, 2) int64.
        """
        a, b = self.top[ends].T
        first = self.of(ends[:, 0], a) - self.of(ends[:, 0], b)
        second = self.of(ends[:, 1], b) - self.of(ends[:, 1], a)
        total = first + second
        return np.divide(first, total, out=np.full(len(ends), 0.5), where=total > 0).clip(0.0, 1.0)


@dataclass(frozen=True, eq=False)
class Diffusion:
    """What diffusion starts from, and a step of it, whatever is pinned.

    Attributes
    ----------
    shares : (v, n_labels) csr_array
        Of the faces around each vertex, by area.
    walk : (v, v) csr_array
        One step.
    """

    shares: csr_array
    walk: csr_array

    @classmethod
    def of(cls, band: Band) -> Diffusion:
        """That of a band."""
        triangles, face = band.table.fans()
        a, b, c = band.table.vertices[triangles].transpose(1, 0, 2)
        area = 0.5 * lengths(cross(b - a, c - a))
        area += 1e-6 * area.mean()
        shape = (len(band.vertices), len(band.names))
        label = np.repeat(band.labels[face], 3)
        shares = coo_array((np.repeat(area, 3), (triangles.ravel(), label)), shape=shape).tocsr()
        return cls(_rows_to_one(shares), _walk(band, triangles))


def diffusing(band: Band, diffusion: Diffusion, pins: Pins, steps: int) -> Steps[Shares]:
    """Find the shares after so many steps of diffusion, with the middle of each border where it was; in steps."""
    shape = diffusion.shares.shape
    # What is pinned stays half and half, and nothing diffuses across it.
    moving = np.ones(shape[0])
    moving[pins.vertex] = 0.0
    held = np.repeat(pins.vertex, 2), pins.pair.ravel()
    halves = coo_array((np.full(len(held[0]), 0.5), held), shape=shape).tocsr()
    moving = diags_array(moving).tocsr()
    walk = moving @ diffusion.walk
    shares = moving @ diffusion.shares + halves
    yield 0.5
    for step in range(steps):
        yield 0.5 + 0.4 * step / steps
        shares = walk @ shares + halves
    yield 0.9
    shares.sort_indices()
    vertex = np.repeat(arange(shape[0]), np.diff(shares.indptr))
    key = vertex * shape[1] + shares.indices
    found = Shares(shape[1], key, shares.data)
    return replace(found, value=shares.data + _shifts(band, found)[shares.indices])


def _rows_to_one(matrix: csr_array) -> csr_array:
    """The matrix with each row divided by its sum."""
    total = matrix.sum(axis=1)
    return csr_array((matrix.data / np.repeat(total, np.diff(matrix.indptr)), matrix.indices, matrix.indptr),
                     shape=matrix.shape)


def _walk(band: Band, triangles: np.ndarray) -> csr_array:
    """One step of diffusion, (v, v): to neighbors by the cotangents of the angles that face the edges."""
    ends, u, v = corner_sides(band.table.vertices, triangles)
    across = lengths(cross(u, v))
    cotangent = np.divide(row_products(u, v), across, out=np.zeros(len(u)), where=across > 0)
    n = len(band.vertices)
    matrix = symmetric_matrix(ends, cotangent.clip(-STEEPEST, STEEPEST), n)
    matrix.data = np.maximum(matrix.data, LEAST_WEIGHT)
    return (0.5 * eye_array(n) + 0.5 * _rows_to_one(matrix)).tocsr()


def _shifts(band: Band, shares: Shares) -> np.ndarray:
    """What to add to the shares of each part so that on average they are equal on the borders, (n_labels,)."""
    low, high = band.edge_labels
    cut = np.flatnonzero(low < high)
    ends, length = band.table.edges[cut], band.table.edge_length(cut)
    pairs, pair = distinct_pairs(low[cut], high[cut])
    gap = sum(shares.of(end, low[cut]) - shares.of(end, high[cut]) for end in ends.T) / 2
    total = sums_by(pair, length, len(pairs))
    total[total == 0] = 1.0
    mean = sums_by(pair, length * gap, len(pairs)) / total
    # As nearly as all borders allow, the shorter ones less.
    system = np.zeros((len(pairs), len(band.names)))
    weight = np.sqrt(total / total.max())
    system[arange(len(pairs)), pairs[:, 0]] = -weight
    system[arange(len(pairs)), pairs[:, 1]] = weight
    return np.linalg.lstsq(system, weight * mean, rcond=None)[0]

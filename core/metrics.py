# SPDX-License-Identifier: GPL-3.0-or-later
"""Measures of how far one labeling of a mesh is from another, such as a person's.

================================  =============  ===================================================
measure                           equal gives    reference
================================  =============  ===================================================
``rand_index_error``              0              [Chen2009]; one minus the Rand index
``hamming_distance``              0, 0           [Chen2009]
``consistency_error``             0, 0           Martin et al. 2001, as in [Chen2009]
``cut_discrepancy``               0              [Chen2009]
``agreement``                     1              [Berretti2009], eqs. (10) to (12)
``mean_intersection_over_union``  1              for each region the best match
================================  =============  ===================================================

Labels may be any whole numbers, also such as 2.0; only which faces have equal labels matters. The first labeling is the
one that is judged, the second is the one with which it is compared.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike
from scipy.sparse import coo_array
from scipy.sparse.csgraph import dijkstra

from .arrays.indexing import largest_of_each
from .arrays.pairs import distinct_pairs
from .errors import ParameterError
from .mesh.arguments import numbers, whole_numbers
from .mesh.polygons import normalized
from .mesh.triangles import TriMesh
from .sentence import Sentence


@dataclass(frozen=True, eq=False)
class Overlap:
    """The elements that each region of one labeling shares with each region of another.

    Attributes
    ----------
    pair : (k, 2) int64
        Regions of the first and of the second labeling that share elements, numbered from 0.
    n_elements : (k,) float64
        Number of elements that each pair of regions shares.
    weight : (k,) float64
        Weight of these elements; equal to ``n_elements`` where all elements have the weight 1.
    """

    pair: np.ndarray
    n_elements: np.ndarray
    weight: np.ndarray

    @classmethod
    def of(cls, first: ArrayLike, second: ArrayLike, weight: ArrayLike | None = None) -> Overlap:
        """Find the overlaps of two labelings of one set of elements, faces or vertices.

        Parameters
        ----------
        first, second : (n,) array_like of int
            Region of each element in the first and in the second labeling.
        weight : (n,) array_like of float, optional
            Weight of each element, such as the area of a face; 1 without.

        Returns
        -------
        overlap : Overlap

        Raises
        ------
        ParameterError
            Labels are not whole numbers, there are none, ``first``, ``second`` and ``weight`` are not equally long, a
            weight is negative, no number or infinite, or all weights are 0.
        """
        first, second = _numbered(first), _numbered(second)
        _check_count(len(second), len(first), "second")
        pair, place = distinct_pairs(first, second)
        count = np.bincount(place).astype(np.float64)
        if weight is None:
            return cls(pair, count, count)
        weight = numbers(weight, truth=True)
        weight = np.full(len(first), np.nan) if weight is None else weight.astype(np.float64).ravel()
        _check_count(len(weight), len(first), "weight")
        if not ((weight >= 0).all() and 0 < weight.sum() < np.inf):
            raise ParameterError(Sentence("Weights must be 0 or more, finite, and not all of them 0."), "weight")
        return cls(pair, count, np.bincount(place, weight, len(pair)))

    @property
    def rand_index_error(self) -> float:
        """Share of the pairs of elements that one labeling joins and the other separates."""
        n_pairs = _pairs(self.n_elements.sum())
        in_first, in_second = (_pairs(total).sum() for total in self.totals(self.n_elements))
        split = in_first + in_second - 2 * _pairs(self.n_elements).sum()
        return float(split / n_pairs) if n_pairs else 0.0

    def totals(self, values: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Sum values over the regions of each labeling.

        values : (k,) float64, per pair of regions. Returns the sums for the regions of the first labeling, (r,), and
        for those of the second, (s,).
        """
        first, second = self.pair.T
        return np.bincount(first, values), np.bincount(second, values)

    def largest(self, values: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Find the largest value of each region of each labeling.

        values : (k,) float64, 0 or more, per pair of regions. Returns the largest values for the regions of the first
        labeling, (r,), and for those of the second, (s,).
        """
        first, second = (largest_of_each(region, values, int(region.max()) + 1) for region in self.pair.T)
        return first, second


def rand_index_error(first: ArrayLike, second: ArrayLike) -> float:
    """Share of the pairs of elements that one labeling joins and the other separates.

    One minus the Rand index. All elements have the weight 1, as in the benchmark of [Chen2009]. Symmetric.

    Parameters
    ----------
    first, second : (n,) array_like of int

    Returns
    -------
    error : float
        0 to 1; 0 for a single element, of which there are no pairs.

    Raises
    ------
    ParameterError
        See ``Overlap.of``.
    """
    return Overlap.of(first, second).rand_index_error


def hamming_distance(first: ArrayLike, second: ArrayLike, weight: ArrayLike | None = None) -> tuple[float, float]:
    """Share of the surface outside the best match: missing rate and false alarm rate.

    Their mean is the Hamming distance of [Chen2009], who weigh by the area of the faces. Exchanging the
    labelings exchanges the two rates.

    Parameters
    ----------
    first, second : (n,) array_like of int
    weight : (n,) array_like of float, optional
        Weight of each element; 1 without.

    Returns
    -------
    missing : float
        Rm, 0 to 1: what lies outside the region of ``first`` that shares most with each region of ``second``.
        Large where ``first`` has too many regions.
    false_alarm : float
        Rf, 0 to 1: what lies outside the region of ``second`` that shares most with each region of ``first``.
        Large where ``first`` has too few regions.

    Raises
    ------
    ParameterError
        See ``Overlap.of``.
    """
    overlap = Overlap.of(first, second, weight)
    of_first, of_second = (best.sum() / overlap.weight.sum() for best in overlap.largest(overlap.weight))
    return float(1 - of_second), float(1 - of_first)


def consistency_error(first: ArrayLike, second: ArrayLike, weight: ArrayLike | None = None) -> tuple[float, float]:
    """Global and local consistency error: 0 where one labeling refines the other.

    For each element, the share of its region in one labeling that is outside its region in the other. The
    global error takes the mean over the elements in each direction, and the smaller of the two means; the local
    one takes the smaller at each element. Shares are by weight, the mean is by number of elements, as in the
    program of [Chen2009]. Symmetric.

    Parameters
    ----------
    first, second : (n,) array_like of int
    weight : (n,) array_like of float, optional
        Weight of each element; 1 without.

    Returns
    -------
    global_error, local_error : float
        0 to 1; the local one is never the larger.

    Raises
    ------
    ParameterError
        See ``Overlap.of``.
    """
    overlap = Overlap.of(first, second, weight)
    outside = []
    for total, region in zip(overlap.totals(overlap.weight), overlap.pair.T, strict=True):
        whole = total[region]
        # A region of elements without any weight is a region inside every other.
        inside = np.divide(overlap.weight, whole, out=np.ones(len(whole)), where=whole > 0)
        outside.append(1 - inside)
    share = overlap.n_elements / overlap.n_elements.sum()
    return float(min(one @ share for one in outside)), float(np.minimum(*outside) @ share)


def agreement(first: ArrayLike, second: ArrayLike) -> float:
    """The paper's agreement, eqs. (10) to (12): how well each region matches one of the other labeling.

    The mean over the regions A of ``first`` of the best |A and B| / max(|A|, |B|) over the regions B of ``second``.
    The paper counts vertices; the labels may be of faces as well. Not symmetric.

    Parameters
    ----------
    first, second : (n,) array_like of int

    Returns
    -------
    agreement : float
        Above 0, and 1 for equal labelings.

    Raises
    ------
    ParameterError
        See ``Overlap.of``.
    """
    overlap = Overlap.of(first, second)
    whole = np.stack([total[region] for total, region in
                      zip(overlap.totals(overlap.n_elements), overlap.pair.T, strict=True)])
    return float(overlap.largest(overlap.n_elements / whole.max(axis=0))[0].mean())


def mean_intersection_over_union(first: ArrayLike, second: ArrayLike, weight: ArrayLike | None = None) -> float:
    """Mean over the regions B of ``second`` of the best |A and B| / |A or B| over the regions A of ``first``.

    Not symmetric: each region of the labeling that is compared with looks for its best match.

    Parameters
    ----------
    first, second : (n,) array_like of int
    weight : (n,) array_like of float, optional
        Weight of each element; 1 without. Regions without any weight do not count.

    Returns
    -------
    mean : float
        Above 0, and 1 for equal labelings.

    Raises
    ------
    ParameterError
        See ``Overlap.of``.
    """
    overlap = Overlap.of(first, second, weight)
    of_first, of_second = overlap.totals(overlap.weight)
    a, b = overlap.pair.T
    union = of_first[a] + of_second[b] - overlap.weight
    ratio = np.divide(overlap.weight, union, out=np.zeros(len(union)), where=union > 0)
    return float(overlap.largest(ratio)[1][of_second > 0].mean())


def cut_discrepancy(mesh: Any, first: ArrayLike, second: ArrayLike) -> float:
    """Mean distance along edges from the cuts of each labeling to those of the other, by the size of the mesh.

    Cuts are the edges between faces of different labels. The mean is over the ends of the cuts of both labelings,
    each end once per labeling; the unit is the mean distance of the surface from its centroid. Symmetric.

    Parameters
    ----------
    mesh : TriMesh, or what another library calls a mesh
        With ``vertices`` and m ``faces``, triangles.
    first, second : (m,) array_like of int
        Labels of the faces.

    Returns
    -------
    discrepancy : float
        0 or more. NaN where a labeling has no cut, or no cut can be reached from any of the other's, or the mesh has
        no area; ends from which none can be reached do not count.

    Raises
    ------
    ParameterError
        The labels are no whole numbers, or not one for each face.
    MeshError
        There is no mesh, or its arrays are wrong.

    Notes
    -----
    One search by Dijkstra's algorithm from all cuts of each labeling: O(n log n) time for n vertices.
    """
    mesh, _ = normalized(TriMesh.of(mesh))
    first, second = _numbered(first), _numbered(second)
    for label in (first, second):
        _check_count(len(label), mesh.n_faces, "labels")
    graph = coo_array((mesh.edge_length, mesh.edges.vertices.T), shape=(mesh.n_vertices, mesh.n_vertices)).tocsr()
    ends = [_cut_ends(mesh, label) for label in (first, second)]
    if not all(map(len, ends)) or not mesh.area > 0:
        return float("nan")
    distance = np.concatenate([
        dijkstra(graph, directed=False, indices=goal, min_only=True)[start] for start, goal in (ends, ends[::-1])])
    distance = distance[np.isfinite(distance)]
    share = mesh.face_area / mesh.area
    radius = share @ np.linalg.norm(mesh.face_centroids - share @ mesh.face_centroids, axis=1)
    return float(distance.mean() / radius) if len(distance) else float("nan")


def _cut_ends(mesh: TriMesh, label: np.ndarray) -> np.ndarray:
    """Vertices of the edges between faces of different labels, (k,), rising."""
    left, right = label[mesh.edges.pairs].T
    return np.unique(mesh.edges.vertices[mesh.edges.pair_edge[left != right]])


def _pairs(count: np.ndarray) -> np.ndarray:
    """Number of pairs among ``count`` elements, of the shape of ``count``."""
    return count * (count - 1.0) / 2


def _numbered(labels: Any) -> np.ndarray:
    """Labels renumbered to 0..k-1, (n,); ParameterError if they are not whole numbers or there are none."""
    row = numbers(labels)
    if row is not None and row.dtype.kind == "f":  # as NumPy reads them from a text
        row = whole_numbers(row)
    if row is None or row.ndim != 1 or not row.size:
        try:
            given = np.asarray(labels)
        except ValueError:  # rows of different lengths
            given = np.empty(len(labels), object)
        kind = f"masked {given.dtype}" if np.ma.is_masked(labels) else given.dtype
        raise ParameterError(
            Sentence("Labels must be a row of whole numbers, at least one, not {type} of shape {shape}.",
                     type=kind, shape=given.shape), "labels")
    return np.unique(row, return_inverse=True)[1].reshape(-1).astype(np.int64)


def _check_count(n: int, total: int, name: str) -> None:
    """Raise ParameterError if there are not as many values as elements."""
    if n != total:
        raise ParameterError(
            Sentence("There are {n} values for {total} elements: each needs one.", n=n, total=total), name)

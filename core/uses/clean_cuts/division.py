# SPDX-License-Identifier: GPL-3.0-or-later
"""Faces divided where curves run."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from ...arrays.indexing import begins_run, expanded, inverse, stable_order
from ...arrays.int64 import arange, cumsum
from ...mesh.corners import CornerTable, next_of_owner
from ...mesh.labels import majority
from .band import Band
from .sides import Sides


@dataclass(frozen=True, eq=False)
class Division:
    """The outlines of the faces taken apart where a curve enters or leaves a face.

    A portion is a stretch of an outline from one point to the next: from corner to corner, or to a crossed edge's
    point. Points have numbers: 0..v-1 are the vertices, v + e is the point on edge e, v + e + f that inside face f.

    Attributes
    ----------
    face : (o,) int64
        Face of each portion, rising.
    point : (o,) int64
        Where the portion begins; it ends where the next one of its face does.
    side : (o,) int64
        Edge and half of it, the same for the portions of the faces that meet there.
    label : (o,) int64
        Part on the side of the face.
    begins : (o,) bool
        Whether the fragment of the face that the portion is part of begins here.
    fragment : (o,) int64
        Which fragment, in the order of where they begin.
    odd : (f,) bool
        Faces that have to be triangles before they can be divided.
    """

    face: np.ndarray
    point: np.ndarray
    side: np.ndarray
    label: np.ndarray
    begins: np.ndarray
    fragment: np.ndarray
    odd: np.ndarray

    @cached_property
    def n_fragments(self) -> np.ndarray:
        """(f,) int64, how many fragments each face is divided into; 1 for one that stays whole."""
        return np.bincount(self.face[self.begins], minlength=len(self.odd))

    def concerned(self, labels: np.ndarray) -> np.ndarray:
        """Which faces are divided or change their part, (f,) bool. labels : (f,) int64, the part of each before."""
        found = self.n_fragments > 1
        found[self.face[self.label != labels[self.face]]] = True
        return found

    @cached_property
    def beside(self) -> tuple[np.ndarray, np.ndarray]:
        """Portions of two faces that are the two sides of the same stretch, two (k,) int64."""
        order = stable_order(self.side)
        same = self.side[order[1:]] == self.side[order[:-1]]
        return order[:-1][same], order[1:][same]


def divide(band: Band, sides: Sides) -> Division:
    """Divide the faces by the sides that their corners are on."""
    face, point, side, low, high = _portions(band, sides)
    label = _decided(band, face, low, high)
    following = next_of_owner(face)
    changes = label != label[inverse(following)]
    count = np.bincount(face[changes], minlength=len(band.faces))
    # A fragment that is one portion only would lie between the portion and itself: the face stays whole.
    thin = changes & changes[following]
    slim = (count == 2) & (np.bincount(face[thin], minlength=len(count)) > 0)
    odd = (count > 1) & ~slim & (band.n_corners > 3) & (~band.convex | (count > 3))
    whole = slim | odd | (count > 3)
    label = np.where(whole[face], _most(band, face, label, len(count))[face], label)
    changes &= ~whole[face]
    # A face that stays whole is one fragment, which begins where the face does.
    begins = changes | (begins_run(face) & (np.bincount(face[changes], minlength=len(count)) == 0)[face])
    last = np.searchsorted(face[begins], arange(len(count)), side="right") - 1
    fragment = cumsum(begins) - 1
    wrapped = (fragment < 0) | (face[np.flatnonzero(begins)[fragment]] != face)
    return Division(face, point, side, label, begins, np.where(wrapped, last[face], fragment), odd)


def _portions(band: Band, sides: Sides) -> tuple[np.ndarray, ...]:
    """Face, first point, side and the one or two labels, the lower first, of each portion, (o,) int64 each."""
    table, crossed = band.table, ~np.isnan(sides.share)
    corner, beyond, point, side = portions(table, arange(len(table.corner_face)), crossed)
    here, there = table.corner_vertex[corner], table.corner_vertex[table.next_corner[corner]]
    cut = crossed[table.corner_edge[corner]]
    low_here, high_here, low_there, high_there = sides.low[here], sides.high[here], sides.low[there], sides.high[there]
    first_common = (low_here == low_there) | (low_here == high_there)
    second_common = (high_here == low_there) | (high_here == high_there)
    low = np.where(beyond, low_there, np.where(cut | first_common, low_here, high_here))
    high = np.where(beyond, high_there, np.where(cut | second_common, high_here, low_here))
    return tuple(column.astype(np.int64) for column in (table.corner_face[corner], point, side, low, high))


def portions(
    table: CornerTable, corner: np.ndarray, crossed: np.ndarray
) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """Take outlines of faces apart into portions, see ``Division``.

    Parameters
    ----------
    table : CornerTable
    corner : (k,) int64
        Corners from which the outlines go to the next ones.
    crossed : (e,) bool
        Edges that have a point, which divides them in two portions.

    Returns
    -------
    corner : (o,) int64
        That each portion lies behind; in the given order, the portions behind one corner next to each other.
    beyond : (o,) bool
        Whether it is the second behind its corner, and begins at the point of the edge.
    point, side : (o,) int64
        See ``Division``.
    """
    row, beyond = expanded(np.zeros(len(corner), np.int64), 1 + crossed[table.corner_edge[corner]])
    corner, beyond = corner[row], beyond > 0
    vertex, edge = (each[corner].astype(np.int64) for each in (table.corner_vertex, table.corner_edge))
    half = crossed[edge] & (beyond == (table.edges[edge, 0] == vertex))
    return corner, beyond, np.where(beyond, len(table.vertices) + edge, vertex), 2 * edge + half


def _decided(band: Band, face: np.ndarray, low: np.ndarray, high: np.ndarray) -> np.ndarray:
    """One label for each portion: along a curve that of two which more of the face's other portions have, (o,)."""
    open_ = low < high
    if not open_.any():
        return low
    asked = np.flatnonzero(open_)
    here = np.zeros(len(band.faces), bool)
    here[face[asked]] = True
    others = np.flatnonzero(here[face] & ~open_)
    width = len(band.names)
    key, count = np.unique(face[others] * width + low[others], return_counts=True)

    def number(label: np.ndarray) -> np.ndarray:
        wanted = face[asked] * width + label
        place = np.minimum(np.searchsorted(key, wanted), max(len(key) - 1, 0))
        own = 0.5 * (band.labels[face[asked]] == label)  # of equal ones, what the face was before
        return own + (np.where(key[place] == wanted, count[place], 0) if len(key) else 0)

    label = low.copy()
    label[asked] = np.where(number(high[asked]) > number(low[asked]), high[asked], low[asked])
    return label


def _most(band: Band, face: np.ndarray, label: np.ndarray, n_faces: int) -> np.ndarray:
    """The label of most portions of each face, of equal ones that of the face before, (f,) int64."""
    own = 0.5 * (label == band.labels[face]) / np.maximum(np.bincount(face, minlength=n_faces), 1)[face]
    return majority(face, label, 1.0 + own, n_faces)

# SPDX-License-Identifier: GPL-3.0-or-later
"""The elements of a mesh with all that they carry, as arrays: some of the faces taken, or others put on.

Blender keeps the order of elements when faces are deleted, and so does what is here. A million vertices take tenths of
a second, where a BMesh takes many seconds.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np

from ...core.arrays.indexing import ranges
from ...core.arrays.int64 import arange, cumsum
from ...core.mesh.corners import CornerTable
from ...core.surface.orientation import looks_inwards, of_solids

POINT, EDGE, FACE, CORNER = "POINT", "EDGE", "FACE", "CORNER"


@dataclass(frozen=True, eq=False)
class Ragged:
    """Lists of items, one for each element.

    Attributes
    ----------
    count : (n,) int64
        Length of each list.
    items : (sum of count,) array
        One list after the other.
    """

    count: np.ndarray
    items: np.ndarray

    def __len__(self) -> int:
        return len(self.count)


Values = Any  # an array or Ragged


@dataclass(frozen=True, eq=False)
class Layer:
    """Something that all elements of a domain carry.

    Attributes
    ----------
    kind : str
        A type of Blender's attributes, or one of element_layers.SPECIAL.
    domain : str
    values : (n,) or (n, k) array, or Ragged
    """

    kind: str
    domain: str
    values: Values


@dataclass(frozen=True, eq=False)
class Selection:
    """Some faces of a mesh, and what belongs to them; indices, (k,) int64 each.

    Attributes
    ----------
    vertices, edges : (v,), (e,) int64
        Rising.
    faces : (f,) int64
        In any order.
    corners : (c,) int64
        Those of the first face, then those of the second ...
    """

    vertices: np.ndarray
    edges: np.ndarray
    faces: np.ndarray
    corners: np.ndarray

    def of(self, domain: str) -> np.ndarray:
        """The indices of a domain."""
        return {POINT: self.vertices, EDGE: self.edges, FACE: self.faces, CORNER: self.corners}[domain]


@dataclass(frozen=True, eq=False)
class Elements:
    """The elements of a mesh: v vertices, e edges, f faces, c corners.

    Attributes
    ----------
    ends : (e, 2) int32
        Vertices of each edge.
    count : (f,) int32
        Number of corners of each face.
    corner_vertex, corner_edge : (c,) int32
        Vertex of each corner, and the edge from there to the next one of its face.
    layers : dict of str -> Layer
        What they carry. "position" is one of them.
    """

    ends: np.ndarray
    count: np.ndarray
    corner_vertex: np.ndarray
    corner_edge: np.ndarray
    layers: dict[str, Layer]

    @property
    def points(self) -> np.ndarray:
        """(v, 3) float32."""
        return self.layers["position"].values

    @cached_property
    def corner_face(self) -> np.ndarray:
        """Face of each corner, (c,) int32."""
        return np.repeat(np.arange(len(self.count), dtype=np.int32), self.count)

    def size(self, domain: str) -> int:
        """Number of elements of a domain."""
        return len({POINT: self.points, EDGE: self.ends, FACE: self.count, CORNER: self.corner_vertex}[domain])

    def corner_table(self) -> CornerTable:
        """The faces corner by corner, for core."""
        return CornerTable(self.points.astype(np.float64), self.ends, self.corner_vertex, self.corner_edge,
                           self.corner_face, len(self.count))

    @cached_property
    def _of_solids(self) -> np.ndarray:
        """(f,) bool, the faces of closed pieces that look outwards."""
        return of_solids(self.corner_table())

    def is_inside_out(self, piece: CornerTable, faces: np.ndarray) -> bool:
        """Whether a piece that was made of some faces, (k,) int64, and closed looks inwards, and did not look outwards.

        The inside of a wall that is a part of its own looks inwards, too, but so that the wall looks outwards.
        """
        return looks_inwards(piece) and not self._of_solids[faces].any()

    def around(self, vertices: np.ndarray) -> np.ndarray:
        """Faces with one of some vertices, (v,) bool: (k,) int64, rising."""
        return np.unique(self.corner_face[vertices[self.corner_vertex]]).astype(np.int64)

    def selection(self, faces: np.ndarray) -> Selection:
        """Some faces, (k,) int64, and all that belongs to them."""
        count = self.count[faces].astype(np.int64)
        first = (cumsum(self.count) - self.count)[faces]
        corners = ranges(first, count)
        return Selection(_used(self.corner_vertex[corners], len(self.points)),
                         _used(self.corner_edge[corners], len(self.ends)), faces, corners)

    def taken(self, chosen: Selection) -> Elements:
        """The elements that were chosen, with what they carry."""
        all_of = {domain: len(chosen.of(domain)) == self.size(domain) for domain in (POINT, EDGE)}
        layers = {name: layer if all_of.get(layer.domain) else
                  replace(layer, values=take(layer.values, chosen.of(layer.domain)))
                  for name, layer in self.layers.items()}
        ends = self.ends if all_of[EDGE] else self.ends[chosen.edges]
        vertex, edge = np.take(self.corner_vertex, chosen.corners), np.take(self.corner_edge, chosen.corners)
        if not all_of[POINT]:
            number = _numbers(chosen.vertices, len(self.points))
            ends, vertex = number[ends], number[vertex]
        if not all_of[EDGE]:
            edge = _numbers(chosen.edges, len(self.ends))[edge]
        return Elements(ends, self.count[chosen.faces], vertex, edge, layers)

    def grafted(self, other: Elements, vertices: np.ndarray, edges: np.ndarray, n_faces: int) -> Elements:
        """These elements, and those of another mesh that are new there, at the end.

        Parameters
        ----------
        other : Elements
        vertices, edges : (k,), (m,) int64
            The first k vertices and m edges of the other mesh are these; the edges may have other ends there.
        n_faces : int
            So many of the first faces of the other mesh are left out.
        """
        kept = {POINT: len(vertices), EDGE: len(edges), FACE: n_faces, CORNER: int(other.count[:n_faces].sum())}
        vertex = _continued(vertices, len(self.points), len(other.points))
        edge = _continued(edges, len(self.ends), len(other.ends))
        ends = np.concatenate([self.ends, vertex[other.ends[len(edges) :]]])
        ends[edges] = vertex[other.ends[: len(edges)]]
        layers = {name: self._extended(name, other, kept) for name in {**self.layers, **other.layers}}
        return Elements(
            ends, np.concatenate([self.count, other.count[n_faces:]]),
            np.concatenate([self.corner_vertex, vertex[other.corner_vertex[kept[CORNER] :]]]),
            np.concatenate([self.corner_edge, edge[other.corner_edge[kept[CORNER] :]]]), layers)

    def _extended(self, name: str, other: Elements, kept: dict[str, int]) -> Layer:
        """A layer with what is new in another mesh; where one of the two lacks it, its elements have nothing."""
        mine, theirs = self.layers.get(name), other.layers.get(name)
        layer = mine or theirs
        assert layer is not None
        first = mine.values if mine else _nothing(layer.values, self.size(layer.domain))
        same = theirs and (theirs.kind, theirs.domain) == (layer.kind, layer.domain)
        number = other.size(layer.domain)
        second = theirs.values if theirs and same else _nothing(layer.values, number)
        return replace(layer, values=_concatenated(first, take(second, arange(kept[layer.domain], number))))

    def turned(self, faces: np.ndarray) -> Elements:
        """Elements with some faces, (f,) bool, turned over; what their corners carry goes along."""
        count = self.count.astype(np.int64)
        first, n = np.repeat(cumsum(count) - count, count), np.repeat(count, count)
        corner = arange(len(n))
        turns, place = faces[self.corner_face], corner - first
        order = np.where(turns, first + (n - place) % n, corner)  # the first corner stays the first
        edge = np.where(turns, first + n - 1 - place, corner)
        layers = {name: replace(layer, values=take(layer.values, order)) if layer.domain == CORNER else layer
                  for name, layer in self.layers.items()}
        return Elements(self.ends, self.count, self.corner_vertex[order], self.corner_edge[edge], layers)

    def with_layer(self, name: str, layer: Layer) -> Elements:
        """Elements with one layer more, or another of that name."""
        return replace(self, layers={**self.layers, name: layer})

    def without_layer(self, name: str) -> Elements:
        """Elements without the layer of a name, if there is one."""
        return replace(self, layers={other: layer for other, layer in self.layers.items() if other != name})


def _used(indices: np.ndarray, count: int) -> np.ndarray:
    """Which of so many numbers there are, rising, (k,) int64."""
    used = np.zeros(count, bool)
    used[indices] = True
    return np.flatnonzero(used)


def _numbers(chosen: np.ndarray, count: int) -> np.ndarray:
    """The place of each that was chosen among those that were, (count,) int32; of others anything."""
    place = np.empty(count, np.int32)
    place[chosen] = np.arange(len(chosen), dtype=np.int32)
    return place


def _continued(known: np.ndarray, count: int, number: int) -> np.ndarray:
    """The new numbers of so many elements, of which the first are known ones of ``count`` others, (number,) int32."""
    return np.concatenate([known, count + arange(number - len(known))]).astype(np.int32)


def take(values: Values, index: np.ndarray) -> Values:
    """The values of some elements. index : (k,) int64."""
    if isinstance(values, np.ndarray):
        return np.take(values, index, axis=0)
    count = values.count[index]
    first = (cumsum(values.count) - values.count)[index]
    return Ragged(count, values.items[ranges(first, count)])


def _nothing(like: Values, count: int) -> Values:
    """Values of the same type that Blender gives where there are none."""
    if isinstance(like, Ragged):
        return Ragged(np.zeros(count, np.int64), like.items[:0])
    return np.zeros((count, *like.shape[1:]), like.dtype)


def _concatenated(first: Values, second: Values) -> Values:
    if isinstance(first, Ragged):
        assert isinstance(second, Ragged)
        return Ragged(np.concatenate([first.count, second.count]), np.concatenate([first.items, second.items]))
    return np.concatenate([first, second])

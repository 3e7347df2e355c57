# SPDX-License-Identifier: GPL-3.0-or-later
"""New vertices of caps, and what they have of those around them: shapes, weights, colors."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import bmesh
import numpy as np
from bmesh.types import BMesh, BMVert
from mathutils import Vector

from ....core.arrays.int64 import cumsum

if TYPE_CHECKING:
    from .disc import Disc


def inner_vertices(bm: BMesh, rim: list[BMVert], disc: Disc) -> list[BMVert]:
    """New vertices inside a surface, which have what those of its rim have, smoothly."""
    made = [bm.verts.new(place) for place in disc.places.tolist()]
    if not made:
        return made
    layers = bm.verts.layers
    shapes, numbers = layers.shape.values(), layers.float.values()
    several = [layer for kind in ("float_vector", "float_color", "color") for layer in getattr(layers, kind).values()]
    # All at once, which takes hardly longer than one.
    found = _spread_each(disc, [_values(rim, layer) for layer in (*shapes, *several)]
                         + [np.array([[vertex[layer]] for vertex in rim]) for layer in numbers]
                         + [_values(rim, "co") for _ in shapes[:1]])
    for layer, values in zip(shapes, found, strict=False):
        _set(made, layer, values + (disc.places - found[-1]))
    for layer, values in zip(several, found[len(shapes):], strict=False):
        _set(made, layer, values)
    for layer, values in zip(numbers, found[len(shapes) + len(several):], strict=False):
        _set(made, layer, values[:, 0])
    if deform := bm.verts.layers.deform.active:
        _spread_weights(made, rim, disc, deform)
    return made


def between(bm: BMesh, vertices: Sequence[BMVert], share: np.ndarray) -> BMVert:
    """A new vertex that is what others are on average. share : (k,) float64, of each of them, 1 together."""
    middle = bm.verts.new()
    middle.copy_from_vert_interp([vertices[0], vertices[len(vertices) // 2]], 0.5)
    middle.co = share @ np.array([vertex.co[:] for vertex in vertices])
    for layer in bm.verts.layers.shape.values():
        middle[layer] = share @ np.array([vertex[layer][:] for vertex in vertices])
    if deform := bm.verts.layers.deform.active:
        sums: dict[int, float] = {}
        for vertex, part in zip(vertices, share.tolist(), strict=True):
            for group, value in vertex[deform].items():
                sums[group] = sums.get(group, 0.0) + part * value
        middle[deform].clear()
        for group, value in sums.items():
            middle[deform][group] = value
    return middle


def moved_to(bm: BMesh, vertex: BMVert, place: np.ndarray) -> BMVert:
    """The vertex, moved to a place in all shapes."""
    moved = Vector(place) - vertex.co
    vertex.co = place
    for layer in bm.verts.layers.shape.values():
        vertex[layer] += moved
    return vertex


def _spread_each(disc: Disc, values: list[np.ndarray]) -> list[np.ndarray]:
    """What the points inside have of each of some values, see Disc.spread."""
    if not values:
        return []
    ends = cumsum([some.shape[1] for some in values])[:-1]
    return np.split(disc.spread(np.concatenate(values, axis=1)), ends, axis=1)


def _values(rim: list[BMVert], layer: bmesh.types.BMLayerItem | str) -> np.ndarray:
    """What the vertices of a rim have in a layer of several numbers, (k, c) float64."""
    return np.array([vertex.co[:] if layer == "co" else vertex[layer][:] for vertex in rim], np.float64)


def _set(vertices: list[BMVert], layer: bmesh.types.BMLayerItem, values: np.ndarray) -> None:
    for vertex, value in zip(vertices, values.tolist(), strict=True):
        vertex[layer] = value


def _spread_weights(made: list[BMVert], rim: list[BMVert], disc: Disc, deform: bmesh.types.BMLayerItem) -> None:
    """Give the vertices inside a surface weights between those of its rim."""
    groups = sorted({group for v in rim for group in v[deform].keys()})
    if not groups:
        return
    weights = disc.spread(np.array([[v[deform].get(group, 0.0) for group in groups] for v in rim]))
    for vertex, values in zip(made, weights.tolist(), strict=True):
        for group, weight in zip(groups, values, strict=True):
            if weight > 0:
                vertex[deform][group] = min(weight, 1.0)

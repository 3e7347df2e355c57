# SPDX-License-Identifier: GPL-3.0-or-later
"""Border vertices that are one for Decompose made one, so that what is cut there can be closed.

Files keep vertices apart at seams of textures and normals. Blender keeps both by corner, so that nothing is lost where
all else that the vertices carry is the same; elsewhere they stay apart.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ...core.arrays.hashes import hashed_sets
from ...core.arrays.indexing import inverse
from ...core.arrays.int64 import arange, cumsum
from ...core.arrays.pairs import distinct_pairs, repeated_in
from ...core.arrays.vectors import box_diagonal
from ...core.mesh.borders import GAP
from ...core.mesh.corners import next_of_owner
from ..reading import element_layers
from ..reading.elements import EDGE, FACE, POINT, Elements, Layer, Ragged, Values, take

SHARP, FLAT = "sharp_edge", "sharp_face"  # Blender's own
_UNLIKE = 1e-3  # by how much normals differ that are not one for the eye


def border_twins(whole: Elements) -> np.ndarray:
    """The vertex that each vertex is one with for Decompose, itself for most, (v,) int64."""
    return whole.corner_table().joined()[1]


def welded(whole: Elements, normals: np.ndarray | None = None) -> tuple[Elements, np.ndarray]:
    """Make one vertex of border vertices that are one for Decompose; faces and corners stay in their places.

    Parameters
    ----------
    whole : Elements
    normals : (c, 3) float32, optional
        Of the corners, where a layer keeps them. Edges where they differ across a seam become sharp: Blender would
        give both sides their mean if they differ little. Without, all edges of seams between smooth faces become sharp.
        So faces look as before.

    Returns
    -------
    welded : Elements
    apart : (k,) int64
        Vertices given that lie on others and still have to stay apart: they differ in what they carry, or there would
        be faces twice, faces with a corner twice, or edges of more than two faces.
    """
    twin = border_twins(whole)
    own = arange(len(twin))
    moved = np.flatnonzero(twin != own)
    if not len(moved):
        return whole, moved
    first = twin.copy()
    apart = moved[_differ(whole, moved, twin[moved])]
    first[apart] = apart
    while (wrong := _wrong(whole, first)).any():
        first = np.where(wrong[first], own, first)
    return _merged(whole, first, normals), moved[first[moved] == moved]


def _differ(whole: Elements, some: np.ndarray, others: np.ndarray) -> np.ndarray:
    """Whether vertices differ from others in what they carry, (k,) bool. some, others : (k,) int64."""
    found = np.zeros(len(some), bool)
    points = whole.points
    slack = GAP * box_diagonal(points)
    for name, layer in whole.layers.items():
        if layer.domain != POINT or name == "position" or name.startswith(element_layers.PASSING):
            continue
        values = layer.values
        if layer.kind == element_layers.KEY:
            shift = values - points
            found |= (np.abs(shift[some] - shift[others]) > slack).any(axis=1)
        else:
            found |= _unlike(values, some, others)
    return found


def _unlike(values: Values, some: np.ndarray, others: np.ndarray) -> np.ndarray:
    """Whether elements have other values than others, (k,) bool; the order of lists does not count."""
    if not isinstance(values, Ragged):
        return (values[some] != values[others]).reshape(len(some), -1).any(axis=1)
    owner = np.repeat(arange(len(values)), values.count)
    # Lists of as many items are the same if the sorted items are.
    names = values.items.dtype.names or ()
    items = values.items[np.lexsort((*(values.items[name] for name in reversed(names)), owner))]
    start = cumsum(values.count) - values.count
    found = values.count[some] != values.count[others]
    for place in range(int(values.count[some].max(initial=0))):
        here = np.flatnonzero(~found & (values.count[some] > place))
        found[here] = items[start[some[here]] + place] != items[start[others[here]] + place]
    return found


def _wrong(whole: Elements, first: np.ndarray) -> np.ndarray:
    """Vertices to which others cannot be welded, (v,) bool; ``first`` : (v,) int64, what each would be."""
    wrong, receives = np.zeros(len(first), bool), np.zeros(len(first), bool)
    receives[first[first != arange(len(first))]] = True
    vertex, face = first[whole.corner_vertex], whole.corner_face
    wrong[repeated_in(face, vertex, count=len(first))] = True
    edges, number = distinct_pairs(*np.sort(first[whole.ends], axis=1).T)
    crowded = np.bincount(number[whole.corner_edge], minlength=len(edges)) > 2
    wrong[edges[crowded]] = True
    _, place, n_faces = np.unique(hashed_sets(face, vertex, len(whole.count)), return_inverse=True, return_counts=True)
    wrong[vertex[(n_faces[place.ravel()] > 1)[face]]] = True
    return wrong & receives


def _merged(whole: Elements, first: np.ndarray, normals: np.ndarray | None) -> Elements:
    """The elements with each vertex replaced. first : (v,) int64. normals : as of ``welded``."""
    kept = np.flatnonzero(first == arange(len(first)))
    vertex = (cumsum(first == arange(len(first))) - 1)[first].astype(np.int32)
    _, number = distinct_pairs(*np.sort(vertex[whole.ends], axis=1).T)
    _, edges = np.unique(number, return_index=True)
    order = np.argsort(edges)  # as they were
    edges, number = edges[order], inverse(order)[number]
    layers = {}
    for name, layer in whole.layers.items():
        if layer.domain == POINT:
            layers[name] = replace(layer, values=take(layer.values, kept))
        elif layer.domain == EDGE:
            layers[name] = replace(layer, values=_of_edges(layer.values, edges, number))
        else:
            layers[name] = layer
    now = Elements(vertex[whole.ends[edges]], whole.count, vertex[whole.corner_vertex],
                   number[whole.corner_edge].astype(np.int32), layers)
    sharp = (np.bincount(number) > 1) & _between_smooth(now)
    if normals is not None:
        sharp = _normals_differ(now, sharp, normals)
    if not sharp.any():
        return now
    return now.with_layer(SHARP, Layer("BOOLEAN", EDGE, sharp | (layers[SHARP].values if SHARP in layers else False)))


def _between_smooth(whole: Elements) -> np.ndarray:
    """Edges at no flat face, (e,) bool."""
    smooth = np.ones(len(whole.ends), bool)
    if FLAT in whole.layers and whole.layers[FLAT].domain == FACE:
        smooth[whole.corner_edge[whole.layers[FLAT].values[whole.corner_face]]] = False
    return smooth


def _normals_differ(whole: Elements, some: np.ndarray, normals: np.ndarray) -> np.ndarray:
    """Which of some edges have corners of different normals at one end, (e,) bool. some : (e,) bool."""
    corner = np.flatnonzero(some[whole.corner_edge])
    corners = np.concatenate([corner, next_of_owner(whole.corner_face)[corner]])
    edge = np.tile(whole.corner_edge[corner], 2)
    order = np.lexsort((whole.corner_vertex[corners], edge))
    edge, corners = edge[order], corners[order]
    at = whole.corner_vertex[corners]
    together = np.flatnonzero((edge[1:] == edge[:-1]) & (at[1:] == at[:-1]))
    far = np.abs(normals[corners[together]] - normals[corners[together + 1]]).max(axis=1, initial=0.0) > _UNLIKE
    found = np.zeros(len(whole.ends), bool)
    found[edge[together[far]]] = True
    return found


def _of_edges(values: np.ndarray, edges: np.ndarray, number: np.ndarray) -> np.ndarray:
    """What edges carry that become one: what the first does; of marks and creases, the most."""
    found = np.take(values, edges, axis=0)
    if values.dtype in (bool, np.float32):
        np.maximum.at(found, number, values)
    return found

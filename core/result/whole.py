# SPDX-License-Identifier: GPL-3.0-or-later
"""The parts of a half model together with their mirror images: those of the whole that is seen."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from ..arrays.indexing import sums_by
from ..arrays.int64 import arange
from ..arrays.pairs import distinct_pairs
from ..cuts.hierarchy import Hierarchy
from ..mesh.corners import CornerTable
from ..symmetry.halves import completed_table, open_sides
from ..symmetry.plane import MirrorPlane
from .decomposition import Decomposition
from .parts import Parts

# A part reaches over the plane if it meets its image along so much, in square roots of its area: half of a ball has
# 2.5, half of a tube more than 1.1, two legs that touch at the thighs less.
_MEETS = 0.5


@dataclass(frozen=True, eq=False)
class Whole:
    """A half model of k parts, p faces and n vertices, and its mirror image.

    Attributes
    ----------
    table : CornerTable
        2 p faces, first those given, then their images; the n vertices given come first.
    image : (n,) int64
        Vertex that is the mirror image of each one given; on the plane, itself.
    mirror : MirrorPlane
    parts : Parts
        First the k parts given - one that reaches over the plane is whole - then the images of the others.
    """

    table: CornerTable
    image: np.ndarray
    mirror: MirrorPlane
    parts: Parts

    @property
    def on_plane(self) -> np.ndarray:
        """(n,) bool, which vertices are on the plane."""
        return self.image == arange(len(self.image))


def whole_of(parts: Parts, table: CornerTable, area: np.ndarray, plane: np.ndarray, nodes: np.ndarray,
             points: np.ndarray) -> Whole:
    """Complete a half model and its parts by their mirror images.

    Parameters
    ----------
    parts : Parts
        Of p faces.
    table : CornerTable
        The half model.
    area : (p,) float64
        Of its faces, in squared units of its vertices.
    plane : (4,) float64
        Behind which its image is: normal of length 1 and distance from the origin along it.
    nodes, points : (k, 3) and (r, 3) float64
        Nodes and center points of the graph, in the coordinates of the table.

    Returns
    -------
    whole : Whole
        Its parts are of one level of detail: they do not merge.
    """
    plane = plane if plane[np.abs(plane[:3]).argmax()] > 0 else -plane
    mirror = MirrorPlane.of(plane)
    both, image = completed_table(table, mirror)
    meets = _meeting(table, open_sides(table, mirror), image, parts)
    size = np.bincount(parts.labels, area, parts.count)
    beside = np.flatnonzero(meets <= _MEETS * np.sqrt(size))
    twin = arange(parts.count + len(beside))
    twin[beside], twin[parts.count :] = parts.count + arange(len(beside)), beside
    found = _decomposition(parts, twin, image, mirror, (size, meets))
    side = 1 if mirror.heights(table.vertices[table.corner_vertex]).sum() > 0 else -1
    here, there = (np.where(side * mirror.heights(place) >= 0, part, twin[part])
                   for place, part in ((nodes, parts.node_part), (points, parts.point_part)))
    found = replace(found, node_candidate=here, point_candidate=there,
                    face_side=np.repeat([side, -side], len(parts.labels)).astype(np.int8))
    return Whole(both, image, mirror, Parts(found, arange(len(twin))))


def _meeting(table: CornerTable, is_open: np.ndarray, image: np.ndarray, parts: Parts) -> np.ndarray:
    """Along how much each part meets its image in the plane, (count,); is_open : (c,) bool, see ``open_sides``."""
    in_plane = (image[table.edges] == table.edges).all(axis=1)
    there = np.flatnonzero(is_open & in_plane[table.corner_edge])
    return np.bincount(parts.labels[table.corner_face[there]], table.edge_length(table.corner_edge[there]), parts.count)


def _decomposition(parts: Parts, twin: np.ndarray, image: np.ndarray, mirror: MirrorPlane,
                   measures: tuple[np.ndarray, np.ndarray]) -> Decomposition:
    """The result of which each part of the whole is one candidate; sides and graph are those of the half still.

    twin : of each part of the whole. measures : area of each part of the half, and along how much it meets its image.
    """
    area, meets = measures
    labels, count, half = parts.labels, parts.count, parts.decomposition
    face, beside = arange(len(labels)), image >= len(image)
    apart = np.flatnonzero((twin[:count] >= count) & (meets > 0))  # these touch their images
    touching = np.concatenate([parts.cuts, twin[parts.cuts], np.stack([apart, twin[apart]], axis=1)])
    pairs, which = distinct_pairs(*np.sort(touching, axis=1).T)
    length = sums_by(which, np.concatenate([parts.cut_length, parts.cut_length, meets[apart]]), len(pairs))
    of_vertex = parts.vertex_labels
    of_image = np.where(of_vertex >= 0, twin[of_vertex], -1)[beside]
    return replace(
        half, candidates=np.concatenate([labels, twin[labels]]), vertex_candidates=np.append(of_vertex, of_image),
        candidate_area=np.where(twin == arange(len(twin)), 2.0, 1.0) * area[np.minimum(twin, arange(len(twin)))],
        candidate_pairs=pairs, candidate_pair_length=length, hierarchy=Hierarchy.of(len(twin), [], []),
        field=np.append(half.field, half.field[beside]), contacts=np.empty((0, 2), np.int64),
        links=np.empty((0, 2), np.int64), junctions=np.empty((0, 2), np.int64), junction_length=np.empty(0),
        mirror=np.append(mirror.normal, mirror.offset), face_twin=np.concatenate([face + len(face), face]))

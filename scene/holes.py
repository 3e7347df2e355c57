# SPDX-License-Identifier: GPL-3.0-or-later
"""The holes that cuts leave in pieces: what their caps have to know of the whole mesh, and the caps put on."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import bpy
import numpy as np

from ..core.surface.corners import edge_labels
from . import caps, element_layers, mesh_arrays
from .elements import Elements, Selection
from .temporary import removed

if TYPE_CHECKING:
    from .discs import Discs


@dataclass(frozen=True, eq=False)
class Holes:
    """The cuts of a mesh of v vertices and e edges.

    Attributes
    ----------
    cut : (e,) bool
        Edges where faces of different parts meet.
    meeting : (v,) bool
        Vertices where more than two of these meet.
    joined : (k, 2) int32
        Edges from cut to cut.
    middles : (v, 3) float64
        For a vertex where cuts meet the middle of all such that cuts connect with it.
    discs : Discs
        Surfaces across the cuts.
    """

    cut: np.ndarray
    meeting: np.ndarray
    joined: np.ndarray
    middles: np.ndarray
    discs: Discs

    @classmethod
    def of(cls, whole: Elements, face_numbers: np.ndarray) -> Holes:
        """The cuts between the parts of a mesh. face_numbers : (p,) int64, of each face's part."""
        from ..core.surface.arrays import components, renumbered, sums_by
        from .discs import Discs  # imports SciPy

        low, high = edge_labels(whole.corner_edge, whole.corner_face, face_numbers, len(whole.ends))
        cut, ends = low < high, whole.ends
        count = np.bincount(ends[cut].ravel(), minlength=len(whole.points))
        meeting = count > 2
        points = whole.points.astype(np.float64)
        middles = points.copy()
        if meeting.any():
            used, place = renumbered(ends[cut])
            n_networks, network = components(len(used), *place.T)
            here = meeting[used]
            total = sums_by(network[here], middles[used[here]], n_networks)
            total /= np.maximum(np.bincount(network[here], minlength=n_networks), 1)[:, None]
            middles[used[here]] = total[network[here]]
        return cls(cut, meeting, ends[(count[ends] > 0).all(axis=1)], middles,
                   Discs(points, mesh_arrays.triangulated(whole.points, whole.count, whole.corner_vertex)[0]))

    def closed(self, piece: Elements, chosen: Selection, like: bpy.types.Mesh) -> tuple[Elements, int]:
        """A piece with its holes filled, see caps.close_cuts, and how many edges of holes were not.

        Parameters
        ----------
        piece : Elements
        chosen : Selection
            What it is of the whole mesh.
        like : bpy.types.Mesh
            Where what it carries comes from.
        """
        near = piece.selection(_around_holes(piece, self.cut[chosen.edges]))
        if not len(near.faces):
            return piece, 0
        some = element_layers.made(piece.taken(near), like)
        with removed(bpy.data.meshes, some):
            left = self.close(some, chosen.vertices[near.vertices], chosen.edges[near.edges])
            capped = element_layers.read(some)
        return piece.grafted(capped, near.vertices, near.edges, len(near.faces)), left

    def close(self, mesh: bpy.types.Mesh, vertices: np.ndarray, edges: np.ndarray) -> int:
        """Fill the holes of a mesh; how many edges of holes stay open.

        vertices, edges : (k,), (m,) int64, rising: what those of the mesh are of the whole mesh.
        """
        joined = np.searchsorted(vertices, self.joined[np.isin(self.joined, vertices).all(axis=1)])
        return caps.close_cuts(mesh, self.cut[edges], self.meeting[vertices], joined, self.middles[vertices],
                               self.discs)[1]


def _around_holes(piece: Elements, opened: np.ndarray) -> np.ndarray:
    """Faces at the holes that were opened by cuts, (e,) bool: (k,) int64.

    A hole goes round borders that there were before, too, if the cut ends there.
    """
    from ..core.surface.arrays import components, renumbered

    border = np.bincount(piece.corner_edge, minlength=len(piece.ends)) == 1
    on = np.zeros(len(piece.points), bool)
    on[piece.ends[opened]] = True
    used, place = renumbered(piece.ends[border])
    if len(used):
        count, hole = components(len(used), *place.T)
        touched = np.zeros(count, bool)
        touched[hole[on[used]]] = True
        on[used[touched[hole]]] = True
    return piece.around(on)

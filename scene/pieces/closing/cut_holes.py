# SPDX-License-Identifier: GPL-3.0-or-later
"""The holes that cuts leave in pieces: what their caps have to know of the whole mesh, and the caps put on."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import bpy
import numpy as np

from ....core.arrays.components import components
from ....core.arrays.indexing import renumbered
from ....core.mesh.corners import edge_labels
from ....core.uses.caps.rims import nested_rims
from ....core.uses.caps.surfaces import common_order
from ...reading import element_layers, mesh_arrays
from ...reading.elements import Elements, Selection
from ...temporary import removed
from . import caps

if TYPE_CHECKING:
    from .discs import Discs


@dataclass(frozen=True, eq=False)
class Holes:
    """The cuts of a mesh of v vertices and e edges.

    Attributes
    ----------
    cut : (e,) bool
        Edges where faces of different parts meet.
    joined : (k, 2) int32
        Edges from cut to cut.
    ways : dict of int -> (s, 3) float64
        For each vertex where more than two cuts meet points from there to the middle of all that cuts connect with it.
    rings : list of lists of (j,) int64
        Vertices of rims between which one cap lies, the outer one first.
    discs : Discs
        Surfaces across the cuts.
    """

    cut: np.ndarray
    joined: np.ndarray
    ways: dict[int, np.ndarray]
    rings: list[list[np.ndarray]]
    discs: Discs

    @classmethod
    def of(cls, whole: Elements, face_numbers: np.ndarray) -> Holes:
        """The cuts between the parts of a mesh. face_numbers : (p,) int64, of each face's part."""
        from .cap_junctions import ways_to_middles
        from .discs import Discs  # imports SciPy

        low, high = edge_labels(whole.corner_edge, whole.corner_face, face_numbers, len(whole.ends))
        cut, ends = low < high, whole.ends
        count = np.bincount(ends[cut].ravel(), minlength=len(whole.points))
        points = whole.points.astype(np.float64)
        triangles, face = mesh_arrays.triangulated(whole.points, whole.count, whole.corner_vertex)
        discs = Discs(points, triangles, face_numbers[face])
        ways = ways_to_middles(points, ends[cut], count > 2, discs)
        corner = np.flatnonzero(cut[whole.corner_edge])
        corner = corner[face_numbers[whole.corner_face[corner]] == low[whole.corner_edge[corner]]]
        edge, start = whole.corner_edge[corner], whole.corner_vertex[corner]
        directed = np.stack([start, ends[edge].sum(axis=1) - start], axis=1)
        rings = [ring for ring in nested_rims(points, directed, np.stack([low[edge], high[edge]], axis=1))
                 if _is_ring([points[rim] for rim in ring], discs)]
        return cls(cut, ends[(count[ends] > 0).all(axis=1)], ways, rings, discs)

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
        meeting = np.array(sorted(self.ways), np.int64)
        here = np.searchsorted(vertices, meeting)
        present = here < len(vertices)
        present[present] = vertices[here[present]] == meeting[present]
        ways = {int(place): self.ways[vertex]
                for place, vertex in zip(here[present], meeting[present].tolist(), strict=True)}
        rings = [[np.searchsorted(vertices, rim) for rim in ring] for ring in self.rings
                 if np.isin(np.concatenate(ring), vertices).all()]
        return caps.close_cuts(mesh, self.cut[edges], joined, ways, rings, self.discs)[1]


def _is_ring(curves: list[np.ndarray], discs: Discs) -> bool:
    """Whether one cap between curves, (j, 3) each, is as good as one across each."""
    found = discs.tried(*curves)
    alone = [discs.tried(curve[common_order(curve)]) for curve in curves] if found.faults else []
    return found.disc is not None and (not alone or found.faults <= sum(one.faults for one in alone))


def _around_holes(piece: Elements, opened: np.ndarray) -> np.ndarray:
    """The faces of a piece at the holes that cuts have left, (k,) int64, rising. opened : (e,) bool, the edges of cuts.

    A hole goes round borders that there were before, too, if the cut ends there.
    """
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

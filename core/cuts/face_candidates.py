# SPDX-License-Identifier: GPL-3.0-or-later
"""Candidates on faces: what every step between the methods of cutting and the result takes and gives."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..mesh.face_graph import FaceGraph
from .hierarchy import Hierarchy


@dataclass(frozen=True, eq=False)
class FaceCandidates:
    """The candidate of each of p faces, and the order in which the candidates merge.

    Attributes
    ----------
    graph : FaceGraph
        Faces that share an edge.
    contacts : (k, 2) int64
        Faces that touch though they share no edge.
    label : (p,) int64
        Candidate of each face, 0..c-1.
    hierarchy : Hierarchy
        Of the c candidates.
    """

    graph: FaceGraph
    contacts: np.ndarray
    label: np.ndarray
    hierarchy: Hierarchy

    def parts(self, detail: float) -> np.ndarray:
        """Part of each face, (p,) int64, at a level of detail, 0 to 1."""
        return self.hierarchy.parts_at(detail)[self.label]

    def touching_graph(self) -> FaceGraph:
        """All faces that touch: the graph with the contacts, along no length, as pairs."""
        return self.graph.with_contacts(self.contacts)

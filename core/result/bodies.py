# SPDX-License-Identifier: GPL-3.0-or-later
"""Bodies - what hangs together by edges and contacts - and the links by which all of them hang together."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..arrays.components import components
from ..arrays.indexing import last_of_each, sums_by
from ..arrays.nearest import nearest_larger
from ..mesh.labels import FaceGraph
from ..surface.preparation import WorkingMesh
from .component_results import ComponentResult


@dataclass(frozen=True, eq=False)
class Bodies:
    """The bodies of the caller's p faces.

    Attributes
    ----------
    face_body : (p,) int64
        Body of each face, 0..b-1.
    contacts : (k, 2) int64
        Faces of one body that touch though they share no edge.
    links : (l, 2) int64
        A face of each body but the largest, and one of the nearest of the larger bodies.
    """

    face_body: np.ndarray
    contacts: np.ndarray
    links: np.ndarray

    @classmethod
    def of(cls, working: WorkingMesh, results: list[ComponentResult], graph: FaceGraph) -> Bodies:
        """Find the bodies.

        Parameters
        ----------
        working : WorkingMesh
        results : list of ComponentResult
            One for each component that was decomposed, with contacts.
        graph : FaceGraph
            Of the caller's faces.

        Returns
        -------
        bodies : Bodies
        """
        contacts = np.concatenate([np.empty((0, 2), np.int64), *(r.component.polygon[r.contacts] for r in results)])
        count, piece = graph.pieces
        joined, of_piece = components(count, *piece[contacts].T)
        face_body = of_piece[piece]
        if joined == 1:
            return cls(face_body, contacts, np.empty((0, 2), np.int64))
        mesh, body = working.mesh, face_body[working.polygon]
        area = np.bincount(body, mesh.face_weight, joined)
        center = sums_by(body, mesh.face_weight[:, None] * mesh.face_centroids, joined)
        center /= np.where(area > 0, area, 1.0)[:, None]
        known = np.flatnonzero(area > 0)  # the copy lacks the faces of others
        links = known[nearest_larger(area[known], center[known])]
        # A face of each body: the nearest to its middle.
        offset = np.linalg.norm(mesh.face_centroids - center[body], axis=1)
        face = last_of_each(body, -offset, count=joined)
        return cls(face_body, contacts, working.polygon[face[links]])

    @property
    def pairs(self) -> np.ndarray:
        """(k + l, 2) int64, the contacts and then the links."""
        return np.concatenate([self.contacts, self.links])

# SPDX-License-Identifier: GPL-3.0-or-later
"""What joins the caller's faces besides edges: contacts, which make bodies of pieces, and links of these bodies."""

from __future__ import annotations

import numpy as np

from ..arrays.components import components
from ..arrays.nearest import nearest_larger, nearest_to_middle
from ..arrays.vectors import middles_of_each
from ..mesh.face_graph import FaceGraph
from ..surface.preparation import WorkingMesh
from .component_results import Findings


def contacts_and_links(findings: Findings, graph: FaceGraph) -> np.ndarray:
    """Find what joins faces that share no edge, so that all of them hang together.

    Parameters
    ----------
    findings : Findings
    graph : FaceGraph
        Of the caller's faces.

    Returns
    -------
    pairs : (k + l, 2) int64
        The k contacts, faces of one body that touch; then a face of each body but the largest, and one of the nearest
        of the larger bodies.
    """
    contacts = findings.contacts
    count, piece = graph.pieces
    joined, of_piece = components(count, *piece[contacts].T)
    if joined == 1:
        return contacts
    return np.concatenate([contacts, links(findings.working, of_piece[piece], joined)])


def links(working: WorkingMesh, body: np.ndarray, count: int) -> np.ndarray:
    """Link bodies, each but the largest to the nearest of the larger ones: a face of each, (l, 2) int64.

    body : (p,) int64, of each of the caller's faces, 0..count-1.
    """
    mesh, of_triangle = working.mesh, body[working.polygon]
    area, center = middles_of_each(of_triangle, mesh.face_centroids, mesh.face_weight, count)
    known = np.flatnonzero(area > 0)  # the copy lacks the faces of others
    pairs = known[nearest_larger(area[known], center[known])]
    face = nearest_to_middle(of_triangle, mesh.face_centroids, center)
    return working.polygon[face[pairs]]

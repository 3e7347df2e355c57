# SPDX-License-Identifier: GPL-3.0-or-later
"""Symmetry within faces: where the caller's are too large to be mirrored, the small ones they were divided into are.

A coarse mesh is rarely its own mirror image, face by face, where its shape is: quads were divided along one diagonal
or the other, or faces were taken away. What each of the caller's faces chooses among is then symmetric, and the parts
are so within a face.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ..cuts.face_candidates import FaceCandidates
from ..cuts.hierarchy import Hierarchy
from ..cuts.settling import settle
from ..cuts.symmetric.regions import symmetric_on_regions
from ..mesh.face_graph import FaceGraph, connect
from ..mesh.triangles import TriMesh, vote_weights
from ..symmetry.images import Images
from ..symmetry.mirrors import Mirror
from .component_results import ComponentResult, FoundCandidates, firsts, merged_at_last

# The finest candidates of several bodies at once are merged down to so many, twice those of one body: what is made
# symmetric is compared pair by pair, again and again, and these are smaller than the caller's faces.
MOST_CANDIDATES = 440


def symmetric_within_faces(results: list[ComponentResult], mirrors: list[Mirror]) -> FoundCandidates:
    """Make the candidates that were found symmetric on the small faces of the components.

    Parameters
    ----------
    results : list of ComponentResult
    mirrors : list of Mirror
        One of all components, or several, each of one.

    Returns
    -------
    found : FoundCandidates
        On the small faces.
    """
    planes = [images for mirror in mirrors for images in mirror.within]
    of_each = [[images for images in planes if images.faces.mesh is r.component.mesh] for r in results]
    # A plane of one body changes no other, and trying it there costs time.
    alone = sum(map(len, of_each)) == len(planes)
    groups = [([r], images) for r, images in zip(results, of_each, strict=True)] if alone else [(results, planes)]
    parts = [_symmetric(some, images) for some, images in groups]
    first = firsts([part.hierarchy.n_candidates for part in parts])
    label = np.concatenate([k + part.label for k, part in zip(first, parts, strict=True)])
    hierarchy = Hierarchy.join([part.hierarchy for part in parts])
    polygon = np.concatenate([r.component.polygon for r in results])
    area = np.concatenate([r.component.mesh.face_area for r in results])
    whole = sum(r.component.mesh.area for r in results)
    return FoundCandidates(polygon, label, vote_weights(area, whole), hierarchy)


def _symmetric(results: list[ComponentResult], planes: list[Images]) -> FaceCandidates:
    """Candidates of the small faces of some components, symmetric in all the planes."""
    mesh = _joined([r.component.mesh for r in results])
    first = firsts([r.component.mesh.n_faces for r in results])
    contacts = np.concatenate([k + r.contacts for k, r in zip(first, results, strict=True)])
    first = firsts([r.candidates.hierarchy.n_candidates for r in results])
    label = np.concatenate([k + r.face_candidate for k, r in zip(first, results, strict=True)])
    hierarchy = Hierarchy.join([r.candidates.hierarchy for r in results])
    graph = FaceGraph.of(mesh)
    candidates = settle(FaceCandidates(graph, contacts, connect(graph, label), hierarchy))
    part, hierarchy = candidates.hierarchy.coarsest(MOST_CANDIDATES)
    candidates = replace(candidates, label=part[candidates.label], hierarchy=hierarchy)
    for images in planes:  # of planes across each other each keeps the symmetry in those before it
        mirror = Mirror.of_faces(images, mesh)
        candidates = replace(candidates, hierarchy=merged_at_last(candidates.hierarchy))
        candidates = symmetric_on_regions(candidates, mirror.twin, mirror.height, mirror.first, mirror.sure)
    return candidates


def _joined(meshes: list[TriMesh]) -> TriMesh:
    """Meshes side by side, as one."""
    if len(meshes) == 1:
        return meshes[0]
    first = firsts([mesh.n_vertices for mesh in meshes])
    return TriMesh(np.concatenate([mesh.vertices for mesh in meshes]),
                   np.concatenate([k + mesh.faces for k, mesh in zip(first, meshes, strict=True)]))

# SPDX-License-Identifier: GPL-3.0-or-later
"""Coarse copies on which candidates of dense meshes are found, and the way back from copy to finer copy."""

from __future__ import annotations

import numpy as np

from ...field.agd import ScalarField
from ...mesh.face_graph import FaceGraph, connect, fill_unlabeled
from ...mesh.labels import majority
from ...mesh.triangles import TriMesh
from ...surface.coarsening import Coarsening, Pyramid, coarsen
from ...surface.curvature import MAX_CURVATURE
from ..hierarchy import Hierarchy
from ..minimum_cut import MovableCuts, move_cuts

# Largest number of faces of a mesh that is cut itself. A denser mesh is cut on a coarse copy of at most so many faces,
# which are still much smaller than parts.
MAX_FACES = 60_000
WHOLE = 0.9  # share of its area from which on the coarse copy of a surface is not torn
IN_VAIN = 0.8  # share of its faces above which a copy in which pieces stay whole is hardly coarser
BAND = 3  # by how many edges of a copy cuts that were found on it move on a finer one, at most


def coarse_copies(pyramid: Pyramid) -> list[Coarsening]:
    """The steps to a coarse copy of at most MAX_FACES faces, in which the surface is whole.

    Where the surface is thin, or has small pieces, a copy may lack triangles. Pieces that would lose some stay as they
    are; if then hardly anything is left to coarsen, the last copy has more faces.

    Parameters
    ----------
    pyramid : Pyramid

    Returns
    -------
    steps : list of Coarsening
        From the mesh on; empty if the mesh itself has no more than MAX_FACES faces, or cannot be coarsened.
    """
    steps: list[Coarsening] = []
    copy, area = pyramid.mesh, pyramid.mesh.vertex_area
    for step in pyramid.until(lambda mesh: mesh.n_faces <= MAX_FACES):
        if not _is_whole(step.mesh, copy.area, copy.face_components[0]):
            break
        steps.append(step)
        copy, area = step.mesh, step.area
    while copy.n_faces > MAX_FACES:
        step = _coarsened_whole(copy, area)
        if step.mesh.n_faces > IN_VAIN * copy.n_faces:
            break
        steps.append(step)
        copy, area = step.mesh, step.area
    return steps


def _is_whole(copy: TriMesh, area: float, n_pieces: int) -> bool:
    """Whether a coarse copy has the pieces of the mesh from which it was made, and nearly its area."""
    whole = copy.n_faces > 0 and bool(copy.used.all())
    return whole and copy.face_components[0] == n_pieces and copy.area > WHOLE * area


def _coarsened_whole(mesh: TriMesh, vertex_area: np.ndarray) -> Coarsening:
    """Coarsen a mesh along its edges, but for the pieces that would not be whole then. vertex_area : (n,) float64."""
    step = coarsen(mesh, vertex_area)
    count, piece = mesh.face_components
    of_vertex = np.zeros(mesh.n_vertices, np.int64)
    of_vertex[mesh.faces] = piece[:, None]
    in_copy = np.zeros(step.mesh.n_vertices, np.int64)
    in_copy[step.owner] = of_vertex
    n_found, found = step.mesh.face_components
    of_found = np.zeros(n_found, np.int64)
    of_found[found] = in_copy[step.mesh.faces[:, 0]]
    area = np.bincount(in_copy[step.mesh.faces[:, 0]], step.mesh.face_area, count)
    whole = (np.bincount(of_found, minlength=count) == 1) & (area > WHOLE * np.bincount(piece, mesh.face_area, count))
    whole[in_copy[~step.mesh.used]] = False
    return step if whole.all() else coarsen(mesh, vertex_area, kept=~whole[of_vertex])


def restricted(field: ScalarField, owner: np.ndarray, weight: np.ndarray, count: int) -> ScalarField:
    """Bring a field to a coarse copy: the mean over each cell.

    Parameters
    ----------
    field : ScalarField
        At n vertices.
    owner : (n,) int64
        Vertex of the copy in whose cell each vertex lies, 0..count-1.
    weight : (n,) float64
        What each vertex counts, such as its area.
    count : int
        Number of vertices of the copy.

    Returns
    -------
    field : ScalarField
        At the vertices of the copy.
    """
    # All faces at a vertex, and in a cell, may be without area.
    weight = np.where(weight > 0, weight, 1e-12 * weight.mean())
    total = np.bincount(owner, weight, count)
    return ScalarField(*(np.bincount(owner, weight * f, count) / total
                         for f in (field.values, field.normalized, field.agd)))


def refined_labels(
    mesh: TriMesh, step: Coarsening, label: np.ndarray, hierarchy: Hierarchy, band_ratio: float
) -> np.ndarray:
    """Bring candidates from a coarse copy to the mesh of which it was made: the cuts of detail 0.5 move anew.

    On the copy the cuts have found their places as well as its edges allow. So they move by BAND of these edges at
    most, and only faces near them are looked at.

    Parameters
    ----------
    mesh : TriMesh
        m faces.
    step : Coarsening
        Made of ``mesh``.
    label : (m',) int64
        Candidate of each face of the copy.
    hierarchy : Hierarchy
        The order in which the candidates merge.
    band_ratio : float
        See ``MovableCuts``.

    Returns
    -------
    label : (m,) int64
        Candidate of each face of the mesh.
    """
    found = _prolong_labels(mesh, step, label)
    part = hierarchy.parts_at(0.5)[label]
    zone = _near_cuts(step.mesh, part)[step.owner][mesh.faces].any(axis=1)
    if not zone.any():
        return found
    a, b = mesh.edges.pairs.T
    across = np.flatnonzero(zone[a] != zone[b])
    rim = np.zeros(mesh.n_faces, bool)
    rim[a[across]] = rim[b[across]] = True
    some, _ = mesh.submesh(zone)
    unit = np.sqrt(mesh.area)
    bend = np.clip(some.dihedral / np.maximum(some.pair_distance, 1e-9 * unit) * unit, -MAX_CURVATURE, MAX_CURVATURE)
    movable = MovableCuts(some, bend, band_ratio, widest=BAND * step.mesh.edge_length.mean(), fixed=rim[zone])
    found[zone] = move_cuts(movable, found[zone], hierarchy, (0.5,))
    return found


def _near_cuts(mesh: TriMesh, part: np.ndarray) -> np.ndarray:
    """Vertices, (n,) bool, at most BAND + 1 edges from the cuts between parts. part : (m,) int64."""
    cut = mesh.edges.pairs[part[mesh.edges.pairs[:, 0]] != part[mesh.edges.pairs[:, 1]]]
    near = np.zeros(mesh.n_vertices, bool)
    near[mesh.faces[cut]] = True
    a, b = mesh.edges.vertices.T
    for _ in range(BAND + 1):
        rim = np.flatnonzero(near[a] != near[b])
        near[a[rim]] = near[b[rim]] = True
    return near


def _prolong_labels(mesh: TriMesh, step: Coarsening, label: np.ndarray) -> np.ndarray:
    """Label of each face of a mesh, (m,) int64, from the labels of a coarse copy's faces; every label is connected."""
    copy = step.mesh
    of_vertex = majority(copy.faces.ravel(), np.repeat(label, 3), np.repeat(copy.face_area, 3),
                         copy.n_vertices)[step.owner]
    p, q, r = of_vertex[mesh.faces.T]
    most = np.where(p == q, p, np.where((p == r) | (q == r), r, -1))
    p, q, r = (np.where(corner < 0, label.max() + 1, corner) for corner in (p, q, r))
    # Where all three differ, the smallest; -1 where none is known.
    least = np.minimum(np.minimum(p, q), r)
    label = np.where(most >= 0, most, np.where(least > label.max(), -1, least))
    graph = FaceGraph.of(mesh)
    return connect(graph, fill_unlabeled(graph, label))

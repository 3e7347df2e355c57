# SPDX-License-Identifier: GPL-3.0-or-later
"""Cuts where people cut: candidates for the preset "Perceptual"."""

from __future__ import annotations

import numpy as np

from ...field.agd import ScalarField
from ...graph.level_sets import LevelSets, cut_at_levels
from ...parameters import Parameters
from ...surface.coarsening import Coarsening, coarsen
from ...surface.labels import FaceGraph, connect, fill_unlabelled, majority
from ...surface.mesh import TriMesh
from ..hierarchy import Hierarchy
from ..minimum_cut import move_cuts
from .boosted_trees import cut_model
from .features import BORDER, MAX_CURVATURE, surface_measures
from .merging import RegionGraph, merge_all_
from .patches import concave_patches, level_set_patches

# Share of people who must separate two regions for the cut to stay at detail 0.5.
DECISION = 0.55
# Denser meshes are cut on a coarse copy: parts are much larger than its faces.
MAX_FACES = 60_000


def perceptual_candidates(
    sets: LevelSets, field: ScalarField, parameters: Parameters, progress=None, first: Coarsening | None = None
) -> tuple[np.ndarray, Hierarchy]:
    """Patches between creases, merged weakest cut first as a model of people's cuts tells.

    Parameters
    ----------
    sets : LevelSets
        Of one connected component.
    field : ScalarField
        Its AGD.
    parameters : Parameters
    progress : callable, optional
        Called with the share done, 0..1.
    first : Coarsening, optional
        Of the mesh, if it is known already.

    Returns
    -------
    element_candidate : (E,) int64
        Patch of each element.
    hierarchy : Hierarchy
        Salience 0.5 is the decision learned from people.
    """
    progress = progress or (lambda share: None)
    if parameters.follow_level_sets:
        label = level_set_patches(sets)
        hierarchy, _ = _merge(sets, field, label)
    elif sets.mesh.n_faces > MAX_FACES:
        label, hierarchy = _on_coarse_copy(sets, field, parameters.alpha, progress, first)
    else:
        label, hierarchy = _cut_in_creases(sets, field, parameters.alpha, progress)
    return label[sets.element_face], hierarchy


def _merge(sets: LevelSets, field: ScalarField, label) -> tuple[Hierarchy, np.ndarray]:
    """The hierarchy over some patches, and the curvature across each pair of faces."""
    measures = surface_measures(sets, field)
    graph = RegionGraph(sets.mesh, measures, label)
    merges, share = merge_all_(graph, judge_cuts)
    length, curvature = measures.pair[:, [BORDER.length, BORDER.curvature.start]].T
    curvature = np.divide(curvature, length, out=np.zeros_like(length), where=length > 0)
    return Hierarchy.of(label.max() + 1, merges, salience_of(share)), curvature


def _cut_in_creases(sets: LevelSets, field: ScalarField, reach, progress) -> tuple[np.ndarray, Hierarchy]:
    """Candidate of each face, and the hierarchy over them."""
    label = concave_patches(sets.mesh)
    progress(0.2)
    hierarchy, curvature = _merge(sets, field, label)
    progress(0.7)
    return move_cuts(sets.mesh, label, hierarchy, curvature, reach), hierarchy


def _on_coarse_copy(sets: LevelSets, field: ScalarField, reach, progress, first) -> tuple[np.ndarray, Hierarchy]:
    """The same for a dense mesh; only the cuts of detail 0.5 are moved on the mesh itself."""
    mesh = sets.mesh
    owner, copy = np.arange(mesh.n_vertices), mesh
    while copy.n_faces > MAX_FACES:
        area = np.bincount(owner, mesh.vertex_area, copy.n_vertices)
        step = first if first and copy is mesh else coarsen(copy, area)
        if not _covers(step, copy):
            break
        owner, copy = step.owner[owner], step.mesh
    progress(0.1)
    values = _restrict(field, owner, mesh.vertex_area, copy.n_vertices)
    label, hierarchy = _cut_in_creases(
        cut_at_levels(copy, values.values, sets.levels), values, reach,
        lambda share: progress(0.1 + 0.4 * share))
    progress(0.5)
    graph = FaceGraph(mesh.n_faces, mesh.edges.pairs, mesh.pair_length, mesh.face_area)
    of_vertex = majority(copy.faces.ravel(), np.repeat(label, 3), np.repeat(copy.face_area, 3),
                         copy.n_vertices)[owner]
    corners = of_vertex[mesh.faces]
    known = corners >= 0
    rows = np.repeat(np.arange(mesh.n_faces), 3)[known.ravel()]
    label = majority(rows, corners[known], np.ones(len(rows)), mesh.n_faces)
    label = connect(graph, fill_unlabelled(graph, label))
    progress(0.6)
    bend = mesh.dihedral / np.maximum(mesh.pair_distance, 1e-9 * np.sqrt(mesh.area))
    bend = np.clip(bend * np.sqrt(mesh.area), -MAX_CURVATURE, MAX_CURVATURE)
    return move_cuts(mesh, label, hierarchy, bend, reach, (0.5,)), hierarchy


def _covers(step: Coarsening, mesh: TriMesh) -> bool:
    """Whether a coarse copy is one surface nearly as large as the mesh."""
    whole = step.mesh.n_faces > 0 and len(np.unique(step.mesh.faces)) == step.mesh.n_vertices
    return whole and step.mesh.face_components[0] == 1 and step.mesh.area > 0.9 * mesh.area


def _restrict(field: ScalarField, owner, weight, n) -> ScalarField:
    """A field on a coarse copy: the mean of each cell."""
    total = np.bincount(owner, weight, n)
    return ScalarField(*(np.bincount(owner, weight * f, n) / total
                         for f in (field.values, field.normalised, field.agd)))


def judge_cuts(graph: RegionGraph, borders: np.ndarray) -> np.ndarray:
    """Share of people who would separate the regions of each border, 0..1."""
    return cut_model().predict(graph.features(borders))


def salience_of(share: np.ndarray) -> np.ndarray:
    """Stretch shares of people so that the decision falls on 0.5."""
    return np.interp(share, [0.0, DECISION, 1.0], [0.0, 0.5, 1.0])

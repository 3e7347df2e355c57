# SPDX-License-Identifier: GPL-3.0-or-later
"""Cuts where people cut: candidates for the preset "Perceptual"."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from ...field.agd import ScalarField
from ...graph.level_sets import LevelSets, cut_at_levels
from ...parameters import Parameters
from ...surface.coarsening import Pyramid
from ...surface.curvature import MAX_CURVATURE
from ...surface.labels import FaceGraph, connect, fill_unlabelled, majority
from ...surface.mesh import TriMesh
from ..hierarchy import Candidates, Hierarchy
from ..minimum_cut import move_cuts
from .boosted_trees import BoostedTrees, cut_model
from .measures import BORDER, surface_measures
from .merging import Judge, RegionAdjacencyGraph, merge_all_
from .patches import concave_patches, level_set_patches

# Share of people who must separate two regions for the cut to stay at detail 0.5.
DECISION = 0.55
# Denser meshes are cut on a coarse copy: parts are much larger than its faces.
MAX_FACES = 60_000


def perceptual_candidates(
    sets: LevelSets,
    field: ScalarField,
    pyramid: Pyramid,
    parameters: Parameters,
    model: BoostedTrees | None = None,
    progress: Callable[[float], None] | None = None,
) -> Candidates:
    """Patches between creases, merged weakest cut first as a model of people's cuts tells.

    Parameters
    ----------
    sets : LevelSets
        Of one connected component.
    field : ScalarField
        Its AGD.
    pyramid : Pyramid
        Coarser copies of its mesh.
    parameters : Parameters
    model : BoostedTrees, optional
        What judges cuts; the one that ships with the package without.
    progress : callable, optional
        Called with the share done, 0..1.

    Returns
    -------
    candidates : Candidates
        The patches. Salience 0.5 is the decision learned from people.
    """
    progress = progress or (lambda share: None)
    judge = judge_by(model or cut_model())
    if parameters.follow_level_sets:
        label = level_set_patches(sets)
        hierarchy, _ = _merge(sets, field, label, judge)
    elif sets.mesh.n_faces > MAX_FACES:
        label, hierarchy = _on_coarse_copy(sets, field, pyramid, parameters.band_ratio, judge, progress)
    else:
        label, hierarchy = _cut_in_creases(sets, field, parameters.band_ratio, judge, progress)
    return Candidates(label[sets.element_face], hierarchy)


def _merge(sets: LevelSets, field: ScalarField, label: np.ndarray, judge: Judge) -> tuple[Hierarchy, np.ndarray]:
    """The hierarchy over some patches, and the curvature across each pair of faces."""
    measures = surface_measures(sets, field)
    graph = RegionAdjacencyGraph(sets.mesh, measures, label)
    merges, share = merge_all_(graph, judge)
    length, curvature = measures.pair[:, [BORDER.length, BORDER.curvature.start]].T
    curvature = np.divide(curvature, length, out=np.zeros_like(length), where=length > 0)
    return Hierarchy.of(label.max() + 1, merges, salience_of(share)), curvature


def _cut_in_creases(
    sets: LevelSets, field: ScalarField, band_ratio: float, judge: Judge, progress: Callable[[float], None]
) -> tuple[np.ndarray, Hierarchy]:
    """Candidate of each face, and the hierarchy over them."""
    label = concave_patches(sets.mesh)
    progress(0.2)
    hierarchy, curvature = _merge(sets, field, label, judge)
    progress(0.7)
    return move_cuts(sets.mesh, label, hierarchy, curvature, band_ratio), hierarchy


def _on_coarse_copy(
    sets: LevelSets, field: ScalarField, pyramid: Pyramid, band_ratio: float, judge: Judge,
    progress: Callable[[float], None],
) -> tuple[np.ndarray, Hierarchy]:
    """Candidates of a dense mesh: found on a coarse copy; the cuts of detail 0.5 are moved on the mesh itself."""
    mesh = sets.mesh
    owner, copy = _coarse_copy(pyramid)
    progress(0.1)
    coarse_field = _restrict(field, owner, mesh.vertex_area, copy.n_vertices)
    label, hierarchy = _cut_in_creases(
        cut_at_levels(copy, coarse_field.values, sets.levels), coarse_field, band_ratio, judge,
        lambda share: progress(0.1 + 0.4 * share))
    progress(0.5)
    label = _prolong_labels(mesh, owner, copy, label)
    progress(0.6)
    bend = mesh.dihedral / np.maximum(mesh.pair_distance, 1e-9 * np.sqrt(mesh.area))
    bend = np.clip(bend * np.sqrt(mesh.area), -MAX_CURVATURE, MAX_CURVATURE)
    return move_cuts(mesh, label, hierarchy, bend, band_ratio, (0.5,)), hierarchy


def _coarse_copy(pyramid: Pyramid) -> tuple[np.ndarray, TriMesh]:
    """The vertex of the copy whose cell each vertex lies in, and the first copy of at most MAX_FACES faces.

    A finer one where that is torn: thin places may lose their triangles.
    """
    owner, copy = np.arange(pyramid.mesh.n_vertices), pyramid.mesh
    for step in pyramid.until(lambda mesh: mesh.n_faces <= MAX_FACES):
        if not _is_whole(step.mesh, copy.area):
            break
        owner, copy = step.owner[owner], step.mesh
    return owner, copy


def _is_whole(copy: TriMesh, area: float) -> bool:
    """Whether a coarse copy is one surface nearly as large as the mesh that it was made of."""
    whole = copy.n_faces > 0 and len(np.unique(copy.faces)) == copy.n_vertices
    return whole and copy.face_components[0] == 1 and copy.area > 0.9 * area


def _prolong_labels(mesh: TriMesh, owner: np.ndarray, copy: TriMesh, label: np.ndarray) -> np.ndarray:
    """Labels of the faces of a mesh, (m,) int64, from those of a coarse copy's faces; each connected."""
    of_vertex = majority(copy.faces.ravel(), np.repeat(label, 3), np.repeat(copy.face_area, 3),
                         copy.n_vertices)[owner]
    corners = of_vertex[mesh.faces]
    known = corners >= 0
    rows = np.repeat(np.arange(mesh.n_faces), 3)[known.ravel()]
    label = majority(rows, corners[known], np.ones(len(rows)), mesh.n_faces)
    graph = FaceGraph(mesh.n_faces, mesh.edges.pairs, mesh.pair_length, mesh.face_area)
    return connect(graph, fill_unlabelled(graph, label))


def _restrict(field: ScalarField, owner: np.ndarray, weight: np.ndarray, n: int) -> ScalarField:
    """A field on a coarse copy of n vertices: the weighted mean of each cell."""
    total = np.bincount(owner, weight, n)
    return ScalarField(*(np.bincount(owner, weight * f, n) / total
                         for f in (field.values, field.normalized, field.agd)))


def judge_by(model: BoostedTrees) -> Judge:
    """A judge of borders: the share of people who would separate the regions on both sides, 0..1."""
    return lambda graph, borders: model.predict(graph.features(borders))


def salience_of(share: np.ndarray) -> np.ndarray:
    """Stretch shares of people so that the decision falls on 0.5."""
    return np.interp(share, [0.0, DECISION, 1.0], [0.0, 0.5, 1.0])

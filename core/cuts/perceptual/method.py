# SPDX-License-Identifier: GPL-3.0-or-later
"""Candidates that are cut where people cut, for the preset "Perceptual"."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cache
from importlib.resources import files
from typing import NamedTuple

import numpy as np

from ...arrays.int64 import arange
from ...arrays.ties import in_steps
from ...field.agd import ScalarField
from ...graph.level_sets import LevelSets, cut_at_levels
from ...parameters import Parameters
from ...surface.coarsening import Pyramid
from ...surface.denoising import denoised
from ...surface.sheets import Inflated, inflated, sheet_faces
from ..boosted_trees import BoostedTrees
from ..foundation import Foundation
from ..hierarchy import Candidates, Hierarchy
from ..minimum_cut import MovableCuts, move_cuts
from ..patches import concave_patches
from .coarse_copies import MAX_FACES, coarse_copies, refined_labels, restricted
from .features import FEATURES
from .level_set_patches import level_set_patches
from .measures import BORDER, surface_measures
from .merging import RegionAdjacencyGraph, merge_all_

# Share of people who separate two regions, 0..1, from which on their cut stays at detail 0.5: of solids, and of sheets,
# where what was learned from says it is certain.
SHARE_AT_HALF, SHEET_SHARE_AT_HALF = 0.55, 0.6


def perceptual_candidates(
    foundation: Foundation,
    parameters: Parameters,
    model: BoostedTrees | None = None,
    progress: Callable[[float], None] | None = None,
) -> Candidates:
    """Divide a component into patches between creases, and merge them as a model of people's cuts judges.

    Parameters
    ----------
    foundation : Foundation
    parameters : Parameters
    model : BoostedTrees, optional
        Model that judges cuts. Without it, those that ship with the package: one of closed surfaces, one of sheets.
    progress : callable, optional
        Called with the share done, 0..1.

    Returns
    -------
    candidates : Candidates
        The patches. A cut that a share SHARE_AT_HALF of people would make has salience 0.5.

    Raises
    ------
    ReebError
        A model that ships with the package was trained on other features.
    """
    pyramid, field, sets = foundation
    progress = progress or (lambda share: None)
    judges = Judges(CutJudge(model or cut_model(), SHARE_AT_HALF),
                    CutJudge(model or sheet_model(), SHEET_SHARE_AT_HALF))
    if parameters.follow_level_sets:
        label, hierarchy = _cut_at_levels(sets, field, judges)
    elif sets.mesh.n_faces > MAX_FACES:
        label, hierarchy = _on_coarse_copy(sets, field, pyramid, parameters.band_ratio, judges, progress)
    else:
        label, hierarchy = _cut_in_creases(sets, field, parameters.band_ratio, judges, progress)
    return Candidates(label[sets.element_face], hierarchy)


@dataclass(frozen=True, eq=False)
class CutJudge:
    """Judges cuts by a model: a ``merging.Judge``.

    Attributes
    ----------
    model : BoostedTrees
        Over the columns FEATURES; estimates the share of people who would separate the regions on both sides of a cut.
    share_at_half : float
        The share at which a cut has salience 0.5.
    """

    model: BoostedTrees
    share_at_half: float

    def __call__(self, graph: RegionAdjacencyGraph, borders: np.ndarray) -> np.ndarray:
        """The share of people for each of some borders, (k,) int64: (k,) float64, 0..1."""
        return self.model.predict(in_steps(graph.features_(borders)))


class Judges(NamedTuple):
    """Who judges cuts.

    Attributes
    ----------
    solid : CutJudge
        Judges cuts of solids, which are closed surfaces.
    sheet : CutJudge
        Judges cuts of sheets that were inflated.
    """

    solid: CutJudge
    sheet: CutJudge


def _merge(
    sets: LevelSets, field: ScalarField, label: np.ndarray, judge: CutJudge
) -> tuple[Hierarchy, np.ndarray]:
    """Hierarchy over patches, and curvature across each pair of faces, (p,), times the square root of the area.

    label : (m,) int64, patch of each face.
    """
    measures = surface_measures(sets, field)
    graph = RegionAdjacencyGraph(sets.mesh, measures, label)
    merges, share = merge_all_(graph, judge)
    length, curvature = measures.pair[:, [BORDER.length, BORDER.curvature.start]].T
    curvature = np.divide(curvature, length, out=np.zeros_like(length), where=length > 0)
    return Hierarchy.of(label.max() + 1, merges, salience_of(share, judge.share_at_half)), curvature


def _without_noise(sets: LevelSets) -> LevelSets:
    """The level sets with a mesh that has no noise, on which normals, curvature and thickness are measured."""
    mesh = denoised(sets.mesh)
    return sets if mesh is sets.mesh else replace(sets, mesh=mesh)


def _cut_at_levels(sets: LevelSets, field: ScalarField, judges: Judges) -> tuple[np.ndarray, Hierarchy]:
    """Candidate of each face, (m,) int64, with cuts on level sets, and the hierarchy over the candidates."""
    sets = _without_noise(sets)
    label = level_set_patches(sets)
    solid = inflate(sets, field)
    if solid is None:
        return label, _merge(sets, field, label, judges.solid)[0]
    return label, _merge(solid.sets, solid.field, label[solid.shape.face_source], judges.sheet)[0]


def _cut_in_creases(
    sets: LevelSets, field: ScalarField, band_ratio: float, judges: Judges, progress: Callable[[float], None]
) -> tuple[np.ndarray, Hierarchy]:
    """Candidate of each face, (m,) int64, with cuts moved into creases, and the hierarchy over the candidates.

    Sheets, which have no creases, are cut as if they were inflated.
    """
    sets = _without_noise(sets)
    solid = inflate(sets, field)
    if solid is None:
        return _cut_solid(sets, field, band_ratio, judges.solid, progress)
    label, hierarchy = _cut_solid(solid.sets, solid.field, band_ratio, judges.sheet, progress)
    return solid.shape.on_front(label, sets.mesh.n_faces), hierarchy


@dataclass(frozen=True, eq=False)
class InflatedComponent:
    """A component whose sheets are inflated.

    Attributes
    ----------
    shape : Inflated
        Its mesh, n vertices, and from which faces and vertices of the component that was made.
    sets : LevelSets
        Of the mesh, at the levels of the component.
    field : ScalarField
        At the n vertices, from that of the component.
    """

    shape: Inflated
    sets: LevelSets
    field: ScalarField


def inflate(sets: LevelSets, field: ScalarField) -> InflatedComponent | None:
    """Inflate the sheets of a component.

    Parameters
    ----------
    sets : LevelSets
        Level sets of one connected component.
    field : ScalarField
        AGD of the component.

    Returns
    -------
    solid : InflatedComponent or None
        None if the component has no sheets.
    """
    sheet = sheet_faces(sets.mesh, field.agd[sets.mesh.faces].mean(axis=1))
    if not sheet.any():
        return None
    shape = inflated(sets.mesh, sheet)
    values, normalized, agd = (of_vertex[shape.vertex_source].mean(axis=1)
                               for of_vertex in (field.values, field.normalized, field.agd))
    return InflatedComponent(shape, cut_at_levels(shape.mesh, values, sets.levels),
                             ScalarField(values, normalized, agd))


def _cut_solid(
    sets: LevelSets, field: ScalarField, band_ratio: float, judge: CutJudge, progress: Callable[[float], None]
) -> tuple[np.ndarray, Hierarchy]:
    """What ``_cut_in_creases`` returns, of a component without sheets."""
    label = concave_patches(sets.mesh)
    progress(0.2)
    hierarchy, curvature = _merge(sets, field, label, judge)
    progress(0.7)
    return move_cuts(MovableCuts(sets.mesh, curvature, band_ratio), label, hierarchy), hierarchy


def _on_coarse_copy(
    sets: LevelSets, field: ScalarField, pyramid: Pyramid, band_ratio: float, judges: Judges,
    progress: Callable[[float], None],
) -> tuple[np.ndarray, Hierarchy]:
    """Candidate of each face of a dense mesh, (m,) int64, and the hierarchy over the candidates.

    The candidates are found on a coarse copy; the cuts of detail 0.5 are then moved on finer and finer ones, at last on
    the mesh itself.
    """
    steps = coarse_copies(pyramid)
    progress(0.1)
    if not steps:
        return _cut_in_creases(sets, field, band_ratio, judges, progress)
    owner, copy = arange(pyramid.mesh.n_vertices), pyramid.mesh
    for step in steps:
        owner, copy = step.owner[owner], step.mesh
    coarse_field = restricted(field, owner, sets.mesh.vertex_area, copy.n_vertices)
    label, hierarchy = _cut_in_creases(
        cut_at_levels(copy, coarse_field.values, sets.levels), coarse_field, band_ratio, judges,
        lambda share: progress(0.1 + 0.4 * share))
    progress(0.5)
    finer = [pyramid.mesh, *(step.mesh for step in steps[:-1])]
    for mesh, step in zip(finer[::-1], steps[::-1], strict=True):
        label = refined_labels(mesh, step, label, hierarchy, band_ratio)
        progress(0.5 + 0.5 * mesh.n_faces / sets.mesh.n_faces)
    return label, hierarchy


def salience_of(share: np.ndarray, share_at_half: float = SHARE_AT_HALF) -> np.ndarray:
    """Turn shares of people into saliences: 0, ``share_at_half`` and 1 become 0, 0.5 and 1, linearly between.

    share : (k,) float64, 0..1. Returns (k,) float64, 0..1.
    """
    return np.interp(share, [0.0, share_at_half, 1.0], [0.0, 0.5, 1.0])


@cache
def cut_model() -> BoostedTrees:
    """Read the model that judges cuts of closed surfaces, which benchmarks/train.py trained; it is read once and kept.

    Returns a BoostedTrees over the columns FEATURES. Raises ReebError if the file was trained on other features.
    """
    return BoostedTrees.read(files(__package__) / "cut_model.npz", FEATURES)


@cache
def sheet_model() -> BoostedTrees:
    """Read the model that judges cuts of inflated sheets: as ``cut_model``, and learned from flat figures, too."""
    return BoostedTrees.read(files(__package__) / "sheet_model.npz", FEATURES)

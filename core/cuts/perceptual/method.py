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
from ...mesh.face_graph import FaceGraph, connect, fill_unlabeled
from ...mesh.labels import majority
from ...mesh.triangles import TriMesh
from ...parameters import Parameters
from ...surface.coarsening import Coarsening, Pyramid, coarsen
from ...surface.curvature import MAX_CURVATURE
from ...surface.denoising import denoised
from ...surface.sheets import Inflated, inflated, sheet_faces
from ..boosted_trees import BoostedTrees
from ..hierarchy import Candidates, Hierarchy
from ..minimum_cut import MovableCuts, move_cuts
from ..patches import concave_patches
from .features import FEATURES
from .level_set_patches import level_set_patches
from .measures import BORDER, surface_measures
from .merging import RegionAdjacencyGraph, merge_all_

# Share of people who separate two regions, 0..1, from which on their cut stays at detail 0.5: of solids, and of sheets,
# where what was learned from says it is certain.
SHARE_AT_HALF, SHEET_SHARE_AT_HALF = 0.55, 0.6
# Largest number of faces of a mesh that is cut itself. A denser mesh is cut on a coarse copy of at most so many faces,
# which are still much smaller than parts.
MAX_FACES = 60_000
WHOLE = 0.9  # share of its area from which on the coarse copy of a surface is not torn
IN_VAIN = 0.8  # share of its faces above which a copy in which pieces stay whole is hardly coarser
BAND = 3  # by how many edges of a copy cuts that were found on it move on a finer one, at most


def perceptual_candidates(
    sets: LevelSets,
    field: ScalarField,
    pyramid: Pyramid,
    parameters: Parameters,
    model: BoostedTrees | None = None,
    progress: Callable[[float], None] | None = None,
) -> Candidates:
    """Divide a component into patches between creases, and merge them as a model of people's cuts judges.

    Parameters
    ----------
    sets : LevelSets
        Level sets of one connected component.
    field : ScalarField
        AGD of the component.
    pyramid : Pyramid
        Coarser copies of the component's mesh.
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
    steps = _coarse_copies(pyramid)
    progress(0.1)
    if not steps:
        return _cut_in_creases(sets, field, band_ratio, judges, progress)
    owner, copy = arange(pyramid.mesh.n_vertices), pyramid.mesh
    for step in steps:
        owner, copy = step.owner[owner], step.mesh
    coarse_field = _restrict(field, owner, sets.mesh.vertex_area, copy.n_vertices)
    label, hierarchy = _cut_in_creases(
        cut_at_levels(copy, coarse_field.values, sets.levels), coarse_field, band_ratio, judges,
        lambda share: progress(0.1 + 0.4 * share))
    progress(0.5)
    finer = [pyramid.mesh, *(step.mesh for step in steps[:-1])]
    for mesh, step in zip(finer[::-1], steps[::-1], strict=True):
        label = _refined(mesh, step, label, hierarchy, band_ratio)
        progress(0.5 + 0.5 * mesh.n_faces / sets.mesh.n_faces)
    return label, hierarchy


def _coarse_copies(pyramid: Pyramid) -> list[Coarsening]:
    """The steps to a coarse copy of at most MAX_FACES faces, in which the surface is whole.

    Where the surface is thin, or has small pieces, a copy may lack triangles. Pieces that would lose some stay as they
    are; if then hardly anything is left to coarsen, the last copy has more faces.
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


def _refined(
    mesh: TriMesh, step: Coarsening, label: np.ndarray, hierarchy: Hierarchy, band_ratio: float
) -> np.ndarray:
    """Candidate of each face of a mesh, (m,) int64, from those of a coarse copy: the cuts of detail 0.5 move anew.

    On the copy the cuts have found their places as well as its edges allow. So they move by BAND of these edges at
    most, and only faces near them are looked at.
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


def _restrict(field: ScalarField, owner: np.ndarray, weight: np.ndarray, n: int) -> ScalarField:
    """Field on a coarse copy of n vertices: the mean over each cell, weighted by ``weight``."""
    # All faces at a vertex, and in a cell, may be without area.
    weight = np.where(weight > 0, weight, 1e-12 * weight.mean())
    total = np.bincount(owner, weight, n)
    return ScalarField(*(np.bincount(owner, weight * f, n) / total
                         for f in (field.values, field.normalized, field.agd)))


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

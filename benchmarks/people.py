# SPDX-License-Identifier: GPL-3.0-or-later
"""Merging with people's segmentations at hand: what train.py and crossvalidate.py learn from."""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from core.arrays.ties import in_steps
from core.cuts.patches import concave_patches
from core.cuts.perceptual.measures import SurfaceMeasures, surface_measures
from core.cuts.perceptual.merging import RegionAdjacencyGraph, merge_all_
from core.cuts.perceptual.method import inflate
from core.mesh.polygons import PolygonMesh
from core.mesh.triangles import TriMesh
from core.metrics import Overlap
from core.parameters import Parameters
from core.pipeline import level_sets_of
from core.progress import Stopwatch
from core.surface.ordering import sorted_by_place
from core.surface.preparation import Component, WorkingMesh, repair

CATEGORIES = (
    ("Human", 1), ("Cup", 21), ("Glasses", 41), ("Airplane", 61), ("Ant", 81), ("Chair", 101),
    ("Octopus", 121), ("Table", 141), ("Teddy", 161), ("Hand", 181), ("Plier", 201), ("Fish", 221),
    ("Bird", 241), ("Armadillo", 281), ("Bust", 301), ("Mech", 321), ("Bearing", 341), ("Vase", 361),
    ("FourLeg", 381))


def category_of(number: int) -> str:
    """Category of a mesh of the benchmark."""
    return [name for name, first in CATEGORIES if first <= number][-1]


def mesh_numbers(folder: Path) -> list[int]:
    """Meshes in a folder of N.npz."""
    return sorted(int(p.stem) for p in folder.glob("*.npz") if re.fullmatch(r"\d+", p.stem))


@dataclass(frozen=True, eq=False)
class Subject:
    """A mesh measured, cut into patches, and how people label the patches.

    Attributes
    ----------
    mesh, measures, label
        As in core.cuts.perceptual.method, of the refined mesh; of a sheet, of the inflated one.
    votes : (patches, people's parts) float64
        Faces of the benchmark in each patch with each label of each person.
    n_people : int
    error : float
        Rand index error of the patches as they are.
    median_parts : float
        Of people.
    """

    mesh: TriMesh
    measures: SurfaceMeasures
    label: np.ndarray
    votes: np.ndarray
    n_people: int
    error: float
    median_parts: float

    @property
    def n_faces(self) -> float:
        return self.votes.sum() / self.n_people


def varied(vertices: np.ndarray, faces: np.ndarray, rng: np.random.Generator) -> np.ndarray:
    """Vertices of a mesh changed so that people's parts stay where they are.

    Stretched by up to a fifth along three random axes; one in three noisy along the normals, one in
    three smoothed.
    """
    axes = np.linalg.qr(rng.normal(size=(3, 3)))[0]
    vertices = (vertices @ axes) * np.exp(rng.uniform(-0.2, 0.2, 3)) @ axes.T
    mesh = TriMesh(vertices, faces)
    kind = rng.integers(3)
    if kind == 1:
        normal = mesh.vertex_area_normals
        normal /= np.maximum(np.linalg.norm(normal, axis=1, keepdims=True), 1e-300)
        step = np.median(mesh.edge_length) * rng.uniform(0.03, 0.15)
        return vertices + step * rng.normal(size=(mesh.n_vertices, 1)) * normal
    if kind == 2:
        a, b = mesh.edges.vertices.T
        degree = np.bincount(mesh.edges.vertices.ravel(), minlength=mesh.n_vertices)
        for _ in range(rng.integers(2, 11)):
            around = [np.bincount(a, c[b], mesh.n_vertices) + np.bincount(b, c[a], mesh.n_vertices)
                      for c in vertices.T]
            mean = np.stack(around, axis=1) / np.maximum(degree, 1)[:, None]
            vertices = (vertices + mean) / 2
    return vertices


def working_mesh(vertices: np.ndarray, faces: np.ndarray) -> tuple[WorkingMesh, np.ndarray]:
    """The sorted and repaired copy of a mesh that ``decompose`` works on, and which of the m faces each of its is."""
    given, ordering = sorted_by_place(PolygonMesh.of(vertices, faces))
    return repair(given), ordering.polygon


def prepare(vertices: np.ndarray, faces: np.ndarray, human: np.ndarray,
            n_patches: int | None = None) -> Subject:
    """Everything that does not depend on the model."""
    working, owner = working_mesh(vertices, faces)
    component = Component.of(working, np.arange(working.mesh.n_faces))
    _, field, sets = level_sets_of(component, Parameters(), Stopwatch(None))
    mesh, owner = component.mesh, owner[component.polygon]
    solid = inflate(sets, field)
    if solid is not None:
        mesh, sets, field, owner = solid.sets.mesh, solid.sets, solid.field, owner[solid.shape.face_source]
    label = concave_patches(mesh, *([n_patches] if n_patches else []))
    weight = 1.0 / np.bincount(owner, minlength=len(faces))[owner]
    votes = []
    for person in human:
        _, part = np.unique(person, return_inverse=True)
        n = int(part.max()) + 1
        cells = np.bincount(label * n + part.reshape(-1)[owner], weight, (label.max() + 1) * n)
        votes.append(cells.reshape(-1, n))
    parts = np.median([v.shape[1] for v in votes])
    return Subject(mesh, surface_measures(sets, field), label, np.hstack(votes), len(human),
                   _error(votes), float(parts))


def _error(votes: list[np.ndarray]) -> float:
    """Mean Rand index error of the patches against people, from their tables of counts."""
    overlaps = [Overlap(np.argwhere(table), table[table > 0], table[table > 0]) for table in votes]
    return float(np.mean([overlap.rand_index_error for overlap in overlaps]))


class VotedGraph(RegionAdjacencyGraph):
    """A region graph that knows what share of people separates two regions."""

    def __init__(self, subject: Subject):
        super().__init__(subject.mesh, subject.measures, subject.label)
        self.subject = subject
        self.votes = subject.votes.copy()
        self.error = [subject.error]  # Rand index error after each merge

    def counts(self, borders) -> np.ndarray:
        """(k, 2) faces on either side."""
        return self.votes.sum(axis=1)[self.ends[borders]] / self.subject.n_people

    def people(self, borders) -> np.ndarray:
        """(k,) share of pairs of faces across each border that people separate, on average."""
        a, b = self.ends[borders].T
        same = (self.votes[a] * self.votes[b]).sum(axis=1) / self.subject.n_people
        return 1.0 - same / np.maximum(self.counts(borders).prod(axis=1), 1e-9)

    def merge_(self, border: int) -> list[int]:
        n = self.subject.n_faces
        change = (2 * self.people([border])[0] - 1) * self.counts([border])[0].prod()
        self.error.append(self.error[-1] + change / (n * (n - 1) / 2))
        a, b = self.ends[border].copy()
        gone = super().merge_(border)
        self.votes[a] += self.votes[b]
        return gone


@dataclass(frozen=True, eq=False)
class Run:
    """One merging to the end: the states it met, and how good every stop would have been.

    Attributes
    ----------
    rows : (k, features) float32
        Cuts as judged.
    share, weight : (k,) float64
        What people say of each, and how many pairs of faces it concerns.
    error : (c,) float64
        Rand index error after 0..c - 1 merges.
    salience : (c - 1,) float64
    """

    rows: np.ndarray
    share: np.ndarray
    weight: np.ndarray
    error: np.ndarray
    salience: np.ndarray

    def n_parts(self, decision: float) -> int:
        """Parts left where a salience is first reached."""
        return len(self.error) - int(np.searchsorted(np.maximum.accumulate(self.salience), decision))

    def error_at(self, decision: float) -> float:
        """Rand index error there."""
        return float(self.error[len(self.error) - self.n_parts(decision)])


def merge_and_record(subject: Subject, model=None) -> Run:
    """Merge by a model of cuts, or without one as people would."""
    graph = VotedGraph(subject)
    rows, share, weight = [], [], []

    def judge(graph, borders):
        features = in_steps(graph.features_(borders))
        people = graph.people(borders)
        rows.append(features.astype(np.float32))
        share.append(people)
        weight.append(graph.counts(borders).prod(axis=1) / subject.n_faces**2)
        return people.copy() if model is None else model(features)

    _, salience = merge_all_(graph, judge)
    return Run(*map(np.concatenate, (rows, share, weight)), np.array(graph.error), salience)

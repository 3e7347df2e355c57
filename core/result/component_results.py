# SPDX-License-Identifier: GPL-3.0-or-later
"""What the stages found on the components, and what of it each of the caller's faces chooses among."""

from __future__ import annotations

from dataclasses import dataclass, replace
from dataclasses import field as dataclass_field
from functools import cached_property
from itertools import accumulate

import numpy as np

from ..arrays.indexing import place_among, renumbered
from ..cuts.hierarchy import LAST, Candidates, Dendrogram, Hierarchy
from ..field.agd import ScalarField
from ..graph.level_sets import LevelSets
from ..graph.reeb import ReebGraph, ReebTopology
from ..mesh.labels import majority
from ..mesh.polygons import PolygonMesh
from ..surface.preparation import Bodies, Component, WorkingMesh


@dataclass(frozen=True, eq=False)
class ComponentResult:
    """Everything that the stages found on one component.

    Attributes
    ----------
    component : Component
        The component of the working copy.
    field : ScalarField
        AGD at the component's vertices.
    sets : LevelSets
        Level sets of the field.
    topology : ReebTopology
        Nodes and arcs of the Reeb graph, simplified.
    graph : ReebGraph
        The Reeb graph with values, positions and center lines.
    candidates : Candidates
        Candidates and the order in which they merge.
    contacts : (k, 2) int64
        Faces of the component's mesh that touch, or nearly so, though they share no edge.
    """

    component: Component
    field: ScalarField
    sets: LevelSets
    topology: ReebTopology
    graph: ReebGraph
    candidates: Candidates
    contacts: np.ndarray = dataclass_field(default_factory=lambda: np.empty((0, 2), np.int64))

    @cached_property
    def face_candidate(self) -> np.ndarray:
        """(m,) int64, the candidate that has most of each face of the component's mesh."""
        sets = self.sets
        return majority(sets.element_face, self.candidates.element_candidate, sets.element_weight, sets.mesh.n_faces)


@dataclass(frozen=True, eq=False)
class Findings:
    """Everything that the stages found on a mesh, before it is brought back to the caller's faces.

    Attributes
    ----------
    given : PolygonMesh
        The caller's mesh, p faces and n vertices.
    working : WorkingMesh
        Repaired copy of it.
    bodies : Bodies
        Of the copy.
    results : list of ComponentResult
        One for each body that was decomposed, with contacts; every piece of the others becomes one candidate.
    """

    given: PolygonMesh
    working: WorkingMesh
    bodies: Bodies
    results: list[ComponentResult]

    @property
    def contacts(self) -> np.ndarray:
        """(k, 2) int64, faces of the caller that touch though they share no edge: in one body."""
        within = (r.component.polygon[r.contacts] for r in self.results)
        found = np.concatenate([self.working.stitches, self.bodies.contacts, *within])
        return found[found[:, 0] != found[:, 1]]  # fine parts of one large face may be joined


@dataclass(frozen=True, eq=False)
class FoundCandidates:
    """The candidates of all components, on the pieces of the caller's faces that they were found on.

    Attributes
    ----------
    face : (r,) int64
        In which of the caller's faces each piece lies.
    label : (r,) int64
        Candidate of each piece.
    area : (r,) float64
        Above 0.
    hierarchy : Hierarchy
        Over the candidates.
    """

    face: np.ndarray
    label: np.ndarray
    area: np.ndarray
    hierarchy: Hierarchy

    @classmethod
    def of(cls, results: list[ComponentResult]) -> FoundCandidates:
        """What the stages found, on the elements between level sets."""
        first = firsts([r.candidates.hierarchy.n_candidates for r in results])
        face = [r.component.polygon[r.sets.element_face] for r in results]
        label = [k + r.candidates.element_candidate for k, r in zip(first, results, strict=True)]
        area = [r.sets.element_weight for r in results]
        nothing = np.empty(0, np.int64), np.empty(0)  # of nothing but small pieces none is decomposed
        return cls(np.concatenate([nothing[0], *face]), np.concatenate([nothing[0], *label]),
                   np.concatenate([nothing[1], *area]), Hierarchy.join([r.candidates.hierarchy for r in results]))

    def with_rest(self, findings: Findings) -> FoundCandidates:
        """These, and a candidate for each piece of the bodies that were not decomposed.

        What is one body merges first; in the end all are one part.
        """
        working, bodies = findings.working, findings.bodies
        rest = np.ones(working.mesh.n_faces, bool)
        for component in bodies.decomposed:
            rest[component.faces] = False
        if not rest.any():
            return replace(self, hierarchy=merged_at_last(self.hierarchy))
        count, piece = working.mesh.face_components
        names, numbers = renumbered(piece[rest])
        area = working.mesh.face_weight[rest]
        touching = place_among(names, count)[working.polygon_piece[bodies.contacts]]
        merges = touching[Dendrogram.of(len(names), touching).rows]
        small = Hierarchy.of(len(names), merges, np.zeros(len(merges)))
        return FoundCandidates(np.concatenate([self.face, working.polygon[rest]]),
                               np.concatenate([self.label, self.hierarchy.n_candidates + numbers]),
                               np.concatenate([self.area, area]),
                               merged_at_last(Hierarchy.join([self.hierarchy, small])))


def firsts(counts: list[int]) -> list[int]:
    """Where each of several lists begins when they are put one after the other. counts : their lengths."""
    return [0, *accumulate(counts)][:-1]


def merged_at_last(hierarchy: Hierarchy) -> Hierarchy:
    """Let what never merges merge last, one after the other: detail 0 is one part."""
    left = hierarchy.parts(0)
    first = np.unique(left, return_index=True)[1]
    merges = np.stack([np.repeat(first[:1], len(first[1:])), first[1:]], axis=1)
    salience = np.concatenate([hierarchy.salience, np.full(len(merges), LAST)])
    return Hierarchy.of(hierarchy.n_candidates, np.concatenate([hierarchy.merges, merges]), salience)

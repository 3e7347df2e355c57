# SPDX-License-Identifier: GPL-3.0-or-later
"""What the stages found on the components, and what of it each of the caller's faces chooses among."""

from __future__ import annotations

from dataclasses import dataclass
from dataclasses import field as dataclass_field
from functools import cached_property

import numpy as np

from ..cuts.hierarchy import Candidates, Hierarchy
from ..cuts.joining.method import LAST
from ..field.agd import ScalarField
from ..graph.level_sets import LevelSets
from ..graph.reeb import ReebGraph, ReebTopology
from ..surface.arrays import renumbered
from ..surface.labels import majority
from ..surface.polygons import PolygonMesh
from ..surface.preparation import Component, WorkingMesh
from .votes import FaceVotes

# Added to the areas and lengths by which faces vote for labels: as a share of the area of the mesh, and in units of the
# vertices. Faces without an area vote with this weight, after all others.
LEAST_WEIGHT = 1e-12


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
        mesh = self.component.mesh
        area = self.sets.element_area + LEAST_WEIGHT * mesh.area
        return majority(self.sets.element_face, self.candidates.element_candidate, area, mesh.n_faces)


def face_votes(
    given: PolygonMesh, working: WorkingMesh, results: list[ComponentResult]
) -> tuple[FaceVotes, Hierarchy]:
    """What candidates have of each of the caller's faces, and the hierarchy over the candidates."""
    owner, label, weight, hierarchies, first = [], [], [], [], 0
    rest = np.ones(working.mesh.n_faces, bool)
    for r in results:
        sets = r.sets
        owner.append(r.component.polygon[sets.element_face])
        label.append(first + r.candidates.element_candidate)
        weight.append(sets.element_area + LEAST_WEIGHT * sets.mesh.area)
        hierarchies.append(r.candidates.hierarchy)
        first += r.candidates.hierarchy.n_candidates
        rest[r.component.faces] = False
    if rest.any():  # components that were not decomposed are one candidate each
        names, numbers = renumbered(working.mesh.face_components[1][rest])
        owner.append(working.polygon[rest])
        label.append(first + numbers)
        weight.append(working.mesh.face_area[rest] + LEAST_WEIGHT * working.mesh.area)
        hierarchies.append(Hierarchy.of(len(names), [], []))
    hierarchy = _join_bodies(Hierarchy.join(hierarchies))
    return FaceVotes(np.concatenate(owner), np.concatenate(label), np.concatenate(weight), given.n_polygons,
                     hierarchy), hierarchy


def _join_bodies(hierarchy: Hierarchy) -> Hierarchy:
    """Let what never merges merge last, one after the other: detail 0 is one part."""
    left = hierarchy.parts(0)
    first = np.unique(left, return_index=True)[1]
    merges = np.stack([np.full(len(first) - 1, first[0]), first[1:]], axis=1)
    salience = np.concatenate([hierarchy.salience, np.full(len(merges), LAST)])
    return Hierarchy.of(hierarchy.n_candidates, np.concatenate([hierarchy.merges, merges]), salience)

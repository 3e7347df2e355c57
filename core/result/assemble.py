# SPDX-License-Identifier: GPL-3.0-or-later
"""The way back: what was found on the components of the working copy, on the caller's faces and vertices."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from ..cuts.hierarchy import Candidates, Dendrogram, Hierarchy
from ..field.agd import ScalarField
from ..graph.level_sets import LevelSets
from ..graph.reeb import ReebGraph, ReebTopology
from ..parameters import Parameters
from ..sentence import Sentence
from ..surface.arrays import renumbered
from ..surface.labels import FaceGraph, connect, fill_unlabelled, majority, straighten
from ..surface.polygons import PolygonMesh
from ..surface.preparation import Component, WorkingMesh
from .decomposition import Decomposition

# Added to areas and lengths that weigh votes, as a share of the whole: what has none still votes, after all others.
LEAST_WEIGHT = 1e-12


@dataclass(frozen=True, eq=False)
class ComponentResult:
    """What the stages found on one component.

    Attributes
    ----------
    component : Component
    field : ScalarField
    sets : LevelSets
    topology : ReebTopology
        Simplified.
    graph : ReebGraph
    candidates : Candidates
    """

    component: Component
    field: ScalarField
    sets: LevelSets
    topology: ReebTopology
    graph: ReebGraph
    candidates: Candidates


def assemble(
    given: PolygonMesh,
    working: WorkingMesh,
    results: list[ComponentResult],
    parameters: Parameters,
    seconds: dict[str, float],
) -> Decomposition:
    """Bring candidates, field and graph back to the caller's faces and vertices.

    Parameters
    ----------
    given : PolygonMesh
        The caller's mesh.
    working : WorkingMesh
        Its repaired copy.
    results : list of ComponentResult
        Of the components that were decomposed; every other component becomes one candidate.
    parameters : Parameters
    seconds : dict
        Of each stage so far.

    Returns
    -------
    decomposition : Decomposition
    """
    face_graph = _face_graph(given, working)
    label, hierarchy = _face_candidates(given, working, results, face_graph, parameters.smoothing)
    values, notes = _vertex_field(given, working, results)
    pairs, length = face_graph.boundaries(label)
    corners = given.triangles.faces.ravel()
    weight = np.repeat(given.triangles.face_area + LEAST_WEIGHT * given.triangles.area, 3)
    vertex = majority(corners, np.repeat(label[given.polygon], 3), weight, given.triangles.n_vertices)
    nodes, points = _graph_candidates(results, label)
    return Decomposition(
        candidates=label, vertex_candidates=vertex,
        candidate_area=np.bincount(label, face_graph.area), candidate_pairs=pairs,
        candidate_pair_length=length, hierarchy=hierarchy, field=values,
        graph=ReebGraph.join([_in_field(r.graph, r.field) for r in results]), node_candidate=nodes,
        point_candidate=points, parameters=parameters, notes=working.notes + notes,
        seconds=seconds)


def _in_field(graph: ReebGraph, field: ScalarField) -> ReebGraph:
    """The graph with the values of the normalized field in place of those whose levels were taken."""
    order = np.argsort(field.values, kind="stable")
    known = field.values[order], field.normalized[order]
    return replace(graph, node_value=np.interp(graph.node_value, *known),
                   point_value=np.interp(graph.point_value, *known))


def _face_graph(given: PolygonMesh, working: WorkingMesh) -> FaceGraph:
    """Which faces of the caller touch; a face that the working copy lacks hangs on one neighbor."""
    mesh = working.mesh
    pairs = working.polygon[mesh.edges.pairs]
    apart = pairs[:, 0] != pairs[:, 1]
    lost = _lost_faces(given, working)
    pairs = np.concatenate([pairs[apart], lost])
    length = np.concatenate([mesh.pair_length[apart], np.zeros(len(lost))])
    area = np.bincount(given.polygon, given.triangles.face_area, given.n_polygons)
    return FaceGraph(given.n_polygons, pairs, length, area)


def _lost_faces(given: PolygonMesh, working: WorkingMesh) -> np.ndarray:
    """(l, 2) int64: each face with repeated corners only, and a neighbor by edge, else by corner."""
    kept = np.zeros(given.n_polygons, bool)
    kept[working.polygon] = True
    kept_triangle = kept[given.polygon]
    at_vertex = np.full(given.triangles.n_vertices, -1)
    at_vertex[given.triangles.faces[kept_triangle]] = given.polygon[kept_triangle][:, None]
    pairs = given.polygon[given.triangles.edges.pairs]
    by_corner = np.stack([np.repeat(given.polygon[~kept_triangle], 3),
                          at_vertex[given.triangles.faces[~kept_triangle]].ravel()], axis=1)
    pairs = np.concatenate([pairs, pairs[:, ::-1], by_corner[by_corner[:, 1] >= 0]])
    pairs = pairs[~kept[pairs[:, 0]] & kept[pairs[:, 1]]]
    return pairs[np.unique(pairs[:, 0], return_index=True)[1]]


def _face_candidates(
    given: PolygonMesh, working: WorkingMesh, results: list[ComponentResult], face_graph: FaceGraph, rounds: int
) -> tuple[np.ndarray, Hierarchy]:
    """One candidate per face of the caller, each connected, and the hierarchy over them."""
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
    if rest.any():  # components that were not decomposed, one candidate each
        names, numbers = renumbered(working.mesh.face_components[1][rest])
        owner.append(working.polygon[rest])
        label.append(first + numbers)
        weight.append(working.mesh.face_area[rest] + LEAST_WEIGHT * working.mesh.area)
        hierarchies.append(Hierarchy.of(len(names), [], []))
    face_label = majority(
        np.concatenate(owner), np.concatenate(label), np.concatenate(weight), given.n_polygons)
    face_label = connect(face_graph, fill_unlabelled(face_graph, face_label))
    face_label = connect(face_graph, straighten(face_graph, face_label, rounds))
    return settle(face_graph, face_label, Hierarchy.join(hierarchies))


def settle(graph: FaceGraph, label: np.ndarray, hierarchy: Hierarchy) -> tuple[np.ndarray, Hierarchy]:
    """Keep the candidates that exist on the caller's faces, and merge only those that touch there.

    Parameters
    ----------
    graph : FaceGraph
    label : (n_faces,) int64
        Candidate of each face; each candidate connected.
    hierarchy : Hierarchy
        Of all candidates, present on faces or not.

    Returns
    -------
    label : (n_faces,) int64
        0..c-1, all present.
    hierarchy : Hierarchy
        Of the c candidates. Merges follow the given order; one whose two sides do not touch on
        the caller's faces waits until they do.
    """
    present, label = renumbered(label)
    touching, _ = graph.boundaries(label)
    merge = hierarchy.merge_of(*present[touching].T)
    order = np.argsort(merge, kind="stable")
    order = order[merge[order] < len(hierarchy.merges)]
    rows = order[Dendrogram.of(len(present), touching[order]).rows]
    return label, Hierarchy.of(len(present), touching[rows], hierarchy.salience[merge[rows]])


def _vertex_field(
    given: PolygonMesh, working: WorkingMesh, results: list[ComponentResult]
) -> tuple[np.ndarray, tuple[str, ...]]:
    """The normalized field at the caller's vertices, and notes about components."""
    values = np.full(given.triangles.n_vertices, np.nan)
    used = np.unique(given.triangles.faces)
    values[used] = 0.0  # in components that were not decomposed
    for r in results:
        kept = r.component.vertex_source >= 0
        values[r.component.vertex_source[kept]] = r.field.normalized[kept]
    n_loose = working.mesh.face_components[0]
    n_flat = sum(not r.field.values.any() for r in results)
    return values, tuple(_component_notes(n_loose, n_loose - len(results), n_flat))


def _component_notes(n_loose, n_small, n_flat):
    """Sentences about loose parts: how many, how many of these too small, or too even, to be cut."""
    if n_loose > 1 and n_small:
        yield Sentence("{n} loose parts are decomposed each on its own; {small} small ones are one part "
                       "each.", n=n_loose, small=n_small)
    elif n_loose > 1:
        yield Sentence("{n} loose parts are decomposed each on its own.", n=n_loose)
    if n_flat and n_loose > 1:
        yield Sentence("{n} of the loose parts are so even that nothing protrudes: one part each.",
                       n=n_flat)
    elif n_flat:
        yield Sentence("Nothing protrudes: the mesh is one part.")


def _graph_candidates(results: list[ComponentResult], label: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """The candidate in which each node and each center point of the joined graph lies."""
    nodes, points = [np.empty(0, np.int64)], [np.empty(0, np.int64)]
    for r in results:
        sets, topology = r.sets, r.topology
        element_label = label[r.component.polygon[sets.element_face]]
        node = topology.piece_node[sets.element_piece]
        inside = node >= 0
        area = sets.element_area[inside] + LEAST_WEIGHT * sets.mesh.area
        nodes.append(majority(node[inside], element_label[inside], area, topology.n_nodes))
        segment_label = label[r.component.polygon[sets.segment_face]]
        of_contour = majority(sets.segment_contour, segment_label,
                              sets.segment_length + LEAST_WEIGHT, sets.n_contours)
        points.append(of_contour[topology.arc_contours(sets)[0]])
    return np.concatenate(nodes), np.concatenate(points)

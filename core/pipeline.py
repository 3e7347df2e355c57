# SPDX-License-Identifier: GPL-3.0-or-later
"""The one door: arrays in, a decomposition out. The stages of the method, in order."""

from __future__ import annotations

import time
from collections.abc import Callable
from contextlib import contextmanager
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from .cuts.berretti.method import berretti_candidates
from .cuts.hierarchy import Hierarchy
from .cuts.perceptual.method import perceptual_candidates
from .field.agd import FIELD_VERTICES, ScalarField, agd_field, coarse_agd
from .graph.level_sets import LevelSets, cut_at_levels, uniform_levels
from .graph.reeb import ReebGraph, ReebStructure, reeb_graph, reeb_structure
from .graph.simplify import simplify
from .parameters import PERCEPTUAL, Parameters
from .result.decomposition import Decomposition
from .sentence import Sentence
from .surface.coarsening import Coarsening, coarsen
from .surface.labels import FaceGraph, connect, fill_unlabelled, majority, settle, straighten
from .surface.mesh import MIN_FACES, PolygonMesh, TriMesh
from .surface.preparation import MAX_EDGE, WorkingMesh, refine, repair

# The graph to look at leaves out leaves that cover less than this share of a component, or
# less than this many levels: ripples, not protrusions.
MIN_LEAF_AREA = 0.0025
MIN_LEAF_LEVELS = 1
# Nor does it show leaves over which the AGD changes by less than this share of its maximum:
# that is the error of the distances.
MIN_LEAF_HEIGHT = 0.005
# Below this share of its maximum, the variation of the AGD is the error of the distances.
FLAT_FIELD = 0.03
# Where the component stages begin and end, as shares of the time on a mesh of some 100,000 vertices.
MESH_SHARE, PARTS_SHARE = 0.14, 0.9

Progress = Callable[[str, float], None]


@dataclass(frozen=True, eq=False)
class Component:
    """One loose part of the surface on its way through the stages.

    Attributes
    ----------
    mesh : TriMesh
        Refined.
    polygon : (m,) int64
        The caller's face that each triangle lies in.
    vertex_source : (n,) int64
        The caller's vertex of each vertex, -1 for one that refinement added.
    """

    mesh: TriMesh
    polygon: np.ndarray
    vertex_source: np.ndarray

    @cached_property
    def coarsening(self) -> Coarsening | None:
        """The first step to a coarse copy, which distances and cuts share; None where it is not needed."""
        dense = self.mesh.n_vertices > FIELD_VERTICES
        return coarsen(self.mesh, self.mesh.vertex_area) if dense else None


@dataclass(frozen=True, eq=False)
class Candidates:
    """Candidate parts of one component.

    Attributes
    ----------
    element_candidate : (E,) int64
        Candidate of each element (face, slab) of the level sets, 0..count-1.
    hierarchy : Hierarchy
        Over the candidates; decides what stays.
    """

    element_candidate: np.ndarray
    hierarchy: Hierarchy


class Stopwatch:
    """Seconds per stage, and the caller's progress function."""

    def __init__(self, progress: Progress | None):
        self.progress = progress or (lambda stage, share: None)
        self.seconds: dict[str, float] = {}
        self.share = 0.0

    @contextmanager
    def stage(self, name: str, until: float):
        """Time a stage that ends at a share of the whole; tells the caller when it starts."""
        self.progress(name, self.share)
        begin, start = time.perf_counter(), self.share
        yield lambda done: self.progress(name, start + done * (until - start))
        self.seconds[name] = self.seconds.get(name, 0.0) + time.perf_counter() - begin
        self.share = until


def decompose(
    vertices,
    faces,
    parameters: Parameters | None = None,
    polygon=None,
    progress: Progress | None = None,
) -> Decomposition:
    """Cut a mesh into parts.

    Parameters
    ----------
    vertices : (n, 3) array_like of float
    faces : (m, k) array_like of int, or a sequence of index sequences
        Triangles, quads or polygons.
    parameters : Parameters, optional
        The default preset without.
    polygon : (m,) array_like of int, optional
        For triangles that are a triangulation of the caller's polygons: the polygon of each.
        Labels are then per polygon.
    progress : callable, optional
        Called as progress(stage, share) between and within stages, share rising from 0 to 1.
        What it raises ends the computation; raise ``Cancelled`` to cancel.

    Returns
    -------
    decomposition : Decomposition
        ``decomposition.parts().labels`` is one part per face.

    Raises
    ------
    MeshError
        Shapes, indices or coordinates are wrong, or the mesh is too small to have parts.
    ParameterError
        Raised by ``Parameters`` itself.

    Notes
    -----
    Deterministic. Time is about that of one Dijkstra search per base vertex (some 140), the
    rest grows with faces + crossings of faces and levels.
    """
    parameters = parameters or Parameters()
    watch = Stopwatch(progress)
    with watch.stage("mesh", MESH_SHARE):
        given = PolygonMesh.of(vertices, faces, polygon)
        working = repair(given)
        count, component = working.mesh.face_components
        large = _large_components(working, count, component, parameters.loose_part)
    results = []
    for done, label in enumerate(large):
        width = (PARTS_SHARE - MESH_SHARE) / len(large)
        begin = MESH_SHARE + done * width
        watch.share = begin
        mask = component == label
        results.append(_decompose_component(
            working, mask, parameters, watch, begin, width))
    with watch.stage("parts", 1.0):
        result = _assemble(given, working, component, large, results, parameters, watch.seconds)
    watch.progress("done", 1.0)
    return result


def _large_components(working, count, component, loose_part) -> np.ndarray:
    """Components worth a decomposition of their own: of some area, and faces enough for parts."""
    area = np.bincount(component, working.mesh.face_area, count)
    n_polygons = int(working.polygon.max()) + 1
    faces = np.unique(component * np.int64(n_polygons) + working.polygon)
    n_faces = np.bincount(faces // n_polygons, minlength=count)
    return np.flatnonzero((area >= max(loose_part * area.sum(), 1e-12 * area.max()))
                          & (n_faces >= MIN_FACES))


@dataclass(frozen=True, eq=False)
class ComponentResult:
    """What one component contributes; see Decomposition."""

    mask: np.ndarray  # (m,) bool over the working mesh
    component: Component
    field: ScalarField
    graph: ReebGraph
    sets: LevelSets
    structure: ReebStructure
    candidates: Candidates


def _decompose_component(working, mask, parameters, watch, begin, width) -> ComponentResult:
    """All stages on one connected component."""
    with watch.stage("mesh", begin + 0.05 * width):
        part = _component(working, mask)
    with watch.stage("distances", begin + 0.4 * width) as progress:
        radius = np.sqrt(parameters.base_spacing * part.mesh.area)
        agd = coarse_agd(part.mesh, radius, progress, part.coarsening)
        field = _field(part.mesh, agd, parameters)
    with watch.stage("reeb graph", begin + 0.5 * width):
        levels = uniform_levels(parameters.levels) if field.values.any() else np.empty(0)
        sets = cut_at_levels(part.mesh, field.values, levels)
        structure = simplify(sets, reeb_structure(sets), MIN_LEAF_AREA, MIN_LEAF_LEVELS,
                             _level_height(field, levels), MIN_LEAF_HEIGHT)
        graph = reeb_graph(sets, structure)
    with watch.stage("cuts", begin + width) as progress:
        if parameters.method == PERCEPTUAL:
            found = perceptual_candidates(sets, field, parameters, progress, part.coarsening)
        else:
            found = berretti_candidates(sets, structure, parameters)
        candidates = Candidates(*found)
    return ComponentResult(mask, part, field, graph, sets, structure, candidates)


def _component(working: WorkingMesh, mask: np.ndarray) -> Component:
    """Cut out a component and refine it."""
    mesh, index = (working.mesh, slice(None)) if mask.all() else working.mesh.submesh(mask)
    source = working.vertex_source[index]
    fine, parent = refine(mesh, MAX_EDGE * np.sqrt(mesh.area))
    added = np.full(fine.n_vertices - len(source), -1)
    return Component(fine, working.polygon[mask][parent], np.concatenate([source, added]))


def _field(mesh, agd, parameters) -> ScalarField:
    field = agd_field(mesh, agd, parameters.equalise)
    if np.ptp(field.agd) < FLAT_FIELD * field.agd.max():
        nothing = np.zeros(mesh.n_vertices)
        return ScalarField(nothing, nothing, field.agd)
    return field


def _level_height(field: ScalarField, levels: np.ndarray) -> np.ndarray:
    """(K,) how much of the AGD each level stands for, as a share of its maximum."""
    if len(levels) == 0:
        return np.empty(0)
    order = np.argsort(field.values, kind="stable")
    at = np.interp(np.append(levels, [0.0, 1.0]), field.values[order], field.agd[order])
    *inner, low, high = at
    ends = np.concatenate([[low], inner, [high]])
    return (ends[2:] - ends[:-2]) / 2 / high


def _assemble(given, working, component, large, results, parameters, seconds) -> Decomposition:
    """Bring candidates, field and graph back to the caller's faces and vertices."""
    face_graph = _face_graph(given, working)
    label, hierarchy = _face_candidates(given, working, component, results, face_graph,
                                        parameters.smoothing)
    values, notes = _vertex_field(given, component, large, results)
    pairs, length = face_graph.boundaries(label)
    corners = given.triangles.faces.ravel()
    # Every corner votes; a little more than nothing where faces have no area.
    weight = np.repeat(given.triangles.face_area + 1e-12 * given.triangles.area, 3)
    vertex = majority(corners, np.repeat(label[given.polygon], 3), weight,
                      given.triangles.n_vertices)
    nodes, points = _graph_candidates(results, label)
    return Decomposition(
        candidates=label, vertex_candidates=vertex,
        candidate_area=np.bincount(label, face_graph.area), candidate_pairs=pairs,
        candidate_pair_length=length, hierarchy=hierarchy, field=values,
        graph=ReebGraph.join([_in_field(r.graph, r.field) for r in results]), node_candidate=nodes,
        point_candidate=points, parameters=parameters, notes=working.notes + notes,
        seconds=seconds)


def _in_field(graph: ReebGraph, field: ScalarField) -> ReebGraph:
    """A graph whose values are those of the normalised field, whatever its levels were taken of."""
    order = np.argsort(field.values, kind="stable")
    known = field.values[order], field.normalised[order]
    return replace(graph, node_value=np.interp(graph.node_value, *known),
                   point_value=np.interp(graph.point_value, *known))


def _face_graph(given: PolygonMesh, working: WorkingMesh) -> FaceGraph:
    """Faces of the caller that touch; faces the working copy lacks hang on one neighbour."""
    mesh = working.mesh
    pairs = working.polygon[mesh.edges.pairs]
    length = mesh.edge_length[mesh.edges.pair_edge]
    apart = pairs[:, 0] != pairs[:, 1]
    lost = _lost_faces(given, working)
    pairs = np.concatenate([pairs[apart], lost])
    length = np.concatenate([length[apart], np.zeros(len(lost))])
    area = np.bincount(given.polygon, given.triangles.face_area, given.n_polygons)
    return FaceGraph(given.n_polygons, pairs, length, area)


def _lost_faces(given: PolygonMesh, working: WorkingMesh) -> np.ndarray:
    """(l, 2) int64: each face with repeated corners only, and a neighbour by edge, else by corner."""
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


def _face_candidates(given, working, component, results, face_graph, rounds):
    """One candidate per face of the caller, connected, and the hierarchy over them."""
    owner, label, weight, hierarchies, first = [], [], [], [], 0
    for r in results:
        sets = r.sets
        owner.append(r.component.polygon[sets.element_face])
        label.append(first + r.candidates.element_candidate)
        weight.append(sets.element_area + 1e-12 * sets.mesh.area)
        hierarchies.append(r.candidates.hierarchy)
        first += r.candidates.hierarchy.n_candidates
    rest = np.ones(len(component), bool)
    for r in results:
        rest &= ~r.mask
    if rest.any():  # small loose parts, one candidate each
        names, numbers = np.unique(component[rest], return_inverse=True)
        owner.append(working.polygon[rest])
        label.append(first + numbers.reshape(-1))
        weight.append(working.mesh.face_area[rest] + 1e-12 * working.mesh.area)
        hierarchies.append(Hierarchy.of(len(names), [], []))
    face_label = majority(*map(np.concatenate, (owner, label, weight)), given.n_polygons)
    face_label = connect(face_graph, fill_unlabelled(face_graph, face_label))
    face_label = connect(face_graph, straighten(face_graph, face_label, rounds))
    return settle(face_graph, face_label, Hierarchy.join(hierarchies))


def _vertex_field(given, component, large, results) -> tuple[np.ndarray, tuple[str, ...]]:
    """The normalised field at the caller's vertices, and notes about components."""
    values = np.full(given.triangles.n_vertices, np.nan)
    used = np.unique(given.triangles.faces)
    values[used] = 0.0  # small loose parts
    for r in results:
        kept = r.component.vertex_source >= 0
        values[r.component.vertex_source[kept]] = r.field.normalised[kept]
    n_loose = int(component.max()) + 1
    n_flat = sum(not r.field.values.any() for r in results)
    return values, tuple(_component_notes(n_loose, n_loose - len(large), n_flat))


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


def _graph_candidates(results, label) -> tuple[np.ndarray, np.ndarray]:
    """The candidate in which each node and each centre point of the joined graph lies."""
    nodes, points = [np.empty(0, np.int64)], [np.empty(0, np.int64)]
    for r in results:
        sets, structure = r.sets, r.structure
        face_label = label[r.component.polygon[sets.element_face]]
        node = structure.piece_node[sets.element_piece]
        inside = node >= 0
        area = sets.element_area[inside] + 1e-12 * sets.mesh.area
        nodes.append(majority(node[inside], face_label[inside], area, structure.n_nodes))
        at = label[r.component.polygon[sets.segment_face]]
        of_contour = majority(sets.segment_contour, at,
                              sets.segment_length + 1e-12, sets.n_contours)
        kept = np.flatnonzero(structure.contour_arc >= 0)
        order = np.lexsort((sets.contour_level[kept], structure.contour_arc[kept]))
        points.append(of_contour[kept[order]])
    return np.concatenate(nodes), np.concatenate(points)

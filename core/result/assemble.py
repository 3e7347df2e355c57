# SPDX-License-Identifier: GPL-3.0-or-later
"""The assembly of the result: what was found on the components is brought back to the caller's faces and vertices."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from scipy.spatial import cKDTree

from ..arrays.components import components
from ..arrays.indexing import is_last_of_each, renumbered
from ..arrays.int64 import arange, full
from ..arrays.pairs import both_ways
from ..cuts.face_candidates import FaceCandidates
from ..cuts.hierarchy import Hierarchy
from ..cuts.hinted import hinted_candidates
from ..cuts.settling import settle
from ..cuts.swarms import joined_swarms
from ..cuts.symmetric.method import symmetric_candidates, turned_candidates
from ..cuts.symmetric.regions import MANY_FACES, symmetric_on_regions
from ..field.agd import ScalarField
from ..graph.reeb import ReebGraph
from ..mesh.face_graph import FaceGraph, connect, fill_unlabeled, straighten
from ..mesh.labels import majority
from ..mesh.polygons import PolygonMesh
from ..mesh.triangles import LEAST_WEIGHT
from ..parameters import TOGETHER, Parameters
from ..sentence import Sentence
from ..surface.preparation import WorkingMesh
from ..symmetry.mirrors import Mirror
from .bodies import contacts_and_links
from .component_results import ComponentResult, Findings, FoundCandidates
from .decomposition import Decomposition, too_many
from .junctions import FaceSides, boundaries, junctions
from .slivers import without_slivers
from .votes import WIDTH, FaceVotes
from .within_faces import symmetric_within_faces


def assemble(
    findings: Findings, mirrors: list[Mirror], parameters: Parameters, seconds: dict[str, float], hint: np.ndarray
) -> Decomposition:
    """Bring candidates, field and graph back to the caller's faces and vertices.

    Parameters
    ----------
    findings : Findings
    mirrors : list of Mirror
        Planes in which the parts are to be symmetric, as ``find_mirrors`` finds them.
    parameters : Parameters
    seconds : dict of str -> float
        Seconds that each stage has taken so far.
    hint : (p,) int64 or (0,)
        Hint of each of the caller's faces; empty for none.

    Returns
    -------
    decomposition : Decomposition
    """
    working, results = findings.working, findings.results
    candidates = _face_candidates(findings, mirrors, parameters, hint)
    tables = tables_of(findings.given, working, candidates)
    values, notes = _vertex_field(findings, parameters)
    nodes, points = _graph_candidates(results, candidates.label)
    first_shown = candidates.hierarchy.parts_at(Parameters().detail)[candidates.label]
    mirror = Mirror.joined([mirror.parting(first_shown) for mirror in mirrors])
    return Decomposition(
        **tables.attributes(), hierarchy=candidates.hierarchy, field=values,
        graph=ReebGraph.join([_in_field(r.graph, r.field) for r in results]), node_candidate=nodes,
        point_candidate=points, contacts=candidates.contacts, links=candidates.contacts[len(findings.contacts):],
        mirror=mirror.plane, face_twin=mirror.twin,
        face_side=np.sign(mirror.height).astype(np.int8), parameters=parameters,
        notes=working.notes + notes + too_many(parameters.n_parts, candidates.hierarchy.n_candidates),
        seconds=seconds)


def _face_candidates(
    findings: Findings, mirrors: list[Mirror], parameters: Parameters, hint: np.ndarray
) -> FaceCandidates:
    """The candidates of the caller's faces, after all that follows cutting. hint : (p,) int64 or empty."""
    working, results = findings.working, findings.results
    coarse = [mirror for mirror in mirrors if mirror.within]
    found = symmetric_within_faces(results, coarse) if coarse and results else FoundCandidates.of(results)
    graph = face_graph_of(findings.given, working)
    found = found.with_rest(findings)
    label = _voted(findings, graph, found, parameters)
    contacts = contacts_and_links(findings, graph)
    candidates = _with_loose_apart(FaceCandidates(graph, contacts, label, found.hierarchy), working)
    if parameters.pieces == TOGETHER:
        candidates = joined_swarms(candidates, working.mesh, working.polygon)
    for mirror in (mirror for mirror in mirrors if not mirror.within):
        candidates = _symmetric(candidates, mirror)
    if mirrors and len(candidates.contacts):  # what an edge joins on one side, a contact may join on the other
        candidates = _with_loose_apart(candidates, working)
    if parameters.traits.learned:  # the others are as they were published
        candidates = without_slivers(candidates)
    if len(hint):  # after symmetry: of what was marked on one side only, the other knows nothing
        candidates = hinted_candidates(candidates, hint)
    return settle(candidates)


def _symmetric(candidates: FaceCandidates, mirror: Mirror) -> FaceCandidates:
    """The candidates and their hierarchy made symmetric in a plane, and in all that were found with it."""
    if candidates.graph.n_faces > MANY_FACES and not mirror.exact:
        return symmetric_on_regions(candidates, mirror.twin, mirror.height, mirror.first, mirror.sure)
    if mirror.group is not None:
        return turned_candidates(candidates, mirror.group, mirror.beside)
    planes = (mirror, *mirror.across)
    return symmetric_candidates(
        candidates, np.array([plane.twin for plane in planes]), np.array([plane.height for plane in planes]),
        np.array([plane.first for plane in planes]), mirror.sure)


@dataclass(frozen=True, eq=False)
class CandidateTables:
    """What follows from the candidates of the caller's faces: attributes of a ``Decomposition``, by the same names."""

    candidates: np.ndarray
    vertex_candidates: np.ndarray
    candidate_area: np.ndarray
    candidate_pairs: np.ndarray
    candidate_pair_length: np.ndarray
    junctions: np.ndarray
    junction_length: np.ndarray

    def attributes(self) -> dict[str, Any]:
        """The arrays by the name of the attribute."""
        return dict(vars(self))


def tables_of(given: PolygonMesh, working: WorkingMesh, candidates: FaceCandidates) -> CandidateTables:
    """Measure the candidates of the caller's faces.

    Parameters
    ----------
    given : PolygonMesh
        p faces and n vertices.
    working : WorkingMesh
        Made of it.
    candidates : FaceCandidates
        Of the p faces, all in use.

    Returns
    -------
    tables : CandidateTables
    """
    graph, label = candidates.touching_graph(), candidates.label
    mesh = working.mesh
    sides = FaceSides(np.repeat(working.polygon, 3), mesh.edges.face_edges.ravel(), mesh.edge_length)
    pairs, length = boundaries(graph, label, sides)
    return CandidateTables(label, given.vertex_labels(label), np.bincount(label, graph.area), pairs, length,
                           *junctions(label, sides))


def _in_field(graph: ReebGraph, field: ScalarField) -> ReebGraph:
    """Copy of a graph whose values are those of the normalized field instead of the field whose levels were taken."""
    order = np.argsort(field.values, kind="stable")
    known = field.values[order], field.normalized[order]
    return replace(graph, node_value=np.interp(graph.node_value, *known),
                   point_value=np.interp(graph.point_value, *known))


def face_graph_of(given: PolygonMesh, working: WorkingMesh) -> FaceGraph:
    """Which of the caller's faces touch. A face that the working copy lacks touches one neighbor, along length 0.

    given : PolygonMesh. working : WorkingMesh, made of it.
    """
    mesh = working.mesh
    pairs = working.polygon[mesh.edges.pairs]
    apart = pairs[:, 0] != pairs[:, 1]
    lost = _lost_faces(given, working)
    pairs = np.concatenate([pairs[apart], lost])
    length = np.concatenate([mesh.pair_length[apart], np.zeros(len(lost))])
    area = np.bincount(given.polygon, given.triangles.face_area, given.n_polygons)
    return FaceGraph(given.n_polygons, pairs, length, area)


def _lost_faces(given: PolygonMesh, working: WorkingMesh) -> np.ndarray:
    """Each of the caller's faces that the working copy lacks and a neighbor that it has, (l, 2) int64.

    The neighbor shares an edge with the face, or, if none does, a corner; for a face that touches such faces only, or
    nothing, it is the nearest.
    """
    kept = np.zeros(given.n_polygons, bool)
    kept[working.polygon] = True
    if kept.all():
        return np.empty((0, 2), np.int64)
    kept_triangle = kept[given.polygon]
    at_vertex = full(given.triangles.n_vertices, -1)
    at_vertex[given.triangles.faces[kept_triangle]] = given.polygon[kept_triangle][:, None]
    pairs = given.polygon[given.triangles.edges.pairs]
    by_corner = np.stack([np.repeat(given.polygon[~kept_triangle], 3),
                          at_vertex[given.triangles.faces[~kept_triangle]].ravel()], axis=1)
    pairs = np.concatenate([both_ways(pairs), by_corner[by_corner[:, 1] >= 0]])
    pairs = pairs[~kept[pairs[:, 0]] & kept[pairs[:, 1]]]
    lost, first = np.unique(pairs[:, 0], return_index=True)
    known = kept.copy()
    known[lost] = True
    return np.concatenate([pairs[first], _nearest_kept(given, kept_triangle, ~known[given.polygon])])


def _nearest_kept(given: PolygonMesh, kept: np.ndarray, lost: np.ndarray) -> np.ndarray:
    """Each of the caller's faces that has a lost triangle and that which has the nearest kept one, (k, 2) int64.

    kept, lost : (m,) bool, triangles of the caller's faces.
    """
    faces, first = np.unique(given.polygon[lost], return_index=True)
    triangle = np.flatnonzero(kept)
    if not len(faces) or not len(triangle):
        return np.empty((0, 2), np.int64)
    middle = given.triangles.face_centroids
    distance, nearest = cKDTree(middle[triangle]).query(middle[lost][first], k=range(1, min(4, len(triangle)) + 1))
    # Of those equally near the first: rounding must not choose.
    equal = distance <= distance[:, :1] + 1e-9 * np.sqrt(given.triangles.area)
    return np.stack([faces, given.polygon[triangle][np.where(equal, nearest, len(triangle)).min(axis=1)]], axis=1)


def _voted(findings: Findings, graph: FaceGraph, found: FoundCandidates, parameters: Parameters) -> np.ndarray:
    """The candidates for which the pieces of the caller's faces vote, (p,) int64, connected; some may have no face."""
    votes = FaceVotes(found.face, found.label, found.area, graph.n_faces, found.hierarchy)
    width = _refined_width(findings.given, findings.results)

    def loss(face: np.ndarray, own: np.ndarray, other: np.ndarray) -> np.ndarray:
        """What it costs a refined face to leave the part that has most of it; other faces may do so for nothing."""
        return votes.loss(face, own, other) / width[face]

    label = connect(graph, fill_unlabeled(graph, votes.winners()))
    # Candidates may be smaller than the caller's faces that were refined, and would be lost in them.
    held = loss if parameters.traits.small_candidates else None
    return connect(graph, straighten(graph, label, parameters.smoothing, held))


def _refined_width(given: PolygonMesh, results: list[ComponentResult]) -> np.ndarray:
    """WIDTH in the unit of the vertices at each of the caller's faces, (p,) float64; infinite at faces not refined."""
    width = np.full(given.n_polygons, np.inf)
    before = np.bincount(given.polygon, minlength=given.n_polygons)
    for r in results:
        polygon, place = renumbered(r.component.polygon)
        width[polygon[np.bincount(place) > before[polygon]]] = WIDTH * np.sqrt(r.component.mesh.area)
    return width


def _with_loose_apart(candidates: FaceCandidates, working: WorkingMesh) -> FaceCandidates:
    """Make candidates of their own, which merge first, of what lies apart from the rest of its candidate."""
    graph, label, hierarchy = candidates.graph, candidates.label, candidates.hierarchy
    count, piece = graph.regions(label)
    solid = np.zeros(count, bool)  # a face that the copy lacks and that touches nothing stays where it is
    solid[piece[working.polygon]] = True
    name = np.empty(count, np.int64)
    name[piece] = label
    main = is_last_of_each(name, solid, np.bincount(piece, graph.area, count), -arange(count),
                           count=hierarchy.n_candidates)
    apart = np.flatnonzero(solid & ~main)
    if not len(apart):
        return candidates
    merges = np.stack([name[apart], hierarchy.n_candidates + arange(len(apart))], axis=1)
    name[apart] = merges[:, 1]
    finer = Hierarchy.of(hierarchy.n_candidates + len(apart), np.concatenate([merges, hierarchy.merges]),
                         np.concatenate([np.zeros(len(apart)), hierarchy.salience]))
    return replace(candidates, label=name[piece], hierarchy=finer)


def _vertex_field(findings: Findings, parameters: Parameters) -> tuple[np.ndarray, tuple[Sentence, ...]]:
    """Normalized field at the caller's vertices, (n,) float64, and notes about pieces and bodies."""
    given, working, results = findings.given, findings.working, findings.results
    values = np.full(given.triangles.n_vertices, np.nan)
    values[given.triangles.used] = 0.0  # in components that were not decomposed
    for r in results:
        kept = r.component.vertex_source >= 0
        values[r.component.vertex_source[kept]] = r.field.normalized[kept]
    values = values[working.joined]  # at a seam all have the value of the one that the copy has
    n_pieces, piece = working.mesh.face_components
    n_flat = sum(not r.field.values.any() for r in results)
    n_cut = sum(len(np.unique(piece[r.component.faces])) for r in results)
    n_small = components(n_pieces, *working.polygon_piece[findings.bodies.contacts].T)[0] - n_cut
    notes = _body_notes if parameters.pieces == TOGETHER else _piece_notes
    if n_pieces == 1:
        return values, (Sentence("Nothing protrudes: the surface is even."),) if n_flat else ()
    return values, tuple(notes(n_cut, n_small, len(results), n_flat))


def _body_notes(n_cut: int, n_small: int, n_bodies: int, n_flat: int) -> Iterator[Sentence]:
    """Sentences about pieces decomposed together: how many bodies they form, how many form none."""
    if n_bodies == 1 and n_cut > 1:
        yield Sentence(
            "{n} pieces that touch, or nearly so, form one body; with Pieces: Separate each is decomposed on its own.",
            n=n_cut)
    elif n_bodies > 1:
        yield Sentence("{n} pieces form {bodies} bodies; what touches is decomposed together.",
                       n=n_cut, bodies=n_bodies)
    if n_small:
        yield Sentence("{n} small {n:body is one part|bodies are one part each}.", n=n_small)
    if n_flat:
        yield Sentence("{n} of the bodies {n:is|are} so even that nothing protrudes.", n=n_flat)


def _piece_notes(n_cut: int, n_small: int, n_bodies: int, n_flat: int) -> Iterator[Sentence]:
    """Sentences about pieces decomposed one by one: how many there are, how many are too small or too even."""
    if n_small:
        yield Sentence("{n} loose parts are decomposed each on its own; {small} small {small:one is one|ones are one} "
                       "part each.", n=n_cut + n_small, small=n_small)
    else:
        yield Sentence("{n} loose parts are decomposed each on its own.", n=n_bodies)
    if n_flat:
        yield Sentence("{n} of the loose parts {n:is|are} so even that nothing protrudes.", n=n_flat)


def _graph_candidates(results: list[ComponentResult], label: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Candidate in which each node, (k,), and each center point, (r,), of the joined graph lies."""
    nodes, points = [np.empty(0, np.int64)], [np.empty(0, np.int64)]
    for r in results:
        sets, topology = r.sets, r.topology
        element_label = label[r.component.polygon[sets.element_face]]
        node = topology.piece_node[sets.element_piece]
        inside = node >= 0
        nodes.append(majority(node[inside], element_label[inside], sets.element_weight[inside], topology.n_nodes))
        segment_label = label[r.component.polygon[sets.segment_face]]
        length = sets.segment_length + LEAST_WEIGHT * np.sqrt(sets.mesh.area)
        of_contour = majority(sets.segment_contour, segment_label, length, sets.n_contours)
        points.append(of_contour[topology.arc_contours(sets)[0]])
    return np.concatenate(nodes), np.concatenate(points)

# SPDX-License-Identifier: GPL-3.0-or-later
"""The result of a mesh with grounds, from that of what stands on them."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ..arrays.indexing import renumbered
from ..arrays.int64 import full
from ..arrays.nearest import nearest_to_middle
from ..arrays.vectors import middles_of_each
from ..cuts.face_candidates import FaceCandidates
from ..cuts.hierarchy import Hierarchy
from ..mesh.face_graph import FaceGraph
from ..mesh.grounds import Standing
from ..mesh.polygons import PolygonMesh
from ..sentence import Sentence
from ..surface.preparation import WorkingMesh, repair
from .assemble import face_graph_of, tables_of
from .component_results import merged_at_last
from .decomposition import Decomposition


def with_grounds(found: Decomposition, given: PolygonMesh, standing: Standing) -> Decomposition:
    """Add the grounds to the result of what stands on them.

    Parameters
    ----------
    found : Decomposition
        Of the mesh without grounds.
    given : PolygonMesh
        With them: p polygons and n vertices.
    standing : Standing
        Found in it.

    Returns
    -------
    decomposition : Decomposition
        Each ground is a candidate, which merges last, and is linked to the middle of what stands there.
    """
    kept, working = standing.polygon, repair(given)
    graph = face_graph_of(given, working)
    label, n_grounds = _labels(found, graph, kept)
    plain = found.asked(replace(found.parameters, n_parts=0))
    links = _links(working, np.maximum(label - found.n_candidates + 1, 0))
    hierarchy = merged_at_last(Hierarchy.join([found.hierarchy, Hierarchy.of(n_grounds, [], [])]))
    contacts = np.concatenate([kept[found.contacts], links])
    tables = tables_of(given, working, FaceCandidates(graph, contacts, label, hierarchy))
    field = np.full(given.triangles.n_vertices, np.nan)
    field[given.triangles.used] = 0.0
    field[standing.vertex] = found.field
    twin, side = found.face_twin, found.face_side
    if len(twin):
        twin, side = full(len(label), -1), np.zeros(len(label), np.int8)
        twin[kept] = np.append(kept, -1)[found.face_twin]
        side[kept] = found.face_side
    return replace(
        plain.scaled(-given.exponent), **tables.attributes(), hierarchy=hierarchy, field=field, contacts=contacts,
        links=np.concatenate([kept[found.links], links]), face_twin=twin, face_side=side,
        notes=_notes(plain, working, n_grounds)).scaled(given.exponent).asked(found.parameters)


def _labels(found: Decomposition, graph: FaceGraph, kept: np.ndarray) -> tuple[np.ndarray, int]:
    """Candidate of each face, (p,) int64, those of grounds after those found, and the number of grounds."""
    label = full(graph.n_faces, found.n_candidates)
    label[kept] = found.candidates
    ground = np.flatnonzero(label == found.n_candidates)
    names, number = renumbered(graph.regions(label)[1][ground])
    label[ground] += number
    return label, len(names)


def _links(working: WorkingMesh, body: np.ndarray) -> np.ndarray:
    """A face in the middle of all that stands on grounds and one of each ground, (g, 2) int64.

    body : (p,) int64, of each face, 0 of what stands, and the numbers of grounds.
    """
    of_triangle = body[working.polygon]
    place, weight = working.mesh.face_centroids, working.mesh.face_weight
    _, center = middles_of_each(of_triangle, place, weight, int(body.max()) + 1)
    face = working.polygon[nearest_to_middle(of_triangle, place, center)]
    return np.stack([np.repeat(face[:1], len(face) - 1), face[1:]], axis=1)


def _notes(found: Decomposition, working: WorkingMesh, n_grounds: int) -> tuple[str, ...]:
    """The notes on the whole mesh, and those on what stands there that are not on its mesh."""
    messages = {note.message for note in working.notes}
    others = (note for note in found.notes if not (isinstance(note, Sentence) and note.message in messages))
    ground = Sentence("The rest is decomposed without {n} large plain {n:piece|pieces}, such as a floor.", n=n_grounds)
    return (*working.notes, *others, ground)

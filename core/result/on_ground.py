# SPDX-License-Identifier: GPL-3.0-or-later
"""The result of a mesh with grounds, from that of what stands on them."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ..arrays.indexing import renumbered
from ..arrays.int64 import full
from ..arrays.pairs import are_among
from ..cuts.face_candidates import FaceCandidates
from ..cuts.hierarchy import Hierarchy
from ..cuts.settling import settle
from ..mesh.face_graph import FaceGraph
from ..mesh.grounds import Standing
from ..mesh.polygons import PolygonMesh
from ..sentence import Sentence
from ..surface.preparation import WorkingMesh, repair
from .assemble import face_graph_of, tables_of
from .bodies import links
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
        Each ground is a candidate, which merges last; it and what stands there are linked as bodies are.
    """
    kept, working = standing.polygon, repair(given)
    graph = face_graph_of(given, working)
    label, n_grounds = _labels(found, graph, kept)
    plain = found.asked(replace(found.parameters, n_parts=0))
    between = links(working, np.maximum(label - found.n_candidates + 1, 0), n_grounds + 1)
    hierarchy = merged_at_last(Hierarchy.join([found.hierarchy, Hierarchy.of(n_grounds, [], [])]))
    known = kept[found.contacts]
    # Of grounds, and of what stands there: a gap that is wide for it alone may be narrow beside its ground.
    seams = working.stitches[~are_among(working.stitches, np.sort(known, axis=1))]
    contacts = np.concatenate([known, seams, between])
    # A ground may be linked to another one, and not to what stands there.
    candidates = settle(FaceCandidates(graph, contacts, label, hierarchy))
    tables = tables_of(given, working, candidates)
    field = np.full(given.triangles.n_vertices, np.nan)
    field[given.triangles.used] = 0.0
    field[standing.vertex] = found.field
    twin, side = found.face_twin, found.face_side
    if len(twin):
        twin, side = full(len(label), -1), np.zeros(len(label), np.int8)
        twin[kept] = np.append(kept, -1)[found.face_twin]
        side[kept] = found.face_side
    return replace(
        plain.scaled(-given.exponent), **tables.attributes(), hierarchy=candidates.hierarchy, field=field,
        contacts=contacts, links=np.concatenate([kept[found.links], between]), face_twin=twin, face_side=side,
        notes=_notes(plain, working, n_grounds)).scaled(given.exponent).asked(found.parameters)


def _labels(found: Decomposition, graph: FaceGraph, kept: np.ndarray) -> tuple[np.ndarray, int]:
    """Candidate of each face, (p,) int64, those of grounds after those found, and the number of grounds."""
    label = full(graph.n_faces, found.n_candidates)
    label[kept] = found.candidates
    ground = np.flatnonzero(label == found.n_candidates)
    names, number = renumbered(graph.regions(label)[1][ground])
    label[ground] += number
    return label, len(names)


def _notes(found: Decomposition, working: WorkingMesh, n_grounds: int) -> tuple[str, ...]:
    """The notes on the whole mesh, and those on what stands there that are not on its mesh."""
    messages = {note.message for note in working.notes}
    others = (note for note in found.notes if not (isinstance(note, Sentence) and note.message in messages))
    ground = Sentence("The rest is decomposed without {n} large plain {n:piece|pieces}, such as a floor.", n=n_grounds)
    return (*working.notes, *others, ground)

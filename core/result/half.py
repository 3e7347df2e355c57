# SPDX-License-Identifier: GPL-3.0-or-later
"""The result for a half model, from that of the whole of which it is one side."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from ..cuts.face_candidates import FaceCandidates
from ..cuts.settling import settle
from ..mesh.face_graph import connect
from ..mesh.labels import majority
from ..mesh.polygons import PolygonMesh
from ..mesh.triangles import vote_weights
from ..sentence import Sentence
from ..surface.preparation import WorkingMesh, repair
from .assemble import face_graph_of, tables_of
from .decomposition import Decomposition


def of_half(whole: Decomposition, given: PolygonMesh) -> Decomposition:
    """Keep of a result what concerns the first half of the faces, the others being their images.

    Parameters
    ----------
    whole : Decomposition
        2 p faces; face k + p is the mirror image of face k.
    given : PolygonMesh
        The half model: p polygons, and n vertices, which are the first of the whole.

    Returns
    -------
    decomposition : Decomposition
        Of p faces. Its graph is that of the whole; a node of the other side lies in the candidate of which it is the
        image. Parts merge as on the whole, and wherever their images do.
    """
    count, working = given.n_polygons, repair(given)
    graph = face_graph_of(given, working)
    contacts, links = (pairs[pairs[:, 0] != pairs[:, 1]] for pairs in (whole.contacts % count, whole.links % count))
    candidates = settle(FaceCandidates(graph, contacts, connect(graph, whole.candidates[:count]), whole.hierarchy))
    label = candidates.label
    tables = tables_of(given, working, candidates)
    # Where the nodes of either side lie: most of a candidate of the whole is, mirrored back, in one of the half.
    area = np.tile(graph.area, 2)
    home = majority(whole.candidates, np.tile(label, 2), vote_weights(area), whole.n_candidates)
    nothing = np.empty(0, np.int64)
    found = whole.asked(replace(whole.parameters, n_parts=0)).scaled(-given.exponent)
    return replace(
        found, **tables.attributes(), hierarchy=candidates.hierarchy,
        field=whole.field[:given.triangles.n_vertices], node_candidate=home[whole.node_candidate],
        point_candidate=home[whole.point_candidate], contacts=contacts, links=links, mirror=np.empty(0),
        face_twin=nothing, face_side=nothing.astype(np.int8),
        notes=(Sentence("The mesh was decomposed together with its mirror image."), *_of_one_side(found, working)),
    ).scaled(given.exponent).asked(whole.parameters)


def _of_one_side(whole: Decomposition, working: WorkingMesh) -> Iterator[str]:
    """The notes of the whole; those that the half has about its mesh, too, with how many there are in the half.

    The whole has each vertex, border and face twice, but for what lies in the plane, so that this is half of its count,
    or that of the half where this is less: at the plane, the whole alone has edges that join four faces, and the half
    alone has borders.
    """
    own = {note.message: note.values["n"] for note in working.notes}
    for note in whole.notes:
        if isinstance(note, Sentence) and note.message in own:
            yield Sentence(note.message, n=min(own[note.message], -(-note.values["n"] // 2)))
        else:
            yield note

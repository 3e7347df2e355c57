# SPDX-License-Identifier: GPL-3.0-or-later
"""Cuts at edges where more than two faces meet."""

from itertools import combinations

import numpy as np
import pytest
import shapes

from core.parameters import PRESETS, Parameters
from core.pipeline import decompose
from core.result.editing import split_candidates
from core.result.fans import boundaries
from core.surface.corners import CornerTable
from core.surface.labels import FaceGraph


def book(n_pages, n=8):
    """Square pages that share one spine of length 1, each of 2 n n triangles."""
    page = shapes.flat_grid(n, n, 1 / n)
    vertices, faces = [page.vertices], [page.faces]
    spine = np.flatnonzero(page.vertices[:, 0] == 0)
    for number in range(1, n_pages):
        angle = 2 * np.pi * number / n_pages
        turned = page.vertices * [np.cos(angle), 1, 1] + page.vertices[:, :1] * [0, 0, np.sin(angle)]
        index = np.arange(len(turned)) + sum(map(len, vertices))
        index[spine] = spine
        vertices.append(turned)
        faces.append(index[page.faces])
    return np.concatenate(vertices), np.concatenate(faces)


def sides(faces, vertices):
    """The faces as a face graph, the face and the edge of each side, and the lengths of the edges."""
    table = CornerTable.of(vertices, faces)
    pairs, edge = table.face_pairs()
    graph = FaceGraph(len(faces), pairs, table.edge_length(edge), np.ones(len(faces)))
    return graph, table.corner_face, table.corner_edge, table.edge_length(np.arange(len(table.edges)))


@pytest.mark.parametrize("n_pages", [2, 3, 4, 7])
def test_every_page_touches_every_other_along_the_spine(n_pages):
    vertices, faces = book(n_pages)
    label = np.repeat(np.arange(n_pages), len(faces) // n_pages)
    graph, *rest = sides(faces, vertices)
    touching, length = boundaries(graph, label, *rest)
    assert [tuple(pair) for pair in touching.tolist()] == list(combinations(range(n_pages), 2))
    assert length == pytest.approx(np.ones(len(touching)))


def touching_pairs(faces, label):
    """Pairs of labels of faces that share an edge, found edge by edge."""
    around = {}
    for face, corners in zip(label.tolist(), faces.tolist(), strict=True):
        for edge in zip(corners, [*corners[1:], corners[0]], strict=True):
            around.setdefault(tuple(sorted(edge)), set()).add(face)
    return sorted({pair for labels in around.values() for pair in combinations(sorted(labels), 2)})


@pytest.mark.parametrize("preset", PRESETS)
@pytest.mark.parametrize("n_pages", [3, 5])
def test_the_cuts_are_the_pairs_of_parts_that_share_an_edge(preset, n_pages):
    vertices, faces = book(n_pages)
    result = decompose(vertices, faces, Parameters.preset(preset))
    # Flat pages all have one curvature: the method that classifies by it finds two candidates.
    assert result.n_candidates >= (2 if preset == "Lavoue 2005" else 3)
    for count in range(2, result.n_candidates + 1):
        parts = result.parts(n_parts=count)
        assert [tuple(cut) for cut in parts.cuts.tolist()] == touching_pairs(faces, parts.labels)


def test_the_cuts_after_faces_were_given_to_other_parts():
    vertices, faces = book(5)
    result = decompose(vertices, faces)
    chosen = np.random.default_rng(0).random(len(faces)) < 0.3
    graph, *_ = sides(faces, vertices)
    finer = split_candidates(result, chosen, graph, CornerTable.of(vertices, faces))
    assert finer.n_candidates > result.n_candidates
    assert [tuple(pair) for pair in finer.candidate_pairs.tolist()] == touching_pairs(faces, finer.candidates)

# SPDX-License-Identifier: GPL-3.0-or-later
"""Cuts at edges where more than two faces meet."""

from itertools import combinations

import numpy as np
import pytest
import shapes

from core.mesh.corners import CornerTable
from core.mesh.face_graph import FaceGraph
from core.parameters import PRESETS, Parameters
from core.pipeline import decompose
from core.result.decomposition import Decomposition
from core.result.editing.finer_candidates import split_candidates
from core.result.junctions import FaceSides, boundaries, counted_again, junctions


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
    """The faces as a face graph, and their sides."""
    table = CornerTable.of(vertices, faces)
    pairs, edge = table.face_pairs()
    graph = FaceGraph(len(faces), pairs, table.edge_length(edge), np.ones(len(faces)))
    return graph, FaceSides(table.corner_face, table.corner_edge, table.edge_length(np.arange(len(table.edges))))


@pytest.mark.parametrize("n_pages", [2, 3, 4, 7])
def test_every_page_touches_every_other_along_the_spine(n_pages):
    vertices, faces = book(n_pages)
    label = np.repeat(np.arange(n_pages), len(faces) // n_pages)
    graph, of_faces = sides(faces, vertices)
    touching, length = boundaries(graph, label, of_faces)
    assert [tuple(pair) for pair in touching.tolist()] == list(combinations(range(n_pages), 2))
    assert length == pytest.approx(np.ones(len(touching)))


def touching_pairs(faces, label):
    """Pairs of labels of faces that share an edge."""
    return sorted(edge_lengths(np.zeros((faces.max() + 1, 3)), faces, label))


def edge_lengths(vertices, faces, label):
    """Length of the edges that pairs of labels share, each edge once, found edge by edge."""
    around = {}
    for face, corners in zip(label.tolist(), faces.tolist(), strict=True):
        for edge in zip(corners, [*corners[1:], corners[0]], strict=True):
            around.setdefault(tuple(sorted(edge)), set()).add(face)
    found = {}
    for (a, b), labels in around.items():
        for pair in combinations(sorted(labels), 2):
            found[pair] = found.get(pair, 0.0) + np.linalg.norm(vertices[a] - vertices[b])
    return found


def cut_lengths(parts):
    return dict(zip(map(tuple, parts.cuts.tolist()), parts.cut_length.tolist(), strict=True))


def test_labels_that_take_turns_around_an_edge_meet_there_once():
    vertices, faces = book(4)
    label = np.repeat([0, 1, 0, 1], len(faces) // 4)
    graph, of_faces = sides(faces, vertices)
    touching, length = boundaries(graph, label, of_faces)
    assert touching.tolist() == [[0, 1]]
    assert length == pytest.approx([1.0])


@pytest.mark.parametrize("seed", range(4))
@pytest.mark.parametrize("n_labels", [2, 3, 8])
def test_boundaries_have_each_edge_once_also_after_labels_became_one(n_labels, seed):
    vertices, faces = book(5)
    random = np.random.default_rng(seed)
    label = random.integers(n_labels, size=len(faces))
    graph, of_faces = sides(faces, vertices)
    touching, length = boundaries(graph, label, of_faces)
    assert dict(zip(map(tuple, touching.tolist()), length.tolist(), strict=True)) == pytest.approx(
        edge_lengths(vertices, faces, label))
    group = random.integers(3, size=n_labels)
    low, high = np.sort(group[touching], axis=1).T
    total = {}
    members, at_junction = junctions(label, of_faces)
    assert (at_junction > 0).all()
    for pair, part in [*zip(zip(low.tolist(), high.tolist(), strict=True), length, strict=True),
                       *((tuple(pair), -more) for pair, more in
                         zip(*(array.tolist() for array in counted_again(members, at_junction, group)), strict=True))]:
        if pair[0] < pair[1]:
            total[pair] = total.get(pair, 0.0) + part
    assert total == pytest.approx(edge_lengths(vertices, faces, group[label]))


def test_sheets_that_cross_have_cuts_of_the_length_of_their_line():
    """Four half sheets meet along a line of length 1: it was counted for each pair of faces there."""
    vertices, faces = book(4)
    result = decompose(vertices, faces, hints=np.repeat([0, 1, 0, 1], len(faces) // 4))
    for count in range(2, result.n_candidates + 1):
        parts = result.parts(n_parts=count)
        assert cut_lengths(parts) == pytest.approx(edge_lengths(vertices, faces, parts.labels))
    crossing = result.group(np.repeat([0, 1, 0, 1], len(faces) // 4)[
        np.unique(result.candidates, return_index=True)[1]])
    assert crossing.cut_length == pytest.approx([1.0])
    again = Decomposition.from_bytes(result.to_bytes())
    assert (again.group(crossing.candidate_part).cut_length == crossing.cut_length).all()
    larger = result.scaled(3).group(crossing.candidate_part)
    assert larger.cut_length == pytest.approx([8.0])


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
        assert cut_lengths(parts) == pytest.approx(edge_lengths(vertices, faces, parts.labels))


def test_the_cuts_after_faces_were_given_to_other_parts():
    vertices, faces = book(5)
    result = decompose(vertices, faces)
    chosen = np.random.default_rng(0).random(len(faces)) < 0.3
    graph, _ = sides(faces, vertices)
    finer = split_candidates(result, chosen, graph, CornerTable.of(vertices, faces))
    assert finer.n_candidates > result.n_candidates
    assert [tuple(pair) for pair in finer.candidate_pairs.tolist()] == touching_pairs(faces, finer.candidates)
    for count in (2, finer.n_candidates // 2, finer.n_candidates):
        parts = finer.parts(n_parts=count)
        assert cut_lengths(parts) == pytest.approx(edge_lengths(vertices, faces, parts.labels))


def test_fans_are_the_sides_of_edges_of_three_faces_and_more_edge_by_edge():
    face, edge = np.array([0, 1, 2, 3, 4, 5, 6, 7]), np.array([3, 0, 2, 3, 0, 2, 3, 1])
    assert FaceSides(face, edge, np.ones(4)).fans.tolist() == [0, 3, 6]
    assert FaceSides(face[:6], edge[:6], np.ones(4)).fans.tolist() == []

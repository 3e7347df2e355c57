# SPDX-License-Identifier: GPL-3.0-or-later
"""Pieces that repeat each other: which do, and that all of them are parts of their own, or none."""

from functools import partial

import numpy as np
import pytest
import shapes

from core.cuts.joining.linkage import JudgedPairs, average_linkage
from core.cuts.joining.repetition import evenly_linked, piece_kinds
from core.mesh.triangles import TriMesh


def together(pieces):
    """One mesh of several."""
    start = np.cumsum([0, *(len(vertices) for vertices, _ in pieces)])
    return TriMesh(np.concatenate([vertices for vertices, _ in pieces]),
                   np.concatenate([faces + first for (_, faces), first in zip(pieces, start[:-1], strict=True)]))


def test_pieces_of_one_shape_are_of_one_kind_however_they_lie():
    vertices, faces = shapes.tube_tree()
    rng = np.random.default_rng(0)
    turns = [np.linalg.qr(rng.normal(size=(3, 3)))[0] for _ in range(4)]  # some of them mirror
    copies = [(vertices @ turn + rng.normal(size=3), faces) for turn in turns]
    larger = 1.1 * vertices, faces
    longer = vertices * [1.0, 1.0, 1.2], faces
    kind = piece_kinds(together([*copies[:2], larger, *copies[2:], longer]))
    assert len({*kind[[0, 1, 3, 4]].tolist()}) == 1
    assert len({*kind.tolist()}) == 3


@pytest.mark.parametrize(("size", "alike"), [(1.0, True), (0.98, True), (0.94, False)])
def test_pieces_repeat_each_other_if_their_sizes_differ_by_a_few_hundredths(size, alike):
    """Of cells of 0.03 of the logarithm of the size, 0.98 is in the one beside that of 1, and 0.94 two farther."""
    vertices, faces = shapes.icosphere(2)
    one, other = piece_kinds(together([(vertices, faces), (size * vertices + 5.0, faces)]))
    assert (one == other) == alike


@pytest.mark.parametrize(("thick", "thicker", "alike"), [(1e-4, 2e-4, True), (2e-3, 4e-3, False)])
def test_sheets_are_alike_however_thin(thick, thicker, alike):
    """A ball pressed flat spreads by a quarter of its thickness, in units of its size; 0.003 is added before logarithms
    are compared."""
    vertices, faces = shapes.icosphere(2)
    one, other = piece_kinds(together([(vertices * (1, 1, thick), faces), (vertices * (1, 1, thicker) + 3.0, faces)]))
    assert (one == other) == alike


def test_thousands_of_one_shape_take_no_table_of_pairs():
    corners = np.array([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 2.0, 0.0]])
    places = np.random.default_rng(1).normal(size=(20_000, 1, 3))
    kind = piece_kinds(TriMesh((corners + places).reshape(-1, 3), np.arange(60_000).reshape(-1, 3)))
    assert not kind.any()


def linked(odds, piece, kind, pairs):
    """Groups at a score of 0, as sets of parts."""
    judged = JudgedPairs(pairs, np.array(odds), np.ones(len(pairs)), np.ones(len(pairs), bool))
    merges, score, _ = evenly_linked(partial(average_linkage, len(piece)), judged, np.array(piece), np.array(kind))
    group = np.arange(len(piece))
    for a, b in merges[np.minimum.accumulate(score) > 0]:
        group[group == group[b]] = group[a]
    return [set(np.flatnonzero(group == name).tolist()) for name in np.unique(group)]


@pytest.mark.parametrize(("odds", "groups"), [
    ([0.2, -1.0, -1.2, -1.4], [{0}, {1}, {2}, {3}, {4}]),  # one wheel alone was one with the body
    ([1.2, 1.0, 1.4, -0.2], [{0, 1, 2, 3, 4}]),  # one wheel alone was none
    ([0.2, 0.1, 0.3, 0.1], [{0, 1, 2, 3, 4}]),
    ([-0.2, -0.1, -0.3, -0.1], [{0}, {1}, {2}, {3}, {4}]),
])
def test_all_wheels_are_parts_or_none(odds, groups):
    pairs = np.array([[0, 1], [0, 2], [0, 3], [0, 4]])
    assert linked(odds, [0, 1, 2, 3, 4], [0, 1, 1, 1, 1], pairs) == groups


def test_what_repeats_nothing_joins_as_it_did():
    pairs = np.array([[0, 1], [0, 2], [0, 3], [0, 4]])
    assert linked([0.2, -1.0, -1.2, -1.4], [0, 1, 2, 3, 4], [0, 1, 2, 3, 4], pairs) == [{0, 1}, {2}, {3}, {4}]


def test_a_row_of_equal_pieces_is_no_other_kind():
    """Links of a chain join each other; only what they do with the anchor at its end is made even."""
    pairs = np.array([[0, 1], [1, 2], [2, 3]])
    assert linked([-1.0, 1.0, 1.0], [0, 1, 2, 3], [0, 1, 1, 1], pairs) == [{0}, {1, 2, 3}]


def test_equal_pieces_that_join_each_other_are_even_with_those_that_do_not():
    """Of four planks two touch each other: whether these are one part tells nothing of what holds with the wall."""
    pairs = np.array([[1, 2], [0, 1], [0, 2], [0, 3], [0, 4]])
    piece, kind = [0, 1, 2, 3, 4], [0, 1, 1, 1, 1]
    assert linked([0.5, -1.0, -1.0, -0.8, -1.2], piece, kind, pairs) == [{0}, {1, 2}, {3}, {4}]
    assert linked([0.5, 0.2, 0.2, -0.8, -1.2], piece, kind, pairs) == [{0}, {1, 2}, {3}, {4}]


def test_tires_with_their_rims_are_even_too():
    """Two wheels of a tire and a rim each: what goes with the body is the rim, in one wheel alone."""
    pairs = np.array([[1, 2], [3, 4], [0, 2], [0, 4]])  # tire and rim, twice; the body and each rim
    groups = linked([3.0, 3.0, 0.5, -1.5], [0, 1, 2, 3, 4], [0, 1, 2, 1, 2], pairs)
    assert groups in ([{0}, {1, 2}, {3, 4}], [{0, 1, 2, 3, 4}])

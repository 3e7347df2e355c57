# SPDX-License-Identifier: GPL-3.0-or-later
"""A fountain: a column, and drops over it that touch neither it nor each other."""

import numpy as np
import pytest
import shapes

from core import decompose

DROPS = 14


@pytest.fixture(scope="module")
def fountain():
    """Vertices, faces, and the piece of each face: 0 for the column, then a number for each drop."""
    rng = np.random.default_rng(3)
    column = shapes.cylinder(20, 24)
    drops = [shapes.moved(shapes.icosphere(1, radius), (0.7 * np.cos(k), 0.7 * np.sin(k), 4.8 + 0.3 * k))
             for k, radius in enumerate(rng.uniform(0.12, 0.18, DROPS))]
    vertices, faces = shapes.together(column, *drops)
    piece = np.repeat(np.arange(DROPS + 1), [len(column[1]), *(len(drop[1]) for drop in drops)])
    return vertices, faces, piece


def as_sets(labels, piece):
    """The sets of pieces that are one part each; a piece that is divided is in several."""
    return {frozenset(piece[labels == label].tolist()) for label in np.unique(labels)}


def test_drops_are_one_part_and_each_its_own_at_more_detail(fountain):
    vertices, faces, piece = fountain
    result = decompose(vertices, faces)
    every, each = frozenset(range(1, DROPS + 1)), {frozenset([k]) for k in range(1, DROPS + 1)}
    assert every in as_sets(result.parts().labels, piece)
    assert every in as_sets(result.parts(detail=0.1).labels, piece)
    assert each <= as_sets(result.parts(detail=0.6).labels, piece)
    assert as_sets(result.parts(detail=0.0).labels, piece) == {frozenset(range(DROPS + 1))}
    for n in range(1, 25):
        assert len(np.unique(result.parts(n_parts=n).labels)) == n


@pytest.mark.parametrize("seed", range(3))
def test_the_same_in_any_order_and_place(fountain, seed):
    vertices, faces, piece = fountain
    rng = np.random.default_rng(seed)
    turned = shapes.Shape(7.0 * vertices @ shapes.rotation(rng).T + 3.0, faces)
    (vertices, faces), _, order = shapes.shuffled(turned, rng)
    found = as_sets(decompose(vertices, faces).parts().labels, piece[order])
    assert frozenset(range(1, DROPS + 1)) in found


def test_pieces_each_on_its_own_are_no_swarm(fountain):
    vertices, faces, piece = fountain
    found = as_sets(decompose(vertices, faces, {"pieces": "separate"}).parts(detail=0.1).labels, piece)
    assert {frozenset([k]) for k in range(1, DROPS + 1)} <= found


def test_a_heap_of_stones_is_so_many_stones():
    stones = [shapes.moved(shapes.icosphere(1, 0.3), (k % 5, k // 5, 0.0)) for k in range(20)]
    vertices, faces = shapes.together(*stones)
    piece = np.arange(len(faces)) // len(stones[0][1])
    assert as_sets(decompose(vertices, faces).parts().labels, piece) == {frozenset([k]) for k in range(20)}

# SPDX-License-Identifier: GPL-3.0-or-later
"""The nearest seed; of equally near ones the first."""

import numpy as np
import pytest

from core.arrays.nearest_seeds import nearest_seeds
from core.arrays.pairs import symmetric_matrix


def test_in_the_middle_of_a_path_the_first_counts():
    pairs = np.stack([np.arange(4), np.arange(1, 5)], axis=1)
    distance, seed = nearest_seeds(symmetric_matrix(pairs, np.ones(4), 6), np.array([4, 0]))
    assert distance.tolist() == [0, 1, 2, 1, 0, np.inf]
    assert seed.tolist() == [0, 0, 0, 4, 4, -1]


@pytest.mark.parametrize("rng_seed", range(5))
def test_against_every_seed_alone(rng_seed):
    """On a grid with lengths of one and two most ways are equally long as others."""
    rng, side = np.random.default_rng(rng_seed), 12
    place = np.arange(side * side).reshape(side, side)
    pairs = np.concatenate([np.stack([place[:, :-1].ravel(), place[:, 1:].ravel()], axis=1),
                            np.stack([place[:-1].ravel(), place[1:].ravel()], axis=1)])
    graph = symmetric_matrix(pairs, rng.integers(1, 3, len(pairs)).astype(float), side * side)
    seeds = rng.permutation(side * side)[:9]
    alone = np.array([nearest_seeds(graph, seeds[i:i + 1])[0] for i in range(9)])
    distance, seed = nearest_seeds(graph, seeds)
    assert (distance == alone.min(axis=0)).all()
    assert (seed == np.where(alone == alone.min(axis=0), seeds[:, None], side * side).min(axis=0)).all()

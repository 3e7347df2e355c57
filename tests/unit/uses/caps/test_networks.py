# SPDX-License-Identifier: GPL-3.0-or-later
"""Networks of curves taken apart, by hand."""

import numpy as np
import pytest

from core.uses.caps.networks import nested_sides, own_places


def ladder(rungs):
    """Places in two rows, and curves along both rows and across: as cuts around a handle, two on each rung."""
    places = np.array([(3.0 * x, y, 0.1 * x * x) for x in range(rungs) for y in (0.0, 1.0)])
    across = [(2 * x, 2 * x + 1) for x in range(rungs)]
    along = [(2 * x + y, 2 * x + y + 2) for x in range(rungs - 1) for y in (0, 1)]
    return places, np.array(across + along)


@pytest.mark.parametrize("rungs", [2, 3, 4, 6])
@pytest.mark.parametrize("seed", [0, 1])
def test_a_ladder_comes_apart_between_its_rungs(rungs, seed):
    places, curves = ladder(rungs)
    order = np.random.default_rng(seed).permutation(len(places))
    place = np.argsort(order)
    sides = nested_sides(places[order], place[curves])
    assert len(sides) == rungs - 1
    own = {tuple(sorted(order[mask].tolist())) for mask in own_places(sides)}
    assert own == {(2 * x, 2 * x + 1) for x in range(rungs)}
    for side in sides:
        assert (side[place[curves[:, 0]]] != side[place[curves[:, 1]]]).sum() == 2


def test_what_holds_together_stays_whole():
    corners = np.array([(x, y, z) for x in (0, 1) for y in (0, 1) for z in (0, 1)], float)
    near = [(a, b) for a in range(8) for b in range(a) if np.abs(corners[a] - corners[b]).sum() == 1]
    assert not len(nested_sides(corners, np.array(near)))  # a cube: four edges go across
    assert not len(nested_sides(*ladder(7)))  # too many to look at all
    assert not len(nested_sides(corners[:3], np.array([(0, 1), (1, 2), (2, 0)])))

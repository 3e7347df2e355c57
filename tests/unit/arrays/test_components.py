# SPDX-License-Identifier: GPL-3.0-or-later
"""Components, numbered as by a search that takes one element after the other."""

import numpy as np
import pytest

from core.arrays.components import MANY_ELEMENTS, components


def named_by_the_lowest(n, a, b):
    """The lowest element that each hangs together with."""
    lowest = np.arange(n)
    while True:
        lower = lowest.copy()
        np.minimum.at(lower, a, lowest[b])
        np.minimum.at(lower, b, lowest[a])
        if (lower == lowest).all():
            return lowest
        lowest = lower


@pytest.mark.parametrize("n", [0, 1, 300, 3 * MANY_ELEMENTS])
@pytest.mark.parametrize("share", [0.0, 0.3, 0.6, 2.0])
def test_components_are_numbered_by_their_lowest_elements(n, share):
    a, b = np.random.default_rng(n).integers(0, max(n, 1), (2, int(share * n)))
    count, label = components(n, a, b)
    names, expected = np.unique(named_by_the_lowest(n, a, b), return_inverse=True)
    assert count == len(names)
    assert (label == expected.reshape(-1)).all()


def test_components_of_what_cannot_be_halved():
    """A star hooks one element to another only in each round; a path comes down in one."""
    n = 4 * MANY_ELEMENTS
    middle, rest = np.full(n - 1, n - 1), np.arange(n - 1)
    for a, b in ((middle, rest), (rest, middle), (rest, rest + 1), (rest[::-1], rest[::-1] + 1)):
        assert components(n, a, b)[0] == 1

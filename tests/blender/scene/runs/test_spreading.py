# SPDX-License-Identifier: GPL-3.0-or-later
"""Which of several processes computes which shapes."""

import importlib

import pytest


@pytest.fixture
def spreading(package):
    return importlib.import_module(f"{package}.scene.runs.spreading")


@pytest.mark.parametrize(("sizes", "processors", "groups"), [
    ([8], 4, [[0]]),
    ([0, 0], 1, [[0, 1]]),
    ([8, 8, 8, 8, 8], 2, [[0, 2, 4], [1, 3]]),
    ([8, 100_000, 8, 8], 2, [[0, 2, 3], [1]]),
    ([8, 8, 300_000], 8, [[0, 1, 2]]),  # as two of the last would take too much memory
    ([8, 8, 250_000], 8, [[0, 1], [2]]),
    ([2_000_000, 8], 8, [[0, 1]]),
])
def test_known_answers(spreading, sizes, processors, groups):
    assert spreading.spread(sizes, processors) == groups


def test_no_process_has_much_more_to_do_than_another(spreading):
    sizes = [5 ** (k % 7) for k in range(100)]
    groups = spreading.spread(sizes, 6)
    assert sorted(k for group in groups for k in group) == list(range(100))
    work = [sum(sizes[k] + spreading.LEAST for k in group) for group in groups]
    assert max(work) - min(work) <= max(sizes) + spreading.LEAST

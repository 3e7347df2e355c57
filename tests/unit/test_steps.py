# SPDX-License-Identifier: GPL-3.0-or-later
"""Long work in steps: run through at once, as a stretch of something longer, and ended early."""

import pytest

from core.steps import finished, stretched


def counting(closed, fails=False):
    """Half done, done, and the word; notes in a list that it was closed."""
    try:
        yield 0.5
        yield 1.0
        if fails:
            raise OSError("full")
        return "word"
    finally:
        closed.append(True)


def longer(closed):
    """The same as the second half of something."""
    yield 0.1
    return (yield from stretched(counting(closed), 0.5, 1.0)) + "s"


def test_what_comes_of_all_steps():
    closed = []
    assert finished(counting(closed)) == "word"
    assert finished(longer(closed)) == "words"
    assert len(closed) == 2


def test_a_stretch_lies_between_two_shares():
    assert list(longer([])) == [0.1, 0.75, 1.0]


def test_what_is_raised_in_a_step_comes_through():
    with pytest.raises(OSError, match="full"):
        finished(counting([], fails=True))


def test_to_close_ends_the_work_within_a_stretch_at_once():
    closed = []
    work = longer(closed)
    assert [next(work), next(work)] == [0.1, 0.75]
    work.close()
    assert closed == [True]

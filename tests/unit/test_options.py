# SPDX-License-Identifier: GPL-3.0-or-later
"""Numbers on a command line: those in their range are taken, all others are one sentence."""

import argparse
import math

import pytest

from core.options import number


@pytest.mark.parametrize(("read", "text", "value"), [
    (number(16, 4096, int), "16", 16), (number(16, 4096, int), "4096", 4096), (number(0), "0.5", 0.5),
    (number(-1.5, 1.5), "-1.5", -1.5), (number(1, kind=int), "100000", 100_000),
])
def test_numbers_in_their_range_are_taken(read, text, value):
    assert read(text) == value
    assert type(read(text)) is type(value)


@pytest.mark.parametrize(("read", "text", "words"), [
    (number(16, 4096, int), "15", "must be a whole number from 16 to 4096, not 15"),
    (number(16, 4096, int), "17.5", "must be a whole number from 16 to 4096, not 17.5"),
    (number(16, 4096, int), "1" * 400, "from 16 to 4096"), (number(0), "nan", "must be a number, 0 or more, not nan"),
    (number(0), "inf", "not inf"), (number(0), "-0.1", "not -0.1"),
    (number(0), "", "must be a number, 0 or more, not "),
    (number(-36000.0, 36000.0), "1e9", "must be a number from -36000 to 36000, not 1e9"),
    (number(0, math.inf, int), "x", "must be a whole number, 0 or more, not x"),
])
def test_others_are_one_sentence_with_the_range(read, text, words):
    with pytest.raises(argparse.ArgumentTypeError) as caught:
        read(text)
    assert words in str(caught.value)

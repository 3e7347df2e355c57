# SPDX-License-Identifier: GPL-3.0-or-later
"""Lines over the view are seen on any surface."""

import sys

import pytest


@pytest.mark.parametrize("name", ["COLOR", "CUTS_COLOR"])
def test_the_outline_of_parts_is_seen_on_white_and_black_and_all_between(package, name):
    """White lines were drawn on white models and pale parts."""
    color = getattr(sys.modules[f"{package}.viewport.highlight"], name)
    strokes = sys.modules[f"{package}.viewport.lines"]._strokes(2.0, color)
    assert sorted(strokes, key=lambda stroke: -stroke[0]) == strokes  # the narrower ones are drawn over the wider ones
    for surface in (step / 100 for step in range(101)):
        seen = [shade[0] * shade[3] + surface * (1 - shade[3]) for _, shade in strokes]
        assert max(abs(grey - surface) for grey in seen) >= 0.2

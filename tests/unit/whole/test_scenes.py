# SPDX-License-Identifier: GPL-3.0-or-later
"""Scenes of many things in one mesh: each has parts of its own."""

import numpy as np
import pytest
import shapes

from core import decompose


@pytest.mark.parametrize("gap", [0.2, 3.0])
def test_things_that_stand_in_a_row_are_parts_of_their_own(gap):
    """The row is so long that less than 3 % of it is between them."""
    things = [shapes.moved(shape, (k * (2 + gap), 0, 0)) for k, shape in enumerate(
        [shapes.icosphere(2), shapes.subdivide(shapes.box((2, 1, 1))), shapes.torus(16, 8, 0.7, 0.3)] * 8)]
    thing = np.repeat(np.arange(len(things)), [len(shape.faces) for shape in things])
    result = decompose(*shapes.together(*things))
    label = result.parts().labels
    for part in range(label.max() + 1):
        assert len(set(thing[label == part])) == 1
    assert result.parts(detail=0).labels.max() == 0

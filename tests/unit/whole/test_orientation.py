# SPDX-License-Identifier: GPL-3.0-or-later
"""What is stored inside out has the same parts."""

import pytest
import shapes
from open_bodies import OPEN

from core import decompose
from core.metrics import rand_index_error


@pytest.mark.parametrize("name", OPEN)
def test_a_body_with_holes_has_the_same_parts_inside_out(name):
    one, other = (decompose(*shape).parts().labels for shape in (OPEN[name](), shapes.inside_out(OPEN[name]())))
    assert rand_index_error(one, other) == 0

# SPDX-License-Identifier: GPL-3.0-or-later
"""How maps that keep angles shrink and grow surfaces, where the answer is known."""

import numpy as np
import pytest
import shapes

from core.mesh.corners import CornerTable
from core.uses.maps.conformal import ConformalFactor


def test_a_flat_piece_keeps_its_size():
    table = CornerTable.of(*shapes.flat_grid(9, 7))
    factor = ConformalFactor.of(table)
    border = table.edges[np.bincount(table.corner_edge) == 1]
    scale = factor.solve(np.setdiff1d(np.arange(len(table.vertices)), border))
    assert scale == pytest.approx(0, abs=1e-9)


def test_a_hemisphere_shrinks_as_stereographic_projection_says():
    """Projected from the south pole to the plane of the equator, which keeps its length: 2 / (1 + z) before scaling."""
    vertices, faces = shapes.icosphere(4)
    table = CornerTable.of(vertices, faces)
    unit = vertices / np.linalg.norm(vertices, axis=1)[:, None]
    inside = np.flatnonzero(unit[:, 2] > 1e-9)
    scale = ConformalFactor.of(table).solve(inside)
    # The map (x, y) / (1 + z) has the scale 1 / (1 + z), and 1 at the equator.
    assert scale[inside] == pytest.approx(-np.log(1 + unit[inside, 2]), abs=0.03)


def test_pieces_between_fixed_vertices_are_solved_alone():
    vertices, faces = shapes.icosphere(3)
    factor = ConformalFactor.of(CornerTable.of(vertices, faces))
    up, down = np.flatnonzero(vertices[:, 2] > 0.1), np.flatnonzero(vertices[:, 2] < -0.1)
    together = factor.solve(np.concatenate([up, down]))
    assert together == pytest.approx(factor.solve(up) + factor.solve(down), abs=1e-9)


@pytest.mark.parametrize("size", [1e-6, 1.0, 1e6])
def test_the_scale_does_not_depend_on_size(size):
    vertices, faces = shapes.tube_tree()
    free = np.arange(0, len(vertices), 2)
    known = ConformalFactor.of(CornerTable.of(vertices, faces)).solve(free)
    assert ConformalFactor.of(CornerTable.of(size * vertices, faces)).solve(free) == pytest.approx(known)

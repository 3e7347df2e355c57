# SPDX-License-Identifier: GPL-3.0-or-later
"""What vertices are classified by: both curvatures, whatever the size of the shape, large ones drawn together."""

import numpy as np
import pytest
import shapes

from core.cuts.lavoue.method import curvature_features
from core.mesh.triangles import TriMesh


@pytest.mark.parametrize("radius", [1e-3, 1.0, 500.0])
def test_both_curvatures_of_a_ball_of_any_size(radius):
    # 1 / radius, in units of 1 / square root of the area, is the square root of 4 pi.
    features = curvature_features(TriMesh(*shapes.icosphere(3, radius)))
    assert features == pytest.approx(10 * np.arcsinh(np.sqrt(4 * np.pi) / 10), rel=0.05)


def test_a_curvature_far_above_that_of_the_shape_counts_by_its_logarithm():
    ball, small, smaller = (shapes.icosphere(3, radius) for radius in (1.0, 0.02, 0.002))
    mesh = TriMesh(*shapes.together(ball, shapes.moved(small, (2, 0, 0)), shapes.moved(smaller, (3, 0, 0))))
    count = len(ball.vertices)
    means = [curvature_features(mesh)[i * count:][:count].mean() for i in range(3)]
    assert means[0] == pytest.approx(10 * np.arcsinh(np.sqrt(4 * np.pi) / 10), rel=0.05)
    assert means[2] - means[1] == pytest.approx(10 * np.log(10), rel=0.05)

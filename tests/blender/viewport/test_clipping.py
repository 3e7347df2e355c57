# SPDX-License-Identifier: GPL-3.0-or-later
"""Where Alt+B ends a view, what is drawn over it ends, too."""

import sys
from types import SimpleNamespace

import numpy as np
from mathutils import Matrix, Vector

# A cube of the world from -1 to 1 in x and y, seen along z; of Blender's six planes two are not used.
VIEW = SimpleNamespace(use_clip_planes=True, clip_planes=[
    [1, 0, 0, 1], [-1, 0, 0, 1], [0, 1, 0, 1], [0, -1, 0, 1], [0, 0, 0, 0], [0, 0, 0, 0]])


def test_of_lines_that_is_left_which_is_within_the_planes(package):
    """The graph and outlines were drawn beyond it, over nothing."""
    clipping = sys.modules[f"{package}.viewport.clipping"]
    rng = np.random.default_rng(0)
    ends = rng.uniform(-2.0, 2.0, (200, 2, 3)).astype(np.float32)
    matrix = Matrix.LocRotScale(Vector((0.3, -0.2, 5.0)), Matrix.Rotation(0.7, 3, "Z"), Vector((-1.0, 2.0, 0.5)))
    left, kept = clipping.clipped_lines(VIEW, ends, matrix)

    def clipped(points):
        return clipping.is_clipped(VIEW, points, matrix)

    assert 20 < kept.sum() < 180
    for line, rest, any_left in zip(ends, left, kept, strict=True):
        along = line[0] + np.linspace(0.0, 1.0, 400)[:, None] * (line[1] - line[0])
        inside = along[~clipped(along)]
        if not any_left:
            assert not len(inside)
            continue
        assert not clipped(0.999 * rest + 0.001 * rest.mean(axis=0)).any()
        if len(inside):
            step = np.linalg.norm(along[1] - along[0])
            assert np.linalg.norm(inside[[0, -1]] - rest, axis=1).max() <= step + 1e-5


def test_without_it_all_is_left(package):
    clipping = sys.modules[f"{package}.viewport.clipping"]
    ends = np.random.default_rng(0).uniform(-9.0, 9.0, (20, 2, 3)).astype(np.float32)
    view = SimpleNamespace(use_clip_planes=False, clip_planes=VIEW.clip_planes)
    left, kept = clipping.clipped_lines(view, ends, Matrix.Identity(4))
    assert kept.all()
    assert np.array_equal(left, ends)
    assert not clipping.is_clipped(view, ends[:, 0], Matrix.Identity(4)).any()

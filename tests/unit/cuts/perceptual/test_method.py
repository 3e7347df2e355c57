# SPDX-License-Identifier: GPL-3.0-or-later
"""The preset "Perceptual" as a whole: parts of simple shapes, dense and coarse."""

import numpy as np
import pytest
import shapes

from core import Parameters, TriMesh, decompose
from core.cuts.perceptual.method import DECISION, MAX_FACES, salience_of
from core.surface.arrays import components


def halves(shape, labels):
    """Share of the area whose label is that of most of its half, above and below z = 0."""
    mesh = TriMesh(*shape)
    above = mesh.face_centroids[:, 2] > 0
    right = [np.bincount(labels[side], mesh.face_area[side]).max() for side in (above, ~above)]
    return sum(right) / mesh.area


@pytest.mark.parametrize("size", [(40, 24), (300, 200)])
def test_two_balls_are_two_parts_however_dense(size):
    """The dense one goes through a coarse copy."""
    shape = shapes.dumbbell(*size)
    assert (len(shape.faces) > MAX_FACES) == (size == (300, 200))
    parts = decompose(*shape).parts(n_parts=2)
    mesh = TriMesh(*shape)
    same = parts.labels[mesh.edges.pairs[:, 0]] == parts.labels[mesh.edges.pairs[:, 1]]
    assert components(mesh.n_faces, *mesh.edges.pairs[same].T)[0] == 2
    assert halves(shape, parts.labels) > 0.95


def test_scale_and_pose_change_nothing():
    shape = shapes.tube_tree()
    turn = np.linalg.qr(np.random.default_rng(3).normal(size=(3, 3)))[0]
    turn *= np.sign(np.linalg.det(turn))
    plain, moved = decompose(*shape), decompose(100 * shape.vertices @ turn.T - 7, shape.faces)
    assert plain.parts().count == moved.parts().count
    assert (plain.parts().labels != moved.parts().labels).mean() < 0.02


def test_nothing_moves_without_a_band():
    """Both are cut alike but for where the cuts run."""
    shape = shapes.tube_tree()
    still, moved = (decompose(*shape, Parameters(band_ratio=a)) for a in (0.0, 0.5))
    assert still.parts().count == moved.parts().count
    assert (still.candidates != moved.candidates).any()


def test_salience_stretches_the_decision_to_one_half():
    assert salience_of(np.array([0.0, DECISION, 1.0])).tolist() == [0.0, 0.5, 1.0]
    assert (np.diff(salience_of(np.linspace(0, 1, 50))) > 0).all()

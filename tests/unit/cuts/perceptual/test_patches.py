# SPDX-License-Identifier: GPL-3.0-or-later
"""Patches: connected, covering, and with borders where they were asked for."""

import numpy as np
import pytest
import shapes

from core.cuts.perceptual.patches import N_PATCHES, SLABS, concave_patches, level_set_patches
from core.graph.level_sets import cut_at_levels, uniform_levels
from core.surface.arrays import components
from core.surface.mesh import TriMesh


def mesh_of(shape) -> TriMesh:
    return TriMesh(*shape)


def assert_connected(mesh, label):
    a, b = mesh.edges.pairs[label[mesh.edges.pairs[:, 0]] == label[mesh.edges.pairs[:, 1]]].T
    assert components(mesh.n_faces, a, b)[0] == label.max() + 1


@pytest.mark.parametrize("shape", [shapes.torus(), shapes.dumbbell(), shapes.flat_grid(12, 9)])
def test_concave_patches_are_connected_and_numbered_from_zero(shape):
    mesh = mesh_of(shape)
    label = concave_patches(mesh)
    assert (np.unique(label) == np.arange(label.max() + 1)).all()
    assert label.max() < N_PATCHES
    assert_connected(mesh, label)


def test_borders_of_level_set_patches_lie_on_levels():
    mesh = mesh_of(shapes.dumbbell())
    along = mesh.vertices @ np.array([0.3, 0.5, 1.0])
    values = (along - along.min()) / np.ptp(along)
    label = level_set_patches(cut_at_levels(mesh, values, uniform_levels(100)))
    assert label.max() > 5
    assert_connected(mesh, label)
    left, right = mesh.edges.pairs[label[mesh.edges.pairs[:, 0]] != label[mesh.edges.pairs[:, 1]]].T
    around = values[np.concatenate([mesh.faces[left], mesh.faces[right]], axis=1)]
    levels = uniform_levels(SLABS)
    crossed = (levels >= around.min(axis=1)[:, None]) & (levels <= around.max(axis=1)[:, None])
    assert crossed.any(axis=1).all()

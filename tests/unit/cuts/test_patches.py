# SPDX-License-Identifier: GPL-3.0-or-later
"""Patches: connected, covering, and with borders where they were asked for."""

import numpy as np
import pytest
import shapes

from core.arrays.components import components
from core.cuts.patches import N_PATCHES, absorb_small, concave_patches
from core.cuts.perceptual.level_set_patches import SLABS, level_set_patches
from core.graph.level_sets import cut_at_levels, uniform_levels
from core.mesh.triangles import TriMesh


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


@pytest.mark.filterwarnings("error")
def test_a_piece_has_a_patch_of_its_own_however_small_it_is():
    """The seeds are all spread over the other one."""
    ball = shapes.icosphere(2)
    mesh = mesh_of(shapes.together(ball, shapes.Shape(ball.vertices[:3] / 10, np.array([[0, 1, 2]]))))
    for count in (1, 9):
        label = concave_patches(mesh, count)
        assert (label[:-1] != label[-1]).all()
        assert (np.unique(label) == np.arange(label.max() + 1)).all()


def test_of_two_equally_small_patches_the_first_joins_the_other():
    """Two slivers side by side, with a larger patch beside the second: both together are no sliver any more."""
    for count, expected in ((8, [0, 0, *[1] * 6]), (2, [0, 0])):
        mesh = mesh_of(shapes.flat_grid(count, 1))
        column = np.floor(mesh.face_centroids[:, 0]).astype(int)
        found = absorb_small(mesh, np.minimum(column, 2), 1.5 / mesh.area)
        assert found.tolist() == np.array(expected)[column].tolist()


def test_patches_end_where_a_sheet_is_folded_up_and_cross_where_it_is_folded_down():
    """Seven seeds at most, on a sheet 12 long and 6 wide with a fold of 90 degrees across its middle."""
    x, y, _ = shapes.flat_grid(12, 6).vertices.T
    for up in (1.0, -1.0):
        folded = np.stack([x, y, up * np.abs(x - 6.0)], axis=1)
        mesh = TriMesh(folded, shapes.flat_grid(12, 6).faces)
        label, left = concave_patches(mesh, 7), mesh.face_centroids[:, 0] < 6.0
        both = np.intersect1d(label[left], label[~left])
        assert len(both) == 0 if up > 0 else len(both) > 0


def test_seeds_are_added_where_patches_are_wide():
    """On a square none is small: each seed has a patch, and those of the last rounds make the widest narrower."""
    mesh = TriMesh(*shapes.flat_grid(40, 40))
    label = concave_patches(mesh, 60)
    area = np.bincount(label, mesh.face_area) / mesh.area
    assert len(area) == 60
    assert area.max() < 3 / 60

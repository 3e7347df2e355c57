# SPDX-License-Identifier: GPL-3.0-or-later
"""The preset "Perceptual" as a whole: parts of simple shapes, dense and coarse."""

import numpy as np
import pytest
import shapes

from core import Parameters, TriMesh, decompose
from core.arrays.components import components
from core.cuts.foundation import Foundation
from core.cuts.minimum_cut import WIDEST
from core.cuts.patches import concave_patches
from core.cuts.perceptual.method import MAX_FACES, SHARE_AT_HALF, perceptual_candidates, salience_of
from core.field.agd import agd_field, coarse_agd
from core.graph.level_sets import cut_at_levels, uniform_levels
from core.metrics import rand_index_error
from core.surface.coarsening import Pyramid


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


def test_small_pieces_of_a_dense_mesh_stay_whole():
    """They are smaller than the edges of its coarse copies."""
    dumbbell, speck = shapes.dumbbell(300, 200), shapes.tetrahedron()
    places = dumbbell.vertices[::5000]
    specks = [shapes.moved(shapes.Shape(1e-3 * speck.vertices, speck.faces), place) for place in places]
    result = decompose(*shapes.together(dumbbell, *specks))
    alone = decompose(*dumbbell)
    assert result.parts(n_parts=result.n_candidates).count >= len(places) + 2
    own = result.parts(0.5).labels[: len(dumbbell.faces)]
    assert rand_index_error(own, alone.parts(0.5).labels) < 0.01


def test_scale_and_pose_change_nothing():
    shape = shapes.tube_tree()
    turn = np.linalg.qr(np.random.default_rng(3).normal(size=(3, 3)))[0]
    turn *= np.sign(np.linalg.det(turn))
    plain, moved = decompose(*shape), decompose(100 * shape.vertices @ turn.T - 7, shape.faces)
    assert plain.parts().count == moved.parts().count
    assert (plain.parts().labels != moved.parts().labels).mean() < 0.02


@pytest.fixture(scope="module")
def tree():
    """A tree of tubes, cut at the levels of its field, and its patches before any cut has moved."""
    mesh = TriMesh(*shapes.tube_tree())
    pyramid = Pyramid(mesh)
    field = agd_field(mesh, coarse_agd(pyramid, np.sqrt(0.02 * mesh.area)), True)
    return Foundation(pyramid, field, cut_at_levels(mesh, field.values, uniform_levels(30))), concave_patches(mesh)


def test_nothing_moves_without_a_band(tree):
    foundation, patches = tree
    found = perceptual_candidates(foundation, Parameters(band_ratio=0.0))
    np.testing.assert_array_equal(found.element_candidate, patches[foundation.sets.element_face])


def test_with_a_band_faces_beside_the_cuts_move_and_nothing_else(tree):
    foundation, patches = tree
    sets = foundation.sets
    mesh = sets.mesh
    still, found = (perceptual_candidates(foundation, Parameters(band_ratio=ratio)) for ratio in (0.0, 1.0))
    element, hierarchy = found.element_candidate, found.hierarchy
    np.testing.assert_array_equal(hierarchy.merges, still.hierarchy.merges)
    np.testing.assert_array_equal(hierarchy.salience, still.hierarchy.salience)
    moved = np.empty(mesh.n_faces, np.int64)
    moved[sets.element_face] = element
    np.testing.assert_array_equal(element, moved[sets.element_face])  # faces move as a whole
    before, after = (hierarchy.parts_at(0.75)[label] for label in (patches, moved))
    a, b = mesh.edges.pairs.T
    beside = np.unique(mesh.edges.pairs[before[a] != before[b]])
    away = np.linalg.norm(mesh.face_centroids[:, None] - mesh.face_centroids[beside], axis=2).min(axis=1)
    assert (before != after).any()
    assert away[patches != moved].max() <= WIDEST * np.sqrt(mesh.area)


def test_salience_stretches_the_decision_to_one_half():
    assert salience_of(np.array([0.0, SHARE_AT_HALF, 1.0])).tolist() == [0.0, 0.5, 1.0]
    assert (np.diff(salience_of(np.linspace(0, 1, 50))) > 0).all()

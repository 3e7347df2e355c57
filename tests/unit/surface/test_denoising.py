# SPDX-License-Identifier: GPL-3.0-or-later
"""Noise is told from shape, and taken off; what has none stays as it is, to the bit."""

import numpy as np
import pytest
import shapes

from core import decompose
from core.mesh.triangles import TriMesh
from core.metrics import rand_index_error
from core.surface.denoising import denoised, roughness


def shaken(shape, share, seed=0):
    """A mesh whose vertices are moved by noise, in shares of its mean edge."""
    mesh = TriMesh(*shape)
    noise = np.random.default_rng(seed).normal(size=mesh.vertices.shape)
    return TriMesh(mesh.vertices + share * mesh.edge_length.mean() * noise, mesh.faces)


SLANTED = shapes.flat_grid(30, 30)[0] @ shapes.rotation(np.random.default_rng(1)).T, shapes.flat_grid(30, 30)[1]
TABLE = shapes.table_of_blocks()[0], shapes.split_quads(shapes.table_of_blocks()[1])
CLEAN = {
    "ball": shapes.icosphere(4), "torus": shapes.torus(96, 32), "dumbbell": shapes.dumbbell(), "horse": shapes.horse(),
    "box of twelve triangles": shapes.box(), "flat grid": shapes.flat_grid(30, 30), "flat grid, turned": SLANTED,
    "cylinder": shapes.cylinder(40, 32), "table of blocks": TABLE, "tetrahedron": shapes.tetrahedron(),
}


@pytest.mark.parametrize("name", CLEAN)
def test_what_has_no_noise_stays_as_it_is(name):
    mesh = TriMesh(*CLEAN[name])
    assert denoised(mesh) is mesh


def test_noise_of_a_grid_has_the_correlation_of_independent_noise():
    # Six neighbors, of which any two that are neighbors share two: -(1/3 - 2/36) / (1 + 1/6). Only heights are moved.
    vertices, faces = shapes.flat_grid(120, 120)
    heights = 0.1 * np.random.default_rng(3).normal(size=len(vertices))
    correlation, size = roughness(TriMesh(vertices + heights[:, None] * (0, 0, 1), faces))
    assert correlation == pytest.approx(-5 / 21, abs=0.03)
    assert size > 0.02


@pytest.mark.parametrize("share", [0.1, 0.2, 0.4])
def test_most_of_the_noise_of_a_ball_is_taken_off(share):
    rough = shaken(shapes.icosphere(5), share)
    smooth = denoised(rough)
    off = [np.std(np.linalg.norm(mesh.vertices, axis=1)) for mesh in (rough, smooth)]
    assert off[1] < 0.4 * off[0]
    assert np.linalg.norm(smooth.vertices, axis=1).mean() == pytest.approx(1.0, abs=0.005)  # it does not shrink
    assert np.array_equal(smooth.faces, rough.faces)


def test_borders_stay_where_they_are():
    rough = shaken(shapes.flat_grid(40, 40), 0.2)
    smooth = denoised(rough)
    border = np.unique(rough.edges.vertices[rough.edges.n_faces == 1])
    assert np.array_equal(smooth.vertices[border], rough.vertices[border])
    assert not np.array_equal(smooth.vertices, rough.vertices)


def test_moved_turned_and_scaled_meshes_lose_the_same_noise():
    rough = shaken(shapes.torus(96, 32), 0.2)
    expected = denoised(rough).vertices
    turn = shapes.rotation(np.random.default_rng(1))
    moved = denoised(TriMesh(3.7 * rough.vertices @ turn.T + (5.0, -2.0, 1.0), rough.faces)).vertices
    np.testing.assert_allclose((moved - (5.0, -2.0, 1.0)) @ turn / 3.7, expected, atol=1e-12)


def test_a_dumbbell_of_noise_has_the_parts_of_a_dumbbell():
    clean = shapes.dumbbell(120, 60)
    rough = shaken(clean, 0.3)
    ours, theirs = (decompose(vertices, clean[1]).parts() for vertices in (clean[0], rough.vertices))
    assert theirs.count == ours.count
    assert rand_index_error(ours.labels, theirs.labels) < 0.02


def test_a_few_spikes_are_no_noise():
    """They stand out as far as all else together, and each against its neighbors, as noise does."""
    vertices, faces = shapes.icosphere(4)
    vertices = vertices.copy()
    vertices[::250] *= 1.2
    mesh = TriMesh(vertices, faces)
    assert denoised(mesh) is mesh

# SPDX-License-Identifier: GPL-3.0-or-later
"""What is one surface with the ground on which it stands has parts as if it stood alone."""

import numpy as np
import pytest
import shapes

from core import Parameters, decompose
from core.mesh.grounds import find_standing
from core.mesh.polygons import PolygonMesh

RNG = np.random.default_rng(5)
PATCH = shapes.figure_on_ground(7.0)
GROUNDS = {"patch": PATCH, "narrow patch": shapes.figure_on_ground(4.5), "hills": shapes.figure_on_ground(9.0, 0.4),
           "slab": shapes.figure_on_ground(7.0, deep=0.15)}


def standing(vertices, faces):
    """Which faces stand on grounds."""
    found = find_standing(PolygonMesh.of(vertices, faces))
    stands = np.full(len(faces), found is None)
    if found:
        stands[found.polygon] = True
    return stands


def noisy(shape, size):
    return shape.vertices + size * RNG.normal(size=shape.vertices.shape)


@pytest.mark.parametrize("name", GROUNDS)
def test_what_stands_on_terrain_has_its_limbs(name):
    """With a patch of ground that is three times as wide, a figure was one part."""
    shape = GROUNDS[name]
    found = decompose(*shape)
    parts = found.parts()
    assert parts.ground.sum() == 1
    ground = parts.labels == parts.ground.argmax()
    np.testing.assert_array_equal(ground, ~standing(*shape))
    x, _, z = shape.vertices[shape.faces].mean(axis=1).T
    assert not ground[z > -1.0].any()
    assert ground[(np.abs(x) > 1.0) & (z < -0.6)].all()
    middle = shape.vertices[shape.faces].mean(axis=1)
    tips = [(1.5, 0.1, 1.0), (-1.5, 0.1, 1.0), (0.5, 0, -1.0), (-0.5, 0, -1.0), (0, 0, 0.6), (2, 2, -1.5)]
    of_tip = [parts.labels[np.linalg.norm(middle - tip, axis=1).argmin()] for tip in tips]
    assert len(set(of_tip)) == len(tips)
    left = find_standing(PolygonMesh.of(*shape)).without_grounds(PolygonMesh.of(*shape)).triangles
    np.testing.assert_array_equal(found.candidates[~ground], decompose(left.vertices, left.faces).candidates)


@pytest.mark.parametrize("name", GROUNDS)
def test_it_is_found_however_the_mesh_is_given(name):
    shape, stands = GROUNDS[name], standing(*GROUNDS[name])
    assert 0 < stands.sum() < len(stands)
    turn = shapes.rotation(RNG)
    np.testing.assert_array_equal(standing(1e-30 * shape.vertices @ turn.T, shape.faces), stands)
    other, _, faces = shapes.shuffled(shape, RNG)
    np.testing.assert_array_equal(standing(*other), stands[faces])
    np.testing.assert_array_equal(standing(*shapes.inside_out(shape)), stands)
    np.testing.assert_array_equal(standing(*shapes.unjoined(shape)), stands)
    for size in (0.01, 0.03):  # a quarter of an edge
        assert (standing(noisy(shape, size), shape.faces) != stands).mean() < 0.02


def test_other_pieces_stand_there_too():
    bird = shapes.moved(shapes.icosphere(2, 0.3), (1.0, 1.0, 2.0))
    stands = standing(*shapes.together(bird, PATCH))
    n = len(bird.faces)
    assert stands[:n].all()
    np.testing.assert_array_equal(stands[n:], standing(*PATCH))
    below = shapes.moved(bird, (0, 0, -5.0))
    assert standing(*shapes.together(below, below, PATCH)).all()


def test_methods_of_papers_get_the_surface_whole():
    found = decompose(*GROUNDS["narrow patch"], Parameters.preset("Berretti 2009"))
    assert not any("such as a floor" in str(note) for note in found.notes)
    assert (found.field > 0).mean() > 0.99  # 0 at one vertex, and on what is left out


def test_what_is_no_terrain():
    figure = shapes.mirrored_figure()
    assert standing(*figure).all()
    assert standing(*shapes.figure_on_ground(2.5)).all()  # narrower than its arms
    assert standing(*shapes.figure_on_ground(7.0, deep=0.7)).all()  # a plinth, or a table on its head
    assert standing(*shapes.table_of_blocks()).all()
    vertices, faces = shapes.flat_grid(30, 30, 0.2)
    away = vertices[:, :2] - vertices[:, :2].mean(axis=0)
    hill = vertices + np.outer(0.8 * np.exp(-(away**2).sum(axis=1)), (0, 0, 1))
    assert standing(hill, faces).all()
    assert standing(*shapes.flat_grid(20, 20)).all()

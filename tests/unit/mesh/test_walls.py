# SPDX-License-Identifier: GPL-3.0-or-later
"""Walls: the inner side of a thin wall around a hollow has the parts of the outer one."""

import numpy as np
import pytest
import shapes

from core import decompose
from core.mesh.copies import find_copies
from core.mesh.polygons import PolygonMesh
from core.metrics import rand_index_error

RNG = np.random.default_rng(5)


def opened(shape, share=0.02):
    """The shape without its lowest faces."""
    height = shape.vertices[shape.faces].mean(axis=1)[:, 2]
    return shapes.Shape(shape.vertices, shape.faces[height > np.quantile(height, share)])


FIGURE = opened(shapes.mirrored_figure())
WALL = shapes.thickened(FIGURE, 0.03)
N_FACES = len(FIGURE.faces)
COARSE = shapes.thickened(opened(shapes.icosphere(2)), 0.004)  # its faces are larger than points on it are apart


def copied(shape):
    """Which polygons are copies; None if there are none."""
    copies = find_copies(PolygonMesh.of(*shape))
    return None if copies is None else copies.is_copy


def test_both_sides_of_a_wall_have_the_parts_of_the_surface():
    """A shell with a thickness came in other parts inside than outside."""
    alone, result = decompose(*FIGURE), decompose(*WALL)
    for count in (1, 3, 5):
        expected, labels = alone.parts(n_parts=count).labels, result.parts(n_parts=count).labels
        outer, inner = labels[:N_FACES], labels[N_FACES:2 * N_FACES]
        assert labels.max() + 1 == count
        assert (outer != inner).mean() < 0.01
        assert rand_index_error(outer, expected) < 0.01
    assert result.notes[-1].startswith(f"{copied(WALL).sum()} faces run along others as a second skin")
    assert not any("border edge" in note for note in result.notes)
    assert result.candidate_area.sum() > 1.8 * alone.candidate_area.sum()
    assert len(result.field) == len(WALL.vertices)
    assert np.isfinite(result.field[np.unique(WALL.faces)]).all()


def test_it_is_the_inner_side_that_is_left_out():
    is_copy = copied(WALL)
    assert not is_copy[:N_FACES].any()
    assert is_copy[N_FACES:2 * N_FACES].all()


@pytest.mark.parametrize("change", [
    shapes.inside_out, shapes.unjoined, lambda shape: shapes.Shape(2.0**9 * shape.vertices, shape.faces),
    lambda shape: shapes.Shape(shape.vertices @ shapes.rotation(RNG).T + 4.0, shape.faces)])
def test_it_is_found_whatever_way_the_mesh_is_stored(change):
    assert (copied(change(WALL))[:2 * N_FACES] == copied(WALL)[:2 * N_FACES]).all()


def test_a_wall_twice_as_large_runs_along_the_same_faces():
    along = [find_copies(PolygonMesh.of(size * COARSE.vertices, COARSE.faces)).original for size in (1.0, 2.0)]
    assert (along[0] == along[1]).all()


def test_the_order_of_the_mesh_does_not_tell_the_side():
    mixed, _, faces = shapes.shuffled(WALL, RNG)
    is_copy = np.empty(len(WALL.faces), bool)
    is_copy[faces] = copied(mixed)
    assert (is_copy == copied(WALL)).all()


def test_a_wall_of_quads_is_one_of_its_polygons():
    vertices, quads = shapes.pipe(24, 12, inner=0.95)
    copies = find_copies(PolygonMesh.of(vertices, quads))
    radius = np.linalg.norm(vertices[quads].mean(axis=1)[:, :2], axis=1)
    rim = np.ptp(np.linalg.norm(vertices[quads][:, :, :2], axis=2), axis=1) > 0.01
    assert copies.is_copy[~rim & (radius < 0.97)].all()
    assert not copies.is_copy[~rim & (radius > 0.97)].any()
    # What a face is on lies behind it.
    across = vertices[quads].mean(axis=1)
    along = copies.polygon[copies.original]
    assert np.linalg.norm(across[along] - across, axis=1).max() < 0.2


def test_every_vertex_of_the_inner_side_has_one_of_the_outer_side_near_it():
    copies = find_copies(PolygonMesh.of(*WALL))
    home = copies.vertex[copies.home]
    assert (home[:len(FIGURE.vertices)][np.unique(FIGURE.faces)] == np.unique(FIGURE.faces)).all()
    assert np.linalg.norm(WALL.vertices[home] - WALL.vertices, axis=1)[np.unique(WALL.faces)].max() < 0.2


@pytest.mark.parametrize("shape", [
    shapes.icosphere(3), shapes.torus(48, 16, 1.0, 0.04), shapes.box((1.0, 1.0, 0.01)), shapes.horse(0.1),
    opened(shapes.icosphere(3)), shapes.thickened(shapes.flat_grid(20, 20), 0.2), shapes.thickened(FIGURE, 0.4)],
    ids=["ball", "wire", "slab", "horse", "open", "plate", "thick"])
def test_what_is_no_thin_wall_around_a_hollow_stays_whole(shape):
    assert copied(shape) is None


def test_walls_that_are_little_of_the_mesh_stay_whole():
    ball = shapes.moved(shapes.icosphere(4, 5.0), (9.0, 0.0, 0.0))
    assert copied(shapes.together(WALL, ball)) is None
    several = shapes.together(WALL, shapes.moved(shapes.icosphere(3, 0.5), (9.0, 0.0, 0.0)))
    assert (copied(several)[:len(WALL.faces)] == copied(WALL)).all()
    assert not copied(several)[len(WALL.faces):].any()

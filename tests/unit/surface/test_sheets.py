# SPDX-License-Identifier: GPL-3.0-or-later
"""Sheets: what is one and what is not, and what they look like inflated."""

import figures
import numpy as np
import pytest
import shapes
from shapes import Shape

from core import TriMesh
from core.surface.sheets import HEIGHT, inflated, sheet_faces
from core.surface.winding import winding_numbers


def is_sheet(shape):
    """Whether all faces are of sheets; all or none must be."""
    mesh = TriMesh(*shape)
    sheet = sheet_faces(mesh, mesh.face_centroids @ (0.3, 0.5, 0.7))
    assert sheet.all() == sheet.any()
    return bool(sheet.all())


def cut(shape, keep):
    """The faces whose middles, (m, 3), are to be kept."""
    mesh, _ = TriMesh(*shape).submesh(keep(TriMesh(*shape).face_centroids))
    return Shape(mesh.vertices, mesh.faces)


def moebius(n=60):
    """A strip with a half turn."""
    u = 2 * np.pi * np.arange(n) / n
    rings = [np.stack([(1 + s * np.cos(u / 2)) * np.cos(u), (1 + s * np.cos(u / 2)) * np.sin(u), s * np.sin(u / 2)], 1)
             for s in (-0.3, 0.0, 0.3)]
    index = np.arange(3 * n).reshape(3, n)
    index = np.concatenate([index, index[::-1, :1]], axis=1)
    quads = np.stack([index[:-1, :-1], index[1:, :-1], index[1:, 1:], index[:-1, 1:]], axis=-1).reshape(-1, 4)
    return Shape(np.concatenate(rings), shapes.split_quads(quads))


def waves(height):
    grid = shapes.flat_grid(40, 40, 1 / 40)
    x, y, _ = grid.vertices.T
    return Shape(grid.vertices + (height * np.sin(19 * x + 2 * np.sin(5 * y)))[:, None] * (0, 0, 1), grid.faces)


SHEETS = {
    "grid": shapes.flat_grid(20, 20),
    "frame": shapes.flat_cells([(x, y) for x in range(8) for y in range(8) if not (2 <= x < 6 and 2 <= y < 6)]),
    "saddle": shapes.monkey_saddle(8),
    "person": figures.sheet(figures.person(), 0.1)[0],
    "hand": figures.sheet(figures.hand(), 0.1)[0],
    "bent a quarter turn": cut(shapes.cylinder(20, 32, capped=False), lambda c: (c[:, 0] > 0) & (c[:, 1] > 0)),
    "shallow bowl": cut(shapes.icosphere(4), lambda c: c[:, 2] > 0.87),
    "waves": waves(0.05),
    "high waves": waves(0.1),
}
SOLIDS = {
    "ball": shapes.icosphere(3),
    "box": shapes.box(),
    "hemisphere": cut(shapes.icosphere(4), lambda c: c[:, 2] > 0),
    "head with an open mouth": cut(shapes.icosphere(4), lambda c: c[:, 2] > -0.9),
    "cup without bottom": cut(shapes.cylinder(20, 32), lambda c: c[:, 2] > 0.01),
    "tube": shapes.cylinder(20, 32, capped=False),
    "half a tube": cut(shapes.cylinder(20, 32, capped=False), lambda c: c[:, 0] > 0),
    "half a tree": cut(shapes.tube_tree(), lambda c: c[:, 2] > 0),
    "half a jug": cut(shapes.genus_two(), lambda c: c[:, 1] > 0),
    "half a dumbbell": cut(shapes.dumbbell(), lambda c: c[:, 0] > 0),
    "plate without a wall": cut(figures.plate(shapes.flat_grid(20, 20), 2.0),
                                lambda c: c[:, 0] > 0.01),
    "Moebius": moebius(),
}


@pytest.mark.parametrize("name", SHEETS)
def test_sheets_are_found(name):
    assert is_sheet(SHEETS[name])


@pytest.mark.parametrize("name", SOLIDS)
def test_solids_with_holes_are_not_sheets(name):
    assert not is_sheet(SOLIDS[name])


@pytest.mark.parametrize("seed", range(3))
@pytest.mark.parametrize("name", ["person", "saddle", "half a tree", "hemisphere"])
def test_neither_pose_nor_scale_nor_order_nor_side_matters(name, seed):
    shape = {**SHEETS, **SOLIDS}[name]
    rng = np.random.default_rng(seed)
    moved, _, _ = shapes.shuffled(Shape(30 * shape.vertices @ shapes.rotation(rng).T + 100, shape.faces), rng)
    assert is_sheet(moved) == is_sheet(shapes.inside_out(moved)) == (name in SHEETS)


def test_a_sheet_beside_or_within_a_ball_is_found_alone():
    ball, grid = shapes.icosphere(3), shapes.flat_grid(8, 8, 0.12)
    for place in ((2.0, 0.0, 0.0), (-0.48, -0.48, 0.05)):
        mesh = TriMesh(*shapes.together(ball, shapes.moved(grid, place)))
        sheet = sheet_faces(mesh, mesh.face_centroids @ (0.3, 0.5, 0.7))
        np.testing.assert_array_equal(sheet, np.arange(mesh.n_faces) >= len(ball.faces))


@pytest.mark.parametrize(("width", "found"), [(0.5, False), (1.2, True)])
def test_a_sheet_that_is_a_small_share_of_the_surface_is_none(width, found):
    """Beside a ball of area 4 pi, a square of 0.02 of it, and one of 0.1."""
    square = shapes.flat_grid(6, 6)
    square = shapes.moved(Shape(width / 6 * square.vertices, square.faces), (2, 0, 0))
    shape = shapes.together(shapes.icosphere(3), square)
    sheet = sheet_faces(TriMesh(*shape), TriMesh(*shape).face_centroids @ (0.3, 0.5, 0.7))
    assert sheet.tolist() == [False] * 1280 + [found] * 72


def test_two_sheets_that_enclose_a_solid_are_none():
    """The front and the back of a lens: each alone would be one."""
    front = cut(shapes.icosphere(4), lambda c: c[:, 2] > 0.87)
    front = shapes.moved(front, (0, 0, -0.85))
    back = shapes.inside_out(Shape(front.vertices * (1, 1, -1), front.faces))
    assert is_sheet(front)
    assert is_sheet(back)
    assert not is_sheet(shapes.together(front, back))


def test_winding_is_half_on_a_closed_surface_and_none_in_a_plane():
    for shape, expected in ((shapes.icosphere(3), 0.5), (shapes.torus(), 0.5), (shapes.inside_out(shapes.box()), -0.5),
                            (shapes.flat_grid(5, 5), 0.0)):
        mesh = TriMesh(*shape)
        every = np.arange(mesh.n_faces)
        winding = winding_numbers(mesh, every, every, mesh.area)
        assert winding == pytest.approx(np.full(mesh.n_faces, expected), abs=1e-9)


@pytest.mark.parametrize(("name", "euler"), [("person", 2), ("frame", 0), ("saddle", 2)])
def test_an_inflated_sheet_is_a_closed_solid(name, euler):
    mesh = TriMesh(*SHEETS[name])
    solid = inflated(mesh, np.ones(mesh.n_faces, bool))
    assert (solid.mesh.edges.n_faces == 2).all()
    assert solid.mesh.euler_characteristic == euler  # twice that of the sheet: borders are circles
    volume = (solid.mesh.area_normals * solid.mesh.face_centroids).sum() / 3
    assert volume > 0
    assert solid.mesh.n_faces == 2 * solid.n_front
    np.testing.assert_array_equal(solid.face_source[: solid.n_front], solid.face_source[solid.n_front:])
    for source in (solid.face_source[: solid.n_front], solid.face_source[solid.n_front:]):
        np.testing.assert_array_equal(np.unique(source), np.arange(mesh.n_faces))
    assert (solid.on_front(solid.face_source, mesh.n_faces) == np.arange(mesh.n_faces)).all()


def test_what_is_no_sheet_stays_in_place():
    ball, grid = shapes.icosphere(2), shapes.flat_grid(8, 8, 0.1)
    mesh = TriMesh(*shapes.together(ball, shapes.moved(grid, (2, 0, 0))))
    solid = inflated(mesh, np.arange(mesh.n_faces) >= len(ball.faces))
    n = len(ball.vertices)
    np.testing.assert_array_equal(solid.mesh.vertices[:n], ball.vertices)
    # Two of the grid's corners have one face, whose edge across is split, and each is two faces then.
    assert solid.mesh.n_faces == len(ball.faces) + 2 * (len(grid.faces) + 2 * 2)
    assert solid.mesh.face_components[0] == 2


def test_in_the_middle_of_a_strip_the_height_is_a_share_of_half_its_width():
    mesh = TriMesh(*shapes.flat_grid(60, 6, 0.5))
    solid = inflated(mesh, np.ones(mesh.n_faces, bool))
    x, y, z = solid.mesh.vertices[: mesh.n_vertices].T
    middle = (np.abs(x - 15) < 10) & (np.abs(y - 1.5) < 0.1)
    np.testing.assert_allclose(z[middle], HEIGHT * 1.5, rtol=0.01)
    # A circle's height across the strip; the vertices stay over their places.
    inner = (np.abs(x - 15) < 10) & (np.abs(y - 1.5) < 1.4)
    np.testing.assert_allclose(z[inner], HEIGHT * np.sqrt(1.5**2 - (y[inner] - 1.5) ** 2), rtol=0.02)
    np.testing.assert_allclose(np.column_stack([x, y]), mesh.vertices[:, :2], atol=1e-9)


def test_a_strip_one_quad_wide_is_inflated_too():
    mesh = TriMesh(*shapes.flat_grid(10, 1))
    solid = inflated(mesh, np.ones(mesh.n_faces, bool))
    assert (solid.mesh.edges.n_faces == 2).all()
    # Its diagonals and the inner cross lines are split: their middles are all there is to lift.
    new = solid.mesh.vertices[mesh.n_vertices:]
    lifted = new[new[:, 2] > 0]
    assert len(lifted) == 19
    assert (lifted[2:-2, 2] > 0.3 * HEIGHT).all()


def test_wrinkles_are_smoothed_before():
    mesh = TriMesh(*waves(0.05))
    solid = inflated(mesh, np.ones(mesh.n_faces, bool))
    back = solid.mesh.vertices[mesh.n_vertices + 2:]  # after the middles of two edges, across two corners
    front = solid.vertex_source[mesh.n_vertices + 2:, 0]
    middle = (solid.mesh.vertices[front] + back) / 2
    inner = (np.abs(mesh.vertices[front, :2] - 0.5) < 0.3).all(axis=1)
    assert inner.sum() > 400
    assert np.std(middle[inner, 2]) < 0.2 * np.std(mesh.vertices[front[inner], 2])


@pytest.mark.parametrize("seed", range(3))
def test_the_inflated_sheet_turns_and_scales_with_the_sheet(seed):
    mesh = TriMesh(*SHEETS["hand"])
    turn = shapes.rotation(np.random.default_rng(seed))
    moved = TriMesh(20 * mesh.vertices @ turn.T + 3, mesh.faces)
    every = np.ones(mesh.n_faces, bool)
    one, other = (inflated(m, every).mesh for m in (mesh, moved))
    np.testing.assert_array_equal(one.faces, other.faces)
    np.testing.assert_allclose(other.vertices, 20 * one.vertices @ turn.T + 3, atol=1e-5)

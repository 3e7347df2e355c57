# SPDX-License-Identifier: GPL-3.0-or-later
"""Which side is outside: of closed surfaces, of such with holes, and of sheets."""

import itertools

import numpy as np
import pytest
import shapes
from open_bodies import OPEN, opened

from core.mesh.corners import CornerTable
from core.mesh.triangles import TriMesh
from core.surface.orientation import against_neighbors, looks_inwards, of_either_side, of_solids, turn_outwards


@pytest.mark.parametrize("name", OPEN)
def test_what_has_holes_is_turned_outwards(name):
    right = TriMesh(*OPEN[name]())
    wrong = TriMesh(*shapes.inside_out(OPEN[name]()))
    assert turn_outwards(right) == (right, ())
    turned, notes = turn_outwards(wrong)
    np.testing.assert_array_equal(turned.faces, wrong.faces[:, ::-1])
    assert str(notes[0]).startswith(f"{len(wrong.faces)} triangles face inwards")


def test_each_piece_on_its_own():
    ball, pipe = OPEN["ball"](), shapes.moved(OPEN["thin pipe"](), (3, 0, 0))
    turned, _ = turn_outwards(TriMesh(*shapes.together(ball, shapes.inside_out(pipe))))
    np.testing.assert_array_equal(turned.face_normals, TriMesh(*shapes.together(ball, pipe)).face_normals)


@pytest.mark.parametrize("make", [
    lambda: shapes.flat_grid(6, 4), lambda: shapes.monkey_saddle(4),
    lambda: opened(shapes.icosphere(3), 2, 0.85), lambda: opened(shapes.cylinder(20, 24, 1.0, 3.0, False), 0, 0.6)])
def test_a_sheet_keeps_its_side(make):
    """Flat, or bent to at most a third of a pipe."""
    for shape in (make(), shapes.inside_out(make())):
        mesh = TriMesh(*shape)
        assert turn_outwards(mesh) == (mesh, ())


@pytest.mark.parametrize("scale", [1.0, 1.37, 0.3048, 25.4])
def test_what_is_folded_flat_keeps_its_side(scale):
    # A sheet and its back, joined at the rim: the volume is a rounding error of either sign.
    sheet = shapes.flat_grid(6, 5)
    vertices = scale * (sheet.vertices @ shapes.rotation(np.random.default_rng(1)).T).round(6)
    x, y = sheet.vertices[:, 0], sheet.vertices[:, 1]
    inside = (x > x.min()) & (x < x.max()) & (y > y.min()) & (y < y.max())
    below = np.where(inside, np.arange(len(x)) + len(x), np.arange(len(x)))
    faces = np.concatenate([sheet.faces, below[sheet.faces][:, ::-1]])
    for given in (faces, faces[:, ::-1]):
        mesh = TriMesh(np.concatenate([vertices, vertices]), given)
        assert turn_outwards(mesh) == (mesh, ())


def test_a_side_is_chosen_whichever_is_left():
    """Of a bowl that which looks outwards, of a card beside it that which looks away from the bowl; a lid stays."""
    vertices, faces = shapes.icosphere(2)
    bowl = shapes.Shape(vertices, faces[(vertices[faces][:, :, 2] < 0.3).all(axis=1)])
    card = shapes.moved(shapes.flat_grid(4, 4), (3.0, 0.0, 0.7))
    lid = shapes.inside_out(shapes.moved(shapes.flat_grid(3, 3), (-1.0, -1.0, -2.0)))
    mesh = TriMesh(*shapes.together(bowl, card, lid))
    chosen = np.arange(mesh.n_faces) < len(bowl.faces) + len(card.faces)
    rng = np.random.default_rng(0)
    for _ in range(4):
        left = np.where((chosen & (rng.random(mesh.n_faces) < 0.5))[:, None], mesh.faces[:, ::-1], mesh.faces)
        found = of_either_side(TriMesh(mesh.vertices, left), chosen)
        np.testing.assert_allclose(found.area_normals, mesh.area_normals, atol=1e-15)


def test_edges_are_contrary_where_one_of_two_faces_is_turned():
    """By hand: the three edges of a face of an octahedron."""
    vertices, faces = shapes.octahedron()
    assert not CornerTable.of(vertices, faces).contrary_edges().any()
    table = CornerTable.of(vertices, np.concatenate([faces[:1, ::-1], faces[1:]]))
    assert sorted(map(tuple, table.edges[table.contrary_edges()].tolist())) == sorted(
        tuple(sorted(pair)) for pair in itertools.combinations(faces[0].tolist(), 2))
    np.testing.assert_array_equal(against_neighbors(table), np.arange(len(faces)) == 0)


@pytest.mark.parametrize("share", [0.3, 0.7])
@pytest.mark.parametrize("name", ["closed", "open", "of squares"])
def test_faces_are_turned_until_neighbors_agree(name, share):
    """Closed pieces look outwards then, sheets to the side of most faces; a piece that agrees stays as it is."""
    vertices, faces = {"closed": lambda: shapes.icosphere(3), "open": lambda: shapes.flat_grid(12, 9),
                       "of squares": shapes.box_quads}[name]()
    wrong = np.zeros(len(faces), bool)
    wrong[np.random.default_rng(0).permutation(len(faces))[: round(share * len(faces))]] = True
    inward = faces[:, ::-1] + len(vertices)
    both = np.concatenate([np.where(wrong[:, None], faces[:, ::-1], faces), inward])
    flip = against_neighbors(CornerTable.of(np.concatenate([vertices, vertices + [9, 0, 0]]), both))
    assert not flip[len(faces) :].any()
    np.testing.assert_array_equal(flip[: len(faces)], ~wrong if name == "open" and share > 0.5 else wrong)


def test_what_has_one_side_only_stays_as_it_is():
    """Six squares in a ring with a twist: one edge is contrary, and no turn ends that."""
    across = np.arange(12).reshape(6, 2)
    ahead = np.concatenate([across[1:], across[:1, ::-1]])
    points = np.random.default_rng(0).normal(size=(12, 3))
    table = CornerTable.of(points, np.concatenate([across, ahead[:, ::-1]], axis=1))
    assert table.contrary_edges().sum() == 1
    assert not against_neighbors(table).any()


@pytest.mark.parametrize("way", [1, -1])
def test_what_is_closed_and_has_one_side_stays_as_it_is(way):
    """A bottle of Klein: a tube whose ends are joined the other way round; it encloses any volume."""
    around, along = np.meshgrid(np.arange(8), np.arange(12))
    corner = np.arange(96).reshape(12, 8)
    after = np.concatenate([corner[1:], corner[:1, (-np.arange(8)) % 8]])
    quads = np.stack([corner, np.roll(corner, -1, axis=1), np.roll(after, -1, axis=1), after], axis=-1).reshape(-1, 4)
    u, v = 2 * np.pi * around.ravel() / 8, 2 * np.pi * along.ravel() / 12
    vertices = np.stack([(3 + np.cos(u)) * np.cos(v), (3 + np.cos(u)) * np.sin(v), np.sin(u)], axis=1)
    table = CornerTable.of(vertices, quads[:, ::way])
    assert (table.n_edge_faces == 2).all()
    assert table.contrary_edges().sum() == 8
    assert not against_neighbors(table).any()


@pytest.mark.parametrize(("size", "turned"), [(0.02, False), (0.2, True)])
def test_an_open_piece_that_is_a_speck_keeps_its_side(size, turned):
    """Less than 0.002 of the area: a ball of a fiftieth of the radius of another one, inside out, with a hole."""
    speck = shapes.inside_out(OPEN["ball"]())
    speck = shapes.moved(shapes.Shape(size * speck.vertices, speck.faces), (3, 0, 0))
    _, notes = turn_outwards(TriMesh(*shapes.together(shapes.icosphere(3), speck)))
    assert bool(notes) == turned


def test_what_looks_inwards_is_closed_and_agrees():
    """A ball, turned; around another one that is turned, as a hollow one has, it is none; nor is half of one."""
    ball = shapes.icosphere(2)
    turned = shapes.inside_out(ball)
    hollow = shapes.together(ball, shapes.inside_out(shapes.Shape(0.5 * ball.vertices, ball.faces)))
    one_turned = np.concatenate([turned.faces[:1, ::-1], turned.faces[1:]])
    assert looks_inwards(CornerTable.of(*turned))
    assert looks_inwards(CornerTable.of(turned.vertices + 1e6, turned.faces))
    for other in (ball, hollow, (turned.vertices, turned.faces[1:]), (turned.vertices, one_turned)):
        assert not looks_inwards(CornerTable.of(*other))


def test_faces_of_solids_are_those_of_closed_pieces_that_look_outwards():
    ball = shapes.icosphere(1)
    turned, open_one = shapes.inside_out(ball), shapes.Shape(ball.vertices, ball.faces[1:])
    contrary = shapes.Shape(ball.vertices, np.concatenate([ball.faces[:1, ::-1], ball.faces[1:]]))
    pieces = [shapes.moved(piece, (3.0 * k, 0, 0)) for k, piece in enumerate((turned, ball, open_one, contrary))]
    found = of_solids(CornerTable.of(*shapes.together(*pieces)))
    assert np.array_equal(found, np.repeat([False, True, False, False], [len(piece.faces) for piece in pieces]))

# SPDX-License-Identifier: GPL-3.0-or-later
"""Grounds: what stands on a floor, on a plinth or before a backdrop has the parts that it has alone."""

import numpy as np
import pytest
import shapes
from floors import collider, column, has_ground, hills, sheet, tree

from core import Parameters, decompose
from core.arrays.components import components
from core.parameters import SEPARATE


def tiles(width, n=6):
    """The sheet of n x n quads, no two of which share vertices."""
    vertices, faces = sheet(width, n)
    quads = np.concatenate([faces[:n * n], faces[n * n:, 2:]], axis=1)
    return shapes.Shape(vertices[quads].reshape(-1, 3), np.concatenate(
        [4 * np.arange(n * n)[:, None] + triangle for triangle in ((0, 1, 2), (0, 2, 3))]))


def open_room(width, n=12):
    """A floor, a wall behind and one on each side, of n x n quads each, with corners of their own."""
    x, y, z = sheet(width, n).vertices.T
    half, high = np.full(len(x), width / 2), y + width / 2
    walls = [(x, y, z), (-x, half, high), (half, x, high), (-half, -x, high)]
    return shapes.together(*(shapes.Shape(np.stack(wall, axis=1), sheet(width, n).faces) for wall in walls))


def backdrop(width):
    """A floor that rises to a wall behind, in one piece."""
    along = np.array([(-1, 0), (0.5, 0), (0.8, 0.1), (1, 0.4), (1, 2)]) * width / 2
    x, (y, z) = np.array([[-width / 2], [width / 2]]), along.T
    vertices = np.stack([np.broadcast_to(a, (2, 5)) for a in (x, y, z)], axis=-1).reshape(-1, 3)
    a = np.arange(4)
    return shapes.Shape(vertices, np.concatenate([np.stack([a, a + 5, a + 6], axis=1),
                                                  np.stack([a, a + 6, a + 1], axis=1)]))


@pytest.mark.parametrize("floor", [
    sheet(5), sheet(40), sheet(200), sheet(12, 30), sheet(5, depth=0.6), sheet(15, depth=2), backdrop(15),
    shapes.icosphere(1, 20), shapes.moved(shapes.box((15, 15, 10)), (-7.5, -7.5, 0)), collider(),
    shapes.icosphere(2, 7.5), hills(15), tiles(15), open_room(15),
    shapes.subdivide(shapes.subdivide(shapes.subdivide(backdrop(15))))],
    ids=["near", "wide", "very wide", "of many faces", "plinth", "slab", "backdrop", "dome", "room", "box around it",
         "ball around it", "hills", "tiles", "open room", "backdrop of many faces"])
def test_what_stands_on_a_ground_has_the_parts_that_it_has_alone(floor):
    """On a floor three times as wide a person was one part."""
    alone, n = decompose(*tree()), len(tree().faces)
    turn = np.linalg.qr(np.random.default_rng(1).normal(size=(3, 3)))[0]
    shape = shapes.together(tree(), floor)
    for vertices in (shape.vertices, shape.vertices @ turn * 1e-30):
        found = decompose(vertices, shape.faces)
        labels = found.parts().labels
        if vertices is shape.vertices:
            np.testing.assert_array_equal(found.candidates[:n], alone.candidates)
        assert len(set(labels[:n])) == alone.parts().count >= 4
        assert len(set(labels[n:])) == 1
        assert labels[n] not in labels[:n]
        assert np.flatnonzero(found.parts().ground).tolist() == [labels[n]]
        assert not found.parts(0).ground.any()
        assert found.parts(0).count == 1
        assert found.parts(n_parts=2).labels.tolist() in ([0] * n + [1] * (len(labels) - n),
                                                           [1] * n + [0] * (len(labels) - n))
        assert "The rest is decomposed without 1 large plain piece, such as a floor." in map(str, found.notes)
        assert (found.field[len(tree().vertices):] == 0).all()
        assert found.parts().share.sum() == pytest.approx(1)


def test_halves_of_a_floor_whose_vertices_lie_within_edges_hang_together_by_contacts():
    """The contacts of a floor's faces were left out: its part did not hang together by edges and contacts."""
    (coarse, triangles), (fine, others), n = sheet(20, 1), sheet(20, 3), len(tree().faces)
    shape = shapes.together(tree(), shapes.Shape(coarse - (10, 0, 0), triangles),
                            shapes.Shape(fine + (10, 0, 0), others))
    found = decompose(shape.vertices, shape.faces)
    assert np.flatnonzero(found.parts().ground).tolist() == [found.parts().labels[n]]
    assert len(set(found.candidates[n:])) == 1
    across = found.contacts[(found.contacts >= n).all(axis=1)]
    assert ((across < n + len(triangles)).sum(axis=1) == 1).all()
    assert len(across) >= 3


def test_what_meets_across_a_gap_that_is_narrow_beside_its_floor_is_in_contact():
    """Contacts were those of the shape alone, for which the gap was wide, though the result had cuts across it."""
    lower = shapes.cylinder(2, 4, capped=False)
    upper, n = shapes.moved(shapes.subdivide(lower), (0, 0, 4.01)), len(lower.faces)
    rim = np.flatnonzero((upper.vertices[upper.faces][:, :, 2] == 4.01).sum(axis=1) == 2)
    contacts = decompose(*shapes.together(lower, upper, sheet(150))).contacts
    across = contacts[((contacts < n).sum(axis=1) == 1) & (contacts < n + len(upper.faces)).all(axis=1)]
    assert len(rim) == 8
    assert np.isin(n + rim, across).all()
    assert (contacts[:, 0] != contacts[:, 1]).all()


def test_with_pieces_separate_a_ground_is_a_piece_like_any_other():
    shape = shapes.together(tree(), sheet(40))
    found = decompose(*shape, Parameters(pieces=SEPARATE))
    assert not any("floor" in str(note) for note in found.notes)


def test_floor_and_wall_are_grounds():
    wall = shapes.Shape(sheet(30).vertices[:, [0, 2, 1]] + (0, 16, 15), sheet(30).faces)
    found = decompose(*shapes.together(tree(), sheet(30), wall))
    labels = found.parts().labels
    np.testing.assert_array_equal(found.candidates[:len(tree().faces)], decompose(*tree()).candidates)
    assert len(set(labels[-4:])) == 2
    assert set(np.flatnonzero(found.parts().ground)) == set(labels[-4:])
    assert "The rest is decomposed without 2 large plain pieces, such as a floor." in map(str, found.notes)


def test_what_a_part_is_made_of_hangs_together_where_grounds_are_linked_to_each_other():
    """The smaller ground is linked to the larger one, and joined what stands there first, far from it."""
    small, large = shapes.moved(sheet(30), (10, 0, -1)), shapes.moved(sheet(90), (0, 0, -2))
    found = decompose(*shapes.together(tree(), small, large))
    labels = found.parts(n_parts=2).labels
    assert len(set(labels[-4:])) == 2
    assert labels[0] == labels[-1] != labels[-3]
    pairs = found.candidate_pairs
    for n in range(1, found.n_candidates + 1):
        part = np.empty(found.n_candidates, np.int64)
        part[found.candidates] = found.parts(n_parts=n).labels
        assert components(len(part), *pairs[part[pairs[:, 0]] == part[pairs[:, 1]]].T)[0] == n


def test_things_on_a_floor_are_parts_of_their_own():
    things = [shapes.moved(tree(), (12 * k, 0, 0)) for k in range(3)]
    found = decompose(*shapes.together(*things, shapes.moved(sheet(90), (12, 0, 0))))
    thing = np.repeat([0, 1, 2, 3], [len(tree().faces)] * 3 + [2])
    labels = found.parts().labels
    for part in range(labels.max() + 1):
        assert len(set(thing[labels == part])) == 1


def test_hints_copies_and_halves_go_along():
    shape = shapes.together(tree(), sheet(40))
    n = len(tree().faces)
    hint = (tree().vertices[tree().faces].mean(axis=1)[:, 0] > 0.7).astype(int)
    alone = decompose(*tree(), hints=hint)
    assert (alone.candidates != decompose(*tree()).candidates).any()
    found = decompose(*shape, hints=np.append(hint, [0, 0]))
    np.testing.assert_array_equal(found.candidates[:n], alone.candidates)
    twice = decompose(shape.vertices, np.concatenate([shape.faces, shape.faces[n:, ::-1]]))
    np.testing.assert_array_equal(twice.candidates[:n], decompose(*tree()).candidates)
    assert len(set(twice.candidates[n:])) == 1
    assert type(found).from_bytes(found.to_bytes()).parts().labels.tolist() == found.parts().labels.tolist()


def test_what_is_no_ground():
    box = shapes.subdivide(shapes.box((1, 1, 1)))
    legs = [shapes.moved(shapes.box((0.3, 0.3, 3)), (x, y, -3)) for x in (-2, 2) for y in (-2, 2)]
    assert has_ground(sheet(6), box)
    assert not has_ground(sheet(6, 2))
    assert not has_ground(sheet(1.5), box)  # no wider than what stands on it
    assert not has_ground(sheet(6), shapes.moved(shapes.box((1, 1, 0.05)), (0, 0, 0.01)))  # a relief
    assert not has_ground(sheet(6), box, *legs)  # a table and what is on it
    assert not has_ground(sheet(6, 3), shapes.box((1, 1, 1)), shapes.moved(shapes.box((1, 1, 1)), (0, 0, -1)))
    assert not has_ground(sheet(6, depth=1), box)  # as few faces have both
    assert not has_ground(sheet(1e6), box)


def test_what_is_no_relief():
    """Its things lie on both sides, or flat, it is no larger than they are, or it goes round them."""
    box = shapes.subdivide(shapes.box((1, 1, 1)))
    assert has_ground(hills(6), box)
    assert has_ground(shapes.inside_out(hills(6)), box)
    assert not has_ground(hills(6), box, shapes.moved(box, (0, 0, -3)))
    assert not has_ground(hills(6), shapes.moved(shapes.box((1, 1, 0.02)), (0, 0, 0.01)))
    assert not has_ground(hills(1.5), box)
    vertices, faces = shapes.cylinder(12, 24, 5.0, 12.0)
    middle = vertices[faces].mean(axis=1)
    for share, found in ((0.2, True), (0.7, False)):  # of a turn
        round_it = (np.abs(np.arctan2(middle[:, 1], middle[:, 0])) < share * np.pi) & (middle[:, 2] % 12 > 0)
        assert has_ground(shapes.Shape(vertices, faces[round_it]), shapes.moved(box, (3.0, -0.5, 6.0))) == found, share


def test_what_is_no_shell():
    """A ruler came apart into its 692 marks."""
    inside = shapes.moved(tree(), -tree().vertices.mean(axis=0))
    around = 1.5 * np.abs(inside.vertices).max()
    ball = shapes.icosphere(2, around)
    assert has_ground(ball, inside)
    assert has_ground(shapes.inside_out(ball), inside)
    assert not has_ground(shapes.Shape(ball.vertices, ball.faces[: len(ball.faces) // 2]), inside)  # open
    assert not has_ground(ball, shapes.moved(inside, (0.5 * around, 0, 0)))  # looks out of it
    assert not has_ground(shapes.icosphere(4, around), shapes.subdivide(inside))  # of many faces
    assert not has_ground(ball, shapes.icosphere(3, 0.9 * around))  # a hollow ball
    body = shapes.box((30, 3, 1))
    marks = [shapes.moved(shapes.box((0.05, 1, 0.01)), (k, 0.1, 0.985)) for k in range(1, 30)]
    assert not has_ground(body, *marks)
    tower = column(12, 0)
    assert not has_ground(shapes.moved(shapes.box((4, 4, 3)), (-1.5, -1.5, -3)), tower)  # no slab, and it is less high


def test_what_is_sunk_into_a_slab_stands_on_it():
    """Higher than the slab is wide; a twelfth of its area is below the middle of the slab, but none below the slab."""
    assert has_ground(sheet(6, depth=1), column(10, -0.9))
    assert not has_ground(sheet(6, depth=1), column(10, -5))


def test_a_half_model_on_half_a_ground():
    column = shapes.lathe([0.01, 1, 1, 0.3, 0.3, 1, 1, 0.01], [0, 0.01, 1, 1.5, 2.5, 3, 4, 4.01], 12)
    shape = shapes.together(column, sheet(30, 2))
    assert (np.abs(shape.vertices[:, 0]) < 1e-9).sum() > 16
    kept = shape.vertices[shape.faces][..., 0].min(axis=1) > -1e-9
    whole = decompose(*shape).parts()
    found = decompose(shape.vertices, shape.faces[kept], mirror=(1, 0, 0, 0)).parts()
    assert found.count == whole.count >= 3
    assert len(set(found.labels[-4:])) == 1

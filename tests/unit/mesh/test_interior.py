# SPDX-License-Identifier: GPL-3.0-or-later
"""Interior faces: what closes the halves of a symmetric solid in its plane of symmetry does not part them."""

import numpy as np
import pytest
import shapes

from core import decompose
from core.mesh.copies import INTERIOR, find_copies
from core.mesh.polygons import PolygonMesh

RNG = np.random.default_rng(5)
PLANE = np.array([1.0, 0.0, 0.0, 0.0])


SOLID = np.zeros((12, 8, 7), bool)
SOLID[6:, :, 6] = SOLID[11, [[0], [7]]] = True
WHOLE, HALF = shapes.table_of_blocks(), shapes.blocks(SOLID)  # one side of the table is closed in the plane x = 0
N_CAPS = 8  # by so many quads


def is_cap(vertices, faces):
    return (np.abs(vertices[faces][:, :, 0]) < 1e-9).all(axis=1)


def halves(welded, caps):
    """Both halves, so many of them closed, joined in the plane or each with its own vertices there."""
    vertices, quads = HALF
    outer, cap = quads[~is_cap(*HALF)], quads[is_cap(*HALF)]
    both, n = np.concatenate([vertices, vertices * (-1, 1, 1)]), len(vertices)
    faces = np.concatenate([outer, outer[:, ::-1] + n, cap, *[cap[:, ::-1] + n] * (caps == 2)])
    if welded:
        both, index = np.unique(both + 0.0, axis=0, return_inverse=True)
        faces = index.reshape(-1)[faces]
    return both, faces


CASES = pytest.mark.parametrize(("welded", "caps"), [(True, 1), (True, 2), (False, 2)])


def interior(vertices, faces, plane=None):
    """Which polygons are interior; none, if no copies are found or these are others."""
    copies = find_copies(PolygonMesh.of(vertices, faces), plane)
    return copies.is_copy if copies is not None and copies.kind == INTERIOR else np.zeros(len(faces), bool)


@CASES
def test_halves_that_are_closed_have_the_parts_of_open_ones(welded, caps):
    """Each half came as a body of its own, cut in parts of its own."""
    vertices, faces = halves(welded, caps)
    outer = ~is_cap(vertices, faces)
    result, opened = decompose(vertices, faces), decompose(vertices, faces[outer])
    for count in (1, 3, 5):
        labels = result.parts(n_parts=count).labels
        assert labels.max() + 1 == count
        assert (labels[outer] == opened.parts(n_parts=count).labels).all()
    assert np.bincount(result.parts().labels).min() > 20  # the top, and four legs
    assert result.parts().count == decompose(*WHOLE).parts().count == 5
    assert result.notes[-1].startswith(f"{N_CAPS * caps} faces lie within the solid")
    assert not any("border edge" in note or "non-manifold" in note for note in result.notes)
    assert (result.face_twin[outer] >= 0).all()
    assert (result.face_twin[~outer] == -1).all()
    assert np.isfinite(result.field).all()


def test_a_polygon_without_a_triangle_is_not_interior():
    vertices, quads = halves(welded=True, caps=1)
    triangles = shapes.split_quads(quads)
    given = PolygonMesh.of(vertices, triangles, np.repeat(np.arange(len(quads)) + 1, 2))
    assert (find_copies(given).is_copy == np.append(False, is_cap(vertices, quads))).all()


@CASES
@pytest.mark.parametrize("change", [
    lambda v, f: (v, f[:, ::-1]), lambda v, f: (v[f].reshape(-1, 3), np.arange(f.size).reshape(f.shape)),
    lambda v, f: (2.0**-9 * v, f), lambda v, f: (v @ shapes.rotation(RNG).T + 40.0, f),
    lambda v, f: (v.astype(np.float32), f)], ids=["inside out", "unjoined", "small", "moved", "float32"])
def test_they_are_found_whatever_way_the_mesh_is_stored(welded, caps, change):
    mesh = halves(welded, caps)
    assert (interior(*change(*mesh)) == is_cap(*mesh)).all()


@CASES
def test_the_order_of_the_mesh_does_not_tell(welded, caps):
    vertices, faces = halves(welded, caps)
    order, place = RNG.permutation(len(faces)), RNG.permutation(len(vertices))
    mixed = np.empty_like(vertices)
    mixed[place] = vertices
    assert (interior(mixed, place[faces][order]) == is_cap(vertices, faces)[order]).all()


def test_a_half_model_that_is_closed_has_the_parts_of_an_open_one():
    """With a Mirror modifier each half was a body: the table had half as many parts."""
    vertices, quads = HALF
    outer = ~is_cap(*HALF)
    closed, opened = decompose(vertices, quads, mirror=PLANE), decompose(vertices, quads[outer], mirror=PLANE)
    for count in (1, 2, 3):
        assert (closed.parts(n_parts=count).labels[outer] == opened.parts(n_parts=count).labels).all()
    assert [note for note in closed.notes if "border" in note] == []
    assert (interior(vertices, quads, PLANE) == ~outer).all()
    assert not interior(vertices, quads).any()  # alone it is closed by them


def test_an_interior_face_has_the_part_of_its_own_half():
    """Two legs that touch in the plane are two parts, and each keeps what closes it there."""
    half = np.zeros((16, 4, 14), bool)
    half[8:10, :, :12] = half[8:, :, 11] = True
    vertices, quads = shapes.blocks(half)
    n, cap = len(vertices), is_cap(vertices, quads)
    both = np.concatenate([vertices, vertices * (-1, 1, 1)])
    faces = np.concatenate([quads, quads[:, ::-1] + n])
    copies = find_copies(PolygonMesh.of(both, faces))
    assert (copies.is_copy == np.tile(cap, 2)).all()
    nearest = copies.polygon[copies.original]
    assert (nearest // len(quads) == np.arange(2 * len(quads)) // len(quads)).all()


def test_what_closes_no_solid_is_not_interior():
    """A net in a ring, and a fin in the plane of symmetry, have air on both sides."""
    ring = shapes.torus(48, 16)
    in_plane = np.flatnonzero((np.abs(ring.vertices[:, 2]) < 1e-9)
                              & (np.linalg.norm(ring.vertices[:, :2], axis=1) < 1))
    angle = np.arctan2(*ring.vertices[in_plane, :2].T)
    rim = in_plane[np.argsort(angle)]
    net = np.stack([rim, np.roll(rim, -1), np.full(len(rim), len(ring.vertices))], axis=1)
    vertices = np.append(ring.vertices, np.zeros((1, 3)), axis=0)
    assert len(rim) == 48
    assert not interior(vertices, np.concatenate([ring.faces, net])).any()
    figure = shapes.mirrored_figure()
    top = np.flatnonzero(figure.vertices[:, 0] == 0)
    top = top[np.argsort(-figure.vertices[top, 2])[:2]]
    fin = [[top[0], top[1], len(figure.vertices)]]
    vertices = np.append(figure.vertices, [[0.0, 0.0, 4.0]], axis=0)
    assert not interior(vertices, np.concatenate([figure.faces, fin])).any()


def test_boards_that_touch_stay_boards():
    board = shapes.box_quads((1.0, 3.0, 2.0))
    vertices = np.concatenate([board[0] - board[0].min(axis=0), (board[0] - board[0].min(axis=0)) * (-1, 1, 1)])
    faces = np.concatenate([board[1], board[1][:, ::-1] + len(board[0])])
    assert not interior(vertices, faces).any()


def test_a_wall_that_no_plane_of_symmetry_has_stays():
    vertices, quads = halves(welded=True, caps=1)
    assert not interior(vertices * np.where(vertices > 0, 1.5, 1.0), quads).any()


def test_a_pair_in_a_scene_of_others_stays():
    """What is a small share of the mesh may be two things that touch, as the wings of a door."""
    vertices, quads = halves(welded=False, caps=2)
    large = shapes.blocks(np.ones((30, 30, 30), bool))
    far = large[0] + (0.0, 60.0, 0.0)
    assert not interior(np.concatenate([vertices, far]), np.concatenate([quads, large[1] + len(vertices)])).any()

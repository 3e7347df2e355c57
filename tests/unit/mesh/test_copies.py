# SPDX-License-Identifier: GPL-3.0-or-later
"""Faces that lie on others with the same corners are left out, and have the parts of these."""

import numpy as np
import pytest
import shapes

from core import Parameters, decompose
from core.mesh.copies import Copies, find_copies
from core.mesh.polygons import PolygonMesh
from core.surface.orientation import without_copies

RNG = np.random.default_rng(0)
TREE = shapes.tube_tree()
BLOCKS = shapes.together(shapes.box((3.0, 1.0, 1.0)), shapes.moved(shapes.box((0.4, 0.4, 3.0)), (0.3, 0.3, 1.0)))


def same(faces):
    """The faces once more, each from the other side and beginning with another corner."""
    return np.roll(faces[:, ::-1], 1, axis=1)


SHAPES = {"triangles": TREE, "quads": shapes.box_quads(), "pieces": BLOCKS, "figure": shapes.mirrored_figure()}


@pytest.mark.parametrize("own_vertices", [False, True])
@pytest.mark.parametrize("name", SHAPES)
def test_a_mesh_with_every_face_twice_has_the_parts_of_the_mesh(name, own_vertices):
    """Three faces met at every edge: a man came in nine parts instead of ten, his head with the trunk."""
    vertices, faces = SHAPES[name]
    once = decompose(vertices, faces)
    copies, points = same(faces), vertices
    if own_vertices:
        copies, points = copies + len(vertices), np.concatenate([vertices, vertices])
    order = RNG.permutation(2 * len(faces))
    twice = decompose(points, np.concatenate([faces, copies])[order])
    assert twice.n_candidates == once.n_candidates
    for count in range(1, min(once.n_candidates, 30) + 1):
        labels = np.empty(2 * len(faces), np.int64)
        labels[order] = twice.parts(n_parts=count).labels
        expected = once.parts(n_parts=count).labels
        assert (labels[:len(faces)] == labels[len(faces):]).all()
        assert len(np.unique(np.stack([expected, labels[:len(faces)]], axis=1), axis=0)) == count
    assert twice.candidate_area.sum() == pytest.approx(2 * once.candidate_area.sum())
    assert (twice.vertex_candidates >= 0).all() == (once.vertex_candidates >= 0).all()
    assert np.isfinite(twice.field).all()
    assert twice.notes[-1] == f"{len(faces)} faces lie on another one with the same corners, and have its part."


def test_the_image_of_a_copy_is_a_copy_of_the_image():
    vertices, faces = shapes.mirrored_figure()
    once = decompose(vertices, faces).face_twin
    twice = decompose(vertices, np.concatenate([faces, same(faces)])).face_twin
    assert (twice == np.concatenate([once, np.where(once >= 0, once + len(faces), -1)])).all()


def test_where_the_image_has_no_copy_that_of_a_copy_is_the_image():
    """Polygons 0 and 1 are images of each other, 2 has none, and 3 and 4 are copies of 0."""
    copies = Copies(np.arange(3), np.array([0, 1, 2, 0, 0]), np.arange(3), np.arange(3), np.zeros(5, bool))
    assert copies.images(np.array([1, 0, -1])).tolist() == [1, 0, -1, 1, 1]
    assert copies.n_copies == 2


def test_a_wall_that_two_solids_have_in_common_stays_in_both():
    """Each would be open without it."""
    block = shapes.box((1.0, 1.0, 1.0))
    assert find_copies(PolygonMesh.of(*shapes.together(block, shapes.moved(block, (1.0, 0.0, 0.0))))) is None


@pytest.mark.parametrize(("share", "found"), [(0.8, False), (0.84, True)])
def test_a_piece_of_which_most_is_there_twice_loses_its_copies(share, found):
    """With copies, 8 of 9 parts of the area are there twice, or 42 of 46; of less than nine tenths these are walls."""
    vertices, faces = shapes.icosphere(2)
    twice = faces[: round(share * len(faces))]
    assert (find_copies(PolygonMesh.of(vertices, np.concatenate([faces, twice]))) is not None) == found


def test_of_two_pieces_one_may_have_every_face_twice():
    vertices, faces = shapes.together(shapes.icosphere(2), shapes.moved(shapes.icosphere(1), (5.0, 0.0, 0.0)))
    sphere = faces[:320]
    copies = find_copies(PolygonMesh.of(vertices, np.concatenate([same(sphere), faces])))
    assert copies.polygon.tolist() == [*range(320), *range(640, 720)]
    assert copies.original.tolist() == [*range(320), *range(400)]


def test_a_half_model_with_every_face_twice():
    vertices, faces = shapes.mirrored_figure()
    half = faces[(vertices[faces][:, :, 0] >= -1e-9).all(axis=1)]
    once = decompose(vertices, half, mirror=(1, 0, 0, 0)).parts().labels
    twice = decompose(vertices, np.concatenate([half, same(half)]), mirror=(1, 0, 0, 0)).parts().labels
    assert (twice[:len(half)] == once).all()
    assert (twice[len(half):] == once).all()


def test_which_side_comes_first_does_not_count():
    """Of open clothes that had both sides, it was random in a shuffled file which faces looked inwards."""
    vertices, faces = shapes.mirrored_figure()
    half = faces[(vertices[faces][:, :, 0] >= -1e-9).all(axis=1)]
    both, found = np.concatenate([half, same(half)]), []
    for _ in range(4):
        order = RNG.permutation(len(both))
        result = decompose(vertices, both[order])
        assert not any("inwards" in note for note in map(str, result.notes))
        labels = np.empty(len(both), np.int64)
        labels[order] = result.candidates
        found.append(np.unique(labels, return_inverse=True)[1])
    for one in found[1:]:
        assert len(np.unique(np.stack([found[0], one], axis=1), axis=0)) == found[0].max() + 1 == one.max() + 1


def test_what_is_there_twice_from_one_side_keeps_that_side():
    """As where a duplicate was joined to its original: of open clothes the side was chosen as if there were both."""
    vertices, faces = shapes.half_of(shapes.mirrored_figure())
    inwards = np.asarray(faces)[:, ::-1]
    given = PolygonMesh.of(vertices, np.concatenate([inwards, np.roll(inwards, 1, axis=1)]))
    assert (without_copies(given, find_copies(given)).triangles.faces == inwards).all()


def test_copies_have_the_hints_of_what_they_lie_on():
    vertices, faces = TREE
    hints = (vertices[faces].mean(axis=1)[:, 2] > 0.5).astype(int)
    once = decompose(vertices, faces, hints=hints).parts().labels
    both = decompose(vertices, np.concatenate([faces, same(faces)]), hints=np.append(hints, 0 * hints)).parts().labels
    assert (both == np.append(once, once)).all()


@pytest.mark.parametrize("shape", [TREE, shapes.box_quads(), shapes.flat_grid(4, 4)])
def test_a_mesh_without_copies_has_none(shape):
    assert find_copies(PolygonMesh.of(*shape)) is None


def test_two_folded_faces_without_an_area_are_no_copies_of_each_other():
    vertices, faces = TREE
    folded = np.array([(0, 1, 0), (5, 6, 5), (5, 6, 5)])
    assert find_copies(PolygonMesh.of(vertices, np.concatenate([faces, folded]))) is None


def test_beside_faces_that_are_all_there_twice_folded_ones_are_no_copies_of_each_other_either():
    vertices, faces = TREE
    folded = np.array([(0, 1, 0), (5, 6, 5), (5, 6, 5)])
    copies = find_copies(PolygonMesh.of(vertices, np.concatenate([faces, same(faces), folded])))
    assert copies.polygon.tolist() == [*range(len(faces)), *range(2 * len(faces), 2 * len(faces) + 3)]


def test_however_a_polygon_is_cut_into_triangles_it_is_the_same_one():
    vertices, quads = shapes.box_quads()
    one = np.concatenate([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]])
    other = np.concatenate([quads[:, [1, 2, 3]], quads[:, [3, 0, 1]]])
    number = np.tile(np.arange(len(quads)), 2)
    given = PolygonMesh.of(vertices, np.concatenate([one, other]), np.concatenate([number, number + len(quads)]))
    copies = find_copies(given)
    assert copies.polygon.tolist() == list(range(len(quads)))
    assert copies.original.tolist() == 2 * list(range(len(quads)))


def test_so_few_faces_that_none_may_be_left_out_stay():
    vertices, faces = shapes.box((1.0, 1.0, 1.0))
    for count, found in ((3, False), (4, True)):
        some = np.concatenate([faces[:count], same(faces[:count])])
        assert (find_copies(PolygonMesh.of(vertices, some)) is not None) == found
    assert len(decompose(vertices, np.concatenate([faces[:3], same(faces[:3])]), Parameters()).candidates) == 6


def test_a_polygon_that_also_comes_elsewhere_is_no_copy():
    """Two triangles that are folded onto each other have no outline, and their corners are those of nothing else."""
    vertices = np.concatenate([shapes.octahedron().vertices, np.eye(3) + 5])
    faces = shapes.octahedron().faces
    folded = np.array([[6, 7, 8], [8, 7, 6]])
    polygon = np.concatenate([np.arange(16), [15, 15]])
    result = decompose(vertices, np.concatenate([faces, same(faces), folded]), polygon=polygon)
    assert len(result.candidates) == 16
    assert ((result.field >= 0) & (result.field <= 1)).all()
    assert (result.vertex_candidates >= 0).all()
    assert result.notes[-1].startswith("7 faces lie on another one")


def test_a_vertex_of_a_copy_has_the_candidate_of_its_own_face():
    """Where every face has vertices of its own, those of copies had the candidates of others that meet there."""
    shape = shapes.tube_tree(2, 0.4)
    result = decompose(*shapes.unjoined(shapes.together(shape, shapes.inside_out(shape))))
    np.testing.assert_array_equal(result.vertex_candidates, np.repeat(result.candidates, 3))

# SPDX-License-Identifier: GPL-3.0-or-later
"""What pairs of parts look like: finite on any mesh, and the same wherever and however the mesh lies."""

from types import SimpleNamespace

import numpy as np
import pytest
import shapes

from core import TriMesh
from core.cuts.joining import pairs
from core.cuts.joining.pairs import FEATURES, MOST_NEAR, part_pairs, unseen_neighbors


def measured(shape, label=None):
    mesh = TriMesh(*shape)
    label = mesh.face_components[1] if label is None else label
    agd = np.linalg.norm(mesh.vertices - mesh.vertices.mean(axis=0), axis=1)
    return part_pairs(mesh, label, lambda a, b: np.ones(len(a)), agd / max(agd.max(), 1e-300))


def furniture():
    """Three stones of different sizes that touch, the last cut into two parts."""
    stone = shapes.icosphere(3)
    parts = [shapes.Shape(stone.vertices * size + at, stone.faces) for size, at in (
        ((2, 1, 0.6), (0, 0, 0)), ((0.3, 0.45, 1), (-1, 0.1, -1.45)), ((0.5, 0.7, 0.9), (0.8, 0.1, 1.4)))]
    shape = shapes.together(*parts)
    label = np.repeat([0, 1, 2], [len(s.faces) for s in parts])
    label[(label == 2) & (shape.vertices[shape.faces].mean(axis=1)[:, 2] > 1.7)] = 3
    return shape, label


@pytest.mark.parametrize("make", [
    shapes.two_spheres, lambda: shapes.crumbs(60), lambda: shapes.together(shapes.box((1, 1, 1e-9)), shapes.box()),
    lambda: shapes.together(shapes.tetrahedron(), shapes.tetrahedron()), lambda: furniture()[0],
    lambda: shapes.together(shapes.icosphere(2), shapes.moved(shapes.icosphere(1, 1e-6), (1, 0, 0)))])
def test_finite_on_awkward_meshes(make):
    found = measured(make())
    assert found.features.shape == (len(found.parts), len(FEATURES))
    assert np.isfinite(found.features).all()
    assert (found.parts[:, 0] < found.parts[:, 1]).all()
    assert found.shapes.area.sum() == pytest.approx(1)


def test_who_is_near_whom():
    found = measured(*furniture())
    assert found.parts.tolist() == [[0, 1], [0, 2], [2, 3]]
    assert found.same_piece.tolist() == [False, False, True]
    assert (found.gap >= 0).all()


def test_how_much_of_a_part_is_near_the_other_and_elsewhere_near_any_other():
    """Of the stones the first touches two others, the last part a single one."""
    found = measured(*furniture())
    column = dict(zip(FEATURES, found.features.T, strict=True))
    for side in ("small", "large"):
        near = np.stack([column[f"near_{side}_{k}"] for k in (1, 2, 3)])
        assert (np.diff(near, axis=0, prepend=0) >= 0).all()
        assert (near[2] > near[1]).all()
        assert (near <= 1).all()
        np.testing.assert_allclose(column[f"elsewhere_{side}"], column[f"{side}_touched"] - near[1], atol=1e-12)
    of_first = np.flatnonzero((found.parts == 0).any(axis=1))
    assert column["elsewhere_large"][of_first] == pytest.approx(column["near_large_2"][of_first[::-1]])
    assert column["elsewhere_small"][found.parts.tolist().index([2, 3])] == pytest.approx(0.0)


def test_how_parts_differ_does_not_depend_on_which_is_first():
    found = measured(*furniture())
    column = dict(zip(FEATURES, found.features.T, strict=True))
    area, agd, center = (value[found.parts] for value in (found.shapes.area, found.shapes.agd, found.shapes.center))
    np.testing.assert_allclose(column["log_ratio"], np.log(area.max(axis=1) / area.min(axis=1)), rtol=1e-12)
    np.testing.assert_allclose(column["agd_change"], np.abs(agd[:, 0] - agd[:, 1]), rtol=1e-12)
    np.testing.assert_allclose(column["distance"], np.linalg.norm(center[:, 0] - center[:, 1], axis=1), rtol=1e-12)


def test_the_place_where_two_parts_touch_by_hand():
    """Two points of areas 1 and 3 are within 0.012 of the other part, the second just so; a third one is not."""
    along = np.array([0.0, 0.4, 9.0, 0.0])
    points = SimpleNamespace(position=along[:, None] * [1.0, 0.0, 0.0], area=np.array([1.0, 3.0, 7.0, 1.0]))
    near = SimpleNamespace(points=points, parts=np.array([[0, 1]]), row=np.zeros(3, int),
                           ends=np.array([[0, 3], [1, 3], [2, 3]]), distance=np.array([0.0, 0.012, 0.0121]))
    normal = np.array([(0.0, 0.0, 1.0), (0.0, 1.0, 0.0), (0.0, 0.0, -1.0), (0.0, 0.6, 0.8)])
    found = pairs._contact_columns(near, normal, np.array([0.2, 0.6, 1.0, 0.0]), np.zeros(1), np.array([0.25]))
    spread = np.sqrt((1 * 0.3**2 + 3 * 0.1**2) / 4)
    expected = {"normals": (1 * 0.8 + 3 * 0.6) / 4, "contact_spread": spread, "contact_extent": 2 * spread,
                "height": (1 * 0.2 + 3 * 0.6) / 4}
    assert {name: value.item() for name, value in found.items()} == pytest.approx(expected, rel=1e-12)


def test_every_two_parts_that_share_an_edge_are_seen_or_unseen_neighbors():
    shape, label = furniture()
    mesh = TriMesh(*shape)
    at_edge = np.unique(np.sort(label[mesh.edges.pairs], axis=1), axis=0)
    at_edge = at_edge[at_edge[:, 0] != at_edge[:, 1]]
    found, faces = unseen_neighbors(mesh, label, np.empty((0, 2), np.int64))
    assert found.tolist() == at_edge.tolist() == [[2, 3]]
    assert np.sort(label[faces], axis=1).tolist() == found.tolist()
    assert len(set(mesh.faces[faces[0, 0]]) & set(mesh.faces[faces[0, 1]])) == 2
    assert not len(unseen_neighbors(mesh, label, found)[0])


def test_scale_and_place_change_nothing():
    shape, label = furniture()
    one = measured(shape, label)
    for vertices, tolerance in ((2.0**-10 * shape.vertices, 1e-9), (1e-3 * (shape.vertices + (5, -3, 2)), 1e-3)):
        two = measured((vertices, shape.faces), label)
        np.testing.assert_array_equal(one.parts, two.parts)
        np.testing.assert_allclose(one.features, two.features, atol=tolerance)


def test_pose_and_order_of_faces_change_little():
    shape, label = furniture()
    rng = np.random.default_rng(0)
    one = measured(shape, label)
    turned = measured((shape.vertices @ shapes.rotation(rng).T, shape.faces), label)
    face = rng.permutation(len(label))
    shuffled = measured((shape.vertices, shape.faces[face]), label[face])
    for other in (turned, shuffled):
        np.testing.assert_array_equal(one.parts, other.parts)
        np.testing.assert_allclose(one.features, other.features, rtol=0.05, atol=0.1)


def grains(place):
    """Small tetrahedra at some places, (k, 3)."""
    one = shapes.tetrahedron()
    return shapes.together(*(shapes.Shape(1e-5 * one.vertices + at, one.faces) for at in place))


POINT = shapes.together(
    shapes.icosphere(2), shapes.moved(shapes.icosphere(1, 0.02), (1.01, 0.1, 0.0)),
    shapes.Shape(np.tile((1.03, 0.11, 0.005), (4, 1)), shapes.tetrahedron().faces))


@pytest.mark.parametrize("stone", [shapes.cylinder(8, 24), shapes.icosphere(2), POINT], ids=["round", "ball", "point"])
def test_a_solid_of_revolution_has_no_axes_that_rounding_chooses(stone):
    """Which of all directions around it were its principal axes depended on the pose, and on NumPy's version."""
    shape = shapes.together(stone, shapes.moved(shapes.icosphere(1, 0.2), (0.85, 0.5, 0.2)))
    one = measured(shape)
    inside = [FEATURES.index(name) for name in ("inside_small", "inside_large")]
    rng = np.random.default_rng(0)
    for _ in range(4):
        two = measured((shape.vertices @ shapes.rotation(rng).T, shape.faces))
        assert two.parts.tolist() == one.parts.tolist() != []
        np.testing.assert_allclose(two.features[:, inside], one.features[:, inside], rtol=1e-9)


def test_of_a_crowd_each_is_compared_with_those_that_are_nearest():
    """A pair is left out where both have so many others that are nearer."""
    rng = np.random.default_rng(0)
    # Far off is one that makes the whole so large that all others are near each other.
    place = np.concatenate([rng.normal(size=(150, 3)) * 0.001, [(1, 0, 0)]])
    crowd = measured(grains(place))
    assert np.bincount(crowd.parts.ravel(), minlength=151)[:150].min() >= MOST_NEAR
    assert len(crowd.parts) <= MOST_NEAR * len(place) < 150 * 149 / 2
    kept = set(map(tuple, crowd.parts.tolist()))
    for part in range(150):
        apart = np.linalg.norm(place[:150] - place[part], axis=1)
        nearest = np.argsort(apart)[1:MOST_NEAR // 2]  # by their middles
        assert all((min(part, other), max(part, other)) in kept for other in nearest.tolist())


def test_all_that_are_equally_near_are_compared():
    assert len(measured(grains(np.zeros((100, 3)))).parts) == 100 * 99 / 2


def test_however_many_are_equally_near_pairs_are_bounded(monkeypatch):
    monkeypatch.setattr(pairs, "MOST_PAIRS", 2_000)
    crowd = measured(grains(np.zeros((100, 3))))
    assert np.bincount(crowd.parts.ravel(), minlength=100).min() >= 20
    assert len(crowd.parts) <= 2_000

# SPDX-License-Identifier: GPL-3.0-or-later
"""Descriptors of parts: invariant, worked out by hand where that is possible, alike for parts of one kind."""

from dataclasses import replace

import numpy as np
import pytest
import shapes

from core import Hierarchy, MeshError, ParameterError, Parameters, decompose
from core.mesh.triangles import TriMesh
from core.uses.descriptors import NAMES, SCALE, _Surface, distances, part_descriptors


@pytest.fixture(scope="module")
def tree():
    """A body with four arms of two lengths, and its parts."""
    shape = shapes.tube_tree(step=0.15)
    return shape, decompose(*shape).parts()


def column(descriptors, name):
    return descriptors[:, NAMES.index(name)]


def test_there_is_a_scale_for_each_column():
    assert SCALE.shape == (len(NAMES),)
    assert (SCALE > 0).all()


def test_they_do_not_depend_on_place_size_and_order(tree):
    shape, parts = tree
    expected = part_descriptors(*shape, parts)
    assert expected.shape == (parts.count, len(NAMES))
    rng = np.random.default_rng(0)
    turn = shapes.rotation(rng)
    turned = 7.0 * shape.vertices @ turn.T + 3.0
    moved = decompose(turned, shape.faces).parts()
    assert np.allclose(part_descriptors(turned, shape.faces, moved), expected, atol=1e-4)
    other, _, face = shapes.shuffled(shape, rng)
    mixed = decompose(*other).parts()
    to = [int(np.bincount(mixed.labels[parts.labels[face] == part]).argmax()) for part in range(parts.count)]
    assert np.allclose(part_descriptors(*other, mixed)[to], expected, atol=1e-9)


def test_what_can_be_counted_is_right(tree):
    shape, parts = tree
    found = part_descriptors(*shape, parts)
    assert np.exp(column(found, "log_share")) == pytest.approx(parts.share)
    beside = np.bincount(parts.cuts.ravel(), minlength=parts.count)
    assert np.expm1(column(found, "n_neighbors")) == pytest.approx(beside)
    assert np.expm1(column(found, "n_leaves")).sum() == pytest.approx((parts.decomposition.graph.node_kind == 2).sum())
    assert np.expm1(column(found, "n_arcs")).sum() == pytest.approx(parts.decomposition.graph.n_arcs)
    assert column(found, "hops")[0] == 0
    cuts = column(found, "cut_length") * np.sqrt(parts.area)
    assert cuts.sum() == pytest.approx(2 * parts.cut_length.sum())


def test_parts_of_another_mesh_are_refused(tree):
    """They were described as if its faces were those of the parts, wherever it had fewer."""
    shape, parts = tree
    with pytest.raises(MeshError, match="of another mesh"):
        part_descriptors(shape.vertices, shape.faces[:-1], parts)
    with pytest.raises(MeshError, match="of another mesh"):
        part_descriptors(np.concatenate([shape.vertices, shape.vertices[:1]]), shape.faces, parts)
    grid = shapes.icosphere(2)
    pairs = np.arange(len(grid.faces)) // 2
    of_polygons = decompose(*grid, polygon=pairs).parts()
    assert len(part_descriptors(*grid, of_polygons, pairs)) == of_polygons.count
    with pytest.raises(MeshError, match="of another mesh"):
        part_descriptors(*grid, of_polygons)


def test_faces_that_are_there_twice_are_measured_once(tree):
    """Radii and cuts were in units of the root of an area that counted them twice."""
    shape, _ = tree
    ball = shapes.moved(shapes.icosphere(2), (9.0, 0.0, 0.0))
    vertices, faces = shapes.together(shape, ball)
    once = decompose(vertices, faces).parts()
    turned = shape.faces[:, ::-1]
    twice = decompose(vertices, np.concatenate([turned, faces])).parts()
    expected = part_descriptors(vertices, faces, once)
    to = [int(once.labels[(twice.labels == part)[len(turned):]][0]) for part in range(twice.count)]
    found = part_descriptors(vertices, np.concatenate([turned, faces]), twice)
    np.testing.assert_allclose(found, expected[to], rtol=1e-9, atol=1e-9)


def test_a_part_of_copies_alone_is_described_with_them():
    """As one that was made by hand, of the faces of one side."""
    ball = shapes.icosphere(2)
    vertices, faces = ball.vertices, np.concatenate([ball.faces, ball.faces[:, ::-1]])
    result = decompose(vertices, faces)
    sides = replace(
        result, candidates=np.repeat([0, 1], len(ball.faces)), candidate_area=np.ones(2),
        node_candidate=np.zeros(1, np.int64), candidate_pairs=np.empty((0, 2), np.int64),
        candidate_pair_length=np.empty(0), hierarchy=Hierarchy.of(2, [], []))
    one, other = part_descriptors(vertices, faces, sides.group([0, 1]))
    assert column(np.stack([one, other]), "log_length") == pytest.approx(np.full(2, np.log(np.sqrt(1 / 3 / 4 / np.pi))),
                                                                         abs=0.02)


def test_what_stands_on_a_floor_is_described_as_without_it(tree):
    """Shares and lengths were measured by the floor, and cuts were counted from it."""
    shape, parts = tree
    floor = shapes.moved(shapes.box((60, 60, 1)), (-30, -30, shape.vertices[:, 2].min() - 1))
    both = shapes.together(shape, floor)
    on_floor = decompose(*both).parts()
    assert on_floor.count == parts.count + 1
    ground = on_floor.labels[-1]
    first = np.unique(parts.labels, return_index=True)[1]
    to = on_floor.labels[first]
    found = part_descriptors(*both, on_floor)
    np.testing.assert_allclose(found[to], part_descriptors(*shape, parts), rtol=1e-9, atol=1e-9)
    row = dict(zip(NAMES, found[ground], strict=True))
    assert np.exp(row["log_share"]) == pytest.approx(on_floor.area[ground] / parts.area.sum())
    assert [row[name] for name in ("n_neighbors", "cut_length", "hops")] == [0] * 3


def test_a_ball_alone_is_what_it_is():
    ball = shapes.icosphere(3)
    parts = decompose(*ball, Parameters(n_parts=1)).parts()
    (found,) = part_descriptors(*ball, parts)
    row = dict(zip(NAMES, found, strict=True))
    spread = np.log(np.sqrt(1 / 3) / np.sqrt(4 * np.pi))  # second moment of a sphere along any axis
    assert [row[name] for name in ("log_length", "log_width", "log_height")] == pytest.approx([spread] * 3, abs=0.02)
    alone = ("log_share", "cut_length", "n_neighbors", "depth_100", "hops", "has_twin")
    assert [row[name] for name in alone] == [0] * 6
    # Two points of a sphere are farther apart than sqrt(2) of its radius half of the time.
    assert row["apart_50"] == pytest.approx(np.sqrt(2) / np.sqrt(4 * np.pi), abs=0.02)


def test_a_ball_apart_has_no_cuts_and_no_contours(tree):
    """So nothing in it is deep, whatever other parts are; its radius is that of a ball of its area."""
    shape = shapes.together(tree[0], shapes.moved(shapes.icosphere(3, 0.3), (50, 0, 0)))
    parts = decompose(*shape).parts()
    found, ball = part_descriptors(*shape, parts), int(parts.labels[-1])
    assert (parts.labels == ball).sum() == len(shapes.icosphere(3).faces)
    assert np.isfinite(found).all()
    assert ((column(found, "depth_100") == 0) == (np.arange(parts.count) == ball)).all()
    assert column(found, "log_radius_50")[ball] == pytest.approx(np.log(1 / np.sqrt(4 * np.pi)))


def test_every_part_has_one_like_it_in_another_tessellation(tree):
    shape, parts = tree
    coarse = shapes.tube_tree(step=0.2)
    others = decompose(*coarse).parts()
    found, more = part_descriptors(*shape, parts), part_descriptors(*coarse, others)
    for part in range(others.count):
        to = distances(more[part], found)
        assert to.min() < 0.8
        # Arms are like each other, but not like what is much smaller or larger.
        unlike = np.abs(np.log(parts.share / others.share[part])) > 1
        assert (to[unlike] > 1.5).all()


def test_the_distance_is_the_mean_of_scaled_differences():
    one = np.zeros(len(NAMES))
    assert distances(one, np.stack([one, SCALE, -2 * SCALE])).tolist() == pytest.approx([0, 1, 2])


def test_depth_is_the_way_from_the_cuts_of_the_own_part():
    """A strip of eight squares, the last three of which are another part."""
    vertices, quads = shapes.flat_cells([(x, 0) for x in range(8)])
    mesh = TriMesh(vertices, quads)
    part = (mesh.face_centroids[:, 0] > 5).astype(int)
    depth = _Surface(mesh, part, np.zeros(mesh.n_vertices), np.array([5.0, 3.0]), 1.0, np.zeros(2, bool)).depth()
    beside = mesh.edges.pairs[part[mesh.edges.pairs[:, 0]] != part[mesh.edges.pairs[:, 1]]].ravel()
    for face, own in enumerate(part):
        (first,) = beside[part[beside] == own]
        straight = np.linalg.norm(mesh.face_centroids[face] - mesh.face_centroids[first])
        assert straight - 1e-9 <= depth[face] <= 1.7 * straight + 1e-9
    assert depth.max() > 4
    one, alone = np.zeros(mesh.n_faces, int), np.zeros(1, bool)
    whole = _Surface(mesh, one, np.zeros(mesh.n_vertices), np.array([8.0]), 1.0, alone)
    assert (whole.depth() == 0).all()


@pytest.mark.parametrize(("name", "value"), [
    ("one", 5.0), ("one", "x"), ("one", np.zeros(3)), ("others", None), ("others", np.zeros(len(NAMES))),
    ("others", np.zeros((2, 3)))])
def test_what_are_no_descriptors_is_refused_by_name(name, value):
    with pytest.raises(ParameterError, match=f"^{name} must have {len(NAMES)} numbers") as caught:
        distances(**{"one": np.zeros(len(NAMES)), "others": np.zeros((2, len(NAMES))), name: value})
    assert caught.value.name == name


def test_what_is_no_parts_is_refused(tree):
    with pytest.raises(ParameterError, match=r"^parts must be the parts of a result, not int\.$"):
        part_descriptors(*tree, 5)

# SPDX-License-Identifier: GPL-3.0-or-later
"""Candidates and hierarchies made symmetric: by hand, on a row of faces, and on a figure."""

import numpy as np
import pytest
import shapes

from core import Parameters, decompose
from core.cuts.face_candidates import FaceCandidates
from core.cuts.hierarchy import Hierarchy
from core.cuts.symmetric.method import symmetric_candidates
from core.cuts.symmetric.regions import symmetric_on_regions
from core.mesh.face_graph import FaceGraph
from core.metrics import rand_index_error
from core.result import assemble


@pytest.fixture(params=[symmetric_candidates, symmetric_on_regions])
def make(request):
    """What makes candidates symmetric: face by face, or on regions."""
    return request.param


def row(make, label, merges, salience):
    """Faces in a row, an even number, mirrored in its middle."""
    n = len(label)
    graph = FaceGraph(n, np.array([(i, i + 1) for i in range(n - 1)]), np.ones(n - 1), np.ones(n))
    candidates = of_faces(graph, np.array(label), Hierarchy.of(max(label) + 1, merges, salience))
    return make(candidates, np.arange(n)[::-1], np.arange(n) - (n - 1) / 2, 1.0)


def of_faces(graph, label, hierarchy):
    """Candidates of faces without contacts."""
    return FaceCandidates(graph, np.empty((0, 2), np.int64), label, hierarchy)


def same(first, second):
    return rand_index_error(first, second) == 0


def test_a_symmetric_result_stays_as_it_is(make):
    label = [0, 0, 1, 2, 2, 3, 4, 4]
    result = row(make, label, [(1, 2), (2, 3), (0, 1), (3, 4)], [0.3, 0.3, 0.8, 0.8])
    assert same(result.label, label)
    assert result.hierarchy.salience.tolist() == pytest.approx([0.3, 0.3, 0.8, 0.8])
    assert same(result.parts(0.5), [0, 0, 1, 1, 1, 1, 2, 2])


def test_a_cut_that_only_one_side_has_is_on_both_or_on_neither(make):
    # The left end is cut off, the right one is not.
    result = row(make, [0] + 98 * [1] + [2], [(1, 2), (0, 1)], [0.2, 0.9])
    for detail in (0.05, 0.3, 0.5, 0.9):
        found = result.parts(detail)
        assert same(found, found[::-1])
    assert len(set(result.parts(0.0))) == 1


def test_a_candidate_that_hangs_over_the_plane_is_cut_off_there(make):
    result = row(make, 51 * [0] + 49 * [1], [(0, 1)], [0.9])
    assert same(result.parts(0.5), 50 * [0] + 50 * [1])


def test_what_speaks_against_the_plane_is_left_as_it_is(make):
    label = 20 * [0] + 80 * [1]
    assert row(make, label, [(0, 1)], [0.9]).label.tolist() == label


def test_thousands_of_candidates_are_left_as_they_are(make):
    label = list(range(20_000))  # a table of all their pairs would take 3 GB
    result = row(make, label, [(i, i + 1) for i in range(len(label) - 1)], np.linspace(0, 1, len(label) - 1))
    assert result.label.tolist() == label
    assert result.hierarchy.n_candidates == len(label)


def test_parts_without_an_image_keep_their_own(make):
    graph = FaceGraph(5, np.array([(0, 1), (1, 2), (2, 3), (3, 4)]), np.ones(4), np.ones(5))
    found = make(
        of_faces(graph, np.array([0, 1, 1, 1, 2]), Hierarchy.of(3, [(0, 1), (1, 2)], [0.4, 0.8])),
        np.array([-1, 3, 2, 1, -1]), np.array([-2.0, -1, 0, 1, 2]), 1.0)
    assert same(found.label, [0, 1, 1, 1, 2])
    assert found.hierarchy.salience.tolist() == pytest.approx([0.4, 0.8])


@pytest.mark.parametrize(
    "method", [{}, {"method": "berretti", "follow_level_sets": True}], ids=["perceptual", "berretti"])
def test_parts_of_a_figure_are_exactly_symmetric_at_every_detail(method):
    shape = shapes.mirrored_figure()
    result = decompose(*shape, Parameters(**method))
    twin = result.face_twin
    assert np.array_equal(twin[twin], np.arange(result.n_faces))
    for detail in np.linspace(0, 1, 21):
        found = result.parts(detail=detail)
        assert same(found.labels, found.labels[twin])
        assert np.array_equal(found.twin[found.labels], found.labels[twin])
        assert np.array_equal(found.side[found.twin], -found.side)
    assert result.parts(detail=0.0).count == 1
    most = min(result.n_candidates, 11)
    assert most > 5
    assert [result.parts(n_parts=n).count for n in range(1, most + 1)] == list(range(1, most + 1))


def test_regions_give_what_faces_give_but_for_slivers(monkeypatch):
    vertices, faces = shapes.subdivide(shapes.mirrored_figure())
    bent = vertices + 0.003 * np.ptp(vertices) * np.sin(vertices[:, [1, 2, 0]] / np.ptp(vertices) * 9)
    found = []
    for most in (0, len(faces)):
        monkeypatch.setattr(assemble, "MANY_FACES", most)
        result = decompose(bent, faces)
        labels, twin = result.parts().labels, result.face_twin
        assert labels.max() > 3
        assert rand_index_error(labels[twin >= 0], labels[twin[twin >= 0]]) < 0.002
        found.append(labels)
    assert rand_index_error(*found) < 0.002


def images_in(vertices, faces, axis):
    """The face that is the mirror image of each in the plane through 0 across an axis; it must have one."""
    centers = np.rint(4 * vertices[faces].mean(axis=1)).astype(int)
    places = {tuple(place): face for face, place in enumerate(centers.tolist())}
    centers[:, axis] *= -1
    return np.array([places[tuple(place)] for place in centers.tolist()])


@pytest.mark.parametrize(("shape", "axes", "orders"), [
    (shapes.table_of_blocks(), (0, 1), 1), (shapes.cross_of_blocks(8, 6), (0, 1, 2), 1),
    (shapes.cross_of_blocks(7, 7), (0, 1, 2), 4)], ids=["table", "cross", "plus"])
def test_parts_are_symmetric_in_all_planes_that_cross_each_other(shape, axes, orders):
    """Also in those of a plus, the middle faces of which its other planes, along their diagonals, leave to no arm."""
    vertices, faces = shape
    for order in range(orders):
        rng = np.random.default_rng(len(faces) + order)
        face = rng.permutation(len(faces))
        result = decompose(vertices @ shapes.rotation(rng).T + rng.normal(size=3), faces[face])
        twins = [images_in(vertices, faces[face], axis) for axis in axes]
        for detail in np.linspace(0, 1, 11):
            labels = result.parts(detail=detail).labels
            assert all(same(labels, labels[twin]) for twin in twins)
        assert len(np.unique(result.parts().labels[twins[0]] != result.parts().labels)) == 2
        assert [result.parts(n_parts=n).count for n in range(1, 12)] == list(range(1, 12))


def test_a_table_has_four_legs():
    vertices, faces = shapes.table_of_blocks()
    parts = decompose(vertices, faces).parts()
    leg = np.bincount(parts.labels) < 100
    assert leg.tolist().count(True) == 4 == parts.count - 1
    middle = np.array([vertices[faces[parts.labels == part]].mean(axis=(0, 1)) for part in np.flatnonzero(leg)])
    assert set(map(tuple, np.sign(middle[:, :2]))) == {(x, y) for x in (-1, 1) for y in (-1, 1)}
    assert np.ptp(parts.area[leg]) == pytest.approx(0.0, abs=1e-9)


def test_one_corner_leads_all_four():
    # A square of 6 by 6 faces; one corner of 2 by 2 is cut off, and half as surely another next to it.
    n = 6
    face = np.arange(n * n).reshape(n, n)
    pairs = np.concatenate([np.stack([face[1:], face[:-1]], axis=-1).reshape(-1, 2),
                            np.stack([face[:, 1:], face[:, :-1]], axis=-1).reshape(-1, 2)])
    label = np.zeros((n, n), np.int64)
    label[:2, :2], label[:2, -2:] = 1, 2
    x, y = np.indices((n, n)).reshape(2, -1) - (n - 1) / 2
    candidates = of_faces(FaceGraph(n * n, pairs, np.ones(len(pairs)), np.ones(n * n)), label.ravel(),
                          Hierarchy.of(3, [(0, 2), (0, 1)], [0.4, 0.8]))
    result = symmetric_candidates(
        candidates, np.stack([face[::-1].ravel(), face[:, ::-1].ravel()]), np.stack([x, y]), np.ones(2), sure=True)
    corners = np.where((abs(x) > 1) & (abs(y) > 1), 2 * (x > 0) + (y > 0) + 1, 0)
    # The second corner leads: with all four cut off where it is, most pairs of points stay as they were found. Corners
    # and middle are parted by 0.4, corners beside each other by 0.6 (0.8 and 0.4) or 0.4 (0.8 and 0), those across by
    # 0.6. The middle takes in all four at once: in the mean over pairs of points, of 20 faces and of 4 in each corner.
    between, inside = 4 * 20 * 4, 6 * 4 * 4
    mean = (between * 0.4 + inside * (0.6 + 0.4 + 0.6) / 3) / (between + inside)
    assert same(result.label, corners)
    assert result.hierarchy.salience.tolist() == pytest.approx(4 * [mean])
    assert same(result.parts(0.5), np.zeros(n * n, int))
    assert same(result.parts(0.6), corners)


def test_what_one_side_lacks_is_no_sliver():
    # A wedge of 15 faces on one hip, whose image is half a leg and half the body, was a part on both sides.
    horse = shapes.horse()
    vertices = horse.vertices.astype(np.float32)
    both, alone = (decompose(vertices, horse.faces, Parameters(symmetry=symmetry)).parts()
                   for symmetry in (True, False))
    assert both.labels.max() == alone.labels.max() == 9
    assert np.bincount(both.labels).min() > 50


@pytest.mark.parametrize(("n", "waist", "axis"), [
    (150, 1.1, 0), (200, 1.05, 2), (250, 1.05, 0), (300, 1.02, 0), (400, 1.1, 0), (500, 1.05, 2), (800, 1.1, 0)])
def test_a_cut_along_the_plane_leaves_nothing_between_two_twins(n, waist, axis):
    # Small candidates on the plane, or all that lies between a cut and its image, can join neither lobe alone; they
    # were 1 to 5 parts more.
    parts = decompose(*shapes.cassini(n, waist, axis)).parts()
    assert parts.share == pytest.approx([0.5, 0.5], abs=0.05)


def test_limbs_of_the_figure_are_pairs():
    shape = shapes.mirrored_figure()
    found = decompose(*shape).parts()
    paired = found.twin != np.arange(found.count)
    middle = np.array([shape.vertices[shape.faces[found.labels == part]].mean(axis=(0, 1))
                       for part in range(found.count)])
    assert (found.twin >= 0).all()
    assert paired.sum() >= 4
    assert np.allclose(middle[found.twin] * (-1, 1, 1), middle, atol=1e-6)
    assert np.array_equal(found.side[paired], np.sign(middle[paired, 0]))


def test_without_symmetry_nothing_is_looked_for():
    found = decompose(*shapes.mirrored_figure(), Parameters(symmetry=False))
    assert len(found.mirror) == len(found.face_twin) == 0
    assert (found.parts().twin == -1).all()
    assert (found.parts().side == 0).all()


def test_twins_are_stored():
    found = decompose(*shapes.mirrored_figure())
    again = type(found).from_bytes(found.to_bytes())
    assert np.array_equal(again.face_twin, found.face_twin)
    assert np.array_equal(again.mirror, found.mirror)
    assert np.array_equal(again.parts().side, found.parts().side)


def areas_in_a_row(make, label, area, twin, height, merges, contacts=(), apart=(), salience=(0.4, 0.8)):
    """Faces in a row of some areas. apart : faces that do not touch the ones before them. salience : first and last."""
    n = len(label)
    graph = FaceGraph(n, np.array([(i, i + 1) for i in range(n - 1) if i + 1 not in apart]),
                      np.ones(n - 1 - len(apart)), np.array(area, float))
    candidates = FaceCandidates(graph, np.array(contacts, np.int64).reshape(-1, 2), np.array(label),
                                Hierarchy.of(max(label) + 1, merges, np.linspace(*salience, len(merges))))
    found = make(candidates, np.array(twin), np.array(height, float), 1.0)
    return found.label, found.hierarchy


@pytest.mark.parametrize(("area", "count"), [(0.4, 2), (0.6, 3)])
def test_what_little_lies_across_the_plane_joins_a_neighbor(make, area, count):
    """Two faces in the middle of a thousand times as much, 0.0008 or 0.0012 of it."""
    side = [50.0] * 10
    label, hierarchy = areas_in_a_row(make, [0] * 10 + [1, 1] + [2] * 10, [*side, area, area, *side],
                                      np.arange(22)[::-1], np.arange(22) - 10.5, [(0, 1), (0, 2)], salience=(0.6, 0.8))
    assert len(np.unique(label)) == hierarchy.n_candidates == count
    assert same(label, [0] * 11 + [2] * 11 if count == 2 else [0] * 10 + [1, 1] + [2] * 10)


@pytest.mark.parametrize(("area", "count"), [(4, 2), (6, 3)])
def test_what_has_no_image_is_a_part_of_its_own_if_it_is_not_small(make, area, count):
    """At both ends of a row, 0.004 or 0.006 of it: at that of the side that leads it is one in any case."""
    label, hierarchy = areas_in_a_row(
        make, [1, *[0] * 20, 2], [area, *[50.0] * 20, area], [-1, *range(1, 21)[::-1], -1], np.arange(22) - 10.5,
        [(0, 1), (0, 2)])
    assert hierarchy.n_candidates == count
    assert same(label, [1 if count == 3 else 0, *[0] * 20, 2])


def test_small_pieces_that_only_lie_on_others_stay_apart(make):
    """A crumb at each end of a row of two halves, an image of the other: no edge joins it with anything."""
    label = [0] + [1] * 10 + [2] * 10 + [3]
    found, hierarchy = areas_in_a_row(
        make, label, [1.0] + [50.0] * 20 + [1.0], np.arange(22)[::-1], np.arange(22) - 10.5,
        [(0, 1), (2, 3), (1, 2)], contacts=[(0, 1), (20, 21)], apart=(1, 21))
    assert same(found, label)
    assert hierarchy.n_candidates == 4


def test_where_the_second_plane_is_wrong_the_first_still_holds():
    """A square of ten by ten, the lowest three rows of which are a part: an image across x, none across y. One corner
    of it is a candidate more, which its image becomes, too, or neither."""
    x, y = np.divmod(np.arange(100), 10)
    square = np.arange(100).reshape(10, 10)
    pairs = np.concatenate([np.stack([square[:, :-1].ravel(), square[:, 1:].ravel()], axis=1),
                            np.stack([square[:-1].ravel(), square[1:].ravel()], axis=1)])
    label = np.where(y < 3, 0, 1)
    label[(x == 0) & (y == 9)] = 2
    twin = np.stack([square[::-1].ravel(), square[:, ::-1].ravel()])
    graph = FaceGraph(100, pairs, np.ones(len(pairs)), np.ones(100))
    found = symmetric_candidates(of_faces(graph, label, Hierarchy.of(3, [(1, 2), (0, 1)], [0.2, 0.9])), twin,
                                 np.stack([x, y]) - 4.5, np.ones(2))
    for detail in (0.05, 0.3, 0.5, 0.9):
        assert same(found.parts(detail), found.parts(detail)[twin[0]])
    assert same(found.parts(0.5), np.where(y < 3, 0, 1))

# SPDX-License-Identifier: GPL-3.0-or-later
"""Places of one surface on another: the same in any order, at any size, in other poses and tessellations."""

import numpy as np
import pytest
import shapes

from core import ParameterError, TriMesh, decompose
from core.uses.correspondence import carried_labels, correspond, sample_surface


@pytest.fixture(scope="module")
def figure():
    """A figure with a left and a right side, its parts and its samples."""
    shape = shapes.mirrored_figure(0.15)
    return shape, decompose(*shape).parts().labels, sample_surface(*shape)


def bent(vertices, angle):
    """Wound around an axis along x: along y it turns by so many degrees from end to end."""
    low, high = vertices[:, 1].min(), vertices[:, 1].max()
    radius = (high - low) / np.radians(angle)
    turn = (vertices[:, 1] - low) / radius
    return np.stack([vertices[:, 0], (radius + vertices[:, 2]) * np.sin(turn),
                     (radius + vertices[:, 2]) * np.cos(turn) - radius], axis=1)


def test_samples_stand_for_the_whole_surface(figure):
    shape, _, samples = figure
    assert samples.weight.sum() == pytest.approx(1)
    assert samples.face_area.sum() == pytest.approx(1)
    assert (samples.distances == samples.distances.T).all()
    assert (samples.distances.max(), samples.distances.diagonal().max()) == (1, 0)
    stood_for = np.bincount(samples.face_sample, samples.face_area, len(samples.weight))
    assert np.abs(stood_for - samples.weight).max() < 0.01
    assert samples.weight @ samples.position == pytest.approx(np.zeros(3), abs=1e-12)
    assert len(samples.face_sample) == len(shape.faces)


def test_a_plan_moves_all_of_the_area(figure):
    samples = figure[2]
    plan = correspond(samples, samples)
    assert (plan >= 0).all()
    assert plan.sum(axis=1) == pytest.approx(samples.weight, abs=1e-6)
    assert plan.sum(axis=0) == pytest.approx(samples.weight, abs=1e-6)


def test_a_surface_corresponds_to_itself_in_any_order_and_size(figure):
    shape, labels, samples = figure
    other, _, face = shapes.shuffled(shape, np.random.default_rng(0))
    label, share = carried_labels(samples, labels, sample_surface(3 * other.vertices, other.faces), labels[face])
    assert label.tolist() == list(range(labels.max() + 1))
    assert share.min() > 0.5


def test_faces_that_are_there_twice_are_one_place(figure):
    """At each of their edges four faces meet, and the surface seemed to branch there."""
    shape, labels, samples = figure
    twice = sample_surface(shape.vertices, np.concatenate([shape.faces, shape.faces[:, ::-1]]))
    for name in ("distances", "weight", "profile", "position"):
        assert (getattr(twice, name) == getattr(samples, name)).all()
    assert (twice.face_sample == np.tile(samples.face_sample, 2)).all()
    assert twice.face_area == pytest.approx(np.tile(samples.face_area, 2) / 2)
    assert carried_labels(samples, labels, twice, np.tile(labels, 2))[0].tolist() == list(range(labels.max() + 1))


def floor_below(shape, width=30.0):
    """A shape with a square below it, of two triangles."""
    square = np.array([(-1, -1, 0), (1, -1, 0), (1, 1, 0), (-1, 1, 0)]) * width / 2
    low = shape.vertices.min(axis=0) + np.ptp(shape.vertices, axis=0) * (0.5, 0.5, 0)
    return shapes.together(shape, shapes.Shape(square + low, np.array([(0, 1, 2), (0, 2, 3)])))


def test_a_floor_is_left_out_and_corresponds_to_a_floor(figure):
    """All parts were the floor's, or one of those beside it."""
    shape, labels, samples = figure
    on_floor = floor_below(shape)
    with_floor = sample_surface(*on_floor)
    for name in ("distances", "weight", "profile", "position"):
        np.testing.assert_array_equal(getattr(with_floor, name), getattr(samples, name))
    n = labels.max() + 1
    both = np.append(labels, [n, n])
    label, share = carried_labels(with_floor, both, with_floor, both)
    assert (label.tolist(), share[n]) == (list(range(n + 1)), 1)
    label, share = carried_labels(with_floor, both, samples, labels)
    assert label.tolist() == list(range(n))
    label, share = carried_labels(samples, labels, with_floor, both)
    assert (label[:-1].tolist(), share[-1]) == (list(range(n)), 0)
    twice = sample_surface(on_floor.vertices, np.concatenate([on_floor.faces, on_floor.faces[-2:, ::-1]]))
    assert carried_labels(with_floor, both, twice, np.append(both, [n, n]))[0].tolist() == list(range(n + 1))


def test_labels_of_another_surface_are_refused(figure):
    """An IndexError, a lack of memory for labels such as colors or, of labels below 0, the wrong part."""
    _, labels, samples = figure
    for wrong in (labels[:-1], labels - 1, labels + 0.5, labels[None], labels + 0xFF0000):
        for pair in ((wrong, labels), (labels, wrong)):
            with pytest.raises(ParameterError, match=f"Labels must be {len(labels)} whole numbers from 0"):
                carried_labels(samples, pair[0], samples, pair[1])


@pytest.mark.parametrize("angle", [40, -60])
def test_a_bent_and_finer_surface_has_the_same_parts_left_and_right(figure, angle):
    shape, labels, samples = figure
    finer = shapes.subdivide(shape)
    label, _ = carried_labels(samples, labels, sample_surface(bent(finer.vertices, angle), finer.faces),
                              np.repeat(labels, 4))
    assert label.tolist() == list(range(labels.max() + 1))


def test_two_parts_can_come_from_one(figure):
    """Labels of a target that is cut finer: all of them come from where they lie."""
    _, labels, samples = figure
    whole = np.zeros_like(labels)
    label, share = carried_labels(samples, whole, samples, labels)
    assert label.tolist() == [0] * (labels.max() + 1)
    assert share == pytest.approx(np.ones(labels.max() + 1))


def test_pieces_and_polygons_and_flat_faces_are_no_trouble():
    two = shapes.two_spheres()
    samples = sample_surface(*two)
    left = (two.vertices[two.faces].mean(axis=1)[:, 0] > two.vertices[:, 0].mean()).astype(int)
    with np.errstate(all="raise"):  # as callers may have it: what nearly nothing goes to underflows
        label, _ = carried_labels(samples, left, samples, left)
    assert label.tolist() == [0, 1]
    flat = shapes.with_flat_faces(shapes.icosphere(2))
    samples = sample_surface(*flat)
    assert (TriMesh(*flat).face_area[samples.face_sample == -1] < 1e-12).all()
    assert (samples.face_sample[:len(shapes.icosphere(2).faces)] >= 0).all()
    vertices, quads = shapes.box_quads()
    assert len(sample_surface(vertices, quads).face_sample) == len(quads)

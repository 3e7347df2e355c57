# SPDX-License-Identifier: GPL-3.0-or-later
"""Classes of like curvature: by hand, from the data, and without chance."""

import numpy as np
import pytest
from results import same_partition

from core.cuts.lavoue.clusters import EXPLAINED, MOST_CLUSTERS, cluster


def clouds(rng, centers, size=40):
    points = np.concatenate([center + 0.3 * rng.normal(size=(size, 2)) for center in np.array(centers, float)])
    return points, np.repeat(np.arange(len(centers)), size)


def test_four_points_in_two_classes_by_hand():
    # On a line at 0, 1, 10 and 12: the split with the least sum of squares, 0.5 + 2, is in the middle.
    points = np.array([(0.0, 0), (1, 0), (10, 0), (12, 0)])
    assert cluster(points, np.ones(4), 2).tolist() in ([0, 0, 1, 1], [1, 1, 0, 0])
    # A point that outweighs all others has the mean beside it, and the longest axis parts it from them.
    assert same_partition(cluster(points[1:], np.array([1.0, 1, 1000]), 2), np.array([0, 1, 1]))


@pytest.mark.parametrize("centers", [[(0, 0), (9, 0)], [(0, 0), (9, 0), (0, 9)], [(-8, 0), (0, 0), (8, 1), (0, 9)]])
def test_as_many_classes_as_the_data_have(centers):
    points, cloud = clouds(np.random.default_rng(0), centers)
    assert same_partition(cluster(points, np.ones(len(points))), cloud)
    assert same_partition(cluster(points, np.ones(len(points)), len(centers)), cloud)


def test_what_differs_by_error_only_is_one_class():
    points = 3.5 + 0.3 * np.random.default_rng(0).normal(size=(200, 2))
    assert cluster(points, np.ones(200)).max() == 0
    assert cluster(points, np.ones(200), 3).max() == 2  # unless more are asked for


def test_enough_of_the_variance_is_explained():
    rng = np.random.default_rng(1)
    points, weight = 12 * rng.random((2000, 2)), rng.random(2000) + 0.1
    label = cluster(points, weight)
    assert 1 < label.max() < MOST_CLUSTERS - 1
    means = np.array([np.average(points[label == k], axis=0, weights=weight[label == k]) for k in np.unique(label)])
    left = weight @ ((points - means[label]) ** 2).sum(axis=1)
    whole = weight @ ((points - np.average(points, axis=0, weights=weight)) ** 2).sum(axis=1)
    assert left < (1 - EXPLAINED + 0.01) * whole  # bins are a little wider than points


def test_order_does_not_matter():
    rng = np.random.default_rng(2)
    points, weight, order = 4 * rng.normal(size=(500, 2)), rng.random(500) + 0.1, rng.permutation(500)
    for count in (0, 1, 5):
        assert same_partition(cluster(points, weight, count)[order], cluster(points[order], weight[order], count))


def test_no_more_classes_than_distinct_points():
    assert cluster(np.zeros((7, 2)), np.ones(7), 5).tolist() == [0] * 7
    assert len(np.unique(cluster(np.array([(0.0, 0), (0, 0), (3, 0)]), np.ones(3), 5))) == 2

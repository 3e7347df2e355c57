# SPDX-License-Identifier: GPL-3.0-or-later
"""Contours as curves: every crossing once, in order, the same alone and beside others."""

from dataclasses import replace

import numpy as np
import pytest
import shapes
from scipy.spatial import Delaunay

from core.cuts.berretti import contour_curves as module
from core.cuts.berretti.contour_curves import contour_curves
from core.graph.level_sets import cut_at_levels, uniform_levels
from core.mesh.triangles import TriMesh


def upright(shape, n_slabs):
    """Level sets of the height, 0..1."""
    z = shape.vertices[:, 2]
    return cut_at_levels(TriMesh(*shape), (z - z.min()) / np.ptp(z), uniform_levels(n_slabs))


def curve(sets, contour):
    """Edges that a contour crosses, where it does, and whether it is closed."""
    (found,) = contour_curves(sets, np.array([contour]))
    assert found.start.tolist() == [0, len(found.edge)]
    return found.edge, found.at_crossings(sets, sets.mesh.vertices), found.closed[0]


@pytest.mark.parametrize("make", [shapes.dumbbell, lambda: shapes.surface_of_genus(2), shapes.tube_tree])
def test_closed_curves_pass_every_crossing_once(make):
    sets = upright(make(), 13)
    edges = sets.mesh.edges.vertices
    for contour in range(sets.n_contours):
        edge, points, closed = curve(sets, contour)
        segments = sets.segment_contour == contour
        assert closed
        assert len(edge) == len(set(edge.tolist())) == segments.sum()
        assert set(edge.tolist()) == set(sets.segment_edges[segments].ravel().tolist())
        # Consecutive crossings, and the last and the first, are the ends of one segment.
        steps = {tuple(sorted(p)) for p in zip(edge.tolist(), np.roll(edge, -1).tolist(), strict=True)}
        assert steps == {tuple(sorted(p)) for p in sets.segment_edges[segments].tolist()}
        length = np.linalg.norm(points - np.roll(points, -1, axis=0), axis=1).sum()
        assert length == pytest.approx(sets.contour_length[contour])
        a, b = sets.mesh.vertices[edges[edge]].transpose(1, 0, 2)
        np.testing.assert_allclose(np.linalg.norm(points - a, axis=1) + np.linalg.norm(points - b, axis=1),
                                   np.linalg.norm(a - b, axis=1), rtol=1e-9)


@pytest.mark.parametrize("other", [shapes.icosphere(2), shapes.moved(shapes.flat_grid(4, 4), (-2, -2, 0))])
@pytest.mark.parametrize("first", [False, True])
def test_the_longest_of_several_curves_stands_for_a_contour(other, first):
    """A contour that a bridge goes through has a curve on each side of it, here a ball and something coarser."""
    ball, other = shapes.icosphere(3), shapes.moved(other, (0, 5, 0))
    vertices, faces = shapes.together(other, ball) if first else shapes.together(ball, other)
    sets = cut_at_levels(TriMesh(vertices, faces), vertices[:, 0], np.array([0.3]))
    assert sets.n_contours == 2
    longest = int(np.bincount(sets.segment_contour).argmax())
    crossed = sets.segment_edges[sets.segment_contour == longest]
    sets = replace(sets, segment_contour=np.zeros_like(sets.segment_contour))
    edge, _, closed = curve(sets, 0)
    assert closed
    assert sorted(edge.tolist()) == np.unique(crossed).tolist()


def test_open_curves_run_from_border_to_border():
    vertices, faces = shapes.flat_grid(6, 9)
    sets = cut_at_levels(TriMesh(vertices, faces), vertices[:, 0], np.array([2.5]))
    _, points, closed = curve(sets, 0)
    assert not closed
    y = points[:, 1]
    assert (np.diff(y) > 0).all() or (np.diff(y) < 0).all()
    assert sorted((y[0], y[-1])) == [0, 9]
    np.testing.assert_allclose(points[:, 0], 2.5)


@pytest.mark.parametrize("at_once", [1, 3, 1000])
def test_many_contours_are_the_curves_that_each_is_alone(at_once, monkeypatch):
    """Also where contours fork, as at edges of three faces, and in any order of the contours."""
    monkeypatch.setattr(module, "AT_ONCE", at_once)
    rng = np.random.default_rng(0)
    points = rng.normal(size=(60, 3))
    fins = rng.permuted(np.tile(np.arange(60), (20, 1)), axis=1)[:, :3]
    sets = upright(shapes.Shape(points, np.concatenate([Delaunay(points[:, :2]).simplices, fins])), 12)
    contours = rng.permutation(sets.n_contours)
    found = list(contour_curves(sets, contours))
    assert len(found) == -(-len(contours) // at_once)
    edges = [edge for one in found for edge in np.split(one.edge, one.start[1:-1])]
    places = [at for one in found for at in np.split(one.at_crossings(sets, points), one.start[1:-1])]
    closed = np.concatenate([one.closed for one in found])
    assert 0 < closed.sum() < len(closed)
    for contour, *curve_found in zip(contours.tolist(), edges, places, closed, strict=True):
        for one, other in zip(curve_found, curve(sets, contour), strict=True):
            np.testing.assert_array_equal(one, other)


def test_of_no_contours_there_are_no_curves():
    assert list(contour_curves(upright(shapes.icosphere(1), 3), np.empty(0, np.int64))) == []

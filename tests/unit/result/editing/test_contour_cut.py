# SPDX-License-Identifier: GPL-3.0-or-later
"""Contours and the cuts along them, on surfaces whose level sets are known."""

import numpy as np
import pytest
import shapes
from face_graphs import graph_of

from core.arrays.components import components
from core.mesh.corners import CornerTable
from core.mesh.face_graph import FaceGraph
from core.result.editing.contour_cut import Contours, contour_sides, contours


class Surface:
    """A closed triangle mesh with a field, as the functions want it."""

    def __init__(self, shape, field):
        self.vertices, self.faces = shape
        self.field = field(self.vertices)
        self.table = CornerTable.of(self.vertices, self.faces)
        self.graph = graph_of(shape)
        self.everything = np.ones(len(self.faces), bool)

    def contours(self, level, inside=None):
        inside = self.everything if inside is None else inside
        return contours(self.field, level, self.table.within(inside))

    def sides(self, level, found, chosen, inside=None):
        crossed = np.zeros(len(self.faces), bool)
        crossed[found.face[found.label == chosen]] = True
        above = self.field[self.faces].mean(axis=1) >= level
        return contour_sides(self.graph, self.everything if inside is None else inside, above, crossed)

    def pieces(self, mask):
        pairs = self.graph.pairs[mask[self.graph.pairs].all(axis=1)]
        _, piece = components(len(mask), *pairs.T)
        return len(np.unique(piece[mask]))


def height(axis):
    return lambda vertices: vertices[:, axis].astype(float)


@pytest.fixture(scope="module")
def tree():
    return Surface(shapes.tube_tree(), lambda vertices: np.linalg.norm(vertices, axis=1))


def test_one_tetrahedron_by_hand():
    # Vertex 3 is at height 1, the others at 0: half way up the contour is a triangle of half the size.
    vertices = np.array([(0, 0, 0), (2, 0, 0), (0, 2, 0), (0, 0, 1)], float)
    faces = np.array([(0, 2, 1), (0, 1, 3), (1, 2, 3), (2, 0, 3)])
    surface = Surface((vertices, faces), height(2))
    found = surface.contours(0.5)
    assert found.count == 1
    assert sorted(found.face.tolist()) == [1, 2, 3]
    corners = {tuple(point) for point in found.segments.reshape(-1, 3).tolist()}
    assert corners == {(0.0, 0.0, 0.5), (1.0, 0.0, 0.5), (0.0, 1.0, 0.5)}
    assert [found.through(face) for face in range(4)] == [-1, 0, 0, 0]
    assert found.around(np.zeros(3)) == 0


def test_a_sphere_has_one_round_contour_at_each_level():
    surface = Surface(shapes.icosphere(4), height(2))
    for level in (-0.7, 0.03, 0.6):
        found = surface.contours(level)
        assert found.count == 1
        assert np.allclose(found.segments[..., 2], level)
        length = np.linalg.norm(found.segments[:, 0] - found.segments[:, 1], axis=1).sum()
        assert length == pytest.approx(2 * np.pi * np.sqrt(1 - level**2), rel=0.01)
        side = surface.sides(level, found, 0)
        area = surface.graph.area
        assert area[side].sum() == pytest.approx(2 * np.pi * (1 - level), rel=0.05)
        assert surface.pieces(side) == surface.pieces(~side) == 1


def test_no_contour_beyond_the_field():
    surface = Surface(shapes.icosphere(2), height(2))
    found = surface.contours(3.0)
    assert found.count == 0
    assert found.around(np.zeros(3)) == found.through(0) == -1


def test_a_cut_at_one_branch_leaves_the_other_branches_alone(tree):
    found = tree.contours(1.2)
    assert found.count == 4
    for tip in shapes.TREE_TIPS:
        # Where the branch's center line is 1.2 from the middle.
        chosen = found.around(1.2 * tip / np.linalg.norm(tip))
        side = tree.sides(1.2, found, chosen)
        center = tree.vertices[tree.faces].mean(axis=1)
        along = center @ tip / np.linalg.norm(tip)
        nearest = np.argmax(center @ (shapes.TREE_TIPS / np.linalg.norm(shapes.TREE_TIPS, axis=1)[:, None]).T, axis=1)
        own = nearest == np.flatnonzero((shapes.TREE_TIPS == tip).all(axis=1))[0]
        assert side[own & (along > 1.3)].all()
        assert not side[own & (along < 1.1)].any()
        assert not side[~own].any()
        assert tree.pieces(side) == tree.pieces(~side) == 1


def test_through_and_around_agree(tree):
    found = tree.contours(1.2)
    for chosen in range(found.count):
        faces = found.face[found.label == chosen]
        assert {found.through(face) for face in faces.tolist()} == {chosen}
        assert found.around(found.segments[found.label == chosen].mean(axis=(0, 1))) == chosen


def test_only_the_part_is_cut(tree):
    center = tree.vertices[tree.faces].mean(axis=1)
    inside = center[:, 0] > 0.5
    found = tree.contours(1.2, inside)
    assert found.count == 1
    assert inside[found.face].all()
    side = tree.sides(1.2, found, 0, inside)
    assert not side[~inside].any()
    assert 0 < side.sum() < inside.sum()


def test_a_ring_is_cut_at_both_of_its_contours():
    # A torus that stands: at its middle height there are two contours, and cutting one of them parts nothing.
    surface = Surface(shapes.torus(48, 24), height(0))
    found = surface.contours(0.0)
    assert found.count == 2
    for chosen in range(2):
        side = surface.sides(0.0, found, chosen)
        assert surface.pieces(side) == surface.pieces(~side) == 1
        assert surface.graph.area[side].sum() == pytest.approx(0.5 * surface.graph.area.sum(), rel=0.05)
        x = surface.vertices[surface.faces].mean(axis=1)[:, 0]
        assert side[x > 0.2].all()
        assert not side[x < -0.2].any()


def test_a_contour_that_hardly_cuts_anything_off_gives_none():
    # All of the part is above the level by its middles.
    surface = Surface(shapes.icosphere(1), height(2))
    found = surface.contours(surface.field.min() + 1e-6)
    assert surface.sides(surface.field.min() + 1e-6, found, 0) is None


@pytest.mark.parametrize("seed", range(3))
def test_the_order_of_vertices_and_faces_does_not_matter(seed):
    rng = np.random.default_rng(seed)
    shape = shapes.dumbbell(40, 16)
    other, _, old_face = shapes.shuffled(shape, rng)
    first, second = Surface(shape, height(2)), Surface(other, height(2))
    level = 0.4321
    sides = [surface.sides(level, surface.contours(level), 0) for surface in (first, second)]
    assert (sides[1] == sides[0][old_face]).all()


def test_the_centroid_of_a_contour_is_that_of_its_length():
    """Ten short segments to the left and a long one to the right, which all lie around 5.5; around 1 by number."""
    x = np.append(np.arange(11) / 10, 11.0)
    long = np.stack([np.outer(ends, (1, 0, 0)) for ends in (x[:-1], x[1:])], axis=1)
    segments = np.concatenate([long, [[(4.0, 0.3, 0), (4.2, 0.3, 0)]]])
    found = Contours(2, segments, np.arange(12), np.repeat([0, 1], (11, 1)), np.zeros((12, 2, 2), int),
                     np.zeros((12, 2)))
    assert found.around(np.array([5.5, 0, 0])) == 0


@pytest.mark.parametrize(("field", "count"), [((0, 0.5, 1), 1), ((0.5, 0.5, 1), 0), ((0, 0.5, 0.5), 1)])
def test_a_vertex_on_the_level_counts_as_above_it(field, count):
    table = CornerTable.of(np.array([(0, 0, 0), (1, 0, 0), (0, 1, 0)], float), np.array([(0, 1, 2)]))
    assert contours(np.array(field), 0.5, table).count == count


def test_of_several_pieces_the_one_that_the_contour_lies_on_is_cut():
    """Beside a piece of more area than both sides, no side of the cut is a stray of it."""
    small = shapes.cylinder(12, 8)
    large = type(small)(4.0 * small.vertices + (20, 0, 0), small.faces)
    surface = Surface(shapes.together(small, large), height(2))
    of_small = np.arange(len(surface.faces)) < len(small.faces)
    level = float(np.median(small.vertices[:, 2])) + 1e-3
    found = surface.contours(level)
    side = surface.sides(level, found, found.label[np.flatnonzero(of_small[found.face])[0]])
    assert side is not None
    assert not side[~of_small].any()
    assert 0 < side.sum() < of_small.sum()


def segments_of(*rows):
    """Contours of segments along x at some y and z. rows : the x between the segments, y and z of each contour."""
    ends = [np.stack([np.column_stack([x[k:len(x) - 1 + k], *(np.full(len(x) - 1, at) for at in (y, z))])
                      for k in (0, 1)], axis=1) for x, y, z in rows]
    label = np.repeat(np.arange(len(rows)), [len(row) for row in ends])
    segments = np.concatenate(ends)
    return Contours(len(rows), segments, np.arange(len(label)), label, np.zeros((len(label), 2, 2), int),
                    np.zeros((len(label), 2)))


def test_around_weighs_segments_by_their_length():
    """Of a contour of three short segments and a long one the middle is 12, and nearly 10 by number; of the other 9."""
    found = segments_of(([10, 10.01, 10.02, 10.03, 14.0], 5, 7), ([8.0, 10.0], 5, 7))
    assert found.around(np.array([10.4, 5, 7])) == 1
    assert found.around(np.array([10.6, 5, 7])) == 0


def test_the_cut_along_a_contour_has_no_saw_teeth():
    """Five rows of six squares; those above the level lie right of the middle, and one more in the third row."""
    rows, columns = 5, 6
    face = np.arange(rows * columns).reshape(rows, columns)
    pairs = np.concatenate([np.stack([face[:, :-1].ravel(), face[:, 1:].ravel()], axis=1),
                            np.stack([face[:-1].ravel(), face[1:].ravel()], axis=1)])
    graph = FaceGraph(rows * columns, pairs, np.ones(len(pairs)), np.ones(rows * columns))
    right = (np.arange(rows * columns) % columns >= 3)
    above = right.copy()
    above[face[2, 2]] = True
    everything = np.ones(rows * columns, bool)
    assert contour_sides(graph, everything, above, everything).tolist() == right.tolist()


def test_what_would_vanish_is_cut_off_with_its_saw_teeth():
    """A corner of a grid of squares: to take it off shortens the cut, to nothing. The ring was shown all the same."""
    rows, columns = 5, 6
    face = np.arange(rows * columns).reshape(rows, columns)
    pairs = np.concatenate([np.stack([face[:, :-1].ravel(), face[:, 1:].ravel()], axis=1),
                            np.stack([face[:-1].ravel(), face[1:].ravel()], axis=1)])
    graph = FaceGraph(rows * columns, pairs, np.ones(len(pairs)), np.ones(rows * columns))
    corner = face.ravel() == 0
    everything = np.ones(rows * columns, bool)
    assert contour_sides(graph, everything, corner, everything).tolist() == corner.tolist()
    assert contour_sides(graph, everything, everything, everything) is None

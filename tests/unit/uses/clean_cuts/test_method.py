# SPDX-License-Identifier: GPL-3.0-or-later
"""Smooth cuts: where they run, that nothing is lost by them, and when they are left alone."""

import numpy as np
import pytest
import shapes

from core.mesh.corners import CornerTable
from core.uses.clean_cuts.method import clean_cuts
from core.uses.clean_cuts.turning import turning

NORMAL = np.array([0.3, 0.5, 0.8]) / np.linalg.norm([0.3, 0.5, 0.8])


def table_of(shape):
    return CornerTable.of(*shape)


def centers(table):
    return table.face_means(table.vertices)


def points_of(table, cuts):
    """Where curves cross edges, (k, 3)."""
    a, b = table.vertices[table.edges[cuts.edge]].transpose(1, 0, 2)
    return a + cuts.share[:, None] * (b - a)


def pieces_of(table, cuts, labels):
    """Area of each part after the cuts."""
    crossed = dict(zip(cuts.edge.tolist(), points_of(table, cuts), strict=True))
    marks = {}
    for face, start, label in zip(cuts.face.tolist(), cuts.start.tolist(), cuts.label.tolist(), strict=True):
        marks.setdefault(face, []).append((start, label))
    area = np.zeros(labels.max() + 1)
    n = len(table.vertices)
    for face in range(table.n_faces):
        corner = np.flatnonzero(table.corner_face == face)
        outline = []
        for i in corner:
            outline.append((int(table.corner_vertex[i]), table.vertices[table.corner_vertex[i]]))
            if table.corner_edge[i] in crossed:
                outline.append((n + int(table.corner_edge[i]), crossed[table.corner_edge[i]]))
        found = marks.get(face, [(outline[0][0], labels[face])])
        place = [next(j for j, (point, _) in enumerate(outline) if point == start) for start, _ in found]
        middle = [np.mean([outline[j][1] for j in place], axis=0)] if len(found) == 3 else []
        for k, (_, label) in enumerate(found):
            end = place[(k + 1) % len(found)]
            steps = (end - place[k]) % len(outline) or len(outline)
            ring = [outline[(place[k] + j) % len(outline)][1] for j in range(steps + (len(found) > 1))] + middle
            fan = [np.cross(p - ring[0], q - ring[0]) for p, q in zip(ring[1:], ring[2:], strict=False)]
            area[label] += np.linalg.norm(np.sum(fan, axis=0)) / 2
    return area


def test_a_ragged_border_becomes_a_section_with_a_plane():
    table = table_of(shapes.icosphere(4))
    labels = (centers(table) @ NORMAL > 0.2).astype(np.int64)
    cuts = clean_cuts(table, labels)
    assert (cuts.planes, cuts.kept, len(cuts.odd)) == (1, 0, 0)
    points = points_of(table, cuts)
    through = table.vertices[cuts.start[cuts.start < len(table.vertices)]]
    fitted = np.linalg.svd(points - points.mean(axis=0))[2][2]
    assert abs(fitted @ NORMAL) > 0.9995
    length = table.edge_length(cuts.edge).mean()
    assert np.abs((np.vstack([points, through]) - points.mean(axis=0)) @ fitted).max() < 0.02 * length
    assert points.mean(axis=0) @ NORMAL == pytest.approx(0.2, abs=0.1 * length)


@pytest.mark.parametrize("bend", [0.1, 0.25])
def test_a_bent_border_lies_in_a_plane_if_that_is_asked_for(bend):
    """A border up and down around a ball: not in a plane by itself, in the one through its middle if asked."""
    table = table_of(shapes.icosphere(4))
    x, y, z = centers(table).T
    labels = (z > bend * np.cos(2 * np.arctan2(y, x)) + 0.1).astype(np.int64)
    assert clean_cuts(table, labels).planes == 0
    cuts = clean_cuts(table, labels, planar=True)
    assert (cuts.planes, cuts.kept, len(cuts.odd)) == (1, 0, 0)
    points = points_of(table, cuts)
    fitted = np.linalg.svd(points - points.mean(axis=0))[2][2]
    length = table.edge_length(cuts.edge).mean()
    through = table.vertices[np.unique(cuts.start[cuts.start < len(table.vertices)])]
    assert abs(fitted[2]) > 0.99
    assert np.abs((points - points.mean(axis=0)) @ fitted).max() < 0.002 * length
    # Where the border was in another place, faces change their part as a whole, and begin anywhere.
    assert len(through)
    area = pieces_of(table, cuts, labels)
    faces = table.face_vectors()
    assert area.sum() == pytest.approx(np.linalg.norm(faces, axis=1).sum(), rel=1e-9)


def test_two_planes_beside_each_other():
    """Bent borders near each other get a plane each, and of borders whose planes might cross no part is lost."""
    table = table_of(shapes.icosphere(4))
    x, y, z = centers(table).T
    wave = 0.1 * np.cos(2 * np.arctan2(y, x))
    labels = (z > wave - 0.2).astype(np.int64) + (z > wave + 0.2)
    assert clean_cuts(table, labels, planar=True).planes == 2
    crossed = (z > wave).astype(np.int64) + (z > -3 * wave + 0.35)
    cuts = clean_cuts(table, crossed, planar=True)
    assert pieces_of(table, cuts, crossed).min() > 0


@pytest.mark.parametrize("count", [2, 3, 5])
def test_all_of_the_surface_is_in_one_part(count):
    """Slices between two poles, where all of them meet, with ragged borders: their areas add up to that of the mesh."""
    table = table_of(shapes.icosphere(3))
    x, y, z = centers(table).T
    labels = ((np.arctan2(y, x) + 0.4 * np.sin(4 * z)) % (2 * np.pi) * count / (2 * np.pi)).astype(np.int64)
    cuts = clean_cuts(table, labels)
    assert len(cuts.edge)
    a, b, c = table.vertices[table.corner_vertex.reshape(-1, 3)].transpose(1, 0, 2)
    face = np.linalg.norm(np.cross(b - a, c - a), axis=1) / 2
    area = pieces_of(table, cuts, labels)
    assert area.sum() == pytest.approx(face.sum(), rel=1e-12)
    assert area == pytest.approx(np.bincount(labels, face), rel=0.05)


@pytest.mark.parametrize("seed", range(3))
def test_order_pose_and_scale_do_not_matter(seed):
    rng = np.random.default_rng(seed)
    vertices, faces = shapes.icosphere(3)
    vertices = vertices + 0.2 * np.sin(3 * vertices[:, [1, 2, 0]])
    middle = vertices[faces].mean(axis=1)
    labels = (middle[:, 0] > 0.1) + 2 * (middle[:, 1] + 0.3 * middle[:, 0] > 0.2)
    table = table_of((vertices, faces))
    cuts = clean_cuts(table, labels)
    points = points_of(table, cuts)
    order, place = rng.permutation(len(faces)), rng.permutation(len(vertices))
    turn, _ = np.linalg.qr(rng.standard_normal((3, 3)))
    turn *= np.linalg.det(turn)
    moved = np.empty_like(vertices)
    moved[place] = 7.0 * vertices @ turn.T + 1.0
    other = table_of((moved, place[faces[order]]))
    others = points_of(other, clean_cuts(other, labels[order]))
    back = (others - 1.0) @ turn / 7.0
    assert np.abs(np.sort(back @ NORMAL) - np.sort(points @ NORMAL)).max() < 1e-9


def test_what_is_smooth_already_stays():
    vertices, faces = shapes.cylinder(24, 16)
    table = table_of((vertices, faces))
    along = np.argmax(np.ptp(vertices, axis=0))
    rings = np.unique(np.round(vertices[:, along], 6))
    labels = (centers(table)[:, along] > rings[len(rings) // 2]).astype(np.int64)
    cuts = clean_cuts(table, labels)
    assert (len(cuts.edge), len(cuts.face), cuts.kept) == (0, 0, 0)


def test_no_part_is_taken_away():
    """A part of one face would be diffused into nothing."""
    table = table_of(shapes.icosphere(3))
    labels = (centers(table) @ NORMAL > 0.2).astype(np.int64)
    labels[np.argmin(centers(table) @ NORMAL)] = 2
    cuts = clean_cuts(table, labels)
    assert len(cuts.edge)
    assert (pieces_of(table, cuts, labels) > 0).all()


@pytest.mark.parametrize("seed", [46, 86, 380, 396])
def test_no_part_of_several_islands_is_taken_away(seed):
    """One island would be diffused into nothing now, and the others, fewer times, in another try."""
    table, rng = table_of(shapes.icosphere(3)), np.random.default_rng(seed)
    normal = rng.normal(size=3)
    labels = (centers(table) @ normal > 0.2 * np.linalg.norm(normal)).astype(np.int64)
    count = rng.integers(1, 4)
    for _ in range(2):
        apart = np.linalg.norm(centers(table) - centers(table)[rng.integers(table.n_faces)], axis=1)
        labels[np.argsort(apart)[:count]] = 2
    cuts = clean_cuts(table, labels)
    assert len(cuts.edge)
    assert (pieces_of(table, cuts, labels) > 0).all()


def test_without_borders_there_is_nothing_to_do():
    table = table_of(shapes.octahedron())
    cuts = clean_cuts(table, np.zeros(8, np.int64))
    assert len(cuts.edge) == len(cuts.face) == len(cuts.odd) == cuts.kept == 0


def test_turning_of_a_square_and_of_a_fork():
    points = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [2, 0, 0.0]])
    square = np.array([[0, 1], [1, 2], [2, 3], [3, 0]])
    at, angle = turning(points, square)
    assert at.tolist() == [0, 1, 2, 3]
    assert angle == pytest.approx(np.full(4, np.pi / 2))
    assert turning(points, np.vstack([square, [[1, 4]]]))[0].tolist() == [0, 2, 3]


def test_a_border_where_three_faces_meet_stays():
    table = table_of(shapes.with_fin(shapes.icosphere(3)))
    count = np.bincount(table.corner_edge)
    branch = np.flatnonzero(count > 2)[0]
    labels = (centers(table) @ NORMAL > table.vertices[table.edges[branch]].mean(axis=0) @ NORMAL).astype(np.int64)
    labels[table.corner_face[np.flatnonzero(table.corner_edge == branch)[0]]] = 0
    labels[table.corner_face[np.flatnonzero(table.corner_edge == branch)[1]]] = 1
    cuts = clean_cuts(table, labels)
    assert cuts.kept == 1
    assert branch not in cuts.edge


def test_a_border_stays_along_edges_where_that_is_asked_for():
    """Two caps of a ball: the border of one of them stays."""
    table = table_of(shapes.icosphere(4))
    height = centers(table) @ NORMAL
    labels = (height > 0.5) + 2 * (height < -0.5)
    low, high = table.edge_labels(labels)
    cuts = clean_cuts(table, labels, (low == 0) & (high == 1))
    assert cuts.kept == 1
    assert (points_of(table, cuts) @ NORMAL < 0).all()
    assert len(cuts.edge) > 50

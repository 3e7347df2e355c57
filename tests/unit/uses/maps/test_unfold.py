# SPDX-License-Identifier: GPL-3.0-or-later
"""Seams that open parts: every chart is a disc that lies flat, and the seams are short and out of sight."""

import numpy as np
import pytest
import shapes
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import connected_components

from core.mesh.corners import CornerTable
from core.uses.maps.conformal import ConformalFactor
from core.uses.maps.unfold import opening_seams, seam_cost, unfolding_seams

SHAPES = {
    "sphere": lambda: shapes.icosphere(3), "torus": shapes.torus, "genus two": lambda: shapes.genus_two(0.09),
    "tree": shapes.tube_tree, "grid": lambda: shapes.flat_grid(8, 6), "two spheres": shapes.two_spheres,
}


def table_of(shape):
    """The corners of a shape."""
    return CornerTable.of(*shape)


def around(vertices, faces, n_seeds):
    """Edges between the parts of a mesh that lie nearest to some of its faces."""
    centers = vertices[faces].mean(axis=1)
    seeds = centers[np.random.default_rng(0).choice(len(centers), n_seeds, replace=False)]
    low, high = table_of((vertices, faces)).edge_labels(
        np.linalg.norm(centers[:, None] - seeds[None], axis=2).argmin(axis=1))
    return low < high


def euler(faces, cut):
    """Euler characteristic of each chart that the cuts leave, counted corner by corner."""
    table = table_of((np.zeros((faces.max() + 1, 3)), faces))
    edges, corner_edge, corner_face = table.edges, table.corner_edge, table.corner_face
    vertex = faces.ravel()
    following = np.roll(np.arange(len(vertex)).reshape(faces.shape), -1, axis=1).ravel()
    corners = [np.flatnonzero(corner_edge == edge) for edge in range(len(edges))]
    joined = [pair for edge, pair in enumerate(corners) if len(pair) == 2 and not cut[edge]]
    same = [(x, y) for a, b in joined for x in (a, following[a]) for y in (b, following[b]) if vertex[x] == vertex[y]]

    def components(pairs, count):
        rows = np.array(pairs, int).reshape(-1, 2)
        return connected_components(coo_matrix((np.ones(len(rows)), rows.T), (count, count)), directed=False)[1]

    chart = components([corner_face[pair] for pair in joined], len(faces))
    point = components(same, len(vertex))
    _, first = np.unique(point, return_index=True)
    n_edges = np.bincount(chart[corner_face], minlength=chart.max() + 1)
    n_edges -= np.bincount(chart[[corner_face[pair[0]] for pair in joined]], minlength=chart.max() + 1)
    return np.bincount(chart[corner_face[first]]) - n_edges + np.bincount(chart)


@pytest.mark.parametrize("find", [opening_seams, unfolding_seams])
@pytest.mark.parametrize("n_seeds", [1, 4, 9])
@pytest.mark.parametrize("name", SHAPES)
def test_every_chart_is_a_disc(name, n_seeds, find):
    vertices, faces = SHAPES[name]()
    cut = around(vertices, faces, n_seeds)
    seams = find(table_of((vertices, faces)), cut)
    assert not (seams & cut).any()
    assert (euler(faces, cut | seams) == 1).all()


@pytest.mark.parametrize("name", SHAPES)
def test_no_chart_shrinks_or_grows_much(name):
    """The scale of the map whose border keeps its length is solved anew, with all seams at once."""
    table = table_of(SHAPES[name]())
    cut = around(*SHAPES[name](), 1)
    barrier = cut | unfolding_seams(table, cut) | (np.bincount(table.corner_edge) != 2)
    inside = np.setdiff1d(np.arange(len(table.vertices)), table.edges[barrier])
    scale = ConformalFactor.of(table).solve(inside)
    assert np.exp(2 * np.abs(scale)).max() <= 1 / 0.3


@pytest.mark.parametrize("seed", range(3))
def test_the_seams_do_not_depend_on_order_pose_or_size(seed):
    rng = np.random.default_rng(seed)
    vertices, faces = shapes.tube_tree()
    vertices = vertices + 1e-3 * np.random.default_rng(9).normal(size=vertices.shape)  # no two ways are equally long
    moved = 7.0 * vertices @ np.linalg.qr(rng.normal(size=(3, 3)))[0].T + rng.normal(size=3)
    place, order = rng.permutation(len(vertices)), rng.permutation(len(faces))
    shuffled = np.empty_like(moved)
    shuffled[place] = moved
    found = [seamed(vertices, faces), seamed(shuffled, place[faces][order])]
    assert {tuple(sorted(place[list(edge)])) for edge in found[0]} == found[1]


def seamed(vertices, faces):
    """The two vertices of each seam of an uncut mesh."""
    table = table_of((vertices, faces))
    seams = unfolding_seams(table, np.zeros(len(table.edges), bool))
    return {tuple(edge) for edge in table.edges[seams].tolist()}


def test_a_tube_is_opened_on_its_inner_side():
    """Two tubes side by side: each seam is on the side of the other, where a seam between legs is hidden."""
    vertices, faces = tube(24, 40)
    left, right = vertices - (1.5, 0, 0), vertices + (1.5, 0, 0)
    table = table_of((np.concatenate([left, right]), np.concatenate([faces, faces + len(vertices)])))
    seams = unfolding_seams(table, np.zeros(len(table.edges), bool))
    ends = table.vertices[table.edges[seams]].reshape(-1, 3)
    assert np.abs(ends[:, 0]).max() < 1.0
    assert table.edge_length(seams).sum() == pytest.approx(2 * 8.0)


def tube(around_it, along, length=8.0):
    """An open tube of radius 1 along z, of triangles."""
    angle, z = np.meshgrid(2 * np.pi * np.arange(around_it) / around_it, np.linspace(0, length, along))
    vertices = np.stack([np.cos(angle), np.sin(angle), z], axis=2).reshape(-1, 3)
    here = np.arange(around_it * (along - 1)).reshape(-1, around_it)
    beside = np.roll(here, -1, axis=1)
    quads = np.stack([here, beside, beside + around_it, here + around_it], axis=2).reshape(-1, 4)
    return vertices, np.concatenate([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]])


def test_a_box_is_opened_along_its_edges():
    """Each side is a grid: seams through sides are as long, but edges cost half. All but the first follow edges."""
    table = table_of(subdivided_cube(4))
    seams = unfolding_seams(table, np.zeros(len(table.edges), bool))
    ends = np.abs(table.vertices[table.edges[seams]])
    on_edge = ((ends > 1 - 1e-9).all(axis=1)).sum(axis=1) >= 2
    assert on_edge.mean() > 0.8


def subdivided_cube(n):
    """A cube from -1 to 1 of n x n squares a side, in triangles."""
    grid = np.linspace(-1, 1, n + 1)
    points, faces = [], []
    for axis in range(3):
        for sign in (-1, 1):
            u, v = np.meshgrid(grid, grid, indexing="ij")
            side = np.insert(np.stack([u, v], axis=2).reshape(-1, 2), axis, sign, axis=1)
            corner = (np.arange(n)[:, None] * (n + 1) + np.arange(n)).ravel() + len(points) * (n + 1) ** 2
            quads = np.stack([corner, corner + n + 1, corner + n + 2, corner + 1], axis=1)
            if (sign > 0) == (axis == 1):
                quads = quads[:, ::-1]
            points.append(side)
            faces += [quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]]
    points = np.concatenate(points)
    _, first, which = np.unique(np.round(points, 6), axis=0, return_index=True, return_inverse=True)
    return points[first], which.reshape(-1)[np.concatenate(faces)]


def test_the_cost_of_a_seam_is_its_length_where_it_is_flat():
    vertices, faces = shapes.flat_grid(8, 6)
    table = table_of((vertices, faces))
    assert seam_cost(table) == pytest.approx(table.edge_length(np.arange(len(table.edges))))


def test_a_flat_disc_needs_no_seam():
    vertices, faces = shapes.flat_grid(8, 6)
    assert not opening_seams(table_of((vertices, faces)), around(vertices, faces, 1)).any()


def test_a_torus_is_opened_by_its_two_shortest_loops():
    vertices, faces = shapes.torus(48, 16, 1.0, 0.35)
    table = table_of((vertices, faces))
    seams = opening_seams(table, np.zeros(len(table.edges), bool))
    length = table.edge_length(seams).sum()
    assert length <= 1.1 * 2 * np.pi * (0.65 + 0.35 + 1.0)


def test_faces_with_four_corners_and_edges_of_three_faces():
    vertices, quads = shapes.box_quads()
    assert (euler(quads, opening_seams(table_of((vertices, quads)), np.zeros(12, bool))) == 1).all()
    vertices, faces = shapes.with_fin(shapes.icosphere(2))
    table = table_of((vertices, faces))
    seams = unfolding_seams(table, np.zeros(len(table.edges), bool))
    assert (euler(faces, seams) == 1).all()

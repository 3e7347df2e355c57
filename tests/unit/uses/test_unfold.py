# SPDX-License-Identifier: GPL-3.0-or-later
"""Seams that open parts: every chart is a disc afterwards, and the seams are no longer than they need be."""

import numpy as np
import pytest
import shapes
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import connected_components

from core.surface.corners import CornerTable
from core.uses.unfold import opening_seams

SHAPES = {
    "sphere": lambda: shapes.icosphere(3), "torus": shapes.torus, "genus two": lambda: shapes.genus_two(0.09),
    "tree": shapes.tube_tree, "grid": lambda: shapes.flat_grid(8, 6), "two spheres": shapes.two_spheres,
}  # fmt: skip


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


@pytest.mark.parametrize("n_seeds", [1, 4, 9])
@pytest.mark.parametrize("name", SHAPES)
def test_every_chart_is_a_disc(name, n_seeds):
    vertices, faces = SHAPES[name]()
    cut = around(vertices, faces, n_seeds)
    seams = opening_seams(table_of((vertices, faces)), cut)
    assert not (seams & cut).any()
    assert (euler(faces, cut | seams) == 1).all()


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
    seams = opening_seams(table, np.zeros(len(table.edges), bool))
    assert seams.any()

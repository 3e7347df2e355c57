# SPDX-License-Identifier: GPL-3.0-or-later
"""Seams that open parts: every chart is a disc afterwards, and the seams are no longer than they need be."""

import numpy as np
import pytest
import shapes
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import connected_components

from core.uses.unfold import opening_seams

SHAPES = {
    "sphere": lambda: shapes.icosphere(3), "torus": shapes.torus, "genus two": lambda: shapes.genus_two(0.09),
    "tree": shapes.tube_tree, "grid": lambda: shapes.flat_grid(8, 6), "two spheres": shapes.two_spheres,
}  # fmt: skip


def topology(faces):
    """Edges, and edge and face of each corner."""
    sides = np.stack([faces, np.roll(faces, -1, axis=1)], axis=2).reshape(-1, 2)
    edges, corner_edge = np.unique(np.sort(sides, axis=1), axis=0, return_inverse=True)
    return edges, corner_edge.reshape(-1), np.repeat(np.arange(len(faces)), faces.shape[1])


def around(vertices, faces, n_seeds):
    """Edges between the parts of a mesh that lie nearest to some of its faces."""
    edges, corner_edge, corner_face = topology(faces)
    centers = vertices[faces].mean(axis=1)
    seeds = centers[np.random.default_rng(0).choice(len(centers), n_seeds, replace=False)]
    labels = np.linalg.norm(centers[:, None] - seeds[None], axis=2).argmin(axis=1)
    low, high = np.full(len(edges), len(faces)), np.full(len(edges), -1)
    np.minimum.at(low, corner_edge, labels[corner_face])
    np.maximum.at(high, corner_edge, labels[corner_face])
    return low < high


def euler(faces, cut):
    """Euler characteristic of each chart that the cuts leave, counted corner by corner."""
    edges, corner_edge, corner_face = topology(faces)
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
    seams = opening_seams(vertices, *topology(faces), cut)
    assert not (seams & cut).any()
    assert (euler(faces, cut | seams) == 1).all()


def test_a_flat_disc_needs_no_seam():
    vertices, faces = shapes.flat_grid(8, 6)
    assert not opening_seams(vertices, *topology(faces), around(vertices, faces, 1)).any()


def test_a_torus_is_opened_by_its_two_shortest_loops():
    vertices, faces = shapes.torus(48, 16, 1.0, 0.35)
    edges, corner_edge, corner_face = topology(faces)
    seams = opening_seams(vertices, edges, corner_edge, corner_face, np.zeros(len(edges), bool))
    length = np.linalg.norm(vertices[edges[seams, 0]] - vertices[edges[seams, 1]], axis=1).sum()
    assert length <= 1.1 * 2 * np.pi * (0.65 + 0.35 + 1.0)


def test_faces_with_four_corners_and_edges_of_three_faces():
    vertices, quads = shapes.box_quads()
    assert (euler(quads, opening_seams(vertices, *topology(quads), np.zeros(12, bool))) == 1).all()
    vertices, faces = shapes.with_fin(shapes.icosphere(2))
    seams = opening_seams(vertices, *topology(faces), np.zeros(len(topology(faces)[0]), bool))
    assert seams.any()

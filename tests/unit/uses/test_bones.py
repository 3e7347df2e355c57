# SPDX-License-Identifier: GPL-3.0-or-later
"""Bones of parts, on parts small enough to see the answer."""

import numpy as np
import pytest

from core.surface.corners import CornerTable
from core.uses.bones import part_bones


def bones(centers, cuts, joints, line=(), line_part=(), height=None, length=None):
    """Parts of one face each, with the given middles; an edge of the given middle and length at each cut."""
    count = len(centers)
    height = np.arange(count, dtype=float) if height is None else height
    vertices, edges, at_vertex = [], [], []
    corners = [[] for _ in range(count)]  # of each face: vertex, edge
    for cut, joint, size in zip(cuts, joints, length or np.ones(len(cuts)), strict=True):
        ends = len(vertices), len(vertices) + 1
        vertices += [np.add(joint, (0, 0, size / 2)), np.add(joint, (0, 0, -size / 2))]
        at_vertex += [0.0, 0.0]
        edges.append(ends)
        for face in cut:
            corners[face] += [(ends[0], len(edges) - 1), (ends[1], len(edges))]
        edges.append(ends[::-1])
    for face, center in enumerate(centers):  # one more vertex brings the middle and the height to where they should be
        n = len(corners[face]) + 1
        vertices.append(n * np.array(center, float) - sum((vertices[v] for v, _ in corners[face]), np.zeros(3)))
        at_vertex.append(n * height[face])
        corners[face].append((len(vertices) - 1, len(edges)))
        edges.append((len(vertices) - 1, len(vertices) - 1))
    vertex, edge = np.array([corner for face in corners for corner in face]).T
    face = np.repeat(np.arange(count), [len(found) for found in corners])
    table = CornerTable(np.array(vertices), np.array(edges), vertex, edge, face, count)
    return part_bones(table, np.arange(count), np.ones(count), np.array(at_vertex),
                      np.array(line, float).reshape(-1, 3), np.array(line_part, int))


def test_an_arm_of_three_parts_is_a_chain():
    """Body, upper arm, lower arm along x: each bone ends where the next begins."""
    made = bones([(0, 0, 0), (3, 0, 0), (5, 0, 0)], [(0, 1), (1, 2)], [(2, 0, 0), (4, 0, 0)],
                 line=[(5, 0, 0), (6, 0, 0)], line_part=[2, 2])
    assert made.parent.tolist() == [-1, 0, 1]
    assert made.head.tolist() == [[0, 0, 0], [2, 0, 0], [4, 0, 0]]
    assert made.tail.tolist() == [[2, 0, 0], [4, 0, 0], [6, 0, 0]]
    assert made.connected.tolist() == [False, True, True]


def test_the_body_is_the_lowest_part():
    made = bones([(0, 0, 0), (3, 0, 0)], [(0, 1)], [(2, 0, 0)], height=[1, 0])
    assert made.parent.tolist() == [1, -1]


def test_a_palm_ends_amid_its_fingers():
    """Body, palm, two fingers: the fingers do not hang at the end of the palm's bone."""
    made = bones([(0, 0, 0), (3, 0, 0), (5, 1, 0), (5, -1, 0)], [(0, 1), (1, 2), (1, 3)],
                 [(2, 0, 0), (4, 1, 0), (4, -1, 0)])
    assert made.tail[1].tolist() == [4, 0, 0]
    assert made.connected.tolist() == [False, True, False, False]
    # Without a center line a bone goes through the middle of its part.
    assert made.tail[2].tolist() == [6, 1, 0]


def test_of_a_ring_of_parts_the_shortest_cut_is_no_joint():
    made = bones([(0, 0, 0), (1, 0, 0), (1, 1, 0)], [(0, 1), (1, 2), (0, 2)],
                 [(0.5, 0, 0), (1, 0.5, 0), (0.5, 0.5, 0)], length=[3, 2, 1])
    assert made.parent.tolist() == [-1, 0, 1]


def test_loose_parts_have_no_parent_and_no_bone_is_without_length():
    made = bones([(0, 0, 0), (9, 0, 0)], [], [])
    assert made.parent.tolist() == [-1, -1]
    assert np.linalg.norm(made.tail - made.head, axis=1) == pytest.approx(0.09)


def test_joints_are_weighted_by_the_length_of_their_edges():
    made = bones([(0, 0, 0), (4, 0, 0)], [(0, 1), (0, 1)], [(2, 0, 0), (2, 4, 0)], length=[3, 1])
    assert made.head[1].tolist() == [2, 1, 0]

# SPDX-License-Identifier: GPL-3.0-or-later
"""The faces beside a closed curve, which a cap follows where it cannot go straight across."""

import numpy as np
import pytest
import shapes

from core.uses.caps.sleeves import sleeve


@pytest.fixture
def ball():
    """A ball cut at its equator: vertices, triangles, labels 0 below and 1 above, and the rim in order."""
    vertices, faces = shapes.icosphere(3)
    labels = (vertices[faces].mean(axis=1)[:, 2] > 0).astype(np.int64)
    return vertices, faces, labels, rim_of(faces, labels)


def rim_of(faces, labels):
    """The vertices round the one border between two labels, in the direction of the faces labelled 1."""
    directed = {(a, b) for face in faces[labels == 0].tolist() for a, b in edges_of(face)}
    after = {a: b for face in faces[labels == 1].tolist() for a, b in edges_of(face) if (b, a) in directed}
    rim = [min(after)]
    while after[rim[-1]] != rim[0]:
        rim.append(after[rim[-1]])
    assert len(rim) == len(after)
    return np.array(rim)


def edges_of(face):
    return list(zip(face, [*face[1:], face[0]], strict=True))


def directed_edges(triangles):
    return [edge for triangle in triangles.tolist() for edge in edges_of(triangle)]


@pytest.mark.parametrize("side", [0, 1])
@pytest.mark.parametrize("rings", [1, 3])
def test_a_ring_lies_between_the_rim_and_its_end(ball, side, rings):
    vertices, faces, labels, rim = ball
    found = sleeve(len(vertices), faces, labels, rim, side, rings)
    edges = directed_edges(found.triangles)
    assert len(set(edges)) == len(edges)
    alone = {(a, b) for a, b in edges if (b, a) not in set(edges)}
    around = set(zip(rim.tolist(), np.roll(rim, -1).tolist(), strict=True))
    around = around if side else {(b, a) for a, b in around}
    assert alone == around | set(zip(found.end.tolist(), np.roll(found.end, -1).tolist(), strict=True))
    assert not set(found.end) & set(rim)
    own = {tuple(sorted(face)) for face in faces[labels == side].tolist()}
    whole = {tuple(sorted(face)) for face in found.triangles.tolist() if max(face) < len(vertices)}
    assert whole <= own


@pytest.mark.parametrize("side", [0, 1])
def test_all_of_a_side_is_a_disc_without_end_and_no_edge_joins_the_rim(ball, side):
    vertices, faces, labels, rim = ball
    found = sleeve(len(vertices), faces, labels, rim, side, 1000)
    assert not len(found.end)
    places = np.concatenate([vertices, vertices[found.split].mean(axis=1)])
    areas = [np.linalg.norm(np.cross(b - a, c - a), axis=1).sum() for a, b, c in
             (places[found.triangles].transpose(1, 0, 2), vertices[faces[labels == side]].transpose(1, 0, 2))]
    assert areas[0] == pytest.approx(areas[1])
    around = set(zip(rim.tolist(), np.roll(rim, -1).tolist(), strict=True))
    on = set(rim.tolist())
    joining = {(a, b) for a, b in directed_edges(found.triangles) if a in on and b in on}
    assert joining <= around | {(b, a) for a, b in around}


def test_edges_between_points_of_the_rim_are_halved():
    """A square of four triangles round a middle, and one of two: its diagonal joins two corners."""
    faces = np.array([[0, 1, 2], [0, 2, 3], [1, 0, 4], [2, 1, 4], [3, 2, 4], [0, 3, 4]])
    labels = np.array([0, 0, 1, 1, 1, 1])
    found = sleeve(5, faces, labels, np.arange(4), 0, 1)
    assert found.split.tolist() == [[0, 2]]
    assert sorted(sorted(triangle) for triangle in found.triangles.tolist()) == [
        [0, 1, 5], [0, 3, 5], [1, 2, 5], [2, 3, 5]]
    assert not len(found.end)


def test_what_is_neither_a_ring_nor_a_disc_is_none(ball):
    """A tube's wall that ends at another cut, and a curve that is no border of the part."""
    vertices, faces, labels, rim = ball
    height = vertices[faces].mean(axis=1)[:, 2]
    three = labels + (height > 0.6)
    assert sleeve(len(vertices), faces, three, rim, 1, 1000) is not None  # up to the other cut, where it ends
    holes = three.copy()
    holes[(height > 0.2) & (height < 0.4) & (vertices[faces].mean(axis=1)[:, 0] > 0.6)] = 2
    assert sleeve(len(vertices), faces, holes, rim, 1, 1000) is None
    assert sleeve(len(vertices), faces, labels, rim, 2, 3) is None

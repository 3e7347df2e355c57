# SPDX-License-Identifier: GPL-3.0-or-later
"""Scenes of many things in one mesh: each has parts of its own."""

import numpy as np
import pytest
import shapes
from results import same_partition

from core import decompose


@pytest.mark.parametrize("gap", [0.2, 3.0])
def test_things_that_stand_in_a_row_are_parts_of_their_own(gap):
    """The row is so long that less than 3 % of it is between them."""
    things = [shapes.moved(shape, (k * (2 + gap), 0, 0)) for k, shape in enumerate(
        [shapes.icosphere(2), shapes.subdivide(shapes.box((2, 1, 1))), shapes.torus(16, 8, 0.7, 0.3)] * 8)]
    thing = np.repeat(np.arange(len(things)), [len(shape.faces) for shape in things])
    result = decompose(*shapes.together(*things))
    label = result.parts().labels
    for part in range(label.max() + 1):
        assert len(set(thing[label == part])) == 1
    assert result.parts(detail=0).labels.max() == 0


def test_a_small_thing_of_several_pieces_is_one_part():
    """Each of its pieces was one, of things that are below 1 % of the area."""
    things = []
    for k in range(121):
        foot, top = shapes.box((1, 1 + 0.01 * k, 0.3)), shapes.box((0.4, 0.4, 1.5))
        things.append(shapes.together(foot, shapes.moved(top, (0, 0, 0.3 + 0.001 * (k % 3)))))
    things = [shapes.moved(thing, (4 * (k % 11), 4 * (k // 11), 0)) for k, thing in enumerate(things)]
    thing = np.repeat(np.arange(len(things)), [len(shape.faces) for shape in things])
    result = decompose(*shapes.together(*things))
    assert same_partition(result.parts().labels, thing)
    assert "121 small bodies are one part each." in map(str, result.notes)
    assert result.parts(detail=1).labels.max() + 1 == 2 * len(things)
    assert result.parts(detail=0).labels.max() == 0
    contacts = result.contacts[:len(result.contacts) - len(result.links)]
    assert thing[contacts[:, 0]].tolist() == thing[contacts[:, 1]].tolist()
    assert sorted(thing[contacts[:, 0]]) == list(range(len(things)))


def test_a_scene_may_have_thousands_of_things():
    """Of more than two thousand none had a part for itself."""
    things = [shapes.moved(shapes.box((1, 1 + 0.3 * (k % 5), 1)), (1.5 * (k % 50), 3 * (k // 50), 0))
              for k in range(2_100)]
    result = decompose(*shapes.together(*things))
    assert same_partition(result.parts().labels, np.repeat(np.arange(len(things)), 12))


def test_the_leaves_of_a_hedge_are_no_scene():
    """A thousand cards in a ball, some of which touch, were 887 parts."""
    rng = np.random.default_rng(0)
    n, size = 1_000, 0.03
    middle, along, about = rng.normal(size=(3, n, 3))
    middle *= 0.5 * rng.random((n, 1)) ** (1 / 3) / np.linalg.norm(middle, axis=1, keepdims=True)
    along *= size / np.linalg.norm(along, axis=1, keepdims=True)
    across = np.cross(along, about)
    across *= size / 2 / np.linalg.norm(across, axis=1, keepdims=True)
    corners = [middle - along - across, middle + along - across, middle + along + across, middle - along + across]
    faces = 4 * np.arange(n)[:, None] + np.array([0, 1, 2, 0, 2, 3])
    result = decompose(np.stack(corners, axis=1).reshape(-1, 3), faces.reshape(-1, 3),
                       polygon=np.repeat(np.arange(n), 2))
    assert result.parts().count == 1

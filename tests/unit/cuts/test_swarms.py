# SPDX-License-Identifier: GPL-3.0-or-later
"""Which pieces are a swarm, and how its members merge."""

import numpy as np
import pytest

from core.cuts.face_candidates import FaceCandidates
from core.cuts.hierarchy import LAST, Hierarchy
from core.cuts.swarms import ALIKE, LEAST, NEAR, SALIENCE, SHAPE, SMALL, THIN, find_swarms, joined_swarms
from core.mesh.face_graph import FaceGraph
from core.mesh.triangles import TriMesh

BODY = 1.0 / SMALL  # area of a piece beside which what has an area of 1 is just small enough


def in_a_row(count, step=1.0):
    """Middles at equal steps, and before them that of a large piece."""
    return np.stack([np.arange(-1, count) * step, np.zeros(count + 1), np.zeros(count + 1)], axis=1)


def swarms_of_row(areas, step=1.0, body=BODY):
    """The swarms of pieces in a row beside a large one, which is in none."""
    swarm = find_swarms(np.array([body, *areas]), in_a_row(len(areas), step), np.ones((len(areas) + 1, 3)), body)
    assert swarm[0] == -1
    return swarm[1:].tolist()


@pytest.mark.parametrize("count", [LEAST - 1, LEAST, 40])
def test_so_many_are_a_swarm(count):
    assert swarms_of_row(np.ones(count)) == [0 if count >= LEAST else -1] * count


@pytest.mark.parametrize(("step", "found"), [(NEAR, True), (1.001 * NEAR, False)])
def test_members_are_near_each_other_for_their_size(step, found):
    assert swarms_of_row(np.ones(10), step) == [0 if found else -1] * 10
    assert swarms_of_row(0.25 * np.ones(10), step / 2) == [0 if found else -1] * 10


@pytest.mark.parametrize(("more", "found"), [(ALIKE, True), (1.001 * ALIKE, False)])
def test_members_are_alike(more, found):
    areas = np.append(np.ones(LEAST) / ALIKE, more / ALIKE)
    assert swarms_of_row(areas)[-1] == (0 if found else -1)


@pytest.mark.parametrize(("factor", "found"), [(SHAPE, True), (1.001 * SHAPE, False)])
@pytest.mark.parametrize("axis", range(3))
def test_members_have_one_shape(axis, factor, found):
    extent = np.full((LEAST + 2, 3), 0.2)
    extent[-1, axis] = np.exp(factor) * (0.2 + THIN) - THIN
    swarm = find_swarms(np.array([BODY, *np.ones(LEAST + 1)]), in_a_row(LEAST + 1), extent, BODY)
    assert swarm.tolist() == [-1, *[0] * LEAST, 0 if found else -1]


def test_members_are_small_beside_a_body():
    assert swarms_of_row(np.ones(10), body=0.999 * BODY) == [-1] * 10
    assert find_swarms(np.ones(20), in_a_row(19), np.ones((20, 3)), 1.0).tolist() == [-1] * 20  # a heap
    assert swarms_of_row([*np.ones(LEAST), *np.zeros(3)])[-3:] == [-1] * 3  # nothing has no size


def test_two_swarms_are_apart_from_each_other():
    center = np.concatenate([in_a_row(9), in_a_row(10)[1:] + [0.0, 1000.0, 0.0]])
    found = find_swarms(np.append(BODY, np.ones(19)), center, np.ones((20, 3)), BODY)
    assert len(set(found[1:10])) == len(set(found[10:])) == 1
    assert len(set(found)) == 3


def test_of_a_crowd_not_all_pairs_are_looked_at():
    rng = np.random.default_rng(0)
    center = rng.random((20_000, 3))  # each of the size of all of them
    found = find_swarms(np.append(BODY, np.ones(len(center))), np.concatenate([[[9.0, 0.0, 0.0]], center]),
                        np.ones((len(center) + 1, 3)), BODY)
    assert np.bincount(found[1:]).max() == len(center)


# A large piece of two triangles and ten small ones, the first of two triangles, all in a row; each is a candidate.
PIECE = np.array([0, 0, 1, 1, *range(2, 11)])
AREA = np.array([BODY, BODY, 0.5, 0.5, *np.ones(9)])
EDGES = np.array([(0, 1), (2, 3)])
CUTS = [(2, 3), (0, 1)]
CHAIN = np.array([(1, 2), *((k, k + 1) for k in range(3, 12))])  # contacts from piece to piece


def joined(merges, salience):
    """What becomes of candidates in a row that merge so."""
    corner = np.array([(0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (0.0, 1.0, 0.0)])
    at = PIECE[:, None, None] * np.array([1.0, 0.0, 0.0])
    mesh = TriMesh((at + np.sqrt(2 * AREA)[:, None, None] * corner).reshape(-1, 3), np.arange(39).reshape(-1, 3))
    candidates = FaceCandidates(FaceGraph(13, EDGES, np.ones(2), AREA), CHAIN, np.arange(13),
                                Hierarchy.of(13, merges, salience))
    return joined_swarms(candidates, mesh, np.arange(13))


def test_members_merge_first_within_and_then_with_each_other():
    found = joined([*CUTS, *CHAIN], [0.7, 0.8, *np.full(10, LAST)])
    hierarchy = found.hierarchy
    assert found.label.tolist() == list(range(13))
    assert hierarchy.salience.tolist() == [SALIENCE] * 10 + [0.8, LAST]
    assert set(hierarchy.merges[0].tolist()) == {2, 3}
    assert hierarchy.parts(3).tolist() == [0, 1] + [2] * 11
    assert hierarchy.parts(2).tolist() == [0, 0] + [1] * 11
    assert found.contacts[:10].tolist() == CHAIN.tolist()
    # They hang together by the contacts that are new.
    assert len(found.contacts) == 10 + 9
    new = found.contacts[10:]
    assert sorted(np.unique(PIECE[new])) == list(range(1, 11))


def test_members_that_are_one_with_something_else_stay_with_it():
    # The first three small pieces are one part with half of the large one, and the last two with each other.
    first = [(1, 2), (2, 3), (3, 4), (4, 5), (11, 12), (0, 1)]
    found = joined([*first, *CHAIN[3:]], [0.1, 0.1, 0.2, 0.2, 0.3, 0.8, *np.full(7, LAST)])
    assert found.hierarchy.parts_at(0.5).tolist() == [0, *[1] * 5, *[2] * 7]
    assert found.hierarchy.parts_at(0.65).tolist() == [0, *[1] * 5, 2, 3, 4, 5, 6, 7, 7]


def test_nothing_changes_where_none_stands_alone():
    merges = [*CHAIN.tolist(), *(list(pair) for pair in CUTS)]
    found = joined(merges, np.full(12, 0.1))  # all of them are one part
    assert found.contacts.tolist() == CHAIN.tolist()
    assert found.hierarchy.merges.tolist() == merges

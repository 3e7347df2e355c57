# SPDX-License-Identifier: GPL-3.0-or-later
"""Weights with which bones move a surface: smooth across every joint, as far as the joint is thick."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from operator import itemgetter

import numpy as np
from scipy.sparse import csr_array, diags_array, eye_array
from scipy.sparse.csgraph import dijkstra
from scipy.spatial.transform import Rotation

from ...arrays.indexing import bounds_of_each, largest_of_each
from ...arrays.int64 import arange, full
from ...arrays.pairs import distinct_pairs, symmetric_matrix
from ...arrays.systems import solved
from ...arrays.vectors import across, lengths
from ...mesh.corners import CornerTable
from ...mesh.cut_edges import CutEdges
from ..maps.conformal import ConformalFactor
from .bone_trees import following
from .bones import Bones

# Ways to weights, tried in turn until none turns a face over. The first number: weights change within so many radii of
# a joint on either side. A joint of radius r that is bent by the angle t shortens its inner side by t r; so that no
# face turns over there, the weights must not change faster than 1 / (t r). The second: the share of a vertex's fifth
# largest weight that is taken from all its weights, so that none of the four that are kept begins with a step.
WAYS = ((1.6, 0.0), (1.6, 1.0), (2.4, 0.0), (1.2, 1.0))
# In each round, faces that turned over in the one before, and those around them, resist a change of weights so many
# times as much as they did. A way is left when so many rounds brought nothing better.
_STIFFER, _PATIENCE = 4.0, 4
# Where a part ends within reach, its farthest tenth has the weight that the distance gives it: there is nothing else
# that holds it.
_TIP = 0.9
#: The angle at which no face should be turned over, in radians.
BENT = np.pi / 3
#: How many bones may move a vertex; what game engines take.
MOST_BONES = 4
_LITTLE = 1e-9  # share of a weight that stays at least when the fifth is taken from it, so that none of the four is 0
_HOLD = 1e-9  # how strongly a share is held where nothing else does, beside what surfaces do
_NEEDLE = 0.5e-6  # area of a needle over the square of its length
_STEPS = 1024  # weights are multiples of 1 / _STEPS


@dataclass(frozen=True, eq=False)
class Weights:
    """What moves each of n vertices.

    Attributes
    ----------
    bone : (n, 4) int64
        The largest weight first; -1 for none, and everywhere for a vertex of no face.
    weight : (n, 4) float64
        Multiples of 1/1024 whose sum is 1; 0 where there is no bone.
    """

    bone: np.ndarray
    weight: np.ndarray

    def of_bones(self, count: int) -> np.ndarray:
        """The weight of each of so many bones at each vertex, (n, count)."""
        every = np.zeros((len(self.bone), count))
        vertex, place = np.nonzero(self.bone >= 0)
        every[vertex, self.bone[vertex, place]] = self.weight[vertex, place]
        return every


def smooth_weights(table: CornerTable, labels: np.ndarray, bones: Bones) -> Weights:
    """Find weights that change smoothly across each joint.

    A joint divides the parts of a tree of bones into those beyond, which are those of its bone and of the bones that
    follow it, and all others. The share of a vertex that goes beyond is harmonic between the two distances from the
    border, 1.6 times its radius, at which all or nothing does. A vertex near several joints goes beyond in
    proportion to the odds of each. Where bending a joint by 60 degrees turns a face over, the surface is made stiffer
    and the weights are found again, so that they change elsewhere; of all weights found, those that turn over the
    fewest faces are kept. Border vertices at one place have the same weights.

    Parameters
    ----------
    table : CornerTable
        n vertices.
    labels : (p,) int64
        Bone of each face, 0..count-1.
    bones : Bones
        In the coordinates of the table.

    Returns
    -------
    weights : Weights
    """
    table, first = table.joined()
    tries = _tries(table, labels, bones)
    best, fewest = next(tries)
    while fewest and (found := next(tries, None)):
        best, fewest = min((best, fewest), found, key=itemgetter(1))
    return Weights(best.bone[first], best.weight[first])


@dataclass(frozen=True, eq=False)
class _Joint:
    """The part of a surface around a joint on which weights change.

    bone : int. near : (k,) int64, vertices within reach of the border. depth : (k,) float64, their distance from it
    over the reach. side : (n,) int8, of all vertices, 1 beyond the border, -1 on this side, 0 on it. goes_on : for
    these sides, by 1 and -1, whether the surface goes on past the reach.
    """

    bone: int
    near: np.ndarray
    depth: np.ndarray
    side: np.ndarray
    goes_on: dict[int, bool]

    def odds(self, laplacian: csr_array) -> np.ndarray:
        """The odds that each vertex goes beyond, (n,): by a share that is harmonic near the joint."""
        share, side = 0.5 + 0.5 * self.side, self.side[self.near]
        share[self.near] = 0.5 + 0.5 * side * self.depth
        free = np.ones(len(self.near), bool)
        for sign in (-1, 1):
            deepest = np.max(self.depth, where=side == sign, initial=0.0)
            free &= (side != sign) | (self.depth < _TIP * deepest) | (deepest >= _TIP and self.goes_on[sign])
        inside = self.near[free]
        if len(inside):
            known, rows = share.copy(), laplacian[inside]
            known[inside] = 0.0
            share[inside] = _harmonic(rows[:, inside], -(rows @ known), share[inside]).clip(0.0, 1.0)
        share = 0.5 * share + 0.5 * share**2 * (3 - 2 * share)  # less of a crease where the change begins and ends
        return share / np.maximum(1 - share, 1e-9)


def _harmonic(matrix: csr_array, right: np.ndarray, guess: np.ndarray) -> np.ndarray:
    """Solve a Laplacian system, (k,); what hangs on nothing that is known, as faces without an area, keeps a guess."""
    try:
        return solved(matrix, right)
    except RuntimeError:  # of SciPy: the matrix is singular
        little = _HOLD * max(abs(matrix).max(), np.finfo(float).tiny)
        return solved(matrix + little * eye_array(len(right), format="csr"), right + little * guess)


@dataclass(frozen=True, eq=False)
class _Shares:
    """Vertices, (k,) int64, each once, and a number of each that is not 0, (k,) float64."""

    vertex: np.ndarray
    share: np.ndarray

    @classmethod
    def of(cls, every: np.ndarray) -> _Shares:
        """Those that are not 0 of the numbers of all vertices, (n,)."""
        vertex = np.flatnonzero(every)
        return cls(vertex, every[vertex])

    def at(self, place: np.ndarray) -> _Shares:
        """The same under other numbers of the vertices, (n,) int64; -1 for vertices that are left out."""
        there = place[self.vertex]
        return _Shares(there[there >= 0], self.share[there >= 0])


_NOWHERE = _Shares(np.empty(0, np.int64), np.empty(0))


def _joints(table: CornerTable, labels: np.ndarray, bones: Bones, reach: float) -> list[_Joint]:
    """The joints of all bones. reach : how far the weights change, in radii of a joint."""
    n = len(table.vertices)
    length = np.maximum(table.edge_length(arange(len(table.edges))), 1e-12 * np.ptp(table.vertices, axis=0).max())
    graph, beyond = symmetric_matrix(table.edges, length, n), following(bones.parent, bones.order)
    cuts = CutEdges.of(table, labels)
    at, own = distinct_pairs(table.corner_vertex, labels[table.corner_face])[0].T
    joints = []
    for bone in np.flatnonzero(bones.parent >= 0).tolist():
        inside, side = beyond[bone], np.full(n, -1, np.int8)
        side[at[inside[own]]] = 1
        border = np.unique(table.edges[cuts.around(inside)])
        if not len(border):  # it hangs on what it does not touch
            joints.append(_Joint(bone, border, np.empty(0), side, {1: False, -1: False}))
            continue
        far = reach * np.linalg.norm(table.vertices[border] - bones.head[bone], axis=1).max()
        side[border] = 0
        distance = dijkstra(graph, directed=False, indices=border, min_only=True, limit=far)
        near = np.flatnonzero(distance < far)
        inner = (distance < far)[table.edges]
        last = side[table.edges[inner & ~inner[:, ::-1]]]  # of the vertices from which an edge leads out of reach
        joints.append(_Joint(bone, near, distance[near] / max(far, np.finfo(float).tiny), side,
                             {sign: bool((last == sign).any()) for sign in (1, -1)}))
    return joints


def _tries(table: CornerTable, labels: np.ndarray, bones: Bones) -> Iterator[tuple[Weights, int]]:
    """Weights of all WAYS and rounds, each with how many faces they turn over."""
    laplacian = ConformalFactor.of(table).laplacian
    for reach, fifth in WAYS:
        joints, stiffness = _joints(table, labels, bones, reach), np.zeros(table.n_faces)
        odds, stale = [_NOWHERE] * len(bones.parent), joints
        fewest, since = np.inf, 0
        while since < _PATIENCE:
            stiff = _stiffened(laplacian, table, stiffness)
            for joint in stale:
                odds[joint.bone] = _Shares.of(joint.odds(stiff))
            found = _limited(*_of_odds(table, labels, bones, odds), len(table.vertices), fifth)
            turned = _turned(table, found, bones)
            count = int(turned.sum())
            yield found, count
            fewest, since = min(fewest, count), 0 if count < fewest else since + 1
            around = table.faces_at(table.vertices_of(turned))
            stiffness[around] = np.maximum(_STIFFER * stiffness[around], 1.0)
            changed = table.vertices_of(around)
            stale = [joint for joint in joints if changed[joint.near].any()]


def _stiffened(laplacian: csr_array, table: CornerTable, stiffness: np.ndarray) -> csr_array:
    """The matrix with a spring at each edge, as stiff as the stiffer of its faces, (p,) float64."""
    spring = largest_of_each(table.corner_edge, stiffness[table.corner_face], len(table.edges))
    some = np.flatnonzero(spring)
    springs = symmetric_matrix(table.edges[some], spring[some], len(table.vertices))
    return laplacian + diags_array(springs.sum(axis=1)).tocsr() - springs


def _of_odds(table: CornerTable, labels: np.ndarray, bones: Bones,
             odds: Sequence[_Shares]) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """What share of which vertex which bone moves, where it goes beyond the bone's joint with such odds.

    Returns vertices and bones, (k,) int64, and shares, (k,) float64. Most bones move most vertices not at all, and an
    array of all bones at all vertices would be gigabytes where there are thousands of bones.
    """
    children = [np.flatnonzero(bones.parent == bone).tolist() for bone in range(len(bones.parent))]
    mass, place = _roots(table, labels, bones), full(len(table.vertices), -1)
    for bone in bones.order:
        own = mass[bone]
        place[own.vertex] = arange(len(own.vertex))
        taken = [odds[child].at(place) for child in children[bone]]
        total = np.zeros(len(own.vertex))
        for some in taken:
            total[some.vertex] += some.share
        mass[bone] = left = _Shares(own.vertex, own.share / (1 + total))
        for child, some in zip(children[bone], taken, strict=True):
            mass[child] = _Shares(own.vertex[some.vertex], left.share[some.vertex] * some.share)
        place[own.vertex] = -1
    mover = np.repeat(arange(len(mass)), [len(some.vertex) for some in mass])
    return np.concatenate([some.vertex for some in mass]), mover, np.concatenate([some.share for some in mass])


def _turned(table: CornerTable, weights: Weights, bones: Bones) -> np.ndarray:
    """Which faces some bone turns over when it is bent at its joint, (p,) bool."""
    beyond, turned = following(bones.parent, bones.order), np.zeros(table.n_faces, bool)
    for bone in np.flatnonzero(bones.parent >= 0).tolist():
        along = bones.tail[bone] - bones.head[bone]
        share = np.where(beyond[bone][weights.bone], weights.weight, 0.0).sum(axis=1)  # 0 where there is no bone
        turned |= turned_over(table, share, bones.head[bone], along, BENT)
    return turned


def limited(mass: np.ndarray) -> Weights:
    """Keep the four largest weights of each vertex.

    mass : (n, count) float64, 0 or more; what share of a vertex each bone moves, in any unit. Returns Weights.
    """
    vertex, bone = np.nonzero(mass)
    return _limited(vertex, bone, mass[vertex, bone], len(mass), 0.0)


def _limited(vertex: np.ndarray, bone: np.ndarray, mass: np.ndarray, n: int, fifth: float) -> Weights:
    """What ``limited`` returns, of what is not 0; of equal weights it keeps those of the first bones.

    vertex, bone : (k,) int64, no pair twice. mass : (k,) float64. n : how many vertices there are. fifth : the share of
    the fifth largest that is taken from each of them; of four that are hardly larger, little less than all.
    """
    if fifth:
        order, rank = _ranked(vertex, bone, mass)
        largest = np.zeros(n)
        at_rank = order[rank == MOST_BONES]
        largest[vertex[at_rank]] = mass[at_rank]
        mass = np.maximum(mass - fifth * largest[vertex], _LITTLE * mass)
    order, rank = _ranked(vertex, bone, mass)
    order, rank = order[rank < MOST_BONES], rank[rank < MOST_BONES]
    mover, weight = full((n, MOST_BONES), -1), np.zeros((n, MOST_BONES))
    mover[vertex[order], rank], weight[vertex[order], rank] = bone[order], mass[order]
    weight /= np.maximum(weight.sum(axis=1, keepdims=True), np.finfo(float).tiny)
    # Such multiples add up exactly; what rounding leaves goes to the largest.
    weight = np.round(_STEPS * weight) / _STEPS
    moved = mover[:, 0] >= 0
    weight[moved, 0] += 1 - weight[moved].sum(axis=1)
    mover[weight <= 0] = -1
    return Weights(mover, weight)


def _ranked(vertex: np.ndarray, bone: np.ndarray, mass: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """The order by vertices, of each the largest first, and the place of each among those of its vertex; (k,) int64."""
    order = np.lexsort((bone, -mass, vertex))
    sorted_vertex = vertex[order]
    return order, arange(len(order)) - np.searchsorted(sorted_vertex, sorted_vertex)


def stiff_weights(table: CornerTable, labels: np.ndarray) -> Weights:
    """Weights with which each part moves as a whole: a vertex on a cut goes with all that meet there.

    table : CornerTable. labels : (p,) int64, bone of each face. Returns Weights.
    """
    vertex, bone = distinct_pairs(table.corner_vertex, labels[table.corner_face])[0].T
    return _limited(vertex, bone, np.ones(len(vertex)), len(table.vertices), 0.0)


def of_half(weights: Weights, on_plane: np.ndarray, twin: np.ndarray) -> Weights:
    """The weights of a half model, from those of the whole.

    Parameters
    ----------
    weights : Weights
        Of the whole; its first n vertices are those of the half.
    on_plane : (n,) bool
        These vertices are their own images: they go with both bones of a pair alike.
    twin : (count,) int64
        The mirror image of each bone, itself if it is its own.

    Returns
    -------
    weights : Weights
    """
    bone, weight = weights.bone[: len(on_plane)].copy(), weights.weight[: len(on_plane)].copy()
    mass = Weights(bone[on_plane], weight[on_plane]).of_bones(len(twin))
    even = limited(mass + mass[:, twin])
    bone[on_plane], weight[on_plane] = even.bone, even.weight
    return Weights(bone, weight)


def turned_over(
    table: CornerTable, share: np.ndarray, joint: np.ndarray, along: np.ndarray, angle: float
) -> np.ndarray:
    """Tell which faces are turned over when a joint is bent, to four sides.

    A face is turned over if it looks against the direction in which the average of its corners' motions turns it. A
    needle whose height is a millionth of its length or less looks nowhere.

    Parameters
    ----------
    table : CornerTable
        n vertices, p faces.
    share : (n,) float64
        Share of each vertex that the bone moves.
    joint, along : (3,) float64
        Place of the joint and direction of the bone.
    angle : float
        In radians.

    Returns
    -------
    turned : (p,) bool
    """
    turned = np.zeros(table.n_faces, bool)
    changing = share[table.edges[:, 0]] != share[table.edges[:, 1]]
    if not changing.any():  # most bones move most of a surface not at all, or as a whole
        return turned
    near = np.zeros(table.n_faces, bool)
    near[table.corner_face[changing[table.corner_edge]]] = True
    table = table.within(near)
    low, high = bounds_of_each(table.corner_face, share[table.corner_vertex], table.n_faces)
    some = _of_area(table.within(high - low > 1e-6))
    size = np.bincount(some.corner_face, minlength=table.n_faces)
    faces = np.flatnonzero(size)
    average = (np.bincount(some.corner_face, share[some.corner_vertex], table.n_faces)[faces] / size[faces])[:, None]
    before = some.face_vectors()[faces]
    for turn in bends(along, angle):
        moved = share[:, None] * ((table.vertices - joint) @ (turn - np.eye(3)).T)
        after = replace(some, vertices=table.vertices + moved).face_vectors()[faces]
        # The cofactors of (1 - a) I + a R, which turn vector areas, are (1 - a)^2 I + a^2 R + a (1 - a) (tr R I - R^T).
        mixed = np.trace(turn) * before - before @ turn
        expected = (1 - average) ** 2 * before + average**2 * (before @ turn.T) + average * (1 - average) * mixed
        turned[faces] |= (expected * after).sum(axis=1) < 0
    return turned


def _of_area(table: CornerTable) -> CornerTable:
    """The table without needles."""
    length = table.edge_length(arange(len(table.edges)))
    longest = largest_of_each(table.corner_face, length[table.corner_edge], table.n_faces)
    return table.within(lengths(table.face_vectors()) > _NEEDLE * longest**2)


def bends(along: np.ndarray, angle: float) -> list[np.ndarray]:
    """Rotations, (3, 3), by an angle in radians about four axes at right angles to a direction, (3,)."""
    direction = along / max(float(np.linalg.norm(along)), np.finfo(float).tiny)
    first = across(direction)
    second = np.cross(direction, first)
    return list(Rotation.from_rotvec(angle * np.stack([first, second, -first, -second])).as_matrix())


def _roots(table: CornerTable, labels: np.ndarray, bones: Bones) -> list[_Shares]:
    """The vertices of each tree of bones, whole, at its root, and nothing at the other bones; of several the first."""
    root = arange(len(bones.parent))
    for bone in bones.order:
        if bones.parent[bone] >= 0:
            root[bone] = root[bones.parent[bone]]
    of_vertex = full(len(table.vertices), len(root))
    np.minimum.at(of_vertex, table.corner_vertex, root[labels[table.corner_face]])
    order = np.argsort(of_vertex, kind="stable")
    first = np.searchsorted(of_vertex[order], arange(len(root) + 1))
    trees = [order[start:end] for start, end in zip(first[:-1].tolist(), first[1:].tolist(), strict=True)]
    return [_Shares(tree, np.ones(len(tree))) for tree in trees]

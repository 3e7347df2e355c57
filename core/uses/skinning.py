# SPDX-License-Identifier: GPL-3.0-or-later
"""Weights with which bones move a surface: smooth across every joint, as far as the joint is thick."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.sparse import csr_array
from scipy.sparse.csgraph import dijkstra
from scipy.spatial.transform import Rotation

from ..surface.arrays import symmetric_matrix
from ..surface.corners import CornerTable
from .bones import Bones, following
from .conformal import ConformalFactor, solved

# Weights change within this many radii of a joint on either side. A joint of radius r that is bent by the angle t
# shortens its inner side by t r; so that no face turns over there, the weights must not change faster than 1 / (t r).
# Where a face turns over in spite of that, the next ones are tried, and what turns over the fewest is kept.
_REACHES = (1.6, 2.4, 2.0, 3.0)
# Where a part ends within reach, its farthest tenth has the weight that the distance gives it.
_TIP = 0.9
# So many times, weights at faces that bending turns over are averaged with those around them.
_ROUNDS = 12
#: The angle at which no face should be turned over, in radians.
BENT = np.pi / 3
#: How many bones may move a vertex; what game engines take.
MOST = 4
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
    proportion to the odds of each. Where bending a joint by 60 degrees would turn a face over, weights are evened
    out further, and change over other distances.

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
    joints = np.flatnonzero(bones.parent >= 0)
    odds = np.zeros((len(table.vertices), len(bones.parent)))
    odds[:, joints] = _odds(table, labels, bones, joints, _REACHES[0])
    found = _of_odds(table, labels, bones, odds)
    folds = _folds(table, found, bones)
    for reach in _REACHES[1:]:
        if not folds.any():
            break
        folding, other = np.flatnonzero(folds), odds.copy()
        other[:, folding] = _odds(table, labels, bones, folding, reach)
        again = _of_odds(table, labels, bones, other)
        if (left := _folds(table, again, bones)).sum() < folds.sum():
            odds, found, folds = other, again, left
    return found


def _of_odds(table: CornerTable, labels: np.ndarray, bones: Bones, odds: np.ndarray) -> Weights:
    """The weights where each vertex goes beyond the joint of each bone with such odds, (n, count)."""
    children = [np.flatnonzero(bones.parent == bone) for bone in range(len(bones.parent))]
    mass = np.zeros(odds.shape)
    mass[:, bones.parent < 0] = _roots(table, labels, bones)
    for bone in bones.order:
        taken = odds[:, children[bone]]
        share = mass[:, [bone]] / (1 + taken.sum(axis=1, keepdims=True))
        mass[:, children[bone]] = share * taken
        mass[:, bone] = share[:, 0]
    return limited(_evened(table, mass, bones))


def _folds(table: CornerTable, weights: Weights, bones: Bones) -> np.ndarray:
    """How many faces each bone turns over when it is bent at its joint, (count,) int64; 0 for roots."""
    mass, beyond = weights.of_bones(len(bones.parent)), following(bones.parent, bones.order)
    folds = np.zeros(len(bones.parent), np.int64)
    for bone in np.flatnonzero(bones.parent >= 0).tolist():
        folds[bone] = _turned_by(table, mass, beyond[bone], bones, bone).sum()
    return folds


def _turned_by(table: CornerTable, mass: np.ndarray, beyond: np.ndarray, bones: Bones, bone: int) -> np.ndarray:
    """Which faces a bone turns over when it is bent at its joint, (p,) bool. beyond : (count,) bool, what it moves."""
    return turned_over(table, mass[:, beyond].sum(axis=1), bones.head[bone], bones.tail[bone] - bones.head[bone], BENT)


def limited(mass: np.ndarray) -> Weights:
    """Keep the four largest weights of each vertex.

    mass : (n, count) float64, 0 or more; what share of a vertex each bone moves, in any unit. Returns Weights.
    """
    n, count = mass.shape
    bone, weight = np.full((n, MOST), -1), np.zeros((n, MOST))
    few = min(MOST, count)
    bone[:, :few] = np.argsort(-mass, axis=1, kind="stable")[:, :few]
    weight[:, :few] = np.take_along_axis(mass, bone[:, :few], axis=1)
    weight /= np.maximum(weight.sum(axis=1, keepdims=True), np.finfo(float).tiny)
    # Such multiples add up exactly; what rounding leaves goes to the largest.
    weight = np.round(_STEPS * weight) / _STEPS
    moved = mass.any(axis=1)
    weight[moved, 0] += 1 - weight[moved].sum(axis=1)
    bone[weight <= 0] = -1
    return Weights(bone, weight)


def _odds(table: CornerTable, labels: np.ndarray, bones: Bones, joints: np.ndarray, reach: float) -> np.ndarray:
    """For each vertex the odds that it goes beyond the joints of some bones, (n, k).

    joints : (k,) int64, the bones. reach : how far the weights change, in radii of a joint.
    """
    n = len(table.vertices)
    length = np.maximum(table.edge_length(np.arange(len(table.edges))), 1e-12 * np.ptp(table.vertices, axis=0).max())
    graph, laplacian = symmetric_matrix(table.edges, length, n), ConformalFactor.of(table).laplacian
    beyond = following(bones.parent, bones.order)
    odds = np.zeros((n, len(joints)))
    for column, bone in enumerate(joints.tolist()):
        inside = beyond[bone][labels].astype(np.int64)
        low, high = table.edge_labels(inside)
        border = np.unique(table.edges[(low == 0) & (high == 1)])
        far = reach * np.linalg.norm(table.vertices[border] - bones.head[bone], axis=1).max(initial=0.0)
        side = np.full(n, -1.0)
        side[table.corner_vertex[inside[table.corner_face] == 1]] = 1.0
        side[border] = 0.0
        distance = dijkstra(graph, directed=False, indices=border, min_only=True, limit=far)
        share = _harmonic(laplacian, distance, side, max(far, np.finfo(float).tiny))
        share = 0.5 * share + 0.5 * share**2 * (3 - 2 * share)  # less of a crease where the change begins and ends
        odds[:, column] = share / np.maximum(1 - share, 1e-9)
    return odds


def _harmonic(laplacian: csr_array, distance: np.ndarray, side: np.ndarray, reach: float) -> np.ndarray:
    """Share of each vertex that goes beyond a joint, (n,): harmonic where the border is within reach.

    distance : (n,), from the border, inf out of reach. side : (n,), 1 beyond the border, -1 on this side, 0 on it.
    """
    share = 0.5 + 0.5 * side * np.minimum(distance / reach, 1.0)
    near = distance < reach
    known = ~near
    for sign in (-1.0, 1.0):
        deepest = np.max(distance, where=near & (side == sign), initial=0.0)
        ends = near & (side == sign) & (distance >= _TIP * deepest)
        known |= ends if deepest < _TIP * reach else False
    free = np.flatnonzero(~known)
    if len(free):
        rows = laplacian[free]
        share[free] = solved(rows[:, free], -(rows @ np.where(known, share, 0.0)))
    return share.clip(0.0, 1.0)


def _evened(table: CornerTable, mass: np.ndarray, bones: Bones) -> np.ndarray:
    """The weights, (n, count), averaged around faces that bending a joint would turn over, until none is or in vain."""
    beyond = following(bones.parent, bones.order)
    beside = symmetric_matrix(table.edges, np.ones(len(table.edges)), len(mass))
    count = np.maximum(np.asarray(beside.sum(axis=1)).ravel(), 1.0)
    joints = np.flatnonzero(bones.parent >= 0).tolist()
    turned, changed = np.zeros(table.n_faces, bool), np.ones(table.n_faces, bool)
    for _ in range(_ROUNDS):
        turned &= ~changed
        some = table.within(changed)
        for bone in joints:
            turned |= _turned_by(some, mass, beyond[bone], bones, bone)
        if not turned.any():
            break
        around = np.zeros(len(mass), bool)
        around[table.corner_vertex[turned[table.corner_face]]] = True
        around |= beside @ around > 0
        mass[around] = 0.5 * mass[around] + 0.5 * (beside[around] @ mass) / count[around, None]
        changed = np.zeros(table.n_faces, bool)
        changed[table.corner_face[around[table.corner_vertex]]] = True
    return mass


def turned_over(
    table: CornerTable, share: np.ndarray, joint: np.ndarray, along: np.ndarray, angle: float
) -> np.ndarray:
    """Tell which faces are turned over when a joint is bent, to four sides.

    A face is turned over if it looks against the direction in which the average of its corners' motions turns it.

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
    low, high = np.full(table.n_faces, np.inf), np.full(table.n_faces, -np.inf)
    np.minimum.at(low, table.corner_face, share[table.corner_vertex])
    np.maximum.at(high, table.corner_face, share[table.corner_vertex])
    faces = high - low > 1e-6
    turned = np.zeros(table.n_faces, bool)
    if not faces.any():
        return turned
    some = table.within(faces)
    corner = some.corner_face
    total = np.bincount(corner, share[some.corner_vertex], table.n_faces)[faces]
    average = (total / np.bincount(corner, minlength=table.n_faces)[faces])[:, None, None]
    before = some.face_vectors()[faces]
    for turn in bends(along, angle):
        moved = share[:, None] * ((table.vertices - joint) @ (turn - np.eye(3)).T)
        after = CornerTable(table.vertices + moved, some.edges, some.corner_vertex, some.corner_edge, some.corner_face,
                            some.n_faces).face_vectors()[faces]
        motion = (1 - average) * np.eye(3) + average * turn
        cofactor = np.linalg.inv(motion).transpose(0, 2, 1) * np.linalg.det(motion)[:, None, None]
        expected = (cofactor @ before[:, :, None])[:, :, 0]
        turned[faces] |= (expected * after).sum(axis=1) < 0
    return turned


def bends(along: np.ndarray, angle: float) -> list[np.ndarray]:
    """Rotations, (3, 3), by an angle in radians about four axes at right angles to a direction, (3,)."""
    direction = along / max(float(np.linalg.norm(along)), np.finfo(float).tiny)
    first = np.cross(direction, np.eye(3)[np.abs(direction).argmin()])
    first /= np.linalg.norm(first)
    second = np.cross(direction, first)
    return list(Rotation.from_rotvec(angle * np.stack([first, second, -first, -second])).as_matrix())


def _roots(table: CornerTable, labels: np.ndarray, bones: Bones) -> np.ndarray:
    """Whether each vertex belongs to each tree of bones, (n, roots) of 0 and 1; of several trees the first."""
    root = np.arange(len(bones.parent))
    for bone in bones.order:
        if bones.parent[bone] >= 0:
            root[bone] = root[bones.parent[bone]]
    of_vertex = np.full(len(table.vertices), len(root))
    np.minimum.at(of_vertex, table.corner_vertex, root[labels[table.corner_face]])
    return (of_vertex[:, None] == np.flatnonzero(bones.parent < 0)).astype(float)

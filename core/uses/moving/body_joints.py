# SPDX-License-Identifier: GPL-3.0-or-later
"""Where parts hold together as rigid bodies: a joint at each cut, and the pairs that must not push each other away."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...arrays.components import components
from ...arrays.indexing import largest_of_each, sums_by
from ...arrays.int64 import cumsum, full
from ...arrays.pairs import distinct_pairs
from ...arrays.vectors import cross, middles_of_each, row_products, second_moments_of_each
from ...mesh.corners import CornerTable
from .groups import beside, off_ground, touching_groups
from .hulls import Hull

# A cut that is shorter than this share of the longest one between its two parts gets no joint of its own.
_CRUMB = 0.2
# A cut is round where its length squared, along its longest line, is not more than this times that across.
_ROUND = 1.3


@dataclass(frozen=True, eq=False)
class BodyJoints:
    """The joints of k cuts.

    Attributes
    ----------
    pairs : (k, 2) int64
        The two parts of each, the lower one first.
    center : (k, 3) float64
        The middle of the cut, in units of the vertices.
    axis : (k, 3) float64
        Unit vector across the cut, toward the second part.
    hinge : (k, 3) float64
        Unit vector along the longest line of the cut; a horizontal one where the cut is round.
    """

    pairs: np.ndarray
    center: np.ndarray
    axis: np.ndarray
    hinge: np.ndarray


def body_joints(table: CornerTable, labels: np.ndarray, ground: np.ndarray | None = None) -> BodyJoints:
    """Find a joint for each cut; parts that meet in several places have several.

    Where cuts leave groups of parts, such as the loose pieces of a model, a joint holds two groups at the place where
    they touch, the nearest ones first, until none touch.

    Parameters
    ----------
    table : CornerTable
        p faces, z upwards.
    labels : (p,) int64
        Part of each face, 0..count-1.
    ground : (count,) bool, optional
        The parts that are grounds, which nothing is joined to; not all of them.

    Returns
    -------
    joints : BodyJoints
    """
    ground = np.zeros(int(labels.max()) + 1, bool) if ground is None else ground
    pairs, joint, middle, weight = _cuts(off_ground(table, labels, ground), labels)
    contacts = touching_groups(table, labels, pairs, ground)
    pairs = np.concatenate([pairs, *([pair] for pair, _ in contacts)])
    joint = np.concatenate([joint, *(full(len(some), len(pairs) - len(contacts) + k)
                                     for k, (_, some) in enumerate(contacts))])
    weight = np.concatenate([weight, *(np.ones(len(some)) for _, some in contacts)])
    middle = np.concatenate([middle, *(some for _, some in contacts)])
    _, center = middles_of_each(joint, middle, weight, len(pairs))
    spread = second_moments_of_each(joint, middle - center[joint], weight, len(pairs))
    axis, hinge = _frames(spread, _middles(table, labels)[pairs])
    return BodyJoints(pairs, center, axis, hinge)


def _cuts(table: CornerTable, labels: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """The two parts of each cut, (k, 2); of each edge on one, which, its middle and its length, (e,) and (e, 3)."""
    low, high = table.edge_labels(labels)
    cut = np.flatnonzero(low < high)
    pairs, which = distinct_pairs(low[cut], high[cut])
    _, end = distinct_pairs(np.repeat(which, 2), table.edges[cut].ravel())
    first, second = end.reshape(-1, 2).T
    count, of_end = components(int(end.max(initial=-1)) + 1, first, second)
    joint = of_end[first]
    weight = np.maximum(table.edge_length(cut), np.finfo(float).tiny)
    pair = np.zeros(count, np.int64)
    pair[joint] = which
    length = np.bincount(joint, weight, count)
    kept = length >= _CRUMB * largest_of_each(pair, length, len(pairs))[pair]
    some = kept[joint]
    return (pairs[pair[kept]], (cumsum(kept) - 1)[joint[some]], table.vertices[table.edges[cut[some]]].mean(axis=1),
            weight[some])


def _middles(table: CornerTable, labels: np.ndarray) -> np.ndarray:
    """Mean of the corners of each part, (count, 3)."""
    part = labels[table.corner_face]
    count = int(labels.max()) + 1
    return sums_by(part, table.vertices[table.corner_vertex], count) / np.bincount(part, minlength=count)[:, None]


def _frames(spread: np.ndarray, middles: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Axes and hinges of cuts, (k, 3) each.

    spread : (k, 3, 3), second moments of each cut. middles : (k, 2, 3), of the parts on both sides.
    """
    size, lines = np.linalg.eigh(spread)
    axis, hinge = lines[:, :, 0].copy(), lines[:, :, 2].copy()
    toward = middles[:, 1] - middles[:, 0]
    straight = size[:, 1] <= 1e-6 * size[:, 2]  # a cut along a line has no plane: the parts say what is across
    across = toward - (toward * hinge).sum(axis=1)[:, None] * hinge
    long = np.linalg.norm(across, axis=1)
    straight &= long > 1e-6 * np.linalg.norm(toward, axis=1)
    axis[straight] = across[straight] / long[straight, None]
    axis *= np.where((axis * toward).sum(axis=1) < 0, -1.0, 1.0)[:, None]
    level = np.cross(np.broadcast_to([0.0, 0.0, 1.0], axis.shape), axis)
    tilt = np.linalg.norm(level, axis=1)
    level[tilt < 1e-3] = np.cross(axis[tilt < 1e-3], [0.0, 1.0, 0.0])
    turned = (size[:, 2] <= _ROUND * size[:, 1])
    hinge[turned] = (level / np.linalg.norm(level, axis=1)[:, None])[turned]
    return axis, hinge


def overlapping(hulls: list[Hull]) -> np.ndarray:
    """List the pairs of hulls that may overlap.

    Two hulls are apart if the plane of a face of one of them divides them; the rare ones that only planes along an
    edge of each divide are listed, too.

    Parameters
    ----------
    hulls : list of Hull

    Returns
    -------
    pairs : (k, 2) int64
        The lower number first, rising.
    """
    if not hulls:
        return np.empty((0, 2), np.int64)
    near = beside([hull.vertices for hull in hulls], 0.0)
    apart = [_divides(hulls[a], hulls[b]) or _divides(hulls[b], hulls[a]) for a, b in near.tolist()]
    return near[~np.array(apart, bool)]


def _divides(hull: Hull, other: Hull) -> bool:
    """Whether the plane of a face of a hull has another hull on its outer side."""
    a, b, c = hull.vertices[hull.triangles].transpose(1, 0, 2)
    normal = cross(b - a, c - a)
    return bool(((normal @ other.vertices.T).min(axis=1) >= row_products(normal, a)).any())

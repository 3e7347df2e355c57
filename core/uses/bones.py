# SPDX-License-Identifier: GPL-3.0-or-later
"""Bones: one for each part, from the cut toward the body along the part's center line to its far end."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import breadth_first_order, connected_components, minimum_spanning_tree

from ..surface.arrays import distinct_pairs, sums_by
from ..surface.corners import CornerTable

# Least length of a bone, as a share of the diagonal of the bounding box of the faces' centers. A shorter bone is
# replaced by one of this length that points upwards.
_SHORTEST = 0.01


@dataclass(frozen=True, eq=False)
class Bones:
    """The bones of ``count`` parts; bone i is that of part i.

    Attributes
    ----------
    head, tail : (count, 3) float64
        Start and end of each bone, in units of the vertices.
    parent : (count,) int64
        Parent of each bone; -1 for the root of the body and of every other connected group of parts.
    connected : (count,) bool
        Whether each bone starts where its parent ends.
    order : tuple of int
        All bones, parents before their children.
    """

    head: np.ndarray
    tail: np.ndarray
    parent: np.ndarray
    connected: np.ndarray
    order: tuple[int, ...]


def part_bones(
    table: CornerTable, labels: np.ndarray, area: np.ndarray, height: np.ndarray, line: np.ndarray,
    line_part: np.ndarray,
) -> Bones:
    """Make a bone for each part, and a tree of bones along the cuts between parts.

    Parameters
    ----------
    table : CornerTable
        p faces and n vertices.
    labels : (p,) int64
        Part of each face, 0..count-1, all in use.
    area : (p,) float64
        Area of each face, in squared units of the vertices.
    height : (n,) float64
        Field at each vertex. The part of lowest mean height is the root of its tree.
    line : (r, 3) float64
        Points on the center lines of the parts, in units of the vertices.
    line_part : (r,) int64
        Part of each point.

    Returns
    -------
    bones : Bones
    """
    count = int(labels.max()) + 1
    center = table.face_means(table.vertices)
    weight = np.maximum(area, 1e-12 * max(area.sum(), 1e-300))
    share = np.bincount(labels, weight, count)
    middle = sums_by(labels, weight[:, None] * center, count) / share[:, None]
    pairs, joint, length = _joints(table, labels)
    of_part = np.bincount(labels, weight * table.face_means(height), count) / share
    parent, order = _tree(count, pairs, length, of_part)
    at = {(a, b): place for (a, b), place in zip(pairs.tolist(), joint, strict=True)}
    head = middle.copy()
    for part in order:
        if parent[part] >= 0:
            head[part] = at[min(part, parent[part]), max(part, parent[part])]
    tail = head.copy()
    connected = np.zeros(count, bool)
    shortest = _SHORTEST * float(np.linalg.norm(np.ptp(center, axis=0)))
    for part in order:
        children = np.flatnonzero(parent == part)
        tail[part] = _end(head[part], head[children], line[line_part == part], middle[part], parent[part] < 0)
        if np.linalg.norm(tail[part] - head[part]) < shortest:
            tail[part] = head[part] + (0.0, 0.0, max(shortest, 1e-6))
        elif len(children) == 1:
            connected[children] = True
    return Bones(head, tail, parent, connected, tuple(order))


def _joints(table: CornerTable, labels: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Pairs of parts that touch, (e, 2), and the middle, (e, 3), and length, (e,), of the cut between them."""
    low, high = table.edge_labels(labels)
    cut = np.flatnonzero(low < high)
    pairs, which = distinct_pairs(low[cut], high[cut])
    weight = np.maximum(table.edge_length(cut), 1e-300)
    length = np.bincount(which, weight, len(pairs))
    joint = sums_by(which, weight[:, None] * table.vertices[table.edges[cut]].mean(axis=1), len(pairs))
    return pairs, joint / np.maximum(length, 1e-300)[:, None], length


def _tree(count: int, pairs: np.ndarray, length: np.ndarray, height: np.ndarray) -> tuple[np.ndarray, list[int]]:
    """Parent of each part, (count,), -1 for a root, and all parts in an order in which parents precede children.

    The tree follows the longest cuts. The root of each connected group of parts is its part of least height.
    """
    rate = (2.0 * length.max(initial=1.0)) / np.maximum(length, 1e-300)
    graph = coo_matrix((rate, pairs.T), (count, count)).tocsr()
    kept = minimum_spanning_tree(graph)
    _, piece = connected_components(kept, directed=False)
    parent = np.full(count, -1)
    order = []
    for index in range(piece.max() + 1):
        members = np.flatnonzero(piece == index)
        root = members[np.argmin(height[members])]
        reached, before = breadth_first_order(kept, root, directed=False)
        order += reached.tolist()
        parent[reached[1:]] = before[reached[1:]]
    return parent, order


def _end(head: np.ndarray, children: np.ndarray, line: np.ndarray, middle: np.ndarray, is_root: bool) -> np.ndarray:
    """End of a bone, (3,): at its only child, amid several children, or at the far end of its center line.

    The bone of a root with several children ends at the farthest child. Without children and without a center line, it
    ends as far beyond the middle of the part as it starts before it. children : (k, 3), heads of the child bones.
    """
    if len(children) == 1:
        return children[0]
    if len(children) and not is_root:
        return children.mean(axis=0)
    far = children if len(children) else line
    if not len(far):
        return 2 * middle - head
    return far[np.argmax(np.linalg.norm(far - head, axis=1))]

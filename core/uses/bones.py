# SPDX-License-Identifier: GPL-3.0-or-later
"""A bone for each part, from where it is joined to the body along its center line to its end."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import breadth_first_order, connected_components, minimum_spanning_tree

from ..surface.arrays import distinct_pairs, sums_by
from ..surface.corners import CornerTable

# A bone shorter than this share of the mesh's extent would have no direction to speak of.
_SHORTEST = 0.01


@dataclass(frozen=True, eq=False)
class Bones:
    """Bone i is that of part i.

    Attributes
    ----------
    head, tail : (count, 3) float64
    parent : (count,) int64
        -1 for the body, and for the first of every loose piece.
    connected : (count,) bool
        Whether the bone starts where its parent's ends.
    """

    head: np.ndarray
    tail: np.ndarray
    parent: np.ndarray
    connected: np.ndarray


def part_bones(
    table: CornerTable, labels: np.ndarray, area: np.ndarray, height: np.ndarray, line: np.ndarray,
    line_part: np.ndarray,
) -> Bones:
    """Bones of parts that hang together at their cuts.

    Parameters
    ----------
    table : CornerTable
        With p faces and n vertices.
    labels : (p,) int64
        Part of each face, 0..count-1, all in use.
    area : (p,) float64
        Of each face.
    height : (n,) float64
        The field at each vertex: the body is lowest.
    line : (r, 3) float64
        Points on the center lines of the parts.
    line_part : (r,) int64
        The part of each.

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
    return Bones(head, tail, parent, connected)


def _joints(table: CornerTable, labels: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """The pairs of parts that touch, the middle of what they have in common, and its length."""
    low, high = table.edge_labels(labels)
    cut = np.flatnonzero(low < high)
    pairs, which = distinct_pairs(low[cut], high[cut])
    weight = np.maximum(table.edge_length(cut), 1e-300)
    length = np.bincount(which, weight, len(pairs))
    joint = sums_by(which, weight[:, None] * table.vertices[table.edges[cut]].mean(axis=1), len(pairs))
    return pairs, joint / np.maximum(length, 1e-300)[:, None], length


def _tree(count, pairs, length, height):
    """Each part's parent, by the longest cuts, from the lowest part of each piece; and parts before children."""
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


def _end(head, children, line, middle, is_root):
    """Where a bone ends: at its only child, amid several, or at the far end of its center line."""
    if len(children) == 1:
        return children[0]
    if len(children) and not is_root:
        return children.mean(axis=0)
    far = children if len(children) else line
    if not len(far):
        return 2 * middle - head
    return far[np.argmax(np.linalg.norm(far - head, axis=1))]

# SPDX-License-Identifier: GPL-3.0-or-later
"""Which bone hangs on which: a tree along the longest cuts between parts, its own mirror image where the parts are."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import breadth_first_order, connected_components, minimum_spanning_tree

from ...arrays.int64 import full
from ...mesh.labels import label_boundaries
from .part_images import PartImages


def following(parent: np.ndarray, order: Sequence[int]) -> np.ndarray:
    """Find which bones follow each other in a tree.

    Parameters
    ----------
    parent, order
        As of ``Bones``.

    Returns
    -------
    beyond : (count, count) bool
        Whether the bone of the second index is that of the first, or follows it.
    """
    beyond = np.eye(len(parent), dtype=bool)
    for bone in reversed(order):
        if parent[bone] >= 0:
            beyond[parent[bone]] |= beyond[bone]
    return beyond


def part_tree(count: int, pairs: np.ndarray, length: np.ndarray, height: np.ndarray) -> tuple[np.ndarray, list[int]]:
    """Parent of each part, (count,), -1 for a root, and all parts in an order in which parents precede children.

    The tree follows the longest cuts. The root of each connected group of parts is its part of least height.
    """
    rate = (2.0 * length.max(initial=1.0)) / np.maximum(length, 1e-300)
    graph = coo_matrix((rate, pairs.T), (count, count)).tocsr()
    kept = minimum_spanning_tree(graph)
    _, piece = connected_components(kept, directed=False)
    parent = full(count, -1)
    order = []
    for index in range(piece.max() + 1):
        members = np.flatnonzero(piece == index)
        root = members[np.argmin(height[members])]
        reached, before = breadth_first_order(kept, root, directed=False)
        order += reached.tolist()
        parent[reached[1:]] = before[reached[1:]]
    return parent, order


def even_tree(
    images: PartImages, pairs: np.ndarray, length: np.ndarray, height: np.ndarray
) -> tuple[np.ndarray, list[int]]:
    """As ``part_tree``, but its own mirror image: a part in the plane hangs on none beside it, or is a root."""
    used = np.unique(images.first)
    middle, beside = images.own[used], images.image[used] != used
    place = np.searchsorted(used, images.first)
    joined, total = label_boundaries(place, pairs, length)
    total = total + 2.0 * total.sum() * middle[joined].all(axis=1)  # along the plane if there is a way
    # A root is not beside the plane if anything is not that hangs together with it.
    before, order = part_tree(len(used), joined, total, height[used] + beside * (1.0 + np.ptp(height)))
    for part in order:
        while middle[part] and before[part] >= 0 and beside[before[part]]:
            before[part] = before[before[part]]
    parent, both = full(len(images.twin), -1), []
    for part in order:
        mine, above = int(used[part]), int(used[before[part]]) if before[part] >= 0 else -1
        image = int(images.image[mine])
        if above >= 0:
            above = _own_side(images, mine, above, pairs, length)
        parent[image], parent[mine] = -1 if above < 0 else images.image[above], above
        both += [mine] if image == mine else [mine, image]
    return parent, both


def _own_side(images: PartImages, part: int, above: int, pairs: np.ndarray, length: np.ndarray) -> int:
    """Which a part hangs on, another one or its image: what it touches more, and its image, if it has one."""
    image, other = images.image[[part, above]].tolist()

    def touching(one: int, two: int) -> float:
        return float(length[(pairs == sorted((one, two))).all(axis=1)].sum())

    here, there = touching(part, above), touching(part, other)
    if image != part:
        here, there = here + touching(image, other), there + touching(image, above)
    return other if there > here else above

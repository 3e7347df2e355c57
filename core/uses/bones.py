# SPDX-License-Identifier: GPL-3.0-or-later
"""Bones: one for each part, from the cut toward the body along the part's center line to its far end.

Or one for each limb: a part that is cut from the others at no neck, such as the belly of a vase, cannot be bent there
without folds or a loss of volume, and moves with the part that it hangs on.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import breadth_first_order, connected_components, minimum_spanning_tree

from ..surface.arrays import distinct_pairs, sums_by
from ..surface.corners import CornerTable
from ..surface.mirror_plane import MirrorPlane

# Least length of a bone, as a share of the diagonal of the bounding box of the faces' centers. A shorter bone is
# replaced by one of this length that points upwards.
_SHORTEST = 0.01
# A cut is a neck if the middles of both sides are so many of its radii away from its middle, and if this share of all
# that divides the two sides is the cut between a part and the part that it hangs on, not one beside another part. In a
# ring, half is; it cannot be bent.
_AWAY, _OWN = 0.6, 0.51


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


@dataclass(frozen=True, eq=False)
class Images:
    """Which parts, or bones, are exact mirror images of which, so that bones are, too.

    Attributes
    ----------
    twin : (count,) int64
        The mirror image of each, itself if it is its own. Of two, the first is the one that is looked at.
    mirror : MirrorPlane
        In units of the vertices.
    """

    twin: np.ndarray
    mirror: MirrorPlane

    @property
    def own(self) -> np.ndarray:
        """(count,) bool, which are their own images: their bones lie in the plane."""
        return self.twin == np.arange(len(self.twin))

    @property
    def first(self) -> np.ndarray:
        """(count,) int64, the first of each and its image."""
        return np.minimum(self.twin, np.arange(len(self.twin)))

    def onto_plane(self, points: np.ndarray) -> np.ndarray:
        """The feet of points, (k, 3), on the plane, (k, 3)."""
        return points - self.mirror.heights(points)[:, None] * self.mirror.normal


def part_bones(
    table: CornerTable, labels: np.ndarray, area: np.ndarray, height: np.ndarray, line: np.ndarray,
    line_part: np.ndarray, images: Images | None = None,
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
    images : Images, optional
        Of the parts, for a mesh that is its own mirror image: so are the bones and their tree then.

    Returns
    -------
    bones : Bones
    """
    table, count = table.joined()[0], int(labels.max()) + 1
    center = table.face_means(table.vertices)
    weight = np.maximum(area, 1e-12 * max(area.sum(), 1e-300))
    share = np.bincount(labels, weight, count)
    middle = sums_by(labels, weight[:, None] * center, count) / share[:, None]
    pairs, length = _joints(table, labels)
    of_part = np.bincount(labels, weight * table.face_means(height), count) / share
    tree = _tree(count, pairs, length, of_part) if images is None else _even_tree(images, pairs, length, of_part)
    (parent, order), connected = tree, np.zeros(count, bool)
    head, beyond = middle.copy(), following(parent, order)
    for part in np.flatnonzero(parent >= 0).tolist():
        # Of all that divides the two sides, which may be more than one cut: a leg meets belly and rump.
        border, _, place = _border(table, beyond[part][labels])
        if len(border):  # an image may hang on what it does not touch
            head[part] = place
    if images is not None:
        head = _even(images, head)
    tail = head.copy()
    shortest = _SHORTEST * float(np.linalg.norm(np.ptp(center, axis=0)))
    for part in order:
        children = np.flatnonzero(parent == part)
        way = head[children], line[line_part == part], middle[[part]]
        if images is not None and images.own[part]:
            way = tuple(images.onto_plane(points) for points in way)
        tail[part] = _end(head[part], *way, parent[part] < 0)
        if np.linalg.norm(tail[part] - head[part]) < shortest:
            tail[part] = head[part] + max(shortest, 1e-6) * _up(images)
        elif len(children) == 1:
            connected[children] = True
    return Bones(head, tail if images is None else _even(images, tail), parent, connected, tuple(order))


def _up(images: Images | None) -> np.ndarray:
    """The direction of bones that would have no length, (3,): upwards, or as nearly as the plane of symmetry goes."""
    up, side = np.eye(3)[[2, 0]]
    if images is None:
        return up
    normal = images.mirror.normal
    within = side - normal[0] * normal if abs(normal[2]) > 0.9 else up - normal[2] * normal
    return within / np.linalg.norm(within)


def _even(images: Images, points: np.ndarray) -> np.ndarray:
    """Ends of bones, (count, 3), as images of each other: of two the first counts; their own ones are in the plane."""
    first = points[images.first]
    image = images.first != np.arange(len(points))
    return np.where(images.own[:, None], images.onto_plane(points),
                    np.where(image[:, None], images.mirror.mirrored(first), points))


def limb_bones(
    table: CornerTable, labels: np.ndarray, area: np.ndarray, height: np.ndarray, line: np.ndarray,
    line_part: np.ndarray, images: Images | None = None,
) -> tuple[Bones, np.ndarray, np.ndarray]:
    """Make bones for parts that can be bent where they are cut; all other parts have that of the part they hang on.

    Parameters
    ----------
    table, labels, area, height, line, line_part, images
        As for ``part_bones``.

    Returns
    -------
    bones : Bones
    bone_part : (k,) int64
        The part that each bone is of.
    part_bone : (count,) int64
        The bone that moves each part.
    """
    table, owner = table.joined()[0], np.arange(int(labels.max()) + 1)
    while True:
        bone_part, part_bone = np.unique(owner, return_inverse=True)
        of_face = part_bone[labels]
        of_bones = None if images is None else Images(part_bone[images.twin[bone_part]], images.mirror)
        bones = part_bones(table, of_face, area, height, line, np.where(line_part < 0, -1, part_bone[line_part]),
                           of_bones)
        held, neck = bone_part.copy(), _necks(table, of_face, area, bones)
        for bone in np.flatnonzero(~neck if of_bones is None else ~neck[of_bones.first]).tolist():
            held[bone] = bone_part[bones.parent[bone]]
        if (held == bone_part).all():
            return bones, bone_part, part_bone
        # What hangs on a part that itself hangs on another follows in the next round.
        owner = held[part_bone]


def _necks(table: CornerTable, labels: np.ndarray, area: np.ndarray, bones: Bones) -> np.ndarray:
    """Whether each bone begins at a neck, (count,) bool; true for roots."""
    low, high = table.edge_labels(labels)
    center = table.face_means(table.vertices)
    beyond, neck = following(bones.parent, bones.order), bones.parent < 0
    for bone in np.flatnonzero(~neck).tolist():
        border, length, middle = _border(table, beyond[bone][labels])
        if not len(border):
            continue
        pair = sorted((bone, int(bones.parent[bone])))
        own = length[(low[border] == pair[0]) & (high[border] == pair[1])].sum()
        radius = np.linalg.norm(table.vertices[table.edges[border]].mean(axis=1) - middle, axis=1).max()
        away = [np.linalg.norm((area[side, None] * center[side]).sum(axis=0) / max(area[side].sum(), 1e-300) - middle)
                for side in (beyond[bone][labels], ~beyond[bone][labels])]
        neck[bone] = own >= _OWN * length.sum() and min(away) >= _AWAY * radius
    return neck


def _border(table: CornerTable, inside: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Edges between faces that are inside, (p,) bool, and others, (b,); their lengths; and the middle of all, (3,)."""
    low, high = table.edge_labels(inside.astype(np.int64))
    border = np.flatnonzero((low == 0) & (high == 1))
    length = np.maximum(table.edge_length(border), 1e-300)
    return border, length, (length / length.sum()) @ table.vertices[table.edges[border]].mean(axis=1)


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


def _joints(table: CornerTable, labels: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Pairs of parts that touch, (e, 2), and the length of the cut between them, (e,)."""
    low, high = table.edge_labels(labels)
    cut = np.flatnonzero(low < high)
    pairs, which = distinct_pairs(low[cut], high[cut])
    return pairs, np.bincount(which, np.maximum(table.edge_length(cut), 1e-300), len(pairs))


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


def _even_tree(
    images: Images, pairs: np.ndarray, length: np.ndarray, height: np.ndarray
) -> tuple[np.ndarray, list[int]]:
    """As ``_tree``, but its own mirror image: a part in the plane hangs on another one there, or is a root."""
    used = np.unique(images.first)
    count, middle = len(used), images.own[used]
    place = np.searchsorted(used, images.first)
    low, high = np.sort(place[pairs], axis=1).T
    apart = low != high
    pairs, which = distinct_pairs(low[apart], high[apart])
    length = sums_by(which, length[apart], len(pairs))
    length = length + 2.0 * length.sum() * middle[pairs].all(axis=1)  # along the plane if there is a way
    # A root is in the plane if anything is that hangs together with it.
    before, order = _tree(count, pairs, length, height[used] - middle * (1.0 + np.ptp(height)))
    for part in order:
        while middle[part] and before[part] >= 0 and not middle[before[part]]:
            before[part] = before[before[part]]
    parent, both = np.full(len(images.twin), -1), []
    for part in order:
        mine, above = int(used[part]), int(used[before[part]]) if before[part] >= 0 else -1
        image = int(images.twin[mine])
        parent[image], parent[mine] = -1 if above < 0 else images.twin[above], above
        both += [mine] if image == mine else [mine, image]
    return parent, both


def _end(head: np.ndarray, children: np.ndarray, line: np.ndarray, middle: np.ndarray, is_root: bool) -> np.ndarray:
    """End of a bone, (3,): at its only child, amid several children, or at the far end of its center line.

    The bone of a root with several children ends at the farthest child. Without children and without a center line, it
    ends as far beyond the middle of the part as it starts before it. children : (k, 3), heads of the child bones.
    middle : (1, 3).
    """
    if len(children) == 1:
        return children[0]
    if len(children) and not is_root:
        return children.mean(axis=0)
    far = children if len(children) else line
    if not len(far):
        return 2 * middle[0] - head
    return far[np.argmax(np.linalg.norm(far - head, axis=1))]

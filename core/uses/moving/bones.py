# SPDX-License-Identifier: GPL-3.0-or-later
"""Bones: one for each part, from the cut toward the body along the part's center line to its far end.

Or one for each limb: a part that is cut from the others at no neck, such as the belly of a vase, cannot be bent there
without folds or a loss of volume, and moves with the part that it hangs on.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import breadth_first_order, connected_components, minimum_spanning_tree

from ...arrays.indexing import sums_by
from ...arrays.pairs import distinct_pairs
from ...arrays.vectors import middles_of_each
from ...mesh.corners import CornerTable
from ...mesh.cut_edges import CutEdges
from ...symmetry.plane import MirrorPlane
from .groups import touching_groups

# Least length of a bone, as a share of the diagonal of the faces' bounding box. A shorter bone is replaced by one of
# this length that points upwards.
_SHORTEST = 0.01
# A cut is a neck if the middles of both sides are so many of its radii away from its middle, and if this share of all
# that divides the two sides is the cut between a part and the part that it hangs on, not one beside another part. In a
# ring, half is; it cannot be bent.
_AWAY, _OWN = 0.6, 0.51
# Two parts have bones that are images if their middles are, within so much of the diagonal of the faces' centers. In 59
# of 60 symmetric models of the benchmark, of artists and of a game all are, within 0.031.
_ALMOST = 0.05
# A bone ends toward those that hang on it by a contact, as a hand on the sleeve, if they and all that follows have this
# share of its part's area: a head's bone does not end at its eyes.
_SHOWN = 0.2


@dataclass(frozen=True, eq=False)
class Bones:
    """The bones of ``count`` parts; bone i is that of part i.

    Attributes
    ----------
    head, tail : (count, 3) float64
        Start and end of each bone, in units of the vertices.
    parent : (count,) int64
        Parent of each bone; -1 for the root of the body and of every other group of parts that touches none.
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
class PartImages:
    """Which parts, or bones, are mirror images of which, so that bones are exact ones.

    Attributes
    ----------
    twin : (count,) int64
        The mirror image of each, itself if it is its own, -1 if it has none. Of two, the first is the one that is
        looked at.
    mirror : MirrorPlane or None
        In units of the vertices; None for a model that is symmetric but for its pose, whose bones are images by the
        tree that they make, not by their places.
    """

    twin: np.ndarray
    mirror: MirrorPlane | None

    @classmethod
    def of_parts(cls, twin: np.ndarray, mirror: MirrorPlane | None, table: CornerTable, labels: np.ndarray,
                 area: np.ndarray) -> PartImages | None:
        """The parts of a mesh that is its own mirror image, or almost: what was posed beside a plane has no images.

        Parameters
        ----------
        twin : (count,) int64
            As of ``Parts``.
        mirror : MirrorPlane or None
        table, labels, area
            As of ``BoneSurface``.

        Returns
        -------
        images : PartImages or None
            None if no part is its own image: one of two sides, on which nothing is between them, is the root.
        """
        if mirror is not None:
            middle, mean = _middles(table, labels, _weights(area))
            size, there = float(np.linalg.norm(np.ptp(mean, axis=0))), np.maximum(twin, 0)
            off = np.linalg.norm(mirror.mirrored(middle) - middle[there], axis=1)
            twin = np.where((twin >= 0) & (np.maximum(off, off[there]) <= _ALMOST * size), twin, -1)
        images = cls(twin, mirror)
        return images if images.own.any() else None

    @property
    def image(self) -> np.ndarray:
        """(count,) int64, the mirror image of each, itself if it has none."""
        return np.where(self.twin < 0, np.arange(len(self.twin)), self.twin)

    @property
    def own(self) -> np.ndarray:
        """(count,) bool, which are their own images: their bones lie in the plane, if there is one."""
        return self.twin == np.arange(len(self.twin))

    @property
    def first(self) -> np.ndarray:
        """(count,) int64, the first of each and its image."""
        return np.minimum(self.image, np.arange(len(self.twin)))

    def of_bones(self, bone_part: np.ndarray, part_bone: np.ndarray) -> PartImages:
        """Those of bones of which several parts may have one; see ``limb_bones``."""
        twin = self.twin[bone_part]
        return PartImages(np.where(twin < 0, -1, part_bone[twin]), self.mirror)

    def onto_plane(self, points: np.ndarray) -> np.ndarray:
        """The feet of points, (k, 3), on the plane, (k, 3); without one the points."""
        return points if self.mirror is None else points - self.mirror.heights(points)[:, None] * self.mirror.normal


@dataclass(frozen=True, eq=False)
class BoneSurface:
    """A surface and all that its bones are made from.

    Attributes
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
    images : PartImages, optional
        Of the parts, for a mesh that is its own mirror image: so are the bones and their tree then, but for those of
        parts without an image.
    """

    table: CornerTable
    labels: np.ndarray
    area: np.ndarray
    height: np.ndarray
    line: np.ndarray
    line_part: np.ndarray
    images: PartImages | None = None

    def joined(self) -> BoneSurface:
        """The surface on vertices of which no two, as files split them, are at one place."""
        return replace(self, table=self.table.joined()[0])


def part_bones(surface: BoneSurface) -> Bones:
    """Make a bone for each part, and a tree of bones along the cuts between parts, and contacts between their pieces.

    surface : BoneSurface. Returns Bones, one for each of its parts.
    """
    surface = surface.joined()
    table, labels, images, count = surface.table, surface.labels, surface.images, int(surface.labels.max()) + 1
    weight = _weights(surface.area)
    middle, _ = _middles(table, labels, weight)
    size = np.bincount(labels, weight, count)
    joints = _Joints.between(table, labels, images)
    of_part = np.bincount(labels, weight * table.face_means(surface.height), count) / size
    known = joints.pairs, joints.length, of_part
    parent, order = _tree(count, *known) if images is None else _even_tree(images, *known)
    head, beyond = middle.copy(), following(parent, order)
    for part in np.flatnonzero(parent >= 0).tolist():
        head[part] = joints.place(part, int(parent[part]), beyond[part], middle[part])
    if images is not None:
        head = _even(images, head)
    tail = head.copy()
    shortest = max(_SHORTEST * table.diagonal, np.finfo(float).tiny)
    shown = joints.by_cut(parent) | (beyond @ size >= _SHOWN * size[parent])
    for part in order:
        children = np.flatnonzero((parent == part) & shown)
        ends, center_line, center = head[children], surface.line[surface.line_part == part], middle[[part]]
        if images is not None and images.own[part]:
            ends, center_line, center = (images.onto_plane(points) for points in (ends, center_line, center))
        tail[part] = _end(head[part], ends, center_line, center, parent[part] < 0)
        if np.linalg.norm(tail[part] - head[part]) < shortest:
            tail[part] = head[part] + shortest * _up(images)
    if images is not None:
        tail = _even(images, tail)
    only = (parent >= 0) & (np.bincount(parent[parent >= 0], minlength=count)[parent] == 1)
    connected = only & (np.linalg.norm(tail[parent] - head, axis=1) <= 1e-6 * shortest)
    return Bones(head, tail, parent, connected, tuple(order))


@dataclass(frozen=True, eq=False)
class _Joints:
    """Where parts hold together.

    table, cuts : of the parts. pairs : (e, 2), parts that touch. length : (e,), of the cut between them, as nothing
    where they touch without one. contacts : the places of the latter, (r, 3), by the two parts.
    """

    table: CornerTable
    cuts: CutEdges
    pairs: np.ndarray
    length: np.ndarray
    contacts: dict[tuple[int, int], np.ndarray]

    @classmethod
    def between(cls, table: CornerTable, labels: np.ndarray, images: PartImages | None) -> _Joints:
        """Cuts, and contacts between what no cuts connect, with their images at a plane."""
        low, high = table.edge_labels(labels)
        cut = np.flatnonzero(low < high)
        pairs, which = distinct_pairs(low[cut], high[cut])
        length = np.bincount(which, np.maximum(table.edge_length(cut), 1e-300), len(pairs))
        contacts = dict(touching_groups(table, labels, pairs))
        if images is not None and images.mirror is not None:
            for pair, places in list(contacts.items()):
                low_one, high_one = np.sort(images.twin[list(pair)]).tolist()
                if low_one >= 0:
                    contacts.setdefault((low_one, high_one), images.mirror.mirrored(places))
        touching = np.array(list(contacts), np.int64).reshape(-1, 2)
        nothing = 1e-9 * length.min(initial=1.0)
        return cls(table, CutEdges.of(table, labels), np.concatenate([pairs, touching]),
                   np.append(length, np.full(len(touching), max(nothing, 1e-300))), contacts)

    def by_cut(self, parent: np.ndarray) -> np.ndarray:
        """Which parts are not held by their parents through a contact alone, (count,) bool."""
        pairs = np.sort(np.stack([np.arange(len(parent)), parent], axis=1), axis=1)
        return np.array([tuple(pair) not in self.contacts for pair in pairs.tolist()])

    def place(self, part: int, parent: int, beyond: np.ndarray, otherwise: np.ndarray) -> np.ndarray:
        """Where a part's bone begins, (3,). beyond : (count,) bool, the parts that follow it, itself included."""
        # Of all that divides the two sides, which may be more than one cut: a leg meets belly and rump.
        border, _, middle = _border(self.table, self.cuts, beyond)
        if len(border):
            return middle
        contact = self.contacts.get((min(part, parent), max(part, parent)))
        return otherwise if contact is None else contact.mean(axis=0)  # an image may hang on what it does not touch


def _weights(area: np.ndarray) -> np.ndarray:
    """Areas of faces, (p,), of which none is without one."""
    return np.maximum(area, 1e-12 * max(area.sum(), 1e-300))


def _middles(table: CornerTable, labels: np.ndarray, weight: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """The center of each part's surface, (count, 3), and the means of the faces' corners, (p, 3)."""
    center = table.face_means(table.vertices)
    return middles_of_each(labels, center, weight, int(labels.max()) + 1)[1], center


def _up(images: PartImages | None) -> np.ndarray:
    """The direction of bones that would have no length, (3,): upwards, or as nearly as the plane of symmetry goes."""
    up, side = np.eye(3)[[2, 0]]
    if images is None or images.mirror is None:
        return up
    normal = images.mirror.normal
    within = side - normal[0] * normal if abs(normal[2]) > 0.9 else up - normal[2] * normal
    return within / np.linalg.norm(within)


def _even(images: PartImages, points: np.ndarray) -> np.ndarray:
    """Ends of bones, (count, 3), as images of each other: of two the first counts; their own ones are in the plane.

    Without a plane they stay where they are.
    """
    if images.mirror is None:
        return points
    first = points[images.first]
    image = images.first != np.arange(len(points))
    return np.where(images.own[:, None], images.onto_plane(points),
                    np.where(image[:, None], images.mirror.mirrored(first), points))


def limb_bones(surface: BoneSurface) -> tuple[Bones, np.ndarray, np.ndarray]:
    """Make bones for parts that can be bent where they are cut; all other parts have that of the part they hang on.

    Parameters
    ----------
    surface : BoneSurface

    Returns
    -------
    bones : Bones
    bone_part : (k,) int64
        The part that each bone is of.
    part_bone : (count,) int64
        The bone that moves each part.
    """
    surface, owner = surface.joined(), np.arange(int(surface.labels.max()) + 1)
    while True:
        bone_part, part_bone = np.unique(owner, return_inverse=True)
        images = None if surface.images is None else surface.images.of_bones(bone_part, part_bone)
        in_limbs = replace(surface, labels=part_bone[surface.labels], images=images,
                           line_part=np.where(surface.line_part < 0, -1, part_bone[surface.line_part]))
        bones = part_bones(in_limbs)
        hangs = _hanging(bones, _necks(in_limbs, bones), images)
        if not hangs.any():
            return bones, bone_part, part_bone
        owner = np.where(hangs, bone_part[bones.parent], bone_part)[part_bone]


def _hanging(bones: Bones, neck: np.ndarray, images: PartImages | None) -> np.ndarray:
    """Which bones, (count,) bool, become one with those that they hang on, of those that begin at no neck.

    Each waits for all that follows it: once a leg of several parts is one, its cut may be a neck. And for its image.
    """
    hangs = ~neck if images is None else ~neck[images.first]
    last = hangs & ((following(bones.parent, bones.order) & hangs).sum(axis=1) == 1)
    return last if images is None else last & last[images.image]


def _necks(surface: BoneSurface, bones: Bones) -> np.ndarray:
    """Whether each bone begins at a neck, (count,) bool; true for roots. surface : joined."""
    table, labels, area = surface.table, surface.labels, surface.area
    low, high = table.edge_labels(labels)
    center = table.face_means(table.vertices)
    beyond, neck, cuts = following(bones.parent, bones.order), bones.parent < 0, CutEdges.of(table, labels)
    for bone in np.flatnonzero(~neck).tolist():
        border, length, middle = _border(table, cuts, beyond[bone])
        if not len(border):  # a piece of its own
            neck[bone] = True
            continue
        pair = sorted((bone, int(bones.parent[bone])))
        own = length[(low[border] == pair[0]) & (high[border] == pair[1])].sum()
        radius = np.linalg.norm(table.vertices[table.edges[border]].mean(axis=1) - middle, axis=1).max()
        away = [np.linalg.norm((area[side, None] * center[side]).sum(axis=0) / max(area[side].sum(), 1e-300) - middle)
                for side in (beyond[bone][labels], ~beyond[bone][labels])]
        neck[bone] = own >= _OWN * length.sum() and min(away) >= _AWAY * radius
    return neck


def _border(table: CornerTable, cuts: CutEdges, inside: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Edges between parts that are inside, (count,) bool, and others, (b,); their lengths; the middle of all, (3,)."""
    border = cuts.around(inside)
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
    images: PartImages, pairs: np.ndarray, length: np.ndarray, height: np.ndarray
) -> tuple[np.ndarray, list[int]]:
    """As ``_tree``, but its own mirror image: a part in the plane hangs on none beside it, or is a root."""
    used = np.unique(images.first)
    middle, beside = images.own[used], images.image[used] != used
    place = np.searchsorted(used, images.first)
    low, high = np.sort(place[pairs], axis=1).T
    apart = low != high
    joined, which = distinct_pairs(low[apart], high[apart])
    total = sums_by(which, length[apart], len(joined))
    total = total + 2.0 * total.sum() * middle[joined].all(axis=1)  # along the plane if there is a way
    # A root is not beside the plane if anything is not that hangs together with it.
    before, order = _tree(len(used), joined, total, height[used] + beside * (1.0 + np.ptp(height)))
    for part in order:
        while middle[part] and before[part] >= 0 and beside[before[part]]:
            before[part] = before[before[part]]
    parent, both = np.full(len(images.twin), -1), []
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

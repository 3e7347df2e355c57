# SPDX-License-Identifier: GPL-3.0-or-later
"""Bones: one for each part, from the cut toward the body along the part's center line to its far end."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from ...arrays.int64 import arange
from ...arrays.pairs import distinct_pairs
from ...arrays.vectors import box_diagonal
from ...mesh.corners import CornerTable
from ...mesh.cut_edges import CutEdges
from ...symmetry.plane import MirrorPlane
from .bone_trees import even_tree, following, part_tree
from .groups import off_ground, touching_groups
from .part_images import PartImages, face_weights, middles

# Least length of a bone, as a share of the diagonal of the box of all that is no ground. A shorter bone is replaced by
# one of this length that points upwards.
_SHORTEST = 0.01
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
    ground : (count,) bool, optional
        The parts that are grounds, such as a floor, not all of them: each is a root without children.
    """

    table: CornerTable
    labels: np.ndarray
    area: np.ndarray
    height: np.ndarray
    line: np.ndarray
    line_part: np.ndarray
    images: PartImages | None = None
    ground: np.ndarray | None = None

    @property
    def count(self) -> int:
        """Number of parts."""
        return int(self.labels.max()) + 1

    @property
    def grounds(self) -> np.ndarray:
        """(count,) bool, the parts that are grounds."""
        return np.zeros(self.count, bool) if self.ground is None else self.ground

    @property
    def diagonal(self) -> float:
        """Diagonal of the bounding box of all that is no ground, in units of the vertices."""
        return self.off_ground.diagonal

    @property
    def off_ground(self) -> CornerTable:
        """The table of all that is no ground, see the function."""
        return off_ground(self.table, self.labels, self.grounds)

    def with_images(self, twin: np.ndarray, mirror: MirrorPlane | None) -> BoneSurface:
        """The surface with its parts' images, see ``PartImages.of_parts``; twin : (count,) int64, as of ``Parts``."""
        middle, center = middles(self.table, self.labels, face_weights(self.area))
        size = box_diagonal(center[~self.grounds[self.labels]])
        return replace(self, images=PartImages.of_parts(twin, mirror, middle, size))

    def joined(self) -> BoneSurface:
        """The surface on vertices of which no two, as files split them, are at one place."""
        return replace(self, table=self.table.joined()[0])


def part_bones(surface: BoneSurface) -> Bones:
    """Make a bone for each part, and a tree of bones along the cuts between parts, and contacts between their pieces.

    surface : BoneSurface. Returns Bones, one for each of its parts.
    """
    surface = surface.joined()
    table, labels, images, count = surface.table, surface.labels, surface.images, surface.count
    weight = face_weights(surface.area)
    middle, _ = middles(table, labels, weight)
    size = np.bincount(labels, weight, count)
    joints = _Joints.between(surface)
    of_part = np.bincount(labels, weight * table.face_means(surface.height), count) / size
    known = joints.pairs, joints.length, of_part
    parent, order = part_tree(count, *known) if images is None else even_tree(images, *known)
    head, beyond = middle.copy(), following(parent, order)
    for part in np.flatnonzero(parent >= 0).tolist():
        head[part] = joints.place(part, int(parent[part]), beyond[part], middle[part])
    if images is not None:
        head = images.even(head)
    shortest = max(_SHORTEST * surface.diagonal, np.finfo(float).tiny)
    shown = joints.by_cut(parent) | (beyond @ size >= _SHOWN * size[parent])
    tail = _tails(surface, head, middle, parent, shown, shortest)
    only = (parent >= 0) & (np.bincount(parent[parent >= 0], minlength=count)[parent] == 1)
    connected = only & (np.linalg.norm(tail[parent] - head, axis=1) <= 1e-6 * shortest)
    return Bones(head, tail, parent, connected, tuple(order))


def _tails(surface: BoneSurface, head: np.ndarray, middle: np.ndarray, parent: np.ndarray, shown: np.ndarray,
           shortest: float) -> np.ndarray:
    """Where the bones end, (count, 3).

    head, middle : (count, 3), where they start, and middles of parts. shown : (count,) bool, the bones at which that on
    which they hang may end. shortest : least length of a bone.
    """
    tail, images = head.copy(), surface.images
    for part in range(len(parent)):
        ends, line, center = head[(parent == part) & shown], surface.line[surface.line_part == part], middle[[part]]
        if images is not None and images.own[part]:
            ends, line, center = (images.onto_plane(points) for points in (ends, line, center))
        tail[part] = _end(head[part], ends, line, center, parent[part] < 0)
        if np.linalg.norm(tail[part] - head[part]) < shortest:
            tail[part] = head[part] + shortest * _up(images)
    return tail if images is None else images.even(tail)


@dataclass(frozen=True, eq=False)
class _Joints:
    """Where parts hold together.

    table, cuts : of the parts that are no grounds. pairs : (e, 2), parts that touch. length : (e,), of the cut between
    them, as nothing where they touch without one. contacts : the places of the latter, (r, 3), by the two parts.
    """

    table: CornerTable
    cuts: CutEdges
    pairs: np.ndarray
    length: np.ndarray
    contacts: dict[tuple[int, int], np.ndarray]

    @classmethod
    def between(cls, surface: BoneSurface) -> _Joints:
        """Cuts, and contacts between what no cuts connect, with their images at a plane."""
        table, labels, images = surface.off_ground, surface.labels, surface.images
        low, high = table.edge_labels(labels)
        cut = np.flatnonzero(low < high)
        pairs, which = distinct_pairs(low[cut], high[cut])
        length = np.bincount(which, np.maximum(table.edge_length(cut), 1e-300), len(pairs))
        contacts = dict(touching_groups(table, labels, pairs, surface.grounds))
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
        pairs = np.sort(np.stack([arange(len(parent)), parent], axis=1), axis=1)
        return np.array([tuple(pair) not in self.contacts for pair in pairs.tolist()])

    def place(self, part: int, parent: int, beyond: np.ndarray, otherwise: np.ndarray) -> np.ndarray:
        """Where a part's bone begins, (3,). beyond : (count,) bool, the parts that follow it, itself included."""
        # Of all that divides the two sides, which may be more than one cut: a leg meets belly and rump.
        border, _, middle = border_of(self.table, self.cuts, beyond)
        if len(border):
            return middle
        contact = self.contacts.get((min(part, parent), max(part, parent)))
        return otherwise if contact is None else contact.mean(axis=0)  # an image may hang on what it does not touch


def border_of(table: CornerTable, cuts: CutEdges, inside: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Edges between parts that are inside, (count,) bool, and others, (b,); their lengths; the middle of all, (3,)."""
    border = cuts.around(inside)
    length = np.maximum(table.edge_length(border), 1e-300)
    return border, length, (length / length.sum()) @ table.vertices[table.edges[border]].mean(axis=1)


def _up(images: PartImages | None) -> np.ndarray:
    """The direction of bones that would have no length, (3,): upwards, or as nearly as the plane of symmetry goes."""
    up, side = np.eye(3)[[2, 0]]
    if images is None or images.mirror is None:
        return up
    normal = images.mirror.normal
    within = side - normal[0] * normal if abs(normal[2]) > 0.9 else up - normal[2] * normal
    return within / np.linalg.norm(within)


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

# SPDX-License-Identifier: GPL-3.0-or-later
"""Changes by hand made on both sides of a plane of symmetry."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from ...arrays.indexing import last_of_each
from ...arrays.int64 import arange, full
from ...arrays.pairs import distinct_pairs
from ...mesh.face_graph import FaceGraph, connect
from ..numbering import NumberedParts

CRUMB = 0.02  # share of its part's area below which a region that the image of a change leaves alone is no part


def twin_numbers(numbered: NumberedParts) -> dict[int, int]:
    """Number of the mirror image of each part that has one; a part may be its own.

    numbered : NumberedParts. Returns dict of int -> int.
    """
    twin = numbered.parts.twin
    has = np.flatnonzero(twin >= 0)
    return dict(zip(numbered.numbers[has].tolist(), numbered.numbers[twin[has]].tolist(), strict=True))


@dataclass(frozen=True, eq=False)
class MirroredChange:
    """A change by hand and its mirror image.

    Attributes
    ----------
    graph : FaceGraph
        Of p faces.
    touching : FaceGraph
        All of these that touch: with contacts between faces of different pieces.
    twin : (p,) int64
        Mirror image of each face; -1 for none.
    before, asked, both : (p,) int64
        Number of the part of each face before the change, after it, and after its mirror image, too.
    """

    graph: FaceGraph
    touching: FaceGraph
    twin: np.ndarray
    before: np.ndarray
    asked: np.ndarray
    both: np.ndarray

    @property
    def extra(self) -> np.ndarray:
        """(p,) bool, faces that the image changed."""
        return self.both != self.asked

    @cached_property
    def regions(self) -> tuple[np.ndarray, np.ndarray]:
        """Connected region of one part that each face is in before the change, and after it, (p,) int64 twice."""
        return self.graph.regions(self.before)[1], self.graph.regions(self.asked)[1]


def cleaned(change: MirroredChange) -> np.ndarray:
    """Have the mirror image of a change consist of as few regions as the change itself, and leave as few.

    Where faces have no exact images the image may be scattered, see ``gathered``, or leave a few faces alone that the
    change did not, see ``without_crumbs``.

    Parameters
    ----------
    change : MirroredChange
        Of p faces.

    Returns
    -------
    both : (p,) int64
        As asked where less than half of the image would be left.
    """
    return without_crumbs(replace(change, both=gathered(change)))


def without_crumbs(change: MirroredChange) -> np.ndarray:
    """Give what the mirror image of a change cut off by chance to the part around it; regions that changed stay.

    Where faces have no exact images, the image of a cut may leave a few of them alone that the cut itself did not.

    change : MirroredChange, of p faces. Returns the number of the part of each face, (p,) int64.
    """
    # What touches its part is in one region with it: to be alone is to have no contact, either.
    graph, both, extra = change.touching, change.both, change.extra
    region = graph.regions(both)[1]
    small = np.bincount(region, graph.area)[region] < CRUMB * np.bincount(both, graph.area)[both]
    concerned = np.isin(both, np.concatenate([change.asked[extra], both[extra]]))
    left = np.bincount(region, both != change.before)[region] == 0
    crumb = small & concerned & left
    return np.where(crumb, connect(graph, both), both) if crumb.any() else both


def gathered(change: MirroredChange) -> np.ndarray:
    """Have the mirror image of a change in as many regions as the change itself.

    Where faces have no exact images, as on surfaces that lie inside each other, the image of a region may be scattered:
    the region that has most of it stays, and the others go to what is around them in the same part. As asked, without
    an image, where less than half of the image would be left.

    change : MirroredChange, of p faces. Returns the number of the part of each face, (p,) int64.
    """
    area, extra = change.graph.area, change.extra
    # Crumbs of the image first: what lies around one may be a single region without it.
    once = _without_strays(change, change.both, image_only=True)
    result = _without_strays(change, once, image_only=False)
    lost = area[extra & (result != change.both)].sum()
    return change.asked if lost > 0.5 * area[extra].sum() else result


def _without_strays(change: MirroredChange, both: np.ndarray, image_only: bool) -> np.ndarray:
    """One round of ``gathered``: the part of each face, (p,), from ``both``, (p,), that it has by now.

    image_only : only what the image alone consists of goes to what is around it.
    """
    graph, before, extra = change.graph, change.before, both != change.asked
    if not extra.any():
        return both
    region = graph.regions(both)[1]
    stray = _strays(change, extra, region)
    if image_only:
        stray[region[~extra]] = False
    number, area = np.zeros(len(stray), np.int64), np.bincount(region, graph.area)
    number[region] = both
    # Of each part, where strays go back to: the largest, of those that stay if there are some.
    main = last_of_each(number, ~stray, area, count=int(number.max()) + 1)[number]
    stray &= main != arange(len(stray))
    if not stray.any():
        return both
    # Nothing goes to another part than those that its own part is cut into.
    touching = change.touching
    first, second = touching.pairs.T
    near = (before[first] == before[second]) | (region[first] == region[second])
    weight = np.where(stray[region], 1e-9, 1.0) * graph.area  # so that it is the strays that move
    around = FaceGraph(graph.n_faces, touching.pairs[near], touching.length[near], weight)
    return number[connect(around, np.where(stray, main, arange(len(stray)))[region])]


def _strays(change: MirroredChange, extra: np.ndarray, region: np.ndarray) -> np.ndarray:
    """Regions after the image of a change that are neither the best image of a region before it nor what it left.

    extra : (p,) bool, faces that the image changed. region : (p,) int64, of each face after it. Returns (r,) bool.
    """
    area, twin = change.graph.area, change.twin
    former, wanted = change.regions
    stray = np.ones(int(region.max()) + 1, bool)
    # Those that the image left alone were there, or are wanted; of those that it cut, most of what is left stays.
    whole = np.bincount(wanted)[wanted] == np.bincount(region)[region]
    stray[region[whole & ~extra]] = False
    left = np.flatnonzero(~extra)
    place, of, share = _shared(region[left], former[left], area[left])
    largest = last_of_each(of, share, count=int(former.max()) + 1)
    stray[place[largest[largest >= 0]]] = False
    has = np.flatnonzero(twin >= 0)
    place, of, share = _shared(region[has], wanted[twin[has]], area[has])
    most = last_of_each(place, share, count=len(stray))  # what each region is mostly the image of
    most = most[most >= 0]
    best = last_of_each(of[most], share[most], count=int(wanted.max()) + 1)
    stray[place[most[best[best >= 0]]]] = False
    return stray


def _shared(first: np.ndarray, second: np.ndarray, area: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Pairs of regions that faces are in both of, (k,) int64 each, and how much area that is, (k,) float64.

    first, second : (f,) int64, of each face. area : (f,) float64.
    """
    pairs, index = distinct_pairs(first, second)
    return *pairs.T, np.bincount(index, area, len(pairs))


@dataclass(frozen=True, eq=False)
class Sides:
    """Where the faces of a symmetric model lie, and its parts.

    Attributes
    ----------
    twin : (p,) int64
        Mirror image of each face; -1 for none.
    of_face : (p,) int
        1 or -1 for the two sides of the plane of symmetry, 0 for a face across it.
    of_part : (k,) int
        Side of the part of each number; 0 for a part without an image on the other side.
    """

    twin: np.ndarray
    of_face: np.ndarray
    of_part: np.ndarray


def own_halves(before: np.ndarray, asked: np.ndarray, sides: Sides) -> np.ndarray:
    """Leave to the image of a part what that would take itself, where the part takes faces together with their images.

    A part that touches the plane of symmetry grows beyond it, and its image, which grows as well, has the better claim
    to what lies there.

    Parameters
    ----------
    before, asked : (p,) int64
        Number of the part of each face before a change and after it.
    sides : Sides

    Returns
    -------
    asked : (p,) int64
        As before where both sides would have gone to a part of the other one.
    """
    return np.where(are_beyond(before, asked, sides), before, asked)


def are_beyond(before: np.ndarray, after: np.ndarray, sides: Sides) -> np.ndarray:
    """Which faces a change gave to a part that lies on the other side, and their images to the same part, (p,) bool.

    As in ``own_halves``; a number beyond those of ``sides.of_part`` is that of a new part, which has no side.
    """
    twin = sides.twin
    given = (before != after) & (twin >= 0)
    side_of_part = np.append(sides.of_part, 0)[np.minimum(after, len(sides.of_part))]
    return given & given[twin] & (after == after[twin]) & (sides.of_face * side_of_part < 0)


def on_both_sides(
    before: np.ndarray, after: np.ndarray, twin: np.ndarray, twin_number: dict[int, int], new: Callable[[], int],
    ended: Iterable[int] = (),
) -> np.ndarray:
    """Make the mirror image of a change as well.

    Parameters
    ----------
    before, after : (n,) int64
        Number of the part of each face or candidate before and after the change.
    twin : (n,) int64
        Mirror image of each; -1 for none.
    twin_number : dict of int -> int
        Mirror image of each part there was; see ``twin_numbers``.
    new : callable
        Returns a number that no part has, another one each time.
    ended : iterable of int
        Parts of which the user wanted nothing left.

    Returns
    -------
    after : (n,) int64
        As given where the image of a change meets the change itself, or parts that are no images of each other, or
        where another part than those that ended would have nothing left.
    """
    result = after.copy()
    moved = after != before
    image_of = full(max(int(before.max()), *twin_number, 0) + 1, -1)
    image_of[list(twin_number)] = list(twin_number.values())
    for number in np.unique(after[moved & (twin >= 0)]).tolist():
        mine = np.flatnonzero(moved & (twin >= 0) & (after == number))
        image = twin[mine]
        target = twin_number.get(number, 0)
        if not (before == number).any():
            # A new part that reaches over the plane, or a half of which the other half is left, is its own image.
            itself = after[image] == number
            target = number if itself.mean() > 0.5 else new()
        if not target:
            continue
        # Those whose image has changed, not the images of those that have: several may share an image, and others are
        # nobody's.
        there = np.flatnonzero(~moved & (twin >= 0))
        there = there[after[twin[there]] == number]
        result[there[image_of[before[twin[there]]] == before[there]]] = target
    gone = np.setdiff1d(after, [*np.unique(result), *ended])
    image_stays = np.isin([twin_number.get(number, number) for number in gone.tolist()], after)
    return after.copy() if image_stays.any() else result

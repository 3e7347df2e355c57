# SPDX-License-Identifier: GPL-3.0-or-later
"""Names for parts that say what they are: a word where the shape is clear enough, else the place and the kind."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from ..result.decomposition import Parts

# Up is the third axis, the front is towards the negative second one, as in Blender; of a model whose plane of symmetry
# is turned about the third, its own axes that are nearest to these.
_PLACES = (("right", "left"), ("front", "back"), ("bottom", "top"))

# None of the numbers of creatures is sharp: each 0.7 or 1.4 times as large names 1,401 to 1,474 parts of rigged models
# rightly instead of 1,454, and 199 to 246 wrongly instead of 224 (docs/quality.md).
# Shares of the model's height, width or length.
_FOOT = 0.08  # a part that comes so near to the ground stands on it
_ASIDE = 0.12  # the middle of a part that is so far from the body's middle is at this side of it
_OFF = 0.06  # of a leg or an arm, which the middle of the model has none of, half of that tells its side
_MIDST = 0.15  # a part whose middle is nearer than that to the body's lies in the midst of it
_APART = 0.075  # half of that: what belongs to a limb is so far to one side, and a belly that hangs down nearer
_AHEAD = 0.15  # the middle of a head, or of a tail where these are weighed, is so far before or behind the body's
_BEHIND = 0.3  # that of what is called a tail is farther: a rump or a saddle is nearer
_SHOE = 0.2  # a foot is shorter than that; what is longer and flat, as a tail on the ground, lies there
_RISE = 0.1  # a head reaches so far above the middle of the body, and a part that is chest and head above its top
_BROW = 0.2  # of the head's height: an ear may end so far below the top of it
# Shares of the surface, of the model or of another part.
_SPECK = 0.01  # a head is larger: smaller ones are horns, knobs of a helmet and hooks on a back
_MUZZLE = 0.3  # what hangs on a head and is less large, is its muzzle, its hat or an ear; a head is larger than that
_EAR = 0.3  # an ear is less large than so much of its head
# Ratios.
_UPRIGHT = 1.2  # a model so many times as high as long is upright
_CLEAR = 2.0  # the end of a creature with so many times as much hanging on it has the head
_LYING = 1.5  # a part that is so many times as long as high lies on the ground instead of standing there
_MIDWAY = 4.0  # and one so many times as long as it is to one side: a tail there, but no leg that is stretched out
_THIN = 0.6  # a tail is at most so many times as wide as the body
_NECK = 1.3  # a part between head and body that is less long may be the head, and the head its snout
_REACH = 1.3  # an arm or a tail is at least so many times as long as wide
_BROAD = 1.2  # a part between them, of an upright creature, that is so many times as wide as the head has the shoulders
_LONG = 1.8  # a part so many times as long as wide is a limb
_BENT = 1.2  # a handle so many times, as it is bent
_LEVEL = 0.5  # a plane of symmetry is one of left and right if its normal is so level, as a share of its length
_OBLONG = 1.2  # seen from above, a model so many times as long as wide has a longest axis

_FOUR = 4  # legs of a creature that has its head where a head is looked for
_LOOSE = 10**6  # cuts from the body to a part that does not hang on it: more than a model has


@dataclass(frozen=True, eq=False)
class Touching:
    """Which parts touch, and which of them is the body; the same whichever way the model is turned.

    Attributes
    ----------
    parts : Parts
        With k parts.
    """

    parts: Parts

    @cached_property
    def neighbors(self) -> list[set[int]]:
        """Parts that each part touches."""
        found: list[set[int]] = [set() for _ in range(self.parts.count)]
        for a, b in self.parts.cuts.tolist():
            found[a].add(b)
            found[b].add(a)
        return found

    @cached_property
    def body(self) -> int:
        """The part that most area hangs on: the one that leaves the smallest remainders when it is taken away."""
        largest = self._remainders()
        # Those were summed in another order. Of parts that are equal but for rounding, the sums below tell.
        near = np.flatnonzero(largest <= largest.min() + 1e-9 * self.parts.share.sum())
        return min(near.tolist(), key=self._remainder)

    def _remainder(self, part: int) -> float:
        """The largest share of what hangs together once a part is taken away, of what hung on it."""
        seen, largest = {part}, 0.0
        for start in self.neighbors[part]:
            if start in seen:
                continue
            waiting, total = [start], 0.0
            seen.add(start)
            while waiting:
                at = waiting.pop()
                total += self.parts.share[at]
                waiting += (new := self.neighbors[at] - seen)
                seen |= new
            largest = max(largest, total)
        return largest

    def _remainders(self) -> np.ndarray:
        """(k,) float64, what ``_remainder`` says of each part, but for rounding: all at once.

        In a depth-first search, what was reached from a part is cut off by it unless it touches what came before it.
        """
        order, above, place = self._depth_first()
        share, low, below, largest = self.parts.share, place.copy(), self.parts.share.copy(), np.zeros(len(place))
        cut_off = np.zeros(len(place))
        for part in reversed(order):
            low[part] = min([low[part], *(place[other] for other in self.neighbors[part])])
            parent = above[part]
            if parent < 0:
                continue
            if low[part] >= place[parent]:
                largest[parent] = max(largest[parent], below[part])
                cut_off[parent] += below[part]
            low[parent], below[parent] = min(low[parent], low[part]), below[parent] + below[part]
        root = np.arange(len(place))
        for part in order:
            root[part] = root[above[part]] if above[part] >= 0 else part
        return np.maximum(largest, np.where(above >= 0, below[root] - cut_off - share, 0.0))

    def _depth_first(self) -> tuple[list[int], np.ndarray, np.ndarray]:
        """Parts in the order of a depth-first search; what each is reached from, -1 for none; the place of each."""
        order: list[int] = []
        above, place = np.full(self.parts.count, -1), np.full(self.parts.count, -1)
        for root in range(self.parts.count):
            waiting = [(root, -1)]
            while waiting:
                part, parent = waiting.pop()
                if place[part] < 0:
                    place[part], above[part] = len(order), parent
                    order.append(part)
                    waiting += [(other, part) for other in self.neighbors[part] if place[other] < 0]
        return order, above, place

    @cached_property
    def steps(self) -> np.ndarray:
        """(k,) int64, over how many cuts each part hangs on the body; a large number for loose ones."""
        steps, at, reached = np.full(self.parts.count, _LOOSE), [self.body], 0
        steps[self.body] = 0
        while at:
            reached += 1
            at = [part for part in {other for part in at for other in self.neighbors[part]} if steps[part] > reached]
            steps[at] = reached
        return steps


@dataclass(frozen=True, eq=False)
class Shapes:
    """Where parts are and how large: upright as in the world, turned about that axis until the model lies along others.

    Attributes
    ----------
    touching : Touching
        Of k parts.
    low, high : (k, 3) float64
        Corners of the box around each part.
    middle : (k, 3) float64
        Middle of the surface of each part.
    length : (k, 3) float64
        Extents of each part along its own axes, longest first.
    across : int
        The axis, 0 or 1, across a creature.
    others : tuple of Shapes
        Other ways in which a creature may look, where no plane of symmetry tells.
    """

    touching: Touching
    low: np.ndarray
    high: np.ndarray
    middle: np.ndarray
    length: np.ndarray
    across: int
    others: tuple[Shapes, ...] = ()

    @classmethod
    def of(cls, parts: Parts, center: np.ndarray, area: np.ndarray, points: np.ndarray,
           point_face: np.ndarray, turn: np.ndarray) -> Shapes:
        """Measure parts.

        Parameters
        ----------
        parts : Parts
            Of p faces.
        center, area : (p, 3) and (p,) float64
            Of the faces, in the world.
        points, point_face : (c, 3) float64 and (c,) int64
            The corners of all faces, and the face of each.
        turn : (3, 3) float64
            Takes directions of the decomposition to those of the world.
        """
        plane = parts.decomposition.plane
        normal = np.zeros(3) if plane is None else turn @ plane.normal
        known = np.linalg.norm(normal[:2]) > _LEVEL * np.linalg.norm(normal)
        weight = area + 1e-12 * area.sum() + 1e-300
        faces = Touching(parts), center, weight, points, point_face
        found = cls._turned(*faces, _onto_axis(normal[:2]) if known else np.eye(3))
        found = replace(found, across=int(abs(normal[1]) > abs(normal[0])))
        if normal.any():  # if it is not level, a creature lies on its side
            return found
        others = [replace(found, across=1 - found.across)]
        if len(longest := _longest(center, weight)):
            along = cls._turned(*faces, _onto_axis(longest))
            others += [replace(found, low=along.low, high=along.high, middle=along.middle, across=axis)
                       for axis in (0, 1)]
        return replace(found, others=tuple(others))

    @classmethod
    def _turned(cls, touching: Touching, center: np.ndarray, weight: np.ndarray, points: np.ndarray,
                point_face: np.ndarray, turn: np.ndarray) -> Shapes:
        """Measure parts once they are turned."""
        parts = touching.parts
        labels, count, center, points = parts.labels, parts.count, center @ turn.T, points @ turn.T
        total = np.bincount(labels, weight, count)
        middle = np.stack([np.bincount(labels, weight * axis, count) for axis in center.T], axis=1) / total[:, None]
        low, high = np.full((count, 3), np.inf), np.full((count, 3), -np.inf)
        np.minimum.at(low, labels[point_face], points)
        np.maximum.at(high, labels[point_face], points)
        offset = center - middle[labels]
        spread = np.stack([np.bincount(labels, weight * offset[:, i] * offset[:, j], count)
                           for i in range(3) for j in range(3)], axis=1).reshape(-1, 3, 3) / total[:, None, None]
        length = np.sqrt(np.maximum(np.linalg.eigvalsh(spread)[:, ::-1], 0.0))
        return cls(touching, low, high, middle, length, 0)

    @property
    def parts(self) -> Parts:
        """The parts themselves."""
        return self.touching.parts

    @property
    def neighbors(self) -> list[set[int]]:
        """Parts that each part touches."""
        return self.touching.neighbors

    @property
    def body(self) -> int:
        """The part that most area hangs on."""
        return self.touching.body

    @property
    def steps(self) -> np.ndarray:
        """(k,) int64, over how many cuts each part hangs on the body."""
        return self.touching.steps

    @cached_property
    def size(self) -> np.ndarray:
        """(3,) float64, extents of the whole model."""
        return np.maximum(self.high.max(axis=0) - self.low.min(axis=0), 1e-300)

    @cached_property
    def elongation(self) -> np.ndarray:
        """(k,) float64, how many times as long as wide each part is."""
        return self.length[:, 0] / np.maximum(self.length[:, 1], 1e-9 * self.size.max())

    @cached_property
    def offset(self) -> np.ndarray:
        """(k, 3) float64, from the middle of the body to that of each part, as shares of the model's extents."""
        return (self.middle - self.middle[self.body]) / self.size

    @cached_property
    def upright(self) -> bool:
        """Whether a creature would stand on two legs: it is higher than long."""
        return bool(self.size[2] > _UPRIGHT * self.size[1 - self.across])

    @cached_property
    def aside(self) -> np.ndarray:
        """(k,) float64, how far to one side of the body each part is, as a share of the model's width."""
        return self.offset[:, self.across]

    @cached_property
    def hanging(self) -> list[int]:
        """Parts that hang on the body."""
        return np.flatnonzero((self.steps > 0) & (self.steps < _LOOSE)).tolist()

    @cached_property
    def feet(self) -> list[int]:
        """Parts that stand on the ground: what lies there, as a tail does, or a belly in the midst, does not stand."""
        extent, aside, long = self.high - self.low, np.abs(self.aside), (self.high - self.low)[:, 1 - self.across]
        down = self.middle[:, 2] < self.middle[self.body, 2]
        lies = long > np.maximum(_LYING * extent[:, 2], _MIDWAY * aside * self.size[self.across])
        lies &= long > _SHOE * self.size.max()
        inside = (aside < _APART) & (not self.upright)
        grounded = self.low[:, 2] - self.low[:, 2].min() < _FOOT * self.size[2]
        stands = grounded & (down | (self.elongation > _LONG)) & ~lies & ~inside
        return [part for part in self.hanging if stands[part]]

    @cached_property
    def legs(self) -> list[int]:
        """The feet, and what is between them and the body."""
        return self.feet + self.between(self.feet)

    @cached_property
    def trunk(self) -> list[int]:
        """What belongs to the body although it is a part of its own: what a leg touches, unless it rises above that.

        A rump has the hind legs, and is neither a head nor a tail. What rises is chest, neck and head in one.
        """
        touched = {other for part in self.legs for other in self.neighbors[part]} - {*self.legs, self.body}
        return [part for part in sorted(touched) if self.high[part, 2] < self.high[self.body, 2] + _RISE * self.size[2]]

    @cached_property
    def ahead(self) -> int:
        """1 or -1, the direction along a creature in which its head is; 0 if that is not clear.

        Head and neck, high and in the midst, are larger than a tail.
        """
        along = self.offset[:, 1 - self.across]
        there = (np.abs(self.aside) < _MIDST) & (np.abs(along) > _AHEAD) & (self.offset[:, 2] > 0.0)
        there[[self.body, *self.legs, *self.trunk]] = False
        front, back = (float(self.parts.share[there & (sign * along > 0)].sum()) for sign in (1, -1))
        return 0 if max(front, back) < _CLEAR * min(front, back) or front == back else 1 if front > back else -1

    def between(self, ends: list[int]) -> list[int]:
        """Parts on the way from the body to some ends of limbs, as far as they are to one side of the body."""
        found: list[int] = []
        at = list(ends)
        while at:
            at = [part for part in {other for part in at for other in self.neighbors[part]
                                    if 0 < self.steps[other] < self.steps[part]}
                  if (abs(self.aside[part]) > _APART or self.paired[part]) and part not in found and part not in ends]
            found += at
        return found

    @cached_property
    def paired(self) -> np.ndarray:
        """(k,) bool, whether a part has a mirror image that is another part."""
        return self.parts.side != 0


def _longest(center: np.ndarray, weight: np.ndarray) -> np.ndarray:
    """The longest axis of a model seen from above, (2,), or (0,) if it is not clear. center, weight : of the faces."""
    away = center[:, :2] - np.average(center[:, :2], axis=0, weights=weight)
    spread, axes = np.linalg.eigh((weight[:, None] * away).T @ away)
    return axes[:, 1] if spread[1] > _OBLONG**2 * spread[0] else np.empty(0)


def _onto_axis(level: np.ndarray) -> np.ndarray:
    """The least turn about the third axis, (3, 3), that brings a level direction, (2,), onto one of the others."""
    angle = np.arctan2(level[1], level[0])
    angle -= np.round(angle / (np.pi / 2)) * np.pi / 2
    cos, sin = np.cos(angle), np.sin(angle)
    return np.array([[cos, sin, 0.0], [-sin, cos, 0.0], [0.0, 0.0, 1.0]])


@dataclass(frozen=True)
class Suggestion:
    """What a part may be called, in English words.

    Attributes
    ----------
    word : str
        What it is: body, head, neck, arm, leg, tail, ear or handle; or its kind alone, limb, tip or piece.
    place : str
        Where it is, if that is clear and tells it from others: front, back, top, bottom, left, right, or "".
    side : int
        1 for the side of the positive first axis, which Blender calls left, -1 for the other one, 0 for neither.
    """

    word: str
    place: str = ""
    side: int = 0


def suggestions(shapes: Shapes) -> list[Suggestion]:
    """Suggest a name for each part.

    A handle is the part that forms a loop together with the one part that it touches. A creature stands on legs on both
    sides of a body that does not touch the ground, and has a head: in the midst of it, in front of the body unless the
    model is upright, and of the parts there one that reaches highest. Of one with more than four legs, only these and
    the body are named: which end has the head is not clear. Parts that fit no rule get their kind only.

    Where no plane of symmetry tells which way a creature looks, it is a way in which it has a head, and of these that
    in which most parts have a word.

    Returns
    -------
    names : list of Suggestion
        One for each part.
    """
    words = _words(shapes)
    for other in shapes.others:
        found = _words(other)
        if "head" in found.values() and ("head" not in words.values() or len(found) > len(words)):
            shapes, words = other, found
    has_head = "head" in words.values()
    return [_suggestion(shapes, part, words.get(part, ""), has_head) for part in range(shapes.parts.count)]


def _words(shapes: Shapes) -> dict[int, str]:
    """The words for those parts that have one, by their number."""
    words = dict.fromkeys(_handles(shapes), "handle")
    creature = [] if words or shapes.parts.count < 2 else _creature(shapes)
    for word, found in creature:
        for part in found:
            words.setdefault(part, word)
    return words


def _suggestion(shapes: Shapes, part: int, word: str, has_head: bool) -> Suggestion:
    """The name of a part: of its word, or without one of its kind. has_head : whether a part is called head."""
    if part == shapes.body:
        return Suggestion(word or "body")
    offset = shapes.offset[part].copy()
    if word in {"leg", "arm", "ear"}:
        return _limb(shapes, part, word, has_head)
    if word:
        return Suggestion(word)
    inner = len(shapes.neighbors[part]) > 1
    kind = "piece" if inner else "limb" if shapes.elongation[part] > _LONG else "tip"
    if shapes.paired[part]:
        offset[shapes.across] = 0.0  # the side says that
    axis = int(np.abs(offset).argmax())
    places: tuple[str, ...] = _PLACES[axis]
    if has_head and axis == 1 - shapes.across and shapes.ahead:  # a creature's front is where its head is
        places = ("back", "front")[:: shapes.ahead]
    place = places[int(offset[axis] > 0)] if abs(offset[axis]) > _ASIDE else ""
    return Suggestion(kind, place, int(shapes.parts.side[part]))


def _limb(shapes: Shapes, part: int, word: str, has_head: bool) -> Suggestion:
    """The name of a limb of a creature: with its side, and of four legs whether in front, towards the head, or back."""
    across, along = shapes.aside[part], shapes.ahead * shapes.offset[part, 1 - shapes.across]
    side = int(shapes.parts.side[part]) or (int(np.sign(across)) if abs(across) > _OFF else 0)
    tells = word == "leg" and has_head and not shapes.upright and abs(along) >= _ASIDE
    place = ("front" if along > 0 else "back") if tells else ""
    return Suggestion(word, place, side)


def _handles(shapes: Shapes) -> list[int]:
    """Parts that form a loop of the graph together with the one larger part that they touch."""
    graph, parts = shapes.parts.decomposition.graph, shapes.parts
    if not graph.n_loops:
        return []
    point = parts.point_part
    # Every step along the graph from one part into another.
    same = graph.point_arc[1:] == graph.point_arc[:-1]
    full = np.flatnonzero(np.diff(graph.arc_points))
    steps = np.concatenate([
        np.stack([point[:-1][same], point[1:][same]], axis=1),
        np.stack([parts.node_part[graph.arcs[full, 0]], point[graph.arc_points[full]]], axis=1),
        np.stack([point[graph.arc_points[full + 1] - 1], parts.node_part[graph.arcs[full, 1]]], axis=1)])
    crossings = np.bincount(steps[steps[:, 0] != steps[:, 1]].ravel(), minlength=parts.count)
    return [part for part in range(parts.count) if crossings[part] == 2 and len(shapes.neighbors[part]) == 1
            and shapes.elongation[part] > _BENT
            and parts.share[part] < parts.share[next(iter(shapes.neighbors[part]))]]


def _creature(shapes: Shapes) -> list[tuple[str, list[int]]]:
    """Words for the parts of a creature that stands on legs, the surest first; none for other models."""
    if not _stands(shapes):
        return []
    legs, body = shapes.legs, ("body", [shapes.body])
    if _n_limbs(shapes) > _FOUR:
        # Of insects and spiders, the abdomen may be larger and higher than the head, which may have feelers.
        return [("leg", legs), body]
    others = [part for part in shapes.hanging if part not in legs]
    midst = _midst(shapes, others)
    head = _head(shapes, midst)
    if head is None:
        return [("leg", legs)]
    found = [("leg", legs), ("head", [head]), body, ("neck", _neck(shapes, midst, head)),
             ("ear", _ears(shapes, others, head))]
    return [*found, ("arm", _arms(shapes, others, head)) if shapes.upright else ("tail", _tail(shapes, others, head))]


def _stands(shapes: Shapes) -> bool:
    """Whether a model stands as a creature does: on both sides of a body that is above the ground."""
    aside, above = shapes.aside[shapes.feet], shapes.low[shapes.body, 2] - shapes.low[:, 2].min()
    return bool(len(aside) and aside.min() < 0.0 < aside.max() and above >= _FOOT * shapes.size[2])


def _midst(shapes: Shapes, others: list[int]) -> list[int]:
    """Parts among which head and neck of a creature are. others : parts that hang on the body and are no legs."""
    midst = [part for part in others if abs(shapes.aside[part]) < _MIDST and part not in shapes.trunk]
    if shapes.upright:
        return midst
    return [part for part in midst if shapes.ahead * shapes.offset[part, 1 - shapes.across] > _AHEAD]


def _neck(shapes: Shapes, midst: list[int], head: int) -> list[int]:
    """Parts between the head and the body, unless they are as wide as shoulders."""
    wide = (shapes.high - shapes.low)[:, shapes.across]
    return [part for part in midst if part in shapes.neighbors[head] and shapes.steps[part] < shapes.steps[head]
            and shapes.elongation[part] > _NECK and (not shapes.upright or wide[part] < _BROAD * wide[head])]


def _ears(shapes: Shapes, others: list[int], head: int) -> list[int]:
    """Small parts that touch nothing but the head and reach as high."""
    brow = shapes.high[head, 2] - _BROW * (shapes.high - shapes.low)[head, 2]
    return [part for part in others if shapes.neighbors[part] == {head} and shapes.high[part, 2] > brow
            and shapes.parts.share[part] < _EAR * shapes.parts.share[head]]


def _arms(shapes: Shapes, others: list[int], head: int) -> list[int]:
    """Long parts beside the body of an upright creature, and what is between them and the body."""
    ends = [part for part in others if shapes.elongation[part] > _REACH and part != head
            and abs(shapes.aside[part]) > _ASIDE and shapes.middle[part, 2] > shapes.low[shapes.body, 2]
            and head not in shapes.neighbors[part]]
    return ends + [part for part in shapes.between(ends) if part not in shapes.legs]


def _tail(shapes: Shapes, others: list[int], head: int) -> list[int]:
    """Long and thin parts at the other end of the body than the head."""
    return [part for part in others if abs(shapes.aside[part]) < _MIDST and head not in shapes.neighbors[part]
            and shapes.elongation[part] > _REACH and shapes.length[part, 1] < _THIN * shapes.length[shapes.body, 1]
            and shapes.ahead * shapes.offset[part, 1 - shapes.across] < -_BEHIND]


def _n_limbs(shapes: Shapes) -> int:
    """How many legs the parts of legs are: those that touch are of one, but for feet that the body itself touches."""
    waiting, count = set(shapes.legs), 0
    while waiting:
        count, at = count + 1, [waiting.pop()]
        while at:
            new = shapes.neighbors[at.pop()] & waiting
            waiting -= new
            at += new
    return max(count, sum(shapes.steps[part] == 1 for part in shapes.feet))


def _head(shapes: Shapes, midst: list[int]) -> int | None:
    """The part in the midst of the model that reaches highest, if that is above the body; None for none.

    Of what hangs on each other there it is the outermost one, unless that is small: then it is a muzzle or a hat.
    """
    share, lowest = shapes.parts.share, shapes.middle[shapes.body, 2] + _RISE * shapes.size[2]
    high = {part for part in midst if share[part] > _SPECK and shapes.high[part, 2] > lowest}
    ends = [part for part in midst if part in high and not any(
        shapes.steps[other] > shapes.steps[part] and share[other] > _MUZZLE * share[part]
        for other in shapes.neighbors[part] & high)]
    return max(ends, key=lambda part: shapes.high[part, 2]) if ends else None

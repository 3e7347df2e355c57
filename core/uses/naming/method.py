# SPDX-License-Identifier: GPL-3.0-or-later
"""The rules: which word a part gets, or which place and kind; of a creature, which of its parts is the head."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from .shapes import AHEAD, FOOT, LONG, MIDST, RISE, Shapes

# Up is the third axis, the front is towards the negative second one, as in Blender; of a model whose plane of symmetry
# is turned about the third, its own axes that are nearest to these.
_PLACES = (("right", "left"), ("front", "back"), ("bottom", "top"))

# Of these numbers, too, none is sharp, see ``shapes``.
# Shares of the model's height, width or length.
_ASIDE = 0.12  # the middle of a part that is so far from the body's middle is at this side of it
_OFF = 0.06  # of a leg, an arm or an ear, which the middle of the model has none of, half of that tells its side
_BEHIND = 0.3  # the middle of what is called a tail is farther behind the body's: a rump or a saddle is nearer
_BROW = 0.2  # of the head's height: an ear may end so far below the top of it
# Shares of the surface, of the model or of another part.
_SPECK = 0.01  # a head is larger: smaller ones are horns, knobs of a helmet and hooks on a back
_MUZZLE = 0.3  # what hangs on a head and is less large, is its muzzle, its hat or an ear; a head is larger than that
_EAR = 0.3  # an ear is less large than so much of its head
# Ratios.
_THIN = 0.6  # a tail is at most so many times as wide as the body
_NECK = 1.3  # a part between head and body that is less long may be the head, and the head its snout
_REACH = 1.3  # an arm or a tail is at least so many times as long as wide
_BROAD = 1.2  # a part between them, of an upright creature, that is so many times as wide as the head has the shoulders
_BENT = 1.2  # a handle is at least so many times as long as wide, as it is bent

# Words for what is beside the middle; a head, a neck, a tail and a body are there once.
_TWICE = frozenset({"arm", "leg", "ear", "horn", "handle"})

_FOUR = 4  # legs of a creature that has its head where a head is looked for


@dataclass(frozen=True)
class Suggestion:
    """What a part may be called, in English words.

    Attributes
    ----------
    word : str
        What it is: body, head, neck, arm, leg, tail, ear, horn or handle, or the ground on which all of it stands; or
        its kind alone, limb, tip or piece.
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

    Two parts that are mirror images have one name, with two sides: of two words that which there may be two of, of two
    places and kinds those of the first.

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
    names = [_suggestion(shapes, part, words.get(part, ""), has_head) for part in range(shapes.parts.count)]
    for one, image in shapes.pairs:
        side = int(shapes.parts.side[one])
        names[one], names[image] = replace(names[one], side=side), replace(names[one], side=-side)
    return names


def _words(shapes: Shapes) -> dict[int, str]:
    """The words for those parts that have one, by their number."""
    words = dict.fromkeys(_handles(shapes), "handle")
    for word, found in [] if words else _creature(shapes):
        for part in found:
            words.setdefault(part, word)
    for pair in shapes.pairs:
        theirs = [words.pop(part) for part in pair if part in words]
        words |= dict.fromkeys(pair, next((word for word in theirs if word in _TWICE), ""))
    return {part: word for part, word in words.items() if word}


def _suggestion(shapes: Shapes, part: int, word: str, has_head: bool) -> Suggestion:
    """The name of a part: of its word, or without one of its kind. has_head : whether a part is called head."""
    if part == shapes.body and not shapes.paired[part]:
        return Suggestion(word or "body")
    if shapes.ground[part]:
        return Suggestion("ground")
    offset = shapes.offset[part].copy()
    if word in {"leg", "arm", "ear", "horn"}:
        return _limb(shapes, part, word, has_head)
    if word:
        return Suggestion(word)
    inner = len(shapes.neighbors[part]) > 1
    kind = "piece" if inner else "limb" if shapes.elongation[part] > LONG else "tip"
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
    steps = np.concatenate([
        np.stack([point[:-1][same], point[1:][same]], axis=1),
        np.stack([parts.node_part[graph.arcs[:, 0]], point[graph.arc_points[:-1]]], axis=1),
        np.stack([point[graph.arc_points[1:] - 1], parts.node_part[graph.arcs[:, 1]]], axis=1)])
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
    ears = _ears(shapes, others, head)
    found = [("leg", legs), ("head", [head]), body, ("neck", _neck(shapes, midst, head)),
             ("horn", _horns(shapes, ears)), ("ear", ears)]
    return [*found, ("arm", _arms(shapes, others, head)) if shapes.upright else ("tail", _tail(shapes, others, head))]


def _stands(shapes: Shapes) -> bool:
    """Whether a model stands as a creature does: on both sides of a body that is above the ground."""
    aside, above = shapes.aside[shapes.feet], shapes.low[shapes.body, 2] - shapes.bottom
    return bool(len(aside) and aside.min() < 0.0 < aside.max() and above >= FOOT * shapes.size[2])


def _midst(shapes: Shapes, others: list[int]) -> list[int]:
    """Parts among which head and neck of a creature are. others : parts that hang on the body and are no legs."""
    midst = [part for part in others if abs(shapes.aside[part]) < MIDST and part not in shapes.trunk
             and not shapes.paired[part]]
    if shapes.upright:
        return midst
    return [part for part in midst if shapes.ahead * shapes.offset[part, 1 - shapes.across] > AHEAD]


def _neck(shapes: Shapes, midst: list[int], head: int) -> list[int]:
    """Parts between the head and the body, unless they are as wide as shoulders."""
    wide = (shapes.high - shapes.low)[:, shapes.across]
    return [part for part in midst if part in shapes.neighbors[head] and shapes.steps[part] < shapes.steps[head]
            and shapes.elongation[part] > _NECK and (not shapes.upright or wide[part] < _BROAD * wide[head])]


def _ears(shapes: Shapes, others: list[int], head: int) -> list[int]:
    """Small parts beside the middle of the head that touch it, and otherwise each other alone, and reach as high."""
    brow = shapes.high[head, 2] - _BROW * (shapes.high - shapes.low)[head, 2]
    small = {part for part in others if head in shapes.neighbors[part]
             and shapes.share[part] < _EAR * shapes.share[head]}
    return [part for part in others if part in small and shapes.neighbors[part] <= {head, *small}
            and shapes.high[part, 2] > brow and (shapes.paired[part] or abs(shapes.aside[part]) > _OFF)]


def _horns(shapes: Shapes, ears: list[int]) -> list[int]:
    """Of two pairs of what may be ears the one that is nearer to the midst and reaches higher: eyes reach less high."""
    pairs = [pair for pair in shapes.pairs if set(pair) <= set(ears)]
    if len(pairs) != 2:
        return []
    inner, outer = sorted(pairs, key=lambda pair: abs(shapes.aside[list(pair)]).mean())
    return list(inner) if shapes.high[list(inner), 2].max() > shapes.high[list(outer), 2].max() else []


def _arms(shapes: Shapes, others: list[int], head: int) -> list[int]:
    """Long parts beside the body of an upright creature, and what is between them and the body."""
    ends = [part for part in others if shapes.elongation[part] > _REACH and part != head
            and abs(shapes.aside[part]) > _ASIDE and shapes.middle[part, 2] > shapes.low[shapes.body, 2]
            and head not in shapes.neighbors[part]]
    return ends + [part for part in shapes.between(ends) if part not in shapes.legs]


def _tail(shapes: Shapes, others: list[int], head: int) -> list[int]:
    """Long and thin parts at the other end of the body than the head."""
    return [part for part in others if abs(shapes.aside[part]) < MIDST and head not in shapes.neighbors[part]
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
    share, lowest = shapes.share, shapes.middle[shapes.body, 2] + RISE * shapes.size[2]
    high = {part for part in midst if share[part] > _SPECK and shapes.high[part, 2] > lowest}
    ends = [part for part in midst if part in high and not any(
        shapes.steps[other] > shapes.steps[part] and share[other] > _MUZZLE * share[part]
        for other in shapes.neighbors[part] & high)]
    return max(ends, key=lambda part: shapes.high[part, 2]) if ends else None

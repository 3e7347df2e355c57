# SPDX-License-Identifier: GPL-3.0-or-later
"""The cuts of separated parts as a list on the object: what joins them, and what the user chose for some.

A cut is known by its two parts and, of the cuts between these, by its place: the largest is the first.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable

import bpy

from .. import transaction
from ..joints import CutJoints
from ..result import part_names


def chosen(obj: bpy.types.Object, part: dict[int, int]) -> Callable[[int, int], str]:
    """What gives the joint that the user chose for a cut, or "", by the keys of its pieces; the largest comes first.

    part : dict of int -> int, the number of the part for the key of a piece, where that is another one.
    """
    mine = _chosen(obj)
    asked: Counter = Counter()

    def kind_of(one: int, other: int) -> str:
        pair = _pair((one, other), part)
        asked[pair] += 1
        return mine.get((*pair, asked[pair] - 1), "")

    return kind_of


def _chosen(obj: bpy.types.Object) -> dict[tuple[int, int, int], str]:
    """What the user chose, by the numbers of the parts, the lower first, and the place of the cut between them."""
    if not obj.is_property_set("reeb_parts_made"):  # to read it would set it
        return {}
    return {(cut.low, cut.high, cut.place): cut.joint for cut in obj.reeb_parts_made.cuts if cut.joint != "ALL"}


def write(obj: bpy.types.Object, cuts: list[CutJoints], part: dict[int, int], numbers: list[int]) -> None:
    """List the cuts; what the user chose stays, also for cuts that are not there now.

    cuts : list of CutJoints, the largest first. part : see ``chosen``. numbers : the parts that were separated; cuts
    between others stay listed as they are.
    """
    transaction.keep_group(obj, "reeb_parts_made")
    mine = _chosen(obj)
    listed = obj.reeb_parts_made.cuts
    found: dict[tuple[int, int, int], tuple[int, float, str] | None] = {
        (cut.low, cut.high, cut.place): (cut.count, cut.width, cut.why) for cut in listed
        if cut.low not in numbers and cut.high not in numbers}
    count: Counter = Counter()
    for cut in cuts:
        pair = _pair(cut.keys, part)
        found[*pair, count[pair]] = cut.count, cut.width, cut.why
        count[pair] += 1
    found |= dict.fromkeys(mine.keys() - found.keys())
    listed.clear()
    for name in sorted(found):
        entry = listed.add()
        entry.low, entry.high, entry.place = name
        entry.joint = mine.get(name, "ALL")
        if (now := found[name]) is not None:
            entry.count, entry.width, entry.why = now


def _pair(keys: tuple[int, int], part: dict[int, int]) -> tuple[int, int]:
    """The numbers of the parts of two pieces, the lower first."""
    low, high = sorted(part.get(key, key) for key in keys)
    return low, high


def cut_name(obj: bpy.types.Object, cut: bpy.types.PropertyGroup) -> str:
    """What a cut of the list is called."""
    name = " - ".join(part_names.part_name(obj.data, number) for number in (cut.low, cut.high))
    return f"{name} ({cut.place + 1})" if cut.place else name

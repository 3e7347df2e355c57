# SPDX-License-Identifier: GPL-3.0-or-later
"""Change parts by hand: merge, split, grow and shrink them, candidate by candidate.

The functions want Object Mode and raise SceneError where a change is not possible; nothing is written then. Those that
return a Stored write nothing at all, so that several of them are written together or not at all. They import what needs
SciPy from core when they are called, so that the panel comes up without it.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import bpy
import numpy as np
from bpy.app.translations import pgettext_rpt as rpt_

from ...core.arrays.components import components
from ...core.mesh.face_graph import FaceGraph
from ...core.result.parts import Parts
from ..errors import SceneError
from ..result import part_names
from ..store import Stored
from . import pins

_BESIDE = 0.5  # share of a candidate's faces, more on one side than on the other, from which on it is of that side


def _twins(stored: Stored) -> dict[int, int]:
    """Mirror image of each part that has one, by number, itself for one across the plane; empty without Symmetry."""
    from ...core.result.editing.mirrored import twin_numbers

    return twin_numbers(stored.shown_parts()) if bpy.context.scene.reeb_parts.symmetry else {}


def one_of_each_pair(stored: Stored, numbers: list[int]) -> list[int]:
    """Parts without those that change with their mirror images, which come before them."""
    twin = _twins(stored)
    return [number for place, number in enumerate(numbers) if twin.get(number) not in numbers[:place]]


def merged(mesh: bpy.types.Mesh, stored: Stored, numbers: list[int], into: int) -> Stored:
    """The result with one part of several; raises SceneError if they do not touch.

    One that lies across the plane cannot be in a part of one side and in its mirror image as well: it is merged with
    the images of the others, too, unless one of these is locked.
    """
    pins.check_unlocked(mesh, numbers)
    if not _touch(stored, numbers):
        raise SceneError(rpt_("These parts do not touch each other. Choose parts that do."))
    pin, twin = pins.pinned, _twins(stored)
    both = [*numbers, *(twin.get(number, number) for number in numbers)]
    across = any(twin.get(number) == number for number in numbers)
    if across and _touch(stored, both) and not set(both) & set(pins.locked_others(mesh, 0)):
        pin, numbers = pins.with_pins, both
    return pin(mesh, stored, np.where(np.isin(stored.shown, numbers), into, stored.shown), [into])


def _touch(stored: Stored, numbers: list[int]) -> bool:
    """Whether parts hang together."""
    from ...core.result.editing.changes import components_of

    return components_of(stored.decomposition, np.isin(stored.shown, numbers)).max() <= 0


def merged_into_neighbors(mesh: bpy.types.Mesh, stored: Stored, numbers: list[int]) -> Stored:
    """The result with parts merged into the neighbors beyond their least salient cuts, as all of them are now.

    Of parts that are each other's nearest the largest takes the others; one that lies across the plane of symmetry
    takes neighbors on both sides. Where the user has given the neighbor no name, but has named the largest part of all
    that become one, that is which stays. numbers : of parts.
    """
    numbered = stored.shown_parts()
    cuts = numbered.numbers[numbered.parts.cuts]
    into = {number: _neighbor(numbered.parts, cuts, number) for number in numbers}
    if alone := [number for number, other in into.items() if not other]:
        raise SceneError(rpt_("{name} touches no other part.").format(name=part_names.part_name(mesh, alone[0])))
    twin = _twins(stored)
    into |= {twin[part]: twin[other] for part, other in into.items() if part in twin and other in twin}
    size = dict(zip(numbered.numbers.tolist(), numbered.parts.share.tolist(), strict=True))
    known, named = sorted({*into, *into.values()}), part_names.kept_names(mesh)
    ends = np.searchsorted(known, np.array(list(into.items())))
    _, group = components(len(known), *ends.T)
    for index in range(int(group.max()) + 1):
        members = [number for number, place in zip(known, group.tolist(), strict=True) if place == index]
        across = [number for number in members if twin.get(number) == number]
        ends_here = [number for number in across or members if number not in into] or across or members
        end, largest = (max(some, key=lambda number: size[number]) for some in (ends_here, members))
        stored = merged(mesh, stored, members, largest if largest in named and end not in named else end)
    return stored


def _neighbor(parts: Parts, cuts: np.ndarray, number: int, locked: Sequence[int] = ()) -> int:
    """The number of a part's neighbor beyond its least salient cut; of equals, beyond the longest; 0 without one.

    cuts : (e, 2) int64, ``parts.cuts`` by the numbers of the parts. locked : numbers of parts that are none.
    """
    own = np.flatnonzero((cuts == number).any(axis=1) & ~np.isin(cuts, locked).any(axis=1))
    if not len(own):
        return 0
    first, second = cuts[own[np.lexsort((-parts.cut_length[own], parts.cut_salience[own]))[0]]].tolist()
    return first if second == number else second


def small_merged(mesh: bpy.types.Mesh, stored: Stored, small: Iterable[int]) -> tuple[Stored, int]:
    """The result with small parts merged into their neighbors, each beyond its least salient cut, and how many were.

    Parts that touch nothing, that are locked, or that touch only locked parts stay. One across the plane of symmetry
    goes to another such part if it touches one. small : numbers, smallest first.
    """
    numbers, locked, changed, twin = stored.shown.copy(), pins.locked_others(mesh, 0), set[int](), _twins(stored)
    for number in [number for number in small if number not in locked]:
        parts = Parts(stored.decomposition, numbers)  # whose labels are the numbers
        aside = [other for other, image in twin.items() if other != image] if twin.get(number) == number else []
        into = (_neighbor(parts, parts.cuts, number, [*locked, *aside])
                or _neighbor(parts, parts.cuts, number, locked))
        if not into:
            continue
        for one, other in _with_image(parts.cuts, twin, number, into, locked).items():
            numbers = np.where(numbers == one, other, numbers)
            changed = changed - {one} | {other}
        if twin.get(number) == into:  # two images are one part now
            twin[into] = into
    return pins.pinned(mesh, stored, numbers, changed), len(np.unique(stored.shown)) - len(np.unique(numbers))


def _with_image(cuts: np.ndarray, twin: dict[int, int], number: int, into: int,
                locked: Sequence[int]) -> dict[int, int]:
    """Which part goes to which neighbor, and its mirror image to the image of that, if this can be.

    cuts : (e, 2) int64, numbers of parts that touch. twin : see ``_twins``. locked : numbers of parts that stay.
    """
    image, beyond = twin.get(number), twin.get(into)
    if image is None or beyond is None or image in (number, into, *locked) or beyond in locked:
        return {number: into}
    touch = (np.sort(cuts, axis=1) == sorted((image, beyond))).all(axis=1).any()
    return {number: into, image: beyond} if touch else {number: into}


def halved(mesh: bpy.types.Mesh, stored: Stored, number: int) -> Stored:
    """The result with a part split in two at the most salient cut inside it."""
    from ...core.result.editing.changes import best_split

    side = best_split(stored.decomposition, stored.shown == number)
    return _split_off(mesh, stored, number, side)[0]


def split_at_node(context: bpy.types.Context, mesh: bpy.types.Mesh, stored: Stored, node: int) -> tuple[int, int]:
    """Split the part that holds a node of the graph; the smaller side becomes a new part.

    Returns
    -------
    number, new : int
        The part that was split, and the new one.

    Raises
    ------
    SceneError
        The part is locked, or cannot be split.
    """
    from ...core.result.editing.changes import node_split, smaller_side

    number = int(stored.shown[stored.decomposition.node_candidate[node]])
    pins.check_unlocked(mesh, [number])
    mask = stored.shown == number
    side = node_split(stored.decomposition, mask, node)
    if side is not None:
        side = smaller_side(side, mask, stored.decomposition.candidate_area)
    after, new = _split_off(mesh, stored, number, side)
    pins.write(context, mesh, stored, after)
    return number, new


def _split_off(mesh: bpy.types.Mesh, stored: Stored, number: int, side: np.ndarray | None) -> tuple[Stored, int]:
    """The result with a new part of some candidates of a part, (c,) bool, and its number.

    Raises SceneError if there are none.
    """
    if side is None:
        raise SceneError(
            rpt_("No cut was found inside {name}. Select faces in Edit Mode and assign them to another "
                 "part instead.").format(name=part_names.part_name(mesh, number))
        )
    new = pins.free_number(mesh, stored)
    return pins.pinned(mesh, stored, np.where(side, new, stored.shown), [number, new]), new


def grown(mesh: bpy.types.Mesh, stored: Stored, number: int) -> Stored:
    """The result with the next candidate beyond a part's weakest boundary in it, unless that is of a locked part."""
    from ...core.result.editing.changes import growth

    allowed = _not_locked(mesh, stored, number) & (_own_side(stored, number) > _BESIDE)
    taken = growth(stored.decomposition, stored.shown == number, allowed)
    if taken is None:
        others = pins.locked_others(mesh, number)
        raise SceneError((rpt_("Nothing is left around {name} that is not locked.") if others else
                          rpt_("Nothing is left around {name} that it could take.")).format(
            name=part_names.part_name(mesh, number)))
    return _moved(mesh, stored, taken, number)


def shrunk(mesh: bpy.types.Mesh, stored: Stored, number: int) -> Stored:
    """The result with a candidate of a part in the part beside it, unless that part is locked."""
    from ...core.result.editing.changes import shrinkage

    allowed = _not_locked(mesh, stored, number) & (_own_side(stored, number) > -_BESIDE)
    step = shrinkage(stored.decomposition, stored.shown == number, allowed)
    if step is None:
        raise SceneError(rpt_("{name} cannot give away anything more.").format(name=part_names.part_name(mesh, number)))
    given, receiver = step
    return _moved(mesh, stored, given, int(stored.shown[receiver]))


def _not_locked(mesh: bpy.types.Mesh, stored: Stored, number: int) -> np.ndarray:
    """Candidates that are in no locked part, or in the part itself, (c,) bool."""
    return ~np.isin(stored.shown, pins.locked_others(mesh, number))


def _own_side(stored: Stored, number: int) -> np.ndarray:
    """How far candidates lie on a part's own side of the plane of symmetry, (c,) float64: 1, 0 across it, -1 beyond it.

    All 1 if the part is no mirror image of another. A part and its image cannot both take a candidate across the plane,
    and would change sides if they took from beyond it.
    """
    found, shown = stored.decomposition, stored.shown
    twin = _twins(stored).get(number, number)
    if twin == number or not len(found.face_side):
        return np.ones(len(shown))
    count, beside = np.bincount(found.candidates, minlength=len(shown)), found.candidate_side
    own = np.sign(beside[shown == number].sum())
    return np.where(shown == twin, -1.0, own * beside / np.maximum(count, 1))


def _moved(mesh: bpy.types.Mesh, stored: Stored, candidate: int, number: int) -> Stored:
    """The result with a candidate in a part; small pieces that it cuts off go along, large ones become parts."""
    from ...core.result.editing.remainders import with_small_pieces

    found, giver = stored.decomposition, int(stored.shown[candidate])
    numbers = stored.shown.copy()
    numbers[candidate] = number
    graph = FaceGraph(found.n_candidates, found.candidate_pairs, found.candidate_pair_length, found.candidate_area)
    numbers = with_small_pieces(graph, stored.shown, numbers)
    numbers, also = pins.mirrored_too(mesh, stored, stored.shown, numbers, found.candidate_twin)
    if also:  # it and its image may cut off together what neither does alone
        numbers = with_small_pieces(graph, stored.shown, numbers)
    changed = pins.renumber_pieces(mesh, stored, numbers, {giver, number, *also})
    return pins.with_pins(mesh, stored, numbers, changed)

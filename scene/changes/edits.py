# SPDX-License-Identifier: GPL-3.0-or-later
"""Change parts by hand: merge, split, grow, shrink, assign, release.

Every part that is changed by hand is pinned: it stays as it is while the detail changes around it, and through
another run, until it is released. A part that the user has locked is pinned, too, and cannot be changed at all.

The functions want Object Mode and raise SceneError where a change is not possible; nothing is written then. Those that
return a Stored write nothing at all, so that several of them are written together or not at all. They import what needs
SciPy from core when they are called, so that the panel comes up without it.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import replace

import bpy
import numpy as np
from bpy.app.translations import pgettext_rpt as rpt_

from ...core.arrays.components import components
from ...core.mesh.corners import CornerTable
from ...core.mesh.labels import FaceGraph
from ...core.result.decomposition import Decomposition
from ...core.result.parts import Parts
from ...core.sentence import Count
from .. import bridge, property_updates, store, transaction
from ..errors import SceneError
from ..outputs import face_sets
from ..reading import mesh_arrays
from ..result import part_names
from ..showing.selection import selected_faces
from ..store import Stored
from . import reactions

_BESIDE = 0.5  # share of a candidate's faces, more on one side than on the other, from which on it is of that side


def free_number(mesh: bpy.types.Mesh, stored: Stored, also: Iterable[int] = ()) -> int:
    """The smallest number that no part has or had, that no name is kept for, and that is none of some others."""
    kept = [entry.number for entry in mesh.reeb_parts.names]
    used = {*stored.shown.tolist(), *stored.previous_number.tolist(), *kept, *also}
    return next(number for number in range(1, len(used) + 2) if number not in used)


def check_unlocked(mesh: bpy.types.Mesh, numbers: Iterable[int]) -> None:
    """Raise SceneError if one of some parts is locked."""
    for part in mesh.reeb_parts.parts:
        if part.locked and part.number in numbers:
            raise SceneError(rpt_("{name} is locked. Unlock it in the list first.").format(name=part.name))


def one_of_each_pair(stored: Stored, numbers: list[int]) -> list[int]:
    """Parts without those that change with their mirror images, which come before them."""
    from ...core.result.editing.mirrored import twin_numbers

    if not bpy.context.scene.reeb_parts.symmetry:
        return numbers
    twin = twin_numbers(stored.shown_parts())
    return [number for place, number in enumerate(numbers) if twin.get(number) not in numbers[:place]]


def locked_others(mesh: bpy.types.Mesh, number: int) -> list[int]:
    """Numbers of the locked parts but for one."""
    return [part.number for part in mesh.reeb_parts.parts if part.locked and part.number != number]


def merged(mesh: bpy.types.Mesh, stored: Stored, numbers: list[int], into: int) -> Stored:
    """The result with one part of several; raises SceneError if they do not touch."""
    from ...core.result.editing.changes import components_of

    check_unlocked(mesh, numbers)
    mask = np.isin(stored.shown, numbers)
    if components_of(stored.decomposition, mask).max() > 0:
        raise SceneError(rpt_("These parts do not touch each other. Choose parts that do."))
    return _pinned(mesh, stored, np.where(mask, into, stored.shown), [into])


def merged_into_neighbors(mesh: bpy.types.Mesh, stored: Stored, numbers: list[int]) -> Stored:
    """The result with parts merged into the neighbors beyond their least salient cuts, as all of them are now.

    Of parts that are each other's nearest the largest takes the others. Where the user has given the neighbor no name,
    but has named the largest part of all that become one, that is which stays. numbers : of parts.
    """
    from ...core.result.editing.mirrored import twin_numbers

    numbered = stored.shown_parts()
    cuts = numbered.numbers[numbered.parts.cuts]
    into = {number: _neighbor(numbered.parts, cuts, number) for number in numbers}
    if alone := [number for number, other in into.items() if not other]:
        raise SceneError(rpt_("{name} touches no other part.").format(name=part_names.part_name(mesh, alone[0])))
    if bpy.context.scene.reeb_parts.symmetry:
        twin = twin_numbers(numbered)
        into |= {twin[part]: twin[other] for part, other in into.items() if part in twin and other in twin}
    size = dict(zip(numbered.numbers.tolist(), numbered.parts.share.tolist(), strict=True))
    known, named = sorted({*into, *into.values()}), part_names.kept_names(mesh)
    ends = np.searchsorted(known, np.array(list(into.items())))
    _, group = components(len(known), *ends.T)
    for index in range(int(group.max()) + 1):
        members = [number for number, place in zip(known, group.tolist(), strict=True) if place == index]
        ends_here = [number for number in members if number not in into] or members
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

    Parts that touch nothing, that are locked, or that touch only locked parts stay. small : numbers, smallest first.
    """
    numbers, locked, changed = stored.shown.copy(), locked_others(mesh, 0), set[int]()
    for number in [number for number in small if number not in locked]:
        parts = Parts(stored.decomposition, numbers)  # whose labels are the numbers
        into = _neighbor(parts, parts.cuts, number, locked)
        if into:
            numbers = np.where(numbers == number, into, numbers)
            changed = changed - {number} | {into}
    return _pinned(mesh, stored, numbers, changed), len(np.unique(stored.shown)) - len(np.unique(numbers))


def halved(mesh: bpy.types.Mesh, stored: Stored, number: int) -> Stored:
    """The result with a part split in two at the most salient cut inside it."""
    from ...core.result.editing.changes import best_split

    side = best_split(stored.decomposition, stored.shown == number)
    return _split_off(mesh, stored, number, side)[0]


def split_at_node(context: bpy.types.Context, mesh: bpy.types.Mesh, node: int) -> tuple[int, int]:
    """Split the part that holds a node of the graph; the smaller side becomes a new part.

    Returns
    -------
    number, new : int
        The part that was split, and the new one.

    Raises
    ------
    SceneError
        The part is locked, cannot be split, or the mesh was edited.
    """
    from ...core.result.editing.changes import node_split, smaller_side

    stored = store.load(mesh)
    number = int(stored.shown[stored.decomposition.node_candidate[node]])
    check_unlocked(mesh, [number])
    mask = stored.shown == number
    side = node_split(stored.decomposition, mask, node)
    if side is not None:
        side = smaller_side(side, mask, stored.decomposition.candidate_area)
    after, new = _split_off(mesh, stored, number, side)
    write(context, mesh, stored, after)
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
    new = free_number(mesh, stored)
    return _pinned(mesh, stored, np.where(side, new, stored.shown), [number, new]), new


def grown(mesh: bpy.types.Mesh, stored: Stored, number: int) -> Stored:
    """The result with the next candidate beyond a part's weakest boundary in it, unless that is of a locked part."""
    from ...core.result.editing.changes import growth

    allowed = _not_locked(mesh, stored, number) & (_own_side(stored, number) > _BESIDE)
    taken = growth(stored.decomposition, stored.shown == number, allowed)
    if taken is None:
        raise SceneError(rpt_("Nothing is left around {name} that is not locked.").format(
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
    return ~np.isin(stored.shown, locked_others(mesh, number))


def _own_side(stored: Stored, number: int) -> np.ndarray:
    """How far candidates lie on a part's own side of the plane of symmetry, (c,) float64: 1, 0 across it, -1 beyond it.

    All 1 if the part is no mirror image of another. A part and its image cannot both take a candidate across the plane,
    and would change sides if they took from beyond it.
    """
    from ...core.result.editing.mirrored import twin_numbers

    found, shown = stored.decomposition, stored.shown
    twin = twin_numbers(stored.shown_parts()).get(number, number)
    if twin == number or not bpy.context.scene.reeb_parts.symmetry or not len(found.face_side):
        return np.ones(len(shown))
    count = np.bincount(found.candidates, minlength=len(shown))
    beside = np.bincount(found.candidates, found.face_side, len(shown))
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
    changed = {giver, number} | _part_pieces_(mesh, stored, numbers, giver)
    return _pinned(mesh, stored, numbers, changed)


def assign_selected(context: bpy.types.Context, obj: bpy.types.Object, stored: Stored, number: int) -> str:
    """Give the selected faces to a part; what happened, in a sentence."""
    faces = selected_faces(obj.data)
    if not faces.any():
        raise SceneError(rpt_("No faces are selected. Select some in Edit Mode."))
    before, names = stored.face_numbers, part_names.all_names(obj.data)
    check_unlocked(obj.data, {number, *before[faces].tolist()})
    wanted = assign_faces(context, obj, stored, np.where(faces, number, before))
    told = rpt_("{n} {n:face is|faces are} {name} now").format(
        n=Count(int(faces.sum())), name=part_names.part_name(obj.data, number))
    return "; ".join(filter(None, (told, told_of_rest(obj.data, before, wanted), told_of_ended(obj.data, names))))


def assign_face_sets(context: bpy.types.Context, obj: bpy.types.Object, stored: Stored) -> int:
    """Give each face to the part of its face set, as painted in Sculpt Mode; how many faces changed their part.

    A face set that is no part's number becomes a new part.
    """
    mesh = obj.data
    sets = mesh.attributes.get(face_sets.NAME)
    if not mesh.reeb_parts.has_face_sets or sets is None:
        raise SceneError(rpt_("The parts are not face sets yet. Press Face Sets, then paint them in Sculpt Mode."))
    painted = mesh_arrays.read(sets.data, "value", np.int32)
    before = stored.face_numbers
    after = before.copy()
    taken: list[int] = []
    for value in np.unique(painted).tolist():
        taken.append(value if value in before else free_number(mesh, stored, taken))
        after[painted == value] = taken[-1]
    changed = after != before
    check_unlocked(mesh, {*after[changed].tolist(), *before[changed].tolist()})
    transaction.keep_mesh(mesh)
    sets.data.foreach_set("value", before.astype(np.int32))  # what was drawn becomes parts: none of it is kept aside
    assign_faces(context, obj, stored, after)
    return int(changed.sum())


def assign_faces(context: bpy.types.Context, obj: bpy.types.Object, stored: Stored, face_numbers: np.ndarray,
                 mesh_tables: tuple[FaceGraph, CornerTable] | None = None, beside_taken: float = 0.0) -> np.ndarray:
    """Give faces to parts, and pin all parts concerned; what falls apart becomes several parts.

    Parameters
    ----------
    context : bpy.types.Context
    obj : bpy.types.Object
    stored : Stored
    face_numbers : (p,) int64
        The part of each face from now on.
    mesh_tables : optional
        What ``bridge.face_graph`` gives for the object, if it is known already.
    beside_taken : float
        Small pieces that the change cuts off go along with it, see ``with_small_pieces`` of
        core.result.editing.remainders; 0 for none.

    Returns
    -------
    wanted : (p,) int64
        The part that each face was to be in, with what goes along and the mirror image of the change; pieces have
        other numbers then.
    """
    from ...core.result.editing.finer_candidates import split_around
    from ...core.result.editing.mirrored import MirroredChange, cleaned

    found, before, asked = stored.decomposition, stored.face_numbers, face_numbers
    if np.array_equal(asked, before):
        return asked
    mesh_tables = mesh_tables or bridge.face_graph(obj)
    face_numbers, also = _mirrored(obj.data, stored, before, asked, found.face_twin)
    if also:
        face_numbers = cleaned(
            MirroredChange(mesh_tables[0], found.contacts, found.face_twin, before, asked, face_numbers))
    if beside_taken:  # last, as a part and its image may cut off together what neither does alone
        face_numbers = _with_small_pieces(stored, mesh_tables[0], face_numbers, beside_taken)
    moved = face_numbers != before
    if not moved.any():
        return face_numbers
    concerned = set(np.unique(np.concatenate([face_numbers[moved], before[moved]])).tolist())
    stored = _finer(stored, split_around(found, np.where(moved, face_numbers, 0), *mesh_tables))
    with property_updates.quiet():
        store.save(obj.data, stored)
    numbers = stored.shown.copy()
    numbers[stored.decomposition.candidates[moved]] = face_numbers[moved]
    for number in sorted(concerned):
        if (numbers == number).any():
            concerned |= _part_pieces_(obj.data, stored, numbers, number)
    write(context, obj.data, stored, _with_pins(obj.data, stored, numbers, concerned))
    return face_numbers


def _with_small_pieces(stored: Stored, graph: FaceGraph, after: np.ndarray, beside_taken: float) -> np.ndarray:
    """The part of each face after a change, (p,), with small pieces that it cuts off; on both sides alike."""
    from ...core.result.editing.mirrored import twin_numbers
    from ...core.result.editing.remainders import halved_between_images, with_small_pieces

    found, numbered = stored.decomposition, stored.shown_parts()
    touching = graph.with_contacts(found.contacts)
    along = with_small_pieces(touching, stored.face_numbers, after, beside_taken)
    if not bpy.context.scene.reeb_parts.symmetry or not len(found.face_side):
        return along
    image = np.arange(int(max(along.max(), numbered.numbers.max())) + 1)
    own_side = np.zeros_like(image)
    twin = twin_numbers(numbered)
    image[list(twin)] = list(twin.values())
    own_side[numbered.numbers] = numbered.parts.side
    return halved_between_images(touching, after, along, found.face_twin, found.face_side, own_side, image)


def told_of_rest(mesh: bpy.types.Mesh, before: np.ndarray, wanted: np.ndarray) -> str:
    """What is left of the parts that faces were taken from, in a sentence; "" unless it is in more parts than before.

    before, wanted : (p,) int64, the part of each face before a change, and what ``assign_faces`` gave.
    """
    after, stays = store.load(mesh).face_numbers, wanted == before
    more = np.setdiff1d(after[stays], before)
    if not len(more):
        return ""
    givers = np.unique(before[stays & np.isin(after, more)])
    old, new = (", ".join(part_names.part_name(mesh, number) for number in numbers.tolist())
                for numbers in (givers, more))
    return rpt_("what is left of {givers} is in {n} {n:part|parts} more: {names}").format(
        givers=old, n=Count(len(more)), names=new)


def told_of_ended(mesh: bpy.types.Mesh, names: dict[int, str]) -> str:
    """Which parts a change has left nothing of, in a sentence; "" for none. names : part_names.all_names before it."""
    listed = {part.number for part in mesh.reeb_parts.parts}
    ended = [name for number, name in names.items() if number not in listed]
    if not ended:
        return ""
    return rpt_("nothing is left of {names}").format(names=", ".join(ended))


def _finer(stored: Stored, decomposition: Decomposition) -> Stored:
    """The stored result with finer candidates, which have the numbers of those that they were cut from."""
    origin = np.empty(decomposition.n_candidates, np.int64)
    origin[: len(stored.shown)] = np.arange(len(stored.shown))
    origin[decomposition.candidates] = stored.decomposition.candidates
    return Stored(decomposition, stored.previous_number[origin], stored.pinned[origin], stored.shown[origin])


def _part_pieces_(mesh: bpy.types.Mesh, stored: Stored, numbers: np.ndarray, number: int) -> set[int]:
    """Give all but the largest piece of a part numbers of their own, unless they were apart from it already.

    Parts of pieces that touch nothing are in several; of each of these, too, the largest piece that is left stays.

    Parameters
    ----------
    mesh : bpy.types.Mesh
    stored : Stored
    numbers : (c,) int64
        The part of each candidate; changed in place.
    number : int
        The part that may have fallen apart.

    Returns
    -------
    made : set of int
        The new numbers.
    """
    from ...core.result.editing.changes import components_of

    area = stored.decomposition.candidate_area
    piece = components_of(stored.decomposition, numbers == number)
    former = np.where(piece >= 0, components_of(stored.decomposition, stored.shown == number), -1)
    there = np.flatnonzero(former >= 0)
    fragment, place = np.unique(np.stack([former, piece])[:, there], axis=1, return_inverse=True)
    order = np.lexsort((np.bincount(place.ravel(), area[there], fragment.shape[1]), fragment[0]))
    last = np.append(fragment[0, order][1:] != fragment[0, order][:-1], True)[: len(order)]
    stays = {0, *fragment[1, order[last]].tolist()}
    made = set()
    for index in sorted({*range(piece.max() + 1)} - stays):
        new = free_number(mesh, stored, numbers.tolist())
        made.add(new)
        numbers[piece == index] = new
    return made


def release(context: bpy.types.Context, mesh: bpy.types.Mesh, stored: Stored, numbers: Iterable[int]) -> None:
    """Let the detail, or the number of parts that was typed, decide about parts again; locked parts stay pinned.

    Mirror images, which were pinned together, are released together.
    """
    images = part_names.twins(mesh) if context.scene.reeb_parts.symmetry else {}
    both = {side for number in numbers for side in (number, images.get(number, number))}
    released = list(both - set(locked_others(mesh, 0)))
    with property_updates.quiet():
        store.save_numbers(mesh, replace(stored, pinned=np.where(np.isin(stored.pinned, released), 0, stored.pinned)))
    reactions.show(mesh.reeb_parts, context)


def _pinned(mesh: bpy.types.Mesh, stored: Stored, candidate_numbers: np.ndarray, changed: Iterable[int]) -> Stored:
    """The result with parts that were changed by hand, on both sides, those that are part of the change pinned.

    Parameters
    ----------
    mesh : bpy.types.Mesh
    stored : Stored
    candidate_numbers : (c,) int64
        The part of each candidate from now on.
    changed : iterable of int
        Numbers of the parts to pin.

    Returns
    -------
    stored : Stored
    """
    twin = stored.decomposition.candidate_twin
    candidate_numbers, also = _mirrored(mesh, stored, stored.shown, candidate_numbers, twin)
    return _with_pins(mesh, stored, candidate_numbers, [*changed, *also])


def _with_pins(mesh: bpy.types.Mesh, stored: Stored, candidate_numbers: np.ndarray, changed: Iterable[int]) -> Stored:
    """What ``_pinned`` does, of a change that is made on both sides already."""
    result = mesh.reeb_parts
    to_pin = np.isin(candidate_numbers, list(changed)) | (stored.pinned > 0)
    stored = replace(stored, pinned=np.where(to_pin, candidate_numbers, 0))
    # Around the pinned parts everything is as the hierarchy has it.
    count = len(np.unique(candidate_numbers)) if result.by_number else 0
    return stored.showing(stored.parts(result.detail, count))


def _mirrored(
    mesh: bpy.types.Mesh, stored: Stored, before: np.ndarray, after: np.ndarray, twin: np.ndarray
) -> tuple[np.ndarray, list[int]]:
    """A change of faces or candidates, and its mirror image if the scene's Symmetry is on and no locked part changes.

    before, after : (n,) int64, numbers of parts. twin : (n,) int64, or empty without a plane of symmetry.

    Returns the numbers after both, and those of the parts that the mirror image concerns.
    """
    from ...core.result.editing.mirrored import on_both_sides, twin_numbers

    if not bpy.context.scene.reeb_parts.symmetry or not (twin >= 0).any():
        return after, []
    taken = after.tolist()

    def new() -> int:
        taken.append(free_number(mesh, stored, taken))
        return taken[-1]

    both = on_both_sides(before, after, twin, twin_numbers(stored.shown_parts()), new)
    extra = both != after
    concerned = np.unique(np.concatenate([before[extra], both[extra]])).tolist()
    return (after, []) if set(concerned) & set(locked_others(mesh, 0)) else (both, concerned)


def write(context: bpy.types.Context, mesh: bpy.types.Mesh, before: Stored, after: Stored) -> None:
    """Keep and show another result of the same decomposition. before : what is shown until now."""
    reactions.refresh(context, mesh, replace(after, shown=before.shown), after.shown_parts())

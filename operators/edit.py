# SPDX-License-Identifier: GPL-3.0-or-later
"""Change parts by hand: lock, merge, split, grow, shrink, paint.

Every part that is changed by hand is pinned by that: it stays as it is while the detail changes around
it, and through another run, until it is released. A lock pins a part and keeps the hands off it, too.
"""

from dataclasses import replace

import bpy
import numpy as np
from bpy.app.translations import pgettext_rpt as rpt_

from ..scene import bridge, reactions, store
from ..scene.errors import SceneError
from ..scene.outputs import face_sets
from .parts import PartOperator, chosen_numbers, make_active


def tie(context, obj, stored, candidate_numbers, changed):
    """Show parts that were changed by hand, and pin those that are part of the change.

    Parameters
    ----------
    context : bpy.types.Context
    obj : bpy.types.Object
    stored : store.Stored
    candidate_numbers : (c,) int64
        The part of each candidate from now on.
    changed : iterable of int
        Numbers to pin.
    """
    mesh = obj.data
    result = mesh.reeb_parts
    pinned = np.isin(candidate_numbers, list(changed)) | (stored.fixed > 0)
    tied = replace(stored, fixed=np.where(pinned, candidate_numbers, 0))
    # Around the pinned parts everything is as the hierarchy has it.
    count = len(np.unique(candidate_numbers)) if result.by_number else 0
    reactions.refresh(context, mesh, tied, tied.parts(result.detail, count))


def free_number(mesh, stored) -> int:
    """The smallest number that no part has, had or is named by."""
    used = {*stored.shown.tolist(), *stored.former.tolist(), *(e.number for e in mesh.reeb_parts.names)}
    return next(number for number in range(1, len(used) + 2) if number not in used)


def check_unlocked(obj, numbers):
    """Raise SceneError if one of some parts is locked."""
    for part in obj.data.reeb_parts.parts:
        if part.locked and part.number in numbers:
            raise SceneError(rpt_("{name} is locked. Unlock it in the list first.").format(name=part.name))


def locked_others(mesh, number) -> list[int]:
    """Numbers of the locked parts but for one."""
    return [part.number for part in mesh.reeb_parts.parts if part.locked and part.number != number]


def merge(context, obj, stored, numbers, into):
    """Make one part of several that touch; raises SceneError if they do not."""
    from ..core.result.editing import pieces

    check_unlocked(obj, numbers)
    mask = np.isin(stored.shown, numbers)
    if pieces(stored.decomposition, mask).max() > 0:
        raise SceneError(rpt_("These parts do not touch each other. Choose parts that do."))
    tie(context, obj, stored, np.where(mask, into, stored.shown), [into])


def _name(obj, number):
    return store.part_name(obj.data, number)


class REEB_PARTS_OT_merge(PartOperator, bpy.types.Operator):
    """Make one part of the parts marked in the list; it takes the name of the active one"""

    bl_idname = "reeb_parts.merge"
    bl_label = "Merge Parts"

    def work(self, context, obj, stored):
        result = obj.data.reeb_parts
        numbers = chosen_numbers(obj.data)
        active = result.parts[result.active].number
        into = active if active in numbers else numbers[0]
        if len(numbers) < 2:
            raise SceneError(rpt_("Mark the parts to merge in the list, two or more."))
        merge(context, obj, stored, numbers, into)
        with store.quiet():
            for part in result.parts:
                part.selected = False
        return rpt_("{n} parts are {name} now").format(n=len(numbers), name=_name(obj, into))


class REEB_PARTS_OT_merge_neighbour(PartOperator, bpy.types.Operator):
    """Merge each chosen part into the neighbour that it is least clearly cut from"""

    bl_idname = "reeb_parts.merge_neighbour"
    bl_label = "Merge into Neighbour"

    def work(self, context, obj, stored):
        for number in chosen_numbers(obj.data):
            neighbour = _weakest_neighbour(obj, stored, number)
            merge(context, obj, stored, [number, neighbour], neighbour)
            stored = store.load(obj.data)


def _weakest_neighbour(obj, stored, number):
    """The part beyond the least salient cut; the longest of equals."""
    numbered = stored.shown_parts()
    cuts = numbered.numbers[numbered.parts.cuts]
    own = (cuts == number).any(axis=1)
    if not own.any():
        raise SceneError(rpt_("{name} touches no other part.").format(name=_name(obj, number)))
    order = np.lexsort((-numbered.parts.cut_length[own], numbered.parts.cut_salience[own]))
    ends = cuts[own][order[0]]
    return int(ends[0] if ends[1] == number else ends[1])


class REEB_PARTS_OT_split(PartOperator, bpy.types.Operator):
    """Split each chosen part in two, where its own best cut is"""

    bl_idname = "reeb_parts.split"
    bl_label = "Split Parts"

    def work(self, context, obj, stored):
        from ..core.result.editing import best_split

        check_unlocked(obj, chosen_numbers(obj.data))
        for number in chosen_numbers(obj.data):
            side = best_split(stored.decomposition, stored.shown == number)
            if side is None:
                raise SceneError(
                    rpt_("No cut was found inside {name}. Select faces in Edit Mode and assign them to another "
                         "part instead.").format(name=_name(obj, number))
                )
            new = free_number(obj.data, stored)
            tie(context, obj, stored, np.where(side, new, stored.shown), [number, new])
            stored = store.load(obj.data)


class REEB_PARTS_OT_grow(PartOperator, bpy.types.Operator):
    """Move the boundary of each chosen part outwards, to the next crease beyond its weakest stretch"""

    bl_idname = "reeb_parts.grow"
    bl_label = "Grow Parts"

    def work(self, context, obj, stored):
        from ..core.result.editing import growth

        check_unlocked(obj, chosen_numbers(obj.data))
        for number in chosen_numbers(obj.data):
            mask = stored.shown == number
            taken = growth(stored.decomposition, mask, _not_locked(obj, stored, number))
            if taken is None:
                raise SceneError(
                    rpt_("Nothing is left around {name} that is not locked.").format(name=_name(obj, number)))
            _move(context, obj, stored, taken, number)
            stored = store.load(obj.data)


class REEB_PARTS_OT_shrink(PartOperator, bpy.types.Operator):
    """Move the boundary of each chosen part inwards, to the next crease"""

    bl_idname = "reeb_parts.shrink"
    bl_label = "Shrink Parts"

    def work(self, context, obj, stored):
        from ..core.result.editing import shrinkage

        check_unlocked(obj, chosen_numbers(obj.data))
        for number in chosen_numbers(obj.data):
            mask = stored.shown == number
            step = shrinkage(stored.decomposition, mask, _not_locked(obj, stored, number))
            if step is None:
                raise SceneError(rpt_("{name} cannot give away anything more.").format(name=_name(obj, number)))
            given, receiver = step
            _move(context, obj, stored, given, int(stored.shown[receiver]))
            stored = store.load(obj.data)


def _not_locked(obj, stored, number) -> np.ndarray:
    """Candidates of other parts that the user did not lock, (c,) bool."""
    return ~np.isin(stored.shown, locked_others(obj.data, number))


def _move(context, obj, stored, candidate, number):
    """Give a candidate to a part; what it leaves behind stays in one piece, or becomes several parts."""
    giver = int(stored.shown[candidate])
    numbers = stored.shown.copy()
    numbers[candidate] = number
    changed = {giver, number} | _part_pieces(obj, stored, numbers, giver)
    tie(context, obj, stored, numbers, changed)


def _part_pieces(obj, stored, numbers, number) -> set:
    """Give all but the largest piece of a part numbers of their own, in place; returns these."""
    from ..core.result.editing import pieces

    piece = pieces(stored.decomposition, numbers == number)
    made = set()
    for index in range(1, piece.max() + 1):
        known = replace(stored, shown=np.concatenate([numbers, stored.shown]))
        made.add(free_number(obj.data, known))
        numbers[piece == index] = max(made)
    return made


class REEB_PARTS_OT_assign(PartOperator, bpy.types.Operator):
    """Give the faces selected in Edit Mode to the active part"""

    bl_idname = "reeb_parts.assign"
    bl_label = "Assign Faces to Part"

    new: bpy.props.BoolProperty(name="New part", description="Make a part of its own of the faces")

    def work(self, context, obj, stored):
        mesh = obj.data
        result = mesh.reeb_parts
        faces = np.empty(len(mesh.polygons), bool)
        mesh.polygons.foreach_get("select", faces)
        if not faces.any():
            raise SceneError(rpt_("No faces are selected. Select some in Edit Mode."))
        number = free_number(mesh, stored) if self.new else result.parts[result.active].number
        before = stored.shown[stored.decomposition.candidates]
        check_unlocked(obj, {number, *before[faces].tolist()})
        assign_faces(context, obj, stored, np.where(faces, number, before))
        make_active(mesh, number)
        return rpt_("{n} faces are {name} now").format(n=int(faces.sum()), name=_name(obj, number))


class REEB_PARTS_OT_from_face_sets(PartOperator, bpy.types.Operator):
    """Take over what you have painted with face sets in Sculpt Mode: each face goes to the part of its face set"""

    bl_idname = "reeb_parts.from_face_sets"
    bl_label = "Parts from Face Sets"

    def work(self, context, obj, stored):
        mesh = obj.data
        sets = mesh.attributes.get(face_sets.NAME)
        if not mesh.reeb_parts.has_face_sets or sets is None:
            raise SceneError(rpt_("The parts are not face sets yet. Press Face Sets, then paint them in Sculpt Mode."))
        painted = np.empty(len(mesh.polygons), np.int32)
        sets.data.foreach_get("value", painted)
        before = stored.shown[stored.decomposition.candidates]
        after = before.copy()
        known = stored
        for value in np.unique(painted).tolist():
            number = value
            if value not in before:  # a face set that somebody has made
                number = free_number(mesh, known)
                known = replace(known, shown=np.append(known.shown, number))
            after[painted == value] = number
        changed = after != before
        check_unlocked(obj, {*after[changed].tolist(), *before[changed].tolist()})
        assign_faces(context, obj, stored, after)
        return rpt_("{n} faces are in other parts now").format(n=int(changed.sum()))


def assign_faces(context, obj, stored, face_numbers, graph=None):
    """Give faces to parts, and pin all parts concerned; what falls apart becomes several parts.

    Parameters
    ----------
    context : bpy.types.Context
    obj : bpy.types.Object
    stored : store.Stored
    face_numbers : (p,) int64
        The part of each face from now on.
    graph : core.surface.labels.FaceGraph, optional
        Of the object, if it is known already.
    """
    from ..core.result.editing import split_candidates

    before = stored.shown[stored.decomposition.candidates]
    moved = face_numbers != before
    if not moved.any():
        return
    concerned = set(np.unique(np.concatenate([face_numbers[moved], before[moved]])).tolist())
    graph = graph or bridge.face_graph(obj)
    for number in np.unique(face_numbers[moved]).tolist():
        inside = moved & (face_numbers == number)
        finer = split_candidates(stored.decomposition, inside, graph.area, graph.pairs, graph.length)
        stored = _finer(stored, finer)
    with store.quiet():
        store.save(obj.data, stored)
    numbers = stored.shown.copy()
    numbers[stored.decomposition.candidates[moved]] = face_numbers[moved]
    for number in sorted(concerned):
        if (numbers == number).any():
            concerned |= _part_pieces(obj, stored, numbers, number)
    tie(context, obj, stored, numbers, concerned)


def _finer(stored, decomposition):
    """The same with finer candidates, which have the numbers of those they were cut from."""
    added = np.full(decomposition.n_candidates - len(stored.shown), -1)
    origin = _origins(stored.decomposition.candidates, decomposition.candidates, added)
    return store.Stored(decomposition, stored.former[origin], stored.fixed[origin], stored.shown[origin])


def _origins(old, new, added):
    """The old candidate that each new one was cut from."""
    count = int(old.max()) + 1
    origin = np.concatenate([np.arange(count), added])
    origin[new] = old
    return origin


class REEB_PARTS_OT_release(PartOperator, bpy.types.Operator):
    """Let the detail decide about the chosen parts again, which were changed by hand"""

    bl_idname = "reeb_parts.release"
    bl_label = "Release Parts"

    everything: bpy.props.BoolProperty(name="All", description="Release every part that is not locked")

    def work(self, context, obj, stored):
        result = obj.data.reeb_parts
        locked = {part.number for part in result.parts if part.locked}
        numbers = {part.number for part in result.parts} if self.everything else set(chosen_numbers(obj.data))
        fixed = np.where(np.isin(stored.fixed, list(numbers - locked)), 0, stored.fixed)
        with store.quiet():
            store.save_numbers(obj.data, replace(stored, fixed=fixed))
        result.by_number = False
        reactions.show(result, context)


CLASSES = (
    REEB_PARTS_OT_release,
    REEB_PARTS_OT_merge,
    REEB_PARTS_OT_merge_neighbour,
    REEB_PARTS_OT_split,
    REEB_PARTS_OT_grow,
    REEB_PARTS_OT_shrink,
    REEB_PARTS_OT_assign,
    REEB_PARTS_OT_from_face_sets,
)

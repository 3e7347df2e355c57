# SPDX-License-Identifier: GPL-3.0-or-later
"""Give faces to parts by hand: those selected, painted, knifed or within a moved border.

Candidates that such a change divides become several. The functions want Object Mode and raise SceneError where a change
is not possible; nothing is written then.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import bpy
import numpy as np
from bpy.app.translations import pgettext_rpt as rpt_

from ...core.arrays.int64 import arange
from ...core.mesh.corners import CornerTable
from ...core.mesh.face_graph import FaceGraph
from ...core.result.decomposition import Decomposition
from ...core.result.numbering import NumberedParts
from ...core.sentence import Count
from .. import bridge, property_updates, store, transaction
from ..errors import SceneError
from ..outputs import face_sets
from ..reading import mesh_arrays
from ..result import part_names
from ..showing.selection import selected_faces
from ..store import Stored
from . import pins

if TYPE_CHECKING:
    from ...core.result.editing.mirrored import Sides


def assign_selected(context: bpy.types.Context, obj: bpy.types.Object, stored: Stored, number: int) -> str:
    """Give the selected faces to a part; what happened, in a sentence."""
    faces = selected_faces(obj.data)
    if not faces.any():
        raise SceneError(rpt_("No faces are selected. Select some in Edit Mode."))
    before, names = stored.face_numbers, part_names.all_names(obj.data)
    pins.check_unlocked(obj.data, {number, *before[faces].tolist()})
    wanted = assign_faces(context, obj, stored, np.where(faces, number, before))
    after = store.load(obj.data).face_numbers[faces]
    told = rpt_("{n} {n:face is|faces are} {name} now").format(
        n=Count(int((after == number).sum())), name=part_names.part_name(obj.data, number))
    apart = told_of_apart(int((after != number).sum()))
    rest, ended = told_of_rest(obj.data, before, wanted), told_of_ended(obj.data, names)
    return "; ".join(filter(None, (told, apart, rest, ended)))


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
        taken.append(value if value in before else pins.free_number(mesh, stored, taken))
        after[painted == value] = taken[-1]
    changed = after != before
    pins.check_unlocked(mesh, {*after[changed].tolist(), *before[changed].tolist()})
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

    found, before, asked = stored.decomposition, stored.face_numbers, face_numbers
    if np.array_equal(asked, before):
        return asked
    mesh_tables = mesh_tables or bridge.face_graph(obj)
    touching = mesh_tables[0].with_contacts(found.contacts)
    halves = _own_halves(stored, asked) if beside_taken else asked
    ended = np.setdiff1d(before, asked)
    face_numbers = _mirrored_too(obj.data, stored, halves, mesh_tables[0], touching, ended)
    if halves is not asked and np.array_equal(face_numbers, halves):  # there is no image, as where a part is locked
        face_numbers = _mirrored_too(obj.data, stored, asked, mesh_tables[0], touching, ended)
    if beside_taken:  # last, as a part and its image may cut off together what neither does alone
        face_numbers = _with_small_pieces(stored, touching, face_numbers, beside_taken)
    moved = face_numbers != before
    if not moved.any():
        return face_numbers
    concerned = np.unique(np.concatenate([face_numbers[moved], before[moved]])).tolist()
    stored = _finer(stored, split_around(found, np.where(moved, face_numbers, 0), *mesh_tables))
    with property_updates.quiet():
        store.save(obj.data, stored)
    numbers = stored.shown.copy()
    numbers[stored.decomposition.candidates[moved]] = face_numbers[moved]
    changed = pins.renumber_pieces(obj.data, stored, numbers, concerned)
    pins.write(context, obj.data, stored, pins.with_pins(obj.data, stored, numbers, changed))
    return face_numbers


def _own_halves(stored: Stored, asked: np.ndarray) -> np.ndarray:
    """A change of faces, (p,), without what the image of a part is to have of it; ``asked`` itself if that is all."""
    from ...core.result.editing.mirrored import own_halves

    found, numbered = stored.decomposition, stored.shown_parts()
    if not bpy.context.scene.reeb_parts.symmetry or not len(found.face_side):
        return asked
    halves = own_halves(stored.face_numbers, asked, _sides(found, numbered))
    return asked if np.array_equal(halves, asked) else halves


def _sides(found: Decomposition, numbered: NumberedParts) -> Sides:
    """Where the faces of a symmetric model lie, and its parts by their numbers."""
    from ...core.result.editing.mirrored import Sides

    of_part = np.zeros(int(numbered.numbers.max()) + 1, np.int64)
    of_part[numbered.numbers] = numbered.parts.side
    return Sides(found.face_twin, found.face_side, of_part)


def _mirrored_too(mesh: bpy.types.Mesh, stored: Stored, asked: np.ndarray, graph: FaceGraph,
                  touching: FaceGraph, ended: np.ndarray) -> np.ndarray:
    """A change of faces, (p,), and its mirror image if that is to be made.

    touching : ``graph`` with contacts. ended : (k,) int64, parts of which nothing may be left.
    """
    from ...core.result.editing.mirrored import MirroredChange, cleaned

    before, twin = stored.face_numbers, stored.decomposition.face_twin
    both, also = pins.mirrored_too(mesh, stored, before, asked, twin, ended.tolist())
    return cleaned(MirroredChange(graph, touching, twin, before, asked, both)) if also else both


def _with_small_pieces(stored: Stored, touching: FaceGraph, after: np.ndarray, beside_taken: float) -> np.ndarray:
    """The part of each face after a change, (p,), with small pieces that it cuts off; on both sides alike.

    touching : all faces that touch, by edges or contacts.
    """
    from ...core.result.editing.mirrored import twin_numbers
    from ...core.result.editing.remainders import halved_between_images, with_small_pieces

    found, numbered = stored.decomposition, stored.shown_parts()
    along = with_small_pieces(touching, stored.face_numbers, after, beside_taken)
    if not bpy.context.scene.reeb_parts.symmetry or not len(found.face_side):
        return along
    image, twin = arange(int(max(along.max(), numbered.numbers.max())) + 1), twin_numbers(numbered)
    image[list(twin)] = list(twin.values())
    return halved_between_images(touching, after, along, _sides(found, numbered), image)


def _finer(stored: Stored, decomposition: Decomposition) -> Stored:
    """The stored result with finer candidates, which have the numbers of those that they were cut from."""
    origin = np.empty(decomposition.n_candidates, np.int64)
    origin[: len(stored.shown)] = arange(len(stored.shown))
    origin[decomposition.candidates] = stored.decomposition.candidates
    return Stored(decomposition, stored.previous_number[origin], stored.pinned[origin], stored.shown[origin])


def told_of_apart(n_faces: int) -> str:
    """How many of the faces that were given to a part do not touch it, in a sentence; "" for 0."""
    if not n_faces:
        return ""
    return rpt_("{n} {n:does not touch it and is a part of its own|do not touch it and are parts of their own}").format(
        n=Count(n_faces))


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

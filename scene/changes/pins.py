# SPDX-License-Identifier: GPL-3.0-or-later
"""What all changes by hand share: numbers, locks, pins, the other side of the plane of symmetry.

Every part that is changed by hand is pinned: it stays as it is while the detail changes around it, and through
another run, until it is released. A part that the user has locked is pinned, too, and cannot be changed at all.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace

import bpy
import numpy as np
from bpy.app.translations import pgettext_rpt as rpt_

from ...core.arrays.indexing import ends_run
from .. import property_updates, store
from ..errors import SceneError
from ..result import part_names
from ..store import Stored
from . import reactions


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


def locked_others(mesh: bpy.types.Mesh, number: int) -> list[int]:
    """Numbers of the locked parts but for one."""
    return [part.number for part in mesh.reeb_parts.parts if part.locked and part.number != number]


def pinned(mesh: bpy.types.Mesh, stored: Stored, candidate_numbers: np.ndarray, changed: Iterable[int]) -> Stored:
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
    candidate_numbers, also = mirrored_too(mesh, stored, stored.shown, candidate_numbers, twin)
    return with_pins(mesh, stored, candidate_numbers, [*changed, *also])


def with_pins(mesh: bpy.types.Mesh, stored: Stored, candidate_numbers: np.ndarray, changed: Iterable[int]) -> Stored:
    """What ``pinned`` does, of a change that is made on both sides already."""
    result = mesh.reeb_parts
    to_pin = np.isin(candidate_numbers, list(changed)) | (stored.pinned > 0)
    stored = replace(stored, pinned=np.where(to_pin, candidate_numbers, 0))
    # Around the pinned parts everything is as the hierarchy has it.
    count = len(np.unique(candidate_numbers)) if result.by_number else 0
    return stored.showing(stored.parts(result.detail, count))


def mirrored_too(
    mesh: bpy.types.Mesh, stored: Stored, before: np.ndarray, after: np.ndarray, twin: np.ndarray,
    ended: Iterable[int] = (),
) -> tuple[np.ndarray, list[int]]:
    """A change of faces or candidates, and its mirror image if the scene's Symmetry is on and no locked part changes.

    before, after : (n,) int64, numbers of parts. twin : (n,) int64, or empty without a plane of symmetry.
    ended : numbers of parts of which nothing may be left.

    Returns the numbers after both, and those of the parts that the mirror image concerns.
    """
    from ...core.result.editing.mirrored import on_both_sides, twin_numbers

    if not bpy.context.scene.reeb_parts.symmetry or not (twin >= 0).any():
        return after, []
    taken = after.tolist()

    def new() -> int:
        taken.append(free_number(mesh, stored, taken))
        return taken[-1]

    both = on_both_sides(before, after, twin, twin_numbers(stored.shown_parts()), new, ended)
    extra = both != after
    concerned = np.unique(np.concatenate([before[extra], both[extra]])).tolist()
    return (after, []) if set(concerned) & set(locked_others(mesh, 0)) else (both, concerned)


def renumber_pieces(mesh: bpy.types.Mesh, stored: Stored, numbers: np.ndarray, concerned: Iterable[int]) -> set[int]:
    """Give what a change cuts off from parts, and what it adds that does not touch them, numbers of their own.

    The largest piece that is left of a part stays, or that of a new part; of a part that was in several pieces, as
    those that touch nothing are, the largest that is left of each.

    Parameters
    ----------
    mesh : bpy.types.Mesh
    stored : Stored
    numbers : (c,) int64
        The part of each candidate; changed in place.
    concerned : iterable of int
        The parts that may have fallen apart; some may be gone.

    Returns
    -------
    changed : set of int
        These parts, and the new numbers.
    """
    changed = set(concerned)
    for number in sorted(changed & set(numbers.tolist())):
        changed |= _renumber_pieces_of(mesh, stored, numbers, number)
    return changed


def _renumber_pieces_of(mesh: bpy.types.Mesh, stored: Stored, numbers: np.ndarray, number: int) -> set[int]:
    """What ``renumber_pieces`` does for one part; the new numbers."""
    from ...core.result.editing.changes import components_of

    area = stored.decomposition.candidate_area
    piece = components_of(stored.decomposition, numbers == number)
    former = np.where(piece >= 0, components_of(stored.decomposition, stored.shown == number), -1)
    there = np.flatnonzero(former >= 0)
    fragment, place = np.unique(np.stack([former, piece])[:, there], axis=1, return_inverse=True)
    order = np.lexsort((np.bincount(place.ravel(), area[there], fragment.shape[1]), fragment[0]))
    stays = set(fragment[1, order[ends_run(fragment[0, order])]].tolist())
    made = set()
    for index in sorted({*range(piece.max() + 1)} - (stays or {0})):
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


def write(context: bpy.types.Context, mesh: bpy.types.Mesh, before: Stored, after: Stored) -> None:
    """Keep and show another result of the same decomposition. before : what is shown until now."""
    reactions.refresh(context, mesh, replace(after, shown=before.shown), after.shown_parts())

# SPDX-License-Identifier: GPL-3.0-or-later
"""Objects that we made: the next run replaces them, but for those that the user has worked on, which are the user's.

Whatever refers to one that is replaced - constraints, modifiers, drivers, custom properties - refers to the new one
that stands for the same from then on. Where there is none, one that the user's things refer to stays.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Collection, Iterable
from typing import NamedTuple

import bpy

from ...core.steps import Steps, finished
from .. import transaction
from ..temporary import remove_object
from . import object_digest
from .surroundings import Surroundings

#: Custom properties of an object that we made: what it is for, such as "node" or "hull"; what it was like when made.
ROLE, MADE = "reeb_parts_role", "reeb_parts_looks"

#: Of all that was made from an object's parts: the key by which it knows the object, see pieces/origins.py.
KEY = "reeb_parts_of"

#: Gives the text that earlier versions kept of an object, which differs once somebody has worked on it. It is not
#: called in Edit Mode.
Former = Callable[[bpy.types.Object], str]

#: What an object that we made stands for, such as a part, as a text. Several may stand for the same, in order.
StandsFor = Callable[[bpy.types.Object], str]

# What has objects without any need of them; of custom properties there, the number of users tells.
_CONTAINERS = (bpy.types.Collection, bpy.types.Scene, bpy.types.Screen, bpy.types.WindowManager, bpy.types.WorkSpace)


class Earlier(NamedTuple):
    """What earlier runs made: the objects that go, by what they stand for, and how many stay."""

    gone: list[tuple[str, bpy.types.Object]]
    kept: int


def mark(items: Collection[bpy.types.Object]) -> None:
    """Remember what objects are like, now that they are made."""
    finished(marking(items))


def marking(items: Collection[bpy.types.Object]) -> Steps[None]:
    """What ``mark`` does, in steps."""
    around = Surroundings.now()
    for index, item in enumerate(items):
        yield index / len(items)
        item[MADE] = _digest(item, around)


def is_as_made(item: bpy.types.Object, former: Former, around: Surroundings) -> bool:
    """Whether an object is still what it was when we made it; what is being edited, be it through another, is not."""
    if getattr(item.data, "is_editmode", False):
        return False
    known = item.get(MADE)
    return (_digest(item, around) if object_digest.is_digest(known) else former(item)) == known


def _digest(item: bpy.types.Object, around: Surroundings) -> str:
    """The digest of an object, now that it is as it is; not in Edit Mode."""
    # What is made from parts is put into one collection. Whoever links it to more has not worked on it: what is made
    # anew is linked there, too, see origins.hand_on.
    count = around.n_own_collections(item)
    return object_digest.digest(item, min(count, 1) if KEY in item else count)


def is_untouched(item: bpy.types.Object, former: Former, around: Surroundings) -> bool:
    """Whether the user has not worked on an object that we made, nor is about to, nor hung anything on it."""
    return item not in around.parents and item.mode in ("OBJECT", "POSE") and is_as_made(item, former, around)


def hand_over(item: bpy.types.ID, *keys: str) -> None:
    """Take custom properties with which we know an object, or a collection, off it: it is the user's from now on."""
    own = [key for key in keys if key in item]
    transaction.keep_keys(item, *own)
    for key in own:
        del item[key]


def remove_untouched(objects: Iterable[bpy.types.Object], role: str, former: Former, stands_for: StandsFor,
                     coming: Collection[str]) -> Earlier:
    """Remove what we made with a role; what the user has worked on, or needs, stays, and is the user's.

    Parameters
    ----------
    objects : iterable of bpy.types.Object
    role : str
    former : Former
    stands_for : StandsFor
    coming : collection of str
        What those stand for that will be made now, see ``needed``.

    Returns
    -------
    earlier : Earlier
        For ``hand_on``.
    """
    there = [item for item in objects if item.get(ROLE) == role]
    needs = needed(there, stands_for, coming)
    around = Surroundings.now()
    gone = [(stands_for(item), item) for item in there if item not in needs and is_untouched(item, former, around)]
    going = {item for _, item in gone}
    for item in there:
        if item in going:
            remove_object(item)
        else:
            hand_over(item, ROLE, MADE)
    return Earlier(gone, len(there) - len(gone))


def needed(items: Collection[bpy.types.Object], stands_for: StandsFor,
           coming: Collection[str]) -> set[bpy.types.Object]:
    """Find those of some objects of ours whose places nothing takes and that something of the user's refers to.

    coming : what those stand for that will be made now.
    """
    left = [item for item in items if stands_for(item) not in coming]
    return {item for item, users in _users(left).items() if any(map(_is_users, users))}


def heirs(gone: Iterable[tuple[str, bpy.types.Object]], new: Iterable[tuple[str, bpy.types.Object]]
          ) -> list[tuple[bpy.types.Object, bpy.types.Object]]:
    """Objects that go, each with the new one that stands for the same, as far as there is one.

    Where fewer of these stand for the same than before, the last takes the places of all that are left.
    """
    waiting, found = defaultdict(list), []
    for key, item in new:
        waiting[key].append(item)
    for key, item in gone:
        several = waiting[key]
        if several:
            found.append((item, several[0]))
        if len(several) > 1:
            del several[0]
    return found


def hand_on(gone: Iterable[tuple[str, bpy.types.Object]], new: Iterable[tuple[str, bpy.types.Object]]) -> None:
    """Have whatever refers to objects that go refer to their ``heirs``, at the end.

    Inside a transaction, until whose end they are still there.
    """
    pairs = heirs(gone, new)
    used = _users([item for item, _ in pairs])
    for item, heir in pairs:
        if item in used:
            # Out of its collections first: a new object would take its places in these, too, next to its own.
            for collection in item.users_collection:
                transaction.at_end(collection.objects.unlink, item)
            transaction.at_end(item.user_remap, heir)


def _users(items: Collection[bpy.types.Object]) -> dict[bpy.types.Object, set[bpy.types.ID | None]]:
    """What refers to each of some objects that anything does but themselves; None stands for a custom property."""
    found, around = {}, Surroundings.now()
    # To ask for no object would be to ask for all there is.
    for item, users in bpy.data.user_map(subset=set(items)).items() if items else ():
        others = {user for user in users if user != item and not isinstance(user, _CONTAINERS)
                  and not transaction.is_discarded(user)}
        if item.users > len(around.collections.get(item, ())):
            others.add(None)
        if others:
            found[item] = others
    return found


def _is_users(item: bpy.types.ID | None) -> bool:
    """Whether something is the user's, not made by us."""
    return item is None or (ROLE not in item and MADE not in item)

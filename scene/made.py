# SPDX-License-Identifier: GPL-3.0-or-later
"""Objects that we made: the next run replaces them, but for those that the user has worked on, which are the user's."""

from __future__ import annotations

from collections.abc import Callable, Iterable

import bpy

from . import looks, transaction
from .temporary import remove_object

#: Custom properties of an object that we made: what it is for, such as "node" or "hull"; what it was like when made.
ROLE, MADE = "reeb_parts_role", "reeb_parts_looks"

#: What earlier versions kept of an object: a text that differs once somebody has worked on it. Not asked in Edit Mode.
Former = Callable[[bpy.types.Object], str]


def mark(item: bpy.types.Object) -> None:
    """Remember what an object is like, now that it is made."""
    item[MADE] = looks.digest(item)


def is_as_made(item: bpy.types.Object, former: Former) -> bool:
    """Whether an object is still what it was when we made it; not in Edit Mode."""
    known = item.get(MADE)
    return (looks.digest if looks.is_digest(known) else former)(item) == known


def is_untouched(item: bpy.types.Object, former: Former) -> bool:
    """Whether the user has not worked on an object that we made, nor is about to, nor hung anything on it."""
    return not item.children and item.mode in ("OBJECT", "POSE") and is_as_made(item, former)


def hand_over(item: bpy.types.ID, *keys: str) -> None:
    """Take custom properties with which we know an object, or a collection, off it: it is the user's from now on."""
    own = [key for key in keys if key in item]
    transaction.keep_keys(item, *own)
    for key in own:
        del item[key]


def remove_untouched(objects: Iterable[bpy.types.Object], role: str, former: Former) -> None:
    """Remove what we made with a role; what the user has worked on stays, and is the user's."""
    for item in [item for item in objects if item.get(ROLE) == role]:
        if is_untouched(item, former):
            remove_object(item)
        else:
            hand_over(item, ROLE, MADE)

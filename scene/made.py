# SPDX-License-Identifier: GPL-3.0-or-later
"""Objects that we made: the next run replaces them, but for those that the user has worked on, which are the user's."""

from __future__ import annotations

from collections.abc import Callable, Iterable

import bpy

from . import transaction
from .temporary import remove_object

#: Custom properties of an object that we made: what it is for, such as "node" or "hull"; what it was like when made.
ROLE, MADE = "reeb_parts_role", "reeb_parts_looks"

#: A text that differs once the user has worked on an object; not asked in Edit Mode.
Looks = Callable[[bpy.types.Object], str]


def mark(item: bpy.types.Object, looks: Looks) -> None:
    """Remember what an object is like, now that it is made."""
    item[MADE] = looks(item)


def is_untouched(item: bpy.types.Object, looks: Looks) -> bool:
    """Whether the user has not worked on an object that we made, nor is about to, nor hung anything on it."""
    return not item.children and item.mode in ("OBJECT", "POSE") and looks(item) == item.get(MADE)


def hand_over(item: bpy.types.Object, *keys: str) -> None:
    """Take custom properties with which we know an object off it: it is the user's from now on."""
    own = [key for key in keys if key in item]
    transaction.keep_keys(item, *own)
    for key in own:
        del item[key]


def remove_untouched(objects: Iterable[bpy.types.Object], role: str, looks: Looks) -> None:
    """Remove what we made with a role; what the user has worked on stays, and is the user's."""
    for item in [item for item in objects if item.get(ROLE) == role]:
        if is_untouched(item, looks):
            remove_object(item)
        else:
            hand_over(item, ROLE, MADE)

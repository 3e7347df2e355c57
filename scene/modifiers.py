# SPDX-License-Identifier: GPL-3.0-or-later
"""Modifiers of ours, given to an object and taken off it, so that it can be taken back; see transaction."""

from __future__ import annotations

import bpy

from . import transaction


def new(obj: bpy.types.Object, name: str, kind: str) -> bpy.types.Modifier:
    """A new modifier, the last of the object."""
    transaction.on_failure(_cut, obj, len(obj.modifiers))
    return obj.modifiers.new(name, kind)


def remove(obj: bpy.types.Object, modifier: bpy.types.Modifier) -> None:
    """Take a modifier off an object, at the end if the object is not a new one."""
    if transaction.is_new(obj):
        obj.modifiers.remove(modifier)
    else:
        transaction.at_end(obj.modifiers.remove, modifier)


def _cut(obj: bpy.types.Object, count: int) -> None:
    """Remove the modifiers that are more than so many."""
    while len(obj.modifiers) > count:
        obj.modifiers.remove(obj.modifiers[-1])

# SPDX-License-Identifier: GPL-3.0-or-later
"""Sliders that go back when what they ask for cannot be shown.

Blender tells of a property only once it has been changed. So a group remembers what the properties were like when all
that they ask for was last done.
"""

from __future__ import annotations

import json
from collections.abc import Callable
from functools import wraps
from typing import Any

import bpy
from bpy.props import StringProperty

from .. import property_updates, transaction
from . import undo_steps

#: The group on each kind of data block that remembers.
_GROUPS = {bpy.types.Mesh: "reeb_parts", bpy.types.Object: "reeb_parts_made", bpy.types.Scene: "reeb_parts"}


class Settled:
    """For property groups that remember some of their values; a class that inherits says which."""

    settled: StringProperty(options={"HIDDEN"})

    def watched(self) -> dict[str, Any]:
        """The values that are remembered, by name; those of the groups in a collection as a list."""
        raise NotImplementedError

    def settle(self) -> None:
        """Remember the values: all that they ask for is done."""
        values = json.dumps(self.watched())
        if self.settled != values:
            self.settled = values

    def take_back(self) -> None:
        """Set the values that are remembered, if any."""
        try:
            values = json.loads(self.settled)
            _set(self, values)
        except (ValueError, TypeError, AttributeError):  # nothing is, or it was not written by us
            pass


def _set(group: bpy.types.PropertyGroup, values: dict[str, Any]) -> None:
    for name, value in values.items():
        if isinstance(value, list) and value and isinstance(value[0], dict):
            for item, entry in zip(getattr(group, name), value, strict=False):
                _set(item, entry)
        elif value != getattr(group, name):
            setattr(group, name, value)


def reaction(work: Callable) -> Callable:
    """For what is done when the user has changed a property: all of it, or the property goes back."""

    @wraps(work)
    def update(group: bpy.types.PropertyGroup, context: bpy.types.Context) -> None:
        if property_updates.is_quiet():
            return
        with transaction.transaction():
            block = group.id_data
            name = next((name for kind, name in _GROUPS.items() if isinstance(block, kind)), None)
            if name is not None:
                transaction.on_failure(getattr(block, name).take_back)
                transaction.keep_group(block, name)
            work(group, context)
        undo_steps.soon(context)

    return update

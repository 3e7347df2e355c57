# SPDX-License-Identifier: GPL-3.0-or-later
"""The bundled model in a driver, and what those that use tools on it note: parts, what is at work, what undo leaves.

Imported by them, inside Blender, beside pointer.py.
"""

import os
import sys

import bpy

sys.path += [os.path.dirname(__file__), os.path.dirname(os.path.dirname(__file__))]
import pointer
from snapshot import changes, snapshot

SEEN = {}


def note(name, value):
    """For the test to judge."""
    SEEN[name] = value


def differences(before):
    """What is not as in a snapshot."""
    return [str(change)[:300] for change in changes(before, snapshot())]


def undo_to(name, before, times=1):
    yield from keys_to(name, before, *["ctrl+z"] * times)


def keys_to(name, wanted, *keys):
    """Keys over the view; what is not as it should be then."""
    pointer.xdo("mousemove", *pointer.in_view(0.3, 0.2))
    yield from pointer.tap(*keys)
    yield from pointer.until(lambda: snapshot() == wanted, 2.0)
    note(name, differences(wanted))


def at_work():
    """What waits for events in the window."""
    return sorted(operator.bl_idname for operator in bpy.context.window.modal_operators)


def shares():
    return {part.name: round(part.share, 3) for part in spot().data.reeb_parts.parts}


def chosen():
    """The active part, and those that are ticked."""
    result = spot().data.reeb_parts
    return [result.parts[result.active].name, [part.name for part in result.parts if part.selected]]


def number(name):
    return spot().data.reeb_parts.parts[name].number


def spot():
    """Looked up anew, since undo replaces it."""
    return bpy.data.objects["spot"]


def mesh():
    """Looked up anew, since undo replaces it."""
    return bpy.data.objects["spot"].data

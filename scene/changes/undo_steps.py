# SPDX-License-Identifier: GPL-3.0-or-later
"""Undo of properties that are changed in the sidebar, in the modes in which Blender's own does not know them.

In Sculpt Mode it makes no step for them: we do, once the properties rest, so that a drag of a slider is one. In Edit
Mode its step is of the edited mesh alone, and what the list showed before came back with the next thing undone.
"""

from __future__ import annotations

import time

import bpy
from bpy.app.handlers import persistent

from .. import handlers

REST = 0.3  # seconds

_changed = 0.0  # when a property was changed last


def soon(context: bpy.types.Context) -> None:
    """A property was changed by the user: make a step of undo soon, if Blender does not."""
    global _changed
    keep_all(context)
    if bpy.app.background or _mode(context) != "SCULPT":
        return
    _changed = time.monotonic()
    if not bpy.app.timers.is_registered(_step):
        bpy.app.timers.register(_step, first_interval=REST)


def _mode(context: bpy.types.Context) -> str:
    """The mode of the active object; ``context.mode`` does not tell where there is no window, as in a timer."""
    active = context.view_layer.objects.active
    return "OBJECT" if active is None else active.mode


def keep_all(context: bpy.types.Context) -> None:
    """A property was changed: have Blender's next step keep more than the edited mesh, as it does after a new block."""
    if not bpy.app.background and _mode(context) == "EDIT":
        bpy.data.meshes.remove(bpy.data.meshes.new("Reeb Parts"), do_unlink=False)


def _step() -> float | None:
    rested = time.monotonic() - _changed
    if rested < REST:
        return REST - rested
    manager = bpy.context.window_manager
    if len(manager.windows) and _mode(bpy.context) == "SCULPT":  # to leave the mode is a step by itself
        with bpy.context.temp_override(window=manager.windows[0]):
            bpy.ops.ed.undo_push(message="Reeb Parts")
    return None


@persistent
def _undone(*_: object) -> None:
    """What was changed is undone before it became a step, which would end what can be done again."""
    if bpy.app.timers.is_registered(_step):
        bpy.app.timers.unregister(_step)


def register() -> None:
    bpy.app.handlers.undo_pre.append(_undone)


def unregister() -> None:
    handlers.remove(bpy.app.handlers.undo_pre, _undone)
    _undone()

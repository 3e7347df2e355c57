# SPDX-License-Identifier: GPL-3.0-or-later
"""Operators, and all else that touches Blender's data."""

import bpy

from . import (
    armature,
    bridge,
    clear,
    compute,
    cut,
    decompose,
    defaults,
    edit,
    export,
    groups,
    handles,
    highlight,
    jobs,
    markers,
    outputs,
    paint,
    parts,
    pick,
    separate,
    slide,
    store,
    unwrap,
    watch,
)

CLASSES = (
    decompose.REEB_PARTS_OT_decompose,
    decompose.REEB_PARTS_OT_cancel,
    clear.REEB_PARTS_OT_clear,
    *defaults.CLASSES,
    *parts.CLASSES,
    *pick.CLASSES,
    *edit.CLASSES,
    *slide.CLASSES,
    *cut.CLASSES,
    *paint.CLASSES,
    *handles.CLASSES,
    *separate.CLASSES,
    *outputs.CLASSES,
    *unwrap.CLASSES,
    *export.CLASSES,
    *armature.CLASSES,
)


def register():
    for cls in CLASSES:
        bpy.utils.register_class(cls)
    defaults.register()
    handles.register()
    highlight.register()
    markers.register()
    watch.register()


def unregister():
    if jobs.current is not None:
        jobs.current.cancel()
    watch.unregister()
    markers.unregister()
    highlight.unregister()
    handles.unregister()
    defaults.unregister()
    for cls in reversed(CLASSES):
        bpy.utils.unregister_class(cls)
    bridge.forget()
    groups.forget()
    compute.forget()
    store.forget()

# SPDX-License-Identifier: GPL-3.0-or-later
"""Operators, and all else that touches Blender's data."""

import bpy

from . import clear, compute, decompose, jobs, parts, store

CLASSES = (
    decompose.REEB_PARTS_OT_decompose,
    decompose.REEB_PARTS_OT_cancel,
    clear.REEB_PARTS_OT_clear,
    *parts.CLASSES,
)


def register():
    for cls in CLASSES:
        bpy.utils.register_class(cls)


def unregister():
    if jobs.current is not None:
        jobs.current.cancel()
    for cls in reversed(CLASSES):
        bpy.utils.unregister_class(cls)
    compute.forget()
    store.forget()

# SPDX-License-Identifier: GPL-3.0-or-later
"""Operators: each reads what it is to work on, calls what does the work, and reports."""

import bpy

from ..scene import jobs
from . import (
    armature,
    clear,
    cut,
    decompose,
    edit,
    export,
    graph,
    outputs,
    paint,
    parts,
    pick,
    separate,
    settings,
    slide,
    unwrap,
)

MODULES = (decompose, clear, settings, parts, pick, edit, slide, cut, paint, graph, separate, outputs, unwrap, export,
           armature)
CLASSES = tuple(cls for module in MODULES for cls in module.CLASSES)


def register() -> None:
    for cls in CLASSES:
        bpy.utils.register_class(cls)


def unregister() -> None:
    jobs.cancel()
    for cls in reversed(CLASSES):
        bpy.utils.unregister_class(cls)

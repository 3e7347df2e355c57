# SPDX-License-Identifier: GPL-3.0-or-later
"""Operators: each reads what it is to work on, calls what does the work, and reports."""

import bpy

from ..scene import running
from . import (
    alike,
    armature,
    checks,
    clear,
    cut,
    decompose,
    detail,
    edit,
    export,
    graph,
    hulls,
    outputs,
    paint,
    parts,
    pick,
    rigid_bodies,
    separate,
    settings,
    slide,
    tool,
    unwrap,
)

MODULES = (decompose, detail, clear, settings, parts, alike, pick, tool, edit, slide, cut, paint, graph, separate,
           checks, outputs, unwrap, export, armature, hulls, rigid_bodies)
#: Every operator that one of the modules defines.
CLASSES = tuple(cls for module in MODULES for cls in vars(module).values()
                if isinstance(cls, type) and issubclass(cls, bpy.types.Operator))

register, _unregister_classes = bpy.utils.register_classes_factory(CLASSES)


def unregister() -> None:
    running.end_all()
    _unregister_classes()

# SPDX-License-Identifier: GPL-3.0-or-later
"""Operators, and all else that touches Blender's data."""

import bpy

from ..scene import armature, compute, defaults, export, jobs, mesh_arrays, pieces, store, uv_map, watch
from ..scene.outputs import vertex_groups
from ..viewport import graph_overlay, highlight
from . import clear, cut, decompose, edit, graph, outputs, paint, parts, pick, slide

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
    *graph.CLASSES,
    *pieces.CLASSES,
    *outputs.CLASSES,
    *uv_map.CLASSES,
    *export.CLASSES,
    *armature.CLASSES,
)


def register():
    for cls in CLASSES:
        bpy.utils.register_class(cls)
    defaults.register()
    graph.register()
    highlight.register()
    graph_overlay.register()
    watch.register()


def unregister():
    if jobs.current is not None:
        jobs.current.cancel()
    watch.unregister()
    graph_overlay.unregister()
    highlight.unregister()
    graph.unregister()
    defaults.unregister()
    for cls in reversed(CLASSES):
        bpy.utils.unregister_class(cls)
    mesh_arrays.forget()
    vertex_groups.forget()
    compute.forget()
    store.forget()

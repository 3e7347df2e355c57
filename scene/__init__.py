# SPDX-License-Identifier: GPL-3.0-or-later
"""Blender's data, read and written: meshes as arrays, results stored with their meshes, and what is made of them."""

from __future__ import annotations

from . import compute, defaults, mesh_arrays, part_places, schema, sculpt_undo, store, watch
from .outputs import vertex_groups


def register() -> None:
    schema.register()
    defaults.register()
    watch.register()
    sculpt_undo.register()


def unregister() -> None:
    sculpt_undo.unregister()
    watch.unregister()
    defaults.unregister()
    schema.unregister()
    for module in (mesh_arrays, vertex_groups, part_places, compute, store):
        module.forget()

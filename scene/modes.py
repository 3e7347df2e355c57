# SPDX-License-Identifier: GPL-3.0-or-later
"""Leave Edit, Sculpt or a paint mode to write to a mesh, and return to it."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

import bpy
from bpy.app.translations import pgettext_rpt as rpt_

from .errors import SceneError


def check_mode(obj: bpy.types.Object) -> None:
    """Raise SceneError in a mode that cannot be left without a loss."""
    if obj.mode == "SCULPT" and obj.use_dynamic_topology_sculpting:
        raise SceneError(
            rpt_("{name} is being sculpted with dynamic topology, which keeps its own mesh. Switch Dyntopo "
                 "off, or leave Sculpt Mode, and try again.").format(name=obj.name)
        )


@contextmanager
def object_mode(context: bpy.types.Context) -> Iterator[None]:
    """Write in Object Mode whatever the mode was; the mode is as before afterwards."""
    active = context.view_layer.objects.active
    mode = active.mode if active else "OBJECT"
    if mode == "OBJECT":
        yield
        return
    with context.temp_override(active_object=active, object=active):
        bpy.ops.object.mode_set(mode="OBJECT")
        try:
            yield
        finally:
            bpy.ops.object.mode_set(mode=mode)

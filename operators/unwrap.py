# SPDX-License-Identifier: GPL-3.0-or-later
"""Unwrap the mesh along the cuts between its parts."""

import bpy
from bpy.app.translations import pgettext_rpt as rpt_

from ..scene import uv_map
from ..scene.reporting import PartOperator
from ..scene.store import Stored


class REEB_PARTS_OT_unwrap(PartOperator, bpy.types.Operator):
    """Unwrap the mesh along the cuts between parts and your own seams, into a UV map of its own"""

    bl_idname = "reeb_parts.unwrap"
    bl_label = "Unwrap along Cuts"

    open_parts: bpy.props.BoolProperty(
        name="Open tubes", default=True,
        description="Also cut tubes along and closed parts open, by the shortest way, so that they lie flat; "
        "these seams are not marked on the mesh",
    )
    method: bpy.props.EnumProperty(
        name="Method", default="ANGLE_BASED",
        items=[("ANGLE_BASED", "Angle based", "Good for organic shapes"),
               ("CONFORMAL", "Conformal", "Faster, less even")],
        description="How faces are laid flat",
    )

    def work(self, context: bpy.types.Context, obj: bpy.types.Object, stored: Stored) -> str:
        name = uv_map.unwrap(context, obj, stored.face_numbers, self.open_parts, self.method)
        return rpt_("Unwrapped into the UV map {name}").format(name=name)

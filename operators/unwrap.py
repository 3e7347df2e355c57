# SPDX-License-Identifier: GPL-3.0-or-later
"""Unwrap the mesh along the cuts between its parts."""

from math import degrees

import bpy
from bpy.app.translations import pgettext_rpt as rpt_

from ..core.sentence import Count
from ..scene.outputs import uv_map
from ..scene.reporting import SelectedPartsOperator
from ..scene.store import Stored

# Share of the faces with even areas below which the report is a warning: a texture would show it.
_FEW_EVEN = 0.75


class REEB_PARTS_OT_unwrap(SelectedPartsOperator, bpy.types.Operator):
    """Unwrap the mesh along the cuts between parts and your own seams, into a UV map of its own"""

    bl_idname = "reeb_parts.unwrap"
    bl_label = "Unwrap along Cuts"

    open_parts: bpy.props.BoolProperty(
        name="Open Tubes", default=True,
        description="Also cut parts open where they would not lie flat: tubes along, and toward tips. These seams run "
        "on inner sides and along creases, and are not marked on the mesh",
    )
    stack: bpy.props.BoolProperty(
        name="Stack Twins", default=False,
        description="Lay parts whose meshes are mirror images of each other over each other, so that both share one "
        "place in the texture",
    )
    method: bpy.props.EnumProperty(
        name="Method", default="MINIMUM_STRETCH",
        items=[("MINIMUM_STRETCH", "Minimum Stretch", "Areas and angles as even as can be"),
               ("ANGLE_BASED", "Angle Based", "Angles even, areas less; faster"),
               ("CONFORMAL", "Conformal", "The fastest, and the least even")],
        description="How faces are laid flat",
    )

    def work(self, context: bpy.types.Context, obj: bpy.types.Object, stored: Stored) -> str | None:
        name, distortion = uv_map.unwrap(context, obj, stored, self.open_parts, self.method, self.stack)
        low, high = distortion.range
        told = rpt_("Unwrapped into the UV map {name}: areas {low:.1f} to {high:.1f} times their size, "
                    "{share:.0%} of the faces within 0.3 to 3; angles {angle:.0f}° off on average").format(
            name=name, low=low, high=high, share=distortion.even, angle=degrees(distortion.angle))
        if distortion.turned:
            self.tell({"INFO"}, rpt_("{n} {n:face is|faces are} mirrored in the UV map").format(
                n=Count(distortion.turned)))
        if distortion.even >= _FEW_EVEN:
            return told
        self.tell({"WARNING"}, told)
        return None

# SPDX-License-Identifier: GPL-3.0-or-later
"""Fewer or more parts, in steps from one number of parts that stands out to the next."""

import bpy
from bpy.app.translations import pgettext_rpt as rpt_

from ..scene import property_updates, transaction
from ..scene.changes import reactions
from ..scene.errors import SceneError
from ..scene.reporting import SelectedPartsOperator
from ..scene.store import Stored


class REEB_PARTS_OT_step_detail(SelectedPartsOperator, bpy.types.Operator):
    """Go to the next number of parts that stands out, such as all limbs, or all fingers"""

    bl_idname = "reeb_parts.step_detail"
    bl_label = "Fewer or More Parts"

    more: bpy.props.BoolProperty(name="More", default=True, description="More parts; without it, fewer")

    def run(self, context: bpy.types.Context) -> None:
        # Each model has a next number of its own, and those without one stay.
        self._stepped = False
        super().run(context)
        if not self._stepped:
            raise SceneError(rpt_("There are no more parts than these.") if self.more
                             else rpt_("There are no fewer parts than these."))

    def work(self, context: bpy.types.Context, obj: bpy.types.Object, stored: Stored) -> None:
        result = obj.data.reeb_parts
        count = len(result.parts)
        levels = stored.numbering.strong_levels()
        beyond = levels[levels > count] if self.more else levels[levels < count][::-1]
        if not len(beyond):
            return
        transaction.keep_result(obj.data)
        with property_updates.quiet():
            result.by_number, result.asked, result.n_parts = True, 0, int(beyond[0])
        reactions.show(result, context)
        self._stepped = True

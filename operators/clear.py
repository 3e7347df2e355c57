# SPDX-License-Identifier: GPL-3.0-or-later
"""Clear: remove exactly what was made."""

import bpy
from bpy.app.translations import pgettext_n as n_
from bpy.app.translations import pgettext_rpt as rpt_

from ..scene import store, targets
from ..scene.errors import SceneError
from ..scene.graph import graph_finding
from ..scene.modes import object_mode
from ..scene.ours import orphan_outputs
from ..scene.reporting import ReportingOperator
from ..scene.runs import results
from ..viewport import shading


class REEB_PARTS_OT_clear(ReportingOperator, bpy.types.Operator):
    """Remove exactly what was added; what is separate stays"""

    bl_idname = "reeb_parts.clear"
    bl_label = "Clear Parts"
    bl_description = n_("Remove everything that Reeb Parts has added to the selected meshes; what was there before is "
                        "back. A UV map that you have changed or renamed stays, and so do colors that you have painted "
                        "on, weights of the armature that you have changed, and the objects made of parts: separated "
                        "pieces, as your own that do not lead back to the mesh, hulls and armatures")

    @classmethod
    def check_context(cls, context: bpy.types.Context) -> None:
        obj = targets.active_object(context)
        if obj is None or obj.type != "MESH" or not (
                store.has_result(obj.data) or graph_finding.exists(obj) or orphan_outputs.may_be(obj.data)):
            raise SceneError(rpt_("The active object has no parts"))

    def run(self, context: bpy.types.Context) -> None:
        objects = targets.chosen_objects(context, self.report)
        with object_mode(context):
            for obj in objects:
                left = results.clear(obj)
                if left.uv_map:
                    self.report({"INFO"}, rpt_("{name}: the UV map {map} was changed by hand and stays").format(
                        name=obj.name, map=left.uv_map))
                if left.colors:
                    self.report({"INFO"}, rpt_("{name}: the colors {attribute} were painted on and stay").format(
                        name=obj.name, attribute=left.colors))
                if left.weights:
                    self.report({"INFO"}, rpt_("{name}: weights of the armature were changed by hand and stay").format(
                        name=obj.name))
        shading.restore_colors(context)

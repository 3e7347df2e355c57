# SPDX-License-Identifier: GPL-3.0-or-later
"""Write each part to a file."""

from pathlib import Path

import bpy
from bpy.app.translations import pgettext_rpt as rpt_

from ..core.sentence import Count
from ..scene.errors import SceneError
from ..scene.modes import object_mode
from ..scene.properties import SEPARATE, WhichProperties, fill_in
from ..scene.reporting import ReportingOperator, chosen_with_parts, with_current_parts
from ..scene.result.part_list import wanted_numbers
from ..scene.saving.export import KINDS, ExportStyle, export_parts
from ..scene.saving.run_files import together

# Since Blender 4.5 a path may only begin with "//" where that is said.
_FROM_FILE = {"PATH_SUPPORTS_BLEND_RELATIVE"} if bpy.app.version >= (4, 5) else set()


class REEB_PARTS_OT_export(ReportingOperator, bpy.types.Operator, WhichProperties):
    """Write each part to a file of its own, or all to one, in a folder; files of the same names are replaced"""

    bl_idname = "reeb_parts.export"
    bl_label = "Export Parts to Files"
    bl_options = {"REGISTER"}

    directory: bpy.props.StringProperty(
        name="Folder", subtype="DIR_PATH", description="Where the files go; made if it is not there",
        options={"ANIMATABLE", *_FROM_FILE},
    )
    filter_folder: bpy.props.BoolProperty(default=True, options={"HIDDEN", "SKIP_SAVE"})
    format: bpy.props.EnumProperty(
        name="Format", default="obj", items=KINDS, description="Kind of the files",
    )
    one_file: bpy.props.BoolProperty(
        name="One File", default=False,
        description="Write all parts of an object to one file, as objects of their own where the format knows objects; "
        "3MF always does",
    )
    caps: bpy.props.BoolProperty(
        name="Close Holes", default=False,
        description="Close the holes where parts were joined, so that each file holds a closed body",
    )

    # As the panel says; scripts get whole faces unless they ask for smooth cuts.
    cut: bpy.props.EnumProperty(**(SEPARATE["cut"].keywords | {"default": "FACES"}))
    separated: bpy.props.BoolProperty(
        name="Separated Pieces", default=False,
        description="Write the pieces that were separated, with their joints and dowels, as they are now",
    )

    def invoke(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        fill_in(self, context.scene.reeb_parts_use, ("which", "caps", "cut"))
        context.window_manager.fileselect_add(self)
        return {"RUNNING_MODAL"}

    def run(self, context: bpy.types.Context) -> None:
        if not self.directory:
            raise SceneError(rpt_("There is no folder to write to. Choose one and try again."))
        folder = Path(bpy.path.abspath(self.directory))
        objects = chosen_with_parts(context, self.report, one_per_mesh=False)
        with object_mode(context), together() as files:
            if not self.separated:
                objects = [obj for obj, _ in with_current_parts(objects, self.report)]
            # Pieces may be of other parts than those in the list, which are of the detail that is shown now.
            every = self.separated and self.which == "ALL"
            wanted = [(obj, None if every else wanted_numbers(obj.data, self.which)) for obj in objects]
            style = ExportStyle(self.format, self.caps, self.one_file, self.separated, self.cut)
            paths = export_parts(files, wanted, folder, style)
        self.report({"INFO"}, rpt_("{n} {n:file|files} in {folder}").format(n=Count(len(paths)), folder=folder))

# SPDX-License-Identifier: GPL-3.0-or-later
"""Parts as files, by Blender's own exporters."""

import os
import re
import tempfile
from contextlib import contextmanager
from pathlib import Path

import bpy
from bpy.app.translations import pgettext_rpt as rpt_

from ..operators import parts
from . import pieces, store, targets
from .errors import SceneError
from .modes import object_mode
from .panel_settings import use_panel_settings, wanted
from .use_properties import WhichProperties

EXPORTERS = {
    "obj": lambda path: bpy.ops.wm.obj_export(filepath=path, export_selected_objects=True),
    "ply": lambda path: bpy.ops.wm.ply_export(filepath=path, export_selected_objects=True),
    "stl": lambda path: bpy.ops.wm.stl_export(filepath=path, export_selected_objects=True),
    "glb": lambda path: bpy.ops.export_scene.gltf(filepath=path, use_selection=True, export_format="GLB"),
}


def export_parts(obj, folder: Path, kind: str, numbers=None, close=False) -> list[Path]:
    """Write each part of an object as a file of its own; the scene stays as it is.

    Parameters
    ----------
    obj : bpy.types.Object
        In Object Mode, with parts.
    folder : Path
        Exists.
    kind : str
        Of EXPORTERS.
    numbers : iterable of int, optional
        Only these parts.
    close : bool
        Close the holes that the cuts leave.

    Returns
    -------
    paths : list of Path

    Raises
    ------
    SceneError
        The parts are out of date, or two parts would get the same file name.
    """
    stored = store.load(obj.data)
    face_numbers = stored.shown_parts().face_numbers
    numbers = sorted(set(face_numbers.tolist()) if numbers is None else numbers)
    names = [_file_name(f"{obj.name} {store.part_name(obj.data, number)}") for number in numbers]
    if len({name.lower() for name in names}) < len(names):
        raise SceneError(
            rpt_("Two parts have the same name; give them different ones to write them as files."))
    meshes, _ = pieces.part_meshes(obj.data, face_numbers, numbers, close)
    try:
        with _own_selection():
            return [_export(obj, meshes[number], folder / f"{name}.{kind}", kind)
                    for number, name in zip(numbers, names, strict=True)]
    finally:
        for mesh in meshes.values():
            bpy.data.meshes.remove(mesh)


@contextmanager
def _own_selection():
    """Nothing selected for a while; the user's selection is back afterwards."""
    layer = bpy.context.view_layer
    active, selected = layer.objects.active, list(layer.objects.selected)
    for obj in selected:
        obj.select_set(False)
    try:
        yield
    finally:
        for obj in selected:
            obj.select_set(True)
        layer.objects.active = active


def _export(obj, mesh, path, kind) -> Path:
    """Write a mesh in the place of an object as a file, whole or not at all."""
    piece = bpy.data.objects.new(path.stem, mesh)
    try:
        bpy.context.scene.collection.objects.link(piece)
        piece.matrix_world = obj.matrix_world
        piece.select_set(True)
        bpy.context.view_layer.objects.active = piece
        with tempfile.TemporaryDirectory(dir=path.parent, prefix=".reeb_parts_") as made:
            EXPORTERS[kind](str(Path(made) / path.name))
            for file in Path(made).iterdir():  # an .obj comes with an .mtl
                os.replace(file, path.parent / file.name)
    finally:
        bpy.data.objects.remove(piece)
    return path


def _file_name(text: str) -> str:
    """The text without what a file system might not like."""
    return re.sub(r"[^\w .()+-]", "_", text).strip(" .") or "part"


class REEB_PARTS_OT_export(bpy.types.Operator, WhichProperties):
    """Write each part to a file of its own, in a folder; files of the same names are replaced"""

    bl_idname = "reeb_parts.export"
    bl_label = "Export Parts to Files"
    bl_options = {"REGISTER"}

    directory: bpy.props.StringProperty(
        name="Folder", subtype="DIR_PATH", description="Where the files go; made if it is not there"
    )
    filter_folder: bpy.props.BoolProperty(default=True, options={"HIDDEN", "SKIP_SAVE"})
    format: bpy.props.EnumProperty(
        name="Format", default="obj",
        items=[("obj", "OBJ", "Wavefront, with materials"), ("ply", "PLY", "Stanford, with colours"),
               ("stl", "STL", "For 3D printing"), ("glb", "glTF Binary", "With materials and textures")],
        description="Kind of the files",
    )
    caps: bpy.props.BoolProperty(
        name="Close holes", default=False,
        description="Close the holes where parts were joined, so that each file holds a closed body",
    )

    @classmethod
    def poll(cls, context):
        return parts.has_parts(cls, context)

    def invoke(self, context, event):
        use_panel_settings(self, WhichProperties, context)
        if not self.properties.is_property_set("caps"):
            self.caps = context.scene.reeb_parts_use.caps
        context.window_manager.fileselect_add(self)
        return {"RUNNING_MODAL"}

    def execute(self, context):
        try:
            if not self.directory:
                raise SceneError(rpt_("There is no folder to write to. Choose one and try again."))
            folder = Path(bpy.path.abspath(self.directory))
            objects = [obj for obj in targets.chosen_objects(context) if store.has_result(obj.data)]
            with object_mode(context):
                folder.mkdir(parents=True, exist_ok=True)
                paths = [path for obj in objects for path in
                         export_parts(obj, folder, self.format, wanted(obj.data, self.which), self.caps)]
        except SceneError as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        except (OSError, RuntimeError) as error:  # what Blender's exporters report arrives as RuntimeError
            self.report({"ERROR"}, rpt_("The parts could not be written: {reason}").format(reason=str(error).strip()))
            return {"CANCELLED"}
        self.report({"INFO"}, rpt_("{n} files in {folder}").format(n=len(paths), folder=folder))
        return {"FINISHED"}


CLASSES = (REEB_PARTS_OT_export,)

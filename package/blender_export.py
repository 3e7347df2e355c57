# SPDX-License-Identifier: GPL-3.0-or-later
"""Run by a Blender: all meshes of a .blend, .fbx, USD or Alembic file as arrays in one file of NumPy.

    blender --background --factory-startup --python blender_export.py -- MODEL OUT.npz

Meshes are those of the objects themselves, in the mix of their shape keys, without their modifiers, in the places that
the scene gives them, once more for each instance of a collection, and of USD for each instance of a point. What Reeb
Parts has made of a model that is there - pieces, dowels, hulls - is that model a second time, and left out.
"""

import sys
from pathlib import Path

import bpy
import numpy as np

#: Custom properties by which Reeb Parts knows what it made, as in its scene/: on hulls and all that helps; on pieces
#: and dowels; on collections of these, the object that they come from, or its name.
ROLE, PIECES, PIECES_OF = "reeb_parts_role", ("reeb_parts_number", "reeb_parts_dowel"), "reeb_parts_pieces_of"


class NoImporterError(Exception):
    """What reads such files is not in this Blender."""


def _include_all(layer: bpy.types.LayerCollection) -> None:
    """Have Blender evaluate what is excluded or disabled, too: without that, nothing says where it is."""
    for obj in bpy.context.scene.objects:
        obj.hide_viewport = False
    open_ = [*layer.children]
    while open_:
        layer = open_.pop()
        layer.collection.hide_viewport = layer.exclude = False
        open_ += layer.children
    bpy.context.view_layer.update()
    for obj in bpy.context.view_layer.objects:  # hidden ones show no instances
        obj.hide_set(False)


def _is_made_of_another(obj: bpy.types.Object) -> bool:
    """Whether Reeb Parts has made an object of another one that is in the scene."""
    if ROLE in obj:
        return True
    there = bpy.context.scene.objects
    sources = [collection.get(PIECES_OF) for collection in obj.users_collection]
    return any(mark in obj for mark in PIECES) and any(
        source in there.keys() if isinstance(source, str) else source in there.values() for source in sources)


def _placed(prototypes: set[bpy.types.Object]) -> list[tuple[bpy.types.Object, np.ndarray]]:
    """Objects with meshes, and their places as matrices, (4, 4): those of the scene, then those of instances.

    prototypes : what is seen through instances alone, also those that nodes make of points.
    """
    found = [(obj, np.array(obj.matrix_world)) for obj in bpy.context.scene.objects if obj not in prototypes]
    for instance in bpy.context.evaluated_depsgraph_get().object_instances:
        if instance.is_instance and (
                instance.parent.instance_type == "COLLECTION" or instance.object.original in prototypes):
            found.append((instance.object.original, np.array(instance.matrix_world)))
    return [(obj, matrix) for obj, matrix in found if obj.type == "MESH" and not _is_made_of_another(obj)]


def _mend_corners(mesh: bpy.types.Mesh) -> None:
    """Drop faces with corners that do not exist, at which Blender would crash; not all its importers do.

    As batch/importers.py has it, which the Blender that runs this file need not have.
    """
    corner = np.empty(len(mesh.loops), np.int32)
    mesh.loops.foreach_get("vertex_index", corner)
    if (corner.view(np.uint32) >= len(mesh.vertices)).any():
        mesh.validate()


def _points(obj: bpy.types.Object) -> np.ndarray:
    """Positions of the vertices of an object, (n, 3) float32: of relative shape keys the mix that is seen."""
    keys = obj.data.shape_keys
    mixed = keys is not None and (keys.use_relative or obj.show_only_shape_key)
    key = obj.shape_key_add(name="Mix", from_mix=True) if mixed else None
    place = np.empty(3 * len(obj.data.vertices), np.float32)
    (key.data if key else obj.data.vertices).foreach_get("co", place)
    if key:
        obj.shape_key_remove(key)
    return place.reshape(-1, 3)


def _opened(path: str) -> set[bpy.types.Object]:
    """Open a scene or import a model; what of it is seen through instances alone."""
    kind = Path(path).suffix.lower()
    if kind == ".blend":
        bpy.ops.wm.open_mainfile(filepath=path, load_ui=False, use_scripts=False)
    else:
        bpy.ops.wm.read_homefile(use_empty=True)
    if kind == ".fbx":
        bpy.ops.import_scene.fbx(filepath=path)
    if kind in (".blend", ".fbx"):
        _include_all(bpy.context.view_layer.layer_collection)
        return set()
    if not (bpy.app.build_options.alembic if kind == ".abc" else bpy.app.build_options.usd):
        raise NoImporterError(f"this Blender was built without an importer of {kind}")
    importer = bpy.ops.wm.alembic_import if kind == ".abc" else bpy.ops.wm.usd_import
    if importer(filepath=path) != {"FINISHED"}:  # that of Alembic says why in the console alone
        raise RuntimeError(f"it is damaged, or no {kind}")
    if kind != ".abc":
        bpy.context.scene.frame_set(0)  # the time of which meshes are read; places would be those of frame 1
    # What instances show lies in collections that are hidden.
    return {obj for obj in bpy.context.scene.objects if not obj.visible_get()}


def export(path: str, out: str) -> None:
    """Read the model and write vertices (n, 3), triangles (m, 3) and the polygon (m,) of each triangle.

    What is raised is written as well, to a file of the same name that ends in .txt, or in .none if another Blender
    could read the model.
    """
    try:
        _export(path, out)
    except Exception as error:
        said = Path(out).with_suffix(".none" if isinstance(error, NoImporterError) else ".txt")
        said.write_text(str(error) or type(error).__name__, encoding="utf-8")
        raise


def _export(path: str, out: str) -> None:
    """Read and write."""
    prototypes = _opened(path)
    vertices, triangles, polygons = [np.empty((0, 3))], [np.empty((0, 3), np.int64)], [np.empty(0, np.int64)]
    n_vertices = n_polygons = 0
    for obj, matrix in _placed(prototypes):
        mesh = obj.data
        _mend_corners(mesh)
        mesh.calc_loop_triangles()
        corner = np.empty(3 * len(mesh.loop_triangles), np.int32)
        polygon = np.empty(len(mesh.loop_triangles), np.int32)
        mesh.loop_triangles.foreach_get("vertices", corner)
        mesh.loop_triangles.foreach_get("polygon_index", polygon)
        if np.linalg.det(matrix[:3, :3]) < 0:  # a mirror image would look inwards
            corner = corner.reshape(-1, 3)[:, ::-1]
        vertices.append(_points(obj) @ matrix[:3, :3].T + matrix[:3, 3])
        triangles.append(corner.reshape(-1, 3).astype(np.int64) + n_vertices)
        polygons.append(polygon.astype(np.int64) + n_polygons)
        n_vertices += len(mesh.vertices)
        n_polygons += len(mesh.polygons)
    np.savez(out, vertices=np.concatenate(vertices), triangles=np.concatenate(triangles),
             polygon=np.concatenate(polygons))


export(*sys.argv[sys.argv.index("--") + 1:])

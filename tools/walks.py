# SPDX-License-Identifier: GPL-3.0-or-later
"""Make the pictures of the three walks in docs/user.md anew.

    python3 tools/walks.py

A figure is made by tests/shapes.py and smoothed by Blender, Spot is in models/. All else is done by the operators that
the walks name, in Blender as a module.
"""

from __future__ import annotations

import importlib
import os
import subprocess
import sys
import tempfile
from pathlib import Path

import environments
from environments import ROOT

IMAGES = ROOT / "docs" / "images" / "user"
SIZE = (480, 400)


def main() -> None:
    """Start this program again in Blender's Python."""
    if "--in-blender" not in sys.argv:
        python = environments.prepare(environments.BLENDER_52)
        with tempfile.TemporaryDirectory() as settings:
            variables = {**os.environ, "BLENDER_USER_RESOURCES": settings, "PYTHONPATH": str(ROOT / "tests")}
            subprocess.run([str(python), __file__, "--in-blender"], check=True, env=variables)
        return
    import checkout

    with tempfile.TemporaryDirectory() as extensions:
        package = checkout.enable(Path(extensions))
        picture = importlib.import_module(f"{package}.batch.picture")
        for walk in (print_a_figure, rig_an_animal, make_a_game_asset):
            walk(picture)


def print_a_figure(picture) -> None:
    """Six parts, and the pieces with their pegs, moved apart."""
    import bpy

    bpy.ops.wm.read_homefile(use_empty=True)
    figure = _shown(bpy.data.objects.new("Figure", _figure()))
    figure.modifiers.new("Remesh", "REMESH").voxel_size = 0.002
    figure.modifiers.new("Smooth", "SMOOTH").iterations = 10
    for name in ("Remesh", "Smooth"):
        bpy.ops.object.modifier_apply(modifier=name)
    bpy.ops.reeb_parts.decompose(n_parts=6)
    picture.render_parts([(figure, _graph(figure))], IMAGES / "walk_figure.png", size=SIZE)
    bpy.ops.reeb_parts.separate(caps=True, joints="ROUND")
    pieces = [piece for piece in bpy.data.objects if "reeb_parts_number" in piece]
    bpy.context.view_layer.update()
    middle = min((piece.location.copy() for piece in pieces), key=lambda place: abs(place.x) + abs(place.z - 0.1))
    for piece in pieces:
        piece.location += 0.35 * (piece.location - middle)
        _painted(piece, piece.color[:3])
    picture.render_parts([(piece, None) for piece in pieces], IMAGES / "walk_figure_pieces.png", size=SIZE)


def _figure():
    """A mesh of some 20 cm, of Blender's metaballs in rows."""
    import bpy
    import numpy as np

    rows = [((0, 0, 0.075), (0, 0, 0.125), 0.024), ((0, 0, 0.205), (0, 0, 0.215), 0.024),
            ((0, 0, 0.13), (0, 0, 0.18), 0.011)]
    for side in (-1, 1):
        rows += [((0.02 * side, 0, 0.135), (0.12 * side, -0.01, 0.11), 0.011),
                 ((0.024 * side, 0, 0.07), (0.055 * side, 0, -0.03), 0.013)]
    balls = bpy.data.metaballs.new("Figure")
    balls.resolution, balls.threshold = 0.0025, 0.3
    for start, end, radius in rows:
        for share in np.linspace(0, 1, 9):
            ball = balls.elements.new()
            ball.co = (1 - share) * np.array(start) + share * np.array(end)
            ball.radius, ball.stiffness = 1.6 * radius, 1.0
    made = bpy.data.objects.new("Balls", balls)
    bpy.context.scene.collection.objects.link(made)
    bpy.context.view_layer.update()
    mesh = bpy.data.meshes.new_from_object(made.evaluated_get(bpy.context.evaluated_depsgraph_get()))
    bpy.data.objects.remove(made)
    return mesh


def rig_an_animal(picture) -> None:
    """Spot's bones, and Spot with his head turned and two legs bent."""
    import bpy
    from mathutils import Quaternion

    spot = _spot(10)
    bpy.ops.reeb_parts.armature()
    rig = spot.modifiers["Reeb Parts Armature"].object
    view = picture.view_from(180)
    picture.render_parts([(spot, _bones(rig))], IMAGES / "walk_rig.png", size=SIZE, view=view)
    for bone in (bone for bone in rig.pose.bones if bone.parent):
        turn = Quaternion((0, 0, 1), 0.5)
        if not bone.children:  # a leg swings about the axis across
            turn = Quaternion((1, 0, 0), 0.5 if bone.head.y * bone.head.x > 0 else -0.5)
        if bone.children or bone.head.z < bone.parent.head.z:
            own = bone.bone.matrix_local.to_quaternion()
            bone.rotation_quaternion = own.inverted() @ turn @ own
    bpy.context.view_layer.update()
    posed = bpy.data.meshes.new_from_object(spot.evaluated_get(bpy.context.evaluated_depsgraph_get()))
    posed.color_attributes.active_color_name = spot.data.color_attributes.active_color_name
    other = bpy.data.objects.new("Posed", posed)
    other.matrix_world = spot.matrix_world
    picture.render_parts([(other, None)], IMAGES / "walk_posed.png", size=SIZE, view=view)


def make_a_game_asset(picture) -> None:
    """Spot with squares by the UV map, the map, and the hulls."""
    import bpy

    spot = _spot(10)
    bpy.ops.reeb_parts.unwrap()
    bpy.ops.reeb_parts.hulls()
    view = picture.view_from(180)
    picture.render_parts([(_flat(spot), None)], IMAGES / "walk_map.png", size=SIZE, view=(0.0, -0.001, 1.0))
    hulls = [hull for hull in bpy.data.objects if hull.name.startswith("UCX_")]
    colors = [part.color[:] for part in spot.data.reeb_parts.parts]
    for index, hull in enumerate(hulls):
        _painted(hull, colors[index % len(colors)], srgb=True)
    picture.render_parts([(hull, None) for hull in hulls], IMAGES / "walk_hulls.png", size=SIZE, view=view)
    picture.render_parts([(_checkered(spot), None)], IMAGES / "walk_squares.png", size=SIZE, view=view)


def _spot(n_parts: int):
    import bpy

    bpy.ops.wm.read_homefile(use_empty=True)
    bpy.ops.wm.obj_import(filepath=str(ROOT / "models" / "spot.obj"))
    bpy.ops.reeb_parts.decompose(n_parts=n_parts)
    return bpy.context.object


def _shown(obj):
    """The object, in the scene, active and selected."""
    import bpy
    from snapshot import activate

    bpy.context.scene.collection.objects.link(obj)
    activate(obj)
    return obj


def _graph(obj):
    import bpy

    return bpy.data.collections[f"Reeb Graph {obj.name}"]


def _painted(obj, color, srgb: bool = False) -> None:
    """Give an object a color attribute of one color; Blender stores linear ones."""
    import numpy as np

    mesh = obj.data
    layer = mesh.color_attributes.new("Shown", "FLOAT_COLOR", "CORNER")
    values = np.ones((len(mesh.loops), 4), np.float32)
    values[:, :3] = np.power(color, 2.2) if srgb else color
    layer.data.foreach_set("color", values.ravel())
    mesh.color_attributes.active_color_name = layer.name


def _bones(rig):
    """A collection with a curve along each bone and balls at its ends, as pictures draw graphs."""
    import bpy

    made = bpy.data.collections.new("Bones")
    curve = bpy.data.curves.new("Bones", "CURVE")
    curve.dimensions = "3D"
    ends = {}
    for bone in rig.data.bones:
        spline = curve.splines.new("POLY")
        spline.points.add(1)
        for point, place in zip(spline.points, (bone.head_local, bone.tail_local), strict=True):
            point.co = (*(rig.matrix_world @ place), 1.0)
        ends[tuple(rig.matrix_world @ bone.tail_local)] = "maximum"
    for bone in rig.data.bones:
        ends[tuple(rig.matrix_world @ bone.head_local)] = "saddle"
    made.objects.link(bpy.data.objects.new("Bones", curve))
    for place, kind in ends.items():
        ball = bpy.data.objects.new("End", None)
        ball.location, ball["kind"] = place, kind
        made.objects.link(ball)
        bpy.context.scene.collection.objects.link(ball)
    return made


def _flat(obj):
    """The UV map as an object in the plane, each island in the color of its part."""
    import bpy
    import numpy as np

    source = obj.data
    place = np.empty(2 * len(source.loops), np.float32)
    source.uv_layers.active.uv.foreach_get("vector", place)
    vertices = np.column_stack([place.reshape(-1, 2), np.zeros(len(source.loops))])
    faces = [list(range(face.loop_start, face.loop_start + face.loop_total)) for face in source.polygons]
    mesh = bpy.data.meshes.new("Map")
    mesh.from_pydata(vertices.tolist(), [], faces)
    name = source.color_attributes.active_color_name
    values = np.empty(4 * len(source.loops), np.float32)
    source.color_attributes[name].data.foreach_get("color", values)
    layer = mesh.color_attributes.new(name, "FLOAT_COLOR", "CORNER")
    layer.data.foreach_set("color", values)
    mesh.color_attributes.active_color_name = name
    return bpy.data.objects.new("Map", mesh)


def _checkered(obj):
    """A fine copy of an object with squares of the UV map in the colors of the parts, light and dark."""
    import bpy
    import numpy as np

    copy = _shown(bpy.data.objects.new("Fine", obj.data.copy()))
    bpy.context.view_layer.update()
    divide = copy.modifiers.new("Fine", "SUBSURF")
    divide.levels, divide.subdivision_type = 4, "SIMPLE"
    mesh = bpy.data.meshes.new_from_object(copy.evaluated_get(bpy.context.evaluated_depsgraph_get()))
    uv = np.empty(2 * len(mesh.loops), np.float32)
    mesh.uv_layers.active.uv.foreach_get("vector", uv)
    first = np.empty(len(mesh.polygons), np.int32)
    mesh.polygons.foreach_get("loop_start", first)
    total = np.diff(np.append(first, len(mesh.loops)))
    middle = np.add.reduceat(uv.reshape(-1, 2), first, axis=0) / total[:, None]
    dark = np.repeat((np.floor(40 * middle).sum(axis=1) % 2) > 0, total)
    values = np.full((len(mesh.loops), 4), 0.85, np.float32)
    values[dark, :3] = (0.25, 0.3, 0.4)
    layer = mesh.color_attributes.new("Squares", "FLOAT_COLOR", "CORNER")
    layer.data.foreach_set("color", values.ravel())
    mesh.color_attributes.active_color_name = layer.name
    squares = bpy.data.objects.new("Squares", mesh)
    squares.matrix_world = obj.matrix_world
    return squares


if __name__ == "__main__":
    main()

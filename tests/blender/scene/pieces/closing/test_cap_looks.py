# SPDX-License-Identifier: GPL-3.0-or-later
"""What caps look like: their places in UV maps, and a material of their own."""

import importlib

import bpy
import numpy as np
import pytest
import shapes
from bulk import read


@pytest.fixture
def pipe(make):
    """A pipe in two parts, with two UV maps of which one has no area, and a material."""
    obj = make(shapes.pipe(24, 7, 0.6))
    mesh = obj.data
    corner = read(mesh.loops, "vertex_index", np.int32)
    points = read(mesh.vertices, "co", np.float32, 3)[corner]
    turn = np.arctan2(points[:, 1], points[:, 0])
    mesh.uv_layers.new(name="Map").uv.foreach_set("vector", (0.4 * np.stack([turn, points[:, 2]], 1)).ravel())
    mesh.uv_layers.new(name="Empty").uv.foreach_set("vector", np.zeros(2 * len(corner), np.float32))
    mesh.materials.append(bpy.data.materials.new("Skin"))
    bpy.ops.reeb_parts.decompose(n_parts=2)
    return obj


def pieces():
    return [obj for obj in bpy.data.objects if "reeb_parts_number" in obj]


def caps_of(mesh):
    return read(mesh.attributes["reeb_cap"].data, "value", np.int32) == 1


def in_map(mesh, name, faces):
    """The corners of some faces in a map, and the area that each face has there."""
    uv = read(mesh.uv_layers[name].uv, "vector", np.float32, 2).astype(float)
    area = []
    for polygon in mesh.polygons:
        own = uv[polygon.loop_start : polygon.loop_start + polygon.loop_total]
        x, y = own.T
        area.append(abs((x * np.roll(y, -1) - y * np.roll(x, -1)).sum()) / 2)
    return uv[np.repeat(faces, read(mesh.polygons, "loop_total", np.int32))], np.array(area)[faces]


@pytest.mark.parametrize("smooth", [None, np.eye(3)])
def test_caps_lie_beside_the_map_as_large_as_the_other_faces(pipe, package, smooth):
    module = importlib.import_module(f"{package}.scene.pieces.part_meshes")
    numbers = 1 + (read(pipe.data.polygons, "center", np.float32, 3)[:, 2] > 1 / 3)
    for mesh in module.piece_meshes(pipe.data, numbers, (1, 2), True, smooth).meshes.values():
        cap = caps_of(mesh)
        assert cap.any()
        area = read(mesh.polygons, "area").astype(float)
        own, own_area = in_map(mesh, "Map", cap)
        others, others_area = in_map(mesh, "Map", ~cap)
        density = others_area.sum() / area[~cap].sum()
        # The ring of the pipe is flat, so that each of its faces keeps its shape.
        assert own_area == pytest.approx(density * area[cap], rel=1e-3, abs=1e-6)
        assert own[:, 0].min() >= others[:, 0].max() - 1e-6
        assert own[:, 0].min() == pytest.approx(round(own[:, 0].min()), abs=1e-5)
        assert not in_map(mesh, "Empty", cap)[0].any()
        assert [material.name for material in mesh.materials] == ["Skin"]


def test_a_material_of_their_own_is_shared_and_found_again(pipe):
    pipe.data.materials.clear()
    before = len(bpy.data.materials)
    for _ in range(2):
        bpy.ops.object.select_all(action="DESELECT")
        pipe.hide_set(False)
        pipe.select_set(True)
        bpy.context.view_layer.objects.active = pipe
        bpy.ops.reeb_parts.separate(caps=True, cap_material=True, hide=False)
        assert len(bpy.data.materials) == before + 1
    made = {piece.data.materials[1] for piece in pieces()}
    assert [material.name for material in made] == ["Cap"]
    for piece in pieces():
        assert piece.data.materials[0] is None
        slots = read(piece.data.polygons, "material_index", np.int32)
        assert (slots == caps_of(piece.data)).all()
    assert not len(pipe.data.materials)


def test_a_linked_material_of_caps_is_left_alone(pipe, tmp_path):
    theirs = bpy.data.materials.new("Cap")
    theirs["reeb_parts_cap"] = True
    bpy.data.libraries.write(str(tmp_path / "other.blend"), {theirs})
    bpy.data.materials.remove(theirs)
    with bpy.data.libraries.load(str(tmp_path / "other.blend"), link=True) as (_, wanted):
        wanted.materials = ["Cap"]
    bpy.ops.reeb_parts.separate(caps=True, cap_material=True)
    used = {material for piece in pieces() for material in piece.data.materials}
    assert {material.name for material in used} == {"Skin", "Cap"}
    assert all(material.library is None for material in used)


def test_without_holes_to_close_there_is_no_material(pipe):
    bpy.ops.reeb_parts.separate(caps=False, cap_material=True)
    assert "Cap" not in bpy.data.materials


def test_undo_takes_the_material_away(pipe):
    bpy.ops.ed.undo_push()
    bpy.ops.reeb_parts.separate(caps=True, cap_material=True)
    bpy.ops.ed.undo_push()
    assert "Cap" in bpy.data.materials
    bpy.ops.ed.undo()
    assert "Cap" not in bpy.data.materials
    assert not pieces()

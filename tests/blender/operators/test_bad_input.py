# SPDX-License-Identifier: GPL-3.0-or-later
"""Bad input: one sentence each, and the scene is as it was."""

import importlib
import re

import bpy
import numpy as np
import pytest
import shapes
from snapshot import activate, snapshot


def refused(match, **arguments):
    """Decompose is refused with a sentence and changes nothing."""
    before = snapshot()
    with pytest.raises(RuntimeError, match=match) as error:
        bpy.ops.reeb_parts.decompose(**arguments)
    assert snapshot() == before
    assert str(error.value).strip().endswith(".")


def test_no_active_object(scene):
    refused("no active object")


def test_not_a_mesh(scene):
    bpy.ops.object.light_add()
    refused("not a mesh")


def test_a_mesh_is_selected_and_something_else_is_active(obj, scene_module):
    """The panel said to select a mesh."""
    targets = scene_module("targets")
    assert targets.to_be_active(bpy.context) == ""
    bpy.ops.object.camera_add()
    assert targets.to_be_active(bpy.context) == ""
    obj.select_set(True)
    assert targets.to_be_active(bpy.context).startswith("Camera is the active object, and not a mesh.")


@pytest.mark.parametrize("add", ["object.text_add", "object.metaball_add", "curve.primitive_bezier_circle_add",
                                 "surface.primitive_nurbs_surface_sphere_add"])
def test_what_can_be_made_a_mesh_of(add):
    group, name = add.split(".")
    getattr(getattr(bpy.ops, group), name)()
    refused(r"Convert it \(Object > Convert > Mesh\)")


def test_the_arcs_of_a_graph_are_not_to_become_a_mesh(obj):
    bpy.ops.reeb_parts.decompose()
    (arcs,) = [item for item in obj.children if item.type == "CURVE"]
    activate(arcs)
    refused("not a mesh but of the type curve. Select a mesh")


@pytest.mark.parametrize(("kind", "faces"), [("SKIN", []), ("SCREW", []), ("SOLIDIFY", [(0, 1, 2)])])
def test_faces_that_modifiers_make(make, kind, faces):
    """All that is seen of such a model, which was said to have no faces, or to be too small."""
    obj = make(([(0, 0, 0), (1, 0, 0), (0, 0, 1)], faces))
    if not faces:
        obj.data.edges.add(2)
        obj.data.edges.foreach_set("vertices", [0, 1, 1, 2])
    obj.modifiers.new("Made", kind)
    if kind == "SKIN":
        with bpy.context.temp_override(object=obj):
            bpy.ops.object.modifier_remove(modifier="Made")
            bpy.ops.object.modifier_add(type=kind)
    bpy.context.view_layer.update()
    refused("faces of Tree are made by its modifiers")
    bpy.ops.object.convert(target="MESH")
    assert bpy.ops.reeb_parts.decompose() == {"FINISHED"}


def test_modifiers_that_make_no_faces_either(make):
    make(([(0, 0, 0), (1, 0, 0)], [])).modifiers.new("Array", "ARRAY")
    refused("no faces")


def test_no_faces(make):
    make(([(0, 0, 0), (1, 0, 0)], []))
    refused("no faces")


def test_too_few_faces(make):
    make(([(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(0, 1, 2)]))
    refused("only 1")


def test_coordinates_that_are_no_numbers(obj):
    obj.data.vertices[7].co.x = float("nan")
    refused("7")


@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize("shape", [shapes.tube_tree(), shapes.box_quads()])
def test_infinite_coordinates(make, shape):
    mesh = make(shape).data
    positions = np.zeros(3 * len(mesh.vertices), np.float32)
    mesh.vertices.foreach_get("co", positions)
    positions[3 * 7] = np.inf
    mesh.vertices.foreach_set("co", positions)
    refused("7")


@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize("scale", [1.0, 2.0])
def test_an_infinite_coordinate_set_by_a_script(make, scale):
    """Blender makes the largest number of it, beside which no face had an area."""
    obj = make(shapes.box_quads())
    obj.scale = (scale, 1.0, 1.0)
    bpy.context.view_layer.update()
    obj.data.vertices[7].co.x = -np.inf
    refused("7")


@pytest.mark.filterwarnings("error")
def test_coordinates_whose_squares_are_infinite(make):
    """In single precision, in which Blender keeps areas, too."""
    make(shapes.Shape(1e30 * shapes.box_quads()[0], shapes.box_quads()[1]))
    assert bpy.ops.reeb_parts.decompose() == {"FINISHED"}


def test_the_graph_of_an_earlier_run_stays_as_it_was_drawn(obj):
    """The sizes that a call gives, or leaves to the preferences, were shown on it before the call was refused."""
    bpy.ops.reeb_parts.decompose(node_size=0.1)
    obj.data.vertices[7].co.x = float("nan")
    refused("7", line_thickness=0.3)


def test_no_area(make):
    make(([(i, 0, 0) for i in range(6)], [(i, i + 1, i + 2) for i in range(4)]))
    refused("area")


@pytest.mark.parametrize("operator", ["pick", "cut", "paint"])
def test_a_place_that_is_none(obj, operator):
    """As a script may give it; it ended in a traceback."""
    bpy.ops.reeb_parts.decompose()
    place = (float("nan"), 0.0, 0.0)
    stroke = {"stroke": [{"name": "", "location": place, "radius": 0.1}]}
    before = snapshot()
    with pytest.raises(RuntimeError, match="not finite"):
        getattr(bpy.ops.reeb_parts, operator)(**(stroke if operator == "paint" else {"location": place}))
    assert snapshot() == before


def test_scaled_to_nothing(obj):
    obj.scale = (0, 0, 0)
    bpy.context.view_layer.update()
    refused("area")


def test_linked_data(obj, package, tmp_path):
    path = str(tmp_path / "library.blend")
    bpy.ops.wm.save_as_mainfile(filepath=path)
    bpy.ops.wm.read_homefile(use_empty=True)
    with bpy.data.libraries.load(path, link=True) as (_, to):
        to.objects = ["Tree"]
    linked = bpy.data.objects["Tree"]
    bpy.context.scene.collection.objects.link(linked)
    bpy.context.view_layer.objects.active = linked
    refused("linked")
    said = importlib.import_module(f"{package}.scene.targets").why_not(linked)  # in the panel, before the button
    assert re.fullmatch(r"Tree is linked from .*library\.blend and cannot be written\. Make it local .*\.", said)


def test_nothing_is_said_of_a_mesh_that_can_be_decomposed(obj, package):
    assert importlib.import_module(f"{package}.scene.targets").why_not(obj) == ""


def test_what_is_linked_from_a_file_that_is_gone_is_said_to_be(obj, tmp_path):
    """Blender has an empty in its place, and a mesh was to be selected."""
    library = tmp_path / "library.blend"
    bpy.ops.wm.save_as_mainfile(filepath=str(library))
    bpy.ops.wm.read_homefile(use_empty=True)
    with bpy.data.libraries.load(str(library), link=True) as (_, to):
        to.objects = ["Tree"]
    bpy.context.scene.collection.objects.link(bpy.data.objects["Tree"])
    bpy.context.view_layer.objects.active = bpy.data.objects["Tree"]
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "shot.blend"))
    library.unlink()
    bpy.ops.wm.open_mainfile(filepath=str(tmp_path / "shot.blend"))
    refused("linked from .*library.blend, which is not there")


def test_a_selected_mesh_of_another_file_is_left_out_and_named(obj, tmp_path, capfd):
    """Even one of the same name; every operator that works on the selected objects."""
    path = str(tmp_path / "library.blend")
    bpy.ops.wm.save_as_mainfile(filepath=path)
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "own.blend"))
    with bpy.data.libraries.load(path, link=True) as (_, to):
        to.objects = ["Tree"]
    (linked,) = to.objects
    bpy.context.scene.collection.objects.link(linked)
    linked.select_set(True)
    assert bpy.context.view_layer.objects.active == obj
    for run in (bpy.ops.reeb_parts.decompose, lambda: bpy.ops.reeb_parts.separate(hide=False),
                lambda: bpy.ops.reeb_parts.export(directory=str(tmp_path)), bpy.ops.reeb_parts.clear):
        bpy.context.view_layer.objects.active = obj
        obj.select_set(True)
        linked.select_set(True)
        capfd.readouterr()
        assert run() == {"FINISHED"}
        assert re.search("Warning: Tree is linked from .*library.blend", capfd.readouterr().out)
        assert not linked.vertex_groups
        assert not linked.data.attributes.get("reeb_part")
        assert not linked.data.reeb_parts.parts


def test_overridden_data(obj, tmp_path):
    path = str(tmp_path / "library.blend")
    bpy.ops.wm.save_as_mainfile(filepath=path)
    bpy.ops.wm.read_homefile(use_empty=True)
    with bpy.data.libraries.load(path, link=True) as (_, to):
        to.objects = ["Tree"]
    (linked,) = to.objects
    bpy.context.scene.collection.objects.link(linked)
    override = linked.override_create()
    bpy.context.scene.collection.objects.link(override)
    bpy.context.view_layer.objects.active = override
    refused("override")


def separated_elsewhere(path, kind, name):
    """The first piece of another file, linked alone, or with its collection and without its original."""
    bpy.ops.reeb_parts.decompose(n_parts=3, graph=False)
    bpy.ops.reeb_parts.separate(caps=True)
    bpy.ops.wm.save_as_mainfile(filepath=str(path))
    bpy.ops.wm.read_homefile(use_empty=True)
    with bpy.data.libraries.load(str(path), link=True) as (_, to):
        setattr(to, kind, [name])
    scene = bpy.context.scene.collection
    (loaded,) = getattr(to, kind)
    (scene.objects if kind == "objects" else scene.children).link(loaded)
    return bpy.data.objects["Tree Part 01"]


@pytest.mark.parametrize("overridden", [False, True])
@pytest.mark.parametrize(("kind", "name"), [("objects", "Tree Part 01"), ("collections", "Parts of Tree")])
def test_a_piece_of_another_file_is_said_to_be_one(obj, tmp_path, package, kind, name, overridden):
    """It was said that it is no part that was separated, and to decompose it first. Made local, it can be checked."""
    piece = separated_elsewhere(tmp_path / "library.blend", kind, name)
    if overridden and kind == "objects":
        piece = piece.override_create()
        bpy.context.scene.collection.objects.link(piece)
    elif overridden:
        whole = bpy.data.collections[name].override_hierarchy_create(bpy.context.scene, bpy.context.view_layer)
        piece = next(item for item in whole.objects if item.name == "Tree Part 01")
    activate(piece)
    why = "is a library override" if overridden else "is linked from .*library.blend"
    for command in ("check_pieces", "select_faults", "repair_piece", "separate", "merge", "hulls", "rigid_bodies"):
        with pytest.raises(RuntimeError, match=f"Tree Part 01 {why}.*Make it local"):
            getattr(bpy.ops.reeb_parts, command)()
    no_original = r"The object that Tree Part 01 was separated from is not in this file\."
    with pytest.raises(RuntimeError, match=no_original):
        bpy.ops.reeb_parts.show_original()
    panel = importlib.import_module(f"{package}.ui.use_panel").REEB_PARTS_PT_piece
    assert panel.poll(bpy.context)
    bpy.ops.object.make_local(type="SELECT_OBDATA" if kind == "objects" else "ALL")
    local = bpy.data.objects["Tree Part 01", None]
    assert local.override_library is None
    activate(local)
    assert panel.poll(bpy.context)
    assert bpy.ops.reeb_parts.check_pieces() == {"FINISHED"}
    for command in ("show_original", "rigid_bodies"):
        with pytest.raises(RuntimeError, match=no_original):
            getattr(bpy.ops.reeb_parts, command)()


def test_a_selected_piece_of_another_file_is_left_out_of_checks_and_named(obj, tmp_path, capfd):
    linked = separated_elsewhere(tmp_path / "library.blend", "objects", "Tree Part 01")
    own = linked.copy()
    own.data = linked.data.copy()
    own.name = "Own"
    bpy.context.scene.collection.objects.link(own)
    activate(own)
    linked.select_set(True)
    assert bpy.ops.reeb_parts.check_pieces() == {"FINISHED"}
    out = capfd.readouterr().out
    assert re.search("Warning: Tree Part 01 is linked from .*library.blend", out)
    assert "1 part is closed" in out


def test_parameters_out_of_range_are_clipped_by_blender(obj):
    bpy.ops.reeb_parts.decompose(detail=7.0)
    assert obj.data.reeb_parts.detail == 1.0


def test_in_edit_mode(make):
    make(([(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(0, 1, 2)]))
    bpy.ops.object.mode_set(mode="EDIT")
    refused("only 1")


def test_a_mesh_edited_through_another_object(obj):
    other = bpy.data.objects.new("Other", obj.data)
    bpy.context.scene.collection.objects.link(other)
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.context.view_layer.objects.active = other
    refused("through another object")
    bpy.context.view_layer.objects.active = obj
    bpy.ops.object.mode_set(mode="OBJECT")


def test_clear_without_parts(obj):
    with pytest.raises(RuntimeError):
        bpy.ops.reeb_parts.clear()


@pytest.mark.parametrize("name", ["decompose", "separate", "hulls", "armature", "unwrap", "merge_small"])
def test_out_of_memory(package, obj, monkeypatch, name):
    """In Blender itself: there was a traceback, which says how large an array would have been."""
    bpy.ops.reeb_parts.decompose(levels=40)
    before = snapshot()
    arrays = importlib.import_module(f"{package}.scene.reading.mesh_arrays")
    monkeypatch.setattr(arrays, "read", lambda *_: np.empty(2**58))
    with pytest.raises(RuntimeError) as error:
        getattr(bpy.ops.reeb_parts, name)()
    monkeypatch.undo()
    assert str(error.value).strip() == (
        "Error: There is not enough memory; nothing was changed. Close other programs and try again.")
    assert snapshot() == before

# SPDX-License-Identifier: GPL-3.0-or-later
"""Where objects are, and where they are not: parents that shear, what Blender does not evaluate, other collections."""

import importlib

import bpy
import numpy as np
import pytest
from mathutils import Euler
from snapshot import activate


def pieces():
    return [o for o in bpy.data.collections["Parts of Tree"].objects if "reeb_parts_number" in o]


def bounds(objects):
    """Box of some objects in the world, (2, 3)."""
    bpy.context.view_layer.update()
    points = np.concatenate([[obj.matrix_world @ vertex.co for vertex in obj.data.vertices] for obj in objects])
    return np.array([points.min(axis=0), points.max(axis=0)])


def layer_of(collection):
    return bpy.context.view_layer.layer_collection.children[collection.name]


@pytest.fixture
def sheared(obj):
    """The tree, turned, under a parent that stretches along one axis."""
    parent = bpy.data.objects.new("Parent", None)
    bpy.context.scene.collection.objects.link(parent)
    parent.scale = (1, 3, 1)
    obj.parent, obj.rotation_euler = parent, Euler((0.3, 0.5, 0.7))
    bpy.context.view_layer.update()
    return obj


@pytest.mark.parametrize("kind", ["obj", "ply", "stl", "glb"])
def test_files_of_what_is_sheared_have_its_shape(sheared, tmp_path, kind):
    bpy.ops.reeb_parts.decompose()
    wanted, before = bounds([sheared]), set(bpy.data.objects)
    bpy.ops.reeb_parts.export(directory=str(tmp_path), format=kind, one_file=True)
    path = str(tmp_path / f"Tree.{kind}")
    {"obj": lambda: bpy.ops.wm.obj_import(filepath=path),
     "ply": lambda: bpy.ops.wm.ply_import(filepath=path), "stl": lambda: bpy.ops.wm.stl_import(filepath=path),
     "glb": lambda: bpy.ops.import_scene.gltf(filepath=path)}[kind]()
    found = bounds([o for o in bpy.data.objects if o.type == "MESH" and o not in before])
    np.testing.assert_allclose(found, wanted, atol=1e-3)


def test_hulls_of_what_is_sheared_lie_around_it(sheared):
    bpy.ops.reeb_parts.decompose()
    bpy.ops.reeb_parts.hulls()
    hulls = [o for o in bpy.data.objects if o.get("reeb_parts_role") == "hull"]
    np.testing.assert_allclose(bounds(hulls), bounds([sheared]), atol=0.1)


@pytest.mark.parametrize("way", ["disabled", "collection disabled", "excluded", "another scene"])
def test_what_blender_does_not_evaluate_is_where_it_would_be(obj, package, tmp_path, way):
    """After a file was opened nobody has said where such an object is; its scale counts all the same."""
    obj.scale, obj.location = (1, 1, 5), (1, 0, 0)
    parent = bpy.data.objects.new("Parent", None)
    bpy.context.scene.collection.objects.link(parent)
    parent.scale = (2, 2, 2)
    obj.parent = parent
    wanted = bounds([obj])
    own = bpy.data.collections.new("Own")
    (bpy.data.scenes.new("Other") if way == "another scene" else bpy.context.scene).collection.children.link(own)
    bpy.context.scene.collection.objects.unlink(obj)
    own.objects.link(obj)
    obj.hide_viewport = way == "disabled"
    own.hide_viewport = way == "collection disabled"
    if way == "excluded":
        layer_of(own).exclude = True
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "x.blend"))
    bpy.ops.wm.open_mainfile(filepath=str(tmp_path / "x.blend"))
    obj = bpy.data.objects["Tree"]
    bridge = importlib.import_module(f"{package}.scene.bridge")
    placing = importlib.import_module(f"{package}.scene.reading.placing")
    np.testing.assert_array_equal(placing.world_matrix(obj), [[2, 0, 0, 2], [0, 2, 0, 0], [0, 0, 10, 0], [0, 0, 0, 1]])
    assert np.ptp(bridge.read_shape(obj).vertices, axis=0) == pytest.approx(np.ptp(wanted, axis=0), rel=1e-4)


def test_what_is_made_in_an_excluded_collection_of_ours_brings_it_back(obj):
    bpy.ops.reeb_parts.decompose(n_parts=3)
    bpy.ops.reeb_parts.separate(hide=False)
    layer_of(bpy.data.collections["Parts of Tree"]).exclude = True
    activate(obj)
    assert bpy.ops.reeb_parts.separate() == {"FINISHED"}
    assert not layer_of(bpy.data.collections["Parts of Tree"]).exclude
    assert set(bpy.context.selected_objects) == set(pieces())
    layer_of(bpy.data.collections["Parts of Tree"]).exclude = True
    bpy.ops.object.select_all(action="DESELECT")
    obj.hide_set(False)
    activate(obj)
    assert bpy.ops.reeb_parts.armature() == {"FINISHED"}


@pytest.mark.parametrize("way", ["eye", "monitor"])
def test_what_is_made_in_a_hidden_collection_of_ours_shows_it(obj, way):
    bpy.ops.reeb_parts.decompose(n_parts=3)
    bpy.ops.reeb_parts.separate(hide=False)
    own = bpy.data.collections["Parts of Tree"]
    if way == "eye":
        layer_of(own).hide_viewport = True
    else:
        own.hide_viewport = True
    activate(obj)
    assert bpy.ops.reeb_parts.separate() == {"FINISHED"}
    assert all(piece.visible_get() for piece in pieces())
    assert set(bpy.context.selected_objects) == set(pieces())


def test_an_original_beside_a_linked_object_of_its_name(obj, tmp_path):
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "library.blend"))
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "own.blend"))
    with bpy.data.libraries.load(str(tmp_path / "library.blend"), link=True) as (_, to):
        to.objects = ["Tree"]
    bpy.context.scene.collection.objects.link(to.objects[0])
    activate(obj)
    bpy.ops.reeb_parts.decompose(n_parts=3)
    bpy.ops.reeb_parts.separate()
    assert obj.hide_get()
    bpy.context.view_layer.objects.active = pieces()[0]
    assert bpy.ops.reeb_parts.show_original() == {"FINISHED"}
    assert not obj.hide_get()


def test_an_original_in_an_excluded_collection_is_named(obj):
    own = bpy.data.collections.new("Own")
    bpy.context.scene.collection.children.link(own)
    own.objects.link(obj)
    bpy.context.scene.collection.objects.unlink(obj)
    activate(obj)
    bpy.ops.reeb_parts.decompose(n_parts=3)
    bpy.ops.reeb_parts.separate()
    layer_of(own).exclude = True
    bpy.context.view_layer.objects.active = pieces()[0]
    with pytest.raises(RuntimeError, match="Tree is not in this view layer"):
        bpy.ops.reeb_parts.show_original()


def test_a_selected_object_in_another_mode_is_left_out(obj, make, tree, capfd):
    other = make(tree, "Other")
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.context.view_layer.objects.active = obj
    obj.select_set(True)
    assert bpy.ops.reeb_parts.decompose() == {"FINISHED"}
    assert "Warning: Other is in another mode than the active object" in capfd.readouterr().out
    assert obj.data.reeb_parts.parts
    assert other.mode == "EDIT"
    assert not other.data.reeb_parts.parts


def test_nothing_is_left_of_a_deleted_object_in_a_file(obj, tmp_path):
    """Not of its graph, nor of the object itself; pieces stay. Without a window no timer runs."""
    bpy.ops.reeb_parts.decompose(n_parts=3)
    bpy.ops.reeb_parts.separate(hide=False)
    names = {piece.name for piece in pieces()}
    activate(obj)
    bpy.ops.object.delete()
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "x.blend"))
    bpy.ops.wm.open_mainfile(filepath=str(tmp_path / "x.blend"))
    assert {o.name for o in bpy.data.objects} == names
    assert "Reeb Graph Tree" not in bpy.data.collections


def test_pieces_of_parts_that_were_hidden_are_seen(obj):
    bpy.ops.reeb_parts.decompose(n_parts=3)
    bpy.ops.reeb_parts.isolate()
    assert any(polygon.hide for polygon in obj.data.polygons)
    bpy.ops.reeb_parts.separate()
    assert not any(polygon.hide for piece in pieces() for polygon in piece.data.polygons)


def test_auto_smooth_leaves_the_origin_free(obj):
    """Its modifier only shades."""
    nodes = bpy.data.node_groups.new("Smooth by Angle", "GeometryNodeTree")
    for way in ("INPUT", "OUTPUT"):
        nodes.interface.new_socket("Geometry", in_out=way, socket_type="NodeSocketGeometry")
    ends = nodes.nodes.new("NodeGroupInput"), nodes.nodes.new("NodeGroupOutput")
    nodes.links.new(ends[0].outputs[0], ends[1].inputs[0])
    obj.modifiers.new("Smooth by Angle", "NODES").node_group = nodes
    bpy.ops.reeb_parts.decompose(n_parts=3)
    bpy.ops.reeb_parts.separate(center=True)
    assert len({tuple(round(x, 3) for x in piece.location) for piece in pieces()}) == 3


def test_an_override_cannot_name_an_object_in_another_mode(obj, make, tree):
    """It would be written to in Edit Mode, where Blender loses its attributes."""
    other = make(tree, "Other")
    obj.data.attributes.new("own", "INT", "FACE")
    activate(obj)
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.context.view_layer.objects.active = other
    with (bpy.context.temp_override(object=obj, active_object=obj, selected_objects=[obj]),
          pytest.raises(RuntimeError, match="Tree is in another mode")):
        bpy.ops.reeb_parts.decompose()
    bpy.context.view_layer.objects.active = obj
    bpy.ops.object.mode_set(mode="OBJECT")
    assert "own" in obj.data.attributes


def test_a_script_names_the_object_with_an_override(obj, make, tree):
    """As Blender's own operators take it; what is active stays so."""
    other = make(tree, "Other")
    with bpy.context.temp_override(object=obj, active_object=obj, selected_objects=[obj]):
        assert bpy.ops.reeb_parts.decompose(n_parts=4) == {"FINISHED"}
        obj.data.reeb_parts.parts[0].selected = obj.data.reeb_parts.parts[1].selected = True
        assert bpy.ops.reeb_parts.merge() == {"FINISHED"}
        assert bpy.ops.reeb_parts.separate(hide=False) == {"FINISHED"}
    assert len(pieces()) == len(obj.data.reeb_parts.parts) == 3
    assert not other.data.reeb_parts.parts

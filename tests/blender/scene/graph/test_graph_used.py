# SPDX-License-Identifier: GPL-3.0-or-later
"""What the user does with the objects of a graph - children, materials, copies, collections - outlasts what we do."""

import importlib

import bpy
import numpy as np
import pytest
from roles import with_role
from snapshot import activate, changes, check_undo, snapshot


@pytest.fixture
def graph(obj):
    """The collection of the graph of the tree, which stands aside, turned and stretched."""
    obj.location, obj.rotation_euler, obj.scale = (3.0, 1.0, 2.0), (1.0, 2.0, 3.0), (2.0, 2.0, 2.0)
    bpy.ops.reeb_parts.decompose()
    return bpy.data.collections["Reeb Graph Tree"]


def add_child(parent):
    """A lamp of the user's that hangs on something, beside it."""
    child = bpy.data.objects.new(f"Lamp of {parent.name}", bpy.data.lights.new("Lamp", "POINT"))
    bpy.context.scene.collection.objects.link(child)
    child.parent, child.location = parent, (0.1, 0.2, 0.0)
    bpy.context.view_layer.update()
    return child


@pytest.mark.parametrize("way", ["clear", "no graph", "another mesh"])
def test_what_hangs_on_a_graph_that_goes_stays_where_it_is(obj, graph, way):
    """Lamps that hung on nodes leapt to the middle of the scene; they go on following the model."""
    lamps = [add_child(with_role("node")[1]), add_child(with_role("arcs")[0])]
    places = [np.array(lamp.matrix_world) for lamp in lamps]
    activate(obj)
    if way == "clear":
        bpy.ops.reeb_parts.clear()
    elif way == "no graph":
        bpy.ops.reeb_parts.decompose(graph=False)
    else:
        obj.data = obj.data.copy()
        obj.data.clear_geometry()
        obj.data.from_pydata([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)], [],
                             [(0, 2, 1), (0, 1, 3), (1, 2, 3), (0, 3, 2)])
        bpy.ops.reeb_parts.decompose(graph=False)
    bpy.context.view_layer.update()
    assert with_role("node") == []
    for lamp, place in zip(lamps, places, strict=True):
        np.testing.assert_allclose(np.array(lamp.matrix_world), place, atol=1e-5)
        assert lamp.parent == obj
    obj.location.x += 5.0
    bpy.context.view_layer.update()
    np.testing.assert_allclose(lamps[0].matrix_world.translation[0], places[0][0, 3] + 5.0, atol=1e-5)


def test_what_hangs_on_a_graph_stays_where_it_is_when_the_model_is_deleted(package, obj, graph):
    lamp = add_child(with_role("node")[1])
    activate(obj)
    bpy.ops.object.delete()
    bpy.context.view_layer.update()
    place = np.array(lamp.matrix_world)
    importlib.import_module(f"{package}.scene.changes.watch")._tidy()  # as a timer does
    bpy.context.view_layer.update()
    assert with_role("node") == []
    np.testing.assert_allclose(np.array(lamp.matrix_world), place, atol=1e-5)


def test_to_clear_what_something_hangs_on_is_undone(obj, graph):
    add_child(with_role("node")[1])
    activate(obj)
    check_undo(lambda: bpy.ops.reeb_parts.clear())


def test_an_error_leaves_what_hangs_on_a_graph_as_it_was(package, obj, graph, monkeypatch):
    add_child(with_role("node")[1])
    activate(obj)
    before = snapshot()
    write = importlib.import_module(f"{package}.scene.outputs.write")

    def broken(_):
        raise MemoryError

    monkeypatch.setattr(write.colors, "remove", broken)
    with pytest.raises((RuntimeError, MemoryError)):
        bpy.ops.reeb_parts.clear()
    assert changes(before, snapshot()) == []


def test_the_curve_keeps_its_materials_and_how_it_is_drawn(obj, graph):
    """A drag of Detail made another curve, without them."""
    def look():
        curve = with_role("arcs")[0].data
        return curve.name, curve.materials[:], curve.bevel_resolution, curve.get("mine")

    curve = with_role("arcs")[0].data
    curve.materials.append(bpy.data.materials.new("Glow"))
    curve.name, curve.bevel_resolution, curve["mine"] = "Bones", 7, 1
    before = look()
    for n_parts in (2, 6):
        obj.data.reeb_parts.n_parts = n_parts
        assert look() == before
    activate(obj)
    bpy.ops.reeb_parts.decompose()
    assert look() == before
    assert len(bpy.data.curves) == 1


def test_copies_of_nodes_and_arcs_are_the_users(obj, graph):
    """Another run removed them with the graph."""
    copies = []
    for item in (with_role("node")[0], with_role("arcs")[0]):
        activate(item)
        bpy.ops.object.duplicate()
        copies.append(bpy.context.view_layer.objects.active)
    n_nodes = len(with_role("node")) - 1
    obj.data.reeb_parts.n_parts = 3
    activate(obj)
    bpy.ops.reeb_parts.decompose()
    assert len(with_role("node")) == n_nodes
    assert len(with_role("arcs")) == 1
    bpy.ops.reeb_parts.clear()
    assert {*copies, obj} == set(bpy.data.objects)
    assert not any("reeb_parts_role" in item for item in bpy.data.objects)


def test_a_curve_that_was_converted_is_the_users(obj, graph):
    """A drag of Detail ended in an error, and another run removed it."""
    (arcs,) = with_role("arcs")
    activate(arcs)
    bpy.ops.object.convert(target="MESH")
    obj.data.reeb_parts.n_parts = 3
    activate(obj)
    for _ in range(2):
        bpy.ops.reeb_parts.show_graph()
    bpy.ops.reeb_parts.decompose()
    assert len(with_role("arcs")) == 1
    bpy.ops.reeb_parts.clear()
    assert {arcs, obj} == set(bpy.data.objects)


def test_a_copy_of_the_model_with_its_graph_has_a_graph_of_its_own(obj, graph):
    """Copies lie beside what they are copies of, in its collection: to clear one cleared both."""
    for item in bpy.data.objects:
        item.select_set(True)
    bpy.context.view_layer.objects.active = obj
    bpy.ops.object.duplicate()
    copy = bpy.context.view_layer.objects.active
    n_nodes = len([item for item in with_role("node") if item.parent == copy])
    activate(obj)
    bpy.ops.reeb_parts.clear()
    assert {item.parent for item in with_role("node")} == {copy}
    assert len(with_role("node")) == n_nodes
    activate(copy)
    bpy.ops.reeb_parts.clear()
    assert set(bpy.data.objects) == {obj, copy}


def test_another_graph_lies_where_the_user_has_that_before(obj, graph):
    """Each run made a new collection, at the top of the scene."""
    place = bpy.data.collections.new("Helpers")
    bpy.context.scene.collection.children.link(place)
    place.children.link(graph)
    bpy.context.scene.collection.children.unlink(graph)
    graph.color_tag, graph.hide_render, graph["mine"] = "COLOR_03", False, 1
    obj.name = "Oak"
    activate(obj)
    bpy.ops.reeb_parts.decompose()
    assert graph.name == "Reeb Graph Oak"
    graph.name = "Bones"
    bpy.ops.reeb_parts.decompose()
    assert place.children[:] == [graph]
    assert bpy.context.scene.collection.children[:] == [place]
    assert (graph.name, graph.color_tag, graph.hide_render, graph["mine"]) == ("Bones", "COLOR_03", False, 1)
    assert set(graph.objects) == {*with_role("node"), *with_role("arcs")} == set(obj.children)

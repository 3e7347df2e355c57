# SPDX-License-Identifier: GPL-3.0-or-later
"""The graph as objects, hidden and shown; what of it and of the pieces is seen in the viewport."""

import importlib

import bpy
import pytest
import shapes
from snapshot import activate


def layer_of(name):
    """The graph's collection in the view layer."""
    return bpy.context.view_layer.layer_collection.children[name]


def graph_facts():
    """All nodes and arcs, by kind and place."""
    nodes = sorted((item["kind"], item["part"], *(round(x, 5) for x in item.location))
                   for item in bpy.data.objects if item.get("reeb_parts_role") == "node")
    (arcs,) = [item for item in bpy.data.objects if item.get("reeb_parts_role") == "arcs"]
    return nodes, [[round(x, 5) for point in spline.points for x in point.co] for spline in arcs.data.splines]


def test_the_graph_is_hidden_and_shown_at_once(obj, settings):
    before = graph_facts()
    settings.graph = False
    assert layer_of("Reeb Graph Tree").hide_viewport
    assert graph_facts() == before
    settings.graph = True
    assert not layer_of("Reeb Graph Tree").hide_viewport
    assert graph_facts() == before


def test_a_graph_that_was_not_asked_for_is_drawn_when_it_is(obj, settings):
    expected = graph_facts()
    bpy.ops.reeb_parts.decompose(method="berretti", graph=False)
    assert "Reeb Graph Tree" not in bpy.data.collections
    settings.graph = False
    settings.graph = True
    assert graph_facts() == expected


def test_the_graph_follows_the_detail_while_it_is_hidden(obj, settings):
    settings.graph = False
    obj.data.reeb_parts.detail = 0.9
    settings.graph = True
    numbers = {part.number for part in obj.data.reeb_parts.parts}
    assert {node[1] for node in graph_facts()[0]} <= numbers


def test_separate_hides_the_graph_with_the_original(obj, settings):
    bpy.ops.reeb_parts.separate()
    assert obj.hide_get()
    assert layer_of("Reeb Graph Tree").hide_viewport
    bpy.ops.reeb_parts.show_original()
    assert not obj.hide_get()
    assert not layer_of("Reeb Graph Tree").hide_viewport
    assert bpy.context.view_layer.objects.active == obj


def test_the_original_comes_back_without_a_graph_that_was_hidden_before(obj, settings):
    settings.graph = False
    bpy.ops.reeb_parts.separate()
    bpy.ops.reeb_parts.show_original()
    assert layer_of("Reeb Graph Tree").hide_viewport


def test_pieces_and_nodes_have_the_colours_of_the_list_in_the_view(obj, settings):
    """Object colors are linear, those of the list are not."""
    bpy.ops.reeb_parts.separate()
    colors = {part.name: part.color[:] for part in obj.data.reeb_parts.parts}
    for name, color in colors.items():
        linear = [c / 12.92 if c <= 0.04045 else ((c + 0.055) / 1.055) ** 2.4 for c in color]
        assert bpy.data.objects[f"Tree {name}"].color[:3] == pytest.approx(linear, abs=1e-5)


def graph_nodes(obj):
    """For each node of an object's graph, what it is of the result and which part it is in."""
    collection = next((c for c in bpy.data.collections if c.get("reeb_parts_source") == obj), None)
    items = collection.objects if collection else ()
    return sorted((item["node"], item["part"]) for item in items if item.get("reeb_parts_role") == "node")


def twin_of(obj):
    """Another object of the same mesh, active and alone selected."""
    twin = bpy.data.objects.new("Twin", obj.data)
    bpy.context.scene.collection.objects.link(twin)
    activate(twin)
    return twin


@pytest.mark.parametrize("graph", [True, False])
def test_objects_that_share_a_mesh_never_show_the_graph_of_an_earlier_result(obj, settings, graph):
    assert len(graph_nodes(obj)) > 2
    twin = twin_of(obj)
    bpy.ops.reeb_parts.decompose(method="berretti", n_slabs=8, small_region=0.5, graph=graph)
    assert graph_nodes(obj) == graph_nodes(twin)
    assert bool(graph_nodes(twin)) == graph
    for detail in (0.0, 1.0, 0.3):
        obj.data.reeb_parts.detail = detail
        assert graph_nodes(obj) == graph_nodes(twin)
        assert {part for _, part in graph_nodes(twin)} <= {part.number for part in obj.data.reeb_parts.parts}
    bpy.ops.reeb_parts.clear()
    assert graph_nodes(obj) == graph_nodes(twin) == []


def test_an_object_that_is_given_another_mesh_loses_its_graph(obj, settings, make, tree):
    other = make((tree[0] * [1, 1, 3], tree[1]), "Other")
    bpy.ops.reeb_parts.decompose(method="berretti", n_slabs=8, small_region=0.5)
    other_graph = graph_nodes(other)
    assert len(other_graph) < len(graph_nodes(obj))
    obj.data = other.data
    other.data.reeb_parts.detail = 1.0
    assert graph_nodes(obj) == []
    assert [node for node, _ in graph_nodes(other)] == [node for node, _ in other_graph]


def nodes(obj, shown=True):
    """The nodes of an object's graph that are shown, or all."""
    return [item for item in obj.children if item.get("reeb_parts_role") == "node"
            and not (shown and item["folded"])]


def test_nodes_are_as_many_as_the_parts_need_and_come_back_with_detail(obj, settings):
    result = obj.data.reeb_parts
    every = len(nodes(obj, shown=False))
    counts = {}
    for count in (1, 5, 20):
        result.n_parts = count
        counts[count] = len(nodes(obj))
        assert {node["part"] for node in nodes(obj)} == {node["part"] for node in nodes(obj, shown=False)}
        assert len(nodes(obj, shown=False)) == every == result.n_nodes
    assert counts[1] == 1
    assert counts[1] < counts[5] < counts[20]
    result.n_parts = 5
    assert len(nodes(obj)) == counts[5]


def test_the_curve_has_the_arcs_between_the_nodes_that_are_shown(obj, settings):
    (arcs,) = [item for item in obj.children if item.get("reeb_parts_role") == "arcs"]
    result = obj.data.reeb_parts
    thickness = arcs.data.bevel_depth = 0.125
    curves = len(bpy.data.curves)
    for count in (1, 5, 20):
        result.n_parts = count
        ends = {tuple(round(x, 4) for x in spline.points[end].co[:3])
                for spline in arcs.data.splines for end in (0, -1)}
        assert {tuple(round(x, 4) for x in node.location) for node in nodes(obj)} <= ends or count == 1
        assert (arcs.data.name, arcs.data.bevel_depth, len(bpy.data.curves)) == ("Reeb arcs", thickness, curves)
    assert len(arcs.data.splines) > 5


def test_nodes_are_named_by_part_and_kind(obj, settings):
    result = obj.data.reeb_parts
    result.n_parts = 5
    result.parts[1].name = "Arm"
    (tip,) = [node for node in nodes(obj) if node["part"] == result.parts[1].number and node["kind"] == "maximum"]
    assert tip.name == "Arm tip"
    names = [node.name for node in nodes(obj, shown=False)]
    words = {"maximum": "tip", "saddle": "joint", "minimum": "middle"}
    for node in nodes(obj, shown=False):
        part = next(part.name for part in result.parts if part.number == node["part"])
        assert node.name.startswith(f"{part} {words[node['kind']]}")
    bpy.ops.reeb_parts.decompose(method="berretti", n_parts=5)
    assert sorted(node.name for node in nodes(obj, shown=False)) == sorted(names)


def test_the_graph_cannot_be_torn_apart_by_moving_all(obj, settings):
    before = graph_facts()
    for item in bpy.data.objects:
        item.select_set(True)
        if item != obj:
            assert all((*item.lock_location, *item.lock_rotation, *item.lock_scale))
    obj.select_set(False)
    bpy.context.view_layer.objects.active = nodes(obj)[0]
    bpy.ops.transform.translate(value=(1.0, 2.0, 3.0))
    bpy.ops.transform.resize(value=(2.0, 2.0, 2.0))
    assert graph_facts() == before


def test_the_eye_hides_and_shows(obj, settings):
    for hidden in (True, False):
        bpy.ops.reeb_parts.show_graph()
        assert layer_of("Reeb Graph Tree").hide_viewport == hidden
        assert settings.graph != hidden


@pytest.mark.parametrize("how", ["exclude", "disable", "unlink"])
def test_the_eye_shows_a_graph_that_the_outliner_has_taken_away(obj, settings, how):
    """Without its tick there, as artists get rid of collections, it said that the graph is shown, and showed none."""
    collection = bpy.data.collections["Reeb Graph Tree"]
    if how == "unlink":
        bpy.context.scene.collection.children.unlink(collection)
    else:
        place, name = (layer_of(collection.name), "exclude") if how == "exclude" else (collection, "hide_viewport")
        setattr(place, name, True)
    bpy.context.view_layer.update()
    bpy.ops.reeb_parts.show_graph()
    bpy.context.view_layer.update()
    assert all(item.visible_get() for item in nodes(obj))
    bpy.ops.reeb_parts.show_graph()
    assert layer_of(collection.name).hide_viewport


def test_the_eye_works_on_all_selected_models(make, tree, obj, settings):
    """It hid the graph of the active one only."""
    other = make(tree, "Other")
    bpy.ops.reeb_parts.decompose()
    obj.select_set(True)
    for hidden in (True, False):
        bpy.ops.reeb_parts.show_graph()
        assert {layer_of(f"Reeb Graph {item.name}").hide_viewport for item in (obj, other)} == {hidden}


def test_the_eye_works_on_a_mesh_that_was_edited(obj, settings):
    """The graph was in the way, and could not be hidden until the mesh was decomposed again."""
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.ops.mesh.select_all(action="SELECT")
    bpy.ops.mesh.subdivide()
    for hidden in (True, False, True):
        bpy.ops.reeb_parts.show_graph()
        assert layer_of("Reeb Graph Tree").hide_viewport == hidden
    bpy.ops.object.mode_set(mode="OBJECT")
    bpy.data.collections.remove(bpy.data.collections["Reeb Graph Tree"])
    with pytest.raises(RuntimeError, match="was edited since"):
        bpy.ops.reeb_parts.show_graph()


def test_the_eye_draws_the_graph_of_a_mesh_that_was_moved(obj, settings):
    """Where no graph was drawn, Apply counted as an edit."""
    bpy.data.collections.remove(bpy.data.collections["Reeb Graph Tree"])
    obj.scale = (2.0, 2.0, 2.0)
    bpy.ops.object.transform_apply()
    bpy.ops.reeb_parts.show_graph()
    assert not layer_of("Reeb Graph Tree").hide_viewport


def test_a_graph_that_would_be_clutter_is_hidden_at_first(package, obj, settings, monkeypatch):
    assert not layer_of("Reeb Graph Tree").hide_viewport
    monkeypatch.setattr(importlib.import_module(f"{package}.core.uses.graph_folding"), "_CROWDED", -1.0)
    bpy.ops.reeb_parts.decompose(method="berretti")
    assert layer_of("Reeb Graph Tree").hide_viewport


def test_a_graph_goes_with_its_model(package, obj, settings):
    watch = importlib.import_module(f"{package}.scene.changes.watch")
    graph_finding = importlib.import_module(f"{package}.scene.graph.graph_finding")
    assert list(graph_finding.left_behind()) == []
    activate(obj)
    bpy.ops.object.delete()
    assert list(graph_finding.left_behind()) == [obj]
    watch._tidy()  # as a timer does
    assert "Reeb Graph Tree" not in bpy.data.collections
    assert [item for item in bpy.data.objects if "reeb_parts_role" in item] == []


def test_a_graph_goes_with_a_model_that_is_removed_from_the_file(package, obj, settings):
    """As in the Outliner, or by a script: nothing told any more whose it had been, and it stayed for ever."""
    watch = importlib.import_module(f"{package}.scene.changes.watch")
    assert not watch._is_untidy()
    bpy.data.objects.remove(obj)
    assert watch._is_untidy()
    watch._tidy()  # as a timer does
    assert "Reeb Graph Tree" not in bpy.data.collections
    assert [item for item in bpy.data.objects if "reeb_parts_role" in item] == []


def test_a_graph_goes_with_the_mesh_that_it_is_of(package, make, obj, settings):
    """Link Object Data gave the object another mesh, in which the graph stayed."""
    watch = importlib.import_module(f"{package}.scene.changes.watch")
    other = make(shapes.tube_tree(), "Other")
    obj.select_set(True)
    bpy.ops.object.make_links_data(type="OBDATA")
    assert obj.data == other.data
    assert watch._is_untidy()
    watch._tidy()  # as a timer does
    assert "Reeb Graph Tree" not in bpy.data.collections
    assert [item for item in bpy.data.objects if "reeb_parts_role" in item] == []


@pytest.mark.parametrize("same", [False, True])
def test_a_graph_goes_where_another_mesh_has_other_parts(package, make, obj, settings, same):
    """Link Object Data onto a mesh that has parts left the graph of the former ones until the next run."""
    watch = importlib.import_module(f"{package}.scene.changes.watch")
    other = make(shapes.dumbbell(), "Other")
    bpy.ops.reeb_parts.decompose(method="berretti")
    obj.data = obj.data.copy() if same else other.data  # as Make Single User does
    bpy.context.view_layer.update()
    assert watch._is_untidy() == (not same)
    watch._undone()  # as after undo and redo, which bring the former graph back
    assert watch._is_untidy() == (not same)
    watch._tidy()  # as a timer does
    assert ("Reeb Graph Tree" in bpy.data.collections) == bool(obj.children) == same
    activate(obj)
    for _ in range(2 - same):
        bpy.ops.reeb_parts.show_graph()
    bpy.context.view_layer.update()
    assert bpy.data.collections.get("Reeb Graph Tree") is not None
    assert not watch._is_untidy()


def _deleted(collection):
    """As the Outliner deletes a collection: what is in it moves up."""
    for item in list(collection.objects):
        bpy.context.scene.collection.objects.link(item)
    bpy.data.collections.remove(collection)


def _moved(collection, items=None):
    other = bpy.data.collections.new("Misc")
    bpy.context.scene.collection.children.link(other)
    for item in items or list(collection.objects):
        other.objects.link(item)
        collection.objects.unlink(item)


def _one_moved(collection):
    _moved(collection, [item for item in collection.objects if item["reeb_parts_role"] == "arcs"])


@pytest.mark.parametrize("how", [_deleted, _moved, _one_moved])
class TestElsewhere:
    """A graph that is not in its own collection any more once stayed where it was, beside a second one."""

    def test_another_run_draws_it_anew(self, obj, settings, how):
        before = graph_facts()
        how(bpy.data.collections["Reeb Graph Tree"])
        bpy.ops.reeb_parts.decompose(method="berretti")
        assert graph_facts() == before
        assert set(bpy.data.collections["Reeb Graph Tree"].objects) == set(obj.children)

    def test_it_is_hidden_and_shown(self, obj, settings, how):
        before = graph_facts()
        how(bpy.data.collections["Reeb Graph Tree"])
        for shown in (False, True):
            bpy.ops.reeb_parts.show_graph()
            bpy.context.view_layer.update()
            assert graph_facts() == before
            assert {item.visible_get() for item in obj.children} == {shown}

    def test_it_follows_the_parts(self, obj, settings, how):
        obj.data.reeb_parts.detail = 0.9
        expected = graph_facts()
        obj.data.reeb_parts.detail = 0.5
        how(bpy.data.collections["Reeb Graph Tree"])
        assert graph_facts() != expected
        obj.data.reeb_parts.detail = 0.9
        assert graph_facts() == expected

    def test_it_is_drawn_as_large_as_is_set(self, obj, settings, how):
        nodes = [item for item in obj.children if item.type == "EMPTY" and not item["folded"]]
        before = nodes[0].empty_display_size
        how(bpy.data.collections["Reeb Graph Tree"])
        settings.node_size *= 2.0
        assert [node.empty_display_size for node in nodes] == pytest.approx([2.0 * before] * len(nodes))

    def test_clear_removes_it(self, obj, settings, how):
        how(bpy.data.collections["Reeb Graph Tree"])
        bpy.ops.reeb_parts.clear()
        assert not obj.children
        assert "Reeb Graph Tree" not in bpy.data.collections


@pytest.mark.parametrize("name", ["node", "part", "kind", "folded", "reeb_parts_size", "reeb_parts_role"])
@pytest.mark.parametrize("value", [None, "Mine"])
def test_nodes_may_lose_their_custom_properties(obj, settings, capfd, name, value):
    """Deleted or changed in the properties of the object, each made sliders fail with a traceback."""
    result = obj.data.reeb_parts
    result.detail = 0.0
    for node in [item for item in bpy.data.objects if item.get("reeb_parts_role") == "node" and name in item]:
        if value is None:
            del node[name]
        else:
            node[name] = value
    result.detail = 1.0
    result.parts[0].name = "Other"
    settings.node_size = 0.02
    result.detail = 0.5
    bpy.ops.reeb_parts.decompose(method="berretti")
    assert "node" in {item.get("reeb_parts_role") for item in bpy.data.objects}
    bpy.ops.reeb_parts.clear()
    assert "Traceback" not in "".join(capfd.readouterr())


@pytest.mark.parametrize("name", ["reeb_parts_source", "reeb_parts_pieces_of"])
def test_what_collections_are_for_may_be_anything(obj, settings, capfd, tmp_path, name):
    """A text where an object is expected made every change of the scene print a traceback."""
    bpy.ops.reeb_parts.separate()
    for collection in [each for each in bpy.data.collections if name in each]:
        collection[name] = 1
    activate(obj)
    obj.data.reeb_parts.detail = 0.9
    bpy.context.view_layer.update()
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "file.blend"))
    bpy.ops.wm.open_mainfile(filepath=str(tmp_path / "file.blend"))
    activate(bpy.data.objects["Tree"])
    assert bpy.ops.reeb_parts.clear() == {"FINISHED"}
    assert "Traceback" not in "".join(capfd.readouterr())

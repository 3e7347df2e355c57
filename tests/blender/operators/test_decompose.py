# SPDX-License-Identifier: GPL-3.0-or-later
"""reeb_parts.decompose and reeb_parts.clear: what is written, and what is not."""

import importlib
from types import SimpleNamespace

import bpy
import numpy as np
import pytest
import shapes
from snapshot import activate, check_undo, snapshot

EVERYTHING = {"face_sets": True, "materials": True, "seams": True, "field": True}


def values(mesh, name, dtype=np.int32, key="value", width=1):
    data = mesh.attributes[name].data
    array = np.zeros(len(data) * width, dtype)
    data.foreach_get(key, array)
    return array


def members(obj, name):
    """Vertices of a group."""
    index = obj.vertex_groups[name].index
    return {v.index for v in obj.data.vertices if any(g.group == index and g.weight == 1.0 for g in v.groups)}


def test_every_face_has_a_part_of_the_list(obj):
    assert bpy.ops.reeb_parts.decompose() == {"FINISHED"}
    numbers = values(obj.data, "reeb_part")
    listed = [part.number for part in obj.data.reeb_parts.parts]
    assert sorted(set(numbers.tolist())) == listed == list(range(1, len(listed) + 1))
    assert len(listed) > 3
    assert sum(part.share for part in obj.data.reeb_parts.parts) == pytest.approx(1.0)


def test_groups_hold_the_corners_of_their_faces(obj):
    bpy.ops.reeb_parts.decompose()
    numbers = values(obj.data, "reeb_part")
    for part in obj.data.reeb_parts.parts:
        corners = {v for p in obj.data.polygons if numbers[p.index] == part.number for v in p.vertices}
        assert members(obj, part.name) == corners
    assert obj.vertex_groups.keys() == [part.name for part in obj.data.reeb_parts.parts]


def test_colours_are_those_of_the_list_and_active(obj):
    bpy.ops.reeb_parts.decompose()
    mesh = obj.data
    assert mesh.attributes.active_color_name == "Reeb Parts"
    attribute = mesh.attributes["Reeb Parts"]
    assert (attribute.data_type, attribute.domain) == ("BYTE_COLOR", "CORNER")
    shown = values(mesh, "Reeb Parts", np.float32, "color_srgb", 4).reshape(-1, 4)
    color = {part.number: tuple(part.color) for part in mesh.reeb_parts.parts}
    numbers = np.repeat(values(mesh, "reeb_part"), [len(p.vertices) for p in mesh.polygons])
    assert shown[:, :3] == pytest.approx(np.array([color[n] for n in numbers.tolist()]), abs=1 / 255)
    assert (shown[:, 3] == 1).all()


def test_optional_outputs(obj):
    bpy.ops.reeb_parts.decompose(**EVERYTHING)
    mesh = obj.data
    numbers = values(mesh, "reeb_part")
    assert (values(mesh, ".sculpt_face_set") == numbers).all()
    slots = np.array([p.material_index for p in mesh.polygons])
    names = [part.name for part in mesh.reeb_parts.parts]
    assert [names[n - 1] for n in numbers] == [mesh.materials[s].name for s in slots]
    field = values(mesh, "reeb_agd", np.float32)
    assert 0.0 <= field.min() < 0.1
    assert 0.9 < field.max() <= 1.0
    around = {}
    for polygon in mesh.polygons:
        for edge in polygon.edge_keys:
            around.setdefault(tuple(sorted(edge)), set()).add(numbers[polygon.index])
    for edge in mesh.edges:
        assert edge.use_seam == (len(around[tuple(sorted(edge.vertices))]) > 1)


def test_running_twice_gives_what_running_once_gives(obj):
    bpy.ops.reeb_parts.decompose()
    bpy.ops.reeb_parts.clear()  # from here on the decomposition is known, and takes no seconds
    bpy.ops.reeb_parts.decompose(**EVERYTHING)
    first = snapshot()
    bpy.ops.reeb_parts.decompose(**EVERYTHING)
    assert snapshot() == first


@pytest.mark.parametrize("outputs", [{}, EVERYTHING])
def test_clear_leaves_nothing(obj, outputs):
    before = snapshot()
    bpy.ops.reeb_parts.decompose(**outputs)
    assert snapshot() != before
    bpy.ops.reeb_parts.clear()
    assert snapshot() == before


def furnish(obj):
    """Give an object of the user's own what we would write, under the very same names."""
    mesh = obj.data
    group = obj.vertex_groups.new(name="Part 01")
    group.add([0, 1, 2], 0.25, "REPLACE")
    obj.vertex_groups.new(name="Mine").add([3], 0.5, "REPLACE")
    obj.vertex_groups.active_index = 0
    mesh.attributes.new("reeb_part", "FLOAT", "POINT").data[5].value = 7.0
    mesh.attributes.new("reeb_agd", "INT", "FACE").data[5].value = 3
    mesh.color_attributes.new("Reeb Parts", "FLOAT_COLOR", "POINT").data[4].color = (1, 0, 0, 1)
    mesh.color_attributes.new("Mine", "BYTE_COLOR", "CORNER")
    mesh.attributes.active_color_name = "Mine"
    mesh.attributes.default_color_name = "Reeb Parts"
    mesh.attributes.new(".sculpt_face_set", "INT", "FACE").data[9].value = 4
    for name in ("Part 01", "Skin"):
        mesh.materials.append(bpy.data.materials.new(name))
    mesh.polygons[3].material_index = 1
    mesh.edges[10].use_seam = True
    mesh["Mine"] = 1.5
    obj["Mine"] = "text"
    obj.shape_key_add(name="Basis")
    obj.shape_key_add(name="Bent").data[0].co.x += 0.1
    obj.modifiers.new("Smooth", "SUBSURF")
    collection = bpy.data.collections.new(f"Reeb Graph {obj.name}")
    bpy.context.scene.collection.children.link(collection)


def test_nothing_of_the_users_is_touched(obj):
    furnish(obj)
    before = snapshot()
    bpy.ops.reeb_parts.decompose(**EVERYTHING)
    bpy.ops.reeb_parts.decompose()
    bpy.ops.reeb_parts.decompose(detail=0.9, **EVERYTHING)
    assert members(obj, "Part 01") == set()  # weight 0.25: still the user's own
    bpy.ops.reeb_parts.clear()
    assert snapshot() == before


def test_positions_and_topology_stay(obj):
    before = snapshot()["meshes"]["Tree"]
    bpy.ops.reeb_parts.decompose(**EVERYTHING)
    after = snapshot()["meshes"]["Tree"]
    for key in ("positions", "edges", "corners", "faces", "keys"):
        assert after[key] == before[key]


def test_undo_and_redo(obj):
    check_undo(lambda: bpy.ops.reeb_parts.decompose(**EVERYTHING))
    bpy.context.object.data.reeb_parts.detail = 0.1
    assert not bpy.context.object.data.reeb_parts.edited


@pytest.mark.parametrize("mode", ["EDIT", "SCULPT", "WEIGHT_PAINT", "VERTEX_PAINT", "TEXTURE_PAINT"])
def test_other_modes_give_the_same_and_come_back(obj, mode):
    bpy.ops.reeb_parts.decompose(**EVERYTHING)
    expected = values(obj.data, "reeb_part")
    bpy.ops.reeb_parts.clear()
    bpy.ops.object.mode_set(mode=mode)
    assert bpy.ops.reeb_parts.decompose(**EVERYTHING) == {"FINISHED"}
    assert obj.mode == mode
    obj.data.reeb_parts.detail = 0.0
    assert len(obj.data.reeb_parts.parts) == 1
    obj.data.reeb_parts.detail = 0.5
    assert len(obj.data.reeb_parts.parts) == expected.max()
    assert obj.mode == mode
    bpy.ops.object.mode_set(mode="OBJECT")
    assert (values(obj.data, "reeb_part") == expected).all()


def test_edit_mode_sees_the_current_edit_mesh(obj, tree):
    import bmesh

    vertices, _ = tree
    bpy.ops.object.mode_set(mode="EDIT")
    edit = bmesh.from_edit_mesh(obj.data)
    for vertex in edit.verts:
        vertex.co.z *= 3.0
    bmesh.update_edit_mesh(obj.data)
    bpy.ops.reeb_parts.decompose()
    bpy.ops.object.mode_set(mode="OBJECT")
    assert obj.data.vertices[5].co.z == pytest.approx(3.0 * vertices[5][2], rel=1e-5)
    expected = values(obj.data, "reeb_part")
    bpy.ops.reeb_parts.clear()
    bpy.ops.reeb_parts.decompose()
    assert (values(obj.data, "reeb_part") == expected).all()


def test_polygons_of_any_size(make):
    bpy.ops.mesh.primitive_cylinder_add(vertices=24, end_fill_type="NGON")
    obj = bpy.context.object
    assert bpy.ops.reeb_parts.decompose() == {"FINISHED"}
    numbers = values(obj.data, "reeb_part")
    assert len(numbers) == 26
    assert numbers.min() >= 1


def test_hidden_faces_count(obj):
    bpy.ops.reeb_parts.decompose()
    expected = values(obj.data, "reeb_part")
    bpy.ops.reeb_parts.clear()
    for polygon in list(obj.data.polygons)[::2]:
        polygon.hide = True
    bpy.ops.reeb_parts.decompose()
    assert (values(obj.data, "reeb_part") == expected).all()


def test_scale_counts_and_place_does_not(make, tree):
    vertices, faces = tree
    scaled = make((vertices * (1.0, 2.0, 0.5), faces))
    bpy.ops.reeb_parts.decompose()
    expected = values(scaled.data, "reeb_part")
    for scale in ((1.0, 2.0, 0.5), (-1.0, 2.0, 0.5), (3.0, 6.0, 1.5)):
        obj = make(tree)
        obj.scale, obj.location, obj.rotation_euler = scale, (5, 6, 7), (0.3, 0.2, 0.1)
        bpy.context.view_layer.update()
        bpy.ops.reeb_parts.decompose()
        same = (values(obj.data, "reeb_part") == expected).mean()
        assert same > 0.98, scale
        collection = bpy.data.collections[f"Reeb Graph {obj.name}"]
        box = np.array(obj.bound_box)
        for empty in collection.objects:
            if empty.type == "EMPTY":
                local = np.array(obj.matrix_world.inverted() @ empty.matrix_world.translation)
                assert (local > box.min(axis=0) - 0.05).all()
                assert (local < box.max(axis=0) + 0.05).all()


def test_rotation_and_place_change_nothing(obj):
    bpy.ops.reeb_parts.decompose()
    expected = values(obj.data, "reeb_part")
    bpy.ops.reeb_parts.clear()
    obj.rotation_euler, obj.location = (1.0, 0.5, 0.2), (100, -3, 2)
    bpy.context.view_layer.update()
    bpy.ops.reeb_parts.decompose()
    assert (values(obj.data, "reeb_part") == expected).all()


def test_shape_key_mix_is_decomposed(make, tree):
    vertices, faces = tree
    mixed = make((vertices * (1.0, 1.0, 2.0), faces))
    bpy.ops.reeb_parts.decompose()
    expected = values(mixed.data, "reeb_part")
    obj = make(tree)
    obj.shape_key_add(name="Basis")
    key = obj.shape_key_add(name="Long", from_mix=False)
    key.data.foreach_set("co", np.float32(vertices * (1.0, 1.0, 3.0)).ravel())
    key.value = 0.5
    bpy.ops.reeb_parts.decompose()
    assert (values(obj.data, "reeb_part") == expected).mean() > 0.98


def test_modifiers_are_left_out_and_noted(obj):
    bpy.ops.reeb_parts.decompose()
    expected = values(obj.data, "reeb_part")
    obj.modifiers.new("Subdivision", "SUBSURF")
    bpy.ops.reeb_parts.decompose()
    assert (values(obj.data, "reeb_part") == expected).all()
    assert "modifier" in obj.data.reeb_parts.notes


def test_a_shared_mesh_is_noted_and_done_once(obj):
    other = bpy.data.objects.new("Other", obj.data)
    bpy.context.scene.collection.objects.link(other)
    other.select_set(True)
    bpy.ops.reeb_parts.decompose()
    assert "2 objects share" in obj.data.reeb_parts.notes
    assert other.vertex_groups.keys() == obj.vertex_groups.keys() != []
    assert len([c for c in bpy.data.collections if c.name.startswith("Reeb Graph")]) == 1
    activate(other)
    bpy.ops.reeb_parts.clear()
    assert obj.vertex_groups.keys() == []


def test_selected_objects_are_done_one_after_the_other(make, tree):
    first = make(tree, "First")
    second = make(shapes.torus(), "Second")
    first.select_set(True)
    bpy.ops.reeb_parts.decompose()
    for obj in (first, second):
        assert obj.data.reeb_parts.parts
        assert f"Reeb Graph {obj.name}" in bpy.data.collections


def test_a_mesh_that_is_gone_while_it_is_read_is_told(package, obj):
    """As by undo in another window; a traceback ended the operator."""
    operator = importlib.import_module(f"{package}.operators.decompose").REEB_PARTS_OT_decompose
    errors = importlib.import_module(f"{package}.scene.errors")
    reader = SimpleNamespace(parameters=lambda: None, report=lambda *_: None, hints="NONE")
    steps = operator._reading(reader, bpy.context)
    next(steps)
    bpy.data.meshes.remove(obj.data)
    with pytest.raises(errors.SceneError, match="Tree was changed while its parts were computed"):
        list(steps)


def test_the_window_waits_no_more_whatever_is_raised_while_a_mesh_is_read(package):
    """The tab went on saying that something was computed, and nothing else could be until Blender was started anew."""
    operator = importlib.import_module(f"{package}.operators.decompose").REEB_PARTS_OT_decompose

    def attempt(work):
        raise ZeroDivisionError

    ended = []
    waiting = SimpleNamespace(attempt=attempt, _read_on=None, _stop_watching=ended.append)
    with pytest.raises(ZeroDivisionError):
        operator._goes_on(waiting, bpy.context)
    assert len(ended) == 1


def test_graph_is_made_of_empties_and_a_curve(obj):
    bpy.ops.reeb_parts.decompose()
    result = obj.data.reeb_parts
    collection = bpy.data.collections["Reeb Graph Tree"]
    empties = [o for o in collection.objects if o.type == "EMPTY"]
    (curve,) = [o for o in collection.objects if o.type == "CURVE"]
    assert len(empties) == result.n_nodes
    shown = [e for e in empties if not e["folded"]]
    assert 5 < len(shown) <= len(empties)
    assert 5 <= len(curve.data.splines) <= result.n_arcs
    assert {o.parent for o in collection.objects} == {obj}
    assert {e["kind"] for e in empties} == {"minimum", "saddle", "maximum"}
    assert len({e.empty_display_type for e in empties}) == 3
    # Small beside the object, in all three shapes.
    diagonal = np.linalg.norm(np.ptp(np.array([corner[:] for corner in obj.bound_box]), axis=0))
    assert [e.empty_display_size for e in shown] == pytest.approx([0.005 * diagonal] * len(shown))
    assert all(e.empty_display_size < 0.001 * diagonal for e in empties if e["folded"])
    assert all(e.hide_select == e["folded"] for e in empties)
    numbers = {part.number for part in result.parts}
    for empty in empties:
        assert 0.0 <= empty["value"] <= 1.0
        assert empty["part"] in numbers
    assert all(min(point.radius for point in spline.points) >= 0 for spline in curve.data.splines)


def test_graph_can_be_left_out(obj):
    bpy.ops.reeb_parts.decompose()
    bpy.ops.reeb_parts.decompose(graph=False)
    assert "Reeb Graph Tree" not in bpy.data.collections
    assert len(bpy.data.objects) == 1


def test_long_names(make, tree):
    obj = make(tree, "T" * 63)
    before = snapshot()
    bpy.ops.reeb_parts.decompose(**EVERYTHING)
    assert len(obj.vertex_groups) == len(obj.data.reeb_parts.parts)
    bpy.ops.reeb_parts.decompose()
    bpy.ops.reeb_parts.clear()
    assert snapshot() == before

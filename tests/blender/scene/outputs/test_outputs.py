# SPDX-License-Identifier: GPL-3.0-or-later
"""Seams, face sets and materials after the fact: the same as if decompose had been asked for them."""

import re
import time

import bpy
import numpy as np
import pytest
from bulk import read
from snapshot import check_undo, snapshot

OPERATORS = {"seams": "seams", "face_sets": "face_sets", "materials": "materials"}


def run(name, **options):
    return getattr(bpy.ops.reeb_parts, name)(**options)


@pytest.fixture
def owned(obj):
    """The tree with seams, face sets and materials of the user's."""
    mesh = obj.data
    mesh.attributes.new(".sculpt_face_set", "INT", "FACE").data.foreach_set("value", [7] * len(mesh.polygons))
    mesh.edges.foreach_set("use_seam", [i % 5 == 0 for i in range(len(mesh.edges))])
    for name in ("Red", "Green"):
        mesh.materials.append(bpy.data.materials.new(name))
    mesh.polygons.foreach_set("material_index", [i % 2 for i in range(len(mesh.polygons))])
    return obj


def contents(mesh_name="Tree"):
    """The mesh, and the materials without their suffixes of former runs; not how long it took, nor what was pressed."""
    seen = snapshot()
    mesh = seen["meshes"][mesh_name]
    mesh["result"] = re.sub(r"'(seconds|by_button)': [^,}]*", "", mesh["result"] or "")
    return mesh, sorted(seen["materials"])


@pytest.mark.parametrize("name", OPERATORS)
def test_the_same_as_decompose_would_have_written(owned, name):
    bpy.ops.reeb_parts.decompose()  # what is known already takes no time, which is part of a result
    bpy.ops.reeb_parts.clear()
    bpy.ops.reeb_parts.decompose(**{name: True})
    wanted = contents()
    bpy.ops.reeb_parts.clear()
    bpy.ops.reeb_parts.decompose()
    assert run(name) == {"FINISHED"}
    assert contents() == wanted


@pytest.mark.parametrize("name", OPERATORS)
def test_taken_back_everything_is_as_before(owned, name):
    bpy.ops.reeb_parts.decompose()
    before = snapshot()
    run(name)
    assert snapshot() != before
    run(name, remove=True)
    assert snapshot() == before


@pytest.mark.parametrize("name", OPERATORS)
def test_the_tooltip_of_a_pressed_button_says_that_a_click_takes_them_away(obj, name):
    operator, properties = (getattr(bpy.types, f"REEB_PARTS_OT_{name}"),
                            bpy.context.window_manager.operator_properties_last(f"reeb_parts.{name}"))
    properties.remove = False
    assert not operator.description(bpy.context, properties)  # what the class says
    properties.remove = True
    assert operator.description(bpy.context, properties).startswith("Take them away again")


@pytest.mark.parametrize("name", OPERATORS)
def test_twice_is_once(owned, name):
    bpy.ops.reeb_parts.decompose()
    run(name)
    once = snapshot()
    run(name)
    assert snapshot() == once


@pytest.mark.parametrize("name", OPERATORS)
def test_they_follow_the_parts(owned, name):
    bpy.ops.reeb_parts.decompose()
    run(name)
    owned.data.reeb_parts.n_parts = 2
    followed = contents()
    run(name, remove=True)
    run(name)
    assert contents() == followed


@pytest.mark.parametrize("name", OPERATORS)
@pytest.mark.parametrize("mode", ["EDIT", "SCULPT", "WEIGHT_PAINT", "VERTEX_PAINT"])
def test_from_every_mode(owned, name, mode):
    bpy.ops.reeb_parts.decompose()
    run(name)
    wanted = contents()
    run(name, remove=True)
    bpy.ops.object.mode_set(mode=mode)
    run(name)
    assert owned.mode == mode
    bpy.ops.object.mode_set(mode="OBJECT")
    assert contents()[0]["seams"] == wanted[0]["seams"]
    assert contents()[0]["slots"] == wanted[0]["slots"]
    face_sets = ".sculpt_face_set"
    assert contents()[0]["attributes"][face_sets] == wanted[0]["attributes"][face_sets]


@pytest.mark.parametrize("edited", [False, True])
@pytest.mark.parametrize("name", OPERATORS)
def test_another_run_leaves_what_a_button_has_switched_on(owned, name, edited):
    """It was gone with all that had been done to it, such as to the materials."""
    bpy.ops.reeb_parts.decompose()
    run(name)
    if edited:
        owned.data.vertices[0].co.x += 0.01
    bpy.ops.reeb_parts.decompose(n_parts=3)
    after = contents()
    bpy.ops.reeb_parts.decompose(n_parts=3, **{name: True})
    assert contents() == after  # as if it had been asked for
    run(name, remove=True)
    without = contents()
    assert without != after
    bpy.ops.reeb_parts.decompose(n_parts=3, **{name: True})
    bpy.ops.reeb_parts.decompose(n_parts=3)
    assert contents() == without


@pytest.mark.parametrize("name", OPERATORS)
def test_taken_back_from_a_mesh_that_was_edited(owned, name):
    """They stayed until it was decomposed again."""
    bpy.ops.reeb_parts.decompose()
    owned.data.vertices[0].co.x += 0.5
    before = snapshot()
    owned.data.vertices[0].co.x -= 0.5
    run(name)
    owned.data.vertices[0].co.x += 0.5
    with pytest.raises(RuntimeError, match="was edited"):
        run(name)
    assert run(name, remove=True) == {"FINISHED"}
    assert snapshot() == before


@pytest.mark.parametrize("name", OPERATORS)
def test_undo(owned, name):
    bpy.ops.reeb_parts.decompose()
    check_undo(lambda: run(name))


@pytest.mark.parametrize("name", ["reeb_part", "Reeb Parts", "reeb_agd"])
@pytest.mark.parametrize(("kind", "domain"), [("FLOAT", "FACE"), ("FLOAT_COLOR", "POINT"), ("INT", "CORNER")])
def test_what_was_converted_is_not_written_any_more(obj, name, kind, domain):
    """After Blender's Convert Attribute every change of the parts ended with a traceback."""
    bpy.ops.reeb_parts.decompose(field=True)
    attributes = obj.data.attributes
    attributes.active = attributes[name]
    bpy.ops.geometry.attribute_convert(data_type=kind, domain=domain)
    converted = snapshot()["meshes"]["Tree"]["attributes"][name]
    obj.data.reeb_parts.n_parts = 3
    bpy.ops.reeb_parts.merge_neighbour()
    assert len(obj.data.reeb_parts.parts) == 2
    obj.reeb_parts_made.explode = 0.5
    bpy.ops.reeb_parts.decompose(field=True)  # makes new ones beside it
    result = obj.data.reeb_parts
    found = [attributes[written] for written in (result.face_attribute, result.color_attribute, result.field_attribute)]
    assert [(a.data_type, a.domain) for a in found] == [
        ("INT", "FACE"), ("BYTE_COLOR", "CORNER"), ("FLOAT", "POINT")]
    assert snapshot()["meshes"]["Tree"]["attributes"][name] == converted


def drawn_sets(mesh, chosen=None, value=90):
    """The face sets of a mesh, those of some faces drawn anew, as a stroke in Sculpt Mode does."""
    sets = np.array(read(mesh.attributes[".sculpt_face_set"].data, "value", np.int32))
    if chosen is not None:
        sets[chosen] = value
        mesh.attributes[".sculpt_face_set"].data.foreach_set("value", sets)
    return sets


@pytest.mark.parametrize("mine", [True, False])
@pytest.mark.parametrize("ends", ["clear", "switched off"])
def test_what_was_drawn_over_our_face_sets_comes_back_where_it_was_drawn(obj, mine, ends):
    """The next change of the parts wrote over it, and it was gone."""
    mesh = obj.data
    if mine:
        mesh.attributes.new(".sculpt_face_set", "INT", "FACE").data.foreach_set("value", [7] * len(mesh.polygons))
    bpy.ops.reeb_parts.decompose(face_sets=True)
    first, second = slice(100, 150), slice(140, 300)
    drawn_sets(mesh, first, 90)
    mesh.reeb_parts.n_parts = 3
    assert drawn_sets(mesh).max() < 90
    drawn_sets(mesh, second, 91)
    mesh.reeb_parts.detail = 0.9
    bpy.ops.reeb_parts.decompose(face_sets=True, method="liu")
    last = slice(300, 310)
    drawn_sets(mesh, last, 92)
    if ends == "clear":
        bpy.ops.reeb_parts.clear()
    else:
        bpy.ops.reeb_parts.face_sets(remove=True)
    wanted = np.full(len(mesh.polygons), 7 if mine else 1)
    wanted[first], wanted[second], wanted[last] = 90, 91, 92
    assert drawn_sets(mesh).tolist() == wanted.tolist()


def test_what_was_drawn_and_made_parts_is_not_kept(obj):
    bpy.ops.reeb_parts.decompose(face_sets=True)
    drawn_sets(obj.data, slice(100, 150))
    bpy.ops.reeb_parts.from_face_sets()
    obj.data.reeb_parts.n_parts = 3
    bpy.ops.reeb_parts.clear()
    assert ".sculpt_face_set" not in obj.data.attributes


def test_a_script_may_remove_all_attributes_that_can_be_removed(owned):
    """Where face sets or seams had been written, every change of the parts ended with a traceback."""
    bpy.ops.reeb_parts.decompose(face_sets=True, seams=True, materials=True)
    for name in [attribute.name for attribute in owned.data.attributes if not attribute.is_required]:
        owned.data.attributes.remove(owned.data.attributes[name])
    owned.data.reeb_parts.n_parts = 3
    bpy.ops.reeb_parts.merge_neighbour()
    assert len(owned.data.reeb_parts.parts) == 2
    bpy.ops.reeb_parts.seams()
    assert any(edge.use_seam for edge in owned.data.edges)
    bpy.ops.reeb_parts.clear()
    assert not any(edge.use_seam for edge in owned.data.edges)


def members(obj, group):
    """Vertices of a vertex group with their weights."""
    index = obj.vertex_groups[group].index
    return {v.index: g.weight for v in obj.data.vertices for g in v.groups if g.group == index}


@pytest.mark.parametrize("deleted", [[0], [1, 2], [-1]])
def test_a_group_deleted_by_hand_comes_back_and_leaves_no_vertex_in_another(obj, deleted):
    bpy.ops.reeb_parts.decompose(n_parts=3)
    result = obj.data.reeb_parts
    for index in deleted:
        obj.vertex_groups.remove(obj.vertex_groups[result.parts[index].group])
    for count in (5, 2, 4):
        result.n_parts = count
        assert len(obj.vertex_groups) == len(result.parts) == count
        numbers = [item.value for item in obj.data.attributes["reeb_part"].data]
        for part in result.parts:
            faces = [f for f in obj.data.polygons if numbers[f.index] == part.number]
            assert members(obj, part.group) == {v: 1.0 for f in faces for v in f.vertices}


def test_many_vertex_groups_do_not_slow_down_what_is_read_and_written_of_faces_and_edges(obj, scene_module):
    """Blender 5 looks through all of them at each face and edge, if it is asked for one by one."""
    arrays, mesh = scene_module("reading.mesh_arrays"), obj.data
    for index in range(3000):
        obj.vertex_groups.new(name=f"Bone {index}")
    keys = {"polygons": ("hide", "select", "material_index"), "edges": ("hide", "select", "use_seam", "use_edge_sharp"),
            "vertices": ("hide", "select")}
    rng, began = np.random.default_rng(0), time.process_time()
    for items, key in ((items, key) for items, some in keys.items() for key in some):
        assert not arrays.element_values(mesh, items, key).any() or key == "select"
        wanted = rng.integers(0, 2, len(getattr(mesh, items))).astype(arrays.element_values(mesh, items, key).dtype)
        arrays.set_element_values(mesh, items, key, wanted)
        assert (arrays.element_values(mesh, items, key) == wanted).all()
        for index in (0, 1, 77):
            assert getattr(getattr(mesh, items)[index], key) == wanted[index], key
    assert time.process_time() - began < 0.2  # 3 s where Blender looks for each


def remove_unused(obj):
    bpy.ops.object.material_slot_remove_unused()
    return "Red", "Green"


def move(obj):
    obj.active_material_index = 0
    bpy.ops.object.material_slot_move(direction="DOWN")
    return "Red", "Green"


def remove_one(obj):
    obj.active_material_index = 1
    bpy.ops.object.material_slot_remove()
    return "Red", "Green"


def put_another_into_it(obj):
    obj.material_slots[1].material = bpy.data.materials.new("Blue")
    return "Red", "Blue"


def remove_material_of_a_part(obj):
    bpy.data.materials.remove(obj.data.reeb_parts.parts[0].material)
    return "Red", "Green"


def remove_material(obj):
    bpy.data.materials.remove(bpy.data.materials["Green"])
    return "Red", ""


@pytest.mark.parametrize("again", [False, True])
@pytest.mark.parametrize("change", [
    remove_unused, move, remove_one, put_another_into_it, remove_material, remove_material_of_a_part])
def test_faces_get_their_materials_back_whatever_became_of_the_slots(owned, change, again):
    """None of them is used while parts have materials: Remove Unused Slots left faces without any."""
    bpy.ops.reeb_parts.decompose(materials=True)
    expected = change(owned)
    bpy.ops.reeb_parts.decompose(materials=True, n_parts=3) if again else None
    bpy.ops.reeb_parts.clear()
    names = [slot.name for slot in owned.material_slots]
    assert [names[polygon.material_index] for polygon in owned.data.polygons] == [
        expected[polygon.index % 2] for polygon in owned.data.polygons]
    assert {*names, ""} == {*expected, ""}


@pytest.mark.parametrize("after", [
    lambda obj: None,
    lambda obj: bpy.ops.reeb_parts.decompose(materials=True, n_parts=3),
    lambda obj: setattr(obj.data.reeb_parts, "detail", 0.9),
    lambda obj: setattr(obj.data.reeb_parts.parts[1], "color", (1, 0, 0)),
    lambda obj: setattr(bpy.context.scene.reeb_parts, "palette", "Pastel"),
], ids=["clear", "decompose", "detail", "color", "palette"])
def test_materials_that_are_given_by_hand_meanwhile_stay(obj, after):
    """Faces that had none, as the mesh had no slot, have an empty one."""
    bpy.ops.reeb_parts.decompose(materials=True)
    obj.data.materials.append(bpy.data.materials.new("Gold"))
    for polygon in obj.data.polygons[:100]:
        polygon.material_index = len(obj.data.materials) - 1
    after(obj)
    bpy.ops.reeb_parts.clear()
    found = [obj.material_slots[polygon.material_index].name for polygon in obj.data.polygons]
    assert found == ["Gold"] * 100 + [""] * (len(found) - 100)


def test_of_two_slots_with_one_material_faces_keep_theirs(owned):
    owned.data.materials.append(owned.data.materials[0])
    for polygon in owned.data.polygons:
        polygon.material_index = polygon.index % 3
    bpy.ops.reeb_parts.decompose(materials=True)
    owned.data.reeb_parts.detail = 0.9
    bpy.ops.reeb_parts.clear()
    assert [polygon.material_index for polygon in owned.data.polygons] == [
        polygon.index % 3 for polygon in owned.data.polygons]


@pytest.mark.parametrize("after", ["clear", "decompose", "seams"])
@pytest.mark.parametrize("edit", ["remove_doubles", "decimate"])
def test_seams_of_ours_that_are_merged_with_other_edges_are_ours(obj, edit, after):
    """Blender makes a seam of edges of which one is, and keeps what the other one says: they stayed as the user's."""
    bpy.ops.reeb_parts.decompose(seams=True)
    n_faces = len(obj.data.polygons)
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.ops.mesh.select_all(action="SELECT")
    getattr(bpy.ops.mesh, edit)(**{"threshold": 0.1} if edit == "remove_doubles" else {"ratio": 0.3})
    bpy.ops.object.mode_set(mode="OBJECT")
    assert len(obj.data.polygons) < n_faces
    assert sum(edge.use_seam for edge in obj.data.edges) > 10
    far = next(edge.index for edge in obj.data.edges if not edge.use_seam)
    obj.data.edges[far].use_seam = True
    if after == "decompose":
        bpy.ops.reeb_parts.decompose(n_parts=2, seams=True)
        bpy.ops.reeb_parts.decompose(n_parts=5, seams=True)
    if after == "seams":
        bpy.ops.reeb_parts.seams(remove=True)
    bpy.ops.reeb_parts.clear()
    assert [edge.index for edge in obj.data.edges if edge.use_seam] == [far]


@pytest.mark.parametrize("had", [False, True])
def test_the_layer_of_seams_goes_only_if_there_was_none(obj, had):
    """Also where no edge is a seam: other programs read from the layer that there are none."""
    if had:
        obj.data.edges[0].use_seam = True
        obj.data.edges[0].use_seam = False
    before = {attribute.name for attribute in obj.data.attributes}
    assert ("seam" in "".join(before)) == had
    bpy.ops.reeb_parts.decompose(seams=True)
    assert any(edge.use_seam for edge in obj.data.edges)
    bpy.ops.reeb_parts.clear()
    assert {attribute.name for attribute in obj.data.attributes} == before


@pytest.mark.parametrize("after", ["detail", "decompose", "clear"])
def test_seams_that_are_marked_by_hand_meanwhile_stay(owned, after):
    """A drag of Detail took them away, and brought those back that had been cleared."""
    bpy.ops.reeb_parts.decompose(seams=True)
    edges, rng = owned.data.edges, np.random.default_rng(0)
    before = np.array([edge.index % 5 == 0 for edge in edges])
    there = np.array([edge.use_seam for edge in edges])
    marked = rng.random(len(edges)) < 0.1
    marked[there] = False
    cleared = before & (rng.random(len(edges)) < 0.5)
    edges.foreach_set("use_seam", (there | marked) & ~cleared)
    if after == "detail":
        owned.data.reeb_parts.detail = 0.9
    elif after == "decompose":
        bpy.ops.reeb_parts.decompose(seams=True, n_parts=3)
    bpy.ops.reeb_parts.clear()
    assert np.array_equal([edge.use_seam for edge in edges], (before | marked) & ~cleared)


@pytest.mark.parametrize("change", [
    lambda result: setattr(result.parts[0], "color", (1, 0, 0)),
    lambda result: setattr(result.parts[0], "name", "Trunk"),
    lambda result: bpy.ops.reeb_parts.rename(new_name="Trunk"),
    lambda result: bpy.ops.reeb_parts.suggest_names(),
    lambda result: setattr(bpy.context.scene.reeb_parts, "palette", "Pastel"),
    lambda result: bpy.ops.reeb_parts.decompose(materials=True, palette="Pastel", n_parts=3),
    lambda result: bpy.ops.reeb_parts.clear(),
], ids=["color", "name", "rename", "suggest", "palette", "decompose", "clear"])
def test_what_is_done_to_the_materials_of_a_copy_is_not_done_to_the_model(obj, change):
    """Shift+D copies the mesh, but not its materials: both models had the new color, and the new names."""
    bpy.ops.reeb_parts.decompose(materials=True)
    model = contents()
    bpy.ops.object.duplicate()
    copy = bpy.context.object.data.name
    made = bpy.data.meshes[copy].reeb_parts.parts[0].material
    made.node_tree.nodes["Principled BSDF"].inputs["Roughness"].default_value = 0.25
    before = {name: dict(values, users=0) for name, values in snapshot()["materials"].items()}

    check_undo(lambda: change(bpy.data.meshes[copy].reeb_parts))
    now = snapshot()
    assert contents()[0] == model[0]
    for name in model[1]:
        assert dict(now["materials"][name], users=0) == before[name]
    for part in bpy.data.meshes[copy].reeb_parts.parts:
        assert part.material.name.split(".0")[0] == part.name
        rough = part.material.node_tree.nodes["Principled BSDF"].inputs["Roughness"].default_value
        assert (rough == 0.25) == (part.number == 1)


def test_a_part_has_its_own_material_not_a_linked_one_of_its_name(obj, tmp_path):
    bpy.data.libraries.write(str(tmp_path / "library.blend"), {bpy.data.materials.new("Part 01")}, fake_user=True)
    bpy.data.materials.remove(bpy.data.materials["Part 01"])
    with bpy.data.libraries.load(str(tmp_path / "library.blend"), link=True) as (_, wanted):
        wanted.materials = ["Part 01"]
    (linked,) = wanted.materials
    obj.data.materials.append(linked)
    bpy.ops.reeb_parts.decompose(materials=True)
    used = {obj.data.materials[polygon.material_index] for polygon in obj.data.polygons}
    assert linked not in used
    assert len(used) == len(obj.data.reeb_parts.parts)


def test_no_group_of_ours_has_the_name_of_a_bone_that_moves_the_model(obj):
    """The user's armature would have moved the faces of the part "head", which had no group of this name before."""
    rig = bpy.data.objects.new("Rig", bpy.data.armatures.new("Rig"))
    bpy.context.scene.collection.objects.link(rig)
    bpy.context.view_layer.objects.active = rig
    bpy.ops.object.mode_set(mode="EDIT")
    for name in ("Part 01", "head", "held", "control"):
        bone = rig.data.edit_bones.new(name)
        bone.tail = (0.0, 0.0, 1.0)
        bone.use_deform = name != "control"
    bpy.ops.object.mode_set(mode="OBJECT")
    for bone in rig.pose.bones:
        bone.location.x = 3.0
    bpy.context.view_layer.objects.active = obj
    obj.modifiers.new("Rig", "ARMATURE").object = rig
    obj.vertex_groups.new(name="held")
    before = seen_vertices(obj)
    bpy.ops.reeb_parts.decompose()
    parts = obj.data.reeb_parts.parts
    assert (parts[0].name, parts[0].group) == ("Part 01", "Part 01.001")
    for index, name in enumerate(("head", "held", "control")):
        parts[index].name = name
    assert [part.group for part in parts][:3] == ["head.001", "held.001", "control"]
    assert seen_vertices(obj) == before
    obj.data.reeb_parts.detail = 0.9
    assert [part.group for part in parts if part.name in ("head", "held")] == ["head.001", "held.001"]
    assert seen_vertices(obj) == before
    bpy.ops.reeb_parts.clear()
    assert obj.vertex_groups.keys() == ["held"]


@pytest.mark.parametrize("older", [False, True])
def test_no_group_of_ours_has_the_name_of_an_attribute(obj, older):
    """Blender 5 dropped the user's map or attribute once Edit Mode was entered, as one of an older file, too."""
    mesh = obj.data
    maps = np.random.default_rng(1).random((2, len(mesh.loops), 2), np.float32)
    faces = np.arange(len(mesh.polygons), dtype=np.int32)
    names = ["Part 01", "head", "DEF-Part 01"]
    mesh.uv_layers.new(name="head").uv.foreach_set("vector", maps[0].ravel())
    mesh.uv_layers.new(name="DEF-Part 01").uv.foreach_set("vector", maps[1].ravel())
    mesh.attributes.new("Part 01", "INT", "FACE").data.foreach_set("value", faces)
    bpy.ops.reeb_parts.decompose()
    parts = mesh.reeb_parts.parts
    parts[1].name = "head"
    if older:  # the groups have the names of the parts
        for part in parts[:2]:
            obj.vertex_groups[part.group].name = part.name
            part.group = part.name
        mesh.reeb_parts.detail = 0.9
    assert [part.group for part in parts][:2] == ["Part 01.001", "head.001"]
    bpy.ops.reeb_parts.armature()
    assert not set(obj.vertex_groups.keys()) & set(mesh.attributes.keys())
    for mode in ("EDIT", "OBJECT"):
        bpy.ops.object.mode_set(mode=mode)
    bpy.ops.reeb_parts.clear()
    assert obj.vertex_groups.keys() == []
    assert sorted(set(names) & set(mesh.attributes.keys())) == sorted(names)
    assert read(mesh.attributes["Part 01"].data, "value", np.int32).tolist() == faces.tolist()
    for name, values in zip(names[1:], maps, strict=True):
        assert np.array_equal(read(mesh.uv_layers[name].uv, "vector", width=2), values)


def test_an_attribute_of_ours_that_was_made_a_vertex_group_is_the_users(obj):
    """Blender 4 makes no attribute of the name of a group: Decompose ended with an AttributeError."""
    bpy.ops.reeb_parts.decompose()
    mesh = obj.data
    mesh.attributes.active = mesh.attributes["reeb_part"]
    bpy.ops.geometry.attribute_convert(mode="VERTEX_GROUP")
    bpy.ops.reeb_parts.decompose()
    assert mesh.reeb_parts.face_attribute == "reeb_part.001"
    assert "reeb_part.001" in mesh.attributes
    bpy.ops.reeb_parts.clear()
    assert obj.vertex_groups.keys() == ["reeb_part"]
    assert not [name for name in mesh.attributes.keys() if name.startswith("reeb")]


@pytest.mark.parametrize("n_parts", [0, 2])
def test_colors_that_were_painted_on_stay(obj, n_parts):
    """Vertex Paint paints on the active colors, which are ours: Clear removed them with all strokes."""
    mesh = obj.data
    bpy.ops.reeb_parts.decompose()
    if n_parts:
        mesh.reeb_parts.n_parts = n_parts
    colors = mesh.color_attributes["Reeb Parts"]
    colors.data[7].color_srgb = (0.5, 0.25, 0.125, 1.0)
    painted = read(colors.data, "color_srgb", width=4)
    bpy.ops.reeb_parts.clear()
    assert mesh.attributes.active_color_name == "Reeb Parts"
    assert np.array_equal(read(mesh.color_attributes["Reeb Parts"].data, "color_srgb", width=4), painted)
    assert "reeb_part" not in mesh.attributes
    bpy.ops.reeb_parts.decompose()  # beside them
    bpy.ops.reeb_parts.clear()
    assert mesh.color_attributes.keys() == ["Reeb Parts"]
    assert mesh.attributes.active_color_name == "Reeb Parts"
    assert np.array_equal(read(mesh.color_attributes["Reeb Parts"].data, "color_srgb", width=4), painted)


def test_colors_that_were_not_painted_on_go(obj):
    """Whatever colored them: a palette, the user's choice, hands, a drag of Detail, the elements in another order."""
    mesh = obj.data
    bpy.ops.reeb_parts.decompose()
    bpy.context.scene.reeb_parts.palette = "Pastel"
    mesh.reeb_parts.parts[0].color = (0.3, 0.61, 0.123)
    mesh.reeb_parts.detail = 0.6
    bpy.ops.reeb_parts.merge_neighbour()
    bpy.ops.reeb_parts.decompose()
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.ops.mesh.select_all(action="SELECT")
    bpy.ops.mesh.sort_elements(type="REVERSE", elements={"FACE"})
    bpy.ops.object.mode_set(mode="OBJECT")
    bpy.ops.reeb_parts.clear()
    assert mesh.color_attributes.keys() == []


def seen_vertices(obj):
    """Where the vertices are with all modifiers."""
    bpy.context.view_layer.update()
    return [tuple(vertex.co) for vertex in obj.evaluated_get(bpy.context.evaluated_depsgraph_get()).data.vertices]

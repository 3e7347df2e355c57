# SPDX-License-Identifier: GPL-3.0-or-later
"""What is left of ours on a mesh without a result, after a decomposed object was joined into it."""

import bpy
import numpy as np
import pytest
import shapes
from mathutils import Matrix
from snapshot import activate, snapshot


@pytest.mark.parametrize("after", ["decompose", "clear"])
def test_what_came_along_with_a_joined_object_is_ours(make, after):
    """Join takes attributes, groups and slots along, but not what says whose they are; the user's own stay."""
    tree, into = make(shapes.tube_tree(), "Tree"), make(shapes.dumbbell(24, 10), "Into")
    gold, steel = (bpy.data.materials.new(name) for name in ("Gold", "Steel"))
    tree.data.materials.append(gold)
    into.data.materials.append(steel)
    tree.data.edges[0].use_seam = into.data.edges[5].use_seam = True
    tree.vertex_groups.new(name="Part 99").add([0, 1], 1.0, "REPLACE")
    into.data.transform(Matrix.Translation((20, 0, 0)))
    activate(tree)
    bpy.ops.reeb_parts.decompose(graph=False, materials=True, seams=True, face_sets=True, field=True)
    bpy.ops.reeb_parts.hide()
    assert "Part 01" in tree.vertex_groups
    activate(into)
    tree.select_set(True)
    bpy.ops.object.join()
    getattr(bpy.ops.reeb_parts, after)(**({"graph": False} if after == "decompose" else {}))
    mesh, result = into.data, into.data.reeb_parts
    names = [part.name for part in result.parts]
    assert into.vertex_groups.keys() == ["Part 99", *names]
    assert [part.group for part in result.parts] == names
    assert not any(name.startswith(".reeb") for name in mesh.attributes.keys())
    assert ("reeb_part" in mesh.attributes) == ("Reeb Parts" in mesh.attributes) == (after == "decompose")
    assert "reeb_part.001" not in mesh.attributes
    assert not {"reeb_agd", "reeb_hidden"} & set(mesh.attributes.keys())
    assert [material.name for material in mesh.materials] == ["Steel", "Gold"]
    used = np.array([polygon.material_index for polygon in mesh.polygons])
    high = np.array([polygon.center.x > 10 for polygon in mesh.polygons])
    assert (used == np.where(high, 0, 1)).all()
    assert sum(edge.use_seam for edge in mesh.edges) == 2
    bpy.ops.reeb_parts.clear() if after == "decompose" else None
    assert into.vertex_groups.keys() == ["Part 99"]


@pytest.mark.parametrize("after", ["decompose", "clear"])
@pytest.mark.parametrize("named", ["", "A", "ABCDEF"], ids=len)
def test_what_came_into_a_decomposed_object_is_ours(make, after, named):
    """Its groups and materials stayed for ever, those of named parts even when the others went."""
    into, tree = make(shapes.dumbbell(24, 10), "Into"), make(shapes.tube_tree(), "Tree")
    gold, steel = (bpy.data.materials.new(name) for name in ("Gold", "Steel"))
    tree.data.materials.append(gold)
    into.data.materials.append(steel)
    tree.vertex_groups.new(name="Part 99").add([0, 1], 1.0, "REPLACE")
    tree.data.edges[0].use_seam = into.data.edges[5].use_seam = True
    into.data.transform(Matrix.Translation((20, 0, 0)))
    activate(into)
    bpy.ops.reeb_parts.decompose(graph=False)
    activate(tree)
    bpy.ops.reeb_parts.decompose(graph=False, materials=True, seams=True, face_sets=True)
    for part, name in zip(tree.data.reeb_parts.parts, named, strict=False):
        part.name = name
    assert len(tree.data.reeb_parts.parts) > len(into.data.reeb_parts.parts)
    activate(into)
    tree.select_set(True)
    bpy.ops.object.join()
    getattr(bpy.ops.reeb_parts, after)(**({"graph": False} if after == "decompose" else {}))
    names = [part.name for part in into.data.reeb_parts.parts]
    assert sorted(into.vertex_groups.keys()) == sorted(["Part 99", *names])
    assert [material.name for material in into.data.materials] == ["Steel", "Gold"]
    assert {face.material_index == (face.center.x < 10) for face in into.data.polygons} == {True}
    assert sum(edge.use_seam for edge in into.data.edges) == 2
    assert not {".reeb_former_material", ".reeb_former_seam", ".sculpt_face_set"} & set(into.data.attributes.keys())
    bpy.ops.reeb_parts.clear() if after == "decompose" else None
    assert into.vertex_groups.keys() == ["Part 99"]


@pytest.mark.parametrize("decomposed", [False, True])
@pytest.mark.parametrize("named", ["", "AB"], ids=len)
def test_what_came_along_with_several_joined_objects_is_ours(make, decomposed, named):
    """Where parts of one number had two colors or names, the groups of all of them stayed for ever."""
    into, *others = (make(shape, "M") for shape in (shapes.dumbbell(24, 10), shapes.tube_tree(), shapes.tube_tree()))
    for place, obj in enumerate(others):
        obj.data.transform(Matrix.Translation((20 * place + 20, 0, 0)))
        obj.vertex_groups.new(name="Part 99").add([0, 1], 1.0, "REPLACE")
        activate(obj)
        bpy.ops.reeb_parts.decompose(graph=False, materials=True)
        obj.data.reeb_parts.parts[place].name = named[place:place + 1] or "Part 01"
        obj.data.reeb_parts.parts[0].color = (0.1, 0.2 * place + 0.3, 0.5)
    activate(into)
    if decomposed:
        bpy.ops.reeb_parts.decompose(graph=False)
    for obj in others:
        obj.select_set(True)
    bpy.ops.object.join()
    bpy.ops.reeb_parts.clear()
    assert into.vertex_groups.keys() == ["Part 99"]
    assert not {"reeb_part", "Reeb Parts", ".reeb_former_material"} & set(into.data.attributes.keys())


@pytest.mark.parametrize("with_parts", [False, True])
@pytest.mark.parametrize("after", ["clear", "decompose", "decompose with the same outputs"])
def test_what_is_joined_into_a_model_with_outputs_keeps_materials_seams_and_face_sets(make, with_parts, after):
    """All joined faces had the first slot of the model then, no seams and no face sets."""
    outputs = {"graph": False, "materials": True, "seams": True, "face_sets": True}
    into, tree = make(shapes.tube_tree(), "Into"), make(shapes.tube_tree(), "Tree")
    into.data.transform(Matrix.Translation((20, 0, 0)))
    for obj, names in ((into, ["Steel"]), (tree, ["Gold", "Silver"])):
        for name in names:
            obj.data.materials.append(bpy.data.materials.new(name))
    tree.data.polygons[7].material_index = 1
    tree.data.edges[3].use_seam = into.data.edges[5].use_seam = True
    sets = tree.data.attributes.new(".sculpt_face_set", "INT", "FACE")
    sets.data.foreach_set("value", np.arange(len(tree.data.polygons), dtype=np.int32) % 2 + 1)
    for obj in (into, tree)[: 1 + with_parts]:
        activate(obj)
        bpy.ops.reeb_parts.decompose(**outputs)
    activate(into)
    tree.select_set(True)
    bpy.ops.object.join()
    if after != "clear":
        bpy.ops.reeb_parts.decompose(**(outputs if after.endswith("outputs") else {"graph": False}))
    bpy.ops.reeb_parts.clear()
    mesh = into.data
    assert [material.name for material in mesh.materials] == ["Steel", "Gold", "Silver"]
    joined = np.array([polygon.center.x < 10 for polygon in mesh.polygons])
    used = np.array([polygon.material_index for polygon in mesh.polygons])
    other = np.flatnonzero(joined)[7]
    assert used[other] == 2
    assert (np.delete(used, other) == np.delete(joined, other)).all()
    assert sum(edge.use_seam for edge in mesh.edges) == 2
    there = np.array([item.value for item in mesh.attributes[".sculpt_face_set"].data])
    assert (len(set(there[joined])), len(set(there[~joined]))) == (2, 1)
    assert not any(name.startswith(".reeb") for name in mesh.attributes.keys())


@pytest.mark.parametrize("after", ["clear", "decompose"])
def test_of_extruded_faces_no_material_of_a_part_is_kept(make, after):
    """They carry on what the faces had from which they come."""
    obj = make(shapes.tube_tree(), "Tree")
    obj.data.materials.append(bpy.data.materials.new("Gold"))
    bpy.ops.reeb_parts.decompose(graph=False, materials=True, seams=True, face_sets=True)
    with bpy.context.temp_override(active_object=obj, object=obj):
        bpy.ops.object.mode_set(mode="EDIT")
        bpy.ops.mesh.select_all(action="SELECT")
        bpy.ops.mesh.duplicate()
        bpy.ops.transform.translate(value=(0, 0, 5))
        bpy.ops.object.mode_set(mode="OBJECT")
    bpy.ops.reeb_parts.decompose(graph=False) if after == "decompose" else None
    bpy.ops.reeb_parts.clear()
    assert [material.name for material in obj.data.materials] == ["Gold"]
    assert not any(polygon.material_index for polygon in obj.data.polygons)
    assert not any(edge.use_seam for edge in obj.data.edges)
    assert ".sculpt_face_set" not in obj.data.attributes


def test_groups_of_the_user_that_hold_the_vertices_of_parts_stay(make):
    """Without groups of ours, and where there is a second one."""
    into, tree = make(shapes.dumbbell(24, 10), "Into"), make(shapes.tube_tree(), "Tree")
    activate(tree)
    bpy.ops.reeb_parts.decompose(graph=False)
    tree.vertex_groups.new(name="Mine").add([*{v.index for v in tree.data.vertices if any(
        entry.group == 0 for entry in v.groups)}], 1.0, "REPLACE")
    tree.data.reeb_parts.parts[0].name = "Theirs"
    activate(into)
    tree.select_set(True)
    bpy.ops.object.join()
    bpy.ops.reeb_parts.clear()
    assert into.vertex_groups.keys() == ["Theirs", "Mine"]


def test_attributes_of_the_user_that_are_called_as_ours_stay(obj):
    mesh = obj.data
    numbers = mesh.attributes.new("reeb_part", "INT", "FACE")
    numbers.data.foreach_set("value", np.arange(len(mesh.polygons), dtype=np.int32) % 3 + 1)
    shades = mesh.color_attributes.new("Reeb Parts", "BYTE_COLOR", "CORNER")
    values = np.random.default_rng(0).random((len(mesh.loops), 4)).astype(np.float32)
    shades.data.foreach_set("color_srgb", values.ravel())
    obj.vertex_groups.new(name="Part 01").add([0], 0.5, "REPLACE")
    before = snapshot()
    bpy.ops.reeb_parts.decompose()
    bpy.ops.reeb_parts.clear()
    assert snapshot() == before


if bpy.app.version >= (5, 0):  # Join of Blender 4 itself makes one of several face sets

    @pytest.mark.parametrize("owners", [("Into",), ("Tree",), ("Into", "Tree")])
    @pytest.mark.parametrize("decomposed", [("Tree",), ("Into", "Tree")])
    def test_face_sets_of_the_user_are_as_apart_after_join_as_without_us(make, decomposed, owners):
        """Those of the one were one with those of the other, or the parts of the one were left in their place."""
        groups = []
        for with_us in (False, True):
            objects = {"Into": make(shapes.dumbbell(24, 10), "Into"), "Tree": make(shapes.tube_tree(), "Tree")}
            for name, obj in objects.items():
                if name in owners:
                    sets = obj.data.attributes.new(".sculpt_face_set", "INT", "FACE")
                    sets.data.foreach_set("value", np.arange(len(sets.data), dtype=np.int32) % 3 + 1)
                if with_us and name in decomposed:
                    activate(obj)
                    bpy.ops.reeb_parts.decompose(graph=False, face_sets=True)
            into = objects["Into"]
            activate(into)
            objects["Tree"].select_set(True)
            bpy.ops.object.join()
            if with_us:
                bpy.ops.reeb_parts.clear()
            groups.append(np.array([item.value for item in into.data.attributes[".sculpt_face_set"].data]))
            bpy.context.view_layer.update()
        pairs = set(zip(*(sets.tolist() for sets in groups), strict=True))
        assert len(pairs) == len(set(groups[0].tolist())) == len(set(groups[1].tolist())) > 3

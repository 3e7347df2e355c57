# SPDX-License-Identifier: GPL-3.0-or-later
"""Pieces of objects with modifiers: copied, applied, or named where they shape a piece otherwise."""

import bpy
import numpy as np
import pytest
from bulk import read
from mathutils import Matrix
from pieces import KEEP, WHOLE, borders, caps_of, pieces_of, same_places
from results import numbers as numbers_of
from snapshot import activate, snapshot


def test_modifiers_are_copied_or_not(obj):
    obj.modifiers.new("Smooth", "SUBSURF")
    bpy.ops.reeb_parts.decompose()
    bpy.ops.reeb_parts.separate(**KEEP)
    assert all(piece.modifiers.keys() == ["Smooth"] for piece in pieces_of())
    bpy.ops.reeb_parts.separate(modifiers=False, **KEEP)
    assert not any(piece.modifiers for piece in pieces_of())


def mirrored(obj, **settings):
    """Give an object a Mirror modifier in its own plane x = 0 and let it stand aside and turned."""
    obj.data.transform(Matrix.Translation((6, 0, 0)))
    obj.location, obj.rotation_euler = (1, 2, 3), (0.1, 0.2, 0.3)
    modifier = obj.modifiers.new("Mirror", "MIRROR")
    for name, value in settings.items():
        setattr(modifier, name, value)


def seen_faces(*objects):
    """The places of the middles of all faces as they are seen."""
    bpy.context.view_layer.update()
    depsgraph = bpy.context.evaluated_depsgraph_get()
    found = []
    for obj in objects:
        mesh = obj.evaluated_get(depsgraph).data
        matrix = np.array(obj.matrix_world)
        found.append(read(mesh.polygons, "center", np.float32, 3) @ matrix[:3, :3].T + matrix[:3, 3])
    return np.concatenate(found)


@pytest.mark.parametrize("style", [{}, {"center": False}, {"seen": True}, {"parent": True}])
def test_with_a_mirror_modifier_pieces_stay_where_they_were(obj, style):
    """Without a mirror object, the modifier mirrors about the origin, which a piece has to keep then."""
    mirrored(obj)
    bpy.ops.reeb_parts.decompose()
    before = seen_faces(obj)
    bpy.ops.reeb_parts.separate(**style, **WHOLE)
    assert same_places(seen_faces(*pieces_of()), before)
    assert all(bool(piece.modifiers) != style.get("seen", False) for piece in pieces_of())


def test_copies_of_an_array_stay_together(obj):
    """A relative offset is one by the extent of the mesh that the modifier gets, and pieces are smaller."""
    mirrored(obj, use_axis=(False, True, False))
    for name, step in (("Row", (1.1, 0.0, 0.1)), ("Column", (0.0, 1.0, 0.5))):
        array = obj.modifiers.new(name, "ARRAY")
        array.count, array.relative_offset_displace = 2, step
    array.use_constant_offset, array.constant_offset_displace = True, (0.3, 0.0, 0.0)
    seen = seen_faces(obj)
    bpy.ops.reeb_parts.decompose()
    bpy.ops.reeb_parts.separate(**KEEP, **WHOLE)
    assert same_places(seen_faces(*pieces_of()), seen)
    assert obj.modifiers["Row"].use_relative_offset


@pytest.mark.parametrize(("kind", "settings", "said"), [
    ("SIMPLE_DEFORM", {}, True), ("CAST", {}, True), ("CAST", {"radius": 1.0}, False), ("CAST", {"size": 1.0}, True),
    ("CAST", {"size": 1.0, "use_radius_as_size": False}, False), ("BEVEL", {}, False)])
def test_modifiers_that_work_by_the_extent_are_told(obj, capfd, kind, settings, said):
    modifier = obj.modifiers.new("Shaper", kind)
    for name, value in settings.items():
        setattr(modifier, name, value)
    bpy.ops.reeb_parts.decompose()
    bpy.ops.reeb_parts.separate(**KEEP)
    assert ("effect of Shaper depends on the extent" in capfd.readouterr().out) == said
    activate(obj)
    bpy.ops.reeb_parts.separate(**KEEP, seen=True)
    assert "depends on the extent" not in capfd.readouterr().out


def bound(obj, kind):
    """A modifier of a kind, bound or with indices, that does something to an object."""
    modifier = obj.modifiers.new("Holder", kind)
    if kind in ("SURFACE_DEFORM", "MESH_DEFORM"):
        bpy.ops.mesh.primitive_cube_add(size=30)
        cage = bpy.context.object
        setattr(modifier, "target" if kind == "SURFACE_DEFORM" else "object", cage)
        if kind == "MESH_DEFORM":
            modifier.precision = 2  # of eight, each twice as fine as the one before: to bind takes seconds
        activate(obj)
        getattr(bpy.ops.object, "surfacedeform_bind" if kind == "SURFACE_DEFORM" else "meshdeform_bind")(
            modifier="Holder")
        assert modifier.is_bound
    elif kind == "HOOK":
        modifier.object = bpy.data.objects.new("Hand", None)
        modifier.vertex_indices_set([0, 1, 2])
    elif kind == "BOOLEAN":
        bpy.ops.mesh.primitive_cube_add(size=1)
        modifier.object = bpy.context.object
    activate(obj)


@pytest.mark.parametrize(("kind", "style", "said"), [
    ("SURFACE_DEFORM", {}, True), ("MESH_DEFORM", {}, True), ("HOOK", {}, True), ("BOOLEAN", {"caps": False}, True),
    ("BOOLEAN", {"caps": True}, False), ("REMESH", {"caps": False}, True), ("HOOK", {"seen": True}, False)])
def test_modifiers_that_are_made_for_the_whole_are_told(obj, capfd, kind, style, said):
    bound(obj, kind)
    bpy.ops.reeb_parts.decompose()
    bpy.ops.reeb_parts.separate(**KEEP, **style)
    assert ("effect of Holder is made for all of Tree" in capfd.readouterr().out) == said


@pytest.mark.parametrize(("kind", "settings", "said"), [
    ("DISPLACE", {}, True), ("DISPLACE", {"direction": "X"}, False), ("DISPLACE", {"strength": 0.0}, False),
    ("SHRINKWRAP", {"offset": 0.3}, True), ("SHRINKWRAP", {}, False),
    ("SHRINKWRAP", {"wrap_method": "PROJECT"}, True)])
def test_modifiers_that_move_along_normals_are_told(obj, capfd, kind, settings, said):
    """Where a piece was cut off normals are others, and cracks open."""
    modifier = obj.modifiers.new("Holder", kind)
    if kind == "SHRINKWRAP":
        bpy.ops.mesh.primitive_uv_sphere_add(radius=3)
        modifier.target = bpy.context.object
        activate(obj)
    for name, value in settings.items():
        setattr(modifier, name, value)
    bpy.ops.reeb_parts.decompose()
    bpy.ops.reeb_parts.separate(**KEEP)
    assert ("effect of Holder is made for all of Tree" in capfd.readouterr().out) == said


def test_about_another_object_pieces_have_origins_of_their_own(obj):
    empty = bpy.data.objects.new("Plane", None)
    bpy.context.scene.collection.objects.link(empty)
    empty.location.x = -0.123
    mirrored(obj, mirror_object=empty)
    bpy.ops.reeb_parts.decompose()
    before = seen_faces(obj)
    bpy.ops.reeb_parts.separate(**WHOLE)
    assert same_places(seen_faces(*pieces_of()), before)
    assert len({tuple(piece.location) for piece in pieces_of()}) == len(pieces_of())


@pytest.mark.parametrize("materials", [False, True])
def test_what_is_seen_is_cut_with_all_that_modifiers_make(obj, materials):
    """Subdivision makes four faces of a quad, three of a triangle; each stays in the part of its face."""
    obj.modifiers.new("Subdivision", "SUBSURF").levels = 1
    bpy.ops.reeb_parts.decompose(materials=materials)
    before, stored = seen_faces(obj), snapshot()["meshes"]["Tree"]
    bpy.ops.reeb_parts.separate(seen=True, caps=True, hide=False, **WHOLE)
    assert snapshot()["meshes"]["Tree"] == stored
    corners = read(obj.data.polygons, "loop_total", np.int32)
    expected = np.bincount(numbers_of(obj.data), corners)[1:].astype(int).tolist()
    assert [int((caps_of(piece.data) == 0).sum()) for piece in pieces_of()] == expected
    assert [len(piece.data.materials) for piece in pieces_of()] == [int(materials)] * len(pieces_of())
    assert not any(a.name.startswith(("reeb", "Reeb")) and a.name != "reeb_cap"
                   for piece in pieces_of() for a in piece.data.attributes)
    assert not any(piece.vertex_groups for piece in pieces_of())
    bpy.ops.reeb_parts.separate(seen=True, hide=False, **WHOLE)
    assert same_places(seen_faces(*pieces_of()), before)


def test_walls_that_a_modifier_makes_are_closed_between_their_rims(obj):
    """Each cut goes through the outer and the inner side; with the first cap made, the others ended in an error."""
    obj.modifiers.new("Solidify", "SOLIDIFY").thickness = 0.05
    bpy.ops.reeb_parts.decompose()
    assert bpy.ops.reeb_parts.separate(seen=True, caps=True, hide=False, **WHOLE) == {"FINISHED"}
    assert [borders(piece.data) for piece in pieces_of()] == [(set(), 0)] * len(pieces_of())


def test_faces_of_no_part_are_refused_and_nothing_written(obj):
    obj.modifiers.new("Remesh", "REMESH").voxel_size = 0.5
    bpy.ops.reeb_parts.decompose()
    before = snapshot()
    with pytest.raises(RuntimeError, match="belong to no part"):
        bpy.ops.reeb_parts.separate(seen=True)
    assert snapshot() == before


def mask(obj, group):
    obj.modifiers.new("Mask", "MASK").vertex_group = group


def displaced(obj, group):
    modifier = obj.modifiers.new("Displace", "DISPLACE")
    modifier.direction, modifier.vertex_group = "Z", group


def shaped(obj, group):
    obj.shape_key_add(name="Basis")
    key = obj.shape_key_add(name="Long")
    key.data.foreach_set("co", (1.5 * read(obj.data.vertices, "co", np.float32, 3)).ravel())
    key.vertex_group, key.value = group, 1.0


def hairy(obj, group):
    obj.modifiers.new("Hair", "PARTICLE_SYSTEM")
    obj.particle_systems[0].vertex_group_density = group


def given(obj, group):
    """Nodes that move what is in a group, whose name the modifier has."""
    tree = nodes_of(obj, "GeometryNodeSetPosition")
    tree.interface.new_socket("Group", in_out="INPUT", socket_type="NodeSocketVector")
    start, move = (next(node for node in tree.nodes if node.bl_idname == name)
                   for name in ("NodeGroupInput", "GeometryNodeSetPosition"))
    tree.links.new(start.outputs[1], move.inputs["Offset"])
    modifier = obj.modifiers["Nodes"]
    if hasattr(modifier, "properties"):
        modifier.properties.inputs.Socket_2.type = "ATTRIBUTE"
        modifier.properties.inputs.Socket_2.attribute_name = group
    else:
        modifier["Socket_2_use_attribute"], modifier["Socket_2_attribute_name"] = True, group
    obj.update_tag()


def named(obj, group):
    """Nodes that name a group, within another group of nodes."""
    inner = bpy.data.node_groups.new("Inner", "GeometryNodeTree")
    inner.interface.new_socket("Weight", in_out="OUTPUT", socket_type="NodeSocketFloat")
    weight, end = (inner.nodes.new(name) for name in ("GeometryNodeInputNamedAttribute", "NodeGroupOutput"))
    weight.inputs["Name"].default_value = group
    inner.links.new(weight.outputs[0], end.inputs[0])
    tree = nodes_of(obj, "GeometryNodeSetPosition")
    node = tree.nodes.new("GeometryNodeGroup")
    node.node_tree = inner
    move = next(node for node in tree.nodes if node.bl_idname == "GeometryNodeSetPosition")
    tree.links.new(node.outputs[0], move.inputs["Offset"])


def nodes_of(obj, name):
    """A modifier with a node that geometry goes through."""
    tree = bpy.data.node_groups.new("Nodes", "GeometryNodeTree")
    for way in ("INPUT", "OUTPUT"):
        tree.interface.new_socket("Geometry", in_out=way, socket_type="NodeSocketGeometry")
    start, node, end = (tree.nodes.new(name) for name in ("NodeGroupInput", name, "NodeGroupOutput"))
    tree.links.new(start.outputs[0], node.inputs[0])
    tree.links.new(node.outputs[0], end.inputs[0])
    obj.modifiers.new("Nodes", "NODES").node_group = tree
    return tree


@pytest.mark.parametrize("use", [mask, displaced, shaped, hairy, given, named])
@pytest.mark.parametrize("style", [{}, {"caps": True, "cut": "SMOOTH"}])
def test_a_group_of_a_part_by_which_a_modifier_works_comes_along(obj, use, style):
    """Without the group, a modifier that is to act on one part acts on all pieces, and a Mask hid all of them."""
    bpy.ops.reeb_parts.decompose(vertex_groups=True)
    names, group = obj.vertex_groups.keys(), obj.vertex_groups[1].name
    use(obj, group)
    seen = seen_faces(obj)
    bpy.ops.reeb_parts.separate(**KEEP, **{**WHOLE, **style})
    assert all(piece.vertex_groups.keys() == [group] for piece in pieces_of())
    assert obj.vertex_groups.keys() == names
    if not style:
        assert same_places(seen_faces(*pieces_of()), seen)


def test_part_numbers_by_which_nodes_work_come_along(obj):
    bpy.ops.reeb_parts.decompose(face_attribute=True)
    tree = nodes_of(obj, "GeometryNodeDeleteGeometry")
    number, same = (tree.nodes.new(name) for name in ("GeometryNodeInputNamedAttribute", "FunctionNodeCompare"))
    number.data_type, number.inputs["Name"].default_value = "INT", "reeb_part"
    same.data_type, same.operation = "INT", "EQUAL"
    first, second = (socket for socket in same.inputs if socket.type == "INT")
    second.default_value = 2
    away = next(node for node in tree.nodes if node.bl_idname == "GeometryNodeDeleteGeometry")
    away.domain = "FACE"
    tree.links.new(next(socket for socket in number.outputs if socket.enabled), first)
    tree.links.new(same.outputs[0], away.inputs["Selection"])
    seen = seen_faces(obj)
    assert 0 < len(seen) < len(obj.data.polygons)
    bpy.ops.reeb_parts.separate(**KEEP, **WHOLE)
    assert same_places(seen_faces(*pieces_of()), seen)


@pytest.mark.parametrize(("kind", "key"), [("ShaderNodeVertexColor", "layer_name"),
                                           ("ShaderNodeAttribute", "attribute_name")])
@pytest.mark.parametrize("link", ["DATA", "OBJECT"])
def test_colors_that_a_material_shows_come_along(obj, kind, key, link):
    """Rendered by such a material, pieces were black; another attribute is left out as ever."""
    bpy.ops.reeb_parts.decompose(face_attribute=True)
    material = bpy.data.materials.new("Shown")
    material.use_nodes = True
    setattr(material.node_tree.nodes.new(kind), key, "Reeb Parts")
    obj.data.materials.append(None)
    obj.material_slots[0].link = link
    obj.material_slots[0].material = material
    attribute = obj.data.color_attributes["Reeb Parts"]
    shown = {tuple(item.color) for item in attribute.data}
    bpy.ops.reeb_parts.separate(**KEEP)
    colors = [piece.data.color_attributes["Reeb Parts"] for piece in pieces_of()]
    assert {color.domain for color in colors} == {attribute.domain}
    assert {tuple(item.color) for color in colors for item in color.data} == shown
    assert not any("reeb_part" in piece.data.attributes for piece in pieces_of())


def test_what_only_explode_works_by_stays_behind(obj):
    bpy.ops.reeb_parts.decompose()
    obj.reeb_parts_made.explode = 0.5
    bpy.ops.reeb_parts.separate(**KEEP)
    assert not any("reeb_part" in piece.data.attributes for piece in pieces_of())


def rig_of(obj):
    """A bent armature with one bone, which moves the upper half."""
    rig = bpy.data.objects.new("Rig", bpy.data.armatures.new("Rig"))
    bpy.context.collection.objects.link(rig)
    activate(rig)
    bpy.ops.object.mode_set(mode="EDIT")
    rig.data.edit_bones.new("Bone").tail = (0, 0, 1)
    bpy.ops.object.mode_set(mode="OBJECT")
    rig.pose.bones["Bone"].rotation_quaternion = (0.9, 0.3, 0.2, 0.1)
    high = np.flatnonzero(read(obj.data.vertices, "co", np.float32, 3)[:, 2] > 0)
    obj.vertex_groups.new(name="Bone").add(high.tolist(), 1.0, "REPLACE")
    return rig


def lattice_of(_):
    lattice = bpy.data.objects.new("Lattice", bpy.data.lattices.new("Lattice"))
    bpy.context.collection.objects.link(lattice)
    lattice.scale = (5, 5, 5)
    lattice.data.points[0].co_deform.x -= 1
    return lattice


@pytest.mark.parametrize("style", [{}, {"center": False}, {"seen": True}, {"parent": True},
                                   {"parent": True, "center": False}, {"parent": True, "seen": True}])
@pytest.mark.parametrize("kind", ["ARMATURE", "LATTICE"])
@pytest.mark.parametrize("displaces", [False, True])
def test_pieces_of_what_its_parent_deforms_stay_where_they_were(obj, style, kind, displaces):
    """It deforms without a modifier: what was seen was deformed twice, and a child of the original not at all."""
    obj.location, obj.rotation_euler = (1, 0.5, 0.2), (0.1, 0.2, 0.3)
    parent = rig_of(obj) if kind == "ARMATURE" else lattice_of(obj)
    obj.parent, obj.parent_type = parent, kind
    if displaces:
        obj.modifiers.new("Displace", "DISPLACE").direction = "Z"
    activate(obj)
    bpy.ops.reeb_parts.decompose()
    before = seen_faces(obj)
    bpy.ops.reeb_parts.separate(**style, **WHOLE)
    assert same_places(seen_faces(*pieces_of()), before)
    assert obj.parent_type == kind

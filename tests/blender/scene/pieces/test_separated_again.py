# SPDX-License-Identifier: GPL-3.0-or-later
"""What a second Separate replaces, and what it leaves since somebody has worked on it."""

import importlib

import bpy
import pytest
from pieces import KEEP, pieces_of
from snapshot import activate, snapshot


def test_a_second_run_makes_the_same_again(rich):
    bpy.ops.reeb_parts.decompose()
    bpy.ops.reeb_parts.separate(caps=True, hide=False)
    first = snapshot()
    activate(rich)
    bpy.ops.reeb_parts.separate(caps=True, hide=False)
    assert snapshot() == first


def test_other_parts_replace_the_earlier_pieces(obj):
    bpy.ops.reeb_parts.decompose()
    bpy.ops.reeb_parts.separate(**KEEP)
    meshes = len(bpy.data.meshes)
    activate(obj)
    obj.data.reeb_parts.n_parts = 2
    bpy.ops.reeb_parts.separate(**KEEP)
    assert len(bpy.data.collections["Parts of Tree"].objects) == len(pieces_of()) == 2
    assert len(bpy.data.meshes) < meshes


WORK = {
    "mesh": lambda piece: setattr(piece.data.vertices[0].co, "x", 0.01),
    "place": lambda piece: setattr(piece.location, "z", 1),
    "name": lambda piece: setattr(piece, "name", "Body"),
    "modifier": lambda piece: piece.modifiers.new("Bevel", "BEVEL"),
    "material": lambda piece: piece.data.materials.append(bpy.data.materials.new("Gold")),
    "the material of a face": lambda piece: setattr(piece.data.polygons[0], "material_index", 1),
    "map": lambda piece: setattr(piece.data.uv_layers.new().data[0], "uv", (0.3, 0.4)),
    "group": lambda piece: piece.vertex_groups.new(name="Bone"),
    "weight": lambda piece: piece.vertex_groups["Bend"].add([0], 0.3, "REPLACE"),
    "color": lambda piece: setattr(piece.data.color_attributes.new("Paint", "BYTE_COLOR", "CORNER").data[0], "color",
                                   (1, 0, 0, 1)),
    "text": lambda piece: setattr(piece.data.attributes.new("Word", "STRING", "FACE").data[0], "value", b"a"),
    "seam": lambda piece: setattr(piece.data.edges[0], "use_seam", True),
    "shape key": lambda piece: (piece.shape_key_add(name="Basis"), piece.shape_key_add(name="Smile")),
    "parts": lambda piece: (activate(piece), bpy.ops.reeb_parts.decompose(graph=False)),
    "constraint": lambda piece: piece.constraints.new("COPY_LOCATION"),
    "keyframes": lambda piece: piece.keyframe_insert("location", frame=1),
    "driver": lambda piece: piece.driver_add("location", 0),
    "rigid body": lambda piece: made_body(piece),
    "custom property": lambda piece: piece.__setitem__("mine", 1),
    "custom property of the mesh": lambda piece: piece.data.__setitem__("mine", 1),
    "setting of a modifier": lambda piece: setattr(piece.modifiers["Wave"], "height", 0.3),
    "input of nodes": lambda piece: set_input(piece.modifiers["Nodes"], 0.25),
    "object color": lambda piece: setattr(piece, "color", (1, 0, 0, 1)),
    "not in renders": lambda piece: setattr(piece, "hide_render", True),
    "lock": lambda piece: setattr(piece, "lock_location", (True, True, True)),
    "asset": lambda piece: piece.asset_mark(),
    "asset of the mesh": lambda piece: piece.data.asset_mark(),
    "name of the mesh": lambda piece: setattr(piece.data, "name", "Mine"),
    "force field": lambda piece: (activate(piece), bpy.ops.object.forcefield_toggle()),
    "shadow in the view": lambda piece: setattr(piece.display, "show_shadows", False),
    "line art": lambda piece: setattr(piece.lineart, "usage", "EXCLUDE"),
    "light linking": lambda piece: setattr(piece.light_linking, "receiver_collection", bpy.data.collections.new("Lit")),
    "another extension": lambda piece: setattr(piece.other_extension.deeper.add(), "kind", "Collider"),
    "another extension, of the mesh": lambda piece: setattr(piece.data.other_extension, "kind", "Collider"),
}


class Deeper(bpy.types.PropertyGroup):
    kind: bpy.props.StringProperty()


class Other(bpy.types.PropertyGroup):
    kind: bpy.props.StringProperty()
    deeper: bpy.props.CollectionProperty(type=Deeper)


@pytest.fixture
def other_extension():
    """An extension that keeps groups of properties with objects and meshes."""
    for kind in (Deeper, Other):
        bpy.utils.register_class(kind)
    for owner in (bpy.types.Object, bpy.types.Mesh):
        owner.other_extension = bpy.props.PointerProperty(type=Other)
    yield
    for owner in (bpy.types.Object, bpy.types.Mesh):
        del owner.other_extension
    for kind in (Other, Deeper):
        bpy.utils.unregister_class(kind)


def made_body(obj):
    bpy.ops.rigidbody.world_add()
    bpy.context.scene.rigidbody_world.collection = bpy.data.collections.new("Bodies")
    bpy.context.scene.rigidbody_world.collection.objects.link(obj)


def with_input(obj):
    """Give an object a modifier of nodes that have an input and do nothing."""
    group = bpy.data.node_groups.new("Nodes", "GeometryNodeTree")
    for way in ("INPUT", "OUTPUT"):
        group.interface.new_socket("Geometry", in_out=way, socket_type="NodeSocketGeometry")
    group.interface.new_socket("Value", in_out="INPUT", socket_type="NodeSocketFloat")
    start, end = group.nodes.new("NodeGroupInput"), group.nodes.new("NodeGroupOutput")
    group.links.new(start.outputs[0], end.inputs[0])
    obj.modifiers.new("Nodes", "NODES").node_group = group


def set_input(modifier, value):
    name = next(item.identifier for item in modifier.node_group.interface.items_tree if item.name == "Value")
    if bpy.app.version < (5, 2):
        modifier[name] = value
    else:
        getattr(modifier.properties.inputs, name).value = value


@pytest.mark.parametrize("work", WORK)
def test_pieces_that_somebody_worked_on_are_kept(obj, work, other_extension):
    obj.other_extension.kind = "Of the whole"
    obj.vertex_groups.new(name="Bend").add(range(len(obj.data.vertices)), 0.5, "REPLACE")
    obj.modifiers.new("Wave", "WAVE")
    with_input(obj)
    bpy.ops.reeb_parts.decompose()
    bpy.ops.reeb_parts.separate(**KEEP)
    count = len(pieces_of())
    mine = pieces_of()[0]
    WORK[work](mine)
    activate(obj)
    bpy.ops.reeb_parts.separate(**KEEP)
    assert mine in bpy.data.objects[:]
    assert mine not in pieces_of()
    assert len(pieces_of()) == count


KEY_WORK = {
    "value": lambda keys: setattr(keys.key_blocks["Fat"], "value", 0.7),
    "name": lambda keys: setattr(keys.key_blocks["Fat"], "name", "Smile"),
    "range": lambda keys: setattr(keys.key_blocks["Fat"], "slider_max", 3.0),
    "mute": lambda keys: setattr(keys.key_blocks["Fat"], "mute", True),
    "of another": lambda keys: setattr(keys.key_blocks["Fat"], "relative_key", keys.key_blocks["Long"]),
    "keyframes": lambda keys: keys.key_blocks["Fat"].keyframe_insert("value", frame=1),
    "driver": lambda keys: keys.key_blocks["Fat"].driver_add("value"),
    "custom property": lambda keys: keys.__setitem__("mine", 1),
    "no change": lambda keys: None,
}


@pytest.mark.parametrize("work", KEY_WORK)
def test_shape_keys_that_somebody_worked_on_are_kept(obj, work):
    """A face that was keyed and animated on a piece went with it; what moves by itself is no work."""
    for name in ("Basis", "Fat", "Long", "Moving"):
        obj.shape_key_add(name=name).data[0].co.x += len(name) / 99
    keys = obj.data.shape_keys.key_blocks
    keys["Fat"].value = 0.2
    for frame, value in ((1, 0.0), (9, 1.0)):
        keys["Moving"].value = value
        keys["Moving"].keyframe_insert("value", frame=frame)
    bpy.ops.reeb_parts.decompose()
    bpy.ops.reeb_parts.separate(**KEEP)
    mine = pieces_of()[0]
    KEY_WORK[work](mine.data.shape_keys)
    bpy.context.scene.frame_set(5)
    activate(obj)
    bpy.ops.reeb_parts.separate(**KEEP)
    assert (mine in bpy.data.objects[:]) == (work != "no change")


def test_pieces_that_somebody_only_looked_at_are_replaced(obj):
    bpy.ops.reeb_parts.decompose()
    bpy.ops.reeb_parts.separate(**KEEP)
    looked, count = pieces_of()[0], len(pieces_of())
    activate(looked)
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.ops.mesh.select_all(action="SELECT")
    bpy.ops.mesh.hide()
    bpy.ops.mesh.reveal()
    bpy.ops.object.mode_set(mode="OBJECT")
    activate(obj)
    bpy.ops.reeb_parts.separate(**KEEP)
    assert len(bpy.data.collections["Parts of Tree"].objects) == len(pieces_of()) == count


def test_what_our_tools_make_of_pieces_is_no_work(obj):
    """Nor is what an animation moves that came with the object."""
    obj.keyframe_insert("location", frame=1)
    obj.location.x = 2
    obj.keyframe_insert("location", frame=9)
    bpy.ops.reeb_parts.decompose()
    bpy.ops.reeb_parts.separate(**KEEP)
    count = len(pieces_of())
    bpy.ops.reeb_parts.rigid_bodies()
    activate(obj)
    bpy.ops.reeb_parts.hulls()
    bpy.context.scene.frame_set(5)
    activate(obj)
    bpy.ops.reeb_parts.separate(**KEEP)
    others = [item for item in bpy.data.collections["Parts of Tree"].objects if item.get("reeb_parts_role") != "hull"]
    assert len(others) == len(pieces_of()) == count
    mine = pieces_of()[0]
    bpy.ops.reeb_parts.rigid_bodies()
    mine.rigid_body.mass = 7
    activate(obj)
    bpy.ops.reeb_parts.separate(**KEEP)
    assert mine in bpy.data.objects[:]
    assert mine not in pieces_of()


def test_pieces_that_earlier_versions_made_are_known(obj, package, tmp_path):
    """They kept a long text, where there is a short one now."""
    bpy.ops.reeb_parts.decompose()
    bpy.ops.reeb_parts.separate(**KEEP)
    assert all(len(piece["reeb_parts_looks"]) < 60 for piece in pieces_of())
    for piece in pieces_of():
        piece["reeb_parts_looks"] = importlib.import_module(f"{package}.scene.pieces.piece_objects").former_looks(piece)
    mine, count = pieces_of()[0], len(pieces_of())
    mine.location.x += 1
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "pieces.blend"))
    bpy.ops.wm.open_mainfile(filepath=str(tmp_path / "pieces.blend"))
    obj, mine = bpy.data.objects["Tree"], pieces_of()[0]
    activate(obj)
    bpy.ops.reeb_parts.separate(**KEEP)
    assert mine in bpy.data.objects[:]
    assert mine not in pieces_of()
    assert len(bpy.data.collections["Parts of Tree"].objects) == count + 1


def test_a_saved_file_knows_its_pieces(obj, tmp_path):
    obj.modifiers.new("Wave", "WAVE")
    with_input(obj)
    bpy.ops.reeb_parts.decompose()
    bpy.ops.reeb_parts.separate(**KEEP)
    count = len(pieces_of())
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "pieces.blend"))
    bpy.ops.wm.open_mainfile(filepath=str(tmp_path / "pieces.blend"))
    activate(bpy.data.objects["Tree"])
    bpy.ops.reeb_parts.separate(**KEEP)
    assert len(bpy.data.collections["Parts of Tree"].objects) == len(pieces_of()) == count


def test_a_piece_that_was_decomposed_is_separated_together_with_its_original(obj):
    """Both chosen: what the original is separated into again does not take the place of the piece."""
    bpy.ops.reeb_parts.decompose()
    bpy.ops.reeb_parts.separate(**KEEP)
    mine = max(pieces_of(), key=lambda piece: len(piece.data.polygons))
    name = mine.name
    activate(mine)
    bpy.ops.reeb_parts.decompose(detail=0.9, graph=False)
    obj.select_set(True)
    bpy.ops.reeb_parts.separate(**KEEP)
    assert mine.name == name
    assert len(pieces_of()) == len(obj.data.reeb_parts.parts)
    assert len(pieces_of(name)) == len(mine.data.reeb_parts.parts) > 1

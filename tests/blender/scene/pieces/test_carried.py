# SPDX-License-Identifier: GPL-3.0-or-later
"""What faces carry goes on in the pieces, and is interpolated where smooth cuts divide faces."""

import importlib
from pathlib import Path

import bmesh
import bpy
import numpy as np
import pieces as carried
import pytest
import shapes
from bulk import read
from diagonal import some
from pieces import KEEP, WHOLE, WIDTH, caps_of, elements, pieces_of
from places import seen_points
from results import numbers as numbers_of
from scipy.spatial import cKDTree
from snapshot import activate, snapshot

SPOT = Path(__file__).resolve().parents[4] / "models" / "spot.obj"


def attributes_of(mesh):
    """Domain and values of everything that Blender keeps as an attribute, but for the topology."""
    found = {}
    for attribute in mesh.attributes:
        # Blender 5 writes the selection in the UV editor whenever a mesh comes out of BMesh.
        name = attribute.name
        if name not in (".edge_verts", ".corner_vert", ".corner_edge", "custom_normal") and ".uv_select" not in name:
            key, width = WIDTH.get(attribute.data_type, ("value", 1))
            dtype = bool if attribute.data_type == "BOOLEAN" else np.float32
            found[attribute.name] = (attribute.domain, read(attribute.data, key, dtype, width))
    return found


def test_faces_and_area_are_conserved(shape):
    bpy.ops.reeb_parts.decompose()
    assert bpy.ops.reeb_parts.separate(**KEEP, **WHOLE) == {"FINISHED"}
    numbers = numbers_of(shape.data)
    assert [len(p.data.polygons) for p in pieces_of()] == np.bincount(numbers)[1:].tolist()
    area = sum(polygon.area for piece in pieces_of() for polygon in piece.data.polygons)
    assert area == pytest.approx(sum(polygon.area for polygon in shape.data.polygons), rel=1e-5)


@pytest.mark.parametrize("caps", [False, True])
def test_all_that_the_faces_carry_is_carried_on(rich, caps):
    user = attributes_of(rich.data)
    weights = [round(v.groups[0].weight, 6) for v in rich.data.vertices]
    normals = read(rich.data.corner_normals, "vector", np.float32, 3)
    bpy.ops.reeb_parts.decompose(face_sets=True, seams=True, field=True)
    numbers = numbers_of(rich.data)
    bpy.ops.reeb_parts.separate(caps=caps, **KEEP, **WHOLE)
    fat = read(rich.data.shape_keys.key_blocks["Fat"].data, "co", np.float32, 3)
    for piece in pieces_of():
        mesh = piece.data
        here = elements(rich.data, numbers == piece["reeb_parts_number"])
        found = attributes_of(mesh)
        assert set(found) - set(user) == ({"reeb_cap"} if caps else set())
        for name, (domain, values) in user.items():
            count = len(here[domain])
            if name not in found:  # flags that are set nowhere need not be there
                assert values.dtype == bool
                assert not values[here[domain]].any()
                continue
            assert found[name][0] == domain
            assert np.array_equal(found[name][1][:count], values[here[domain]]), name
        assert [round(v.groups[0].weight, 6) for v in mesh.vertices][: len(here["POINT"])] == [
            weights[i] for i in here["POINT"]
        ]
        assert piece.vertex_groups.keys() == ["Arm"]
        assert [m.name for m in mesh.materials] == ["Red", "Green"]
        assert mesh.shape_keys.key_blocks.keys() == ["Basis", "Fat"]
        key = read(mesh.shape_keys.key_blocks["Fat"].data, "co", np.float32, 3)
        assert key[: len(here["POINT"])] == pytest.approx(fat[here["POINT"]])
        mine = read(mesh.corner_normals, "vector", np.float32, 3)[: len(here["CORNER"])]
        # Blender keeps directions as two angles of sixteen bits, rounded once more here.
        assert mine == pytest.approx(normals[here["CORNER"]], abs=5e-3)


@pytest.mark.parametrize("style", [{"cut": "FACES", "caps": False}, {}, {"seen": True}])
@pytest.mark.parametrize("kind", ["FLOAT", "FLOAT_COLOR", "FLOAT2"])
def test_a_vertex_group_may_have_the_name_of_an_attribute(obj, kind, style):
    """Blender lets it, but gives a new attribute with the name of a group another one."""
    rng = np.random.default_rng(0)
    key, width = WIDTH.get(kind, ("value", 1))
    data = obj.data.attributes.new("Mask", kind, "CORNER" if kind == "FLOAT2" else "POINT").data  # a map, or values
    data.foreach_set(key, rng.random(len(data) * width).astype(np.float32))
    group = obj.vertex_groups.new(name="Other")
    group.add(range(len(obj.data.vertices)), 0.25, "REPLACE")
    bpy.ops.reeb_parts.decompose()
    found = []
    for name in ("Other", "Mask"):
        group.name = name
        activate(obj)
        assert bpy.ops.reeb_parts.separate(**KEEP, **style) == {"FINISHED"}
        assert all(piece.vertex_groups.keys() == [name] for piece in pieces_of())
        found.append([(attributes_of(piece.data), [[(entry.group, entry.weight) for entry in vertex.groups]
                                                   for vertex in piece.data.vertices]) for piece in pieces_of()])
    for (with_other, weights), (with_mask, same_weights) in zip(*found, strict=True):
        assert weights == same_weights
        assert with_mask.keys() == with_other.keys()
        for name, (domain, values) in with_other.items():
            assert with_mask[name][0] == domain
            assert np.array_equal(with_mask[name][1], values), name


def test_without_custom_normals_none_are_made(obj):
    bpy.ops.reeb_parts.decompose()
    bpy.ops.reeb_parts.separate()
    assert not any(piece.data.has_custom_normals for piece in pieces_of())


@pytest.mark.parametrize("style", [{"cut": "FACES"}, {"caps": True}])
def test_blender_has_nothing_to_warn_of_where_there_are_shape_keys(rich, style, capfd):
    """It printed a line for each key whenever a mesh was made: thousands on a farm, of a face with all its keys."""
    bpy.ops.reeb_parts.decompose()
    capfd.readouterr()
    bpy.ops.reeb_parts.separate(**KEEP, **style)
    assert len(pieces_of()[0].data.shape_keys.key_blocks) == 2
    said = capfd.readouterr()
    assert "shape-key" not in said.out + said.err


@pytest.mark.parametrize("cut", ["SMOOTH", "FACES"])
def test_a_vertex_group_may_be_empty(obj, cut):
    obj.vertex_groups.new(name="Nobody")
    bpy.ops.reeb_parts.decompose()
    assert bpy.ops.reeb_parts.separate(cut=cut, caps=True) == {"FINISHED"}
    assert all([group.name for group in piece.vertex_groups] == ["Nobody"] for piece in pieces_of())
    assert not any(vertex.groups for piece in pieces_of() for vertex in piece.data.vertices)


def test_what_a_bmesh_says_of_its_shapes_is_written(package, rich):
    # Blender itself, in 4.2, writes one of two answers, about every third time the other one.
    module = importlib.import_module(f"{package}.scene.reading.mesh_groups")
    for _ in range(12):
        mesh = rich.data.copy()
        bm = bmesh.new()
        bm.from_mesh(mesh)
        for edge in bm.edges[:]:
            bmesh.utils.edge_split(edge, edge.verts[0], 0.37)
        said = np.array([vertex[bm.verts.layers.shape["Fat"]][:] for vertex in bm.verts], np.float32)
        module.write(bm, mesh)
        bm.free()
        assert (read(mesh.shape_keys.key_blocks["Fat"].data, "co", np.float32, 3) == said).all()
        assert (read(mesh.shape_keys.key_blocks["Basis"].data, "co", np.float32, 3)
                == read(mesh.vertices, "co", np.float32, 3)).all()


def spot():
    bpy.ops.wm.obj_import(filepath=str(SPOT))
    activate(bpy.context.selected_objects[0])


@pytest.mark.parametrize("parts", some({}, {"n_parts": 25}, {"pieces": "separate"}))
@pytest.mark.parametrize("model", ["Spot", "Suzanne", "jug"])
def test_models_in_closed_pieces_lose_nothing(model, parts, make):
    """As benchmarks/separate.py, which also does models that are not here."""
    {"Spot": spot, "Suzanne": bpy.ops.mesh.primitive_monkey_add, "jug": lambda: make(shapes.genus_two(0.09))}[model]()
    obj = bpy.context.object
    carried.furnish(obj)
    bpy.ops.reeb_parts.decompose(**parts)
    bpy.ops.reeb_parts.separate(caps=True, **KEEP, **WHOLE)
    found = carried.compare(obj, pieces_of(obj.name))
    assert found.caps > (100 if parts else 50)  # the eyes of Suzanne and their sockets are parts together
    assert (found.lost, found.new_borders, found.new_branches) == (0, 0, 0)
    assert abs(found.area) < 1e-5
    # Blender keeps directions as two angles, and takes a small one for none.
    assert found.differences.pop("normals") < 0.014
    assert max(found.differences.values()) == 0


@pytest.fixture
def linear(shape):
    """A shape whose every value is a linear function of the place, which interpolation has to leave true."""
    mesh = shape.data
    points = read(mesh.vertices, "co", np.float32, 3)
    corner = read(mesh.loops, "vertex_index", np.int32)
    mesh.uv_layers.new(name="Map").data.foreach_set("uv", points[corner, :2].ravel())
    dust = mesh.attributes.new("Dust", "FLOAT_COLOR", "POINT")
    dust.data.foreach_set("color", np.column_stack([points, np.ones(len(points))]).astype(np.float32).ravel())
    group = shape.vertex_groups.new(name="Arm")
    for index, height in enumerate(height_of(points).tolist()):
        group.add([index], height, "REPLACE")
    shape.shape_key_add(name="Basis")
    key = shape.shape_key_add(name="Fat")
    key.data.foreach_set("co", (points * np.float32(1.5)).ravel())
    return shape


def height_of(points):
    """A weight that grows with height, never 0."""
    return 0.5 + points[:, 2] / 100


@pytest.mark.parametrize("caps", some(False, True))
def test_smooth_cuts_interpolate_all_that_is_carried(linear, caps):
    bpy.ops.reeb_parts.decompose()
    before = snapshot()["meshes"]["Tree"]
    bpy.ops.reeb_parts.separate(caps=caps, **KEEP)
    assert snapshot()["meshes"]["Tree"] == before
    faces = 0
    for piece in pieces_of():
        mesh = piece.data
        cap = caps_of(mesh) == 1
        own = ~np.repeat(cap, read(mesh.polygons, "loop_total", np.int32))
        corner = read(mesh.loops, "vertex_index", np.int32)
        points = read(mesh.vertices, "co", np.float32, 3)
        used = np.unique(corner[own])
        assert read(mesh.uv_layers["Map"].data, "uv", np.float32, 2)[own] == pytest.approx(points[corner[own], :2],
                                                                                         abs=1e-4)
        dust = read(mesh.attributes["Dust"].data, "color", np.float32, 4)[used, :3]
        assert dust == pytest.approx(points[used], abs=1e-4)
        weights = np.array([v.groups[0].weight for v in mesh.vertices])
        assert weights[used] == pytest.approx(height_of(points)[used], abs=1e-5)
        fat = read(mesh.shape_keys.key_blocks["Fat"].data, "co", np.float32, 3)
        assert fat[used] == pytest.approx(1.5 * points[used], abs=1e-4)
        faces += int((~cap).sum())
    area = sum(f.area for p in pieces_of() for f, c in zip(p.data.polygons, caps_of(p.data), strict=True) if not c)
    assert area == pytest.approx(sum(polygon.area for polygon in linear.data.polygons), rel=1e-5)
    assert faces >= len(linear.data.polygons)


@pytest.mark.parametrize("style", [WHOLE, {}])
def test_what_is_rare_is_carried_too(obj, style):
    """Text, weights of 0, locked groups, the skin of a modifier, a driven shape key, the map that is rendered."""
    mesh = obj.data
    labels = mesh.attributes.new("label", "STRING", "FACE")
    for index, item in enumerate(labels.data):
        item.value = f"face {index}".encode() if isinstance(item.value, bytes) else f"face {index}"
    mesh.attributes.new("pair", "INT32_2D", "POINT").data.foreach_set("value", np.arange(2 * len(mesh.vertices)))
    for name, lock in (("Empty", True), ("Bone", False)):
        obj.vertex_groups.new(name=name).lock_weight = lock
    obj.vertex_groups["Bone"].add(range(0, len(mesh.vertices), 2), 0.0, "REPLACE")
    obj.vertex_groups["Bone"].add(range(0, len(mesh.vertices), 3), 0.25, "REPLACE")
    bpy.ops.mesh.customdata_skin_add()
    size = np.arange(2 * len(mesh.vertices), dtype=np.float32)
    mesh.skin_vertices[0].data.foreach_set("radius", size)
    for name in ("Map", "Light"):
        mesh.uv_layers.new(name=name)
    mesh.uv_layers["Light"].active_render = True
    mesh.uv_layers.active = mesh.uv_layers["Map"]
    if style != WHOLE:  # shape keys make another way of it
        obj.shape_key_add(name="Basis")
        key = obj.shape_key_add(name="Fat")
        key.vertex_group, key.slider_max = "Bone", 2.0
        key.driver_add("value").driver.expression = "0.5"
    weights = [{entry.group: entry.weight for entry in vertex.groups} for vertex in mesh.vertices]
    bpy.ops.reeb_parts.decompose()
    numbers = numbers_of(obj.data)
    bpy.ops.reeb_parts.separate(caps=False, **{**KEEP, **style})
    for piece in pieces_of():
        made = piece.data
        assert [(group.name, group.lock_weight) for group in piece.vertex_groups] == [("Empty", True), ("Bone", False)]
        assert (made.uv_layers.active.name, [layer.active_render for layer in made.uv_layers]) == ("Map", [False, True])
        known = read(made.attributes["pair"].data, "value", np.int32, 2)[:, 0] // 2
        radius = read(made.skin_vertices[0].data, "radius", np.float32, 2)
        if style == WHOLE:
            assert [item.value for item in made.attributes["label"].data] == [
                labels_of for labels_of, number in zip((i.value for i in obj.data.attributes["label"].data), numbers,
                                                       strict=True) if number == piece["reeb_parts_number"]]
            assert [{e.group: e.weight for e in v.groups} for v in made.vertices] == [weights[i] for i in known]
            np.testing.assert_array_equal(radius, size.reshape(-1, 2)[known])
        else:
            fat = made.shape_keys.key_blocks["Fat"]
            assert (fat.vertex_group, fat.slider_max, fat.relative_key.name) == ("Bone", 2.0, "Basis")
            assert made.shape_keys.animation_data.drivers[0].driver.expression == "0.5"
            assert {item.value for item in made.attributes["label"].data} <= {
                item.value for item in obj.data.attributes["label"].data}
            assert all(0 <= entry.weight <= 0.25 for vertex in made.vertices for entry in vertex.groups)


@pytest.mark.parametrize("style", some(WHOLE, {}))
def test_what_is_sculpted_with_multires_stays(make, style):
    """Its displacement can be read as no array. Away from the cuts a piece is seen where the model is."""
    obj = make(shapes.tube_tree(step=0.15))
    modifier = obj.modifiers.new("Multires", "MULTIRES")
    bpy.ops.object.multires_subdivide(modifier=modifier.name, mode="SIMPLE")
    flat = seen_points(obj)
    bumpy = obj.copy()
    bumpy.data = bpy.data.meshes.new_from_object(obj.evaluated_get(bpy.context.evaluated_depsgraph_get()))
    bumpy.modifiers.clear()
    points = read(bumpy.data.vertices, "co", np.float32, 3)
    bumpy.data.vertices.foreach_set("co", (points * (1 + 0.05 * np.sin(9 * points))).astype(np.float32).ravel())
    bpy.context.scene.collection.objects.link(bumpy)
    bumpy.select_set(True)
    bpy.ops.object.multires_reshape(modifier=modifier.name)
    bpy.data.objects.remove(bumpy)
    whole = seen_points(obj)
    assert np.median(np.linalg.norm(whole - flat, axis=1)) > 0.01
    bpy.ops.reeb_parts.decompose(n_parts=4)  # large ones, most of whose points are far from cuts
    bpy.ops.reeb_parts.separate(caps=False, modifiers=True, **{**KEEP, **style})
    for piece in pieces_of():
        bpy.context.view_layer.update()
        points = seen_points(piece)
        assert len(points) > 2 * len(piece.data.vertices)
        assert np.median(cKDTree(whole).query(points)[0]) < 1e-5


@pytest.mark.parametrize("domain", ["POINT", "EDGE", "FACE", "CORNER"])
def test_pieces_carry_matrices(obj, domain):
    """In Blender 4.2 and 4.5 this ended the program. Each is one of the object's, but for those of what is new."""
    attribute = obj.data.attributes.new("pose", "FLOAT4X4", domain)
    values = 1 + np.arange(len(attribute.data))[:, None] + np.linspace(0, 0.9375, 16, dtype=np.float32)
    attribute.data.foreach_set("value", values.astype(np.float32).ravel())
    bpy.ops.reeb_parts.decompose(n_parts=3)
    bpy.ops.reeb_parts.separate(caps=True, **KEEP)
    seen = np.zeros(len(values), bool)
    for piece in pieces_of():
        kept = piece.data.attributes["pose"]
        assert (kept.data_type, kept.domain) == ("FLOAT4X4", domain)
        found = read(kept.data, "value", width=16)
        found = found[found.any(axis=1) & (found != np.eye(4).ravel()).any(axis=1)]
        index = found[:, 0].round().astype(int) - 1
        assert np.allclose(found, values[index])
        seen[index] = True
        assert not any(name.startswith("\1") for name in piece.data.attributes.keys())
    assert seen.mean() > 0.9

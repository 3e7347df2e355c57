# SPDX-License-Identifier: GPL-3.0-or-later
"""The list: its order, what is folded in it, names that differ, and small parts merged."""

import importlib
import time

import bpy
import numpy as np
import pytest
import shapes
from mathutils import Euler, Vector


@pytest.fixture
def listed(package):
    return importlib.import_module(f"{package}.scene.result.part_list")


def order(listed, obj, by):
    """Names in the order of the list."""
    parts = obj.data.reeb_parts.parts
    places = listed.ordered(parts, by, obj.matrix_world)
    return [parts[places.index(place)].name for place in range(len(parts))]


def test_no_two_parts_have_one_name(obj, result):
    parts = result.parts
    parts[1].name = parts[2].name = parts[3].name = "Arm"
    assert [part.name for part in parts] == ["Part 01", "Arm", "Arm.001", "Arm.002", "Part 05"]
    parts[1].name = "Part 05"
    assert parts[1].name == "Part 05.001"
    parts[2].name = "Arm"  # free again
    assert parts[2].name == "Arm"
    assert sorted(group.name for group in obj.vertex_groups) == sorted(part.name for part in parts)


def test_a_name_that_a_hidden_part_would_have(result):
    result.parts[0].name = "Part 06"  # there are five
    result.n_parts = 6
    assert sorted(part.name for part in result.parts)[-3:] == ["Part 05", "Part 06", "Part 06.001"]


def test_long_names_stay_within_what_blender_keeps(result):
    for part in result.parts:
        part.name = 31 * "ä" + "x"
    assert len({part.name for part in result.parts}) == 5
    assert max(len(part.name.encode()) for part in result.parts) <= 63


def test_a_name_never_ends_within_a_letter(result):
    """Blender 4 cuts a property off in the midst of one, and nothing could read the list of parts any more."""
    result.parts[0].name = 62 * "x" + "ü"
    assert result.parts[0].name == 62 * "x"
    result.active = 1
    bpy.ops.reeb_parts.rename(new_name=61 * "y" + "漢字")
    assert result.parts[1].name == 61 * "y"


def test_orders(obj, result, listed):
    assert order(listed, obj, "NUMBER") == [f"Part 0{n}" for n in range(1, 6)]
    shares = {part.name: part.share for part in result.parts}
    assert order(listed, obj, "SIZE") == sorted(shares, key=lambda name: -shares[name])
    for part, name in zip(result.parts, ("leg 10", "Leg 9", "arm", "Body", "x"), strict=True):
        part.name = name
    assert order(listed, obj, "NAME") == ["arm", "Body", "Leg 9", "leg 10", "x"]


@pytest.mark.parametrize("turn", [(0, 0, 0), (2.0, 0.3, 1.0)])
def test_the_order_by_place_is_from_the_top_of_the_world(obj, result, listed, turn):
    obj.rotation_euler, obj.scale = Euler(turn), (1.0, 2.0, 0.5)
    bpy.context.view_layer.update()
    faces = np.zeros(len(obj.data.polygons), np.int32)
    obj.data.attributes["reeb_part"].data.foreach_get("value", faces)
    area = np.array([face.area for face in obj.data.polygons])
    center = np.array([face.center[:] for face in obj.data.polygons])
    height = {}
    for part in result.parts:
        middle = np.average(center[faces == part.number], axis=0, weights=area[faces == part.number])
        np.testing.assert_allclose(part.middle, middle, atol=1e-5)
        height[part.name] = (np.array(obj.matrix_world)[2] @ [*middle, 1.0]).item()
    assert order(listed, obj, "PLACE") == sorted(height, key=lambda name: -height[name])


@pytest.mark.parametrize("kind", ["triangles", "polygons"])
def test_middles_and_areas_of_faces_are_those_of_blender(kind, obj, package):
    if kind == "polygons":
        bpy.ops.mesh.primitive_cylinder_add(vertices=7, end_fill_type="NGON")
    mesh = bpy.context.object.data
    center, area = importlib.import_module(f"{package}.scene.reading.mesh_arrays").face_middles(mesh)
    assert center == pytest.approx(np.array([face.center[:] for face in mesh.polygons]), abs=1e-6)
    assert area == pytest.approx(np.array([face.area for face in mesh.polygons]), rel=1e-4)


def test_small_parts_of_a_long_list_are_folded(obj, result, listed):
    settings = bpy.context.scene.reeb_parts
    settings.small = 5.0
    result.n_parts = 12
    assert listed.small_parts(obj.data) == []
    result.n_parts = 30
    small = {part.number for part in result.parts if part.share < 0.05}
    assert small
    assert {part.number for part in listed.small_parts(obj.data)} == small
    assert listed.folded(obj.data) == small - {result.parts[result.active].number}
    some = next(part for part in result.parts if part.number in small)
    some.selected = True
    assert some.number not in listed.folded(obj.data)
    settings.show_small = True
    assert listed.folded(obj.data) == set()


def test_beside_a_floor_parts_are_as_small_as_without_it(make, listed):
    """All were below 1 % of a wide floor: all but that were folded, and Merge Small made one part of them."""
    tree, small = shapes.tube_tree(), []
    low = tree.vertices[:, 2].min()
    for floor in ([], [shapes.moved(shapes.box((60, 60, 1)), (-30, -30, low - 1))]):
        obj = make(shapes.together(tree, *floor))
        bpy.ops.reeb_parts.decompose(n_parts=14 + len(floor))
        assert sum(part.is_ground for part in obj.data.reeb_parts.parts) == len(floor)
        small.append(len(listed.small_parts(obj.data)))
    assert 0 < small[0] == small[1] < 14


def test_small_parts_are_merged_into_what_they_touch(obj, result):
    bpy.context.scene.reeb_parts.small = 2.0
    result.n_parts = 30
    shares = {part.number: part.share for part in result.parts}
    small = [number for number, share in shares.items() if share < 0.02]
    kept = next(part for part in result.parts if part.number == small[0])
    kept.locked = True
    bpy.ops.reeb_parts.merge_small()
    after = {part.number: part.share for part in result.parts}
    assert set(after) == set(shares) - set(small[1:])
    assert sum(after.values()) == pytest.approx(1.0)
    assert after[kept.number] == pytest.approx(shares[kept.number])
    assert all(after[number] >= shares[number] - 1e-6 for number in after)
    with pytest.raises(RuntimeError, match="no small parts"):
        bpy.ops.reeb_parts.merge_small()


def test_pieces_have_the_name_of_their_model(obj, result):
    result.parts[0].name = "Tree trunk"
    result.parts[1].name = "arm"
    bpy.ops.reeb_parts.separate()
    names = sorted(item.name for item in bpy.data.objects if "reeb_parts_number" in item)
    assert names == ["Tree Part 03", "Tree Part 04", "Tree Part 05", "Tree arm", "Tree trunk"]


def test_the_view_goes_to_a_part(obj, result):
    result.active = 2
    views = [area.spaces.active.region_3d for screen in bpy.data.screens for area in screen.areas
             if area.type == "VIEW_3D" and screen == bpy.context.window_manager.windows[0].screen]
    bpy.ops.reeb_parts.frame()
    faces = np.zeros(len(obj.data.polygons), np.int32)
    obj.data.attributes["reeb_part"].data.foreach_get("value", faces)
    vertices = {v for p in obj.data.polygons if faces[p.index] == result.parts[2].number for v in p.vertices}
    points = np.array([obj.matrix_world @ obj.data.vertices[v].co for v in vertices])
    for view in views:
        np.testing.assert_allclose(view.view_location, (points.min(0) + points.max(0)) / 2, atol=1e-5)


def test_suggested_names_are_taken_by_parts_that_have_none(obj, result):
    result.parts[1].name = "mine"
    bpy.ops.reeb_parts.suggest_names()
    names = [part.name for part in result.parts]
    assert names[1] == "mine"
    assert len(set(names)) == 5
    assert sum(name.endswith("limb") for name in names) == 3
    assert sorted(group.name for group in obj.vertex_groups) == sorted(names)
    nodes = {item.name for item in obj.children if item.get("kind") == "maximum" and not item["folded"]}
    assert "mine tip" in nodes
    # They are kept as names that were typed: through other levels of detail, and through another run.
    result.n_parts = 8
    result.n_parts = 5
    assert sorted(part.name for part in result.parts) == sorted(names)
    bpy.ops.reeb_parts.decompose()
    assert sorted(part.name for part in result.parts) == sorted(names)


def test_in_weight_paint_a_part_shows_its_group(obj, result):
    own = obj.vertex_groups.new(name="own")
    obj.vertex_groups.active_index = own.index
    result.active = 2
    assert obj.vertex_groups.active == own
    bpy.ops.object.mode_set(mode="WEIGHT_PAINT")
    result.active = 3
    assert obj.vertex_groups.active.name == result.parts[3].group
    bpy.ops.object.mode_set(mode="OBJECT")


def test_weight_paint_begins_with_the_group_of_the_active_part(obj, result):
    """It showed another one until the row that is active already was clicked."""
    assert obj.vertex_groups.active.name == result.parts[result.active].group
    result.active = 3
    bpy.ops.object.mode_set(mode="WEIGHT_PAINT")
    assert obj.vertex_groups.active.name == result.parts[3].group
    bpy.ops.object.mode_set(mode="OBJECT")
    bpy.ops.reeb_parts.split()
    assert obj.vertex_groups.active.name == result.parts[result.active].group


def test_names_are_suggested_for_all_selected_models(obj, result, make, tree):
    other = make(tree, "Other")
    bpy.ops.reeb_parts.decompose(n_parts=5)
    obj.select_set(True)
    assert bpy.ops.reeb_parts.suggest_names() == {"FINISHED"}
    for item in (obj, other):
        assert sum(part.name.endswith("limb") for part in item.data.reeb_parts.parts) == 4


@pytest.mark.parametrize("seed", range(8))
def test_names_given_at_once_are_those_given_one_by_one(make, package, seed):
    """Names that others have, or had a moment ago, with and without numbers, long ones, and the parts' own."""
    part_names = importlib.import_module(f"{package}.scene.result.part_names")
    reactions = importlib.import_module(f"{package}.scene.changes.reactions")
    found = []
    for at_once in (False, True):
        obj = make(shapes.tube_tree())
        bpy.ops.reeb_parts.decompose(detail=1.0, graph=False)
        mesh, draw = obj.data, np.random.default_rng(seed)
        words = ["leg", "leg.001", "leg.002", "leg.001.001", "x" * 63, "x" * 59 + ".001", "Part 02", "Part 03"]
        for _ in range(4):
            names = {part.number: str(draw.choice(words)) for part in mesh.reeb_parts.parts if draw.random() < 0.8}
            if at_once:
                reactions.give_names(mesh, names)
                continue
            quiet = importlib.import_module(f"{package}.scene.property_updates")
            with quiet.quiet():
                for part in mesh.reeb_parts.parts:
                    if part.number in names:
                        part.name = part_names.free_name(mesh, part.number, names[part.number])
                        part_names.keep_name(mesh, part.number, part.name)
        found.append(([part.name for part in mesh.reeb_parts.parts], part_names.kept_names(mesh)))
        assert [part_names.part_name(mesh, part.number) for part in mesh.reeb_parts.parts] == list(
            part_names.all_names(mesh).values())
    assert found[0] == found[1]


@pytest.mark.parametrize("by", ["NUMBER", "SIZE", "NAME", "PLACE"])
def test_the_order_of_a_long_list_is_that_of_its_keys_and_costs_a_redraw_little(obj, listed, by):
    bpy.ops.reeb_parts.decompose(detail=1.0, graph=False)
    parts, rng = obj.data.reeb_parts.parts, np.random.default_rng(3)
    while len(parts) < 1500:
        parts.add()
    with listed.property_updates.quiet():
        for index, part in enumerate(parts):
            part.name, part.share = f"Part {rng.integers(400)} {index % 3}", float(rng.integers(40)) / 40
            part.middle = rng.integers(-9, 9, 3).astype(float).tolist()
    obj.rotation_euler, obj.location = (0.3, 0.2, 0.1), (1, 2, 3)
    bpy.context.view_layer.update()
    keys = {"NUMBER": lambda index: index, "SIZE": lambda index: -parts[index].share,
            "NAME": lambda index: [int(word) if word.isdecimal() else word for word in parts[index].name.split()],
            "PLACE": lambda index: -(obj.matrix_world @ Vector(parts[index].middle)).z}
    wanted = sorted(range(1500), key=keys[by])
    times = []
    for _ in range(5):
        start = time.perf_counter()
        found = listed.ordered(parts, by, obj.matrix_world)
        times.append(time.perf_counter() - start)
    assert [found[index] for index in wanted] == list(range(1500))
    assert min(times) < 0.005


def test_to_suggest_names_again_says_that_all_are_named(obj, capfd):
    bpy.ops.reeb_parts.decompose()
    count = len(obj.data.reeb_parts.parts)
    bpy.ops.reeb_parts.suggest_names()
    assert f"{count} parts are named" in capfd.readouterr().out
    bpy.ops.reeb_parts.suggest_names()
    assert f"All named already: {count} parts" in capfd.readouterr().out

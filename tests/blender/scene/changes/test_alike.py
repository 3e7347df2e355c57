# SPDX-License-Identifier: GPL-3.0-or-later
"""Similar parts are found on all objects, and names go to the same parts of a model in another pose."""

import bpy
import numpy as np
import pytest
import shapes
from snapshot import activate


@pytest.fixture
def figures(make):
    """A figure with parts that are named, and the same bent, finer and in another order; both selected."""
    shape = shapes.mirrored_figure(0.15)
    first = make(shape, "First")
    bpy.ops.reeb_parts.decompose()
    finer = shapes.subdivide(shape)
    turn = np.radians(40) * finer.vertices[:, 1] / np.ptp(finer.vertices[:, 1])
    radius = np.ptp(finer.vertices[:, 1]) / np.radians(40)
    points = np.stack([finer.vertices[:, 0], (radius + finer.vertices[:, 2]) * np.sin(turn),
                       (radius + finer.vertices[:, 2]) * np.cos(turn) - radius], axis=1)
    second = make(shapes.shuffled(shapes.Shape(points, finer.faces), np.random.default_rng(0))[0], "Second")
    bpy.ops.reeb_parts.decompose()
    activate(first)
    second.select_set(True)
    return first, second


def middles(obj):
    """Middle of the faces of each part, by number."""
    numbers = np.zeros(len(obj.data.polygons), np.int32)
    obj.data.attributes["reeb_part"].data.foreach_get("value", numbers)
    centers = np.array([polygon.center[:] for polygon in obj.data.polygons])
    return {number: centers[numbers == number].mean(axis=0) for number in set(numbers.tolist())}


def marked(obj):
    return {part.number for part in obj.data.reeb_parts.parts if part.selected}


def test_that_no_part_is_like_another_is_said(make, capfd):
    make(shapes.dumbbell(24, 10))
    bpy.ops.reeb_parts.decompose(n_parts=1)
    bpy.ops.reeb_parts.find_similar()
    assert "No other part is like Part 01; a larger difference finds more" in capfd.readouterr().out


def test_parts_of_a_model_that_was_moved_are_found(make):
    """Once its scale was applied, its parts were left out until something else was done with it."""
    other = make(shapes.dumbbell(24, 10), "Other")
    bpy.ops.reeb_parts.decompose(n_parts=2)
    other.scale = (2.0, 2.0, 2.0)
    bpy.ops.object.transform_apply()
    obj = make(shapes.dumbbell(24, 10), "One")
    bpy.ops.reeb_parts.decompose(n_parts=2)
    bpy.ops.reeb_parts.find_similar()
    assert (len(marked(obj)), len(marked(other))) == (2, 2)


def test_names_go_to_the_same_parts_in_another_pose_left_and_right(figures):
    first, second = figures
    for index, part in enumerate(first.data.reeb_parts.parts):
        part.name = f"Own {index}"
    names = {part.name: middles(first)[part.number] for part in first.data.reeb_parts.parts}
    assert bpy.ops.reeb_parts.names_from_active() == {"FINISHED"}
    assert len(second.data.reeb_parts.parts) == len(first.data.reeb_parts.parts)
    places = middles(second)
    for part in second.data.reeb_parts.parts:
        distance = {name: np.linalg.norm(middle - places[part.number]) for name, middle in names.items()}
        assert part.name == min(distance, key=distance.get)
        assert part.name in second.vertex_groups
    assert {part.name for part in first.data.reeb_parts.parts} == set(names)


def test_of_the_same_mesh_every_face_keeps_its_name_and_parts_without_a_name_keep_theirs(figures):
    first, second = figures
    copy = first.copy()
    copy.data = first.data.copy()
    bpy.context.scene.collection.objects.link(copy)
    second.select_set(False)
    copy.select_set(True)
    before = [part.name for part in copy.data.reeb_parts.parts]
    first.data.reeb_parts.parts[2].name = "Named"
    given = [part.name for part in first.data.reeb_parts.parts]
    bpy.ops.reeb_parts.names_from_active()
    assert [part.name for part in copy.data.reeb_parts.parts] == given
    assert sum(a != b for a, b in zip(before, given, strict=True)) in (1, 2)  # with its mirror image


@pytest.mark.parametrize("from_triangles", [False, True])
def test_a_model_and_its_triangles_give_each_other_names(make, from_triangles):
    """Those triangles are the model's, but they are more than its faces: that was a traceback."""
    vertices, quads = shapes.table_of_blocks()
    one = make((vertices, quads), "Quads")
    one.data.calc_loop_triangles()
    other = make((vertices, [triangle.vertices[:] for triangle in one.data.loop_triangles]), "Triangles")
    if from_triangles:
        one, other = other, one
    for obj in (other, one):
        activate(obj)
        bpy.ops.reeb_parts.decompose()
    for part in one.data.reeb_parts.parts:
        part.name = f"Own {part.number}"
    other.select_set(True)
    assert bpy.ops.reeb_parts.names_from_active() == {"FINISHED"}
    places = middles(one)
    for part, middle in ((part, middles(other)[part.number]) for part in other.data.reeb_parts.parts):
        nearest = min(places, key=lambda number: np.linalg.norm(places[number] - middle))
        assert part.name == f"Own {nearest}"


def test_several_parts_that_come_from_one_get_names_that_differ(figures):
    first, second = figures
    first.data.reeb_parts.n_parts = 1
    first.data.reeb_parts.parts[0].name = "Whole"
    bpy.ops.reeb_parts.names_from_active()
    names = [part.name for part in second.data.reeb_parts.parts]
    assert len(set(names)) == len(names)
    assert {name.partition(".")[0] for name in names} == {"Whole"}
    assert "Whole" in names


def pairs(mesh):
    """Names of the parts that are mirror images, left and right."""
    names = {part.own_name: part.name for part in mesh.reeb_parts.parts}
    return [(name, names[f"{own[:-1]}R"]) for own, name in names.items() if own.endswith(".L")]


def check_images(mesh):
    """No two parts have one name, and those of mirror images are mirror images, with one number behind them at most."""
    names = [part.name for part in mesh.reeb_parts.parts]
    assert len(set(names)) == len(names)
    assert not any(name.count(".0") > 1 for name in names)
    assert pairs(mesh)
    for left, right in pairs(mesh):
        assert left != right == bpy.utils.flip_name(left)


@pytest.mark.parametrize("name", ["Whole.001", "Back.L.001"])
def test_images_that_come_from_one_part_get_names_that_are_images(figures, name):
    """Each was named alone: the surest of several got the plain name, the others Back.L.001.001 and so on."""
    first, second = figures
    second.select_set(False)
    first.data.reeb_parts.n_parts = 1
    first.data.reeb_parts.parts[0].name = name
    second.select_set(True)
    bpy.ops.reeb_parts.names_from_active()
    check_images(second.data)


def test_a_part_in_the_middle_has_no_side(make):
    """It was called as the left or the right one of the parts that it comes from, and so was its bone."""
    z, y, x = np.array(shapes.dumbbell(24, 10).vertices).T
    y = y + 0.1 * x * x  # bent and slanted, so that there is one plane
    shape = shapes.Shape(np.stack([x, y, z + 0.5 * y], axis=1), shapes.dumbbell(24, 10).faces)
    for name, count in (("First", 3), ("Second", 1)):
        make(shape, name)
        bpy.ops.reeb_parts.decompose(n_parts=count)
    first, second = (bpy.data.objects[name] for name in ("First", "Second"))
    left = next(part for part in first.data.reeb_parts.parts if part.own_name.endswith(".L"))
    left.name = "Ball.L"
    activate(first)
    second.select_set(True)
    bpy.ops.reeb_parts.names_from_active()
    assert [part.name for part in second.data.reeb_parts.parts] == ["Ball"]


def test_images_get_one_number_where_those_of_the_source_have_two(figures):
    first, second = figures
    bpy.context.scene.reeb_parts.symmetry = False
    crossed = {".L": iter(("Leg.L", "Leg.L.001", "Leg.L.002")), ".R": iter(("Leg.R.002", "Leg.R.001", "Leg.R"))}
    for part in first.data.reeb_parts.parts:
        if part.own_name[-2:] in crossed:
            part.name = next(crossed[part.own_name[-2:]])
    bpy.ops.reeb_parts.names_from_active()
    check_images(second.data)


def test_mirror_images_that_the_user_has_given_two_names_keep_them(figures):
    first, second = figures
    given = {part.name: f"Own {index}" for index, part in enumerate(first.data.reeb_parts.parts)}
    for part in first.data.reeb_parts.parts:
        part.name = given[part.name]
    bpy.ops.reeb_parts.names_from_active()
    assert sorted(pairs(second.data)) == sorted(pairs(first.data))


def test_a_name_that_leaves_no_room_for_a_number_and_a_side_is_given_all_the_same(figures):
    first, second = figures
    second.select_set(False)
    first.data.reeb_parts.n_parts = 1
    second.select_set(True)
    first.data.reeb_parts.parts[0].name = 61 * "x" + ".L"
    bpy.ops.reeb_parts.names_from_active()
    names = [part.name for part in second.data.reeb_parts.parts]
    assert len(set(names)) == len(names)
    assert all(name.startswith(59 * "x") for name in names)


@pytest.mark.parametrize(("prepare", "words"), [
    (lambda first, second: None, "No part of First has a name of its own"),
    (lambda first, second: (setattr(first.data.reeb_parts.parts[0], "name", "Body"), second.select_set(False)),
     "Select other decomposed objects"),
], ids=["no names", "no others"])
def test_what_is_missing_is_said(figures, prepare, words):
    prepare(*figures)
    with pytest.raises(RuntimeError, match=words):
        bpy.ops.reeb_parts.names_from_active()


def test_similar_parts_are_marked_on_all_objects(figures):
    first, second = figures
    parts = first.data.reeb_parts.parts
    twins = {part.number: next((other.number for other in parts if other.own_name != part.own_name
                                and bpy.utils.flip_name(other.own_name) == part.own_name), None) for part in parts}
    index = next(index for index, part in enumerate(parts) if twins[part.number])
    first.data.reeb_parts.active = index
    number = parts[index].number
    bpy.ops.reeb_parts.find_similar(limit=0.0)
    assert marked(first) == {number}
    assert marked(second) == set()
    # The legs of the second end lower at the hips: they have a third less area.
    bpy.ops.reeb_parts.find_similar(limit=0.6)
    assert {number, twins[number]} <= marked(first)
    left, right = (part.own_name for part in second.data.reeb_parts.parts if part.selected)
    assert left != right == bpy.utils.flip_name(left)  # both legs, and nothing else
    assert parts[first.data.reeb_parts.active].number == number
    bpy.ops.reeb_parts.find_similar(limit=1000.0)
    assert (len(marked(first)), len(marked(second))) == (len(parts), len(second.data.reeb_parts.parts))

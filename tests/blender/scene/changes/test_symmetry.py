# SPDX-License-Identifier: GPL-3.0-or-later
"""Symmetry: names of mirror images, and changes by hand on both sides."""

from contextlib import suppress
from pathlib import Path

import bpy
import numpy as np
import pytest
import shapes
from results import numbers as face_numbers

SPOT = Path(__file__).resolve().parents[4] / "models" / "spot.obj"


@pytest.fixture
def mesh(make):
    obj = make(shapes.mirrored_figure(), "Figure")
    bpy.ops.reeb_parts.decompose()
    return obj.data


def image(mesh):
    """Mirror image of each face."""
    center = np.array([polygon.center for polygon in mesh.polygons])
    apart = np.linalg.norm(center[:, None] * (-1, 1, 1) - center, axis=2)
    return apart.argmin(axis=1)


def paired(mesh):
    """The face numbers are the same on both sides but for the names of twins."""
    numbers, other = face_numbers(mesh), face_numbers(mesh)[image(mesh)]
    return len(set(zip(numbers.tolist(), other.tolist(), strict=True))) == len(set(numbers.tolist()))


def of_both_sides(mesh):
    """Each part has as many faces as the one called like it with the other side has there, or lies across the plane."""
    left = np.array([polygon.center[0] for polygon in mesh.polygons]) > 0
    count = {entry.own_name: np.bincount(left[face_numbers(mesh) == entry.number], minlength=2).tolist()
             for entry in mesh.reeb_parts.parts}
    return all(count.get(bpy.utils.flip_name(name)) == faces[::-1] for name, faces in count.items())


def part(mesh, ending):
    return next(entry for entry in mesh.reeb_parts.parts if entry.name.endswith(ending))


def part_named(mesh, name):
    return next(entry for entry in mesh.reeb_parts.parts if entry.name == name)


def pinned(mesh):
    return {entry.number for entry in mesh.reeb_parts.parts if entry.pinned}


def choose(mesh, *parts):
    numbers = [entry.number for entry in parts]
    mesh.reeb_parts.active = [entry.number for entry in mesh.reeb_parts.parts].index(numbers[0])
    for entry in mesh.reeb_parts.parts:  # after that, as a click in the list takes marks away
        entry.selected = entry.number in numbers


def test_images_have_one_number_and_a_side(mesh):
    names = [entry.name for entry in mesh.reeb_parts.parts]
    left = [name for name in names if name.endswith(".L")]
    assert left
    assert sorted(name[:-1] + "R" for name in left) == sorted(name for name in names if name.endswith(".R"))
    assert len(set(names)) == len(names)
    for name in left:
        vertex = next(entry for entry in mesh.reeb_parts.parts if entry.name == name)
        center = np.array([polygon.center for polygon in mesh.polygons])[face_numbers(mesh) == vertex.number]
        assert center[:, 0].mean() > 0


@pytest.mark.parametrize("direction", ["NEGATIVE_X", "POSITIVE_X"])
def test_parts_stay_on_their_sides_after_symmetrize(mesh, direction):
    """It copies numbers, too: names of the left went to the right, and pinned parts had faces on both sides."""
    choose(mesh, part(mesh, ".L"))
    bpy.ops.reeb_parts.grow(rings=1)
    part(mesh, ".L").name = "Arm.L"
    part_named(mesh, "Arm.L").color = (1.0, 0.0, 0.0)
    before = {entry.name: (entry.number, entry.pinned, tuple(entry.color)) for entry in mesh.reeb_parts.parts}
    assert before["Arm.L"][1]
    assert before["Arm.R"][1]
    mesh.vertices[0].co.x *= 1.001  # an edit, in any case
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.ops.mesh.select_all(action="SELECT")
    bpy.ops.mesh.symmetrize(direction=direction)
    bpy.ops.object.mode_set(mode="OBJECT")
    bpy.ops.reeb_parts.decompose()
    assert {entry.name: (entry.number, entry.pinned, tuple(entry.color)) for entry in mesh.reeb_parts.parts} == before
    for entry in mesh.reeb_parts.parts:
        side = {"L": 1.0, "R": -1.0}.get(entry.name[-1], 0.0)
        assert np.sign(np.round(entry.middle[0], 3)) == side


def test_groups_and_materials_have_the_names_in_the_list_whatever_the_detail(make):
    """A part that has an image at one detail, and none at another, kept the group and material of its former name."""
    obj = make(shapes.mirrored_figure(), "Figure")
    bpy.ops.reeb_parts.decompose(materials=True)
    result = obj.data.reeb_parts
    next(entry for entry in result.parts if entry.name.endswith(".L")).name = "Arm.L"
    names = {}
    for count in (*range(1, 12), *range(12, 0, -1)):
        result.n_parts = count
        assert [entry.group for entry in result.parts] == [entry.name for entry in result.parts]
        assert [entry.material.name for entry in result.parts] == [entry.name for entry in result.parts]
        assert sorted(obj.vertex_groups.keys()) == sorted(entry.name for entry in result.parts)
        for entry in result.parts:
            names.setdefault(entry.number, set()).add(entry.name)
    assert any(len(found) > 1 for found in names.values())


def test_a_group_and_a_material_of_the_users_keep_their_names_when_parts_change_theirs(make):
    obj = make(shapes.mirrored_figure(), "Figure")
    bpy.ops.reeb_parts.decompose(materials=True, n_parts=1)
    result = obj.data.reeb_parts
    result.n_parts = 2
    number, plain = result.parts[1].number, result.parts[1].name
    obj.vertex_groups.new(name=f"{plain}.L")
    result.parts[1].material.name = "Bark"
    result.n_parts = 6
    (found,) = [entry for entry in result.parts if entry.number == number]
    assert (found.name, found.group, found.material.name) == (f"{plain}.L", f"{plain}.L.001", "Bark")
    kept = next(group for group in obj.vertex_groups if group.name == f"{plain}.L")
    assert not any(entry.group == kept.index for vertex in obj.data.vertices for entry in vertex.groups)


def test_a_name_with_a_side_is_given_to_the_image_too(mesh):
    left, right = part(mesh, ".L"), part(mesh, ".L").name[:-1] + "R"
    right = next(entry for entry in mesh.reeb_parts.parts if entry.name == right)
    left.name = "Arm.L"
    assert right.name == "Arm.R"
    right.name = "Hook"
    left.name = "Wing.L"
    assert right.name == "Hook"


def test_both_sides_are_released(mesh):
    """Of a limb that was grown, and its image with it, only the one that was chosen followed the detail again."""
    left = part(mesh, ".L")
    number, image = left.number, part_named(mesh, bpy.utils.flip_name(left.name)).number
    choose(mesh, left)
    before = face_numbers(mesh)
    bpy.ops.reeb_parts.grow()
    assert {number, image} <= pinned(mesh)
    choose(mesh, part(mesh, ".L"))
    others = pinned(mesh) - {number, image}
    part_named(mesh, part(mesh, ".R").name).locked = True
    bpy.ops.reeb_parts.release()
    assert pinned(mesh) == others | {image}
    part_named(mesh, part(mesh, ".R").name).locked = False
    bpy.ops.reeb_parts.release()
    assert pinned(mesh) == others
    assert paired(mesh)
    bpy.ops.reeb_parts.release(everything=True)
    assert (face_numbers(mesh) == before).all()


def test_a_name_that_is_corrected_is_corrected_on_both_sides(mesh):
    """Once names were suggested, or one was typed before, the image kept what it was called."""
    bpy.ops.reeb_parts.suggest_names()
    left = part(mesh, ".L")
    right = part_named(mesh, bpy.utils.flip_name(left.name))
    right.color = (1.0, 0.5, 0.25)
    for name in ("Wing", "Fin", "Arm"):
        left.name = f"{name}.L"
        assert right.name == f"{name}.R"
    mesh.reeb_parts.active = list(mesh.reeb_parts.parts).index(left)
    bpy.ops.reeb_parts.rename(new_name="Shield arm.L")
    assert right.name == "Shield arm.R"
    right.name = "Sword arm.R"
    assert left.name == "Shield arm.L"
    left.name = "Arm.L"
    assert right.name == "Sword arm.R"


@pytest.mark.parametrize("edit", ["split", "grow", "shrink", "merge_neighbour"])
def test_both_sides_change(mesh, edit):
    """An arm: legs meet at the plane, and where the image of a change meets the change itself all is as asked."""
    before = face_numbers(mesh)
    choose(mesh, min((entry for entry in mesh.reeb_parts.parts if entry.name.endswith(".L")),
                     key=lambda entry: entry.share))
    assert getattr(bpy.ops.reeb_parts, edit)() == {"FINISHED"}
    after = face_numbers(mesh)
    assert (after != before).any()
    assert paired(mesh)


@pytest.mark.parametrize("edit", ["split", "grow", "shrink", "merge_neighbour"])
def test_both_sides_of_a_posed_figure_change(make, edit):
    """No plane mirrors it; sides are those of the figure as it stood."""
    vertices, faces = shapes.mirrored_figure()
    center = vertices[faces].mean(axis=1)
    twin = np.linalg.norm(center[:, None] * (-1, 1, 1) - center, axis=2).argmin(axis=1)
    mesh = make(shapes.Shape(shapes.posed(vertices), faces), "Figure").data
    bpy.ops.reeb_parts.decompose()
    left = part(mesh, ".L")
    assert center[face_numbers(mesh) == left.number, 0].mean() > 0
    assert any(entry.name == left.name[:-1] + "R" for entry in mesh.reeb_parts.parts)
    before = face_numbers(mesh)
    choose(mesh, left)
    assert getattr(bpy.ops.reeb_parts, edit)() == {"FINISHED"}
    after = face_numbers(mesh)
    assert (after != before).any()
    assert len(set(zip(after.tolist(), after[twin].tolist(), strict=True))) == len(set(after.tolist()))


@pytest.mark.parametrize("locked", [False, True])
def test_a_part_across_the_plane_is_merged_with_both_sides(mesh, locked):
    """It went to the side that was marked, and left the other one alone."""
    left, middle = part(mesh, ".L"), max(mesh.reeb_parts.parts, key=lambda entry: entry.share)
    right = part_named(mesh, left.name[:-1] + "R")
    right.locked = locked
    number, before = left.number, face_numbers(mesh)
    wanted = np.isin(before, [number, middle.number] if locked else [number, middle.number, right.number])
    choose(mesh, left, middle)
    assert bpy.ops.reeb_parts.merge() == {"FINISHED"}
    assert np.array_equal(face_numbers(mesh) == number, wanted)
    assert paired(mesh) != locked


def test_a_part_across_the_plane_takes_neighbors_on_both_sides():
    """It went to one of two mirror images, and was called as this: the head of spot, whose weakest cut is an ear's."""
    bpy.ops.wm.obj_import(filepath=str(SPOT))
    mesh = bpy.context.object.data
    bpy.ops.reeb_parts.decompose()
    bpy.ops.reeb_parts.suggest_names()
    number = {entry.name: entry.number for entry in mesh.reeb_parts.parts}
    wanted = np.isin(face_numbers(mesh), [number[name] for name in ("head", "ear.L", "ear.R")])
    choose(mesh, part_named(mesh, "head"))
    assert bpy.ops.reeb_parts.merge_neighbour() == {"FINISHED"}
    assert np.array_equal(face_numbers(mesh) == number["head"], wanted)


@pytest.mark.parametrize("locked", [False, True])
def test_small_parts_are_merged_on_both_sides(locked):
    """What lay across the plane went to one side, and images to neighbors that were no images."""
    bpy.ops.wm.obj_import(filepath=str(SPOT))
    mesh = bpy.context.object.data
    bpy.ops.reeb_parts.decompose(detail=1.0)
    assert of_both_sides(mesh)
    tiny, before = min(mesh.reeb_parts.parts, key=lambda entry: entry.share), face_numbers(mesh)
    number, tiny.locked, count = tiny.number, locked, len(mesh.reeb_parts.parts)
    assert bpy.ops.reeb_parts.merge_small() == {"FINISHED"}
    assert len(mesh.reeb_parts.parts) < 0.5 * count
    assert of_both_sides(mesh) != locked
    assert np.array_equal(face_numbers(mesh) == number, before == number) == locked


def test_two_images_marked_are_split_once(mesh):
    count = len(mesh.reeb_parts.parts)
    left = part(mesh, ".L")
    right = next(entry for entry in mesh.reeb_parts.parts if entry.name == left.name[:-1] + "R")
    choose(mesh, left, right)
    bpy.ops.reeb_parts.split()
    assert len(mesh.reeb_parts.parts) == count + 2
    assert paired(mesh)


def test_without_symmetry_one_side_changes(mesh):
    bpy.context.scene.reeb_parts.symmetry = False
    count = len(mesh.reeb_parts.parts)
    choose(mesh, part(mesh, ".L"))
    bpy.ops.reeb_parts.split()
    assert len(mesh.reeb_parts.parts) == count + 1


def test_a_locked_image_stays(mesh):
    left = part(mesh, ".L")
    right = next(entry for entry in mesh.reeb_parts.parts if entry.name == left.name[:-1] + "R")
    right.locked = True
    number, count = right.number, len(mesh.reeb_parts.parts)
    before = face_numbers(mesh) == number
    choose(mesh, left)
    bpy.ops.reeb_parts.split()
    assert len(mesh.reeb_parts.parts) == count + 1
    assert np.array_equal(face_numbers(mesh) == number, before)


def test_faces_assigned_are_assigned_on_both_sides(mesh):
    for polygon in mesh.polygons:
        polygon.select = polygon.center.x > 1.0
    assert bpy.ops.reeb_parts.assign(new=True) == {"FINISHED"}
    assert paired(mesh)
    center = np.array([polygon.center for polygon in mesh.polygons])
    assert len(set(face_numbers(mesh)[center[:, 0] > 1.0])) == 1
    assert len(set(face_numbers(mesh)[center[:, 0] < -1.0])) == 1


@pytest.mark.parametrize("name", [".L", ".R"])
def test_parts_that_grow_stay_on_their_side(name):
    """Nor do a part and its image change sides, which touch or nearly so at the plane."""
    bpy.ops.wm.obj_import(filepath=str(SPOT))
    mesh = bpy.context.object.data
    bpy.ops.reeb_parts.decompose()
    done, left = 0, np.array([polygon.center[0] for polygon in mesh.polygons]) > 0
    for entry in [entry for entry in mesh.reeb_parts.parts if entry.name.endswith(name)]:
        number = entry.number
        beside = (face_numbers(mesh) == number) @ np.where(left, 1, -1)
        for action in ("grow", "grow", "shrink", "grow", "shrink", "shrink"):
            listed = {entry.number: entry for entry in mesh.reeb_parts.parts}
            choose(mesh, listed[number])
            with suppress(RuntimeError):  # there is nothing more to take, or to give
                done += getattr(bpy.ops.reeb_parts, action)() == {"FINISHED"}
            now = face_numbers(mesh) == number
            assert abs(now @ np.where(left, 1, -1)) >= 0.8 * now.sum()
            assert (now @ np.where(left, 1, -1)) * beside > 0
    assert done > 6


@pytest.mark.parametrize(("place", "rings", "more"), [(3, 4, 0), (4, 4, 1), (4, -2, 0)])
def test_neighbors_do_not_crumble(make, capfd, place, rings, more):
    """Each piece that was cut off from a neighbor became a pinned part, down to 0.04 % of the surface, and nothing was
    said. What stays apart, as too large to be taken along, is named.
    """
    mesh = make(shapes.mirrored_figure(0.25), "Figure").data
    bpy.ops.reeb_parts.decompose()
    result = mesh.reeb_parts
    before, count, numbers = face_numbers(mesh), len(result.parts), {entry.number for entry in result.parts}
    choose(mesh, result.parts[place])
    capfd.readouterr()
    bpy.ops.reeb_parts.grow(rings=rings)
    said = capfd.readouterr().out
    assert (face_numbers(mesh) != before).any()
    assert len(result.parts) == count + more
    assert paired(mesh)
    made = [entry.name for entry in result.parts if entry.number not in numbers]
    assert ("what is left of" in said) == bool(made)
    assert not made or f"is in {len(made)} part more: {', '.join(made)}" in said


@pytest.mark.parametrize("action", ["grow", "slide"])
def test_what_grows_beyond_the_plane_leaves_the_other_half_to_its_image(make, action):
    """The part had both halves of the trunk and its image nothing, so that neither was of a side any more."""
    mesh = make(shapes.mirrored_figure(0.25), "Figure").data
    bpy.ops.reeb_parts.decompose()
    names = {entry.name for entry in mesh.reeb_parts.parts}
    choose(mesh, part_named(mesh, "Part 02.R"))
    bpy.ops.reeb_parts.grow(rings=8) if action == "grow" else bpy.ops.reeb_parts.slide(offset=2.0)
    assert {entry.name for entry in mesh.reeb_parts.parts} == names - {"Part 05"}  # of which nothing is left
    assert paired(mesh)
    assert of_both_sides(mesh)


def test_what_grows_beyond_the_plane_stays_where_its_image_is_locked(make):
    mesh = make(shapes.mirrored_figure(0.25), "Figure").data
    bpy.ops.reeb_parts.decompose()
    image, trunk = part_named(mesh, "Part 02.L"), part_named(mesh, "Part 05").number
    image.locked, before, number = True, face_numbers(mesh), image.number
    choose(mesh, part_named(mesh, "Part 02.R"))
    bpy.ops.reeb_parts.grow(rings=8)
    assert np.array_equal(face_numbers(mesh) == number, before == number)
    assert trunk not in face_numbers(mesh)


def test_grow_to_the_next_crease_takes_crumbs_along(make):
    """The next candidate cut a neighbor in pieces as small as can be."""
    mesh = make(shapes.insect(0.15), "Insect").data
    bpy.ops.reeb_parts.decompose()
    result = mesh.reeb_parts
    numbers = {entry.number for entry in result.parts}
    choose(mesh, result.parts[5])
    bpy.ops.reeb_parts.shrink()
    assert {entry.number for entry in result.parts} == numbers


def in_pieces(mesh):
    """Numbers of the parts that do not hang together."""
    numbers, label = face_numbers(mesh), np.arange(len(mesh.polygons))
    vertices = np.array([polygon.vertices for polygon in mesh.polygons])
    touching = [np.flatnonzero(np.isin(vertices, corners).sum(axis=1) == 2) for corners in vertices]
    pairs = np.array([(face, other) for face, others in enumerate(touching) for other in others])
    first, second = pairs[numbers[pairs[:, 0]] == numbers[pairs[:, 1]]].T
    for _ in label:
        before = label.copy()
        np.minimum.at(label, first, label[second])
        if np.array_equal(label, before):
            break
    return [number for number in np.unique(numbers) if len(set(label[numbers == number])) > 1]


@pytest.mark.parametrize("count", [6, 12])
def test_what_grows_on_both_sides_leaves_no_part_in_pieces(make, count):
    """A part and its image cut off together what neither does alone: of most parts some faces lay apart."""
    mesh = make(shapes.torus(), "Ring").data
    bpy.ops.reeb_parts.decompose(n_parts=count)
    for place in range(count):
        choose(mesh, mesh.reeb_parts.parts[min(place, len(mesh.reeb_parts.parts) - 1)])
        with suppress(RuntimeError):
            bpy.ops.reeb_parts.grow()
    assert not in_pieces(mesh)


def test_the_report_of_paint_does_not_count_the_mirror_image_as_what_is_left(mesh, capfd):
    """A dab on one of two limbs, into the other: a part of its own on each side, and nothing else."""
    bpy.context.scene.reeb_parts.symmetry = True
    left, right = part(mesh, ".L"), part(mesh, ".R")
    choose(mesh, left)
    faces = np.flatnonzero(face_numbers(mesh) == right.number)
    center = np.array([polygon.center for polygon in mesh.polygons])
    tip = faces[np.linalg.norm(center[faces], axis=1).argmax()]
    name, count = right.name, len(mesh.reeb_parts.parts)
    capfd.readouterr()
    bpy.ops.reeb_parts.paint(stroke=[{"name": "", "location": center[tip], "radius": 1e-4}])
    said = capfd.readouterr().out
    assert len(mesh.reeb_parts.parts) == count + 2
    assert f"1 face of {name} does not touch" in said
    assert "what is left" not in said
    assert "0 faces" not in said


@pytest.mark.parametrize("in_pose", [False, True])
def test_suggested_names_of_images_are_images(make, in_pose):
    """Each part was named alone, and of equal names each got the next number, whatever its image has."""
    vertices, faces = shapes.mirrored_figure()
    obj = make(shapes.Shape(shapes.posed(vertices) if in_pose else vertices, faces), "Figure")
    bpy.ops.reeb_parts.decompose()
    for count in (12, 20, 35):
        obj.data.reeb_parts.n_parts = count
        parts = obj.data.reeb_parts.parts
        own = {entry.number: entry.own_name for entry in parts}
        numbers = {name: number for number, name in own.items()}
        parts[0].name = "piece.L.001"  # of which one side is taken
        bpy.ops.reeb_parts.suggest_names()
        names = {entry.number: entry.name for entry in parts}
        assert len(set(names.values())) == len(names)
        images = {number: numbers.get(bpy.utils.flip_name(name), number) for number, name in own.items()}
        paired = [number for number in images if len({number, images[number]} - {parts[0].number}) == 2]
        assert len(paired) > 4
        for number in paired:
            assert names[number] == bpy.utils.flip_name(names[images[number]]) != names[images[number]]

# SPDX-License-Identifier: GPL-3.0-or-later
"""Half models: the first modifier mirrors them, and their parts are those of the whole."""

import importlib

import bpy
import numpy as np
import pytest
import shapes
from mathutils import Matrix
from results import numbers as face_numbers


@pytest.fixture
def half():
    return shapes.half_of(shapes.mirrored_figure())


@pytest.fixture
def plane_of(package):
    bridge = importlib.import_module(f"{package}.scene.bridge")

    def read(obj):
        bpy.context.view_layer.update()
        shape = bridge.read_shape(obj)
        return shape.mirror, shape

    return read


@pytest.fixture
def mirrored(make, half):
    obj = make(half, "Figure")
    obj.modifiers.new("Mirror", "MIRROR")
    return obj


def seen_sides(obj, plane, stretch):
    """Vertices of the evaluated mesh in coordinates of the shape, and their heights above the plane."""
    evaluated = obj.evaluated_get(bpy.context.evaluated_depsgraph_get()).to_mesh()
    points = np.array([v.co for v in evaluated.vertices]) @ stretch.T
    return points, points @ plane[:3] - plane[3]


def test_the_parts_of_the_whole(mirrored, half, package):
    core = importlib.import_module(f"{package}.core")
    assert bpy.ops.reeb_parts.decompose() == {"FINISHED"}
    expected = core.decompose(half.vertices.astype(np.float32), half.faces, mirror=(1, 0, 0, 0)).parts()
    numbers = face_numbers(mirrored.data)
    pairs = set(zip(numbers.tolist(), expected.labels.tolist(), strict=True))
    assert len(pairs) == expected.count == len(mirrored.data.reeb_parts.parts)
    notes = mirrored.data.reeb_parts.notes
    assert "mirror image" in notes
    assert "before its modifier" not in notes
    # Nothing becomes stale when the modifier is hidden.
    mirrored.modifiers[0].show_viewport = False
    bpy.context.view_layer.update()
    assert importlib.import_module(f"{package}.scene.store").has_parts(mirrored)


def test_a_half_that_is_closed_at_the_plane_has_the_parts_of_an_open_one(make):
    """What closes it would be a wall inside of what is seen, or part it in two."""
    solid = np.zeros((12, 8, 7), bool)
    solid[6:, :, 6] = solid[11, [[0], [7]]] = True
    vertices, quads = shapes.blocks(solid)
    inside = (np.abs(vertices[quads][:, :, 0]) < 1e-9).all(axis=1)
    numbers = []
    for faces in (quads, quads[~inside]):
        table = make((vertices, faces), "Table")
        table.modifiers.new("Mirror", "MIRROR")
        assert bpy.ops.reeb_parts.decompose() == {"FINISHED"}
        numbers.append(face_numbers(table.data))
    closed, opened = numbers
    assert (closed[~inside] == opened).all()
    assert set(closed[inside]) <= set(opened)
    assert len(set(opened)) == 3  # the top, and two legs


def own(obj):
    obj.scale, obj.rotation_euler, obj.location = (1.5, 0.7, 2.0), (0.3, 1.0, -0.4), (1, 2, 3)


def by_an_object(obj):
    """A mirror object beside the model, turned; the model is scaled unevenly."""
    other = bpy.data.objects.new("Mirror", None)
    bpy.context.scene.collection.objects.link(other)
    other.location, other.rotation_euler, obj.scale = (-1.5, 0.5, 0.1), (0, 0.2, 0.1), (1, 2, 1)
    obj.modifiers[0].mirror_object = other


def by_another_axis(obj):
    obj.data.transform(Matrix(((0, 1, 0, 0), (1, 0, 0, 0), (0, 0, 1, 0), (0, 0, 0, 1))))
    obj.modifiers[0].use_axis = (False, True, False)


@pytest.mark.parametrize("change", [own, by_an_object, by_another_axis])
def test_the_plane_is_that_of_what_is_seen(mirrored, plane_of, change):
    change(mirrored)
    plane, shape = plane_of(mirrored)
    assert len(plane) == 4
    points, height = seen_sides(mirrored, plane, shape.stretch)
    image = points - 2 * height[:, None] * plane[:3]
    apart = np.linalg.norm(image[:, None] - points, axis=2).min(axis=1)
    assert apart.max() < 2e-3 * np.ptp(points)


def two_axes(obj):
    obj.modifiers[0].use_axis = (True, True, False)


def cuts_off(obj):
    obj.modifiers[0].use_bisect_axis = (True, False, False)


def is_hidden(obj):
    obj.modifiers[0].show_viewport = False


def comes_second(obj):
    obj.modifiers.new("Array", "ARRAY")
    obj.modifiers.move(1, 0)


def lies_on_both_sides(obj):
    obj.data.transform(Matrix.Translation((-0.3, 0, 0)))


def shears(obj):
    """Turned below a parent of uneven scale: what is seen is no mirror image in the world."""
    parent = bpy.data.objects.new("Parent", None)
    bpy.context.scene.collection.objects.link(parent)
    obj.parent, parent.scale, obj.rotation_euler = parent, (1, 3, 1), (0, 0, 0.5)


@pytest.mark.parametrize("change", [two_axes, cuts_off, is_hidden, comes_second, lies_on_both_sides, shears])
def test_other_modifiers_are_left_alone(mirrored, plane_of, change):
    change(mirrored)
    assert len(plane_of(mirrored)[0]) == 0


def separated(obj, **style):
    """Pieces by their names behind the object's, and how many faces they have on either side of the plane x = 0."""
    for other in list(bpy.data.objects):
        if other is not obj:
            bpy.data.objects.remove(other)
    assert bpy.ops.reeb_parts.separate(caps=False, cut="FACES", hide=False, **style) == {"FINISHED"}
    found = {}
    for piece in bpy.data.objects:
        if piece is not obj:
            across = np.array([face.center.x for face in piece.data.polygons]) + piece.location.x
            found[piece.name.removeprefix("Figure ")] = (int((across > 0).sum()), int((across < 0).sum()))
    return found


def test_with_the_mirror_applied_both_sides_are_pieces(mirrored, half):
    """An arm is two pieces then, .L and .R, each with the faces of the half; the trunk is one, of both halves."""
    assert bpy.ops.reeb_parts.decompose() == {"FINISHED"}
    numbers = face_numbers(mirrored.data)
    names = {part.number: part.name for part in mirrored.data.reeb_parts.parts}
    far = half.vertices[half.faces].min(axis=(1, 2), where=[True, False, False], initial=np.inf)
    beside = {number for number in names if far[numbers == number].min() > 1e-4}
    assert 0 < len(beside) < len(names)
    counts = {number: int((numbers == number).sum()) for number in names}
    expected = {names[number]: (counts[number], counts[number]) for number in names if number not in beside}
    for number in beside:
        expected |= {f"{names[number]}.L": (counts[number], 0), f"{names[number]}.R": (0, counts[number])}
    assert separated(mirrored, seen=True) == expected
    assert separated(mirrored, seen=True) == expected  # and nothing twice
    # Without, a piece keeps the modifier and shows both sides.
    assert separated(mirrored) == {name: (counts[number], 0) for number, name in names.items()}


def test_a_name_that_has_a_side_is_that_of_the_side_that_is_there(mirrored):
    assert bpy.ops.reeb_parts.decompose() == {"FINISHED"}
    before = separated(mirrored, seen=True)
    arm = next(part for part in mirrored.data.reeb_parts.parts if f"{part.name}.R" in before)
    own, image = before[f"{arm.name}.L"], before[f"{arm.name}.R"]
    arm.name = "Arm.R"
    found = separated(mirrored, seen=True)
    assert (found["Arm.R"], found["Arm.L"]) == (own, image)


def test_on_the_other_side_left_and_right_are_the_same(make, half):
    vertices = half.vertices * (-1, 1, 1)
    obj = make(shapes.Shape(vertices, half.faces[:, ::-1]), "Figure")
    obj.modifiers.new("Mirror", "MIRROR")
    assert bpy.ops.reeb_parts.decompose() == {"FINISHED"}
    found = separated(obj, seen=True)
    sided = [name for name in found if name.endswith((".L", ".R"))]
    assert sided
    assert all(found[name][name.endswith(".L")] == 0 for name in sided)

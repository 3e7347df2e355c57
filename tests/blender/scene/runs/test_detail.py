# SPDX-License-Identifier: GPL-3.0-or-later
"""Detail and the number of parts are one thing; both, and all that was given to parts, outlast an edit of the mesh."""

import importlib

import bmesh
import bpy
import numpy as np
import pytest
import shapes
from mathutils import Matrix, Vector
from snapshot import activate


def levels(obj, package):
    store = importlib.import_module(f"{package}.scene.store")
    return store.load(obj.data).numbering.strong_levels().tolist()


def test_a_number_of_parts_moves_the_detail_to_where_it_is(obj, result):
    for count in (5, 1):  # between them, two branches at a time are cut off as clearly as each other
        result.n_parts = count
        assert len(result.parts) == count
        shown = [part.number for part in result.parts]
        # A nudge that is smaller than the way to the next cut changes nothing.
        result.detail = result.detail + 1e-5
        assert [part.number for part in result.parts] == shown


def test_more_detail_after_a_number_adds_to_these_parts(result):
    result.n_parts = 2
    faces = [part.number for part in result.parts]
    while len(result.parts) == 2:
        result.detail += 0.01
    assert len(result.parts) in {3, 4, 5}  # the branches are alike
    assert set(faces) <= {part.number for part in result.parts}


def test_a_number_that_cannot_be_had_is_told(result):
    result.n_parts = 3
    assert result.asked == 0
    result.n_parts = 1_000_000
    assert (result.asked, result.fewest, result.n_parts) == (1_000_000, 1, result.most)
    assert len(result.parts) == result.most
    result.detail = 0.5
    assert result.asked == 0


def test_a_run_with_a_number_is_as_if_it_had_been_typed(obj, result):
    """Detail is where there are so many parts: whoever drags it on begins there."""
    result.n_parts = 5
    typed = result.detail, result.fewest, result.most, result.asked
    bpy.ops.reeb_parts.clear()
    bpy.ops.reeb_parts.decompose(n_parts=5)
    result = obj.data.reeb_parts
    assert (result.detail, result.fewest, result.most, result.asked) == typed
    result.detail += 1e-5  # smaller than the way to the next cut
    assert len(result.parts) == 5


def test_a_run_tells_of_a_number_that_cannot_be_had(obj, result, capfd):
    """In the report, in the panel and among the notes, also where the parts were computed before; and never later."""
    capfd.readouterr()
    bpy.ops.reeb_parts.decompose(n_parts=5000)
    result = obj.data.reeb_parts
    note = f"5000 parts were asked for; there are {result.most} at most."
    assert f"Info: {note}" in capfd.readouterr().out
    assert (result.asked, result.n_parts, len(result.parts)) == (5000, result.most, result.most)
    assert note in result.notes.splitlines()
    bpy.ops.reeb_parts.decompose(n_parts=3)
    assert result.asked == 0
    assert "asked for" not in result.notes


def test_steps_go_from_one_clear_choice_to_the_next_and_back(obj, result, package):
    result.n_parts = 1
    there = [1]
    while len(there) < 5:
        bpy.ops.reeb_parts.step_detail(more=True)
        there.append(len(result.parts))
    assert there == levels(obj, package)[:5]
    assert 5 in there  # the trunk and its four branches
    for count in reversed(there[:-1]):
        bpy.ops.reeb_parts.step_detail(more=False)
        assert len(result.parts) == count
    with pytest.raises(RuntimeError, match="no fewer parts"):
        bpy.ops.reeb_parts.step_detail(more=False)
    result.n_parts = 1_000_000
    with pytest.raises(RuntimeError, match="no more parts"):
        bpy.ops.reeb_parts.step_detail(more=True)


def test_the_panel_decomposes_an_edited_mesh_at_the_detail_that_it_shows(obj, result, package):
    results = importlib.import_module(f"{package}.scene.runs.results")
    assert results.detail_of(obj) == {"detail": pytest.approx(0.5), "n_parts": 0}
    result.n_parts = 4
    assert results.detail_of(obj)["n_parts"] == 4
    result.detail = 0.7
    assert results.detail_of(obj) == {"detail": pytest.approx(0.7), "n_parts": 0}
    bpy.ops.reeb_parts.clear()
    assert results.detail_of(obj) == {}
    assert results.detail_of(None) == {}


def looks(result):
    return {part.number: (part.name, tuple(np.round(part.color, 5)), part.locked, part.pinned)
            for part in result.parts}


def edit(mesh):
    """Half of the faces are cut in two by another edge, and all points move a little."""
    work = bmesh.new()
    work.from_mesh(mesh)
    bmesh.ops.subdivide_edges(work, edges=[edge for edge in work.edges if edge.index % 7 == 0], cuts=1)
    bmesh.ops.triangulate(work, faces=work.faces[:])
    work.to_mesh(mesh)
    work.free()
    mesh.update()


def test_what_was_given_to_parts_outlasts_an_edit(obj, result, package):
    results = importlib.import_module(f"{package}.scene.runs.results")
    result.detail = 0.6
    parts = result.parts
    parts[1].name = "Arm"
    parts[2].color = (1.0, 0.0, 1.0)
    parts[3].locked = True
    before = looks(result)
    edit(obj.data)
    bpy.ops.reeb_parts.decompose(**results.detail_of(obj))
    after = looks(result)
    same = before.keys() & after.keys()
    assert len(same) >= 5
    assert {number: after[number] for number in same} == {number: before[number] for number in same}


def test_faces_that_do_not_tell_leave_names_in_their_places(obj, result):
    """After QuadriFlow names, colors and locks were those of parts that had their numbers by chance."""
    place = {part.name: Vector(part.middle) for part in result.parts}
    gone = max(result.parts, key=lambda part: part.middle[0])
    stays = min(result.parts, key=lambda part: part.middle[0])
    gone.locked = stays.locked = True
    center, locked = Vector(gone.middle), stays.number
    for part in result.parts:
        part.name = f"My {part.name}"
    mesh, matrix = obj.data, Matrix.Rotation(0.01, 4, "X")
    vertices = [matrix @ vertex.co for vertex in mesh.vertices]
    faces = [polygon.vertices[:] for polygon in mesh.polygons if (polygon.center - center).length > 0.5]
    mesh.clear_geometry()
    mesh.from_pydata(vertices, [], faces[::-1])
    assert "reeb_part" not in mesh.attributes
    bpy.ops.reeb_parts.decompose()
    named = {part.name: Vector(part.middle) for part in result.parts if part.name.startswith("My ")}
    assert len(named) == len(place) - 1
    for name, middle in named.items():
        assert (place[name.removeprefix("My ")] - middle).length < 0.2
    assert [part.number for part in result.parts if part.locked] == [locked]
    assert [part.number for part in result.parts if part.pinned] == [locked]


def test_what_was_given_to_a_part_goes_with_its_last_face(obj, result):
    """Its number is free then, and the next new part had it, with the name, the color and the lock of a deleted one."""
    bpy.ops.reeb_parts.decompose(n_parts=5)
    part = min(result.parts, key=lambda part: part.share)
    number = part.number
    part.name, part.color, part.locked = "Gone", (0.1, 0.2, 0.3), True
    bm = bmesh.new()
    bm.from_mesh(obj.data)
    numbers = bm.faces.layers.int["reeb_part"]
    bmesh.ops.delete(bm, geom=[face for face in bm.faces if face[numbers] == number], context="FACES")
    bm.to_mesh(obj.data)
    bm.free()
    bpy.ops.reeb_parts.decompose(n_parts=8)
    assert number in {part.number for part in result.parts}
    assert "Gone" not in {part.name for part in result.parts} | {entry.name for entry in result.names}
    assert not any(part.locked or np.allclose(part.color, (0.1, 0.2, 0.3)) for part in result.parts)


@pytest.mark.parametrize("change", [{"detail": 0.9}, {"n_parts": 3}])
def test_detail_stays_when_a_script_decomposes_again(obj, result, change):
    for name, value in change.items():
        setattr(result, name, value)
    shown = (pytest.approx(result.detail), result.by_number, [part.number for part in result.parts])
    assert bpy.ops.reeb_parts.decompose() == {"FINISHED"}
    assert (result.detail, result.by_number, [part.number for part in result.parts]) == shown
    bpy.ops.reeb_parts.decompose(colors=False)
    assert (result.detail, result.by_number, [part.number for part in result.parts]) == shown


def test_what_a_script_says_of_the_parts_wins(result):
    result.n_parts = 3
    bpy.ops.reeb_parts.decompose(detail=0.9)
    assert (result.detail, result.by_number) == (pytest.approx(0.9), False)
    bpy.ops.reeb_parts.decompose(n_parts=2)
    assert (len(result.parts), result.by_number) == (2, True)
    bpy.ops.reeb_parts.decompose(n_parts=0)
    assert not result.by_number


def test_nothing_leaves_dynamic_topology(obj, result):
    """Buttons refuse there, for the sculpted mesh is not the object's; but sliders, and what takes back a failed
    command, left it and came back."""
    bpy.ops.object.mode_set(mode="SCULPT")
    bpy.ops.sculpt.dynamic_topology_toggle()
    order, detail = obj.data.attributes.keys(), result.detail
    result.detail, result.n_parts = 0.9, 3
    result.parts[0].color, result.parts[0].locked = (1, 0, 0), True
    for operator in (bpy.ops.reeb_parts.decompose, bpy.ops.reeb_parts.clear):
        with pytest.raises(RuntimeError, match="Switch Dyntopo off"):
            operator()
    assert (result.detail, len(result.parts), result.parts[0].locked) == (detail, 5, False)
    assert obj.data.attributes.keys() == order  # another one, and masks, when the mesh has come back from sculpting


def test_detail_of_several_selected_models_is_set_together(make, tree):
    first, second, third = (make((tree[0] * size, tree[1]), name) for size, name in ((1, "A"), (2, "B"), (3, "C")))
    for obj in (first, second, third):
        obj.select_set(True)
    bpy.ops.reeb_parts.decompose()
    third.select_set(False)
    bpy.context.view_layer.objects.active = first
    first.data.reeb_parts.n_parts = 3
    assert [len(obj.data.reeb_parts.parts) for obj in (first, second, third)] == [3, 3, 5]
    bpy.ops.object.mode_set(mode="EDIT")  # both: only those that are not edited were set
    first.data.reeb_parts.detail = 0.5
    assert [obj.mode for obj in (first, second, third)] == ["EDIT", "EDIT", "OBJECT"]
    bpy.ops.object.mode_set(mode="OBJECT")
    assert [len(obj.data.reeb_parts.parts) for obj in (first, second, third)] == [5, 5, 5]
    # A script that sets the detail of a model that is not the active one means this one alone.
    second.data.reeb_parts.n_parts = 2
    assert [len(obj.data.reeb_parts.parts) for obj in (first, second, third)] == [5, 2, 5]


def faces_of(obj, name):
    """Which faces the part of a name has."""
    number = next((part.number for part in obj.data.reeb_parts.parts if part.name == name), -1)
    return np.array([value.value for value in obj.data.attributes["reeb_part"].data]) == number


def test_a_name_outlasts_another_run_while_fewer_parts_are_shown(obj, result):
    """By another method, so that numbers do not come out the same by themselves."""
    bpy.ops.reeb_parts.decompose(method="berretti", detail=0.5)
    branch = sorted(result.parts, key=lambda part: part.share)[len(result.parts) // 2]
    branch.name = "Branch"
    before = faces_of(obj, "Branch")
    result.detail = 0.0
    assert "Branch" not in [part.name for part in result.parts]
    bpy.ops.reeb_parts.decompose(method="perceptual", detail=0.5)
    after = faces_of(obj, "Branch")
    assert (before & after).sum() > 0.9 * max(before.sum(), after.sum()) > 0


def test_what_is_ticked_stays_ticked_while_the_detail_is_dragged(result):
    result.detail = 0.5
    ticked = result.parts[1].number
    result.parts[1].selected = True
    for detail in (0.6, 0.8, 0.5):
        result.detail = detail
        assert [part.number for part in result.parts if part.selected] == [ticked]


@pytest.mark.parametrize("mode", ["OBJECT", "EDIT"])
def test_steps_are_those_of_each_selected_model(make, obj, package, mode):
    """Fewer and More changed the active model alone, beside Detail and Parts, which set all."""
    ball = make(shapes.two_spheres(), "Ball")
    objects = [obj, ball, make(shapes.tube_tree(6), "Other")]
    for item in objects:
        item.select_set(True)
    bpy.ops.reeb_parts.decompose(n_parts=1)
    ball.data.reeb_parts.n_parts = ball.data.reeb_parts.most
    expected = [[count for count in levels(item, package) if count > len(item.data.reeb_parts.parts)]
                for item in objects]
    most = [len(item.data.reeb_parts.parts) for item in objects]
    bpy.ops.object.mode_set(mode=mode)
    assert [len(counts) > 1 for counts in expected] == [True, False, True]
    for step in range(max(map(len, expected))):
        bpy.ops.reeb_parts.step_detail(more=True)
        counts = [([most[i], *expected[i]])[min(step + 1, len(expected[i]))] for i in range(3)]
        assert [len(item.data.reeb_parts.parts) for item in objects] == counts
    with pytest.raises(RuntimeError, match="no more parts"):
        bpy.ops.reeb_parts.step_detail(more=True)
    assert bpy.context.mode.startswith(mode)


def test_each_of_several_models_keeps_its_detail(make, obj):
    """All got that of the active one, and that of new models where this had no parts yet."""
    objects = [obj, make(shapes.tube_tree(6), "Six"), make(shapes.tube_tree(5), "Five")]
    for item, wanted in zip(objects, ({"n_parts": 2}, {"detail": 0.8}, {"detail": 0.1}), strict=True):
        activate(item)
        bpy.ops.reeb_parts.decompose(**wanted)
    before = [(len(item.data.reeb_parts.parts), item.data.reeb_parts.detail) for item in objects]
    assert len({count for count, _ in before}) == 3
    new = make(shapes.two_spheres(), "New")
    for active in (obj, new):
        for item in (*objects, new):
            item.select_set(True)
            edit(item.data)
        bpy.context.view_layer.objects.active = active
        bpy.ops.reeb_parts.decompose()
        counts, details = zip(*[(len(item.data.reeb_parts.parts), item.data.reeb_parts.detail) for item in objects],
                              strict=True)
        assert counts[0] == before[0][0]
        assert details[1:] == pytest.approx([detail for _, detail in before[1:]])
    bpy.ops.reeb_parts.decompose(detail=0.3)
    assert [item.data.reeb_parts.detail for item in (*objects, new)] == pytest.approx([0.3] * 4)
    # As the panel after the press does, which repeats it with what it shows: another setting changes no detail.
    shown = {"detail": obj.data.reeb_parts.detail, "n_parts": 0}
    objects[1].data.reeb_parts.n_parts = 7
    left = {"left_detail": shown["detail"], "left_n_parts": 0}
    bpy.ops.reeb_parts.decompose(**shown, **left, symmetry=False)
    assert objects[1].data.reeb_parts.n_parts == 7
    bpy.ops.reeb_parts.decompose(**{**shown, "detail": 0.6}, **left)
    assert [item.data.reeb_parts.detail for item in (*objects, new)] == pytest.approx([0.6] * 4)

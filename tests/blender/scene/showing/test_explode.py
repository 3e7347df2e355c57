# SPDX-License-Identifier: GPL-3.0-or-later
"""The explode slider: every part moves as one, the mesh stays as it is, 0 and Clear leave nothing."""

import importlib

import bpy
import numpy as np
import pytest
import shapes
from bulk import read
from snapshot import activate, changes, snapshot


def shown(obj):
    """Corners of the faces as the viewport shows them, (c, 3)."""
    evaluated = obj.evaluated_get(bpy.context.evaluated_depsgraph_get())
    mesh = evaluated.to_mesh()
    points = read(mesh.vertices, "co", np.float32, 3)[read(mesh.loops, "vertex_index", np.int32)]
    evaluated.to_mesh_clear()
    return points


def expected(obj, amount):
    """The same by hand: each part moved along the line from the middle of all to its own middle."""
    mesh = obj.data
    points = read(mesh.vertices, "co", np.float32, 3)
    numbers = read(mesh.attributes["reeb_part"].data, "value", np.int32)
    area = read(mesh.polygons, "area")
    center = read(mesh.polygons, "center", np.float32, 3)
    moved = np.zeros((len(numbers), 3))
    for number in np.unique(numbers):
        mine = numbers == number
        moved[mine] = np.average(center[mine], axis=0, weights=area[mine]) - np.average(center, axis=0, weights=area)
    corner = read(mesh.loops, "vertex_index", np.int32)
    face = np.repeat(np.arange(len(numbers)), read(mesh.polygons, "loop_total", np.int32))
    return points[corner] + amount * moved[face]


@pytest.mark.parametrize("amount", [0.5, 2.0])
def test_each_part_moves_away_from_the_middle(obj, amount):
    bpy.ops.reeb_parts.decompose()
    obj.reeb_parts_made.explode = amount
    assert shown(obj) == pytest.approx(expected(obj, amount), abs=1e-4)


def with_ball(obj, operation="UNION"):
    """Give an object a Boolean modifier with a ball at a tip of the tree; the ball's place and radius."""
    tip = shapes.TREE_TIPS[1]
    bpy.ops.mesh.primitive_ico_sphere_add(subdivisions=3, radius=0.6, location=tip)
    ball = bpy.context.object
    ball.hide_set(True)
    activate(obj)
    modifier = obj.modifiers.new("Boolean", "BOOLEAN")
    modifier.operation, modifier.object = operation, ball
    return tip


@pytest.mark.parametrize("operation", ["UNION", "DIFFERENCE"])
@pytest.mark.parametrize("n_parts", [1, 5])
def test_faces_that_a_modifier_adds_go_with_the_nearest_part(obj, operation, n_parts):
    """They have no number: they counted as a part of their own, which drifted off a model of one part."""
    tip = with_ball(obj, operation)
    bpy.ops.reeb_parts.decompose(n_parts=n_parts)
    assert "Faces that a Boolean modifier adds to Tree are in no part" in obj.data.reeb_parts.notes
    before = shown(obj)
    obj.reeb_parts_made.explode = 0.5
    moved = shown(obj) - before
    assert len(moved) == len(before)
    near = np.linalg.norm(before - tip, axis=1) < 0.8  # the ball, and what of the branch is beside it
    assert near.sum() > 100
    assert np.ptp(moved[near], axis=0).max() < 1e-4
    assert (np.abs(moved[near]).max() > 0.1) == (n_parts > 1)


@pytest.mark.parametrize(("kind", "values"), [
    ("SUBSURF", {}), ("SOLIDIFY", {"thickness": 0.02}), ("ARRAY", {"count": 2, "relative_offset_displace": (2, 0, 0)}),
    ("MIRROR", {"use_mirror_merge": False}), ("BOOLEAN", {}),
])
def test_one_part_stays_where_it_is_with_modifiers(obj, kind, values):
    if kind == "BOOLEAN":
        with_ball(obj)
    else:
        modifier = obj.modifiers.new("Mine", kind)
        for key, value in values.items():
            setattr(modifier, key, value)
    bpy.ops.reeb_parts.decompose(n_parts=1)
    before = shown(obj)
    obj.reeb_parts_made.explode = 1.0
    assert shown(obj) == pytest.approx(before, abs=1e-5)


def test_the_slider_moves_what_is_there(obj):
    bpy.ops.reeb_parts.decompose()
    for amount in (1.0, 0.25):
        obj.reeb_parts_made.explode = amount
        assert shown(obj) == pytest.approx(expected(obj, amount), abs=1e-4)
    assert len(obj.modifiers) == 1


@pytest.mark.parametrize("face_attribute", [True, False])
def test_a_driver_alone_moves_the_parts(package, obj, face_attribute):
    """They stayed until the slider had been moved by hand, and went back when that came to 0."""
    watch = importlib.import_module(f"{package}.scene.changes.watch")
    bpy.ops.reeb_parts.decompose(face_attribute=face_attribute)
    obj.driver_add("reeb_parts_made.explode").driver.expression = "0.5"
    bpy.context.view_layer.update()
    assert bpy.app.timers.is_registered(watch._explode)
    watch._explode()  # as the timer does
    bpy.app.timers.unregister(watch._explode)
    assert shown(obj) == pytest.approx(expected(obj, 0.5), abs=1e-4)
    obj.reeb_parts_made.explode = 0.0
    assert shown(obj) == pytest.approx(expected(obj, 0.5), abs=1e-4)
    obj.driver_remove("reeb_parts_made.explode")
    obj.reeb_parts_made.explode = 0.0
    assert not obj.modifiers


def test_it_follows_the_detail(obj):
    bpy.ops.reeb_parts.decompose()
    obj.reeb_parts_made.explode = 1.0
    obj.data.reeb_parts.n_parts = 3
    assert shown(obj) == pytest.approx(expected(obj, 1.0), abs=1e-4)


def test_the_mesh_is_not_changed_and_at_zero_nothing_is_left(obj):
    bpy.ops.reeb_parts.decompose()
    before = snapshot()
    obj.reeb_parts_made.explode = 1.0
    assert snapshot()["meshes"] == before["meshes"]
    obj.reeb_parts_made.explode = 0.0
    after = snapshot()
    for shot in (before, after):
        for key in ("properties", "made"):  # where the slider's own value is
            shot["objects"]["Tree"].pop(key)
    assert changes(before, after) == []
    assert not bpy.data.node_groups


def test_clear_removes_it(obj):
    obj.modifiers.new("Smooth", "SUBSURF")
    bpy.ops.reeb_parts.decompose()
    obj.reeb_parts_made.explode = 1.0
    assert obj.modifiers.keys() == ["Smooth", "Reeb Parts Explode"]
    bpy.ops.reeb_parts.clear()
    assert obj.modifiers.keys() == ["Smooth"]
    assert obj.reeb_parts_made.explode == 0.0
    assert not bpy.data.node_groups


def test_after_the_modifier_was_applied_the_slider_begins_at_zero_again(obj):
    """It went on saying 0.5 beside parts that it did not move."""
    bpy.ops.reeb_parts.decompose(method="berretti")
    obj.reeb_parts_made.explode = 0.5
    bpy.ops.reeb_parts.decompose(method="berretti")
    assert obj.reeb_parts_made.explode == 0.5
    bpy.ops.object.modifier_apply(modifier="Reeb Parts Explode")
    bpy.ops.reeb_parts.decompose(method="berretti")
    assert obj.reeb_parts_made.explode == 0.0
    assert not obj.modifiers


@pytest.mark.parametrize("again", [0.0, 0.7])
def test_nodes_that_the_user_has_changed_stay_in_the_file(obj, again):
    """They were gone once the slider was at 0; and where one was renamed, the slider ended in an error."""
    bpy.ops.reeb_parts.decompose()
    obj.reeb_parts_made.explode = 0.5
    mine = obj.modifiers[0].node_group
    mine.nodes.new("GeometryNodeTransform").name = "Turn"
    mine.nodes["Part"].name = "Which"
    obj.reeb_parts_made.explode = again
    assert "Turn" in mine.nodes
    assert mine.use_fake_user
    assert [modifier.node_group for modifier in obj.modifiers] != [mine]
    obj.reeb_parts_made.explode = 0.5
    assert np.allclose(shown(obj), expected(obj, 0.5), atol=1e-5)
    bpy.ops.reeb_parts.clear()
    assert bpy.data.node_groups[:] == [mine]


def test_nodes_of_ours_go_in_a_file_that_was_saved(obj, tmp_path):
    bpy.ops.reeb_parts.decompose()
    obj.reeb_parts_made.explode = 0.5
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "apart.blend"))
    bpy.ops.wm.open_mainfile(filepath=str(tmp_path / "apart.blend"))
    bpy.data.objects["Tree"].reeb_parts_made.explode = 0.0
    assert bpy.data.node_groups[:] == []


def test_it_needs_no_output(obj):
    bpy.ops.reeb_parts.decompose(face_attribute=False)
    obj.reeb_parts_made.explode = 1.0
    assert shown(obj) == pytest.approx(expected(obj, 1.0), abs=1e-4)


def test_it_can_be_animated(obj):
    bpy.ops.reeb_parts.decompose()
    made = obj.reeb_parts_made
    for frame, amount in ((1, 0.0), (11, 1.0)):
        made.explode = amount
        obj.keyframe_insert("reeb_parts_made.explode", frame=frame)
    for frame, amount in ((11, 1.0), (1, 0.0)):
        bpy.context.scene.frame_set(frame)
        assert shown(obj) == pytest.approx(expected(obj, amount), abs=1e-4)


def test_a_copy_has_a_slider_of_its_own(obj):
    bpy.ops.reeb_parts.decompose()
    obj.reeb_parts_made.explode = 1.0
    bpy.ops.object.duplicate(linked=True)
    twin = bpy.context.object
    twin.reeb_parts_made.explode = 0.5
    assert shown(twin) == pytest.approx(expected(obj, 0.5), abs=1e-4)
    assert shown(obj) == pytest.approx(expected(obj, 1.0), abs=1e-4)
    activate(obj)


@pytest.mark.parametrize("amount", [0.0, 0.5])
@pytest.mark.parametrize("linked", [False, True])
def test_a_copy_stays_as_it_is_when_the_slider_of_its_original_moves(obj, linked, amount):
    """It went together with the original, or apart, and its own slider said otherwise."""
    bpy.ops.reeb_parts.decompose()
    obj.reeb_parts_made.explode = 1.0
    bpy.ops.object.duplicate(linked=linked)
    twin = bpy.context.object
    obj.reeb_parts_made.explode = amount
    assert shown(twin) == pytest.approx(expected(obj, 1.0), abs=1e-4)
    assert shown(obj) == pytest.approx(expected(obj, amount), abs=1e-4)
    activate(obj)


def test_a_copy_that_takes_the_name_of_its_original_has_a_slider_of_its_own(obj):
    bpy.ops.reeb_parts.decompose()
    obj.reeb_parts_made.explode = 1.0
    bpy.ops.object.duplicate()
    twin, name = bpy.context.object, obj.name
    obj.name, twin.name = "Former", name
    twin.reeb_parts_made.explode = 0.5
    assert shown(twin) == pytest.approx(expected(obj, 0.5), abs=1e-4)
    assert shown(obj) == pytest.approx(expected(obj, 1.0), abs=1e-4)
    activate(obj)


def test_pieces_are_not_exploded(obj):
    bpy.ops.reeb_parts.decompose()
    obj.reeb_parts_made.explode = 1.0
    bpy.ops.reeb_parts.separate(hide=False)
    made = [o for o in bpy.data.objects if "reeb_parts_number" in o]
    assert len(made) > 1
    assert not any(piece.modifiers or piece.reeb_parts_made.explode for piece in made)
    assert obj.modifiers.keys() == ["Reeb Parts Explode"]


def test_nobody_is_told_of_our_own_modifier(obj):
    bpy.ops.reeb_parts.decompose()
    notes = obj.data.reeb_parts.notes
    obj.reeb_parts_made.explode = 1.0
    bpy.ops.reeb_parts.decompose()
    assert obj.data.reeb_parts.notes == notes


def test_a_first_drag_that_fails_goes_back(obj, package, monkeypatch):
    """The slider stayed where it had been moved to, and nothing had moved: nothing was remembered before."""
    bpy.ops.reeb_parts.decompose()
    explode = importlib.import_module(f"{package}.scene.showing.explode")

    def fail(_):
        raise MemoryError

    with monkeypatch.context() as patched:
        patched.setattr(explode, "_node_group", fail)
        obj.reeb_parts_made.explode = 0.5
    assert obj.reeb_parts_made.explode == 0.0
    assert not obj.modifiers
    obj.reeb_parts_made.explode = 0.5
    assert obj.modifiers

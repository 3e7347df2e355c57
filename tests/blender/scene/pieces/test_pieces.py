# SPDX-License-Identifier: GPL-3.0-or-later
"""reeb_parts.separate: pieces are what their faces were, and nothing of the user's is lost."""

import importlib
import itertools

import bpy
import numpy as np
import pytest
import shapes
from bulk import read
from pieces import KEEP, WHOLE, elements, pieces_of
from places import world_points
from results import numbers as numbers_of
from snapshot import activate, changes, check_undo, snapshot


def test_the_original_is_not_changed(rich):
    bpy.ops.reeb_parts.decompose(materials=True)
    before = snapshot()
    bpy.ops.reeb_parts.separate(caps=True, hide=False)
    after = snapshot()
    assert after["meshes"]["Tree"] == before["meshes"]["Tree"]
    assert after["objects"]["Tree"].pop("properties").keys() <= {"reeb_parts_made"}
    assert not before["objects"]["Tree"].pop("properties")
    assert "Parts of Tree" in after["objects"]["Tree"].pop("made")
    before["objects"]["Tree"].pop("made")
    assert changes(before["objects"]["Tree"], after["objects"]["Tree"]) == []


def test_names_colours_and_materials_of_the_parts(obj):
    bpy.ops.reeb_parts.decompose(materials=True)
    obj.data.reeb_parts.parts[1].name = "Head"
    bpy.ops.reeb_parts.separate(**KEEP)
    listed = obj.data.reeb_parts.parts
    assert [piece.name for piece in pieces_of()] == [f"Tree {part.name}" for part in listed]
    assert [piece.data.name for piece in pieces_of()] == [f"Tree {part.name}" for part in listed]
    for piece, part in zip(pieces_of(), listed, strict=True):
        srgb = np.array(part.color)  # Blender draws what objects are coloured with as linear
        linear = np.where(srgb <= 0.04045, srgb / 12.92, ((srgb + 0.055) / 1.055) ** 2.4)
        assert tuple(piece.color)[:3] == pytest.approx(linear, abs=1e-5)
        assert piece.data.materials[:] == [part.material]


@pytest.mark.parametrize("center", [False, True])
@pytest.mark.parametrize("parent", [False, True])
def test_pieces_lie_where_their_faces_lay(obj, center, parent):
    frame = bpy.data.objects.new("Frame", None)
    bpy.context.scene.collection.objects.link(frame)
    frame.rotation_euler, frame.location = (0.3, 0.2, 0.1), (4, 5, 6)
    obj.parent = frame
    obj.scale, obj.rotation_euler, obj.location = (-1.5, 0.5, 2.0), (0.1, 0.7, -0.4), (1, 2, 3)
    obj.delta_location = (0.5, 0, 0)
    bpy.ops.reeb_parts.decompose()
    numbers, points = numbers_of(obj.data), world_points(obj)
    bpy.ops.reeb_parts.separate(center=center, parent=parent, **WHOLE)
    for piece in pieces_of():
        here = elements(obj.data, numbers == piece["reeb_parts_number"])["POINT"]
        assert world_points(piece) == pytest.approx(points[here], abs=1e-4)
        assert piece.parent == (obj if parent else frame)
    origins = {tuple(round(x, 4) for x in piece.matrix_world.translation) for piece in pieces_of()}
    assert len(origins) == (len(pieces_of()) if center else 1)


def test_an_animated_object_keeps_its_origin(obj):
    obj.keyframe_insert("location", frame=1)
    bpy.ops.reeb_parts.decompose()
    bpy.ops.reeb_parts.separate(center=True)
    assert all(piece.location == obj.location for piece in pieces_of())


@pytest.mark.parametrize("name", ["armature", "hulls", "export", "separate", "merge"])
def test_with_a_piece_active_commands_name_the_original(obj, name, tmp_path):
    """In a script, right after Separate."""
    bpy.ops.reeb_parts.decompose()
    bpy.ops.reeb_parts.separate()
    assert bpy.context.object in pieces_of()
    with pytest.raises(RuntimeError, match="Select the original, Tree, first"):
        getattr(bpy.ops.reeb_parts, name)(**({"directory": str(tmp_path)} if name == "export" else {}))
    activate(pieces_of()[0])
    bpy.ops.reeb_parts.decompose()
    assert bpy.ops.reeb_parts.hulls() == {"FINISHED"}


def test_only_the_chosen_parts(obj):
    bpy.ops.reeb_parts.decompose()
    listed = obj.data.reeb_parts.parts
    for index in (1, 2):
        listed[index].selected = True
    bpy.ops.reeb_parts.separate(which="CHOSEN", **KEEP)
    assert [p["reeb_parts_number"] for p in pieces_of()] == [2, 3]
    activate(obj)
    listed[1].selected = False
    listed[3].selected = True
    bpy.ops.reeb_parts.separate(which="CHOSEN", **KEEP)
    assert [p["reeb_parts_number"] for p in pieces_of()] == [2, 3, 4]


@pytest.mark.parametrize("mode", ["EDIT", "SCULPT", "WEIGHT_PAINT", "VERTEX_PAINT", "TEXTURE_PAINT"])
@pytest.mark.parametrize("hide", [False, True])
def test_from_every_mode(obj, mode, hide):
    bpy.ops.reeb_parts.decompose()
    bpy.ops.object.mode_set(mode=mode)
    bpy.ops.reeb_parts.separate(hide=hide)
    assert len(pieces_of()) == len(obj.data.reeb_parts.parts)
    assert obj.mode == ("OBJECT" if hide else mode)


def test_linked_duplicates_get_pieces_of_their_own(obj):
    bpy.ops.reeb_parts.decompose()
    twin = obj.copy()
    twin.location.x = 20
    bpy.context.scene.collection.objects.link(twin)
    bpy.ops.reeb_parts.separate(**KEEP)
    activate(twin)
    bpy.ops.reeb_parts.separate(**KEEP)
    assert [p.location.x for p in pieces_of(twin.name)] == [20] * len(pieces_of())
    assert [p.location.x for p in pieces_of()] == [0] * len(pieces_of())


def test_several_objects_at_once(make):
    objects = [make(shapes.tube_tree(), name) for name in ("First", "Second")]
    for obj in objects:
        obj.select_set(True)
    bpy.ops.reeb_parts.decompose()
    bpy.ops.reeb_parts.separate(**KEEP)
    for obj in objects:
        assert len(pieces_of(obj.name)) == len(obj.data.reeb_parts.parts)


def test_undo_and_redo(obj):
    bpy.ops.reeb_parts.decompose()
    check_undo(lambda: bpy.ops.reeb_parts.separate(caps=True))


def test_an_edited_mesh_is_refused_and_nothing_written(obj):
    bpy.ops.reeb_parts.decompose()
    obj.data.vertices[0].co.x += 1
    before = snapshot()
    with pytest.raises(RuntimeError, match="was edited since"):
        bpy.ops.reeb_parts.separate()
    assert snapshot() == before


def test_an_edited_mesh_beside_the_active_one_is_left_out(make, capfd, tmp_path):
    active, edited = make(shapes.tube_tree(), "Active"), make(shapes.tube_tree(), "Edited")
    active.select_set(True)
    bpy.ops.reeb_parts.decompose()
    edited.data.vertices[0].co.x += 1
    activate(active)
    edited.select_set(True)
    bpy.ops.reeb_parts.export(directory=str(tmp_path))
    assert "Warning: Edited was edited since" in capfd.readouterr().out
    assert all(path.name.startswith("Active") for path in tmp_path.iterdir())
    bpy.ops.reeb_parts.separate(**KEEP)
    assert "Warning: Edited was edited since" in capfd.readouterr().out
    assert len(pieces_of("Active")) == len(active.data.reeb_parts.parts)
    assert "Parts of Edited" not in bpy.data.collections


def test_linked_duplicates_have_pieces_of_their_own(obj, tmp_path):
    """One of the two was left out without a word."""
    bpy.ops.reeb_parts.decompose()
    bpy.ops.object.duplicate(linked=True)
    copy = bpy.context.object
    copy.location.x = 5.0
    obj.select_set(True)
    n = len(obj.data.reeb_parts.parts)
    bpy.ops.reeb_parts.export(directory=str(tmp_path), format="stl")
    assert len(list(tmp_path.iterdir())) == 2 * n
    bpy.ops.reeb_parts.separate(center=False, **WHOLE)
    assert obj.hide_get()
    assert copy.hide_get()
    for item in (obj, copy):
        assert [round(piece.location.x, 5) for piece in item.reeb_parts_made.pieces.objects] == [item.location.x] * n


def test_groups_of_a_cage_survive_subdivision(obj):
    """After Subdivision, all corners of the faces of a part have the full weight of its group, and few others."""
    bpy.ops.reeb_parts.decompose()
    names = {part.number: part.name for part in obj.data.reeb_parts.parts}
    obj.modifiers.new("Subdivision", "SUBSURF").levels = 2
    bpy.ops.object.modifier_apply(modifier="Subdivision")
    numbers = numbers_of(obj.data)
    for number, name in names.items():
        index = obj.vertex_groups[name].index
        full = np.array([any(g.group == index and g.weight > 0.999 for g in v.groups) for v in obj.data.vertices])
        corner = full[read(obj.data.loops, "vertex_index", np.int32)]
        inside = np.logical_and.reduceat(corner, read(obj.data.polygons, "loop_start", np.int32))
        assert inside[numbers == number].all()
        assert inside.sum() < 1.1 * (numbers == number).sum()


@pytest.mark.parametrize("style", [{"caps": True}, {"caps": False, "cut": "FACES"}])
def test_to_end_it_at_any_step_leaves_everything_as_it_was(package, obj, style):
    """In the window it goes on in steps and Esc ends it; whichever step it is at, nothing is left of it."""
    scene = importlib.import_module(f"{package}.scene.pieces.separation")
    transaction = importlib.import_module(f"{package}.scene.transaction").transaction
    stored = importlib.import_module(f"{package}.scene.store")
    bpy.ops.reeb_parts.decompose()
    bpy.ops.reeb_parts.separate(**KEEP)
    activate(obj)
    for name, value in style.items():
        setattr(bpy.context.scene.reeb_parts_use, name, value)
    before = snapshot()
    numbers = [part.number for part in obj.data.reeb_parts.parts]
    settings = bpy.context.scene.reeb_parts_use

    def steps():
        with transaction():
            yield from scene.separating(bpy.context, obj, stored.load(obj.data), numbers, settings)

    shares, last = [], 0
    while True:
        work = steps()
        shares = list(itertools.islice(work, last + 1))
        if len(shares) <= last:
            break
        work.close()
        assert changes(before, snapshot()) == []
        last += 1
    assert last > len(numbers)
    assert shares == sorted(shares)
    assert 0 <= shares[0] < shares[-1] <= 1

# SPDX-License-Identifier: GPL-3.0-or-later
"""Pieces that are in Edit Mode, beside an active object that is not, or that are no meshes any more."""

from contextlib import nullcontext

import bpy
import numpy as np
import pytest
from pieces import KEEP, pieces_of
from snapshot import activate, changes, snapshot


@pytest.fixture
def pieces(obj):
    """The pieces of the tree; several objects can be in modes of their own."""
    bpy.ops.reeb_parts.decompose()
    bpy.ops.reeb_parts.separate(caps=True, **KEEP)
    bpy.context.scene.tool_settings.lock_object_mode = False
    return pieces_of()


def edit(item):
    """Go to Edit Mode and move a vertex there."""
    activate(item)
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.ops.mesh.select_all(action="SELECT")
    bpy.ops.transform.translate(value=(0.0, 0.0, 0.5))


def edit_through_another(piece):
    """Edit the mesh of a piece through a copy of the user's."""
    copy = piece.copy()
    bpy.context.scene.collection.objects.link(copy)
    edit(copy)


def select(*items):
    """Select objects, the first one as the active one, whatever modes others are in."""
    for other in list(bpy.context.view_layer.objects.selected):
        other.select_set(False)
    for item in items:
        item.select_set(True)
    bpy.context.view_layer.objects.active = items[0]


@pytest.mark.parametrize("way", [edit, edit_through_another])
def test_bodies_are_made_of_pieces_that_are_being_edited(obj, pieces, way):
    way(pieces[0])
    select(obj)
    assert bpy.ops.reeb_parts.rigid_bodies() == {"FINISHED"}
    assert all(piece.rigid_body is not None for piece in pieces)
    assert pieces[0].data.is_editmode


@pytest.mark.parametrize("way", [edit, edit_through_another])
def test_a_piece_that_is_being_edited_is_kept(obj, pieces, way):
    mine, count = pieces[0], len(pieces)
    way(mine)
    select(obj)
    assert bpy.ops.reeb_parts.separate(**KEEP) == {"FINISHED"}
    assert mine in bpy.data.objects[:]
    assert mine.data.is_editmode
    assert len(pieces_of()) == count
    assert mine not in pieces_of()


@pytest.mark.parametrize("way", [edit, edit_through_another])
@pytest.mark.parametrize("name", ["check_pieces", "repair_piece"])
def test_selected_pieces_that_are_being_edited_are_left_out_and_named(pieces, way, name, capfd):
    way(pieces[0])
    select(pieces[1], pieces[0])
    capfd.readouterr()
    is_sound = pytest.raises(RuntimeError, match="Nothing has to be repaired")
    with is_sound if name == "repair_piece" else nullcontext():
        getattr(bpy.ops.reeb_parts, name)()
    assert f"{pieces[0].name} is " in capfd.readouterr().out.replace("The mesh of ", "")


def test_files_have_what_is_being_edited_as_it_is_by_now(obj, pieces, tmp_path):
    """They had it as it was before Edit Mode."""
    edit(pieces[0])
    select(obj)
    bpy.ops.reeb_parts.export(directory=str(tmp_path), format="obj", separated=True)
    bpy.ops.object.select_all(action="DESELECT")
    lines = (tmp_path / f"{pieces[0].name}.obj").read_text().splitlines()
    points = np.array([line.split()[1:4] for line in lines if line.startswith("v ")], float)
    pieces[0].update_from_editmode()
    expected = np.array([pieces[0].matrix_world @ vertex.co for vertex in pieces[0].data.vertices])
    heights = points[:, 1]  # y is up in the file
    np.testing.assert_allclose(sorted(heights), sorted(expected[:, 2]), atol=1e-4)


def test_a_piece_that_was_converted_is_the_users(obj, pieces, tmp_path):
    """Bodies, and files, ended in an error; what was made until then stayed."""
    activate(obj)
    bpy.ops.reeb_parts.separate(**KEEP)
    pieces = curve, *others = pieces_of()
    activate(curve)
    bpy.ops.object.convert(target="CURVE")
    activate(obj)
    before = snapshot()
    with pytest.raises(RuntimeError, match=f"{curve.name} is not a mesh but of the type curve"):
        bpy.ops.reeb_parts.export(directory=str(tmp_path), format="obj", separated=True)
    assert changes(before, snapshot()) == []
    assert list(tmp_path.iterdir()) == []
    assert bpy.ops.reeb_parts.rigid_bodies() == {"FINISHED"}
    assert [piece.rigid_body is not None for piece in pieces] == [False, *[True] * len(others)]
    activate(others[0])
    bpy.ops.reeb_parts.show_original()
    bpy.ops.reeb_parts.show_pieces()
    activate(obj)
    bpy.ops.reeb_parts.separate(**KEEP)
    assert curve in bpy.data.objects[:]
    assert len(pieces_of()) == len(pieces)
    assert all(piece.type == "MESH" for piece in pieces_of())

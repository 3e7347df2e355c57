# SPDX-License-Identifier: GPL-3.0-or-later
"""Parts that are longer than the printer's bed are cut further: closed, together what they were, and joined alike."""

import sys

import bpy
import numpy as np
import pytest
import shapes
from pieces import is_sound, volume
from snapshot import activate, check_undo

KEEP = {"hide": False, "center": False}


def pieces(name="Tree"):
    return [o for o in bpy.data.collections[f"Parts of {name}"].objects if "reeb_parts_number" in o]


def extents(piece):
    """In millimeters, along the axes of the world and along its own, longest first."""
    points = np.array([piece.matrix_world @ vertex.co for vertex in piece.data.vertices]) * 1000
    area = np.zeros(len(points))
    for polygon in piece.data.polygons:
        area[list(polygon.vertices)] += polygon.area / len(polygon.vertices)
    out = points - np.average(points, axis=0, weights=area)
    _, axes = np.linalg.eigh((out * area[:, None]).T @ out)
    return [np.sort(np.ptp(some, axis=0))[::-1] for some in (points, points @ axes)]


@pytest.mark.parametrize(("bed", "count"), [((2100.0, 2100.0, 2100.0), 3), ((7000.0, 3000.0, 3000.0), 1),
                                            ((1100.0, 1100.0, 3100.0), 8)])
def test_each_piece_fits(make, bed, count):
    """Two balls six meters from tip to tip, each two meters wide."""
    obj = make(shapes.dumbbell(), "Tree")
    obj.rotation_euler = (0.3, 0.2, 0.1)
    bpy.context.view_layer.update()
    bpy.ops.reeb_parts.decompose(n_parts=1)
    bpy.ops.reeb_parts.separate(fit_bed=True, bed=bed, **KEEP)
    assert len(pieces()) == count
    assert all(is_sound(piece) for piece in pieces())
    assert sum(volume(piece.data) for piece in pieces()) == pytest.approx(volume(obj.data), rel=1e-5)
    if count < 8:  # of a quarter of a ball, the axes are others than those of the cuts
        assert all(min((extent - np.sort(bed)[::-1]).max() for extent in extents(piece)) < 1 for piece in pieces())
    assert {piece["reeb_parts_number"] for piece in pieces()} == {1}
    names = ["Tree Part 01"] if count == 1 else [f"Tree Part 01 {i + 1}" for i in range(count)]
    assert sorted(piece.name for piece in pieces()) == sorted(names)


def test_cuts_of_the_bed_are_joined_as_all_others(make):
    """Also where a cut between parts is divided by one across them: both sides stay alike."""
    obj = make(shapes.dumbbell(), "Tree")
    bpy.ops.reeb_parts.decompose(n_parts=2)
    bpy.ops.reeb_parts.separate(fit_bed=True, bed=(2500.0, 2500.0, 1100.0), joints="ROUND", joint_clearance=0.0, **KEEP)
    cuts = obj.reeb_parts_made.cuts
    assert len(pieces()) > 2
    assert {(cut.low, cut.high) for cut in cuts} == {(1, 1), (1, 2), (2, 2)}
    assert sum(cut.count > 0 for cut in cuts) >= len(pieces()) - 1
    assert all(is_sound(piece) for piece in pieces())
    assert sum(volume(piece.data) for piece in pieces()) == pytest.approx(volume(obj.data), rel=5e-3)


def test_cuts_through_a_triangular_bar_are_joined(make):
    """The cap of each is one triangle."""
    make(shapes.prism(3), "Tree")
    bpy.ops.reeb_parts.decompose(n_parts=1)
    with np.errstate(all="raise"):
        bpy.ops.reeb_parts.separate(fit_bed=True, bed=(1500.0, 1500.0, 1500.0), joints="ROUND", **KEEP)
    cuts = bpy.data.objects["Tree"].reeb_parts_made.cuts
    assert len(pieces()) == len(cuts) + 1 > 3
    assert [cut.count for cut in cuts] == [1] * len(cuts)
    assert all(is_sound(piece) for piece in pieces())


def test_what_the_mesh_carries_goes_on(obj):
    obj.shape_key_add(name="Basis")
    key = obj.shape_key_add(name="Fat")
    for point in key.data:
        point.co *= 2
    obj.vertex_groups.new(name="Arm").add(range(len(obj.data.vertices)), 0.25, "REPLACE")
    obj.data.uv_layers.new(name="Map")
    bpy.ops.reeb_parts.decompose(n_parts=2)
    bpy.ops.reeb_parts.separate(fit_bed=True, bed=(1500.0, 1500.0, 1500.0), **KEEP)
    assert len(pieces()) > 2
    for piece in pieces():
        basis, fat = (np.array([p.co for p in piece.data.shape_keys.key_blocks[k].data]) for k in ("Basis", "Fat"))
        assert fat == pytest.approx(2 * basis, abs=1e-4)
        assert piece.vertex_groups.keys() == ["Arm"]
        assert piece.data.uv_layers.keys() == ["Map"]
        assert is_sound(piece)


def test_open_parts_stay_whole_and_it_is_said(make, capfd):
    make(shapes.flat_grid(20, 20, 0.1), "Tree")
    bpy.ops.reeb_parts.decompose(n_parts=1)
    bpy.ops.reeb_parts.separate(fit_bed=True, bed=(1000.0, 1000.0, 1000.0), **KEEP)
    assert len(pieces()) == 1
    assert "Warning: Not closed, so not cut to fit the bed: Part 01" in capfd.readouterr().out


def test_a_bed_in_other_units_changes_nothing(obj):
    bpy.ops.reeb_parts.decompose(n_parts=2)
    with pytest.raises(RuntimeError, match="There would be more than 200 pieces"):
        bpy.ops.reeb_parts.separate(fit_bed=True, bed=(2.0, 2.0, 2.0), **KEEP)
    assert "Parts of Tree" not in bpy.data.collections
    assert [mesh.name for mesh in bpy.data.meshes] == ["Tree"]


def test_a_second_run_replaces_all_pieces(make):
    obj = make(shapes.dumbbell(), "Tree")
    bpy.ops.reeb_parts.decompose(n_parts=2)
    bpy.ops.reeb_parts.separate(fit_bed=True, bed=(1500.0, 2100.0, 2100.0), **KEEP)
    assert len(pieces()) > 2
    activate(obj)
    bpy.ops.reeb_parts.separate(**KEEP)
    assert len(pieces()) == len(bpy.data.collections["Parts of Tree"].objects) == 2


def test_undo(obj):
    bpy.ops.reeb_parts.decompose(n_parts=2)
    check_undo(lambda: bpy.ops.reeb_parts.separate(fit_bed=True, bed=(1500.0, 1500.0, 1500.0), joints="ROUND"))


@pytest.mark.parametrize(("name", "value"), [("fit_bed", True), ("joints", "ROUND")])
def test_in_the_window_there_is_progress_however_few_faces_there_are(package, obj, result, name, value):
    """Of an animal of 3,000 vertices, cut to fit a bed and joined, Blender stood still for five seconds."""
    is_long, style = sys.modules[f"{package}.scene.stepped"].is_long, bpy.context.scene.reeb_parts_use
    assert not is_long([obj], style)
    setattr(style, name, value)
    assert is_long([obj], style)

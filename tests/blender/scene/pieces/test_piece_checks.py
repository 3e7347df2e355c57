# SPDX-License-Identifier: GPL-3.0-or-later
"""What is wrong with a piece is told, selected and repaired."""

import importlib
from dataclasses import replace

import bmesh
import bpy
import numpy as np
import pytest
import shapes
from bulk import read
from pieces import KEEP, borders, caps_of, pieces_of, volume
from snapshot import activate, check_undo


@pytest.fixture
def checks(package):
    """The module that checks pieces."""
    return importlib.import_module(f"{package}.scene.pieces.piece_checks")


def test_what_is_enclosed_does_not_depend_on_which_corner_of_a_face_is_first(make, checks):
    """Booleans turn quads round that they leave whole, and Blender folds a bent one along its other diagonal then."""
    octants = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)], np.float64)
    points = octants + 0.2 * np.random.default_rng(0).random((8, 3))
    faces = np.array([[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]])
    bent = [make((points, np.roll(faces, turn, axis=1)), "Bent").data for turn in (0, 1)]
    folded = [volume(mesh) for mesh in bent]
    assert abs(folded[0] - folded[1]) > 1e-3
    found = [checks.check(mesh, np.eye(3))[0].volume for mesh in bent]
    assert found[0] == pytest.approx(found[1], rel=1e-6)
    # Of the two ways to fold it each quad is as far from one as from the other.
    assert found[0] == pytest.approx(np.mean(folded), rel=1e-6)


def test_a_check_tells_what_is_wrong_with_a_mesh(make, checks):
    """Two octahedra of volume 4/3 that run into each other, a face taken off, a fin, and all of it turned round."""
    octahedron = shapes.octahedron()
    sound = make(octahedron)
    found, faults = checks.check(sound.data, np.eye(3))
    assert (found.sound, found.open_edges, found.branching_edges, found.crossing_faces) == (True, 0, 0, 0)
    assert found.volume == pytest.approx(4 / 3)
    assert found.thinnest == pytest.approx(2 / np.sqrt(3), rel=1e-4)  # between opposite faces
    assert faults.thin.sum() == 1
    assert checks.check(sound.data, 10 * np.eye(3))[0].volume == pytest.approx(4000 / 3)
    sound.data.flip_normals()
    assert checks.check(sound.data, np.eye(3))[0].inside_out
    crossed = make(shapes.together(octahedron, shapes.moved(octahedron, (0.4, 0.3, 0.2))), "Crossed")
    found, faults = checks.check(crossed.data, np.eye(3))
    assert found.crossing_faces == found.own_crossing_faces == faults.crossing.sum() > 4
    opened = make((octahedron[0], octahedron[1][1:]), "Opened")
    found, faults = checks.check(opened.data, np.eye(3))
    assert (found.open_edges, found.volume, found.sound, faults.open.sum()) == (3, None, False, 3)
    turned = make((octahedron[0], np.concatenate([octahedron[1][:1, ::-1], octahedron[1][1:]])), "Turned")
    found, faults = checks.check(turned.data, np.eye(3))
    assert (found.contrary_edges, found.volume, found.sound, faults.contrary.sum()) == (3, None, False, 4)
    assert (found.open_edges, found.branching_edges, found.inside_out) == (0, 0, False)
    finned = make(shapes.with_fin(octahedron), "Finned")
    found, faults = checks.check(finned.data, np.eye(3))
    assert (found.branching_edges, faults.branching.sum(), found.open_edges) == (1, 3, 2)


def test_pieces_are_checked_and_what_is_wrong_can_be_selected_and_repaired(obj):
    bpy.ops.reeb_parts.decompose()
    bpy.ops.reeb_parts.separate(caps=False)
    piece = pieces_of()[0]
    activate(piece)
    assert "reeb_parts_check" not in piece
    bpy.ops.reeb_parts.check_pieces()
    rim = sum(count == 1 for count in np.bincount(read(piece.data.loops, "edge_index", np.int32)))
    bpy.ops.reeb_parts.select_faults(kind="OPEN")
    assert bpy.context.mode == "EDIT_MESH"
    bpy.ops.object.mode_set(mode="OBJECT")
    assert 0 < read(piece.data.polygons, "select", bool).sum() <= rim
    with pytest.raises(RuntimeError, match="nothing of the kind"):
        bpy.ops.reeb_parts.select_faults(kind="CROSSING")
    check_undo(bpy.ops.reeb_parts.repair_piece)
    piece = pieces_of()[0]
    assert borders(piece.data) == (set(), 0)
    with pytest.raises(RuntimeError, match="Nothing has to be repaired"):
        bpy.ops.reeb_parts.repair_piece()
    piece.data.flip_normals()
    bpy.ops.reeb_parts.repair_piece()
    assert volume(piece.data) > 0


def turn(mesh, mask):
    """Turn some faces round."""
    bm = bmesh.new()
    bm.from_mesh(mesh)
    bm.faces.ensure_lookup_table()
    bmesh.ops.reverse_faces(bm, faces=[bm.faces[i] for i in np.flatnonzero(mask)])
    bm.to_mesh(mesh)
    bm.free()


@pytest.mark.parametrize("share", [0.3, 0.7])
@pytest.mark.parametrize("closed", [True, False])
def test_faces_that_look_both_ways_are_found_and_repaired(obj, checks, capfd, share, closed):
    bpy.ops.reeb_parts.decompose()
    bpy.ops.reeb_parts.separate(caps=True)
    piece = pieces_of()[0]
    activate(piece)
    size = volume(piece.data)
    if not closed:
        bm = bmesh.new()
        bm.from_mesh(piece.data)
        bm.faces.ensure_lookup_table()
        bmesh.ops.delete(bm, geom=[bm.faces[0]], context="FACES_ONLY")
        bm.to_mesh(piece.data)
        bm.free()
    height = read(piece.data.polygons, "center", np.float32, 3)[:, 2]
    turn(piece.data, height > np.quantile(height, 1 - share))
    capfd.readouterr()
    bpy.ops.reeb_parts.check_pieces()
    found = checks.kept(piece)
    assert found.contrary_edges
    assert not found.sound
    assert "1 of 1 part has faces that look inwards" in capfd.readouterr().out
    bpy.ops.reeb_parts.select_faults(kind="CONTRARY")
    bpy.ops.object.mode_set(mode="OBJECT")
    assert found.contrary_edges <= read(piece.data.polygons, "select", bool).sum() <= 2 * found.contrary_edges
    check_undo(bpy.ops.reeb_parts.repair_piece)
    piece = pieces_of()[0]
    assert checks.kept(piece).sound
    assert borders(piece.data) == (set(), 0)
    assert volume(piece.data) == pytest.approx(size, rel=1e-3)


@pytest.mark.parametrize("inside_out", [False, True])
def test_a_repaired_piece_looks_outwards_however_many_faces_cross(package, make, checks, monkeypatch, inside_out):
    """Of faces that nearly lie on each other, others are found to cross once they are turned: a piece that looked
    outwards was turned for that, or one that looked inwards was not.
    """
    repairs = importlib.import_module(f"{package}.scene.pieces.piece_repairs")
    octahedron = shapes.octahedron()
    obj = make(shapes.together(octahedron, shapes.moved(octahedron, (0.4, 0.3, 0.2))), "Crossed")
    if inside_out:
        obj.data.flip_normals()
    check = checks.check

    def found_otherwise(mesh, stretch):
        found, faults = check(mesh, stretch)
        more = 0 if found.inside_out else 3
        return replace(found, crossing_faces=found.crossing_faces + more), faults

    monkeypatch.setattr(checks, "check", found_otherwise)
    repairs.repair(obj, np.eye(3))
    assert not check(obj.data, np.eye(3))[0].inside_out


def test_what_refers_to_a_mesh_refers_to_the_repaired_one(obj):
    """A fake user, or a property, was taken for another object that shares the mesh; keys got another name."""
    obj.shape_key_add(name="Basis")
    obj.shape_key_add(name="Fat").value = 0.3
    bpy.ops.reeb_parts.decompose()
    bpy.ops.reeb_parts.separate(**KEEP)
    piece = pieces_of()[0]
    activate(piece)
    piece.data.use_fake_user, piece.data.name, piece.data.shape_keys.name = True, "Mine", "My keys"
    piece.data["own"], bpy.context.scene["mine"] = 1, piece.data
    former, n_meshes = piece.data.session_uid, len(bpy.data.meshes)
    assert bpy.ops.reeb_parts.repair_piece() == {"FINISHED"}
    assert piece.data.session_uid != former
    assert bpy.context.scene["mine"] == piece.data
    assert (piece.data.name, piece.data.shape_keys.name, piece.data["own"]) == ("Mine", "My keys", 1)
    assert piece.data.use_fake_user
    assert len(bpy.data.meshes) == n_meshes


def test_all_selected_pieces_are_repaired(obj, checks):
    bpy.ops.reeb_parts.decompose()
    bpy.ops.reeb_parts.separate(caps=True)
    for piece in pieces_of():
        piece.data.flip_normals()
        piece.select_set(True)
    bpy.context.view_layer.objects.active = pieces_of()[0]
    bpy.ops.reeb_parts.check_pieces()
    assert not any(checks.kept(piece).sound for piece in pieces_of())
    assert bpy.ops.reeb_parts.repair_piece() == {"FINISHED"}
    assert all(checks.kept(piece).sound for piece in pieces_of())


def test_of_what_cannot_be_repaired_only_what_is_wrong_is_named(obj):
    """With sound pieces among them it was said of all that nothing can be repaired."""
    bpy.ops.reeb_parts.decompose()
    bpy.ops.reeb_parts.separate(caps=True)
    first, *others = pieces_of()
    bm = bmesh.new()
    bm.from_mesh(first.data)
    a, b = bm.edges[:][0].verts  # of a fin, which no step of the repair takes off
    bm.faces.new([a, b, bm.verts.new((0.0, 0.0, 9.0))])
    bm.to_mesh(first.data)
    bm.free()
    for piece in (first, *others):
        piece.select_set(True)
    bpy.context.view_layer.objects.active = first
    with pytest.raises(RuntimeError, match=f"Nothing of {first.name} can be repaired"):
        bpy.ops.reeb_parts.repair_piece()


@pytest.mark.parametrize("share", [0.3, 1.0])
@pytest.mark.parametrize("style", [{"cut": "FACES"}, {}, {"joints": "ROUND"}])
def test_pieces_of_a_model_with_turned_faces_are_those_of_the_model_without(rich, checks, capfd, style, share):
    """Faces of pieces with closed holes look outwards, also if none of the model does; corners keep what they carry."""
    bpy.ops.reeb_parts.decompose()
    bpy.ops.reeb_parts.separate(caps=True, **KEEP, **style)
    want = [(volume(piece.data), corners_of(piece.data)) for piece in pieces_of()]
    activate(rich)
    bpy.ops.reeb_parts.clear()
    turn(rich.data, np.random.default_rng(0).random(len(rich.data.polygons)) < share)
    bpy.ops.reeb_parts.decompose()
    capfd.readouterr()
    bpy.ops.reeb_parts.separate(caps=True, **KEEP, **style)
    assert "look inwards" not in capfd.readouterr().out
    found = pieces_of()
    assert len(found) == len(want)
    for piece, (size, corners) in zip(found, want, strict=True):
        assert checks.kept(piece).sound
        assert volume(piece.data) == pytest.approx(size, rel=1e-3)
        normals = read(piece.data.corner_normals, "vector", np.float32, 3)
        own = np.repeat(read(piece.data.polygons, "normal", np.float32, 3),
                        read(piece.data.polygons, "loop_total", np.int32), axis=0)
        assert ((normals * own).sum(axis=1) > 0).all()
        if style.get("cut") == "FACES":
            assert corners_of(piece.data) == corners


def corners_of(mesh):
    """What each corner of a face that is no cap has in the first map, by the places of its face and its vertex."""
    cap = caps_of(mesh)
    found = {}
    for face in mesh.polygons:
        for corner in face.loop_indices if not cap[face.index] else ():
            place = mesh.vertices[mesh.loops[corner].vertex_index].co
            found[tuple(face.center.to_tuple(4) + place.to_tuple(4))] = mesh.uv_layers[0].uv[corner].vector.to_tuple(5)
    return found


def test_what_crosses_itself_in_the_model_is_told_apart(make, checks, capfd):
    """Two balls of one mesh, the second one small and half in the first; the cut is elsewhere, and sound."""
    vertices, faces = shapes.icosphere(3)
    small, rim = 0.2 * vertices + [0, 0, 1.0], len(vertices)
    make((np.concatenate([vertices, small]), np.concatenate([faces, faces + rim])))
    bpy.ops.reeb_parts.decompose(n_parts=3)
    capfd.readouterr()
    bpy.ops.reeb_parts.separate(caps=True)
    found = {piece.name: checks.kept(piece) for piece in pieces_of()}
    crossing = [one for one in found.values() if one.crossing_faces]
    said = capfd.readouterr().out
    assert all(one.as_model for one in crossing)
    assert ("as the model does there" in said) == bool(crossing)
    assert "not closed or cross" not in said
    made = bpy.data.meshes.new("Both")
    made.from_pydata(np.concatenate([vertices, small]).tolist(), [], np.concatenate([faces, faces + rim]).tolist())
    both = checks.check(made, np.eye(3))[0]
    assert both.crossing_faces == both.own_crossing_faces > 0
    made.attributes.new("reeb_cap", "INT", "FACE").data.foreach_set("value", np.ones(2 * len(faces), np.int32))
    assert checks.check(made, np.eye(3))[0].own_crossing_faces == 0


@pytest.mark.parametrize("style", [{"caps": True}, {"joints": "ROUND"}, {"fit_bed": True, "bed": [9999.0] * 3}])
def test_with_holes_closed_the_report_tells_the_truth(obj, capfd, style):
    bpy.ops.reeb_parts.decompose()
    bpy.ops.reeb_parts.separate(**style)
    count = len(pieces_of())
    assert f"{count} parts are closed and do not cross themselves" in capfd.readouterr().out

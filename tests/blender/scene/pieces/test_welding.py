# SPDX-License-Identifier: GPL-3.0-or-later
"""Pieces of models with split vertices: closed as those of the same model without, and nothing is lost."""

import importlib

import bpy
import numpy as np
import pytest
import shapes
from bulk import read
from pieces import closed_volume, is_sound, pieces_of
from results import numbers
from snapshot import activate


def dressed(obj):
    """Smooth faces, a map, colors, weights and a shape key, all as the places of the corners say."""
    mesh = obj.data
    points = read(mesh.vertices, "co", np.float32, 3)
    corner = read(mesh.loops, "vertex_index", np.int32)
    face = np.repeat(np.arange(len(mesh.polygons)), read(mesh.polygons, "loop_total", np.int32))
    mesh.polygons.foreach_set("use_smooth", np.ones(len(mesh.polygons), bool))
    mesh.uv_layers.new(name="Map").data.foreach_set("uv", (points[corner, :2] + face[:, None]).ravel())
    mesh.attributes.new("Paint", "FLOAT_COLOR", "POINT").data.foreach_set("color", np.tile(points[:, :1], 4).ravel())
    group = obj.vertex_groups.new(name="Arm")
    for index, height in enumerate(points[:, 2].round(3).tolist()):
        group.add([index], abs(height) % 1.0, "REPLACE")
    obj.shape_key_add(name="Basis")
    obj.shape_key_add(name="Fat").data.foreach_set("co", (points * 1.2).ravel())
    return obj


def at_corners(obj, mesh, faces):
    """What the corners of some faces of a mesh carry, (c, k)."""
    corner = np.concatenate([np.arange(f.loop_start, f.loop_start + f.loop_total)
                             for f in (mesh.polygons[i] for i in faces)])
    vertex = read(mesh.loops, "vertex_index", np.int32)[corner]
    weight = np.array([sum(entry.weight for entry in v.groups if obj.vertex_groups[entry.group].name == "Arm")
                       for v in mesh.vertices], np.float32)
    return np.concatenate([
        read(mesh.vertices, "co", np.float32, 3)[vertex], read(mesh.corner_normals, "vector", np.float32, 3)[corner],
        read(mesh.uv_layers["Map"].data, "uv", np.float32, 2)[corner], weight[vertex, None],
        read(mesh.attributes["Paint"].data, "color", np.float32, 4)[vertex],
        read(mesh.shape_keys.key_blocks["Fat"].data, "co", np.float32, 3)[vertex]], axis=1)


def separate(obj, **how):
    activate(obj)
    bpy.ops.reeb_parts.decompose()
    assert bpy.ops.reeb_parts.separate(center=False, **how) == {"FINISHED"}
    return pieces_of(obj.name)


@pytest.mark.parametrize("cut", ["SMOOTH", "FACES"])
def test_pieces_are_closed_and_joined_as_without_seams(make, tree, cut):
    whole = separate(make(tree), caps=True, joints="ROUND", cut=cut)
    split = separate(make(shapes.unjoined(tree), "Split"), caps=True, joints="ROUND", cut=cut)
    assert len(whole) == len(split) > 3
    assert all(is_sound(piece) for piece in split)
    for one, other in zip(whole, split, strict=True):
        assert closed_volume(other.data) == pytest.approx(closed_volume(one.data), rel=1e-3)
        assert len(other.data.vertices) == pytest.approx(len(one.data.vertices), rel=0.02)


@pytest.mark.parametrize("custom", [False, True])
def test_nothing_that_faces_carry_is_lost(make, tree, custom):
    obj = dressed(make(shapes.unjoined(tree)))
    if custom:
        rng = np.random.default_rng(0)
        turned = read(obj.data.vertices, "normal", np.float32, 3) + rng.normal(0, 0.2, (len(obj.data.vertices), 3))
        obj.data.normals_split_custom_set_from_vertices(turned.tolist())
    pieces = separate(obj, caps=True, cut="FACES")
    of_face = numbers(obj.data)
    for piece in pieces:
        mine = np.flatnonzero(of_face == piece["reeb_parts_number"]).tolist()
        assert is_sound(piece)
        before, now = at_corners(obj, obj.data, mine), at_corners(piece, piece.data, range(len(mine)))
        np.testing.assert_allclose(now, before, atol=1e-3 if custom else 1e-5)


def test_without_caps_vertices_stay_split(make, tree):
    obj = make(shapes.unjoined(tree))
    assert sum(len(piece.data.vertices) for piece in separate(obj, caps=False)) == len(obj.data.vertices)


@pytest.mark.parametrize("what", ["shape", "weight", "color"])
def test_vertices_that_differ_stay_apart_and_are_counted(make, tree, package, what):
    part_meshes = importlib.import_module(f"{package}.scene.pieces.part_meshes")
    obj = dressed(make(shapes.unjoined(tree)))
    mesh = obj.data
    if what == "shape":
        mesh.shape_keys.key_blocks["Fat"].data[0].co.x += 0.5
    elif what == "weight":
        obj.vertex_groups.new(name="Other").add([0], 0.5, "REPLACE")
    else:
        mesh.attributes["Paint"].data[0].color = (9, 9, 9, 9)
    made = part_meshes.piece_meshes(mesh, np.ones(len(mesh.polygons), np.int64), [1], close=True)
    # Vertex 0 comes first, so that it is the one that the others at its place would be.
    at = np.linalg.norm(read(mesh.vertices, "co", np.float32, 3) - mesh.vertices[0].co[:], axis=1) < 1e-6
    assert made.n_apart == at.sum() - 1 > 1
    assert len(made.meshes[1].vertices) == len(tree.vertices) + made.n_apart


def test_faces_that_lie_on_each_other_stay_two(make, package):
    """A sheet with a front and a back of its own, all faces apart: joined, faces would be there twice."""
    part_meshes = importlib.import_module(f"{package}.scene.pieces.part_meshes")
    sheet = shapes.unjoined(shapes.flat_grid(4, 4))
    obj = make(shapes.together(sheet, shapes.inside_out(sheet)))
    n_faces = len(obj.data.polygons)
    mesh = part_meshes.piece_meshes(obj.data, np.ones(n_faces, np.int64), [1], close=True).meshes[1]
    assert len(mesh.polygons) == n_faces
    assert not mesh.validate()


def test_separate_says_what_cannot_be_joined(make, tree, capfd):
    obj = dressed(make(shapes.unjoined(tree)))
    for index in range(0, len(obj.data.vertices), 7):
        obj.data.attributes["Paint"].data[index].color = (index, 0, 0, 1)
    separate(obj, caps=True)
    assert "cannot be joined with them: parts stay open there" in capfd.readouterr().out


def test_marks_of_either_edge_stay(make, tree, package):
    part_meshes = importlib.import_module(f"{package}.scene.pieces.part_meshes")
    obj = make(shapes.unjoined(tree))
    rng = np.random.default_rng(0)
    creases = np.where(rng.random(len(obj.data.edges)) < 0.1, rng.random(len(obj.data.edges)), 0).astype(np.float32)
    obj.data.attributes.new("crease_edge", "FLOAT", "EDGE").data.foreach_set("value", creases)
    obj.data.edges.foreach_set("use_seam", creases > 0.5)
    whole = np.ones(len(obj.data.polygons), np.int64)
    mesh = part_meshes.piece_meshes(obj.data, whole, [1], close=True).meshes[1]

    def most(mesh, key):
        """The largest value of the edges at each place."""
        middle = read(mesh.vertices, "co", np.float32, 3)[read(mesh.edges, "vertices", np.int32, 2)].mean(axis=1)
        values = (read(mesh.attributes[key].data, "value", np.float32) if key == "crease_edge"
                  else read(mesh.edges, key, bool))
        found = {}
        for place, value in zip(map(tuple, middle.round(5).tolist()), values.tolist(), strict=True):
            found[place] = max(found.get(place, 0), value)
        return found

    assert 2 * len(mesh.edges) == len(obj.data.edges)
    assert most(mesh, "crease_edge") == most(obj.data, "crease_edge")
    assert most(mesh, "use_seam") == most(obj.data, "use_seam")


def test_sculpted_vertices_stay_split_and_are_counted(make, tree, package):
    part_meshes = importlib.import_module(f"{package}.scene.pieces.part_meshes")
    obj = make(shapes.unjoined(tree))
    obj.modifiers.new("Multires", "MULTIRES")
    made = part_meshes.piece_meshes(obj.data, np.ones(len(obj.data.polygons), np.int64), [1], close=True)
    assert len(made.meshes[1].vertices) == len(obj.data.vertices)
    assert made.n_apart == len(obj.data.vertices) - len(tree.vertices)


@pytest.mark.parametrize("cut", ["SMOOTH", "PLANAR", "FACES"])
def test_a_flat_model_with_multires_is_separated(make, cut):
    """No cut runs smoothly where every edge is a border."""
    shape = shapes.dumbbell(40, 16)
    make(shapes.unjoined(shape), "Tree")
    obj = bpy.data.objects["Tree"]
    modifier = obj.modifiers.new("Multires", "MULTIRES")
    bpy.ops.object.multires_subdivide(modifier=modifier.name, mode="SIMPLE")
    bpy.ops.reeb_parts.decompose(n_parts=3)
    assert bpy.ops.reeb_parts.separate(cut=cut, caps=False, hide=False) == {"FINISHED"}
    assert sum(len(piece.data.polygons) for piece in pieces_of(obj.name)) >= len(shape.faces)

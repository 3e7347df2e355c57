# SPDX-License-Identifier: GPL-3.0-or-later
"""Pieces whose holes are closed: caps fit together, lie inside the model and cross nothing."""

import bmesh
import bpy
import numpy as np
import pytest
import shapes
from bulk import read
from diagonal import some
from mathutils.bvhtree import BVHTree
from pieces import KEEP, WHOLE, borders, caps_of, pieces_of, same_places, volume
from results import numbers as numbers_of
from snapshot import activate


def closed_pieces(separate, mesh, numbers, wanted):
    """Pieces cut along faces, their holes filled, and how many edges stayed open."""
    made = separate.piece_meshes(mesh, numbers, wanted, close=True)
    return made.meshes, made.left_open


@pytest.mark.parametrize("seed", some(0, 1, 2, 3))
def test_closed_pieces_have_no_border_that_was_not_there(shape, separate, seed):
    """Parts around random faces: ragged, with cuts that end on borders, meet, and touch in a vertex."""
    before, bad = borders(shape.data)
    assert bad == 0
    rng = np.random.default_rng(seed)
    centers = read(shape.data.polygons, "center", np.float32, 3)
    centers = centers + 0.05 * rng.standard_normal(centers.shape)
    seeds = centers[rng.choice(len(centers), 12, replace=False)]
    numbers = 1 + np.linalg.norm(centers[:, None] - seeds[None], axis=2).argmin(axis=1)
    meshes, left_open = closed_pieces(separate, shape.data, numbers, range(1, 13))
    assert left_open == 0
    for number, mesh in meshes.items():
        assert len(mesh.polygons) - caps_of(mesh).sum() == (numbers == number).sum()
        after, bad = borders(mesh)
        assert after <= before
        assert bad == 0


def test_a_tube_cut_along_becomes_two_bodies(make, separate):
    """The cuts run from border to border: each half is closed with its stretches of the borders."""
    tube = make(shapes.cylinder(24, 16))
    halves = 1 + (read(tube.data.polygons, "center", np.float32, 3)[:, 0] > 0)
    meshes, left_open = closed_pieces(separate, tube.data, halves, (1, 2))
    assert [borders(mesh) for mesh in meshes.values()] == [(set(), 0)] * 2
    assert left_open == 0


def test_single_faces_can_be_closed(make, separate):
    """A part of one triangle has no room for a second face between the same corners."""
    obj = make(shapes.octahedron())
    meshes, left_open = closed_pieces(separate, obj.data, np.arange(8), range(8))
    assert left_open == 0
    assert [borders(mesh) for mesh in meshes.values()] == [(set(), 0)] * 8


def test_a_hole_where_three_faces_meet_is_left_open_and_counted(make, separate):
    """Beside the fin there is no telling which of the faces goes on around the hole."""
    shape = shapes.with_fin(shapes.octahedron())
    a, b, _ = shape.faces[0]
    taken = next(i for i, face in enumerate(shape.faces) if a in face and b not in face)
    obj = make(shape)
    numbers = np.ones(len(shape.faces), np.int64)
    numbers[taken] = 2
    meshes, left_open = closed_pieces(separate, obj.data, numbers, (1, 2))
    assert left_open == 3
    assert len(meshes[1].polygons) == len(shape.faces) - 1
    assert borders(meshes[2]) == (set(), 0)


def test_pieces_that_meet_in_rings_fit_together(make):
    """Both sides of a cut are closed by the same surface: together, they enclose what the mesh encloses."""
    obj = make(shapes.dumbbell())
    bpy.ops.reeb_parts.decompose(n_parts=3)
    bpy.ops.reeb_parts.separate(caps=True, **KEEP)
    volumes = [volume(piece.data) for piece in pieces_of()]
    assert min(volumes) > 0
    assert sum(volumes) == pytest.approx(volume(obj.data), rel=1e-5)


@pytest.mark.parametrize("count", [3, 4, 5])
@pytest.mark.parametrize("bent", [0.0, 0.3])
def test_slices_that_meet_in_two_places_fit_together(make, separate, count, bent):
    """As of an orange: each stretch between the poles is closed alike on both sides."""
    vertices, faces = shapes.icosphere(3)
    obj = make((vertices + bent * np.sin(3 * vertices[:, [1, 2, 0]]), faces))
    x, y, z = vertices[faces].mean(axis=1).T
    angle = (np.arctan2(y, x) + 0.4 * np.sin(4 * z)) % (2 * np.pi)
    numbers = 1 + (angle * count / (2 * np.pi)).astype(int)
    meshes, left_open = closed_pieces(separate, obj.data, numbers, range(1, count + 1))
    assert left_open == 0
    volumes = [volume(mesh) for mesh in meshes.values()]
    assert min(volumes) > 0
    assert sum(volumes) == pytest.approx(volume(obj.data), rel=1e-4)


def test_caps_are_marked_and_have_the_part_material(rich):
    slots = read(rich.data.polygons, "material_index", np.int32)
    bpy.ops.reeb_parts.decompose()
    numbers = numbers_of(rich.data)
    bpy.ops.reeb_parts.separate(caps=True, **KEEP, **WHOLE)
    for piece in pieces_of():
        mine = numbers == piece["reeb_parts_number"]
        cap = caps_of(piece.data)
        assert cap[: mine.sum()].tolist() == [0] * mine.sum()
        assert cap[mine.sum() :].tolist() == [1] * (len(cap) - mine.sum()) != []
        assert set(read(piece.data.polygons, "material_index", np.int32)[cap == 1]) <= set(slots[mine])
        corners = np.repeat(cap, read(piece.data.polygons, "loop_total", np.int32)) == 1
        places = read(piece.data.uv_layers["Map"].data, "uv", np.float32, 2)
        assert places[corners, 0].min() >= np.ceil(places[~corners, 0].max()) - 1e-6


def turning(piece):
    """By how much the rims of a piece turn, in radians."""
    bm = bmesh.new()
    bm.from_mesh(piece.data)
    angle = 0.0
    for vertex in bm.verts:
        ends = [edge.other_vert(vertex).co for edge in vertex.link_edges if edge.is_boundary]
        if len(ends) == 2:
            angle += (vertex.co - ends[0]).angle(ends[1] - vertex.co)
    bm.free()
    return angle


def test_smooth_cuts_divide_what_faces_leave_ragged(obj):
    """What rims turn besides going round is at most a quarter of what it is along faces; pieces are still closed."""
    bpy.ops.reeb_parts.decompose()
    turned = {}
    for cut in ("FACES", "SMOOTH"):
        activate(obj)
        bpy.ops.reeb_parts.separate(cut=cut, caps=False, **KEEP)
        turned[cut] = sum(map(turning, pieces_of()))
    round_ = 2 * np.pi * 2 * (len(pieces_of()) - 1)
    assert turned["SMOOTH"] - round_ < 0.25 * (turned["FACES"] - round_)
    activate(obj)
    bpy.ops.reeb_parts.separate(caps=True, **KEEP)
    assert [borders(piece.data) for piece in pieces_of()] == [(set(), 0)] * len(pieces_of())
    assert sum(volume(piece.data) for piece in pieces_of()) == pytest.approx(volume(obj.data), rel=1e-5)


def test_smooth_cuts_through_quads_and_larger_faces(make, separate):
    """Quads, a grid bent to a tube, and faces with a corner turned in, which are made triangles where cut."""
    vertices, faces = shapes.cylinder(24, 16)
    obj = make((vertices, faces))
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.ops.mesh.select_all(action="SELECT")
    bpy.ops.mesh.tris_convert_to_quads()
    bpy.ops.object.mode_set(mode="OBJECT")
    centers = read(obj.data.polygons, "center", np.float32, 3)
    size = np.ptp(centers, axis=0)
    along = np.argmax(size)
    wave = centers[:, along] + 0.1 * size[along] * np.sign(np.sin(1e4 * centers[:, (along + 1) % 3]))
    numbers = 1 + (wave > wave.mean())
    made = separate.piece_meshes(obj.data, numbers, (1, 2), smooth=np.eye(3))
    area = sum(polygon.area for mesh in made.meshes.values() for polygon in mesh.polygons)
    assert area == pytest.approx(sum(polygon.area for polygon in obj.data.polygons), rel=1e-4)
    before = {frozenset(edge) for edge in borders(obj.data)[0]}
    joint = [borders(mesh)[0] for mesh in made.meshes.values()]
    assert joint[0] - before == joint[1] - before  # both sides have the same rim
    assert len(made.meshes[1].polygons) + len(made.meshes[2].polygons) > len(obj.data.polygons)


def crossings(mesh):
    """How many pairs of triangles without a common corner cross."""
    bm = bmesh.new()
    bm.from_mesh(mesh)
    bmesh.ops.triangulate(bm, faces=bm.faces[:])
    bm.faces.ensure_lookup_table()
    tree = BVHTree.FromBMesh(bm)
    corners = [{vertex.index for vertex in face.verts} for face in bm.faces]
    bm.free()
    return sum(a < b and not corners[a] & corners[b] for a, b in tree.overlap(tree))


@pytest.mark.parametrize("smooth", [None, np.eye(3)])
@pytest.mark.parametrize("wave", [0.35, 0.7])
def test_bent_rims_are_closed_by_smooth_surfaces_inside(make, separate, wave, smooth):
    """Cuts up and down around a ball: no cap leaves it or crosses itself, and both sides have the same."""
    vertices, faces = shapes.icosphere(4)
    obj = make((vertices, faces))
    obj.shape_key_add(name="Basis")
    obj.shape_key_add(name="Fat").data.foreach_set("co", (1.5 * vertices).astype(np.float32).ravel())
    x, y, z = vertices[faces].mean(axis=1).T
    numbers = 1 + (z > wave * np.cos(2 * np.arctan2(y, x)))
    made = separate.piece_meshes(obj.data, numbers, (1, 2), True, smooth)
    caps = []
    for mesh in made.meshes.values():
        assert borders(mesh) == (set(), 0)
        assert crossings(mesh) == 0
        assert volume(mesh) > 0
        points = read(mesh.vertices, "co", np.float32, 3)
        fat = read(mesh.shape_keys.key_blocks["Fat"].data, "co", np.float32, 3)
        assert np.abs(fat - 1.5 * points).max() < 0.5
        cap = caps_of(mesh) == 1
        middles = read(mesh.polygons, "center", np.float32, 3)[cap]
        caps.append(middles[np.lexsort(middles.T)])
        assert 30 < cap.sum() < 1000
        angle = [edge.calc_face_angle() for edge in cap_edges(mesh)]
        assert np.mean(angle) < np.radians(25 if smooth is None else 15)
    assert same_places(*caps)
    assert sum(map(volume, made.meshes.values())) == pytest.approx(volume(obj.data), rel=1e-6)


def cap_edges(mesh):
    """The edges between two faces of caps."""
    bm = bmesh.new()
    bm.from_mesh(mesh)
    layer = bm.faces.layers.int["reeb_cap"]
    yield from [edge for edge in bm.edges if all(face[layer] for face in edge.link_faces)]
    bm.free()


def test_parts_that_meet_in_many_places_leave_nothing_between_them(make, separate):
    """The eight octants of a bent ball: six places where four of them meet."""
    vertices, faces = shapes.icosphere(4)
    obj = make((vertices + 0.15 * np.sin(3 * vertices[:, [1, 2, 0]]), faces))
    numbers = 1 + ((vertices[faces].mean(axis=1) > 0) @ [1, 2, 4])
    made = separate.piece_meshes(obj.data, numbers, range(1, 9), True, np.eye(3))
    volumes = [volume(mesh) for mesh in made.meshes.values()]
    assert [borders(mesh) for mesh in made.meshes.values()] == [(set(), 0)] * 8
    assert min(volumes) > 0
    assert sum(volumes) == pytest.approx(volume(obj.data), rel=1e-5)
    assert sum(map(crossings, made.meshes.values())) == 0


def ring_area(n, inner):
    """Between two regular polygons of n corners."""
    return 0.5 * n * np.sin(2 * np.pi / n) * (1 - inner**2)


@pytest.mark.parametrize("smooth", [None, np.eye(3)])
@pytest.mark.parametrize("turned", [False, True])
def test_a_pipe_cut_across_gets_a_ring_between_its_rims(make, separate, smooth, turned):
    """Each piece is half of the pipe; the caps of both are the same and as large as the wall is thick."""
    vertices, faces = shapes.pipe(24, 7, 0.6)
    turn, _ = np.linalg.qr(np.random.default_rng(3).standard_normal((3, 3)))
    numbers = 1 + (vertices[faces].mean(axis=1)[:, 2] > 1 / 3)
    obj = make(((3 * vertices @ turn.T * np.linalg.det(turn) + 5) if turned else vertices, faces))
    made = separate.piece_meshes(obj.data, numbers, (1, 2), True, smooth)
    size = 3.0 if turned else 1.0
    caps = []
    for mesh, height in zip(made.meshes.values(), (4 / 3, 2 / 3), strict=True):
        assert borders(mesh) == (set(), 0)
        assert crossings(mesh) == 0
        assert volume(mesh) == pytest.approx(height * ring_area(24, 0.6) * size**3, rel=1e-4)
        cap = caps_of(mesh) == 1
        assert read(mesh.polygons, "area")[cap].sum() == pytest.approx(ring_area(24, 0.6) * size**2, rel=1e-4)
        middles = read(mesh.polygons, "center", np.float32, 3)[cap]
        caps.append(middles[np.lexsort(middles.T.round(4))])
    assert same_places(*caps)


def test_a_pipe_in_a_pipe_and_rims_between_other_parts(make, separate):
    """Where the inside of a wall is in another part than the outside, there is no ring between the rims."""
    vertices, faces = shapes.pipe(24, 7, 0.6, 0.2)
    center = vertices[faces].mean(axis=1)
    inside = np.linalg.norm(center[:, :2] - 0.2 * center[:, 2:] ** 2 * [1, 0], axis=1) < 0.7
    numbers = 1 + (center[:, 2] > 0.1) + (inside & (center[:, 2] > 0.1))
    obj = make((vertices, faces))
    made = separate.piece_meshes(obj.data, numbers, (1, 2, 3), True, None)
    assert [borders(mesh) for mesh in made.meshes.values()] == [(set(), 0)] * 3
    assert sum(map(volume, made.meshes.values())) == pytest.approx(volume(obj.data), rel=1e-5)


def test_the_pieces_of_a_hollow_print_are_hollow(make):
    """The inner wall was a part of its own or went with one part: its pieces had up to four times the volume."""
    outer, inner = shapes.dumbbell(60, 24), shapes.dumbbell(40, 20, 0.19)
    inner = shapes.inside_out(shapes.Shape(inner.vertices * (0.9, 0.9, 0.97), inner.faces))
    obj = make(shapes.together(outer, inner))
    bpy.ops.reeb_parts.decompose()
    bpy.ops.reeb_parts.separate(caps=True)
    meshes = [piece.data for piece in pieces_of()]
    assert len(meshes) >= 2
    assert [borders(mesh) for mesh in meshes] == [(set(), 0)] * len(meshes)
    assert sum(map(volume, meshes)) == pytest.approx(volume(obj.data), rel=1e-5)
    assert all(volume(mesh) < 0.5 * bounding_volume(mesh) for mesh in meshes)


def bounding_volume(mesh):
    """Volume of the box around a mesh."""
    return float(np.ptp(read(mesh.vertices, "co", np.float32, 3), axis=0).prod())


@pytest.mark.parametrize("cut", ["PLANAR", "SMOOTH"])
def test_bent_cuts_are_planar_if_asked_for(make, separate, cut):
    """A border up and down around a ball: planar, its cap is one face for both sides; else it is a surface."""
    vertices, faces = shapes.icosphere(4)
    obj = make((vertices, faces))
    x, y, z = vertices[faces].mean(axis=1).T
    numbers = 1 + (z > 0.2 * np.cos(2 * np.arctan2(y, x)) + 0.1)
    made = separate.piece_meshes(obj.data, numbers, (1, 2), True, np.eye(3), cut == "PLANAR")
    assert [borders(mesh) for mesh in made.meshes.values()] == [(set(), 0)] * 2
    assert sum(map(volume, made.meshes.values())) == pytest.approx(volume(obj.data), rel=1e-6)
    caps = [caps_of(mesh).sum() for mesh in made.meshes.values()]
    assert caps == [1, 1] if cut == "PLANAR" else min(caps) > 30


def ragged_parts(obj, count, seed):
    """The number of each face's part: of so many random faces the nearest."""
    centers = read(obj.data.polygons, "center", np.float32, 3)
    around = centers[np.random.default_rng(seed).choice(len(centers), count, replace=False)]
    return 1 + np.linalg.norm(centers[:, None] - around[None], axis=2).argmin(axis=1)


@pytest.mark.parametrize("seed", some(3, 4, 5, 18))
def test_where_no_cap_was_seen_to_cross_anything_no_piece_does(make, separate, seed):
    """Ragged parts: where caps cross nothing of the model, those that go to one middle may cross each other."""
    obj = make(shapes.tube_tree())
    made = separate.piece_meshes(obj.data, ragged_parts(obj, 14, seed), range(1, 15), True, np.eye(3))
    crossing = [crossings(mesh) > 0 for mesh in made.meshes.values()]
    assert any(crossing) == (made.n_crossings > 0) == (seed == 5)  # of that one, no caps are known that cross nothing


@pytest.mark.parametrize(("step", "count", "seed"), some((0.11, 14, 18), (0.11, 8, 14), (0.2, 20, 7)))
def test_where_a_smooth_cut_goes_wrong_faces_stay_whole(make, separate, step, count, seed):
    """Ragged parts, some of whose caps cross something: with some borders along faces, fewer do.

    In the last, not all of these borders help, and to have the others smooth again is no better.
    """
    obj = make(shapes.tube_tree(step=step))
    numbers, wanted = ragged_parts(obj, count, seed), list(range(1, count + 1))
    made = separate.piece_meshes(obj.data, numbers, wanted, True, np.eye(3))
    plain = separate.PlainMesh(separate.plain_copy(obj.data))
    smooth = separate.finished(
        separate._made(plain, numbers, wanted, True, np.eye(3), np.empty((0, 2), np.int64)))
    assert made.n_crossings < smooth.n_crossings
    assert made.along_faces > smooth.along_faces
    assert all(borders(mesh) == (set(), 0) for mesh in made.meshes.values())

# SPDX-License-Identifier: GPL-3.0-or-later
"""Parts chosen, cut and painted where somebody points; by location here, with the pointer in tests/window."""

import importlib
import sys
from types import SimpleNamespace

import bpy
import numpy as np
import pytest
import shapes
from mathutils import Euler, Matrix, Vector
from results import numbers, same_partition
from snapshot import activate, check_undo, snapshot


@pytest.fixture
def parameters_of_result():
    return {"method": "berretti"}  # of few parts


def centers(obj):
    values = np.zeros(3 * len(obj.data.polygons), np.float32)
    obj.data.polygons.foreach_get("center", values)
    return values.reshape(-1, 3)


def arcs(obj):
    return next(item for item in obj.children if item.get("reeb_parts_role") == "arcs")


def branch(obj, tip):
    """Faces nearer to one tip of the tree than to the others, as far as they are out on its branch."""
    center = centers(obj)
    ways = shapes.TREE_TIPS / np.linalg.norm(shapes.TREE_TIPS, axis=1)[:, None]
    along = center @ ways.T
    return (along.argmax(axis=1) == tip), along[:, tip]


@pytest.mark.parametrize("tip", range(4))
def test_a_place_on_the_surface_picks_its_part(obj, result, tip):
    tip_face = np.linalg.norm(centers(obj) - shapes.TREE_TIPS[tip], axis=1).argmin()
    bpy.ops.reeb_parts.pick(location=centers(obj)[tip_face])
    assert result.parts[result.active].number == numbers(obj.data)[tip_face]
    assert not any(part.selected for part in result.parts)


def test_the_part_under_the_pointer_is_called_by_its_new_name_at_once(obj, result, package):
    """After F2 the former name stayed beside the pointer until it moved to another part."""
    hover = importlib.import_module(f"{package}.viewport.hover")
    hover._pointed = hover.Pointed(hover._key(obj), result.parts[1].number, np.empty((0, 3, 3), np.float32))
    assert hover.name(obj) == result.parts[1].name
    result.parts[1].name = "Arm"
    assert hover.name(obj) == "Arm"
    hover.clear()
    assert hover.name(obj) == ""


def test_extending_adds_and_takes_away(obj, result):
    faces = [np.linalg.norm(centers(obj) - tip, axis=1).argmin() for tip in shapes.TREE_TIPS]
    wanted = [int(numbers(obj.data)[face]) for face in faces]
    bpy.ops.reeb_parts.pick(location=centers(obj)[faces[0]])
    for face in faces[1:]:
        bpy.ops.reeb_parts.pick(location=centers(obj)[face], extend=True)
    assert {part.number for part in result.parts if part.selected} == set(wanted)
    bpy.ops.reeb_parts.pick(location=centers(obj)[faces[1]], extend=True)
    assert {part.number for part in result.parts if part.selected} == set(wanted) - {wanted[1]}


def test_what_several_picks_have_chosen_is_chosen_by_number(obj, result):
    first, second, third = (part.number for part in result.parts[:3])
    bpy.ops.reeb_parts.pick(number=first, marked=f"{second}, {third}")
    assert result.parts[result.active].number == first
    assert [part.number for part in result.parts if part.selected] == [second, third]
    before = snapshot()
    with pytest.raises(RuntimeError, match=r"There is no part with the number 99\."):
        bpy.ops.reeb_parts.pick(number=first, marked="99")
    assert snapshot() == before


@pytest.mark.parametrize("matrix", [
    Matrix(), Matrix.Translation((3, -1, 2)) @ Matrix.Rotation(0.7, 4, "X") @ Matrix.Diagonal((2, 0.5, 1, 1)),
    Matrix.Diagonal((-1, 1, 1, 1)),
])
@pytest.mark.parametrize("on_graph", [True, False])
def test_a_cut_goes_around_the_branch_where_it_was_pointed_at(obj, matrix, on_graph):
    obj.matrix_world = matrix
    bpy.context.view_layer.update()
    bpy.ops.reeb_parts.decompose(method="berretti", n_parts=1)
    mesh = obj.data
    tip = 0
    own, along = branch(obj, tip)
    way = shapes.TREE_TIPS[tip] / np.linalg.norm(shapes.TREE_TIPS[tip])
    place = Vector(1.4 * way)
    if not on_graph:
        place = Vector(centers(obj)[np.flatnonzero(own)[np.abs(along[own] - 1.4).argmin()]])
    bpy.ops.reeb_parts.cut(location=obj.matrix_world @ place, on_graph=on_graph)
    found = numbers(mesh)
    (new,) = set(found.tolist()) - {1}
    assert (found[own & (along > 1.65)] == new).all()
    assert (found[~own | (along < 1.15)] == 1).all()
    assert all(part.pinned for part in mesh.reeb_parts.parts)
    assert mesh.reeb_parts.parts[mesh.reeb_parts.active].number == new


def test_a_cut_stays_at_every_detail(obj, result):
    result.n_parts = 1
    bpy.ops.reeb_parts.cut(location=1.4 * Vector(shapes.TREE_TIPS[0]).normalized())
    cut = numbers(obj.data)
    new = int(cut.max())
    for detail in (0.9, 0.1, 0.5):
        result.detail = detail
        assert ((numbers(obj.data) == new) == (cut == new)).all()


@pytest.mark.parametrize("name", ["pick", "cut", "paint", "from_face_sets"])
def test_each_is_one_step_of_undo(obj, result, name):
    result.n_parts = 2
    bpy.ops.reeb_parts.face_sets()
    face = int(np.flatnonzero(numbers(obj.data) != result.parts[0].number)[0])
    sets = obj.data.attributes[".sculpt_face_set"].data
    sets[face].value = result.parts[0].number
    result.active = 0
    work = {
        "pick": lambda: bpy.ops.reeb_parts.pick(location=centers(obj)[face]),
        "cut": lambda: bpy.ops.reeb_parts.cut(location=1.4 * Vector(shapes.TREE_TIPS[0]).normalized()),
        "paint": lambda: bpy.ops.reeb_parts.paint(stroke=dabs(centers(obj)[face], size=0.1)),
        "from_face_sets": bpy.ops.reeb_parts.from_face_sets,
    }[name]
    check_undo(work)


def test_nothing_is_cut_off_beyond_a_tip(obj, result):
    result.n_parts = 1
    tip = Vector(shapes.TREE_TIPS[0]) * 1.5
    before = snapshot()
    with pytest.raises(RuntimeError, match="Nothing of Part 01 would be cut off"):
        bpy.ops.reeb_parts.cut(location=tip, on_graph=True)
    assert snapshot() == before


def test_without_lines_of_a_graph_a_cut_is_where_the_surface_is(make):
    """A ball of few faces has a graph of one node, beside which no line could be found."""
    ball = make(shapes.icosphere(1))
    bpy.ops.reeb_parts.decompose()
    before = snapshot()
    with pytest.raises(RuntimeError, match="Nothing of Part 01 would be cut off there"):
        bpy.ops.reeb_parts.cut(location=centers(ball)[0])
    assert snapshot() == before


def test_a_locked_part_is_not_cut(obj, result):
    result.n_parts = 1
    result.parts[0].locked = True
    before = snapshot()
    with pytest.raises(RuntimeError, match="locked"):
        bpy.ops.reeb_parts.cut(location=shapes.TREE_TIPS[0])
    assert snapshot() == before


def test_an_arc_is_a_handle(obj, result):
    curve = arcs(obj)
    for index, tip in enumerate(shapes.TREE_TIPS):
        activate(curve)
        bpy.ops.reeb_parts.from_arc(location=1.2 * tip)
        assert bpy.context.view_layer.objects.active == obj
        assert bpy.context.view_layer.objects.selected[:] == [obj]
        tip_face = np.linalg.norm(centers(obj) - tip, axis=1).argmin()
        assert result.parts[result.active].number == numbers(obj.data)[tip_face], index


@pytest.mark.parametrize("turned", [False, True])
@pytest.mark.parametrize("aside", [0.0, 1.5])
def test_of_arcs_behind_each_other_the_one_in_front_is_meant(package, turned, aside):
    """A symmetric model from the side: over the near leg, the pointer named the far one."""
    frontmost = sys.modules[f"{package}.viewport.graph_lines"].frontmost
    nearest = sys.modules[f"{package}.viewport.graph_lines"].nearest
    rng = np.random.default_rng(3)
    line = np.column_stack([np.arange(0.0, 200.0, 10.0), 5.0 * rng.random(20), 0.4 + 0.1 * rng.random(20)])
    behind = line + (0.0, aside, 0.3)
    far_off = line + (0.0, 80.0, -0.3)  # seen beside them, however near to the viewer
    lines = [far_off, behind, line] if turned else [line, behind, far_off]
    points, first = np.concatenate(lines), 20 * 2 * turned
    pairs = np.stack([np.arange(59), np.arange(1, 60)], axis=1)[np.arange(59) % 20 != 19]
    for place in np.column_stack([200.0 * rng.random(50), 15.0 * rng.random(50) - 5.0]):
        alone = nearest(line[:, :2], pairs[pairs[:, 1] < 20], place)
        segment, share, distance = frontmost(points, pairs, place, 2.0)
        assert pairs[segment].tolist() == [first + alone[0], first + alone[0] + 1]
        assert (share, distance) == pytest.approx(alone[1:])


@pytest.mark.parametrize("change", ["nothing", "subdivided", "mirrored", "exploded", "moved and scaled"])
def test_a_ray_meets_the_part_that_is_seen_there(package, obj, result, change):
    pointing = sys.modules[f"{package}.viewport.pointing"]
    start = centers(obj)
    if change == "subdivided":
        obj.modifiers.new("Smooth", "SUBSURF").levels = 1
    elif change == "mirrored":
        obj.modifiers.new("Twin", "MIRROR").use_axis[2] = True
    elif change == "exploded":
        obj.reeb_parts_made.explode = 1.0
    elif change == "moved and scaled":
        obj.matrix_world = Matrix.Translation((3, -1, 2)) @ Matrix.Rotation(1.0, 4, "Y")
        obj.scale = (2, 1, -1)
    bpy.context.view_layer.update()
    model = pointing.Model(obj)
    seen = obj.evaluated_get(bpy.context.evaluated_depsgraph_get())
    for tip in shapes.TREE_TIPS:
        face = int(np.linalg.norm(start - tip, axis=1).argmin())
        place = Vector(start[face])
        if change == "exploded":  # the faces keep their order
            place = seen.data.polygons[face].center
        # From outside, along the branch.
        inwards = -Vector(tip).normalized()
        world = obj.matrix_world
        target = model.along(bpy.context, obj, world @ (place - 2 * inwards), world.to_3x3() @ inwards)
        assert model.number(target) == numbers(obj.data)[face]
    assert model.along(bpy.context, obj, Vector((50, 50, 50)), Vector((1, 0, 0))) is None


@pytest.mark.parametrize("kind", ["PERSP", "ORTHO"])
def test_rays_begin_where_a_camera_is(package, scene, kind):
    """Of an orthographic one they began in the middle of what it sees, behind most models: nothing was pointed at."""
    scene.camera = camera = bpy.data.objects.new("Camera", bpy.data.cameras.new("Camera"))
    scene.collection.objects.link(camera)
    camera.data.type, camera.location, camera.data.clip_end = kind, (2.0, 1.0, 5.0), 1000.0
    bpy.context.view_layer.update()
    window = camera.calc_matrix_camera(bpy.context.evaluated_depsgraph_get(), x=400, y=400)
    view = SimpleNamespace(
        view_matrix=camera.matrix_world.inverted(), perspective_matrix=window @ camera.matrix_world.inverted(),
        is_perspective=kind == "PERSP", view_perspective="CAMERA", use_clip_planes=False, clip_planes=[[0.0] * 4] * 6)
    region = SimpleNamespace(width=400, height=400, data=view)
    start, ahead = sys.modules[f"{package}.viewport.pointing"].ray_of(region, (200, 200))
    assert start[:] == pytest.approx(camera.location[:], abs=0.1 + 1e-3)  # it sees from its near end, 0.1 ahead
    assert ahead[:] == pytest.approx((0.0, 0.0, -1.0), abs=1e-5)


def seen_without_perspective(middle, turn, size, depth=500.0):
    """A view as Blender makes it: of what is this far to either side of a place, as deep as by the settings."""
    view = (Matrix.Translation(middle) @ turn.to_matrix().to_4x4()).inverted()
    window = Matrix.Diagonal((1 / size, 1 / size, -1 / depth, 1.0))
    data = SimpleNamespace(view_matrix=view, perspective_matrix=window @ view, is_perspective=False,
                           view_perspective="ORTHO", use_clip_planes=False, clip_planes=[[0.0] * 4] * 6)
    return SimpleNamespace(width=400, height=400, data=data)


def test_without_perspective_rays_meet_what_is_small(package, obj, result):
    """They begin at the far end of the view, 500 m away: on a model of 5 mm they missed the pointer by whole faces."""
    pointing = sys.modules[f"{package}.viewport.pointing"]
    model, turn, found = pointing.Model(obj), Euler((1.0, 0.2, 0.7)), {}
    for scale, middle in ((1.0, (0.0, 0.0, 0.0)), (0.001, (0.3, 0.2, 0.1))):
        obj.scale, obj.location = (scale,) * 3, middle
        bpy.context.view_layer.update()
        region = seen_without_perspective(middle, turn, 2.5 * scale)
        found[scale] = [model.along(bpy.context, obj, *pointing.ray_of(region, (x, y)))
                        for x in range(5, 400, 15) for y in range(5, 400, 15)]
    large, small = found.values()
    pairs = [(a, b) for a, b in zip(large, small, strict=True) if a is not None and b is not None]
    assert len(pairs) > 80
    np.testing.assert_allclose([b.location for _, b in pairs], [a.location for a, _ in pairs], atol=1e-3)


def bent(obj, *modifiers):
    """Bend what is far out in x by an armature, before other modifiers; part, middle and normal of each face seen."""
    rig = bpy.data.objects.new("Rig", bpy.data.armatures.new("Rig"))
    bpy.context.scene.collection.objects.link(rig)
    activate(rig)
    bpy.ops.object.mode_set(mode="EDIT")
    rig.data.edit_bones.new("Bone").tail = (0.0, 0.0, 1.0)
    bpy.ops.object.mode_set(mode="OBJECT")
    group = obj.vertex_groups.new(name="Bone")
    for vertex in obj.data.vertices:
        group.add([vertex.index], min(max((vertex.co.x - 0.2) / 0.6, 0.0), 1.0), "REPLACE")
    obj.modifiers.new("Rig", "ARMATURE").object = rig
    for kind in modifiers:
        obj.modifiers.new(kind, kind)
    rig.pose.bones["Bone"].rotation_mode = "XYZ"
    rig.pose.bones["Bone"].rotation_euler.y = 1.2
    activate(obj)
    seen = obj.evaluated_get(bpy.context.evaluated_depsgraph_get()).data
    return numbers(seen), np.array([face.center[:] for face in seen.polygons]), np.array(
        [face.normal[:] for face in seen.polygons])


@pytest.mark.parametrize("modifiers", [(), ("SUBSURF",), ("SUBSURF", "MIRROR"), ("SOLIDIFY",)], ids="+".join)
def test_in_a_pose_the_part_is_the_one_that_is_seen_there(obj, result, package, modifiers):
    """With Subdivision it was that of the nearest face without the pose: on a bent arm, of the body."""
    pointing = sys.modules[f"{package}.viewport.pointing"]
    part, center, normal = bent(obj, *modifiers)
    model = pointing.Model(obj)
    for face in np.random.default_rng(0).permutation(len(part))[:200]:
        start, way = Vector(center[face] + normal[face]), Vector(-normal[face])
        _, _, _, hit = obj.ray_cast(start, way)
        target = model.along(bpy.context, obj, start, way)
        assert model.number(target) == part[hit]
        again = model.at(obj, target.location, False)
        assert (again.face, again.candidate) == (target.face, target.candidate)


def test_on_coarse_faces_a_place_is_on_the_face_that_it_lies_on(package, scene):
    """It was on the one with the nearest middle: what is adjusted after a click cut elsewhere, or another part."""
    pointing = sys.modules[f"{package}.viewport.pointing"]
    bpy.ops.mesh.primitive_monkey_add()
    bpy.ops.reeb_parts.decompose()
    obj = bpy.context.object
    model = pointing.Model(obj)
    for face in obj.data.polygons:
        corner = obj.data.vertices[face.vertices[0]].co
        assert model.at(obj, corner.lerp(face.center, 0.2), False).face == face.index


def test_in_a_pose_a_part_is_framed_where_it_is_seen(obj, result, package):
    part_places = importlib.import_module(f"{package}.scene.result.part_places")
    part, _, _ = bent(obj)
    mesh = obj.evaluated_get(bpy.context.evaluated_depsgraph_get()).data
    for number in set(part.tolist()):
        corners = {corner for face in mesh.polygons if part[face.index] == number for corner in face.vertices}
        points = np.array([mesh.vertices[corner].co[:] for corner in corners])
        low, high = part_places.box(obj, numbers(obj.data) == number)
        assert np.allclose([low, high], [points.min(axis=0), points.max(axis=0)], atol=1e-5)


@pytest.mark.parametrize("modifiers", [(), ("SUBSURF",)], ids="+".join)
def test_in_a_pose_paint_takes_the_faces_that_are_seen_under_the_brush(obj, result, modifiers):
    """It took those that are there without the pose."""
    part, center, _ = bent(obj, *modifiers)
    result.active = 0
    # The tip that is bent furthest, of a part that is not the active one.
    place = center[np.flatnonzero(part != result.parts[0].number)][
        center[part != result.parts[0].number][:, 0].argmax()]
    bpy.ops.reeb_parts.paint(stroke=dabs(place, size=0.2))
    seen = obj.evaluated_get(bpy.context.evaluated_depsgraph_get()).data
    moved = numbers(seen) != part
    assert moved.any()
    assert len(set(numbers(seen)[moved].tolist())) == 1
    assert (np.linalg.norm(center[moved] - place, axis=1) < 0.25).all()
    assert moved[np.linalg.norm(center - place, axis=1) < 0.1].all()


def dabs(*places, size):
    return [{"name": "", "location": tuple(place), "radius": size} for place in places]


def test_painting_takes_the_faces_under_the_brush_and_no_others(obj, result):
    result.n_parts = 1
    bpy.ops.reeb_parts.cut(location=1.4 * Vector(shapes.TREE_TIPS[0]).normalized())
    before, center = numbers(obj.data), centers(obj)
    new = int(before.max())
    result.active = [part.number for part in result.parts].index(new)
    edge = center[np.linalg.norm(center - center[before == new].mean(axis=0), axis=1).argmin()]
    border = center[(before == 1)][np.linalg.norm(center[before == 1] - edge, axis=1).argmin()]
    bpy.ops.reeb_parts.paint(stroke=dabs(border, size=0.2))
    after = numbers(obj.data)
    moved = after != before
    assert moved.any()
    assert (after[moved] == new).all()
    assert (np.linalg.norm(center[moved] - border, axis=1) <= 0.2).all()
    near = np.linalg.norm(center - border, axis=1) <= 0.1
    assert (after[near] == new).all()


def test_painting_leaves_locked_parts_alone(obj, result):
    other = next(part for part in result.parts if part.number != result.parts[result.active].number)
    other.locked = True
    before = snapshot()
    face = np.flatnonzero(numbers(obj.data) == other.number)[0]
    with pytest.raises(RuntimeError, match="All that was painted is locked"):
        bpy.ops.reeb_parts.paint(stroke=dabs(centers(obj)[face], size=0.01))
    assert snapshot() == before


def test_painting_says_why_nothing_came_of_it(obj, result):
    before = snapshot()
    mine = np.flatnonzero(numbers(obj.data) == result.parts[result.active].number)[0]
    with pytest.raises(RuntimeError, match=f"is {result.parts[result.active].name} already"):
        bpy.ops.reeb_parts.paint(stroke=dabs(centers(obj)[mine], size=0.01))
    with pytest.raises(RuntimeError, match="No faces were painted"):
        bpy.ops.reeb_parts.paint(stroke=[])
    assert snapshot() == before


@pytest.mark.parametrize("pieces", ["together", "separate"])
def test_a_brush_does_not_reach_through_a_thin_body(pieces, make):
    # Two plates back to back, so near that the brush is much larger than the gap.
    plate = shapes.flat_grid(20, 20)
    obj = make(shapes.together(plate, shapes.moved(plate, (0, 0, 0.01))))
    bpy.ops.reeb_parts.decompose(pieces=pieces, n_parts=4)
    mesh = obj.data
    center = centers(obj)
    before = numbers(mesh)
    upper = center[:, 2] > 0.005
    lower_face = np.flatnonzero(~upper)[0]
    others = [k for k, part in enumerate(mesh.reeb_parts.parts) if part.number != before[lower_face]]
    mesh.reeb_parts.active = others[0]
    bpy.ops.reeb_parts.paint(stroke=dabs(center[lower_face], size=0.3))
    moved = numbers(mesh) != before
    assert moved.any()
    assert not moved[upper].any()


def test_face_sets_painted_by_hand_become_parts(obj, result):
    mesh = obj.data
    with pytest.raises(RuntimeError, match="not face sets yet"):
        bpy.ops.reeb_parts.from_face_sets()
    bpy.ops.reeb_parts.face_sets()
    before = numbers(mesh)
    sets = mesh.attributes[".sculpt_face_set"].data
    # A ball of faces into part 1, another into a face set of its own.
    center = centers(obj)
    ball = np.linalg.norm(center - shapes.TREE_TIPS[1], axis=1) < 0.5
    fresh = np.linalg.norm(center - shapes.TREE_TIPS[0], axis=1) < 0.5
    for face in np.flatnonzero(ball):
        sets[face].value = 1
    for face in np.flatnonzero(fresh):
        sets[face].value = 77
    bpy.ops.object.mode_set(mode="SCULPT")
    bpy.ops.reeb_parts.from_face_sets()
    assert obj.mode == "SCULPT"
    bpy.ops.object.mode_set(mode="OBJECT")
    after = numbers(mesh)
    (new,) = set(after[fresh].tolist())
    assert new not in before
    assert (after[~ball & ~fresh] == before[~ball & ~fresh]).all()
    assert ball.any()
    assert fresh.any()
    # The ball is not connected with the rest of part 1: it is a part of its own.
    (other,) = set(after[ball].tolist())
    assert other not in (before[ball][0], new)


def test_many_face_sets_are_as_many_parts(make):
    """A plane of 25 squares of 18 faces."""
    bpy.context.scene.reeb_parts.symmetry = False
    obj = make(shapes.flat_grid(15, 15))
    bpy.ops.reeb_parts.decompose(face_sets=True)
    sets = (np.floor(centers(obj)[:, :2] / 3) @ (1, 5)).astype(np.int32)
    obj.data.attributes[".sculpt_face_set"].data.foreach_set("value", 100 + sets)
    bpy.ops.reeb_parts.from_face_sets()
    assert same_partition(numbers(obj.data), sets)
    assert len(obj.data.reeb_parts.parts) == 25


def test_rays_meet_the_surface_as_it_is_shown(obj, result, package):
    """Colors written to the mesh leave the tree of it as it is; a shape key, a modifier or another object do not."""
    pointing = importlib.import_module(f"{package}.viewport.pointing")

    def seen(obj):
        bpy.context.view_layer.update()
        target = pointing.Model(obj).along(bpy.context, obj, Vector((0.0, 0.0, 50.0)), Vector((0.0, 0.0, -1.0)))
        return target.location[2], pointing._surfaces[0]

    height, surface = seen(obj)
    ray = obj.ray_cast(obj.matrix_world.inverted() @ Vector((0.0, 0.0, 50.0)), Vector((0.0, 0.0, -1.0)))
    assert height == pytest.approx(ray[1].z, abs=1e-5)
    obj.data.color_attributes["Reeb Parts"].data[0].color = (1.0, 0.0, 0.0, 1.0)
    obj.data.update()
    assert seen(obj)[1] is surface
    obj.shape_key_add(name="Basis")
    key = obj.shape_key_add(name="Up")
    for point in key.data:
        point.co.z += 1.0
    key.value = 0.5
    assert seen(obj)[0] == pytest.approx(height + 0.5, abs=1e-5)
    modifier = obj.modifiers.new("Displace", "DISPLACE")
    modifier.direction, modifier.strength, modifier.mid_level = "Z", 1.0, 0.0
    assert seen(obj)[0] == pytest.approx(height + 1.5, abs=1e-5)
    obj.modifiers.remove(modifier)
    other = obj.copy()
    bpy.context.scene.collection.objects.link(other)
    assert seen(other)[1].uid != obj.session_uid

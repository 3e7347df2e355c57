# SPDX-License-Identifier: GPL-3.0-or-later
"""Outline, ring and cuts are drawn where Separate cuts; that they are drawn, tests/window shows."""

import importlib
import time
from types import SimpleNamespace

import bpy
import numpy as np
import pytest
import shapes
from bulk import read
from mathutils import Matrix
from results import numbers
from scipy.spatial import cKDTree
from snapshot import activate


def rims(pieces, names):
    """The edges of one face of each piece that the mesh did not have there, (k, 2, 3), by the name of the piece.

    pieces : dict of meshes, with the edge attribute "rim" where the whole mesh was open.
    """
    found = {}
    for name in names:
        mesh = pieces[name]
        edge = read(mesh.loops, "edge_index", np.int32)
        alone = np.bincount(edge, minlength=len(mesh.edges)) == 1
        if "rim" in mesh.attributes:
            alone &= read(mesh.attributes["rim"].data, "value", np.float32) == 0
        found[name] = read(mesh.vertices, "co", np.float32, 3)[read(mesh.edges, "vertices", np.int32, 2)[alone]]
    return found


def apart(lines, others):
    """How far the two ends of each line are from those of the nearest other line, at most; lines have no direction."""
    ways = np.concatenate([others.reshape(-1, 6), others[:, ::-1].reshape(-1, 6)])
    return cKDTree(ways).query(lines.reshape(-1, 6))[0].max()


def check_same(lines, others, size):
    assert len(lines) == len(others) > 0
    assert max(apart(lines, others), apart(others, lines)) < 1e-6 * size


def slices(obj, count):
    """Slices of a mesh with ragged borders, from 1."""
    x, y, z = read(obj.data.polygons, "center", np.float32, 3).T
    return ((np.arctan2(y, x) + 0.3 + 0.4 * np.sin(4 * z)) % (2 * np.pi) * count / (2 * np.pi)).astype(np.int64) + 1


def cells():
    """A ball of polygons of five and six corners, and some that are not convex."""
    bpy.ops.mesh.primitive_ico_sphere_add(subdivisions=5, radius=1.0)
    ball = bpy.context.object
    modifier = ball.modifiers.new("Decimate", "DECIMATE")
    modifier.decimate_type, modifier.angle_limit = "DISSOLVE", 0.12
    bpy.ops.object.modifier_apply(modifier=modifier.name)
    assert max(len(face.vertices) for face in ball.data.polygons) > 4
    return ball


def quads():
    bpy.ops.mesh.primitive_torus_add(major_segments=40, minor_segments=16)
    return bpy.context.object


MESHES = {
    "closed": lambda make: make(shapes.icosphere(3)),
    "open": lambda make: make(shapes.moved(shapes.flat_grid(24, 19), (-11.4, -9.2, 0))),
    "quadrilaterals": lambda make: quads(),
    "polygons": lambda make: cells(),
    "loose pieces": lambda make: make(
        shapes.together(shapes.icosphere(2), shapes.moved(shapes.icosphere(3), (1.5, 0.7, 0)))),
}


@pytest.fixture
def modules(package):
    names = {"core": ("steps",),
             "scene": ("bridge", "errors"),
             "scene.reading": ("mesh_arrays", "seen_points"),
             "scene.pieces": ("cut_curves", "part_meshes"),
             "viewport": ("highlight", "idle", "pointing"),
             "viewport.modal": ("knife", "ring_tool")}
    return SimpleNamespace(**{name: importlib.import_module(f"{package}.{folder}.{name}")
                              for folder, several in names.items() for name in several})


@pytest.mark.parametrize("planar", [False, True])
@pytest.mark.parametrize("name", MESHES)
def test_the_curves_are_the_rims_of_the_pieces(make, modules, name, planar):
    obj = MESHES[name](make)
    obj.scale = (1.0, 1.3, 0.7)
    bpy.context.view_layer.update()
    edge = read(obj.data.loops, "edge_index", np.int32)
    open_edge = np.bincount(edge, minlength=len(obj.data.edges)) == 1
    obj.data.attributes.new("rim", "FLOAT", "EDGE").data.foreach_set("value", open_edge.astype(np.float32))
    parts = slices(obj, 3)
    names = np.unique(parts).tolist()
    curves = modules.steps.finished(modules.cut_curves.finding_curves(*modules.cut_curves.read(obj), parts, planar))
    made = modules.part_meshes.piece_meshes(obj.data, parts, names, smooth=modules.bridge.world_stretch(obj),
                                            planar=planar)
    lines = curves.points(read(obj.data.vertices, "co", np.float32, 3))[curves.segments]
    size = np.linalg.norm(np.ptp(lines.reshape(-1, 3), axis=0))
    assert len(np.unique(curves.share)) > 10  # not only along edges
    for number, rim in rims(made.meshes, names).items():
        check_same(lines[curves.around([number])], rim, size)


@pytest.fixture
def tree(make):
    """A decomposed tree that is stretched, and shows a mix of shape keys."""
    obj = make(shapes.tube_tree())
    obj.scale = (1.0, 1.4, 0.8)
    obj.matrix_world = Matrix.Rotation(0.5, 4, "X") @ obj.matrix_world
    bpy.ops.reeb_parts.decompose(method="berretti")
    obj.shape_key_add(name="Basis")
    key = obj.shape_key_add(name="Bent")
    points = read(key.data, "co", np.float32, 3)
    key.data.foreach_set("co", (points + np.sin(points[:, [1, 2, 0]])).ravel())
    return obj


@pytest.mark.parametrize("cut", ["SMOOTH", "PLANAR", "FACES"])
def test_the_outline_of_a_part_is_the_rim_of_the_piece(tree, modules, cut):
    tree.data.shape_keys.key_blocks["Bent"].value = 0.7
    listed = [part.number for part in tree.data.reeb_parts.parts]
    curves = modules.highlight.curves_of(tree, cut)
    assert (curves is None) == (cut == "FACES")
    drawn = {number: modules.highlight.outline(tree, [number], curves)[0].reshape(-1, 2, 3) for number in listed}
    (every,) = modules.highlight.outline(tree, None, curves)
    bpy.ops.reeb_parts.separate(cut=cut, center=False, hide=False)
    pieces = {}
    for piece in bpy.data.collections["Parts of Tree"].objects:
        activate(piece)
        bpy.ops.object.shape_key_remove(all=True, apply_mix=True)
        pieces[piece["reeb_parts_number"]] = piece.data
    size = np.linalg.norm(np.ptp(every, axis=0))
    for number, rim in rims(pieces, listed).items():
        check_same(drawn[number], rim, size)
    assert 2 * len(every) == sum(len(lines) * 2 for lines in drawn.values())


def test_curves_are_found_once_for_all_choices_and_again_for_other_parts(tree, modules):
    curves = modules.highlight.curves_of(tree, "SMOOTH")
    assert modules.highlight.curves_of(tree, "SMOOTH") is curves
    assert modules.highlight.curves_of(tree, "PLANAR") is not curves
    tree.data.reeb_parts.n_parts -= 1
    assert modules.highlight.curves_of(tree, "SMOOTH") is not curves
    tree.data.reeb_parts.n_parts += 1
    assert modules.highlight.curves_of(tree, "SMOOTH") is curves


def test_where_part_of_a_part_is_hidden_lines_run_along_faces(tree, modules):
    number = tree.data.reeb_parts.parts[1].number
    curves = modules.highlight.curves_of(tree, "SMOOTH")
    smooth = modules.highlight.outline(tree, [number], curves)[0]
    faces = np.flatnonzero(numbers(tree.data) == number)
    for face in faces[:5].tolist():
        tree.data.polygons[face].hide = True
    along = modules.highlight.outline(tree, [number])[0]
    assert np.array_equal(modules.highlight.outline(tree, [number], curves)[0], along)
    assert not np.array_equal(smooth, along)
    for face in faces.tolist():
        tree.data.polygons[face].hide = True
    assert not len(modules.highlight.outline(tree, [number], curves)[0])
    others = [part.number for part in tree.data.reeb_parts.parts if part.number != number]
    assert len(modules.highlight.outline(tree, others, curves)[0]) == len(smooth)
    for face in tree.data.polygons:
        face.hide = True
    assert not len(modules.highlight.outline(tree, None, curves)[0])


def test_the_ring_of_the_knife_is_what_is_cut(tree, modules):
    """The lines at rest are those along which the part is separated once it is cut there."""
    model = modules.pointing.Model(tree)
    knife = modules.knife.Knife(tree, model)
    arcs = next(item for item in tree.children if item.get("reeb_parts_role") == "arcs")
    place = arcs.matrix_world @ arcs.data.splines[0].points[len(arcs.data.splines[0].points) // 2].co.to_3d()
    target = model.at(tree, place, True)
    old = model.number(target)
    lines = modules.steps.finished(knife.finding_curve(tree, target, False))
    assert len(lines) > 5
    before = {part.number for part in tree.data.reeb_parts.parts}
    with bpy.context.temp_override(object=tree):
        bpy.ops.reeb_parts.cut(location=place, on_graph=True)
    (new,) = {part.number for part in tree.data.reeb_parts.parts} - before
    curves = modules.highlight.curves_of(tree, "SMOOTH")
    cut = curves.segments[(curves.pair == sorted((old, new))).all(axis=1)]
    points = curves.points(modules.mesh_arrays.shown_points(tree))
    check_same(lines, points[cut], np.linalg.norm(np.ptp(lines.reshape(-1, 3), axis=0)))


@pytest.mark.parametrize("along_faces", [False, True])
def test_at_rest_there_is_no_ring_where_nothing_would_be_cut_off(tree, modules, along_faces):
    """A click there is refused; the ring stayed, also one around much of a part."""
    model = modules.pointing.Model(tree)
    knife, graph = modules.knife.Knife(tree, model), modules.bridge.face_graph(tree)[0]
    arcs = next(item for item in tree.children if item.get("reeb_parts_role") == "arcs")
    places = [arcs.matrix_world @ point.co.to_3d() for spline in arcs.data.splines for point in spline.points]
    targets = [model.at(tree, place, True) for place in places]
    refused = [target for target in targets if knife.sides(target, graph) is None]
    assert 0 < len(refused) < len(targets)
    for target in (refused[0], next(target for target in targets if target not in refused)):
        lines = modules.steps.finished(knife.finding_curve(tree, target, False, along_faces))
        assert bool(len(lines)) == (target not in refused)
        assert len(knife.ring(target)) or target not in refused


def test_rings_at_rest_are_the_curve_of_the_parts_that_are_shown(tree, modules):
    model = modules.pointing.Model(tree)
    tool = modules.ring_tool.RingTool()
    tool.model, tool._key, tool._shown = model, modules.pointing.result_key(tree), model.numbers
    tool.read(tree)
    tool.go_to(tree, 0)
    active = tree.data.reeb_parts.parts[tree.data.reeb_parts.active].number
    lines = modules.steps.finished(tool.finding_rim(tool._shown, False))
    (outline,) = modules.highlight.outline(tree, [active], modules.highlight.curves_of(tree, "SMOOTH"))
    assert lines == pytest.approx(outline.reshape(-1, 2, 3), abs=1e-6)
    tool.go_to(tree, 2)
    assert not np.array_equal(tool._shown, model.numbers)
    assert len(modules.steps.finished(tool.finding_rim(tool._shown, False)))


@pytest.fixture
def hooked(tree):
    """What a hook does to all vertices of the tree, (4, 4), and the empty that moves them."""
    empty = bpy.data.objects.new("Hook", None)
    bpy.context.collection.objects.link(empty)
    empty.matrix_world = Matrix.Rotation(0.8, 4, "Y") @ Matrix.Translation((3.0, -2.0, 1.0))
    hook = tree.modifiers.new("Hook", "HOOK")
    hook.falloff_type, hook.object = "NONE", empty
    hook.vertex_indices_set(range(len(tree.data.vertices)))
    bpy.context.view_layer.update()
    hook.matrix_inverse = tree.matrix_world
    bpy.context.view_layer.update()
    return np.array(tree.matrix_world.inverted() @ empty.matrix_world @ tree.matrix_world), empty


def moved(lines, matrix):
    return lines @ matrix[:3, :3].T + matrix[:3, 3]


@pytest.mark.parametrize("others", [[], ["SUBSURF"], ["EDGE_SPLIT"], ["WEIGHTED_NORMAL", "MULTIRES", "SUBSURF"]])
@pytest.mark.parametrize("cut", ["SMOOTH", "FACES"])
def test_lines_go_where_modifiers_move_the_surface(tree, hooked, modules, cut, others):
    (active, *_) = [part.number for part in tree.data.reeb_parts.parts]
    curves = modules.highlight.curves_of(tree, cut)
    model, tool = modules.pointing.Model(tree), modules.ring_tool.RingTool()
    tool.model, tool._key, tool._shown = model, modules.pointing.result_key(tree), model.numbers
    target = model._on_face(0, model.face_center[0])

    def drawn():
        bpy.context.view_layer.update()
        tool.read(tree)
        tool.go_to(tree, 1)
        return [*(modules.highlight.outline(tree, parts, curves)[0] for parts in ([active], None)),
                modules.knife.Knife(tree, model).ring(target).reshape(-1, 3), tool.rim.reshape(-1, 3)]

    tree.modifiers["Hook"].show_viewport = False
    at_rest = drawn()
    tree.modifiers["Hook"].show_viewport = True
    for kind in others:
        modifier = tree.modifiers.new(kind, kind)
        if kind == "SUBSURF":
            modifier.subdivision_type = "SIMPLE"  # new vertices, but all in the faces that there were
    assert min(map(len, at_rest)) > 5
    for before, after in zip(at_rest, drawn(), strict=True):
        assert after == pytest.approx(moved(before, hooked[0]), abs=1e-4)


def test_lines_lie_on_a_smoothed_surface_and_stay_where_other_faces_are_made(tree, modules):
    at_rest = modules.highlight.outline(tree, None)[0]
    tree.modifiers.new("Subdivision", "SUBSURF").levels = 2
    bpy.context.view_layer.update()
    seen = tree.evaluated_get(bpy.context.evaluated_depsgraph_get()).data
    smoothed = modules.highlight.outline(tree, None)[0]
    away = cKDTree(read(seen.vertices, "co", np.float32, 3)).query(smoothed)[0]
    assert away.max() == 0.0
    assert np.abs(smoothed - at_rest).max() > 1e-3
    tree.modifiers.new("Decimate", "DECIMATE").ratio = 0.5
    bpy.context.view_layer.update()
    assert np.array_equal(modules.highlight.outline(tree, None)[0], at_rest)


def test_lines_are_built_again_once_the_object_is_evaluated_anew(tree, hooked, modules):
    before = modules.seen_points.version(tree)
    hooked[1].location.x += 1
    bpy.context.view_layer.update()
    after = modules.seen_points.version(tree)
    assert after > before > 0
    bpy.context.view_layer.update()
    assert modules.seen_points.version(tree) == after
    tree.modifiers["Hook"].show_viewport = False
    assert modules.seen_points.version(tree) == 0


def test_what_takes_long_is_found_bit_by_bit_once_the_view_rests(modules):
    taken = []

    def steps(result):
        for step in range(3):
            taken.append(step)
            time.sleep(modules.idle._BREATH)
            yield step / 3
        return result

    search = modules.idle.IdleSearch(keep=2)
    assert search.of("a", lambda: steps("A")) is None
    assert bpy.app.timers.is_registered(search._timer)
    assert search._go_on() > 0
    assert not taken  # it is asked for just now
    modules.idle._last -= modules.idle.REST
    assert search._go_on() == 0.0
    assert taken == [0]
    assert search.of("b", lambda: steps("B")) is None  # something else: the first is given up
    modules.idle._last -= modules.idle.REST
    while search._go_on() is not None:
        pass
    assert taken == [0, 0, 1, 2]
    assert search.of("b", lambda: steps("C")) == "B"
    assert search.of("a", lambda: steps("A"), at_once=True) == "A"
    assert (search.of("b", None), search.of("c", lambda: steps("C"), at_once=True)) == ("B", "C")
    assert search.of("b", lambda: steps("D"), at_once=True) == "D"  # two are remembered
    assert search.of("e", lambda: steps("E")) is None
    modules.idle._last -= modules.idle.REST
    modules.idle.moved()  # the pointer
    assert search._go_on() > 0
    search.forget()
    assert not bpy.app.timers.is_registered(search._timer)


def test_what_cannot_be_found_is_not_looked_for_again(modules, tree):
    def fails():
        raise modules.errors.SceneError("gone")
        yield

    search = modules.idle.IdleSearch()
    assert search.of("a", fails, at_once=True) is None
    assert search.of("a", None) is None
    # An object that was edited, renamed or deleted since: nothing is raised, and lines run along faces.
    search = modules.idle.IdleSearch()
    for change in (lambda: setattr(tree.data.vertices[0].co, "x", 9.0), lambda: setattr(tree, "name", "Other"),
                   lambda: bpy.data.objects.remove(tree)):
        uid = tree.data.session_uid
        change()
        key = object()
        assert search.of(key, lambda uid=uid: modules.highlight._finding("Tree", uid, "SMOOTH"), True) is None

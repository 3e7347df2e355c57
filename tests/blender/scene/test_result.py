# SPDX-License-Identifier: GPL-3.0-or-later
"""The result that stays with the mesh: detail, numbers and names, saving, editing."""

import importlib

import bmesh
import bpy
import numpy as np
import pytest
import shapes
from mathutils import Matrix, Vector
from results import numbers
from snapshot import snapshot


def corner_colors(mesh):
    values = np.zeros(4 * len(mesh.loops), np.float32)
    mesh.color_attributes["Reeb Parts"].data.foreach_get("color_srgb", values)
    return values.reshape(-1, 4)[:, :3]


def node_colors(obj):
    return [(item["part"], item.color[:3]) for item in obj.children if item.get("reeb_parts_role") == "node"]


def check_colors(obj):
    """Faces, materials and nodes are colored as the list says."""
    mesh = obj.data
    colors = {part.number: np.array(part.color) for part in mesh.reeb_parts.parts}
    corner_numbers = np.repeat(numbers(mesh), [face.loop_total for face in mesh.polygons])
    expected = np.array([colors[number] for number in corner_numbers.tolist()])
    assert np.abs(corner_colors(mesh) - expected).max() < 1.5 / 255
    for number, color in node_colors(obj):
        srgb = np.where(np.array(color) <= 0.0031308, 12.92 * np.array(color),
                        1.055 * np.maximum(color, 1e-9) ** (1 / 2.4) - 0.055)
        assert np.allclose(srgb, colors[number], atol=1e-3)


def check_outputs(obj):
    """Attribute, groups, list, colors and overlay all tell of the same parts."""
    result, mesh = obj.data.reeb_parts, obj.data
    faces = numbers(mesh)
    assert sorted(set(faces.tolist())) == [part.number for part in result.parts]
    assert sorted(obj.vertex_groups.keys()) == sorted(part.group for part in result.parts)
    for part in result.parts:
        index = obj.vertex_groups[part.group].index
        group = {v.index for v in mesh.vertices if any(g.group == index for g in v.groups)}
        assert group == {v for p in mesh.polygons if faces[p.index] == part.number for v in p.vertices}
    color = {part.number for part in result.parts}
    for item in bpy.data.collections[f"Reeb Graph {obj.name}"].objects:
        if item.type == "EMPTY":
            assert item["part"] in color
    check_colors(obj)


@pytest.mark.parametrize("detail", [0.0, 0.3, 0.7, 1.0])
def test_detail_equals_a_run_with_that_detail(obj, result, detail):
    result.detail = detail
    check_outputs(obj)
    live = numbers(obj.data)
    bpy.ops.reeb_parts.clear()
    bpy.ops.reeb_parts.decompose(detail=detail)
    once = numbers(obj.data)
    # The same parts; their numbers come from the first run.
    pairs = set(zip(live.tolist(), once.tolist(), strict=True))
    assert len(pairs) == len(set(live)) == len(set(once))


def test_there_and_back_is_where_it_was(obj, result):
    before = snapshot()
    for detail in (0.0, 1.0, 0.2, 0.5):
        result.detail = detail
    after = snapshot()
    # Groups are as before, their order in the list aside.
    assert sorted(after["objects"]["Tree"]["groups"]) == before["objects"]["Tree"]["groups"]
    assert after["meshes"]["Tree"]["attributes"] == before["meshes"]["Tree"]["attributes"]
    check_outputs(obj)


def listed(result):
    return {part.number: (part.name, tuple(part.color)) for part in result.parts}


def test_more_detail_gives_new_numbers_and_changes_no_name_or_colour(obj, result):
    seen, count = {}, 0
    for detail in np.linspace(0, 1, 30).tolist():
        result.detail = detail
        known = listed(result)
        for number in seen.keys() & known.keys():
            assert known[number] == seen[number]
        assert seen.keys() <= known.keys()
        seen, count = known, count + 1
    # And the way back shows the same.
    result.detail = 0.5
    assert all(seen[number] == value for number, value in listed(result).items())


@pytest.fixture
def large(obj):
    """The tree with 218,000 corners, with colors and another attribute of the user's own."""
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.ops.mesh.select_all(action="SELECT")
    bpy.ops.mesh.subdivide(number_cuts=4)
    bpy.ops.object.mode_set(mode="OBJECT")
    obj.data.color_attributes.new("Mine", "BYTE_COLOR", "CORNER")
    obj.data.attributes.new("Weight", "FLOAT", "POINT")
    bpy.ops.reeb_parts.decompose(field=True)
    obj.data.attributes.active = obj.data.attributes["Weight"]
    return obj


def described(mesh):
    """Names and kinds of all attributes, and which are active."""
    kinds = sorted((a.name, a.data_type, a.domain) for a in mesh.attributes)
    return kinds, mesh.attributes.active.name, mesh.attributes.active_color_name, mesh.attributes.default_color_name


def test_colours_of_a_large_mesh_are_those_of_its_parts_by_either_way(large):
    mesh, result = large.data, large.data.reeb_parts
    before = described(mesh)
    chosen = result.parts[0].number
    result.parts[0].color = (0.1234, 0.5, 0.777)  # between bytes
    for detail in (1.0, 0.0, 0.7):
        result.detail = detail
        check_colors(large)
        assert described(mesh) == before
    fast = corner_colors(mesh)
    # With a modifier Blender's operator for attributes would evaluate it: then colours are written one by one.
    result.detail = 0.0
    large.modifiers.new("Bend", "SIMPLE_DEFORM")
    result.detail = 0.7
    assert np.array_equal(corner_colors(mesh), fast)
    assert described(mesh) == before
    assert chosen in {part.number for part in result.parts}


@pytest.mark.parametrize("count", [1, 2, 3])
def test_exact_number(obj, result, count):
    result.n_parts = count
    assert len(result.parts) == count
    assert result.by_number
    check_outputs(obj)


def test_number_is_clipped_to_what_there_is(obj, result):
    result.n_parts = 100_000
    assert result.n_parts == len(result.parts) < 100_000


def test_names_are_kept_through_detail_runs_and_poses(obj, result):
    number = result.parts[2].number
    result.parts[2].name = "Arm"
    assert "Arm" in obj.vertex_groups
    faces = numbers(obj.data) == number
    result.n_parts = 1
    assert "Arm" not in obj.vertex_groups
    result.detail = 0.5
    assert "Arm" in obj.vertex_groups
    for vertex in obj.data.vertices:  # another pose
        vertex.co.x += 0.2 * vertex.co.z**2
    bpy.ops.reeb_parts.decompose()
    part = next(part for part in obj.data.reeb_parts.parts if part.name == "Arm")
    assert ((numbers(obj.data) == part.number) == faces).mean() > 0.95
    check_outputs(obj)


def test_names_stay_beside_the_users_own(obj, result):
    obj.vertex_groups.new(name="Arm")
    result.parts[1].name = "Arm"
    assert result.parts[1].name == "Arm"
    assert result.parts[1].group == "Arm.001"
    result.parts[1].name = "  "
    assert result.parts[1].name == "Arm"


def test_backspace_over_a_color_gives_the_palettes_back(obj, result):
    """It gave black, which stayed with the part."""
    bpy.ops.reeb_parts.materials()
    before = snapshot()
    part = result.parts[1]
    for _ in range(2):  # of a color that was chosen, and of the palette's own
        part.color = part.bl_rna.properties["color"].default_array
        assert snapshot() == before
        part.color = (1.0, 0.0, 0.5)
        assert snapshot() != before


def test_a_colour_that_is_chosen_stays_with_the_part(obj, result):
    result.detail = 0.6
    chosen = result.parts[1]
    number, group = chosen.number, chosen.group
    chosen.color = (1.0, 0.0, 0.5)
    check_colors(obj)
    assert result.parts[1].group == group
    result.detail = 0.0
    result.detail = 0.6
    bpy.ops.reeb_parts.decompose(method="berretti", detail=0.6)
    (found,) = [part for part in result.parts if part.number == number]
    assert found.color[:] == (1.0, 0.0, 0.5)
    assert sum(part.color[:] == (1.0, 0.0, 0.5) for part in result.parts) == 1
    check_colors(obj)


def test_a_colour_set_back_is_the_palettes_again(obj, result):
    before = result.parts[1].color[:]
    result.parts[1].color = (1.0, 0.0, 0.5)
    assert len(result.names) == 1
    result.parts[1].color = before
    assert len(result.names) == 0
    bpy.context.scene.reeb_parts.palette = "Pastel"
    assert min(result.parts[1].color) >= 0.35


def test_a_palette_is_seen_at_once_and_spares_chosen_colours(obj, result):
    result.parts[0].color = (0.1, 0.2, 0.3)
    before = [part.color[:] for part in result.parts]
    bpy.context.scene.reeb_parts.palette = "Pastel"
    check_colors(obj)
    after = [part.color[:] for part in result.parts]
    assert after[0] == pytest.approx((0.1, 0.2, 0.3))
    assert all(a != b for a, b in zip(after[1:], before[1:], strict=True))
    assert all(min(color) >= 0.35 for color in after[1:])
    bpy.context.scene.reeb_parts.palette = "Colour-blind safe"
    assert [part.color[:] for part in result.parts] == before


def test_a_colour_outlives_a_name_that_is_taken_back(obj, result):
    part = result.parts[0]
    part.color = (0.25, 0.5, 0.75)
    part.name = "Body"
    part.name = "Part 01"
    result.detail = 0.9
    assert result.parts[0].color[:] == (0.25, 0.5, 0.75)
    assert result.parts[0].name == "Part 01"


def test_numbers_of_parts_survive_a_coarser_run(obj, result):
    fine = numbers(obj.data)
    bpy.ops.reeb_parts.decompose(n_parts=2)
    bpy.ops.reeb_parts.decompose(detail=0.5)
    assert (numbers(obj.data) == fine).all()


DETAILS = (0.3, 0.5, 0.7, 0.9)


def numbers_at(result):
    """The number of each face at some levels of detail."""
    found = {}
    for detail in DETAILS:
        result.detail = detail
        found[detail] = numbers(result.id_data).tolist()
    return found


@pytest.mark.parametrize("detail", DETAILS)
def test_numbers_of_all_levels_survive_a_run_at_any_of_them(make, detail):
    """Parts that had come with a drag of Detail got other numbers and colors when Decompose was pressed again."""
    obj = make(shapes.insect())
    bpy.ops.reeb_parts.decompose(detail=0.5)
    before = numbers_at(obj.data.reeb_parts)
    bpy.ops.reeb_parts.decompose(detail=detail)
    assert numbers(obj.data).tolist() == before[detail]
    assert numbers_at(obj.data.reeb_parts) == before


def test_numbers_after_a_drag_survive_a_run_with_other_parameters(make):
    obj = make(shapes.insect())
    bpy.ops.reeb_parts.decompose(detail=0.5)
    obj.data.reeb_parts.detail = 0.9
    before = numbers(obj.data)
    bpy.ops.reeb_parts.decompose(detail=0.9, smoothing=0)
    assert (numbers(obj.data) == before).mean() > 0.9


def test_saved_and_opened_again(obj, result, tmp_path):
    result.parts[1].name = "Arm"
    path = str(tmp_path / "tree.blend")
    bpy.ops.wm.save_as_mainfile(filepath=path)
    before = snapshot()
    bpy.ops.wm.open_mainfile(filepath=path)
    assert snapshot() == before
    obj = bpy.data.objects["Tree"]
    result = obj.data.reeb_parts
    result.n_parts = 2
    assert not result.edited
    check_outputs(obj)
    result.detail = 0.5
    assert result.parts[1].name == "Arm"


def test_an_edited_mesh_is_noticed_and_not_mislabelled(obj, result):
    obj.data.vertices[0].co.x += 0.5
    before = numbers(obj.data)
    result.detail = 0.0
    assert result.edited
    assert (numbers(obj.data) == before).all()
    bpy.ops.reeb_parts.decompose()
    assert not obj.data.reeb_parts.edited
    check_outputs(obj)


def rested(package, obj):
    """Whether a mesh that has been left alone for a moment counts as edited."""
    watch = importlib.import_module(f"{package}.scene.changes.watch")
    watch._waiting.add(obj.data.session_uid)
    watch._last = 0.0
    watch._look()
    bpy.context.view_layer.update()
    return obj.data.reeb_parts.edited


def graph_places(obj):
    """Where the nodes and the points of the arcs are in the world, and how thick these are."""
    nodes = [item.matrix_world.translation[:] for item in obj.children if item.get("reeb_parts_role") == "node"]
    (arcs,) = [item for item in obj.children if item.get("reeb_parts_role") == "arcs"]
    points = [point for spline in arcs.data.splines for point in spline.points]
    return np.array(nodes + [(arcs.matrix_world @ point.co.to_3d())[:] for point in points])


def apply_transform():
    bpy.ops.object.transform_apply()


def set_origin():
    bpy.ops.object.origin_set(type="ORIGIN_CENTER_OF_VOLUME")


def apply_to_the_mesh():
    """As a script does, which leaves the children to themselves."""
    obj = bpy.context.object
    obj.data.transform(obj.matrix_world)
    obj.matrix_world.identity()


def check_that_it_keeps_its_parts(package, obj, move):
    """Decompose an object and move its mesh: graph, names and what is done next are as if nothing had happened."""
    bpy.ops.reeb_parts.decompose()
    result, names = obj.data.reeb_parts, [part.name for part in obj.data.reeb_parts.parts]
    before, size = graph_places(obj), max(obj.dimensions)
    move()
    if move is apply_to_the_mesh:  # without a window no timer looks
        bpy.ops.reeb_parts.select()
        bpy.context.view_layer.update()
    else:
        assert not rested(package, obj)
    assert np.abs(graph_places(obj) - before).max() < 1e-5 * size
    assert [part.name for part in result.parts] == names
    result.detail = 0.9
    check_outputs(obj)
    assert not result.edited
    assert bpy.ops.reeb_parts.separate() == {"FINISHED"}


@pytest.mark.parametrize("move", [apply_transform, set_origin, apply_to_the_mesh])
def test_a_mesh_that_is_moved_as_a_whole_keeps_its_parts(package, obj, move):
    """The parts were out of date, and the graph lay about, once the scale was applied."""
    obj.location, obj.rotation_euler, obj.scale = (1.0, 2.0, 3.0), (0.3, 0.2, 0.1), (0.02, 0.03, 0.02)
    check_that_it_keeps_its_parts(package, obj, move)


@pytest.mark.parametrize("move", [apply_transform, set_origin, apply_to_the_mesh])
@pytest.mark.parametrize("far", [0.0, 500.0])
def test_a_flat_mesh_that_is_moved_as_a_whole_keeps_its_parts(package, make, move, far):
    """What is off its plane is nowhere, so that Apply counted as an edit."""
    obj = make(shapes.flat_cells([(x, 0) for x in range(9)] + [(4, y) for y in range(1, 9)]), "Letter")
    obj.data.transform(Matrix.Translation((far, far, far)) @ Matrix.Rotation(0.7, 4, Vector((1, 2, 3))))
    obj.location, obj.rotation_euler, obj.scale = (1.0, 2.0, 3.0), (0.3, 0.2, 0.1), (0.02, 0.03, 0.02)
    check_that_it_keeps_its_parts(package, obj, move)


def test_commands_of_the_graph_and_the_list_take_a_mesh_that_was_moved_as_a_whole(obj):
    """Without a window no timer looks: these two called it edited, where others went on."""
    bpy.ops.reeb_parts.decompose(n_parts=1)
    obj.scale = (2.0, 2.0, 2.0)
    bpy.ops.object.transform_apply()
    bpy.context.view_layer.objects.active = next(item for item in obj.children if item.get("kind") == "saddle")
    assert bpy.ops.reeb_parts.split_at_node() == {"FINISHED"}
    bpy.context.view_layer.objects.active = obj
    obj.scale = (3.0, 3.0, 3.0)
    bpy.ops.object.transform_apply()
    assert bpy.ops.reeb_parts.mark(action="FACES") == {"FINISHED"}


def test_half_of_a_model_keeps_its_parts_where_its_other_half_is_the_same(package, make):
    """Apply Scale, which half models need before they are bent or bevelled, counted as an edit."""
    obj = make(shapes.half_of(shapes.mirrored_figure()), "Figure")
    obj.modifiers.new("Mirror", "MIRROR")
    obj.rotation_euler, obj.scale = (0.3, 0.0, 0.0), (2.0, 3.0, 4.0)
    check_that_it_keeps_its_parts(package, obj, apply_transform)
    bpy.context.view_layer.objects.active = obj
    for matrix in (Matrix.Translation((0, 1, 2)), Matrix.Scale(3.0, 4, (1, 0, 0))):
        obj.data.transform(matrix)
        assert not rested(package, obj)
    sheared = Matrix()
    sheared[1][0] = 0.1
    for matrix in (Matrix.Translation((1, 0, 0)), Matrix.Rotation(0.1, 4, "Z"), sheared):
        obj.data.transform(matrix)
        assert rested(package, obj)
        obj.data.transform(matrix.inverted())
        assert not rested(package, obj)


def test_a_mesh_that_is_mirrored_or_flattened_or_gets_another_half_does_not(package, obj, result):
    obj.modifiers.new("Mirror", "MIRROR")
    obj.data.transform(Matrix.Translation((1, 0, 0)))
    assert rested(package, obj)
    obj.modifiers.clear()
    assert not rested(package, obj)
    for matrix in (Matrix.Scale(-1.0, 4, (1, 0, 0)), Matrix.Scale(0.0, 4, (1, 0, 0))):
        obj.data.transform(matrix)
        assert rested(package, obj)


def test_a_mesh_with_other_faces_is_decomposed_anew(obj, result):
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.ops.mesh.select_all(action="SELECT")
    bpy.ops.mesh.subdivide()
    bpy.ops.object.mode_set(mode="OBJECT")
    former = numbers(obj.data)
    assert bpy.ops.reeb_parts.decompose() == {"FINISHED"}
    check_outputs(obj)
    # Subdivided faces carry their part's number along, and the new parts follow it.
    assert (numbers(obj.data) == former).mean() > 0.9
    with pytest.raises(RuntimeError):
        obj.data.vertices[0].co.x += 0.5
        bpy.ops.reeb_parts.select()


def test_clear_works_on_an_edited_mesh(obj, result):
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.ops.mesh.select_all(action="SELECT")
    bpy.ops.mesh.subdivide()
    bpy.ops.object.mode_set(mode="OBJECT")
    bpy.ops.reeb_parts.clear()
    assert obj.vertex_groups.keys() == []
    assert not [name for name in obj.data.attributes.keys() if "eeb" in name]
    assert len(bpy.data.objects) == 1


def test_select_and_isolate(obj, result, capfd):
    result.active = 1
    wanted = numbers(obj.data) == result.parts[1].number
    bpy.ops.reeb_parts.select()
    assert f"{wanted.sum()} faces selected" in capfd.readouterr().out  # nothing is seen of it in Object Mode
    assert [p.select for p in obj.data.polygons] == wanted.tolist()
    bpy.ops.reeb_parts.select(number=result.parts[0].number, action="ADD")
    assert sum(p.select for p in obj.data.polygons) > wanted.sum()
    bpy.ops.reeb_parts.isolate()
    assert [not p.hide for p in obj.data.polygons] == wanted.tolist()
    bpy.ops.reeb_parts.isolate(show_all=True)
    assert not any(p.hide for p in obj.data.polygons)


def test_an_edit_in_edit_mode_is_noticed_and_what_is_refused_goes_back(obj, package):
    """A timer looks once the mesh rests; a large mesh is looked at when Edit Mode is left."""
    watch = importlib.import_module(f"{package}.scene.changes.watch")
    bpy.ops.reeb_parts.decompose()
    result, count = obj.data.reeb_parts, len(obj.data.reeb_parts.parts)
    place = obj.data.vertices[0].co.copy()

    def look():
        watch._waiting.add(obj.data.session_uid)
        watch._last = 0.0
        watch._look()
        return result.edited

    def move(height):
        edit = bmesh.from_edit_mesh(obj.data)
        edit.verts.ensure_lookup_table()
        edit.verts[0].co = place + Vector((0, 0, height))
        bmesh.update_edit_mesh(obj.data)

    bpy.ops.object.mode_set(mode="EDIT")
    assert not look()
    move(64)
    assert look()
    result.detail = 0.9
    assert (result.detail, len(result.parts)) == (0.5, count)
    move(0)
    assert not look()
    result.detail = 0.9
    assert result.detail == pytest.approx(0.9)
    assert len(result.parts) > count
    watch.MOST_EDITED, most = 10, watch.MOST_EDITED
    move(64)
    assert not look()
    watch.MOST_EDITED = most
    assert look()
    bpy.ops.mesh.delete(type="VERT")
    bpy.ops.object.mode_set(mode="OBJECT")
    assert look()


@pytest.mark.parametrize("second", [False, True])
def test_a_message_names_the_object_and_not_its_mesh(obj, second):
    obj.name, obj.data.name = "Hero", "Cube.003"
    if second:
        other = bpy.data.objects.new("Another", obj.data)
        bpy.context.scene.collection.objects.link(other)
    bpy.ops.reeb_parts.decompose()
    obj.data.vertices[0].co.x += 1
    with pytest.raises(RuntimeError, match="Hero was edited since"):
        bpy.ops.reeb_parts.separate()


def test_a_mesh_that_no_object_has_keeps_its_parts(obj):
    """A script that set its Detail got a traceback."""
    bpy.ops.reeb_parts.decompose(n_parts=4)
    mesh = obj.data
    mesh.use_fake_user = True
    obj.data = bpy.data.meshes.new("Other")
    before = snapshot()
    mesh.reeb_parts.detail = 0.9
    mesh.reeb_parts.n_parts = 2
    mesh.reeb_parts.parts[0].locked = True
    mesh.reeb_parts.parts[0].color = (1.0, 0.0, 0.0)
    assert snapshot() == before
    obj.data = mesh
    mesh.reeb_parts.n_parts = 2
    assert len(mesh.reeb_parts.parts) == 2


def test_settings_of_the_scene_reach_the_active_object_where_there_is_no_window(result):
    """As in a timer of a script, in which there was a traceback, and the setting went back."""
    settings = bpy.context.scene.reeb_parts
    with bpy.context.temp_override(window=None):
        settings.palette = "Pastel"
        settings.graph = False
        settings.line_thickness = 0.5
    assert (result.palette, settings.graph, settings.line_thickness) == ("Pastel", False, 0.5)
    assert bpy.data.objects["Reeb arcs"].data.bevel_depth == 0.5

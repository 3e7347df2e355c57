# SPDX-License-Identifier: GPL-3.0-or-later
"""reeb_parts.unwrap: parts become islands of a UV map of ours; nothing else is touched."""

import bpy
import numpy as np
import pytest
import shapes
from bulk import read
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components
from snapshot import changes, check_undo, snapshot

MAP = "Reeb Parts UV"


def torn_edges(mesh):
    """Whether the faces at each edge lie apart in the map."""
    uv = read(mesh.uv_layers[MAP].uv, "vector", np.float32, 2)
    at = {}
    for polygon in mesh.polygons:
        loops = list(polygon.loop_indices)
        for a, b in zip(loops, [*loops[1:], loops[0]], strict=True):
            ends = {mesh.loops[a].vertex_index: uv[a], mesh.loops[b].vertex_index: uv[b]}
            at.setdefault(mesh.loops[a].edge_index, []).append(ends)
    torn = np.zeros(len(mesh.edges), bool)
    for edge, (first, *others) in at.items():
        torn[edge] = not others or any(np.abs(first[v] - other[v]).max() > 1e-5 for other in others for v in first)
    return torn


def face_areas(mesh):
    """Signed area of each triangle in the map."""
    uv = read(mesh.uv_layers[MAP].uv, "vector", np.float32, 2).reshape(-1, 3, 2).astype(np.float64)
    a, b = uv[:, 1] - uv[:, 0], uv[:, 2] - uv[:, 0]
    return 0.5 * (a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0])


def cuts(mesh):
    numbers = read(mesh.attributes["reeb_part"].data, "value", np.int32)
    around = {}
    for polygon in mesh.polygons:
        for loop in polygon.loop_indices:
            around.setdefault(mesh.loops[loop].edge_index, set()).add(numbers[polygon.index])
    return np.array([len(around[edge.index]) > 1 for edge in mesh.edges])


def test_the_map_is_torn_along_the_cuts(obj):
    bpy.ops.reeb_parts.decompose()
    assert bpy.ops.reeb_parts.unwrap() == {"FINISHED"}
    torn = torn_edges(obj.data)
    assert torn[cuts(obj.data)].all()
    assert torn.mean() < 0.25
    assert obj.data.uv_layers.active.name == MAP


def n_islands(mesh):
    """Groups of faces that share a place in space and in the map."""
    uv = read(mesh.uv_layers[MAP].uv, "vector", np.float32, 2)
    points = read(mesh.vertices, "co", np.float32, 3)[read(mesh.loops, "vertex_index", np.int32)]
    place = np.unique(np.concatenate([points, uv], axis=1).round(4), axis=0, return_inverse=True)[1].ravel()
    face = np.repeat(np.arange(len(mesh.polygons)), read(mesh.polygons, "loop_total", np.int32))
    count, _ = connected_components(coo_array((np.ones(len(face)), (face, len(mesh.polygons) + place)),
                                              (len(mesh.polygons) + place.max() + 1,) * 2))
    return count


def test_parts_hang_together_where_only_vertices_are_split(make, tree):
    """Each piece of a surface between such seams, as .glb files have them, was an island of its own."""
    maps = []
    for shape in (tree, shapes.unjoined(tree)):
        obj = make(shape)
        bpy.ops.reeb_parts.decompose()
        bpy.ops.reeb_parts.unwrap()
        maps.append((len(obj.data.reeb_parts.parts), n_islands(obj.data)))
    assert maps[0] == maps[1]


def test_seams_by_hand_are_those_of_split_edges(make, tree):
    """Of two edges at one place either may be marked."""
    found = []
    for marked in (False, True):
        obj = make(shapes.unjoined(tree))
        bpy.ops.reeb_parts.decompose(n_parts=1)
        middle = read(obj.data.polygons, "center", np.float32, 3)[:, 2]
        if marked:
            for polygon in obj.data.polygons:
                for loop in polygon.loop_indices if middle[polygon.index] > np.quantile(middle, 0.9) else ():
                    obj.data.edges[obj.data.loops[loop].edge_index].use_seam = True
        bpy.ops.reeb_parts.unwrap()
        found.append(n_islands(obj.data))
    assert found[1] > found[0] + 10


def test_a_model_of_millimeters_has_the_map_of_one_of_meters(make, tree):
    """Blender's unwrapping has limits that are lengths: on a model of 2 mm it found no solution."""
    maps = []
    for size in (1.0, 2.0**-10):
        obj = make((tree.vertices * size, tree.faces))
        bpy.ops.reeb_parts.decompose()
        bpy.ops.reeb_parts.unwrap()
        maps.append(read(obj.data.uv_layers[MAP].uv, "vector", np.float32, 2))
    assert (maps[0] == maps[1]).all()


@pytest.mark.parametrize("name", ["tree", "torus", "genus two", "sphere"])
def test_every_face_lies_flat_and_no_face_is_turned_over(make, name):
    shape = {"tree": shapes.tube_tree, "torus": shapes.torus, "genus two": lambda: shapes.genus_two(0.09),
             "sphere": lambda: shapes.icosphere(3)}[name]()
    obj = make(shape)
    bpy.ops.reeb_parts.decompose()
    bpy.ops.reeb_parts.unwrap()
    area = face_areas(obj.data)
    assert (area > 0).mean() > 0.99
    uv = read(obj.data.uv_layers[MAP].uv, "vector", np.float32, 2)
    assert uv.min() >= 0.0
    assert uv.max() <= 1.0
    # Islands do not lie over each other: together they cover no more than the square.
    assert 0.2 < area.sum() < 1.0


@pytest.mark.parametrize("n_parts", [1, 0])
def test_areas_are_even(obj, n_parts):
    """Areas in the map are like those of the faces, up to one factor, also where a whole tree is one part."""
    bpy.ops.reeb_parts.decompose(n_parts=n_parts)
    bpy.ops.reeb_parts.unwrap()
    ratio = face_areas(obj.data) / read(obj.data.polygons, "area")
    ratio /= face_areas(obj.data).sum() / read(obj.data.polygons, "area").sum()
    assert np.mean((ratio > 0.3) & (ratio < 3)) > 0.99


@pytest.mark.parametrize("method", ["ANGLE_BASED", "CONFORMAL"])
def test_the_report_says_how_even_the_map_is(obj, method, capfd):
    bpy.ops.reeb_parts.decompose()
    bpy.ops.reeb_parts.unwrap(method=method)
    ratio = face_areas(obj.data) / read(obj.data.polygons, "area")
    ratio /= np.abs(face_areas(obj.data)).sum() / read(obj.data.polygons, "area").sum()
    low, high = np.quantile(np.abs(ratio), (0.01, 0.99))
    even = np.mean((ratio > 0.3) & (ratio < 3))
    assert f"areas {low:.1f} to {high:.1f} times their size, {even:.0%} of the faces" in capfd.readouterr().out


@pytest.mark.parametrize("stack", [False, True])
@pytest.mark.parametrize("method", ["MINIMUM_STRETCH", "ANGLE_BASED", "CONFORMAL"])
def test_faces_that_lie_on_others_share_their_place(make, method, stack, capfd):
    """Blender leaves out the second of two faces with the same vertices: each kept the whole square, and all else had
    next to nothing. Manes, leaves and cloth of games have faces for either side.
    """
    vertices, faces = shapes.mirrored_figure()
    far = np.abs(vertices[faces].mean(axis=1)[:, 0]) > 0.6 * np.abs(vertices[:, 0]).max()
    assert 0.05 < far.mean() < 0.5
    obj = make((vertices, np.concatenate([faces, faces[far][:, ::-1]])), "Figure")
    bpy.ops.reeb_parts.decompose()
    bpy.ops.reeb_parts.unwrap(method=method, stack=stack)
    assert "Warning" not in capfd.readouterr().out
    uv = read(obj.data.uv_layers[MAP].uv, "vector", np.float32, 2).reshape(-1, 3, 2)
    assert (uv[len(faces):] == uv[: len(faces)][far][:, ::-1]).all()
    area = np.abs(face_areas(obj.data))[: len(faces)]
    ratio = area / read(obj.data.polygons, "area")[: len(faces)]
    ratio /= np.median(ratio)
    assert np.mean((ratio > 0.3) & (ratio < 3)) > (0.97 if method == "MINIMUM_STRETCH" else 0.9)


def test_an_uneven_map_is_a_warning(make, capfd):
    """A ball with a small hole, without Open Tubes, has no even map that keeps angles."""
    vertices, faces = shapes.icosphere(3)
    make((vertices, faces[1:]))
    bpy.ops.reeb_parts.decompose(n_parts=1)
    for open_parts in (False, True):
        bpy.ops.reeb_parts.unwrap(open_parts=open_parts, method="CONFORMAL")
        assert ("Warning: Unwrapped" in capfd.readouterr().out) != open_parts


def test_twins_lie_over_each_other(make):
    """Left and right parts that are mirror images share their place; all else has more of the map than before."""
    obj = make(shapes.mirrored_figure(), "Figure")
    bpy.ops.reeb_parts.decompose()
    bpy.ops.reeb_parts.unwrap()
    apart = face_areas(obj.data)
    bpy.ops.reeb_parts.unwrap(stack=True)
    stacked, numbers = face_areas(obj.data), read(obj.data.attributes["reeb_part"].data, "value", np.int32)
    uv = read(obj.data.uv_layers[MAP].uv, "vector", np.float32, 2).reshape(-1, 3, 2)
    named = {part.name: numbers == part.number for part in obj.data.reeb_parts.parts}
    pairs = [(named[name], named[name[:-1] + "R"]) for name in named if name.endswith(".L")]
    assert pairs
    for left, right in pairs:
        islands = [{tuple(sorted(map(tuple, face.tolist()))) for face in uv[side]} for side in (left, right)]
        assert islands[0] == islands[1]
        assert np.sign(stacked[left]).mean() == pytest.approx(-np.sign(stacked[right]).mean())
    alone = ~np.any(pairs, axis=(0, 1))
    assert np.abs(stacked[alone]).sum() > np.abs(apart[alone]).sum()


def test_nothing_else_is_touched(obj):
    obj.data.uv_layers.new(name="Mine")
    obj.shape_key_add(name="Basis")
    obj.shape_key_add(name="Fat").value = 0.5
    obj.data.polygons[3].hide = True
    bpy.ops.reeb_parts.decompose()
    before = snapshot()
    bpy.ops.reeb_parts.unwrap()
    after = snapshot()
    mesh = after["meshes"]["Tree"]
    assert mesh["attributes"].pop(MAP)
    mesh["order"].remove(MAP)
    assert mesh["properties"].pop("reeb_parts_uv") == MAP
    assert mesh["properties"].pop("reeb_parts_uv_digest")
    assert mesh["properties"].pop("reeb_parts_uv_former") == "Mine"
    assert mesh.pop("active UV map") == MAP
    assert before["meshes"]["Tree"].pop("active UV map") == "Mine"
    assert changes(before, after) == []


def test_twice_is_once_and_clear_removes_it(obj):
    bpy.ops.reeb_parts.decompose()
    bpy.ops.reeb_parts.unwrap()
    once = snapshot()
    bpy.ops.reeb_parts.unwrap()
    assert snapshot() == once
    bpy.ops.reeb_parts.clear()
    assert not obj.data.uv_layers
    assert not [key for key in obj.data.keys() if key.startswith("reeb_parts")]


def move_islands(mesh):
    """Make an island smaller by hand; what the map is then, (c, 2)."""
    layer = mesh.uv_layers[MAP]
    for corner in mesh.polygons[0].loop_indices:
        layer.uv[corner].vector *= 0.5
    return read(layer.uv, "vector", np.float32, 2)


def test_clear_leaves_a_map_that_was_changed_by_hand(obj, capfd):
    bpy.ops.reeb_parts.decompose()
    bpy.ops.reeb_parts.unwrap()
    by_hand = move_islands(obj.data)
    capfd.readouterr()
    bpy.ops.reeb_parts.clear()
    assert f"Info: Tree: the UV map {MAP} was changed by hand and stays" in capfd.readouterr().out
    assert obj.data.uv_layers.keys() == [MAP]
    assert (read(obj.data.uv_layers[MAP].uv, "vector", np.float32, 2) == by_hand).all()
    assert not [key for key in obj.data.keys() if key.startswith("reeb_parts")]


@pytest.mark.parametrize("chosen", ["", "First", "Third"])
def test_clear_leaves_active_what_was(obj, chosen):
    """The last map was, whichever had been; the user's own choice since then stays."""
    for name in ("First", "Second", "Third"):
        obj.data.uv_layers.new(name=name)
    obj.data.uv_layers.active = obj.data.uv_layers["Second"]
    obj.data.uv_layers["First"].active_render = True
    bpy.ops.reeb_parts.decompose()
    before = snapshot()
    bpy.ops.reeb_parts.unwrap()
    bpy.ops.reeb_parts.unwrap()
    if chosen:
        obj.data.uv_layers.active = obj.data.uv_layers[chosen]
    bpy.ops.reeb_parts.clear()
    assert obj.data.uv_layers.active.name == (chosen or "Second")
    assert [layer.name for layer in obj.data.uv_layers if layer.active_render] == ["First"]
    bpy.ops.reeb_parts.decompose()
    if not chosen:
        assert changes(before, snapshot()) == []


def test_clear_leaves_a_map_that_was_renamed(obj):
    bpy.ops.reeb_parts.decompose()
    bpy.ops.reeb_parts.unwrap()
    obj.data.uv_layers[MAP].name = "Mine"
    bpy.ops.reeb_parts.clear()
    assert obj.data.uv_layers.keys() == ["Mine"]


def test_clear_removes_a_map_of_which_nothing_was_changed(obj, tmp_path):
    """Whatever else was done: a visit to Edit Mode, another map, the file saved and opened again."""
    bpy.ops.reeb_parts.decompose()
    bpy.ops.reeb_parts.unwrap()
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.ops.object.mode_set(mode="OBJECT")
    obj.data.uv_layers.new(name="Mine")
    path = str(tmp_path / "tree.blend")
    bpy.ops.wm.save_as_mainfile(filepath=path)
    bpy.ops.wm.open_mainfile(filepath=path)
    bpy.ops.reeb_parts.clear()
    assert bpy.context.object.data.uv_layers.keys() == ["Mine"]


def test_unwrap_makes_a_new_map_beside_one_that_was_changed_by_hand(obj):
    bpy.ops.reeb_parts.decompose()
    bpy.ops.reeb_parts.unwrap()
    by_hand = move_islands(obj.data)
    bpy.ops.reeb_parts.unwrap()
    first, second = obj.data.uv_layers
    assert (first.name, second.name) == (MAP, f"{MAP}.001")
    assert obj.data.uv_layers.active == second
    assert (read(first.uv, "vector", np.float32, 2) == by_hand).all()
    bpy.ops.reeb_parts.clear()
    assert obj.data.uv_layers.keys() == [MAP]


def test_the_user_s_seams_are_used(obj):
    bpy.ops.reeb_parts.decompose(n_parts=2)
    numbers = read(obj.data.attributes["reeb_part"].data, "value", np.int32)
    # Around one face, which becomes an island.
    face = obj.data.polygons[int(np.flatnonzero(numbers == 1)[0])]
    for loop in face.loop_indices:
        obj.data.edges[obj.data.loops[loop].edge_index].use_seam = True
    bpy.ops.reeb_parts.unwrap()
    torn = torn_edges(obj.data)
    assert all(torn[obj.data.loops[loop].edge_index] for loop in face.loop_indices)


@pytest.mark.parametrize("mode", ["EDIT", "SCULPT", "WEIGHT_PAINT", "VERTEX_PAINT"])
def test_from_every_mode(obj, mode):
    bpy.ops.reeb_parts.decompose()
    bpy.ops.object.mode_set(mode=mode)
    bpy.ops.reeb_parts.unwrap()
    assert obj.mode == mode
    assert bpy.context.view_layer.objects.active == obj
    bpy.ops.object.mode_set(mode="OBJECT")
    assert obj.data.uv_layers.keys() == [MAP]


def test_from_an_image_editor(obj):
    """Where it shows an image, Blender's own operators for UV maps refuse."""
    bpy.ops.reeb_parts.decompose()
    window = bpy.context.window_manager.windows[0]
    area = next(area for area in window.screen.areas if area.type == "VIEW_3D")
    area.ui_type = "IMAGE_EDITOR"
    with bpy.context.temp_override(window=window, area=area, region=area.regions[-1]):
        bpy.ops.reeb_parts.unwrap()
    area.ui_type = "VIEW_3D"
    assert obj.data.uv_layers.keys() == [MAP]


def test_a_full_mesh_is_refused_in_a_sentence(obj):
    for _ in range(8):
        obj.data.uv_layers.new()
    bpy.ops.reeb_parts.decompose()
    before = snapshot()
    with pytest.raises(RuntimeError, match="as many UV maps"):
        bpy.ops.reeb_parts.unwrap()
    assert snapshot() == before


def test_undo(obj):
    bpy.ops.reeb_parts.decompose()
    check_undo(bpy.ops.reeb_parts.unwrap)

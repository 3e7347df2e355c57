# SPDX-License-Identifier: GPL-3.0-or-later
"""reeb_parts.export: a file for each part, which holds the part."""

import bpy
import numpy as np
import pytest
import shapes
from mathutils import Matrix
from places import world_points
from snapshot import activate, snapshot
from threemf_reader import read_3mf

IMPORT = {
    "obj": lambda path: bpy.ops.wm.obj_import(filepath=path, forward_axis="Y", up_axis="Z"),
    "ply": lambda path: bpy.ops.wm.ply_import(filepath=path),
    "stl": lambda path: bpy.ops.wm.stl_import(filepath=path),
    "glb": lambda path: bpy.ops.import_scene.gltf(filepath=path),
}


def area(obj):
    """Area of the faces as they lie in the world."""
    obj.data.transform(obj.matrix_world)
    return sum(polygon.area for polygon in obj.data.polygons)


@pytest.mark.parametrize("kind", IMPORT)
def test_each_file_holds_its_part(obj, tmp_path, kind):
    obj.scale = (2, 2, 2)
    bpy.ops.reeb_parts.decompose()
    shares = {part.name: part.share for part in obj.data.reeb_parts.parts}
    before = snapshot()
    assert bpy.ops.reeb_parts.export(directory=str(tmp_path / "new"), format=kind) == {"FINISHED"}
    assert snapshot() == before
    files = sorted((tmp_path / "new").glob(f"*.{kind}"))
    assert [file.stem for file in files] == [f"Tree {name}" for name in shares]
    total = area(obj)
    for file, share in zip(files, shares.values(), strict=True):
        bpy.ops.wm.read_homefile(use_empty=True)
        IMPORT[kind](str(file))
        (piece,) = [o for o in bpy.data.objects if o.type == "MESH"]
        assert area(piece) == pytest.approx(share * total, rel=1e-3)


@pytest.mark.parametrize("kind", IMPORT)
def test_one_file_holds_all_parts(obj, tmp_path, kind):
    bpy.ops.reeb_parts.decompose()
    names, total = {f"Tree {part.name}" for part in obj.data.reeb_parts.parts}, area(obj)
    bpy.ops.reeb_parts.export(directory=str(tmp_path), format=kind, one_file=True)
    assert [file.name for file in tmp_path.iterdir() if file.suffix != ".mtl"] == [f"Tree.{kind}"]
    bpy.ops.wm.read_homefile(use_empty=True)
    IMPORT[kind](str(tmp_path / f"Tree.{kind}"))
    pieces = [o for o in bpy.data.objects if o.type == "MESH"]
    assert sum(area(piece) for piece in pieces) == pytest.approx(total, rel=1e-3)
    if kind in ("obj", "glb"):
        # Blender's .obj has no spaces in names.
        assert {piece.name.replace("_", " ") for piece in pieces} == names


def test_cuts_are_those_of_separate(obj, tmp_path):
    """The same pieces, vertex by vertex, as Separate makes with the same choice."""
    obj.scale, obj.location = (2, 2, 2), (1, 2, 3)
    bpy.ops.reeb_parts.decompose()
    cuts = ("SMOOTH", "PLANAR", "FACES")
    for cut in cuts:
        bpy.ops.reeb_parts.export(directory=str(tmp_path / cut), format="ply", cut=cut, caps=True)
    names = [part.name for part in obj.data.reeb_parts.parts]
    found = {}
    for cut in cuts:
        for name in names:
            bpy.ops.wm.ply_import(filepath=str(tmp_path / cut / f"Tree {name}.ply"))
            found[cut, name] = np.array([v.co[:] for v in bpy.context.object.data.vertices])
            bpy.ops.object.delete()
    for cut in cuts:
        activate(obj)
        bpy.ops.reeb_parts.separate(cut=cut, caps=True, hide=False)
        bpy.context.view_layer.update()
        for name in names:
            piece = bpy.data.objects[f"Tree {name}"]
            points = np.array([(piece.matrix_world @ v.co)[:] for v in piece.data.vertices])
            assert found[cut, name] == pytest.approx(points, abs=1e-4)
    for cut, other in (("SMOOTH", "FACES"), ("PLANAR", "FACES"), ("PLANAR", "SMOOTH")):
        assert any(not np.array_equal(found[cut, name], found[other, name]) for name in names)


@pytest.mark.parametrize("mirrored", [False, True])
def test_3mf_is_one_assembly_in_millimeters(obj, tmp_path, mirrored):
    """Closed bodies in their places; their volumes add up to that of the tree, and none is inside out."""
    obj.scale, obj.location = (-2 if mirrored else 2, 2, 2), (5, 6, 7)
    bpy.context.scene.unit_settings.scale_length = 0.01
    bpy.ops.reeb_parts.decompose()
    parts = [(part.name, part.color[:]) for part in obj.data.reeb_parts.parts]
    assert bpy.ops.reeb_parts.export(directory=str(tmp_path), format="3mf", caps=True) == {"FINISHED"}
    (file,) = tmp_path.iterdir()
    assert file.name == "Tree.3mf"
    bodies, (item,) = read_3mf(file)
    assert [body.name for body in bodies] == [f"Tree {name}" for name, _ in parts]
    assert [body.color for body in bodies] == [
        "#" + "".join(f"{round(255 * value):02X}" for value in color) for _, color in parts]
    points = world_points(obj)
    written = np.concatenate([body.vertices for body in bodies])
    assert np.ptp(written, axis=0) == pytest.approx(10 * np.ptp(points, axis=0), rel=1e-5)
    assert written.min(axis=0) + item == pytest.approx(0, abs=1e-4)
    volumes = [shapes.volume(body.vertices, body.triangles) for body in bodies]
    assert min(volumes) > 0
    faces = np.array([polygon.vertices[:] for polygon in obj.data.polygons])[:, :: -1 if mirrored else 1]
    assert sum(volumes) == pytest.approx(1000 * shapes.volume(points, faces), rel=2e-3)


def test_closed_files_have_no_border(obj, tmp_path):
    bpy.ops.reeb_parts.decompose()
    bpy.ops.reeb_parts.export(directory=str(tmp_path), format="obj", caps=True)
    for file in tmp_path.glob("*.obj"):
        bpy.ops.wm.read_homefile(use_empty=True)
        IMPORT["obj"](str(file))
        mesh = bpy.context.selected_objects[0].data
        edges = np.zeros(len(mesh.loops), np.int32)
        mesh.loops.foreach_get("edge_index", edges)
        assert set(np.bincount(edges)) == {2}


def test_only_the_chosen_parts(obj, tmp_path):
    bpy.ops.reeb_parts.decompose()
    obj.data.reeb_parts.parts[1].selected = True
    bpy.ops.reeb_parts.export(directory=str(tmp_path), format="stl", which="CHOSEN")
    assert [file.name for file in tmp_path.iterdir()] == [f"Tree {obj.data.reeb_parts.parts[1].name}.stl"]


@pytest.mark.parametrize("mode", ["EDIT", "SCULPT", "WEIGHT_PAINT", "VERTEX_PAINT"])
def test_from_every_mode(obj, tmp_path, mode):
    bpy.ops.reeb_parts.decompose()
    bpy.ops.object.mode_set(mode=mode)
    bpy.ops.reeb_parts.export(directory=str(tmp_path), format="stl")
    assert obj.mode == mode
    assert len(list(tmp_path.iterdir())) == len(obj.data.reeb_parts.parts)


def test_no_folder_is_refused_in_a_sentence(obj):
    bpy.ops.reeb_parts.decompose()
    with pytest.raises(RuntimeError, match="no folder"):
        bpy.ops.reeb_parts.export()


def test_a_folder_that_cannot_be_made_is_refused_in_a_sentence(obj, tmp_path):
    bpy.ops.reeb_parts.decompose()
    (tmp_path / "file").write_text("")
    with pytest.raises(RuntimeError, match="could not be written"):
        bpy.ops.reeb_parts.export(directory=str(tmp_path / "file" / "folder"))


def test_parts_that_are_given_one_name_have_two(obj, tmp_path):
    bpy.ops.reeb_parts.decompose()
    for part in obj.data.reeb_parts.parts[:2]:
        part.name = "Arm"
    bpy.ops.reeb_parts.export(directory=str(tmp_path), format="stl")
    names = sorted(path.name for path in tmp_path.iterdir())
    assert names == ["Tree Arm.001.stl", "Tree Arm.stl", "Tree Part 03.stl", "Tree Part 04.stl", "Tree Part 05.stl"]


def test_objects_whose_names_differ_by_what_files_cannot_have(make, tree, tmp_path):
    vertices, faces = tree
    objects = [make((vertices * size, faces), name)
               for size, name in ((1, "a/b"), (2, "a:b"), (3, "A_B"), (4, "a_b Part 01"))]
    for obj in objects:
        obj.select_set(True)
    bpy.ops.reeb_parts.decompose(n_parts=2)
    objects[3].data.reeb_parts.parts[0].name = "x"
    objects[0].data.reeb_parts.parts[0].name = "Part 01 x"
    bpy.ops.reeb_parts.export(directory=str(tmp_path), format="stl")
    files = sorted(tmp_path.iterdir())
    assert len({file.name.casefold() for file in files}) == 8
    assert [file.name for file in files if "x" in file.name] == ["a_b Part 01 x (2).stl", "a_b Part 01 x.stl"]
    # No two are of the same size in the world, and none is lost.
    areas = []
    for file in files:
        bpy.ops.wm.read_homefile(use_empty=True)
        IMPORT["stl"](str(file))
        areas.append(area(bpy.context.selected_objects[0]))
    total = sum(area_of(vertices * size, faces) for size in (1, 2, 3, 4))
    assert sum(areas) == pytest.approx(total, rel=1e-3)


def area_of(vertices, faces):
    """Area of triangles."""
    a, b, c = vertices[faces].transpose(1, 0, 2)
    return np.linalg.norm(np.cross(b - a, c - a), axis=1).sum() / 2


def test_names_longer_than_files_may_have(make, tree, tmp_path):
    obj = make(tree, "ä" * 31)
    bpy.ops.reeb_parts.decompose(n_parts=2)
    for part, letter in zip(obj.data.reeb_parts.parts, "ab", strict=True):
        part.name = "ö" * 30 + letter
    obj.name = "ä" * 120
    bpy.ops.reeb_parts.export(directory=str(tmp_path), format="stl")
    assert len(list(tmp_path.iterdir())) == 2


def test_a_part_that_would_replace_the_open_scene_is_refused(obj, tmp_path):
    bpy.ops.reeb_parts.decompose()
    scene = tmp_path / "Tree Part 01.obj"
    bpy.ops.wm.save_as_mainfile(filepath=str(scene), check_existing=False)
    before = scene.read_bytes()
    with pytest.raises(RuntimeError, match="is read"):
        bpy.ops.reeb_parts.export(directory=str(tmp_path))
    assert [file.name for file in tmp_path.iterdir()] == [scene.name]
    assert scene.read_bytes() == before


def test_pieces_are_written_as_they_were_separated(obj, tmp_path):
    """With their joints, where they are; an error where there are none."""
    bpy.ops.reeb_parts.decompose(n_parts=3)
    with pytest.raises(RuntimeError, match="There are no separated parts of Tree"):
        bpy.ops.reeb_parts.export(directory=str(tmp_path), format="stl", separated=True)
    assert not list(tmp_path.iterdir())
    bpy.ops.reeb_parts.separate(joints="DOWEL", hide=False)
    there = {piece.name: piece for piece in bpy.data.collections["Parts of Tree"].objects}
    before = snapshot()
    bpy.ops.reeb_parts.export(directory=str(tmp_path), format="stl", separated=True)
    assert snapshot() == before
    assert {path.stem for path in tmp_path.iterdir()} == set(there)
    assert any("reeb_parts_dowel" in piece for piece in there.values())
    for path in sorted(tmp_path.iterdir()):
        wanted = np.array([there[path.stem].matrix_world @ v.co for v in there[path.stem].data.vertices])
        bpy.ops.wm.stl_import(filepath=str(path))
        found = np.array([bpy.context.object.matrix_world @ v.co for v in bpy.context.object.data.vertices])
        assert np.sort(found, axis=0)[[0, -1]] == pytest.approx(np.sort(wanted, axis=0)[[0, -1]], abs=1e-4)


@pytest.mark.parametrize("kind", ["stl", "3mf"])
@pytest.mark.parametrize(("before", "after"), [(5, 2), (2, 5)])
def test_all_pieces_are_written_whatever_the_detail_is_now(obj, tmp_path, kind, before, after):
    """Where the list had other parts by now, those of the pieces that it does not show were missing, or an error."""
    bpy.ops.reeb_parts.decompose(n_parts=before)
    bpy.ops.reeb_parts.separate(hide=False)
    there = {piece.name: piece.color[:3] for piece in bpy.data.collections["Parts of Tree"].objects}
    assert len(there) == before
    obj.data.reeb_parts.n_parts = after
    activate(obj)
    bpy.ops.reeb_parts.export(directory=str(tmp_path), format=kind, separated=True)
    if kind == "stl":
        assert {path.stem for path in tmp_path.iterdir()} == set(there)
        return
    bodies, _ = read_3mf(tmp_path / "Tree.3mf")
    assert {body.name for body in bodies} == set(there)
    assert len({body.color for body in bodies}) == before


def test_of_chosen_parts_only_their_pieces_are_written(obj, tmp_path):
    bpy.ops.reeb_parts.decompose(n_parts=5)
    bpy.ops.reeb_parts.separate(hide=False)
    activate(obj)
    obj.data.reeb_parts.parts[1].selected = True
    bpy.ops.reeb_parts.export(directory=str(tmp_path), format="stl", separated=True, which="CHOSEN")
    assert [file.name for file in tmp_path.iterdir()] == [f"Tree {obj.data.reeb_parts.parts[1].name}.stl"]


@pytest.mark.parametrize("separated", ["", "AS_MADE", "APPLIED"])
@pytest.mark.parametrize("sheared", [False, True])
@pytest.mark.parametrize("kind", IMPORT)
def test_mirrored_objects_are_not_inside_out_in_files(obj, tmp_path, kind, sheared, separated):
    """A .ply was, whose exporter leaves the order of corners as it is; and all were of pieces in a place of their own.

    Such are those whose scale was applied.
    """
    obj.scale = (-1, 1, 1)
    if sheared:
        parent = bpy.data.objects.new("Parent", None)
        bpy.context.scene.collection.objects.link(parent)
        obj.parent, obj.rotation_euler, parent.scale = parent, (0.3, 0.4, 0.5), (1, 2, 3)
    bpy.context.view_layer.update()
    bpy.ops.reeb_parts.decompose(n_parts=2)
    if separated:
        bpy.ops.reeb_parts.separate(caps=True, hide=False)
        if separated == "APPLIED":
            for piece in [item for item in bpy.data.objects if "reeb_parts_number" in item]:
                piece.data.transform(piece.matrix_world)
                piece.data.flip_normals()
                piece.parent, piece.matrix_basis = None, Matrix()
        activate(obj)
    bpy.ops.reeb_parts.export(directory=str(tmp_path), format=kind, caps=True, separated=bool(separated))
    files = sorted(tmp_path.glob(f"*.{kind}"))
    assert len(files) == 2
    for file in files:
        bpy.ops.wm.read_homefile(use_empty=True)
        IMPORT[kind](str(file))
        (piece,) = [item for item in bpy.data.objects if item.type == "MESH"]
        piece.data.transform(piece.matrix_world)
        piece.data.calc_loop_triangles()
        triangles = np.array([triangle.vertices[:] for triangle in piece.data.loop_triangles])
        # A matrix that mirrors turns faces inside out without a word.
        turned = -1 if piece.matrix_world.determinant() < 0 else 1
        assert turned * shapes.volume(np.array([vertex.co for vertex in piece.data.vertices]), triangles) > 0


@pytest.mark.parametrize("kind", IMPORT)
def test_what_else_is_in_the_scene_is_not_evaluated_for_each_file(obj, make, tree, tmp_path, kind):
    """It was, which took most of the time in scenes with much in them."""
    bpy.ops.reeb_parts.decompose(n_parts=5)
    others = make(tree, "Others")
    others.modifiers.new("Array", "ARRAY").count = 50
    activate(obj)
    seen = []
    watch = lambda scene, graph: seen.append("Others" in graph.objects)  # noqa: E731
    bpy.app.handlers.depsgraph_update_post.append(watch)
    try:
        bpy.ops.reeb_parts.export(directory=str(tmp_path), format=kind)
    finally:
        bpy.app.handlers.depsgraph_update_post.remove(watch)
    assert sum(seen) <= 2  # before the first and after the last, of five


def test_shape_keys_are_written_as_they_are_at_the_frame_that_is_seen(obj, tmp_path):
    obj.shape_key_add(name="Basis")
    stretched = obj.shape_key_add(name="Stretched")
    for point, vertex in zip(stretched.data, obj.data.vertices, strict=True):
        point.co = vertex.co * 3
    for frame, value in ((1, 0.0), (21, 1.0)):
        stretched.value = value
        stretched.keyframe_insert("value", frame=frame)
    bpy.context.scene.frame_set(21)
    bpy.ops.reeb_parts.decompose(n_parts=2)
    seen = obj.evaluated_get(bpy.context.evaluated_depsgraph_get())
    wanted = bounds_of(np.array([obj.matrix_world @ vertex.co for vertex in seen.data.vertices]))
    bpy.ops.reeb_parts.export(directory=str(tmp_path), format="stl", one_file=True)
    bpy.ops.wm.stl_import(filepath=str(tmp_path / "Tree.stl"))
    assert bounds_of(np.array([vertex.co for vertex in bpy.context.object.data.vertices])) == pytest.approx(
        wanted, abs=1e-4)


@pytest.mark.parametrize("kind", IMPORT)
def test_no_scene_is_left_where_a_file_cannot_be_written(obj, tmp_path, kind):
    bpy.ops.reeb_parts.decompose(n_parts=3)
    (tmp_path / f"Tree Part 02.{kind}").mkdir()
    before = snapshot(), len(bpy.data.scenes)
    with pytest.raises(RuntimeError, match="Part 02"):
        bpy.ops.reeb_parts.export(directory=str(tmp_path), format=kind)
    assert (snapshot(), len(bpy.data.scenes)) == before
    assert [path.name for path in tmp_path.iterdir()] == [f"Tree Part 02.{kind}"]


def bounds_of(points):
    return np.sort(points, axis=0)[[0, -1]]


@pytest.mark.parametrize("separated", [False, True])
@pytest.mark.parametrize("kind", [*IMPORT, "3mf"])
def test_the_shape_keys_that_are_seen_are_written(obj, tmp_path, kind, separated):
    """One that stretches the upper half to a side, by half; of another none is left."""
    obj.location, obj.scale = (1, 2, 3), (2, 2, 2)
    obj.shape_key_add(name="Basis")
    stretched, other = (obj.shape_key_add(name=name) for name in ("Stretched", "Other"))
    group = obj.vertex_groups.new(name="Upper")
    group.add([vertex.index for vertex in obj.data.vertices if vertex.co.z > 0.5], 0.5, "REPLACE")
    for index, vertex in enumerate(obj.data.vertices):
        stretched.data[index].co, other.data[index].co = vertex.co * 3, vertex.co * 0.1
    stretched.value, other.value = 1.0, 0.0
    if kind != "glb":  # which knows no groups of shape keys
        stretched.vertex_group = "Upper"
    bpy.ops.reeb_parts.decompose(n_parts=3)
    seen = obj.evaluated_get(bpy.context.evaluated_depsgraph_get())
    wanted = bounds_of(np.array([obj.matrix_world @ vertex.co for vertex in seen.data.vertices]))
    if separated:
        bpy.ops.reeb_parts.separate(hide=False)
    before = snapshot()
    bpy.ops.reeb_parts.export(directory=str(tmp_path), format=kind, separated=separated, one_file=True)
    assert snapshot() == before
    (file,) = tmp_path.glob(f"Tree.{kind}")
    if kind == "3mf":
        bodies, (item,) = read_3mf(file)
        found = (np.concatenate([body.vertices for body in bodies]) + item) / 1000
        assert np.ptp(found, axis=0) == pytest.approx(np.ptp(wanted, axis=0), rel=1e-4)
        return
    bpy.ops.wm.read_homefile(use_empty=True)
    IMPORT[kind](str(file))
    bpy.context.view_layer.update()
    pieces = [item for item in bpy.data.objects if item.type == "MESH"]
    evaluated = [(item, item.evaluated_get(bpy.context.evaluated_depsgraph_get()).data) for item in pieces]
    found = np.array([item.matrix_world @ vertex.co for item, mesh in evaluated for vertex in mesh.vertices])
    if kind == "obj":  # written with Y up, and read as it is
        found = np.stack([found[:, 0], -found[:, 2], found[:, 1]], axis=1)
    assert bounds_of(found) == pytest.approx(wanted, abs=1e-3)


@pytest.mark.parametrize("slots", [(None,), ("Red", None)])
def test_empty_slots_of_materials_are_written(obj, tmp_path, slots):
    for name in slots:
        obj.data.materials.append(name and bpy.data.materials.new(name))
    for polygon in obj.data.polygons:
        polygon.material_index = int(polygon.center.x > 0)
    bpy.ops.reeb_parts.decompose()
    assert bpy.ops.reeb_parts.export(directory=str(tmp_path), format="obj") == {"FINISHED"}
    assert len(list(tmp_path.glob("*.obj"))) == len(obj.data.reeb_parts.parts)


@pytest.mark.parametrize("kind", ["obj", "glb"])
def test_separated_pieces_have_their_own_names_in_a_file(obj, tmp_path, kind):
    bpy.ops.reeb_parts.decompose(n_parts=3)
    bpy.ops.reeb_parts.separate(joints="DOWEL", hide=False)
    names = {piece.name for piece in bpy.data.collections["Parts of Tree"].objects}
    bpy.ops.reeb_parts.export(directory=str(tmp_path), format=kind, separated=True, one_file=True)
    bpy.ops.wm.read_homefile(use_empty=True)
    IMPORT[kind](str(tmp_path / f"Tree.{kind}"))
    assert {piece.name.replace("_", " ") for piece in bpy.data.objects if piece.type == "MESH"} == names


@pytest.mark.parametrize("kind", ["stl", "3mf"])
@pytest.mark.parametrize("hidden", [False, True])
def test_a_name_that_is_also_another_parts_costs_neither_of_them(obj, tmp_path, kind, hidden):
    """One was written over the other, and left an object in the scene.

    The user gives the other's name with the object's before it, or the name itself while the other is not shown.
    """
    bpy.ops.reeb_parts.decompose(detail=1.0, graph=False)
    result = obj.data.reeb_parts
    own = result.parts[-1].name
    if hidden:
        result.detail = 0.0
    result.parts[0].name = own if hidden else f"Tree {own}"
    result.detail = 1.0
    names = [part.name for part in result.parts]
    assert names[0] == (own if hidden else f"Tree {own}")
    before = snapshot()
    assert bpy.ops.reeb_parts.export(directory=str(tmp_path), format=kind, caps=True) == {"FINISHED"}
    assert snapshot() == before
    found = ([body.name for body in read_3mf(tmp_path / "Tree.3mf")[0]] if kind == "3mf"
             else [file.stem for file in tmp_path.iterdir()])
    assert sorted(found) == sorted(f"Tree {name}" for name in names)
    bpy.ops.reeb_parts.separate(hide=False)
    assert {piece.name for piece in bpy.data.objects if "reeb_parts_number" in piece} == set(found)

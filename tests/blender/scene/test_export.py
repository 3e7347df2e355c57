# SPDX-License-Identifier: GPL-3.0-or-later
"""reeb_parts.export: a file for each part, which holds the part."""

import bpy
import numpy as np
import pytest
from snapshot import snapshot

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


def test_parts_of_one_name_are_refused_and_nothing_written(obj, tmp_path):
    bpy.ops.reeb_parts.decompose()
    for part in obj.data.reeb_parts.parts[:2]:
        part.name = "Arm"
    with pytest.raises(RuntimeError, match="same name"):
        bpy.ops.reeb_parts.export(directory=str(tmp_path))
    assert list(tmp_path.iterdir()) == []

# SPDX-License-Identifier: GPL-3.0-or-later
"""What Blender has written is complete, and no beginning of it is, nor one with a hole or a tail."""

import re
from importlib import import_module
from pathlib import Path

import bpy
import numpy as np
import pytest
from snapshot import activate

CASES = ["blend", "packed.blend", "png", "obj", "ply", "stl", "glb", "3mf"]


@pytest.fixture
def complete(package):
    return import_module(f"{package}.scene.saving.file_checks")


def coloured(obj):
    """With what exporters write besides positions: a colour of each corner, a UV map, materials."""
    mesh = obj.data
    mesh.color_attributes.new("Colours", "BYTE_COLOR", "CORNER")
    mesh.uv_layers.new()
    for index in range(2):
        mesh.materials.append(bpy.data.materials.new("Red"))
        mesh.polygons[index].material_index = index


def write(obj, path, kind):
    """Write a file of a kind; the function that checks such files needs the kind's last word and the mesh."""
    if kind.endswith("blend"):
        bpy.ops.wm.save_as_mainfile(filepath=str(path), copy=True, compress=kind.startswith("packed"))
    elif kind == "png":
        image = bpy.data.images.new("Picture", 64, 64)
        image.pixels = np.linspace(0, 1, 64 * 64 * 4).tolist()
        image.filepath_raw, image.file_format = str(path), "PNG"
        image.save()
    elif kind == "3mf":
        if not obj.data.reeb_parts.parts:
            bpy.ops.reeb_parts.decompose(n_parts=2)
        bpy.ops.reeb_parts.export(directory=str(path.parent), format="3mf")
        (path.parent / f"{obj.name}.3mf").rename(path)
    elif kind == "glb":
        bpy.ops.export_scene.gltf(filepath=str(path), use_selection=True, export_format="GLB")
    else:
        operator = getattr(bpy.ops.wm, f"{kind}_export")
        operator(filepath=str(path), export_selected_objects=True)


@pytest.mark.parametrize("kind", CASES)
@pytest.mark.parametrize("dressed", [False, True])
def test_only_the_whole_file_is_complete(complete, obj, tmp_path, kind, dressed):
    if dressed:
        coloured(obj)
    activate(obj)
    path = tmp_path / f"it.{kind.split('.')[-1]}"
    write(obj, path, kind)
    own = getattr(complete, kind.split(".")[-1], None)
    check = own if own and kind not in ("obj", "ply", "stl", "glb", "3mf") else complete.model([obj.data], kind)
    assert check(path)
    whole = path.read_bytes()
    for length in {0, 1, 10, 100, len(whole) // 3, len(whole) - 4096, len(whole) - 30, len(whole) - 1}:
        path.write_bytes(whole[: max(length, 0)])
        assert not check(path), length
    path.write_bytes(whole + b"x")
    assert not check(path)
    middle = len(whole) // 2
    path.write_bytes(whole[:middle] + whole[middle + len(whole) // 10 :])
    assert not check(path)
    path.unlink()
    assert not check(path)


@pytest.mark.parametrize("kind", ["obj", "ply", "stl", "glb"])
def test_another_mesh_is_not_complete(complete, obj, make, tmp_path, kind):
    write(obj, tmp_path / "it", kind) if kind == "glb" else write(obj, tmp_path / f"it.{kind}", kind)
    path = next(path for path in tmp_path.iterdir() if path.suffix != ".mtl")
    other = make(([(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(0, 1, 2)] if kind != "glb" else []), "Other")
    assert not complete.model([other.data], kind)(path)


def test_materials_that_are_cut_off(complete, obj, tmp_path):
    coloured(obj)
    activate(obj)
    write(obj, tmp_path / "it.obj", "obj")
    library = tmp_path / "it.mtl"
    whole = library.read_bytes()
    for kept in (b"", whole[:20], whole[: whole.rindex(b"newmtl")], whole[: whole.rindex(b"illum")]):
        library.write_bytes(kept)
        assert not complete.model([obj.data], "obj")(tmp_path / "it.obj")
    library.write_bytes(whole)
    assert complete.model([obj.data], "obj")(tmp_path / "it.obj")


@pytest.mark.parametrize("hole", [rb"^vt .*\n", rb"^vn .*\n", rb" [\d/]+(?=\nf )"], ids=["vt", "vn", "corner"])
def test_an_obj_that_lacks_a_line_or_a_corner_is_not_complete(complete, obj, tmp_path, hole):
    """Though it has all vertices and faces, and ends as it should."""
    coloured(obj)
    activate(obj)
    path = tmp_path / "it.obj"
    write(obj, path, "obj")
    whole = path.read_bytes()
    assert complete.model([obj.data], "obj")(path)
    path.write_bytes(re.sub(hole, b"", whole, count=1, flags=re.MULTILINE))
    assert path.read_bytes() != whole
    assert not complete.model([obj.data], "obj")(path)


@pytest.mark.parametrize("way", ["folder", "alone"])
def test_an_interruption_just_when_a_folder_is_made_leaves_none(package, tmp_path, monkeypatch, way):
    run_files = import_module(f"{package}.scene.saving.run_files")
    mkdir = Path.mkdir

    def interrupted(folder, *arguments, **options):
        mkdir(folder, *arguments, **options)
        raise KeyboardInterrupt

    monkeypatch.setattr(Path, "mkdir", interrupted)
    with pytest.raises(KeyboardInterrupt), run_files.together() as files:
        if way == "folder":
            files.folder(tmp_path / "new" / "deep")
        with files.writing(tmp_path / "x.stl", lambda place: True, alone=True):
            pass
    assert list(tmp_path.iterdir()) == []


def test_none_of_several_files_is_in_place_if_one_cannot_be_moved(package, tmp_path):
    """Such as one that another program has open on Windows; here a folder took its place meanwhile."""
    run_files = import_module(f"{package}.scene.saving.run_files")
    first, second = tmp_path / "a.json", tmp_path / "b.json"
    for path in (first, second):
        path.write_text("old")

    def write():
        with run_files.together() as files:
            for path in (first, second):
                with files.writing(path, lambda place: True) as place:
                    place.write_text("new")
            second.unlink()
            second.mkdir()

    with pytest.raises(Exception, match="b.json could not be written: "):
        write()
    assert first.read_text() == "old"
    assert sorted(path.name for path in tmp_path.iterdir()) == ["a.json", "b.json"]
    second.rmdir()

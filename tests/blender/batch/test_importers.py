# SPDX-License-Identifier: GPL-3.0-or-later
"""What the command imports, above all of USD and Alembic, and what the package's script for a Blender reads of these.

A Blender may be built without either, as Debian's is; it says so.
"""

import runpy
import struct
import sys
from importlib import import_module
from pathlib import Path

import bpy
import numpy as np
import pytest

EXPORTER = Path(__file__).resolve().parents[3] / "package" / "blender_export.py"
CORNERS = [(x, y, z) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)]
FACES = (0, 1, 3, 2, 4, 6, 7, 5, 0, 4, 5, 1, 2, 3, 7, 6, 0, 2, 6, 4, 1, 5, 7, 3)


def points(size):
    return [tuple(size * x for x in corner) for corner in CORNERS]


def cube(name, where=f"points = {CORNERS}", more="", corners=FACES):
    """The text of a cube of side 2."""
    return f"""def Mesh "{name}" {{
    int[] faceVertexCounts = {[4] * 6}
    int[] faceVertexIndices = {list(corners)}
    point3f[] {where}
    {more}
}}
"""


def placed(kind, name, x, inside, more=""):
    """The text of something at some x, or, given a text, at that attribute of times."""
    x = x if isinstance(x, str) else f" = ({x}, 0, 0)"
    return f"""def {kind} "{name}" {more} {{
    double3 xformOp:translate{x}
    uniform token[] xformOpOrder = ["xformOp:translate"]
    {inside}
}}
"""


INSTANCED = "(instanceable = true\nreferences = </Proto>)"
POINTS = f"""def PointInstancer "P" {{
    rel prototypes = [</P/All/M>]
    int[] protoIndices = [0, 0]
    point3f[] positions = [(10, 0, 0), (20, 0, 0)]
    def Scope "All" {{
        {cube("M")}
    }}
}}
"""
SUBSETS = "".join(f"""def GeomSubset "{name}" (prepend apiSchemas = ["MaterialBindingAPI"]) {{
    uniform token elementType = "face"
    uniform token familyName = "materialBind"
    int[] indices = {indices}
    rel material:binding = </{name}>
}}
""" for name, indices in (("Red", [0, 1]), ("Blue", [2, 3, 4, 5])))
#: What is in a file; the x of the middle of each mesh that the command finds, and the x of all that the package reads.
SCENES = {
    "hierarchy": (placed("Xform", "G", 5, cube("A") + placed("Xform", "H", 7, cube("B"))), [5, 12], [5, 12]),
    "instances": (placed("Xform", "I", 10, "", INSTANCED) + placed("Xform", "J", 20, "", INSTANCED)
                  + f'class Xform "Proto" {{\n{cube("M")}\n}}\n', [0], [10, 20]),
    "instances of points": (cube("Own") + POINTS, [0, 0], [0, 10, 20]),
    "invisible, and for guides": (cube("A", more='token visibility = "invisible"')
                                  + cube("B", more='uniform token purpose = "guide"') + cube("C"), [0], [0]),
    "moves from frame 0": (placed("Xform", "G", ".timeSamples = {0: (3, 0, 0), 10: (9, 0, 0)}", cube("A")), [3], [3]),
    "moves from frame 1001": (placed("Xform", "G", ".timeSamples = {1001: (3, 0, 0), 1010: (9, 0, 0)}", cube("A")),
                              [3], [3]),
    "a corner that does not exist": (cube("A", corners=(99, *FACES[1:])), [0], [0]),
}


@pytest.fixture
def imported(package):
    """A function that imports a model as the command does, its meshes by name."""
    import_model = import_module(f"{package}.batch.importers").import_model

    def imported(path):
        bpy.ops.wm.read_homefile(use_empty=True)
        meshes = import_model(path)
        bpy.context.view_layer.update()
        return {obj.name: obj for obj in meshes}

    return imported


def usda(path, body, up="Z", meters=1):
    path.write_text(f'#usda 1.0\n(\n    upAxis = "{up}"\n    metersPerUnit = {meters}\n)\n{body}')
    return path


def world(obj):
    return np.array([obj.matrix_world @ vertex.co for vertex in obj.data.vertices])


def read(path, monkeypatch):
    """Vertices and the number of polygons, as the package has them."""
    out = path.with_suffix(".npz")
    monkeypatch.setattr(sys, "argv", ["blender", "--", str(path), str(out)])
    runpy.run_path(str(EXPORTER))
    with np.load(out) as data:
        return data["vertices"], int(data["polygon"].max()) + 1


def refusals(package, path, monkeypatch):
    """The sentences of the command and of the script, neither of which can read a file."""
    with pytest.raises(RuntimeError) as raised:
        import_module(f"{package}.batch.importers").import_model(path)
    with pytest.raises(Exception, match=r"\w") as said:
        read(path, monkeypatch)
    return str(raised.value), str(said.value)


def test_what_blender_has_no_importer_of_is_said(run, tmp_path):
    """An add-on that is off was a traceback; where Blender is built without an importer, that is the same to it."""
    path = tmp_path / "model.fbx"
    path.write_bytes(b"Kaydara")
    bpy.ops.preferences.addon_disable(module="io_scene_fbx")
    try:
        ended = run(path)
    finally:
        bpy.ops.preferences.addon_enable(module="io_scene_fbx")
    assert ended.status == 1
    assert "model.fbx could not be read: this Blender has no importer of .fbx" in ended.err
    assert "Traceback" not in ended.err


PLY = """ply
format ascii 1.0
element vertex 4
property float x
property float y
property float z
element face {count}
property list uchar int vertex_indices
end_header
0 0 0
1 0 0
0 1 0
0 0 1
3 0 2 1
3 0 1 3
3 1 2 3
3 2 0 3
"""


@pytest.mark.parametrize("count", ["", "four", "2147483647", "-3000000000", "9" * 5000])
def test_a_ply_with_a_damaged_head_costs_only_itself(run, model, tmp_path, count):
    """Blender's importer ends the program there, or counts on so many faces; an old answer outlasted the run."""
    path = tmp_path / "head.ply"
    path.write_text(PLY.format(count=count))
    ended = run(path, model)
    assert ended.status == 1
    assert ended.answer["problems"] == [
        {"name": str(path), "problem": f"{path} could not be read: it is damaged or cut short"}]
    assert [mesh["model"] for mesh in ended.answer["objects"]] == [str(model)]


@pytest.mark.parametrize(("before", "after"), [
    ("element face", "comment element x\nelement  face"), ("\n", "\r\n"), ("face 4", "face\t4 ")])
def test_a_ply_with_an_unusual_head_is_read(imported, tmp_path, before, after):
    path = tmp_path / "head.ply"
    path.write_bytes(PLY.format(count=4).replace(before, after).encode())
    assert len(imported(path)["head"].data.polygons) == 4


def test_an_fbx_with_a_damaged_node_costs_only_itself(run, model, tmp_path):
    """Blender's importer took so much memory that the run was ended, or a minute to say why not."""
    path = tmp_path / "node.fbx"
    path.write_bytes(b"Kaydara FBX Binary  \0\x1a\0" + struct.pack("<4IB", 7400, 50, 2**31, 0, 0) + bytes(20))
    ended = run(path, model)
    assert ended.status == 1
    assert ended.answer["problems"] == [
        {"name": str(path), "problem": f"{path} could not be read: it is damaged or cut short"}]
    assert [mesh["model"] for mesh in ended.answer["objects"]] == [str(model)]


def test_an_fbx_is_read(imported, tmp_path):
    bpy.ops.wm.read_homefile(use_empty=True)
    bpy.ops.mesh.primitive_cube_add()
    bpy.ops.export_scene.fbx(filepath=str(tmp_path / "cube.fbx"))
    assert len(imported(tmp_path / "cube.fbx")["Cube"].data.polygons) == 6


@pytest.mark.parametrize("kind", ["ply", "abc", "fbx"])
def test_a_file_that_may_not_be_read_is_one_sentence(run, tmp_path, monkeypatch, kind):
    def fail(path, mode, *more):
        raise PermissionError(13, "Permission denied")

    path = tmp_path / f"closed.{kind}"
    path.write_bytes(b"")
    monkeypatch.setattr(Path, "open", fail)
    ended = run(path)
    assert ended.status == 1
    assert f"{path} could not be read: Permission denied" in ended.err


if not (bpy.app.build_options.usd and bpy.app.build_options.alembic):

    @pytest.mark.parametrize("kind", ["usda", "abc"])
    def test_a_blender_without_either_says_so(package, kind, tmp_path, monkeypatch):
        path = usda(tmp_path / f"model.{kind}", cube("A"))
        assert refusals(package, path, monkeypatch) == (
            f"this Blender has no importer of .{kind}", f"this Blender was built without an importer of .{kind}")
        assert path.with_suffix(".none").is_file()

else:

    @pytest.mark.parametrize("name", SCENES)
    def test_what_is_read_of_usd(imported, name, tmp_path, monkeypatch):
        body, meshes, places = SCENES[name]
        path = usda(tmp_path / "model.usda", body)
        assert sorted(world(obj)[:, 0].mean() for obj in imported(path).values()) == pytest.approx(meshes)
        vertices, polygons = read(path, monkeypatch)
        assert sorted(vertices.reshape(-1, 8, 3)[:, :, 0].mean(axis=1)) == pytest.approx(places)
        assert polygons in (6 * len(places), 6 * len(places) - (name == "a corner that does not exist"))

    def test_meshes_that_move_are_those_of_frame_0_or_the_first(imported, tmp_path, monkeypatch):
        for first, size in ((-5, 2), (0, 2), (3, 1)):
            times = {first: points(1), 0: points(2), 9: points(3)} if first <= 0 else {3: points(1), 9: points(3)}
            samples = ", ".join(f"{time}: {where}" for time, where in sorted(times.items()))
            path = usda(tmp_path / f"{first}.usda", cube("A", f"points.timeSamples = {{{samples}}}"))
            assert world(imported(path)["A"]).max() == size
            assert read(path, monkeypatch)[0].max() == size

    def test_units_and_axes_are_those_of_the_file(imported, tmp_path):
        """A model in centimeters whose y is up, in meters where Blender does that: from 4.5 on."""
        path = usda(tmp_path / "model.usda", placed("Xform", "G", 5, cube("A", more=SUBSETS) + """
            double3 xformOp:scale = (1, 2, 3)""").replace('["', '["xformOp:scale", "'), "Y", 0.01)
        for kind in ("Red", "Blue"):
            path.write_text(path.read_text() + f'def Material "{kind}" {{\n}}\n')
        (obj,) = imported(path).values()
        scale = 0.01 if bpy.app.version >= (4, 5) else 1.0
        assert np.ptp(world(obj), axis=0) == pytest.approx(scale * np.array([2, 6, 4]))
        assert [material.name for material in obj.data.materials] == ["Red", "Blue"]
        assert [polygon.material_index for polygon in obj.data.polygons] == [0, 0, 1, 1, 1, 1]

    @pytest.mark.parametrize("kind", ["usdc", "usdz", "abc"])
    def test_what_blender_exports_is_read_whole_or_refused(package, imported, make, tree, kind, tmp_path, monkeypatch):
        """The end of an Alembic file that was cut short crashed Blender."""
        make(tree).location.x = 7
        path, short = tmp_path / f"model.{kind}", tmp_path / f"short.{kind}"
        if kind == "abc":
            bpy.ops.wm.alembic_export(filepath=str(path), start=1, end=1)
        else:
            bpy.ops.wm.usd_export(filepath=str(path))
        (obj,) = imported(path).values()
        assert len(obj.data.polygons) == len(tree[1])
        assert world(obj) == pytest.approx(tree[0] + [7, 0, 0], abs=1e-5)
        assert read(path, monkeypatch)[0] == pytest.approx(tree[0] + [7, 0, 0], abs=1e-5)
        for content in (path.read_bytes()[:-400], b"", b"Ogawa", b"no model at all"):
            short.write_bytes(content)
            with pytest.raises(RuntimeError, match="Could not open|cut short|damaged"):
                imported(short)

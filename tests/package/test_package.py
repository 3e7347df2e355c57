# SPDX-License-Identifier: GPL-3.0-or-later
"""The installed package: what is in it, and what it takes."""

import gc
import json
import os
import re
import struct
import subprocess
import sys
import warnings
import zipfile
from pathlib import Path

import numpy as np
import pytest
import reeb_parts
import shapes
import trimesh
from reeb_parts import model_files
from reeb_parts.core.metrics import cut_discrepancy
from reeb_parts.outputs import picture_bytes

from core import VERSION, decompose

ROOT = Path(__file__).resolve().parents[2]
VERTICES, FACES = shapes.box()


def test_the_wheel_has_all_of_core_and_of_the_package_and_nothing_of_blender(wheel):
    with zipfile.ZipFile(wheel) as archive:
        names = {name for name in archive.namelist() if ".dist-info/" not in name}
    tree = {path.relative_to(ROOT).as_posix() for folder in ("core", "package") for path in (ROOT / folder).rglob("*")
            if path.is_file() and "__pycache__" not in path.parts}
    wanted = {f"reeb_parts/{name}" if name.startswith("core/") else f"reeb_parts/{name.removeprefix('package/')}"
              for name in tree}
    assert names == wanted
    assert "reeb_parts/py.typed" in names


def test_it_has_the_version_of_core(wheel):
    assert reeb_parts.__version__ == VERSION
    assert wheel.name == f"reeb_parts-{VERSION}-py3-none-any.whl"


def test_it_runs_from_the_wheel_as_it_is(wheel, tmp_path):
    """As Python runs a module, out of a zip; two boxes that touch need every model that ships but that of sheets."""
    boxes = trimesh.util.concatenate([trimesh.creation.box(), trimesh.creation.box().apply_translation([0.9, 0.3, 1])])
    boxes.export(tmp_path / "boxes.obj")
    done = subprocess.run([sys.executable, "-m", "reeb_parts", "decompose", "boxes.obj"], cwd=tmp_path, check=False,
                          capture_output=True, text=True, env={**os.environ, "PYTHONPATH": str(wheel)})
    assert done.returncode == 0, done.stderr
    assert '"faces": 24' in done.stdout


def test_it_has_every_name_of_core():
    import core

    assert set(core.__all__) <= set(reeb_parts.__all__)
    assert reeb_parts.Parameters is reeb_parts.core.Parameters
    assert Path(reeb_parts.__file__).parents[1] != ROOT


def test_a_name_is_imported_when_it_is_used():
    """The command hears Ctrl+C before NumPy is there."""
    words = "import sys, reeb_parts as r; print('numpy' in sys.modules, *set(r.__all__).difference(dir(r)))"
    done = subprocess.run([sys.executable, "-c", words], capture_output=True, text=True, check=True, timeout=60)
    assert done.stdout == "False\n"
    assert all(hasattr(reeb_parts, name) for name in reeb_parts.__all__)
    assert not hasattr(reeb_parts, "no_such_name")


#: The command in a Python in which no package is installed but those of a list.
ALONE = """
import sys
from importlib.machinery import PathFinder
from importlib.metadata import packages_distributions
hidden = packages_distributions().keys() - set(sys.argv[3:])
class Finder(PathFinder):
    @classmethod
    def find_spec(cls, name, path=None, target=None):
        return None if name.partition(".")[0] in hidden else super().find_spec(name, path, target)
sys.meta_path[sys.meta_path.index(PathFinder)] = Finder
from reeb_parts.command.main import main
sys.exit(main(["decompose", sys.argv[1], "--colored", sys.argv[2], "--n-parts", "3"]))
"""


def test_a_model_with_texture_coordinates_needs_no_other_packages_than_are_named(wheel, tmp_path):
    """What pip brings along is enough; other packages of this environment are hidden."""
    with zipfile.ZipFile(wheel) as archive:
        text = archive.read(f"reeb_parts-{VERSION}.dist-info/METADATA").decode().partition("\n\n")[0]
    needed = [re.split("[<>=]", line.removeprefix("Requires-Dist: "))[0] for line in text.splitlines()
              if line.startswith("Requires-Dist: ") and "extra ==" not in line]
    assert {"numpy", "scipy", "trimesh"} < set(needed)
    names = ["PIL" if name == "pillow" else name for name in needed]
    for colored in ("spot.ply", "spot.glb"):
        done = subprocess.run(
            [sys.executable, "-c", ALONE, ROOT / "models" / "spot.obj", tmp_path / colored, "reeb_parts", *names],
            capture_output=True, text=True, check=False, timeout=100)
        assert done.returncode == 0, done.stderr
        assert (tmp_path / colored).is_file()


@pytest.mark.parametrize("mesh", [
    lambda shape: (shape.vertices.tolist(), shape.faces.tolist()),
    lambda shape: (trimesh.Trimesh(*shape, process=False),),
    lambda shape: (reeb_parts.TriMesh(*shape),),
], ids=["lists", "trimesh", "TriMesh"])
def test_every_kind_of_mesh_gives_what_core_gives_for_its_arrays(mesh, tree):
    expected = decompose(*tree)
    result = reeb_parts.decompose(*mesh(tree))
    assert (result.candidates == expected.candidates).all()
    assert (result.hierarchy.merges == expected.hierarchy.merges).all()
    assert (result.parts(n_parts=3).labels == expected.parts(n_parts=3).labels).all()


def test_parameters_reach_core(tree):
    mesh = trimesh.Trimesh(*tree, process=False)
    result = reeb_parts.decompose(mesh, parameters={"n_parts": 2})
    assert result.parts().count == 2


def test_what_is_no_mesh_is_refused():
    with pytest.raises(reeb_parts.MeshError, match="ndarray is no mesh: give vertices and faces"):
        reeb_parts.decompose(np.zeros((4, 3)))


def test_colors_of_faces_are_those_of_their_parts(tree):
    parts = reeb_parts.decompose(*tree).parts()
    colors = reeb_parts.face_colors(parts)
    assert colors.dtype == np.uint8
    pairs = np.unique(np.column_stack([parts.labels, colors]), axis=0)
    assert len(pairs) == parts.count == len(np.unique(colors, axis=0))
    mesh = trimesh.Trimesh(*tree, process=False)
    mesh.visual.face_colors = colors
    assert (mesh.visual.face_colors == colors).all()


@pytest.mark.parametrize("what", [3, None, [0, 1], "parts"])
def test_what_has_no_parts_has_no_colors(what):
    with pytest.raises(reeb_parts.ReebError, match=rf"not of {type(what).__name__}\.$"):
        reeb_parts.face_colors(what)


def test_a_result_has_colors_once_its_parts_are_read(tree):
    with pytest.raises(reeb_parts.ParameterError, match="not of Decomposition"):
        reeb_parts.face_colors(reeb_parts.decompose(*tree))


def test_an_unknown_parameter_has_an_error_of_its_own():
    with pytest.raises(reeb_parts.UnknownParameterError) as caught:
        reeb_parts.Parameters(detial=0.5)
    assert caught.value.name == "detial"


@pytest.mark.parametrize("path", [None, 5, b"model.obj"])
def test_what_is_no_path_is_no_model(path):
    with pytest.raises(reeb_parts.ParameterError, match=r"^path must be the name of a file, not \w+\.$"):
        reeb_parts.read_model(path)


def test_points_without_faces_are_no_models(tmp_path):
    """trimesh counts .xyz among the files of meshes; the list of kinds offered it."""
    (tmp_path / "points.xyz").write_text("0 0 0\n1 0 0\n0 1 0\n")
    with pytest.raises(reeb_parts.ModelFileError, match=r"points\.xyz is none of ") as caught:
        reeb_parts.read_model(tmp_path / "points.xyz")
    assert str(caught.value).count(".xyz") == 1


@pytest.mark.parametrize("kind", ["obj", "ply", "stl", "glb", "off"])
def test_models_are_read_in_the_order_of_the_file(kind, tmp_path):
    shape = shapes.tube_tree(step=0.2)
    path = tmp_path / f"tree.{kind}"
    trimesh.Trimesh(*shape, process=False).export(path)
    model = reeb_parts.read_model(path)
    assert model.name == "tree"
    assert model.up == ("z" if kind in ("stl", "ply") else "y")
    assert np.allclose(model.vertices[model.faces], shape.vertices[shape.faces], atol=1e-6)
    assert (model.polygon == np.arange(len(shape.faces))).all()


def test_arrays_are_read_as_they_are(tmp_path):
    shape = shapes.tube_tree(step=0.2)
    np.savez(tmp_path / "tree.npz", vertices=shape.vertices, faces=shape.faces)
    model = reeb_parts.read_model(tmp_path / "tree.npz")
    assert repr(model) == f"<Model tree: {len(shape.vertices)} vertices, {len(shape.faces)} triangles, y up>"
    assert (model.vertices == shape.vertices).all()
    assert (model.faces == shape.faces).all()


@pytest.mark.parametrize("kind", ["<i4", ">f4", "<u8", "<f8"])
def test_vertices_of_arrays_are_float64_whatever_is_stored(kind, tmp_path):
    shape = shapes.octahedron()
    np.savez(tmp_path / "one.npz", vertices=shape.vertices.astype(kind), faces=shape.faces.astype(">i2"))
    model = reeb_parts.read_model(tmp_path / "one.npz")
    assert (model.vertices.dtype, model.faces.dtype, model.polygon.dtype) == (np.float64, np.int64, np.int64)
    assert (model.vertices == shape.vertices.astype(kind)).all()


@pytest.mark.parametrize(("said", "up"), [
    ("<up_axis>Z_UP</up_axis>", "z"), ("<up_axis>\n Y_UP\n</up_axis>", "y"), ("", "y")])
def test_a_dae_says_which_axis_is_up(said, up, tmp_path):
    """Models that Blender had written lay on their side in pictures."""
    shape = trimesh.Trimesh(*shapes.octahedron(), process=False)
    text = trimesh.exchange.dae.export_collada(shape).decode()
    before, after = text[: text.index("<up_axis")], text[text.index("</up_axis>") + len("</up_axis>") :]
    (tmp_path / "model.dae").write_text(before + said + after, encoding="utf-8")
    model = reeb_parts.read_model(tmp_path / "model.dae")
    assert model.up == up
    assert np.allclose(np.sort(model.vertices[model.faces].reshape(-1)), np.sort(shape.triangles.reshape(-1)))


@pytest.mark.parametrize(("before", "words"), [
    ("<p>", "Corrupted index"), ("<float_array[^>]*>", "Corrupted float array"),
    ('<instance_effect url="#', "Effect not found")])
def test_a_dae_with_a_damaged_mesh_is_refused(before, words, tmp_path):
    """The mesh was left out without a word: of two the other was decomposed, and of one it was said to be none."""
    meshes = [trimesh.Trimesh(*shapes.octahedron(), process=False) for _ in range(2)]
    text = trimesh.exchange.dae.export_collada(meshes).decode()
    damaged = re.sub(f"({before})", r"\1x", text, count=1)
    assert damaged != text
    (tmp_path / "model.dae").write_text(damaged, encoding="utf-8")
    with pytest.raises(reeb_parts.ModelFileError, match=words):
        reeb_parts.read_model(tmp_path / "model.dae")


def test_quads_of_arrays_are_one_face_each(tmp_path):
    vertices, quads = shapes.box_quads()
    np.savez(tmp_path / "box.npz", vertices=vertices, faces=quads)
    model = reeb_parts.read_model(tmp_path / "box.npz")
    assert np.array_equal(model.polygon, np.repeat(np.arange(6), 2))
    assert reeb_parts.decompose(model).n_faces == 6


@pytest.mark.parametrize(("arrays", "said"), [
    ({"faces": FACES + 0.4}, "Face indices must be whole numbers"),
    ({"vertices": VERTICES + 1j}, "Vertices must be rows of three numbers"),
    ({"vertices": VERTICES[:, :2]}, r"vertices must have shape \(n, 3\), not \(8, 2\)"),
    ({"vertices": None}, "it has no arrays of numbers vertices and faces"),
    ({"faces": None}, "it has no arrays of numbers vertices and faces"),
    ({"faces": np.array([[0, 1, 2], [1, 2]], object)}, "it has no arrays of numbers vertices and faces"),
    ({"faces": FACES[:, :2]}, "12 faces have fewer than three corners"),
    ({"faces": FACES + 3}, "1. of 12 faces name a vertex that does not exist"),
])
def test_arrays_that_are_no_mesh_are_refused(tmp_path, arrays, said):
    given = {"vertices": VERTICES, "faces": FACES} | arrays
    np.savez(tmp_path / "box.npz", **{name: array for name, array in given.items() if array is not None})
    with pytest.raises(reeb_parts.ModelFileError, match=f"box.npz could not be read: {said}"):
        reeb_parts.read_model(tmp_path / "box.npz")


def test_what_is_no_npz_is_said_to_have_no_arrays(tmp_path):
    (tmp_path / "junk.npz").write_bytes(np.random.default_rng(0).bytes(500))
    with pytest.raises(reeb_parts.ModelFileError, match="it has no arrays of numbers vertices and faces"):
        reeb_parts.read_model(tmp_path / "junk.npz")


def test_meshes_of_other_libraries_are_drawn_and_compared():
    mesh = trimesh.Trimesh(VERTICES, FACES, process=False)
    result = reeb_parts.decompose(mesh)
    parts = result.parts()
    assert picture_bytes(mesh, result, parts, 16).startswith(b"\x89PNG")
    assert cut_discrepancy(mesh, np.arange(12) // 6, np.arange(12) // 6) == 0
    for wrong in (None, VERTICES):
        with pytest.raises(reeb_parts.MeshError, match="is no mesh: give vertices and faces"):
            picture_bytes(wrong, result, parts, 16)
        with pytest.raises(reeb_parts.MeshError, match="is no mesh: give vertices and faces"):
            cut_discrepancy(wrong, parts.labels, parts.labels)
    for size in (0, -1, "a", 1.5, None, 5000):
        with pytest.raises(reeb_parts.ParameterError, match="whole number of pixels, 1 to 4096"):
            picture_bytes(mesh, result, parts, size)
    with pytest.raises(reeb_parts.ParameterError, match="The parts are of 12 faces, the model has 8"):
        picture_bytes(trimesh.Trimesh(*shapes.octahedron(), process=False), result, parts, 16)


def test_damaged_arrays_are_not_left_open(tmp_path):
    (tmp_path / "tree.npz").write_bytes(b"PK\x03\x04 and no end")
    with warnings.catch_warnings(record=True) as found:
        warnings.simplefilter("always")
        with pytest.raises(reeb_parts.ModelFileError, match="could not be read: it is damaged, or .*BadZipFile"):
            reeb_parts.read_model(tmp_path / "tree.npz")
        gc.collect()
    assert [str(warning.message) for warning in found] == []


def test_an_obj_with_materials_and_texture_seams_keeps_the_order_of_its_faces(tmp_path):
    vertices, faces = shapes.octahedron()
    lines = [*(f"v {x} {y} {z}" for x, y, z in vertices), "vt 0 0", "vt 1 0", "vt 0 1"]
    for number, (a, b, c) in enumerate((faces + 1).tolist()):
        lines += [f"usemtl {'even' if number % 2 == 0 else 'odd'}", f"f {a}/1 {b}/2 {c}/3"]
    (tmp_path / "model.obj").write_text("\n".join(lines))
    model = reeb_parts.read_model(tmp_path / "model.obj")
    assert (model.vertices[model.faces] == vertices[faces]).all()


@pytest.mark.parametrize("corner", ["{0}", "{0}/1", "{0}//2", "{0}/1/2"])
def test_polygons_of_an_obj_are_faces_and_concave_ones_are_cut_right(corner, tmp_path):
    square = [(0, 0), (4, 0), (4, 4), (2, 1), (0, 4)]  # with a notch, so that no fan of corner 0 is right
    vertices = np.array([(x, y, z) for z in (0, 1) for x, y in square], float)
    sides = [[i, (i + 1) % 5, 5 + (i + 1) % 5, 5 + i] for i in range(4)]
    faces = [[0, 4, 3, 2, 1], [5, 6, 7, 8, 9], *sides, [4, 0, 5], [4, 5, 9]]
    lines = [*(f"v {x} {y} {z}" for x, y, z in vertices), "vt 0 0", "vn 0 0 1", "vn 0 1 0", "g some"]
    lines += ["f " + " ".join(corner.format(place + 1) for place in face) for face in faces]
    lines[-3] = lines[-3].replace(" ", " \\\n", 3)  # goes on in the next line
    path = tmp_path / "model.obj"
    path.write_text("\n".join(lines))
    model = reeb_parts.read_model(path)
    assert model.polygon.tolist() == [0, 0, 0, 1, 1, 1, 2, 2, 3, 3, 4, 4, 5, 5, 6, 7]
    for polygon, face in enumerate(faces):
        used = model.vertices[model.faces[model.polygon == polygon]].reshape(-1, 3)
        assert {tuple(place) for place in used} == {tuple(place) for place in vertices[face]}
    parts = reeb_parts.decompose(model).parts()
    assert len(parts.labels) == len(faces)
    around = np.linalg.norm(np.roll(square, -1, axis=0) - square, axis=1).sum()
    assert parts.area.sum() == pytest.approx(2 * 10 + around)


def test_meshes_of_a_scene_come_in_their_places(tmp_path):
    scene = trimesh.Scene()
    for place in (0.0, 5.0):
        scene.add_geometry(trimesh.Trimesh(*shapes.octahedron(), process=False),
                           transform=trimesh.transformations.translation_matrix((place, 0, 0)))
    scene.export(tmp_path / "two.glb")
    model = reeb_parts.read_model(tmp_path / "two.glb")
    assert len(model.faces) == 16
    assert sorted({round(x) for x in model.vertices[:, 0].tolist()}) == [-1, 0, 1, 4, 5, 6]


@pytest.mark.parametrize(("name", "text", "words"), [
    ("comma.obj", "v 0,5 1 2\nf 1 1 1", "0,5 is no coordinate"),
    ("name.obj", "v 0 1 2\nf 1 1 x", "x stands where a face has the number of a vertex or of its corners"),
    ("large.off", "OFF\n1 1 0\n0 0 0\n99999999999999999999 0 0 0\n", "99999999999999999999 stands where a face has"),
    ("word.stl", "facet normal 0 0 1 vertex 0 0 \0 vertex 1 0 0 vertex 0 1 0 endfacet", r"\\x00 is no coordinate"),
    ("flat.ply", "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\n"
     "property list uchar int z\nend_header\n1 0\n", "its vertices have no x, y and z"),
    ("cut.ply", "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nend_header\n",
     "it is damaged, or has what plyfile does not read .*early end-of-file"),
    ("deep.gltf", "[" * 100_000, "its description of a scene is no JSON .*recursion"),
    ("list.gltf", '{"meshes": [{}], "scenes": [{"nodes": [0]}]}',
     "its description of a scene lacks something, or has something else in its place"),
    ("away.gltf", json.dumps({"asset": {"version": "2.0"}, "buffers": [{"uri": "away.bin", "byteLength": 1}]}),
     "away.bin, which it refers to, is not there"),
    ("seek.npz", "PK\3\4" + "-" * 60 + "PK\5\6" + "\0" * 8 + "\x7f" * 10,
     "it is damaged, or has what NumPy does not read"),
])
def test_a_damaged_model_is_one_sentence(name, text, words, tmp_path):
    """Some were Python's own: could not convert string to float, KeyError: 'inf', Invalid argument."""
    (tmp_path / name).write_bytes(text.encode("latin-1"))
    with pytest.raises(reeb_parts.ModelFileError, match=f"/{name} could not be read: {words}"):
        reeb_parts.read_model(tmp_path / name)


def test_what_goes_wrong_in_our_own_readers_is_no_damage_of_the_model(tmp_path, monkeypatch):
    """Any exception there was the sentence of a damaged file, so that nobody would have reported it."""
    def wrong(text):
        raise KeyError(len(text))

    monkeypatch.setitem(model_files._READERS, ".obj", model_files._by_bytes(wrong))
    (tmp_path / "model.obj").write_text("v 0 0 0")
    with pytest.raises(KeyError, match="7"):
        reeb_parts.read_model(tmp_path / "model.obj")


@pytest.mark.parametrize(("name", "text", "words"), [
    ("there_is_none.obj", None, "There is no file"),
    ("", None, "is a folder, not a model"),
    (f"{'x' * 300}.obj", None, "obj could not be read: "),  # no system has such names
    ("model.xyzzy", "", "is none of"),
    ("damaged.ply", "ply\nformat nonsense", "could not be read"),
    ("empty.obj", "# nothing\n", "empty.obj"),
    ("scene.blend", "", "Blender only"),
])
def test_what_cannot_be_read_gets_one_sentence(name, text, words, tmp_path):
    if text is not None:
        (tmp_path / name).write_text(text)
    with pytest.raises(reeb_parts.ModelFileError, match=words) as caught:
        reeb_parts.read_model(tmp_path / name)
    assert "\n" not in str(caught.value)


def test_the_mirror_of_a_half_model_reaches_core():
    half = shapes.half_of(shapes.mirrored_figure())
    mesh = trimesh.Trimesh(*half, process=False)
    result = reeb_parts.decompose(mesh, mirror=(1.0, 0.0, 0.0, 0.0))
    expected = decompose(*half, mirror=(1.0, 0.0, 0.0, 0.0))
    assert (result.parts().labels == expected.parts().labels).all()
    assert (result.candidates != reeb_parts.decompose(mesh).candidates).any()


def test_what_is_taken_for_faces_by_mistake_says_what_to_give(tree):
    mesh = trimesh.Trimesh(*tree, process=False)
    for parameters in (reeb_parts.Parameters(), {"detail": 0.5}):
        with pytest.raises(reeb_parts.MeshError, match="parameters="):
            reeb_parts.decompose(mesh, parameters)
    with pytest.raises(reeb_parts.MeshError, match="Trimesh has faces of its own"):
        reeb_parts.decompose(mesh, mesh.faces)
    with pytest.raises(reeb_parts.MeshError, match="Scene is no mesh: decompose what its to_mesh"):
        reeb_parts.decompose(trimesh.Scene([mesh]))
    assert reeb_parts.decompose(trimesh.Scene([mesh]).to_mesh()).n_faces == len(tree.faces)


def test_an_fbx_that_would_take_all_memory_is_refused_before_a_blender_starts(tmp_path):
    path = tmp_path / "node.fbx"
    path.write_bytes(b"Kaydara FBX Binary  \0\x1a\0" + struct.pack("<4IB", 7400, 50, 2**31, 0, 0) + bytes(20))
    with pytest.raises(reeb_parts.ModelFileError, match=r"node\.fbx could not be read: it is damaged or cut short"):
        reeb_parts.read_model(path, "no blender")

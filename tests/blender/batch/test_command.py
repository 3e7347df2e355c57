# SPDX-License-Identifier: GPL-3.0-or-later
"""The command when something goes wrong: what it leaves, what it says, how it ends."""

import json
import os
import re
import signal
import time
from importlib import import_module
from pathlib import Path

import bmesh
import bpy
import numpy as np
import process
import pytest
import shapes
from scipy.spatial import cKDTree
from systems import unix
from threemf_reader import read_3mf


@pytest.fixture
def two(tree, tmp_path):
    """A model of the tree and of a triangle, which has no parts."""
    path = process.write_obj(tmp_path / "two.obj", tree)
    with path.open("a") as file:
        file.write("o Triangle\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf -3 -2 -1\n")
    return path


def test_standard_output_is_one_json_object(run, model, tmp_path):
    ended = run(model, "--json", tmp_path / "out.json", "--parts", tmp_path / "parts", "--save", tmp_path / "x.blend")
    assert ended.status == 0
    assert ended.out == (tmp_path / "out.json").read_text()
    assert ended.answer["problems"] == []
    names = {str(path.relative_to(tmp_path)) for path in tmp_path.rglob("*") if path.is_file()}
    parts = {str(Path(name).relative_to(tmp_path)) for name in ended.answer["files"]["parts"]}
    assert names == {"own.obj", "out.json", "x.blend", *parts, *(part.replace(".obj", ".mtl") for part in parts)}
    assert new_points(model, ended.answer["files"]["parts"]) == 0


def test_parts_in_files_are_cut_as_asked(run, model, tmp_path):
    """Where a cut runs smoothly, faces are divided: the parts have points that the model has not."""
    ended = run(model, "--cuts", "smooth", "--parts", tmp_path)
    assert new_points(model, ended.answer["files"]["parts"]) > 20


@pytest.mark.skipif(os.name == "nt", reason="there a folder stays while somebody works in it")
@pytest.mark.parametrize("arguments", [["MODEL", "--json", "x.json"], ["own.obj"]])
def test_a_working_folder_that_is_gone_is_one_sentence(arguments, run, model, tmp_path, monkeypatch):
    (tmp_path / "gone").mkdir()
    monkeypatch.chdir(tmp_path / "gone")
    (tmp_path / "gone").rmdir()
    ended = run(*(model if word == "MODEL" else word for word in arguments))
    assert (ended.status, ended.out) == (1, "")
    assert "The folder in which the command was started is gone." in ended.err


def new_points(model, parts):
    """How many points of the files of parts are nowhere in the model, all of them .obj."""
    known, found = ([line.split()[1:4] for path in paths for line in Path(path).read_text().splitlines()
                     if line.startswith("v ")] for paths in ([model], parts))
    return int((cKDTree(np.array(known, float)).query(np.array(found, float))[0] > 1e-4).sum())


def test_the_answer_says_of_each_part_whether_its_piece_is_sound(run, model, tmp_path):
    """The pieces enclose together what the model encloses, and none of them stays in the file."""
    ended = run(model, "--check", "--save", tmp_path / "x.blend")
    checks = [part["check"] for part in ended.answer["objects"][0]["parts"]]
    schema = json.loads((Path(__file__).resolve().parents[3] / "docs" / "reeb_parts.schema.json").read_text())
    wanted = schema["$defs"]["check"]
    assert all(set(found) == set(wanted["required"]) == set(wanted["properties"]) for found in checks)
    assert all(found["sound"] and found["all_tried"] and found["thinnest"] > 0 for found in checks)
    bpy.ops.wm.open_mainfile(filepath=str(tmp_path / "x.blend"))
    (mesh,) = bpy.data.meshes
    edited = bmesh.new()
    edited.from_mesh(mesh)
    assert sum(found["volume"] for found in checks) == pytest.approx(edited.calc_volume(), rel=1e-4)
    edited.free()


def test_parts_are_separated_with_joints(run, model, tmp_path):
    """The scene and the assembly have the pieces, closed and joined; the answer says of each cut what it has."""
    ended = run(model, "--pegs", "dowel", "--peg-count", "2", "--save", tmp_path / "x.blend",
                "--threemf", tmp_path / "x.3mf")
    (answer,) = ended.answer["objects"]
    assert len(answer["joints"]) == len(answer["parts"]) - 1
    assert all(cut["count"] and cut["width"] >= 2.0 and cut["reason"] is None for cut in answer["joints"])
    assert {index for cut in answer["joints"] for index in cut["parts"]} == set(range(len(answer["parts"])))
    schema = json.loads((Path(__file__).resolve().parents[3] / "docs" / "reeb_parts.schema.json").read_text())
    assert all(set(cut) == set(schema["$defs"]["joint"]["required"]) for cut in answer["joints"])
    bpy.ops.wm.open_mainfile(filepath=str(tmp_path / "x.blend"))
    pieces = [obj for obj in bpy.data.objects if "reeb_parts_number" in obj]
    assert len(pieces) == len(answer["parts"])
    assert all(json.loads(piece["reeb_parts_check"])["volume"] > 0 for piece in pieces)
    assert bpy.data.objects["Tree"].hide_render
    dowels = [obj for obj in bpy.data.objects if "reeb_parts_dowel" in obj]
    assert len(dowels) == sum(cut["count"] for cut in answer["joints"])
    bodies, _ = read_3mf(tmp_path / "x.3mf")
    assert sorted(body.name for body in bodies) == sorted(obj.name for obj in (*pieces, *dowels))
    bpy.context.view_layer.update()
    by_name = {body.name: body for body in bodies}
    for obj in (*pieces, *dowels):
        low = np.min([obj.matrix_world @ vertex.co for vertex in obj.data.vertices], axis=0)
        assert 1000 * low == pytest.approx(np.min(by_name[obj.name].vertices, axis=0), abs=1e-2)


def test_parts_fit_the_bed(run, model, tmp_path):
    ended = run(model, "--bed", "1000", "1200", "1100", "--parts", tmp_path / "parts", "--parts-format", "stl")
    assert len(ended.answer["files"]["parts"]) > len(ended.answer["objects"][0]["parts"])
    for path in ended.answer["files"]["parts"]:
        bpy.ops.wm.read_homefile(use_empty=True)
        bpy.ops.wm.stl_import(filepath=path)
        points = np.array([vertex.co for vertex in bpy.context.object.data.vertices])
        assert np.linalg.norm(np.ptp(points, axis=0)) < np.linalg.norm([1.0, 1.2, 1.1]) * 1.01


def test_what_fails_once_the_graph_is_drawn_is_taken_back(run, model, tmp_path, caplog):
    """The curve of the graph is drawn more than once, and the former ones were gone: tracebacks said so."""
    ended = run(model, "--bed", "1", "1", "1", "--save", tmp_path / "x.blend")
    assert ended.status == 1
    assert "There would be more than" in ended.err
    assert [record.message for record in caplog.records] == []
    assert not (tmp_path / "x.blend").exists()
    assert [len(kind) for kind in (bpy.data.curves, bpy.data.objects, bpy.data.meshes)] == [0, 1, 1]


def test_what_is_made_of_the_parts(run, model, tmp_path):
    """A UV map, an armature and rigid bodies in the scene, and an assembly of the parts, all whole."""
    ended = run(model, "--unwrap", "--armature", "--hulls", "unreal", "--hulls-per-part", "1", "--rigid-bodies",
                "point", "--threemf", tmp_path / "out.3mf", "--save", tmp_path / "out.blend")
    assert ended.status == 0
    assert ended.answer["files"]["threemf"] == str(tmp_path / "out.3mf")
    bodies, places = read_3mf(tmp_path / "out.3mf")
    assert [body.name for body in bodies] == [f"Tree {part['name']}" for part in ended.answer["objects"][0]["parts"]]
    assert len(places) == 1
    bpy.ops.wm.open_mainfile(filepath=str(tmp_path / "out.blend"))
    tree, parts = bpy.data.objects["Tree"], ended.answer["objects"][0]["parts"]
    assert "Reeb Parts UV" in tree.data.uv_layers
    assert sum(name.startswith("UCX_Tree_") for name in bpy.data.objects.keys()) == len(parts)
    assert sum(obj.rigid_body is not None for obj in bpy.data.objects) == len(parts)
    joints = bpy.context.scene.rigidbody_world.constraints.objects
    assert {joint.rigid_body_constraint.type for joint in joints} == {"POINT"}
    assert sorted(tree.modifiers[0].object.data.bones.keys()) == [f"DEF-{part['name']}" for part in parts]


def test_a_scene_that_was_saved_with_all_of_it_is_the_same_after_another_run(run, obj, tmp_path):
    """Joints held pieces that were replaced in the same run: they stayed, named "Reeb Parts, to be removed" or so."""
    names = []
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "0.blend"))
    for before, after in (("0.blend", "1.blend"), ("1.blend", "2.blend")):
        ended = run(tmp_path / before, "--separate", "--rigid-bodies", "--hulls", "godot", "--armature", "--unwrap",
                    "--materials", "--save", tmp_path / after)
        assert ended.status == 0
        bpy.ops.wm.open_mainfile(filepath=str(tmp_path / after))
        names.append({kind: sorted(item.name for item in getattr(bpy.data, kind))
                      for kind in ("objects", "meshes", "curves", "collections", "armatures", "materials")})
        joints = bpy.context.scene.rigidbody_world.constraints.objects
        ends = {end for joint in joints for end in (joint.rigid_body_constraint.object1,
                                                    joint.rigid_body_constraint.object2)}
        assert ends == set(bpy.context.scene.rigidbody_world.collection.objects)
    assert names[0] == names[1]
    assert any(" - " in name for name in names[0]["objects"])


def test_an_object_that_cannot_be_cut_costs_only_itself(run, two, tmp_path):
    ended = run(two, "--json", tmp_path / "out.json", "--save", tmp_path / "out.blend")
    assert ended.status == 1
    assert [report["name"] for report in ended.answer["objects"]] == ["Tree"]
    (problem,) = ended.answer["problems"]
    assert problem["name"] == "Triangle"
    assert problem["problem"] in ended.err
    assert (tmp_path / "out.json").read_text() == ended.out
    bpy.ops.wm.open_mainfile(filepath=str(tmp_path / "out.blend"))
    assert len(bpy.data.objects["Tree"].data.reeb_parts.parts) == len(ended.answer["objects"][0]["parts"])


def test_a_lack_of_memory_while_files_are_written_is_one_sentence(package, run, model, tmp_path, monkeypatch):
    """It ended in a traceback, where a lack of memory before was a sentence."""
    def fail(path):
        raise MemoryError

    (tmp_path / "out.json").write_text("an earlier one")
    (tmp_path / "x.blend").write_text("an earlier one")
    monkeypatch.setattr(import_module(f"{package}.scene.saving.file_checks"), "blend", fail)
    ended = run(model, "--json", tmp_path / "out.json", "--parts", tmp_path / "parts", "--save", tmp_path / "x.blend")
    assert (ended.status, ended.out) == (1, "")
    assert "reeb_parts: There is not enough memory; nothing was written." in ended.err
    assert {path.name for path in tmp_path.iterdir()} == {"own.obj", "x.blend"}
    assert (tmp_path / "x.blend").read_text() == "an earlier one"


@pytest.mark.parametrize("damage", ["a mesh of two", "no mesh at all"])
def test_nothing_of_a_model_that_cannot_be_read_is_saved_with_the_others(run, model, tmp_path, damage):
    """Importers leave what they had read by then, or what is no mesh."""
    bpy.ops.wm.read_homefile(use_empty=True)
    bpy.ops.object.camera_add()
    if damage == "a mesh of two":
        bpy.ops.mesh.primitive_cube_add()
        bpy.ops.mesh.primitive_monkey_add()
        bpy.context.object.shape_key_add()
    path = tmp_path / "two.gltf"
    bpy.ops.export_scene.gltf(filepath=str(path), export_format="GLTF_SEPARATE", export_cameras=True)
    described = json.loads(path.read_text())
    for mesh in described.get("meshes", ())[1:]:
        described["accessors"][mesh["primitives"][0]["attributes"]["POSITION"]]["bufferView"] = 99
    path.write_text(json.dumps(described))
    ended = run(path, model, "--no-graph", "--save", tmp_path / "x.blend")
    assert ended.status == 1
    assert [problem["name"] for problem in ended.answer["problems"]] == [str(path)]
    bpy.ops.wm.open_mainfile(filepath=str(tmp_path / "x.blend"))
    assert [obj.name for obj in bpy.data.objects] == ["Tree"]
    assert len(bpy.data.meshes) == 1
    assert not bpy.data.cameras


def test_several_models_and_one_that_cannot_be_read_costs_only_itself(run, model, tmp_path):
    other, broken, missing = (tmp_path / name for name in ("other.obj", "empty.obj", "missing.obj"))
    other.write_bytes(model.read_bytes())
    broken.write_bytes(b"")
    ended = run(model, broken, other, missing, "--parts", tmp_path / "parts")
    assert ended.status == 1
    assert [mesh["model"] for mesh in ended.answer["objects"]] == [str(model), str(other)]
    assert [problem["name"] for problem in ended.answer["problems"]] == [str(broken), str(missing)]
    assert ended.answer["objects"][0]["parts"] == ended.answer["objects"][1]["parts"]
    assert len(list((tmp_path / "parts").glob("*.obj"))) == 2 * len(ended.answer["objects"][0]["parts"])
    assert "Traceback" not in ended.err


def test_a_scene_is_given_alone(run, model, tmp_path):
    ended = run(model, tmp_path / "scene.blend")
    assert ended.status == 1
    (tmp_path / "scene.blend").write_bytes(b"")
    ended = run(model, tmp_path / "scene.blend")
    assert ended.status == 1
    assert ended.answer["problems"][0]["problem"].endswith(
        "is none of .obj, .ply, .stl, .glb, .gltf, .fbx, .usd, .usda, .usdc, .usdz, .abc.")


def test_an_object_that_is_not_there_costs_only_itself(run, two, tmp_path):
    ended = run(two, "--object", "Tree", "--object", "Nobody")
    assert ended.status == 1
    assert [report["name"] for report in ended.answer["objects"]] == ["Tree"]
    assert [problem["name"] for problem in ended.answer["problems"]] == ["Nobody"]


def test_small_objects_are_computed_side_by_side(package, run, make, tree, tmp_path, monkeypatch):
    """The answer is that of one after the other, whatever cannot be decomposed among them, in the order of names."""
    triangle = shapes.Shape(np.eye(3), np.array([[0, 1, 2]]))
    for name, shape in zip("ABCDE", (tree, triangle, shapes.torus(), shapes.two_spheres(), tree), strict=True):
        make(shape, name)
    bpy.data.objects["E"].data = bpy.data.objects["A"].data
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "x.blend"))
    computing = import_module(f"{package}.batch.computing")
    monkeypatch.setattr(computing, "n_processors", lambda: 2)
    ended = run(tmp_path / "x.blend", "--object", "*")
    assert "4 objects: " in ended.err  # as many as have a mesh of their own
    monkeypatch.setattr(computing, "n_processors", lambda: 1)
    alone = run(tmp_path / "x.blend", "--object", "*")
    assert "objects: " not in alone.err
    assert [report["name"] for report in ended.answer["objects"]] == ["A", "C", "D", "E"]
    for one, other in zip(ended.answer["objects"], alone.answer["objects"], strict=True):
        assert {**one, "seconds": 0} == {**other, "seconds": 0}
    assert ended.answer["problems"] == alone.answer["problems"]
    assert [problem["name"] for problem in ended.answer["problems"]] == ["B"]


def test_names_of_objects_may_be_patterns(run, obj, make, tree, tmp_path):
    """All meshes of a scene whose active object is none; what was made of parts is not cut again with the rest."""
    make(tree, "Other")
    empty = bpy.data.objects.new("Empty", None)
    bpy.context.scene.collection.objects.link(empty)
    bpy.context.view_layer.objects.active = empty
    scene, cut, again = (tmp_path / name for name in ("x.blend", "y.blend", "z.blend"))
    bpy.ops.wm.save_as_mainfile(filepath=str(scene))

    def decomposed(path, *words):
        ended = run(path, *words)
        assert "Traceback" not in ended.err
        return [entry["name"] for entry in ended.answer["objects"]] if ended.status == 0 else ended.err

    assert "Empty, the active object, is no mesh: name a mesh with --object NAME" in decomposed(scene)
    assert decomposed(scene, "--object", "[!O]*", "--object", "Tree") == ["Tree"]
    assert "no mesh with a name like Tr? in the scene" in decomposed(scene, "--object", "Tr?")
    for path, saved in ((scene, cut), (cut, again)):
        uses = ("--separate", "--hulls", "unreal", "--save", saved)
        assert decomposed(path, "--object", "*", *uses) == ["Other", "Tree"]


@pytest.mark.parametrize("arguments", [
    ["missing.obj"], ["own.txt"], ["broken.blend"], ["broken.glb"], ["own.obj", "--detail", "7"],
    ["own.obj", "--object", "Nobody"], ["two.obj", "--object", "Triangle"], ["own.obj", "--save", "own.obj"],
    ["own.obj", "--parts", "own.obj"], ["own.obj", "--save", "broken.glb/x.blend"],
])
def test_an_old_answer_does_not_outlast_a_failed_run(run, model, two, tmp_path, arguments):
    for name in ("own.txt", "broken.blend", "broken.glb"):
        (tmp_path / name).write_text("BLENDER or what")
    before = process.content(tmp_path)
    (tmp_path / "out.json").write_text("an answer of yesterday")
    words = [str(tmp_path / word) if "." in word else word for word in arguments]
    ended = run(*words, "--json", tmp_path / "out.json")
    assert (ended.status, ended.out) == (2 if "--detail" in arguments else 1, "")
    assert process.content(tmp_path) == before
    said = [line for line in ended.err.splitlines() if line.startswith("reeb_parts: ")]
    assert said
    assert not any("Traceback" in line or ".reeb_parts" in line for line in said)
    if arguments[0] != "own.obj":
        assert any(arguments[0] in line or "Triangle" in line for line in said)


def test_what_is_no_answer_outlasts_a_failed_run(run, model, tmp_path):
    """A model that was named after --json by mistake was removed."""
    before = process.content(tmp_path)
    assert run(tmp_path / "missing.obj", "--json", model).status == 1
    assert process.content(tmp_path) == before


@pytest.mark.parametrize("option", ["--node-size", "--line-thickness", "--picture-turn"])
@pytest.mark.parametrize("value", ["nan", "inf", "-inf", "1e9", "-1e9", "x"])
def test_numbers_out_of_range_are_refused(run, model, option, value):
    ended = run(model, f"{option}={value}")
    assert (ended.status, ended.out) == (2, "")
    assert option in ended.err


@pytest.mark.parametrize("size", ["15x100", "100x8193", "100", "100x", "axb", "100x100x100", "nanx16"])
def test_a_picture_has_a_size_in_its_range(run, model, tmp_path, size):
    ended = run(model, "--picture", tmp_path / "x.png", "--picture-size", size)
    assert (ended.status, ended.out) == (2, "")
    assert (f"--picture-size: must be two whole numbers from 16 to 8192 with an x between them, such as 960x540, "
            f"not {size}") in ended.err


@unix
@pytest.mark.parametrize(("moment", "name"), [
    ("mesh 0%", "SIGINT"), ("cuts", "SIGTERM"), ("files", "SIGINT"), ("cuts", "SIGHUP"),
    *[("2 objects", "SIGINT")] * (hasattr(os, "sched_getaffinity") and len(os.sched_getaffinity(0)) > 1)])
def test_ctrl_c_leaves_nothing_half_written(model, tmp_path, tmp_path_factory, moment, name):
    said = tmp_path_factory.mktemp("said")  # files, not pipes: nobody reads while the process writes
    models = [model]
    if moment == "2 objects":
        models.append(process.write_obj(tmp_path / "other.obj", shapes.two_spheres()))
    before = process.content(tmp_path)
    (tmp_path / "out.json").write_text("an answer of yesterday")
    (tmp_path / "parts").mkdir()
    arguments = (*models, "--json", tmp_path / "out.json", "--save", tmp_path / "out.blend",
                 "--parts", tmp_path / "parts", "--parts-format", "stl", "--picture", tmp_path / "out.png")
    files = len(list(tmp_path.rglob("*")))
    with (open(said / "out", "w") as out, open(said / "err", "w") as err,
          process.start(*arguments, stdout=out, stderr=err) as running):
        reached = ((lambda: len(list(tmp_path.rglob("*"))) > files) if moment == "files"
                   else lambda: moment in (said / "err").read_text())
        while running.poll() is None and not reached():
            time.sleep(0.01)
        os.kill(running.pid, signal.Signals[name])
        other = signal.SIGTERM if name == "SIGINT" else signal.SIGINT
        while running.poll() is None:  # nor do more of them, as from somebody impatient, until the process has ended
            os.kill(running.pid, other)
            time.sleep(0.001)
    out, err = ((said / name).read_text() for name in ("out", "err"))
    # Of two that wait for Blender to go on, Python hears the one of smaller number first.
    assert running.returncode in {128 + signal.Signals[name], 128 + min(signal.Signals[name], other)}, err
    assert "{" not in out  # a full Blender says its version there
    assert "Interrupted; nothing was written." in err
    assert process.content(tmp_path) == before
    assert list((tmp_path / "parts").iterdir()) == []


@unix
def test_nohup_has_it_go_on(model, tmp_path, tmp_path_factory):
    said = tmp_path_factory.mktemp("said") / "err"
    nohup = "import signal; signal.signal(signal.SIGHUP, signal.SIG_IGN)"
    with (open(said, "w") as err,
          process.start(model, "--json", tmp_path / "out.json", before=nohup, stderr=err) as running):
        while running.poll() is None and "mesh 0%" not in said.read_text():
            time.sleep(0.01)
        os.kill(running.pid, signal.SIGHUP)
        running.communicate(timeout=120)
    assert running.returncode == 0
    assert json.loads((tmp_path / "out.json").read_text())["objects"]


@unix
def test_standard_output_and_pipes_are_no_files(run, model, tmp_path):
    assert run(model, "--json", "-").status == 2
    assert run(model, "--parts", "").status == 2  # as of a variable that is not set: it would be the working folder
    ended = run("/dev/null", "--json", tmp_path / "x.json")
    assert (ended.status, ended.out) == (1, "")
    assert "/dev/null is no file but a pipe or a device: write the model to a file first." in ended.err


@unix
def test_closed_streams(package, model, tmp_path, capfd):
    """Their numbers had both ends of a pipe of the library for sound; of one the command made the other, and Blender
    waited for that at its end for ever."""
    main = import_module(f"{package}.batch.command").main
    kept, ends = [os.dup(1), os.dup(2)], os.pipe()
    try:
        for stream, end in enumerate(ends, 1):
            os.dup2(end, stream, inheritable=False)
        status = main([str(model), "--json", str(tmp_path / "out.json")])
        nowhere = [os.path.samestat(os.fstat(stream), os.stat(os.devnull)) for stream in (1, 2)]
    finally:
        for stream, end, own in zip((1, 2), ends, kept, strict=True):
            os.dup2(own, stream)
            os.close(own)
            os.close(end)
    assert (status, nowhere) == (1, [True, True])
    assert json.loads((tmp_path / "out.json").read_text())["objects"]


@unix
def test_a_name_that_blender_would_cut_short_is_refused(run, tree, tmp_path):
    """It read the file of the shorter name, and said that this was the one."""
    folder = tmp_path.joinpath(*["d" * 200] * 4)
    folder.mkdir(parents=True)
    short = "x" * (1023 - len(os.fsencode(folder.resolve())) - 1)
    process.write_obj(folder / short, tree)
    process.write_obj(folder / f"{short}y.obj", shapes.octahedron())
    ended = run(folder / f"{short}y.obj")
    assert (ended.status, ended.out) == (1, "")
    assert "y.obj could not be read: Blender takes names of up to 1023 bytes, with all folders." in ended.err


@unix
@pytest.mark.parametrize("option", ["--save", "--picture", "--parts"])
def test_a_place_whose_name_blender_would_cut_short_is_refused(option, run, model, tmp_path):
    """It was said to be missing, or to be on a full disk; of pictures nothing was heard for minutes."""
    folder = tmp_path.joinpath(*["d" * 200] * 4)
    folder /= "x" * (1023 - len(os.fsencode(folder.resolve())) - 10)
    folder.mkdir(parents=True)
    name = {"--save": "longer.blend", "--picture": "longer.png", "--parts": "folder"}[option]
    ended = run(model, option, folder / name)
    assert (ended.status, ended.out) == (1, "")
    assert "could not be written: Blender takes names of up to 1023 bytes, with all folders." in ended.err
    assert list(folder.iterdir()) == []


@unix
def test_names_that_are_no_utf8_are_readable_in_the_answer(run, model):
    odd = Path(os.fsdecode(os.fsencode(model.parent) + b"/Stra\xdfe.json"))
    ended = run(model, model.with_name(odd.name).with_suffix(".obj"), "--json", odd)
    assert ended.answer["files"]["json"].endswith(r"Stra\xdfe.json")
    assert ended.answer["problems"][0]["name"].endswith(r"Stra\xdfe.obj")
    assert odd.is_file()


@pytest.fixture
def parser(package):
    return import_module(f"{package}.batch.options").parser("")


def test_the_help_says_the_range_and_the_default_of_every_number(parser):
    words, defaults = " ".join(parser.format_help().split()), vars(parser.parse_args([]))
    shown = dict(re.findall(r"--([a-z-]+) N (?:(?! --).)*?\([-\d.]+ to [\d.e+]+; default ([\d.]+)\)", words))
    missing = {option for option in re.findall(r"--([a-z-]+) N ", words)} - shown.keys() - {"hulls-per-part"}
    assert not missing
    names = {"peg-count": "joint_count", "peg-size": "joint_size", "peg-depth": "joint_depth",
             "peg-clearance": "joint_clearance", "peg-wall": "joint_wall"}
    assert names.keys() | {"node-size", "line-thickness"} <= shown.keys()
    for option, default in shown.items():
        known = defaults[names.get(option, option.replace("-", "_"))]
        assert known is None or float(default) == pytest.approx(known)  # a parameter's is that of the preset


def test_a_palette_is_named_as_in_the_panel_or_as_in_version_0_1_0(parser, capsys):
    palette = lambda *words: parser.parse_args(list(words)).palette  # noqa: E731
    assert palette("--palette", "Color-Blind Safe") == palette("--palette", "Colour-blind safe") == palette()
    assert palette("--palette", "Bright") == "Bright"
    assert "{Color-Blind Safe,Pastel,Bright}" in parser.format_help()
    assert "(default: Color-Blind Safe)" in " ".join(parser.format_help().split())
    with pytest.raises(SystemExit):
        palette("--palette", "Grey")
    assert "--palette: must be one of Color-Blind Safe, Pastel, Bright, not Grey" in capsys.readouterr().err


def test_the_help_says_what_is_on(package):
    parser = import_module(f"{package}.batch.options").parser("")
    words, defaults = " ".join(parser.format_help().split()), vars(parser.parse_args([]))
    shown = dict(re.findall(r"--([a-z-]+), --no-\1 (?:(?!--).)*\(default: (on|off)\)", words))
    assert len(shown) > 3
    assert {name: value == "on" for name, value in shown.items()} == {
        name: defaults[name.replace("-", "_")] for name in shown}


def test_a_rigged_glb_has_no_object_for_its_bones(run, obj, tmp_path):
    """Blender's importer makes one with which it shows them."""
    rig = bpy.data.objects.new("Rig", bpy.data.armatures.new("Rig"))
    bpy.context.scene.collection.objects.link(rig)
    bpy.context.view_layer.objects.active = rig
    bpy.ops.object.mode_set(mode="EDIT")
    for name in ("DEF-a", "DEF-b"):
        bone = rig.data.edit_bones.new(name)
        bone.head, bone.tail = (0, 0, 0), (0, 0, 1)
        obj.vertex_groups.new(name=name).add(range(len(obj.data.vertices)), 0.5, "REPLACE")
    bpy.ops.object.mode_set(mode="OBJECT")
    obj.parent = rig
    obj.modifiers.new("Armature", "ARMATURE").object = rig
    path = tmp_path / "rig.glb"
    bpy.ops.export_scene.gltf(filepath=str(path))
    bpy.ops.wm.read_homefile(use_empty=True)
    bpy.ops.import_scene.gltf(filepath=str(path))
    assert len([o for o in bpy.data.objects if o.type == "MESH"]) == 2
    ended = run(path, "--parts", tmp_path / "parts", "--picture", tmp_path / "x.png", "--picture-size", "64x64")
    assert [entry["name"] for entry in ended.answer["objects"]] == ["Tree"]
    assert all(file.name.startswith("Tree ") for file in (tmp_path / "parts").iterdir())


def test_a_model_in_millimeters(run, tree, tmp_path):
    """Is as large in a slicer as in its own unit; without a word a unit is a meter."""
    model = process.write_obj(tmp_path / "mm.obj", (tree[0] * 10.0, tree[1]))
    size = np.ptp(tree[0] * 10.0, axis=0)
    for unit, factor in ((["--unit", "mm"], 1.0), (["--unit", "cm"], 10.0), ([], 1000.0)):
        assert run(model, *unit, "--threemf", tmp_path / "x.3mf").status == 0
        bodies, _ = read_3mf(tmp_path / "x.3mf")
        points = np.concatenate([body.vertices for body in bodies])
        assert sorted(np.ptp(points, axis=0)) == pytest.approx(sorted(size * factor), rel=1e-3)
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "x.blend"))
    assert "a scene has its own" in run(tmp_path / "x.blend", "--unit", "mm").err
    bpy.ops.export_scene.gltf(filepath=str(tmp_path / "x.glb"))
    assert "has its own" in run(tmp_path / "x.glb", "--unit", "mm").err


def test_an_object_of_an_excluded_collection_costs_nobody_anything(run, obj, make, tree, tmp_path):
    make(tree, "Other")
    own = bpy.data.collections.new("Own")
    bpy.context.scene.collection.children.link(own)
    own.objects.link(obj)
    bpy.context.scene.collection.objects.unlink(obj)
    bpy.context.view_layer.layer_collection.children["Own"].exclude = True
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "x.blend"))
    for use in ("--separate", "--rigid-bodies", "--armature", "--unwrap"):
        ended = run(tmp_path / "x.blend", "--object", "Other", "--object", "Tree", use, "--save", tmp_path / "y.blend")
        assert "Other" in [entry["name"] for entry in ended.answer["objects"]], ended.err
        assert "Traceback" not in ended.err


def test_a_scene_that_was_saved_in_edit_mode(run, obj, make, tree, tmp_path):
    """Both objects were being edited; the command ended with a traceback."""
    other = make(tree, "Other")
    obj.select_set(True)
    bpy.ops.object.mode_set(mode="EDIT")
    assert other.mode == "EDIT"
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "x.blend"))
    ended = run(tmp_path / "x.blend", "--object", "Tree", "--object", "Other", "--save", tmp_path / "y.blend")
    assert ended.status == 0, ended.err
    bpy.ops.wm.open_mainfile(filepath=str(tmp_path / "y.blend"))
    assert [len(bpy.data.objects[name].data.reeb_parts.parts) > 1 for name in ("Tree", "Other")] == [True, True]


def test_an_object_of_which_not_all_can_be_made_is_left_as_it_was(run, obj, make, tree, tmp_path):
    """It has as many UV maps as there can be, so that it cannot be unwrapped."""
    other = make(tree, "Other")
    while len(other.data.uv_layers) < 8:
        other.data.uv_layers.new()
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "x.blend"))
    ended = run(tmp_path / "x.blend", "--object", "Other", "--object", "Tree", "--separate", "--unwrap", "--save",
                tmp_path / "y.blend")
    assert [problem["name"] for problem in ended.answer["problems"]] == ["Other"]
    bpy.ops.wm.open_mainfile(filepath=str(tmp_path / "y.blend"))
    left = bpy.data.objects["Other"]
    assert not left.data.reeb_parts.parts
    assert not left.vertex_groups
    assert not left.hide_render
    assert len(bpy.data.collections["Parts of Tree"].objects) > 1
    assert "Parts of Other" not in bpy.data.collections


USES = ("--separate", "--rigid-bodies", "--unwrap", "--hulls", "unreal")


@pytest.mark.parametrize("first", ["Tree", "Flat"])
def test_objects_that_share_a_mesh_have_the_parts_of_the_first(run, obj, tmp_path, first):
    """Each was decomposed, the later over the earlier: an error, or fewer parts in the answer than files."""
    flat = bpy.data.objects.new("Flat", obj.data)
    flat.scale, flat.location = (1, 1, 0.05), (5, 0, 0)
    bpy.context.scene.collection.objects.link(flat)
    other = "Flat" if first == "Tree" else "Tree"
    ended = run("--object", first, "--object", other, *USES, "--parts", tmp_path / "parts", "--parts-format", "stl",
                "--threemf", tmp_path / "x.3mf", "--picture", tmp_path / "x.png", "--picture-size", "64x64")
    assert (ended.status, ended.answer["problems"]) == (0, [])
    reports = {report["name"]: report for report in ended.answer["objects"]}
    assert [part["name"] for part in reports["Tree"]["parts"]] == [part["name"] for part in reports["Flat"]["parts"]]
    assert [f"It shares the mesh of {first}, and so its parts." in reports[name]["notes"]
            for name in (first, other)] == [False, True]
    files = [path.stem for path in (tmp_path / "parts").iterdir()]
    bodies, places = read_3mf(tmp_path / "x.3mf")
    assert len(places) == 2
    for name, report in reports.items():
        names = {f"{name} {part['name']}" for part in report["parts"]}
        assert {stem for stem in files if stem.startswith(name)} == names
        assert {body.name for body in bodies if body.name.startswith(name)} == names
        assert f"Reeb Graph {name}" in bpy.data.collections
    assert reports["Flat"]["parts"][0]["bounding_box"] != reports["Tree"]["parts"][0]["bounding_box"]


def test_of_objects_that_share_a_mesh_one_has_an_armature(run, obj):
    """The others were problems, without anything that had been asked for besides."""
    twin = bpy.data.objects.new("Twin", obj.data)
    bpy.context.scene.collection.objects.link(twin)
    ended = run("--object", "*", "--armature", "--separate")
    assert (ended.status, ended.answer["problems"]) == (0, [])
    assert [report["name"] for report in ended.answer["objects"]] == ["Tree", "Twin"]
    note = "It shares the mesh of Tree, and so its parts; only that one has an armature."
    assert note in ended.answer["objects"][1]["notes"]
    assert [bool(each.modifiers) for each in (obj, twin)] == [True, False]
    assert len(bpy.data.armatures) == 1
    assert len(bpy.data.collections["Parts of Twin"].objects) > 1


@pytest.mark.parametrize("uses", [USES, ("--armature",)])
def test_what_is_made_of_an_object_is_in_its_scene(run, obj, make, tree, tmp_path, uses):
    """It was in the scene that was open, with the pieces at the origin."""
    own = bpy.context.scene
    second = bpy.data.scenes.new("Second")
    second.view_layers.new("With it")
    within = bpy.data.collections.new("Within")
    second.collection.children.link(within)
    second.view_layers[0].update()
    second.view_layers[0].layer_collection.children["Within"].exclude = True
    there = make((tree[0] * [1, 1, 2], tree[1]), "There")
    own.collection.objects.unlink(there)
    within.objects.link(there)
    parent = bpy.data.objects.new("Parent", None)
    within.objects.link(parent)
    there.parent, parent.location = parent, (7, 0, 0)
    before = set(own.collection.all_objects), set(own.collection.children_recursive)
    ended = run("--object", "There", *uses, "--parts", tmp_path, "--parts-format", "ply")
    assert ended.status == 0
    assert bpy.context.scene == own
    assert (set(own.collection.all_objects), set(own.collection.children_recursive)) == before
    assert own.rigidbody_world is None
    made = set(second.collection.all_objects) - {there, parent}
    assert made == set(bpy.data.objects) - {there, parent, obj}
    assert "Reeb Graph There" in second.collection.children
    if "--separate" in uses:
        assert there.hide_get(view_layer=second.view_layers["With it"])
        assert second.rigidbody_world is not None
    for path in ended.answer["files"]["parts"]:
        bpy.ops.wm.read_homefile(use_empty=True)
        bpy.ops.wm.ply_import(filepath=path)
        assert min(vertex.co.x for vertex in bpy.context.object.data.vertices) > 4

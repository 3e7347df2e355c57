# SPDX-License-Identifier: GPL-3.0-or-later
"""Outputs of the command that are aimed at what must not be written over: refused, and all is as it was."""

import os
import stat

import bpy
import process
import pytest
from systems import unix

pytestmark = unix


def refused(run, folder, words, *arguments):
    """The command ends with one sentence that names the words, and leaves the folder as it was."""
    before = process.content(folder), sorted(os.listdir(folder))
    ended = run(*arguments)
    assert (process.content(folder), sorted(os.listdir(folder))) == before
    assert (ended.status, ended.out) == (1, "")
    (sentence,) = [line for line in ended.err.splitlines() if line.startswith("reeb_parts: ")]
    assert all(word in sentence for word in words)


@pytest.mark.parametrize("option", ["--json", "--save", "--picture"])
def test_the_model_itself(run, model, tmp_path, option):
    (tmp_path / "link.json").symlink_to(model)
    os.link(model, tmp_path / "hard.json")
    for path in (model, tmp_path / "link.json", tmp_path / "hard.json", tmp_path / "x" / ".." / "own.obj"):
        (tmp_path / "x").mkdir(exist_ok=True)
        refused(run, tmp_path, [str(path), "read"], model, option, path)


def test_the_open_scene(run, obj, tmp_path):
    scene = tmp_path / "scene.blend"
    bpy.ops.wm.save_as_mainfile(filepath=str(scene))
    refused(run, tmp_path, ["scene.blend", "read"], "--save", scene)
    refused(run, tmp_path, ["scene.blend", "read"], scene, "--json", scene)


def test_what_the_scene_names(run, obj, tmp_path):
    texture = tmp_path / "texture.png"
    image = bpy.data.images.new("texture", 4, 4)
    image.filepath_raw, image.file_format = str(texture), "PNG"
    image.save()
    bpy.data.images.remove(image)
    bpy.data.images.load(str(texture)).use_fake_user = True
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "scene.blend"))
    refused(run, tmp_path, ["texture.png", "read"], tmp_path / "scene.blend", "--picture", texture)


def test_the_materials_of_the_model(run, model, tmp_path):
    (tmp_path / "own.mtl").write_text("newmtl none\n")
    refused(run, tmp_path, ["own.mtl", "read"], model, "--json", tmp_path / "own.mtl")


def test_a_part_that_would_be_the_model(run, tree, tmp_path):
    model = process.write_obj(tmp_path / "Tree Part 02.obj", tree)
    before = process.content(tmp_path)
    ended = run(model, "--parts", tmp_path)
    assert ended.status == 1
    assert "Tree Part 02.obj is read" in ended.err
    assert process.content(tmp_path) == before


def test_one_name_for_two_outputs(run, model, tmp_path):
    (tmp_path / "link").symlink_to(tmp_path / "x")
    (tmp_path / "x").write_text("an earlier one")
    for other in (tmp_path / "x", tmp_path / "y" / ".." / "x", tmp_path / "link"):
        refused(run, tmp_path, ["written over"], model, "--save", tmp_path / "x", "--json", other)
    refused(run, tmp_path, ["written over"], model, "--save", tmp_path / "x", "--json", tmp_path / "x" / "y.json")
    refused(run, tmp_path, ["written over"], model, "--parts", tmp_path / "x", "--json", tmp_path / "x")


def test_what_is_no_file(run, model, tmp_path):
    os.mkfifo(tmp_path / "pipe")
    (tmp_path / "folder").mkdir()
    (tmp_path / "one").symlink_to(tmp_path / "two")
    (tmp_path / "two").symlink_to(tmp_path / "one")
    (tmp_path / "to_pipe").symlink_to(tmp_path / "pipe")
    for name in ("pipe", "to_pipe", "folder", "one"):
        for option in ("--json", "--save", "--picture"):
            refused(run, tmp_path, [name], model, option, tmp_path / name)
    refused(run, tmp_path, ["own.obj"], model, "--parts", model)
    refused(run, tmp_path, ["one"], model, "--parts", tmp_path / "one")
    assert stat.S_ISFIFO(os.stat(tmp_path / "pipe").st_mode)


@pytest.mark.parametrize("name", [".", "/", ""])
def test_a_model_that_is_a_folder(run, tmp_path, name):
    refused(run, tmp_path, [], name, "--json", tmp_path / "x.json")


def test_a_folder_given_as_model_is_said_to_be_one(run, model, tmp_path):
    refused(run, tmp_path, [f"{tmp_path} is a folder, not a model."], tmp_path, "--json", tmp_path / "x.json")
    (tmp_path / "scene.blend").mkdir()
    refused(run, tmp_path, ["x.obj could not be read: "], tmp_path / f"{'x' * 300}.obj")
    refused(run, tmp_path, ["x could not be written: "], model, "--parts", tmp_path / ("x" * 300))
    refused(run, tmp_path, ["scene.blend is a folder"], tmp_path / "scene.blend", "--json", tmp_path / "x.json")


@pytest.mark.parametrize(("option", "name", "kind"), [
    ("--save", "a.txt", ".blend"), ("--save", "a", ".blend"), ("--threemf", "a.txt", ".3mf"),
    ("--picture", "p.jpg", ".png")])
def test_a_file_named_as_another_kind(run, model, tmp_path, option, name, kind):
    refused(run, tmp_path, [f"{option} {tmp_path / name} must end in {kind}."], model, option, tmp_path / name)


def test_a_kind_may_be_in_capitals(run, model, tmp_path):
    assert run(model, "--save", tmp_path / "A.BLEND", "--threemf", tmp_path / "A.3MF").status == 0
    assert {"A.BLEND", "A.3MF"} <= set(os.listdir(tmp_path))


def test_a_folder_that_cannot_be_made_is_refused_before_anything_is_computed(run, model, tmp_path):
    ended = run(model, "--parts", "/proc/none/parts")
    assert (ended.status, ended.out) == (1, "")
    assert "/proc/none/parts could not be written" in ended.err
    assert "mesh 0%" not in ended.err
    # One that could be made is gone again when nothing comes of the run.
    assert run(tmp_path / "none.obj", "--parts", tmp_path / "new" / "parts").status == 1
    assert not (tmp_path / "new").exists()


def test_links_to_files_are_followed_and_stay(run, model, tmp_path):
    (tmp_path / "latest.json").symlink_to(tmp_path / "answer.json")
    (tmp_path / "answer.json").write_text("old")
    ended = run(model, "--json", tmp_path / "latest.json")
    assert ended.status == 0
    assert (tmp_path / "latest.json").is_symlink()
    assert (tmp_path / "answer.json").read_text() == ended.out

# SPDX-License-Identifier: GPL-3.0-or-later
"""The command on a disk that fills up while it writes: it says so, and what was there is as it was."""

import re

import bpy
import process
import pytest
from diagonal import some
from systems import unix

pytestmark = unix


@pytest.fixture
def full(model, tmp_path):
    """A function that runs the command where files end after so many bytes; what it says, after checks."""

    def run_full(size, name, *arguments):
        before = process.content(tmp_path)
        ended = process.run(model, *arguments, before=process.FULL_DISK.format(size=size))
        assert process.content(tmp_path) == before
        assert ended.returncode == 1
        assert "{" not in ended.stdout  # a full Blender says its version there
        (sentence,) = re.findall(r"reeb_parts: (.* could not be written.*)", ended.stderr)
        assert name in sentence
        assert ".reeb_parts_" not in sentence
        return sentence

    return run_full


@pytest.mark.parametrize("compress", some(False, True))
def test_a_scene(full, obj, tmp_path, compress):
    bpy.context.preferences.filepaths.use_file_compression = compress
    path = tmp_path / "out.blend"
    bpy.ops.wm.save_as_mainfile(filepath=str(path), compress=compress)
    full(50_000, "out.blend", "--save", path)


@pytest.mark.parametrize("kind", some("obj", "ply", "stl", "glb"))
def test_parts(full, tmp_path, kind):
    (tmp_path / "parts").mkdir()
    (tmp_path / "parts" / f"Tree Part 01.{kind}").write_text("an earlier one")
    full(1000, f"Tree Part 01.{kind}", "--parts", tmp_path / "parts", "--parts-format", kind)


def test_a_picture(full, tmp_path):
    (tmp_path / "out.png").write_text("an earlier one")
    full(1000, "out.png", "--picture", tmp_path / "out.png", "--picture-size", "64x64")


def test_the_json_in_a_new_folder(full, tmp_path):
    full(1000, "out.json", "--json", tmp_path / "new" / "folder" / "out.json")
    assert not (tmp_path / "new").exists()


def test_standard_output(model):
    done = process.run(model, before="import os; os.dup2(os.open('/dev/full', os.O_WRONLY), 1)")
    assert done.returncode == 1
    assert "Standard output could not be written" in done.stderr

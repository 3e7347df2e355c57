# SPDX-License-Identifier: GPL-3.0-or-later
"""Files that only Blender reads, by the full Blender that BLENDER names."""

import json
import os
import subprocess
from pathlib import Path

import numpy as np
import pytest
import reeb_parts

DATA = Path(__file__).resolve().parents[1] / "data"
#: A cube of side 2 and a plane, moved and turned, in an .fbx.
MAKE = """
import bpy, sys
bpy.ops.wm.read_homefile(use_empty=True)
bpy.ops.mesh.primitive_cube_add(size=2, location=(5, 0, 0))
bpy.ops.mesh.primitive_plane_add(size=2, location=(0, 7, 0))
bpy.ops.export_scene.fbx(filepath=sys.argv[-1])
"""


EMPTY = """
import bpy, sys
bpy.ops.wm.read_homefile(use_empty=True)
bpy.ops.wm.save_as_mainfile(filepath=sys.argv[-1])
"""


def test_a_blend_file_has_the_faces_of_blender(reeb_parts_command, tmp_path):
    done = reeb_parts_command("decompose", DATA / "saved_by_0_1_0.blend", "--blender", os.environ["BLENDER"],
                              "--labels", tmp_path / "labels.npy")
    assert done.returncode == 0, done.stderr
    (entry,) = json.loads(done.stdout)["objects"]
    assert len(np.load(tmp_path / "labels.npy")) == entry["faces"] == 2904


def test_an_fbx_file_has_quads_in_their_places(tmp_path):
    path = tmp_path / "two.fbx"
    subprocess.run([os.environ["BLENDER"], "--background", "--factory-startup", "--python-expr", MAKE, "--", str(path)],
                   check=True, capture_output=True)
    model = reeb_parts.read_model(path, os.environ["BLENDER"])
    assert (len(model.vertices), len(model.faces), model.polygon.max() + 1, model.up) == (12, 14, 7, "z")
    low, high = model.vertices.min(axis=0), model.vertices.max(axis=0)
    assert np.concatenate([low, high]) == pytest.approx([-1, -1, -1, 6, 8, 1], abs=1e-4)


def test_what_blender_cannot_read_is_said(tmp_path):
    (tmp_path / "broken.blend").write_bytes(b"no blend file")
    with pytest.raises(reeb_parts.ModelFileError, match="broken.blend could not be read"):
        reeb_parts.read_model(tmp_path / "broken.blend", os.environ["BLENDER"])


def test_a_mirrored_object_looks_outwards(tmp_path):
    path = tmp_path / "mirrored.blend"
    make = """
import bpy, sys
bpy.ops.wm.read_homefile(use_empty=True)
bpy.ops.mesh.primitive_cube_add(size=2, location=(5, 0, 0))
bpy.context.object.scale = (-1, 1, 1)
bpy.ops.wm.save_as_mainfile(filepath=sys.argv[-1])
"""
    subprocess.run([os.environ["BLENDER"], "--background", "--factory-startup", "--python-expr", make, "--", str(path)],
                   check=True, capture_output=True)
    model = reeb_parts.read_model(path, os.environ["BLENDER"])
    a, b, c = model.vertices[model.faces].transpose(1, 0, 2)
    assert (np.cross(a, b) * c).sum() / 6 == pytest.approx(8)


@pytest.mark.parametrize(("name", "make", "words"), [
    ("broken.blend", None, "broken.blend could not be read: File format is not supported in file"),
    ("broken.fbx", None, "broken.fbx could not be read: "),
    ("empty.blend", EMPTY, "There is no mesh in "),
])  # fmt: skip
def test_why_blender_could_not_read_is_said(name, make, words, tmp_path):
    path = tmp_path / name
    path.write_bytes(b"no model")
    if make:
        subprocess.run([os.environ["BLENDER"], "--background", "--factory-startup", "--python-expr", make, "--",
                        str(path)], check=True, capture_output=True)
    with pytest.raises(reeb_parts.ModelFileError, match=words) as raised:
        reeb_parts.read_model(path, os.environ["BLENDER"])
    for strange in ("script failed", "RuntimeError", "[", "Traceback"):
        assert strange not in str(raised.value)

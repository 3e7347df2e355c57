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


def made_by_blender(script, path):
    """The file that a script makes."""
    subprocess.run([os.environ["BLENDER"], "--background", "--factory-startup", "--python-exit-code", "1",
                    "--python-expr", script, "--", str(path)], check=True, capture_output=True)
    return path


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


def test_shape_keys_are_read_as_they_are_mixed(tmp_path):
    """A cube of side 2; one key of value 0.5 doubles it, but for the lower half; one is muted, one has no value."""
    path = made_by_blender("""
import bpy, sys
bpy.ops.wm.read_homefile(use_empty=True)
bpy.ops.mesh.primitive_cube_add(size=2)
cube = bpy.context.object
group = cube.vertex_groups.new(name="Upper")
group.add([v.index for v in cube.data.vertices if v.co.z > 0], 1.0, "REPLACE")
cube.shape_key_add(name="Basis")
for name, value, mute in (("Large", 0.5, False), ("Muted", 1.0, True), ("None", 0.0, False)):
    key = cube.shape_key_add(name=name, from_mix=False)
    key.value, key.mute = value, mute
    for point in key.data:
        point.co = 2 * point.co
cube.data.shape_keys.key_blocks["Large"].vertex_group = "Upper"
other = bpy.data.objects.new("Only", cube.data)
other.location.x = 10
bpy.context.collection.objects.link(other)
other.active_shape_key_index, other.show_only_shape_key = 3, True
bpy.ops.wm.save_as_mainfile(filepath=sys.argv[-1])
""", tmp_path / "keys.blend")
    points = reeb_parts.read_model(path, os.environ["BLENDER"]).vertices
    mixed, only = points[:8], points[8:] - (10, 0, 0)
    assert sorted(np.abs(mixed[:, 0]).tolist()) == pytest.approx([1.0] * 4 + [1.5] * 4)
    assert sorted(set(mixed[:, 2].tolist())) == pytest.approx([-1.0, 1.5])
    assert np.abs(only) == pytest.approx(2.0)


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
    ("broken.abc", None, "broken.abc could not be read: (it is damaged|this Blender was built without an importer)"),
    ("empty.blend", EMPTY, "There is no mesh in "),
])
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


#: A cube with what Reeb Parts marks as made of it, one thing of the user's among that, and pieces whose model is gone.
MADE = """
import bpy, sys
bpy.ops.wm.read_homefile(use_empty=True)
scene = bpy.context.scene
def cube(x, collection, **marks):
    bpy.ops.mesh.primitive_cube_add(size=1, location=(x, 0, 0))
    obj = bpy.context.object
    for mark, value in marks.items():
        obj["reeb_parts_" + mark] = value
    collection.objects.link(obj)
    if collection != scene.collection:
        scene.collection.objects.unlink(obj)
    return obj
def pieces(of):
    made = bpy.data.collections.new("Parts")
    scene.collection.children.link(made)
    made["reeb_parts_pieces_of"] = of
    return made
def original(x):
    bpy.ops.mesh.primitive_cube_add(size=1, location=(x, 0, 0))
    return bpy.context.object
named = original(0)
for place, source in ((10, named), (20, named.name)):
    made = pieces(source)
    cube(place, made, number=1)
    cube(place + 1, made, dowel=[1, 2])
    cube(place + 2, made, hull_of=1, role="hull")
cube(30, made)
left = original(0)
made = pieces(left)
bpy.data.objects.remove(left)
cube(40, made, number=1)
cube(41, made, number=1, role="hull")
bpy.ops.wm.save_as_mainfile(filepath=sys.argv[-1])
"""


def test_what_was_made_of_a_model_is_not_the_model_again(tmp_path):
    """Pieces and hulls that were saved with their original were decomposed with it, as one mesh."""
    path = made_by_blender(MADE, tmp_path / "pieces.blend")
    model = reeb_parts.read_model(path, os.environ["BLENDER"])
    assert sorted(set(model.vertices[:, 0].round().astype(int).tolist())) == [0, 30, 40]


def test_the_marks_are_those_of_the_extension():
    root = DATA.parents[1]
    marks = (root / "package" / "blender_export.py").read_text(encoding="utf-8")
    scene = "".join((root / "scene" / name).read_text(encoding="utf-8")
                    for name in ("ours/made_objects.py", "pieces/origins.py"))
    for mark in ("reeb_parts_role", "reeb_parts_number", "reeb_parts_dowel", "reeb_parts_pieces_of"):
        assert f'"{mark}"' in marks
        assert f'= "{mark}"' in scene


#: A cube in a collection that is in no scene, shown by three empties, of which one is hidden and one shows another.
INSTANCES = """
import bpy, sys
bpy.ops.wm.read_homefile(use_empty=True)
bpy.ops.mesh.primitive_cube_add(size=1, location=(1, 0, 0))
cube = bpy.context.object
inner, outer = bpy.data.collections.new("inner"), bpy.data.collections.new("outer")
inner.objects.link(cube)
bpy.context.scene.collection.objects.unlink(cube)
def show(collection, x, into):
    empty = bpy.data.objects.new("empty", None)
    empty.instance_type, empty.instance_collection, empty.location = "COLLECTION", collection, (x, 0, 0)
    into.objects.link(empty)
    return empty
show(inner, 10, bpy.context.scene.collection)
show(inner, 20, bpy.context.scene.collection).hide_set(True)
show(inner, 30, outer)
show(outer, 100, bpy.context.scene.collection)
bpy.ops.wm.save_as_mainfile(filepath=sys.argv[-1])
"""


def test_instances_of_collections_come_in_their_places(tmp_path):
    """Meshes that are seen through them alone were no meshes of the file."""
    path = made_by_blender(INSTANCES, tmp_path / "instances.blend")
    model = reeb_parts.read_model(path, os.environ["BLENDER"])
    assert len(model.faces) == 36
    center = model.vertices.reshape(3, 8, 3).mean(axis=1)
    assert sorted(center[:, 0].tolist()) == pytest.approx([11, 21, 131])

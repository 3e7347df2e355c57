# SPDX-License-Identifier: GPL-3.0-or-later
"""A file that goes from one Blender to another: what we made there is known, as long as nobody has worked on it."""

import importlib
from pathlib import Path

import bpy
import pytest
from one_of_each import add_one_of_each
from snapshot import activate

FILE = Path(__file__).resolve().parents[3] / "data" / "made_in_4_2.blend"
MADE = "reeb_parts_looks"


@pytest.fixture
def digest(package):
    """The function that tells objects which somebody has worked on from those that are as they were made."""
    load = importlib.import_module
    around = load(f"{package}.scene.ours.surroundings").Surroundings
    return lambda item: load(f"{package}.scene.ours.made_objects")._digest(item, around.now())


@pytest.fixture
def marked(package):
    """The objects of a file of Blender 4.2 that were marked as made, the file open."""
    bpy.ops.wm.open_mainfile(filepath=str(FILE))
    return [item for item in bpy.data.objects if MADE in item]


def test_all_that_another_blender_made_is_as_it_was(marked, digest):
    """With each modifier, constraint and kind of physics: defaults that are told otherwise made all of it differ."""
    assert len(marked) > 100
    assert [item.name for item in marked if digest(item) != item[MADE]] == []


def test_all_that_is_made_now_is_as_another_blender_makes_it(marked, digest):
    """And so what this Blender makes is known in others."""
    then = {item.name: item[MADE] for item in marked}
    bpy.ops.wm.read_homefile(use_empty=True)
    now = {item.name: digest(item) for item in add_one_of_each()}
    assert len(now) > 90
    assert [name for name in now if name in then and now[name] != then[name]] == []
    assert all("Tree" in name for name in then.keys() - now.keys())


def test_every_setting_that_somebody_changes_still_counts(marked, digest):
    for name, path in (("Modifier BEVEL", "modifiers[0].loop_slide"), ("Constraint CHILD_OF", "constraints[0].enabled"),
                       ("Rig", 'data.bones["a"].use_deform'), ("Rig", 'data.bones["a"].head_radius'),
                       ("Body ACTIVE", "rigid_body.enabled"), ("Modifier WAVE", "visible_shadow")):
        item = bpy.data.objects[name]
        holder, _, setting = path.rpartition(".")
        holder = item.path_resolve(holder) if holder else item
        before = getattr(holder, setting)
        setattr(holder, setting, before + 1 if setting == "head_radius" else not before)
        assert digest(item) != item[MADE], path
        setattr(holder, setting, before)
        assert digest(item) == item[MADE], path


def test_pressed_again_all_of_it_is_replaced(marked):
    def count():
        return sum(MADE in item for item in bpy.data.objects), len(bpy.data.objects)

    before = count()
    tree = bpy.data.objects["Tree"]
    for command in ("hulls", "armature", "separate"):
        activate(tree)
        getattr(bpy.ops.reeb_parts, command)(**({"hide": False, "center": False} if command == "separate" else {}))
    activate(tree)
    bpy.ops.reeb_parts.rigid_bodies()
    assert count() == before
    bpy.ops.reeb_parts.decompose(detail=0.9)
    bpy.ops.reeb_parts.decompose(detail=0.5)
    assert count() == before


@pytest.mark.parametrize("button", ["clear", "decompose"])
def test_nothing_is_left_of_what_blender_4_had_stored(marked, button):
    """Blender 5 leaves a copy among the custom properties, which Blender 4.5 takes for the parts after Clear."""
    tree = bpy.data.objects["Tree"]
    activate(tree)
    getattr(bpy.ops.reeb_parts, button)()
    if button == "clear":
        assert [key for block in (tree, tree.data) for key in block.keys() if key.startswith("reeb")] == []
    elif bpy.app.version >= (5, 0):
        assert "reeb_parts" not in tree.data
        assert tree.data.reeb_parts.parts


@pytest.mark.parametrize("value", ["seen by the pipeline", 1, {"version": 2}])
def test_a_property_of_the_user_of_that_name_stays(obj, value):
    """A script's mark on the mesh was taken for what Blender 4 leaves there, and removed."""
    if bpy.app.version < (5, 0):  # property groups are custom properties there, and this would write over one
        return
    obj.data["reeb_parts"] = value
    for button in (bpy.ops.reeb_parts.decompose, bpy.ops.reeb_parts.clear):
        assert button() == {"FINISHED"}
        left = obj.data["reeb_parts"]
        assert (left.to_dict() if isinstance(value, dict) else left) == value

# SPDX-License-Identifier: GPL-3.0-or-later
"""Preferences: what new scenes and scripts start with, and what scenes that are there keep."""

from importlib import import_module

import bpy
import pytest


@pytest.fixture
def preferences(package):
    """The preferences; as they were again afterwards."""
    chosen = bpy.context.preferences.addons[package].preferences
    yield chosen
    for name in chosen.bl_rna.properties.keys():
        if chosen.is_property_set(name) and name != "bl_idname":
            chosen.property_unset(name)


@pytest.fixture
def presets(package):
    return import_module(f"{package}.core.parameters").PRESETS


def change(preferences):
    preferences.preset = "Berretti 2009"
    preferences.node_size, preferences.line_thickness, preferences.in_front = 0.25, 0.125, False
    preferences.colors, preferences.seams = False, True


def check_changed(settings, presets):
    assert settings.preset == "Berretti 2009"
    assert settings.parameters() == presets["Berretti 2009"]
    assert (settings.node_size, settings.line_thickness, settings.in_front) == (0.25, 0.125, False)
    assert (settings.colors, settings.seams, settings.face_attribute) == (False, True, True)


def test_are_what_scenes_start_with_anyway(preferences):
    settings = bpy.context.scene.reeb_parts
    for name, prop in preferences.bl_rna.properties.items():
        if name not in ("rna_type", "bl_idname", "name"):
            assert getattr(preferences, name) == getattr(settings, name)
            assert prop.name == settings.bl_rna.properties[name].name


def test_a_new_file_takes_them(preferences, presets):
    change(preferences)
    bpy.ops.wm.read_homefile(use_empty=True)
    check_changed(bpy.context.scene.reeb_parts, presets)


def test_a_new_scene_takes_them_and_the_others_stay(preferences, presets):
    old = bpy.context.scene
    before = old.reeb_parts.parameters()
    change(preferences)
    new = bpy.data.scenes.new("New")
    bpy.context.window.scene = new
    # Blender tells of a scene as soon as there is something in it.
    new.collection.objects.link(bpy.data.objects.new("First", None))
    bpy.context.view_layer.update()
    check_changed(new.reeb_parts, presets)
    bpy.context.window.scene = old
    bpy.context.view_layer.update()
    assert old.reeb_parts.parameters() == before
    assert old.reeb_parts.colors
    assert bpy.ops.reeb_parts.use_preferences() == {"FINISHED"}
    check_changed(old.reeb_parts, presets)


def test_what_was_set_in_an_empty_scene_stays(preferences):
    change(preferences)
    new = bpy.data.scenes.new("New")
    new.reeb_parts.n_slabs, new.reeb_parts.colors = 50, True
    bpy.context.window.scene = new
    new.collection.objects.link(bpy.data.objects.new("First", None))
    bpy.context.view_layer.update()
    settings = new.reeb_parts
    assert (settings.n_slabs, settings.preset, settings.colors, settings.seams) == (50, "Perceptual", True, True)


def test_a_saved_file_keeps_its_own(preferences, tmp_path):
    bpy.context.scene.reeb_parts.n_slabs = 50
    path = str(tmp_path / "own.blend")
    bpy.ops.wm.save_as_mainfile(filepath=path)
    change(preferences)
    bpy.ops.wm.open_mainfile(filepath=path)
    settings = bpy.context.scene.reeb_parts
    assert (settings.n_slabs, settings.preset, settings.colors, settings.in_front) == (50, "Perceptual", True, True)


def test_what_was_changed_in_a_scene_is_reset(preferences, presets):
    settings = bpy.context.scene.reeb_parts
    settings.n_slabs = 50
    bpy.ops.reeb_parts.use_preferences()
    assert settings.parameters() == presets["Perceptual"]


def test_a_script_takes_them_where_it_says_nothing(preferences, obj):
    change(preferences)
    preferences.graph = False
    bpy.ops.reeb_parts.decompose(seams=False, detail=0.25)
    result = obj.data.reeb_parts
    assert result.detail == 0.25
    assert not result.has_seams
    assert not result.color_attribute
    assert result.face_attribute
    assert "Reeb Graph Tree" not in bpy.data.collections
    bpy.ops.reeb_parts.decompose(graph=True)
    nodes = [item for item in bpy.data.objects if item.type == "EMPTY"]
    assert nodes
    assert not any(item.show_in_front for item in nodes)
    assert result.has_seams


def test_they_change_no_graph_that_is_drawn(preferences, obj):
    bpy.ops.reeb_parts.decompose()
    sizes = {item.name: item.empty_display_size for item in bpy.data.objects}
    change(preferences)
    assert {item.name: item.empty_display_size for item in bpy.data.objects} == sizes

# SPDX-License-Identifier: GPL-3.0-or-later
"""Properties that mirror the parameters, and an extension that comes and goes without a trace."""

import importlib
import os
import sys
from dataclasses import fields
from pathlib import Path

import addon_utils
import bpy
import pytest


def test_nothing_is_installed_where_the_user_has_extensions():
    """Blender unpacked SciPy there, or took it away, while another run was at it: "No module named scipy.cluster"."""
    own = os.path.realpath(os.environ["BLENDER_USER_RESOURCES"])
    assert os.path.realpath(bpy.utils.user_resource("EXTENSIONS")).startswith(own)
    libraries = os.path.join("extensions", ".local")
    assert not [path for path in sys.path if libraries in path and not os.path.realpath(path).startswith(own)]


@pytest.mark.parametrize("where", ["scene", "operator"])
def test_properties_mirror_the_parameters(parameters, where):
    if where == "scene":
        properties = bpy.context.scene.reeb_parts.bl_rna.properties
    else:
        properties = bpy.ops.reeb_parts.decompose.get_rna_type().properties
    for field in fields(parameters):
        mirrored = properties[field.name]
        if mirrored.type == "FLOAT":
            assert mirrored.default == pytest.approx(field.default, rel=1e-6)
        else:
            assert mirrored.default == field.default
        if "range" in field.metadata:
            low, high = field.metadata["range"]
            assert (mirrored.hard_min, mirrored.hard_max) == pytest.approx((low, high), rel=1e-6)
        if "choices" in field.metadata:
            assert tuple(mirrored.enum_items.keys()) == field.metadata["choices"]
        assert mirrored.name
        assert mirrored.description


# Written small within a label, as Blender does.
SMALL = {"of", "in", "into", "at", "to", "from", "or", "and", "by", "with", "the", "a", "per", "on", "for", "as",
         "between", "along", "glTF"}


def labels(operator):
    """All that Blender shows of an operator: its label and those of its properties and their choices."""
    yield operator.name
    for prop in operator.properties:
        if prop.type not in {"POINTER", "COLLECTION"} and not prop.is_hidden:  # of which it shows nothing
            yield prop.name
            yield from (item.name for item in prop.enum_items_static) if prop.type == "ENUM" else ()


def test_labels_are_in_title_case_and_tooltips_end_without_a_stop():
    """As Blender's own; Of selected faces and Minimum stretch were not."""
    wrong = []
    for name in dir(bpy.ops.reeb_parts):
        operator = getattr(bpy.ops.reeb_parts, name).get_rna_type()
        wrong += [label for label in labels(operator) for word in label.split()
                  if word[0].islower() and word not in SMALL]
        wrong += [text for text in (operator.description, *(prop.description for prop in operator.properties))
                  if text.endswith(".")]
    assert len(dir(bpy.ops.reeb_parts)) > 40
    assert wrong == []


def test_what_does_something_when_it_is_set_cannot_be_animated(package):
    """A frame that is shown sets nothing: the slider would move, and the parts would stay. Explode heeds frames."""
    classes = importlib.import_module(f"{package}.scene.result.schema").CLASSES
    found = {name: cls.bl_rna.properties[name].is_animatable
             for cls in classes for base in reversed(cls.__mro__)
             for name, made in getattr(base, "__annotations__", {}).items()
             if "update" in getattr(made, "keywords", {})}
    assert {"detail", "n_parts", "locked", "color", "graph", "palette", "preset", "node_size"} <= found.keys()
    assert {name for name, animatable in found.items() if animatable} == {"explode"}


def test_neither_keys_nor_drivers_for_detail(obj):
    bpy.ops.reeb_parts.decompose()
    with pytest.raises(TypeError, match="not animatable"):
        obj.data.keyframe_insert("reeb_parts.detail")
    with pytest.raises(TypeError, match="not animatable"):
        obj.data.driver_add("reeb_parts.n_parts")


def test_defaults_make_default_parameters(parameters):
    assert bpy.context.scene.reeb_parts.parameters() == parameters()


def test_presets_set_all_parameters(package):
    presets = importlib.import_module(f"{package}.core.parameters").PRESETS
    settings = bpy.context.scene.reeb_parts
    for name, expected in presets.items():
        settings.detail = 0.125
        settings.preset = name
        assert settings.parameters() == expected


def _ours():
    return {
        "types": sorted(name for name in dir(bpy.types) if "reeb" in name.lower()),
        "operators": sorted(dir(bpy.ops.reeb_parts)),
        "properties": [cls.__name__ for cls in (bpy.types.Scene, bpy.types.Mesh) if hasattr(cls, "reeb_parts")],
    }


def test_switched_off_leaves_nothing_and_on_again_works(package, obj):
    before = _ours()
    assert before["properties"] == ["Scene", "Mesh"]
    addon_utils.disable(package)
    try:
        assert _ours() == {"types": [], "operators": [], "properties": []}
    finally:
        addon_utils.enable(package)
    assert _ours() == before
    assert bpy.ops.reeb_parts.decompose() == {"FINISHED"}


@pytest.mark.skipif(os.name == "nt", reason="links are for administrators there")
def test_a_second_copy_is_not_switched_on(package, obj, tmp_path):
    """As one of a studio's repository; half of the first was replaced, and neither could be switched off any more."""
    before = _ours()
    (tmp_path / "reeb_parts").symlink_to(Path(sys.modules[package].__file__).parent)
    repositories, said = bpy.context.preferences.extensions.repos, []
    second = repositories.new(name="studio", module="studio", custom_directory=str(tmp_path))
    try:
        other = addon_utils.enable("bl_ext.studio.reeb_parts", handle_error=lambda error: said.append(str(error)))
        assert other is None
    finally:
        repositories.remove(second)
    assert said == ["Reeb Parts of another repository is enabled: disable that first."]
    assert _ours() == before
    assert bpy.ops.reeb_parts.decompose() == {"FINISHED"}
    addon_utils.disable(package)
    try:
        assert _ours()["types"] == []
    finally:
        addon_utils.enable(package)


def test_switched_off_after_a_script_has_cleared_the_handlers(package):
    """As scripts of pipelines and rigs do; then it could not be switched off, updated, or switched on again."""
    before = _ours()
    lists = [those for name in dir(bpy.app.handlers) if isinstance(those := getattr(bpy.app.handlers, name), list)]
    own = [[function for function in those if function.__module__.startswith(package)] for those in lists]
    assert sum(map(len, own)) > 5
    for those in lists:
        those.clear()
    addon_utils.disable(package)
    assert _ours() == {"types": [], "operators": [], "properties": []}
    addon_utils.enable(package)
    assert _ours() == before
    assert [len(those) for those in lists] == [len(functions) for functions in own]


def drawn_names():
    """Every string in the code of the panels' draw functions, and in the lists of names that these draw."""
    found = set()
    for name in dir(bpy.types):
        if name.startswith("REEB_PARTS_PT_"):
            panel = getattr(bpy.types, name)
            todo = [*panel.draw.__code__.co_consts, getattr(panel, "names", ())]
            while todo:
                item = todo.pop()
                if isinstance(item, tuple):
                    todo.extend(item)
                elif isinstance(item, str):
                    found.add(item)
    return found


def test_every_parameter_stands_in_a_panel():
    properties = bpy.ops.reeb_parts.decompose.get_rna_type().properties
    # Hidden are the names that version 0.1.0 had for some of them.
    names = {prop.identifier for prop in properties if not prop.is_hidden} - {"rna_type"}
    assert {"detail", "band_ratio", "smoothing", "node_size", "seams"} <= names
    assert names - drawn_names() == set()

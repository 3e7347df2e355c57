# SPDX-License-Identifier: GPL-3.0-or-later
"""Meshes are looked at once they have been left alone for a moment: whether they were edited, or others joined in."""

import importlib

import bpy
import numpy as np
import pytest
import shapes
from mathutils import Matrix
from results import numbers as face_numbers
from snapshot import activate


@pytest.fixture
def look(package, monkeypatch):
    """What a timer calls in a window; the module."""
    watch = importlib.import_module(f"{package}.scene.changes.watch")
    monkeypatch.setattr(watch, "REST", 0.0)
    return watch


@pytest.mark.parametrize("edited", [False, True])
def test_a_file_that_was_edited_without_us_says_so_once_it_is_opened(look, obj, result, edited):
    """It did only after the first command."""
    look._waiting.clear()
    obj.data.vertices[0].co.x += edited  # nobody is told
    look._opened()
    assert look.bpy.app.timers.is_registered(look._look)
    look._look()
    assert obj.data.reeb_parts.edited == edited


@pytest.mark.parametrize("copied", [False, True])
def test_what_came_by_join_is_settled_before_the_next_edit(look, make, copied):
    """After an edit nobody knew which faces had come: parts of theirs were pinned ones of ours, and groups stayed."""
    into, tree = make(shapes.dumbbell(24, 10), "Into"), make(shapes.tube_tree(), "Tree")
    into.data.transform(Matrix.Translation((20, 0, 0)))
    activate(tree)
    bpy.ops.reeb_parts.decompose(graph=False, materials=True, seams=True, face_sets=True)
    activate(into)
    bpy.ops.reeb_parts.decompose(graph=False, n_parts=2)
    bpy.ops.reeb_parts.split()
    mesh, own = into.data, len(into.data.polygons)
    before, names = face_numbers(mesh), [part.name for part in mesh.reeb_parts.parts]
    if copied:  # in Edit Mode: copies have the numbers of what they are copies of
        edit(into, bpy.ops.mesh.duplicate, faces=slice(None))
    else:
        tree.select_set(True)
        bpy.ops.object.join()
    look._waiting.add(mesh.session_uid)
    look._look()
    assert mesh.reeb_parts.edited
    assert into.vertex_groups.keys() == names
    assert (face_numbers(mesh) == [*before, *(before if copied else [0] * (len(mesh.polygons) - own))]).all()
    edit(into, bpy.ops.mesh.delete, faces=slice(5), type="FACE")
    bpy.ops.reeb_parts.decompose(graph=False)
    high = np.array([polygon.center.x > 10 for polygon in mesh.polygons])
    assert copied or not any(part.pinned and part.number in face_numbers(mesh)[~high] for part in mesh.reeb_parts.parts)
    bpy.ops.reeb_parts.clear()
    assert into.vertex_groups.keys() == []
    assert not any(mesh.materials)  # Join of Blender 5 leaves an empty slot
    assert ".sculpt_face_set" not in mesh.attributes
    assert not any(edge.use_seam for edge in mesh.edges)


@pytest.mark.parametrize("own", [False, True])
def test_face_sets_of_several_models_that_were_joined_are_ours(look, make, own):
    """Join adds another number to those of each: of three, they stayed for good, as if they had been drawn."""
    models = [make(shapes.dumbbell(24, 10), name) for name in "ABC"]
    for place, obj in enumerate(models):
        obj.data.transform(Matrix.Translation((20 * place, 0, 0)))
        activate(obj)
        if own or not place:
            bpy.ops.reeb_parts.decompose(graph=False, n_parts=2, face_sets=True)
        else:
            obj.data = models[0].data.copy()
            obj.data.transform(Matrix.Translation((20 * place, 0, 0)))
    for obj in models:
        obj.select_set(True)
    bpy.context.view_layer.objects.active = models[0]
    bpy.ops.object.join()
    mesh = models[0].data
    look._waiting.add(mesh.session_uid)
    look._look()
    edit(models[0], bpy.ops.mesh.delete, faces=slice(5), type="FACE")
    bpy.ops.reeb_parts.decompose(graph=False)
    assert ".sculpt_face_set" not in mesh.attributes


def test_a_graph_is_hidden_at_the_frames_at_which_its_model_is(look, obj, result):
    """It stayed, alone, where the hiding is animated."""
    for frame, hidden in ((1, False), (2, True), (3, False)):
        obj.hide_viewport = hidden
        obj.keyframe_insert("hide_viewport", frame=frame)
    nodes = [item for item in obj.children if item.type == "EMPTY"]
    for frame in (1, 2, 3, 2):
        bpy.context.scene.frame_set(frame)
        if bpy.app.timers.is_registered(look._hide_graphs):
            look._hide_graphs()
            bpy.app.timers.unregister(look._hide_graphs)
        bpy.context.view_layer.update()
        assert {item.visible_get() for item in nodes} == {frame != 2}


def edit(obj, operator, faces, **arguments):
    """In Edit Mode, with some faces selected."""
    for elements in (obj.data.vertices, obj.data.edges, obj.data.polygons):
        elements.foreach_set("select", [False] * len(elements))
    for polygon in obj.data.polygons[faces]:
        polygon.select = True
    bpy.ops.object.mode_set(mode="EDIT")
    operator(**arguments)
    bpy.ops.object.mode_set(mode="OBJECT")

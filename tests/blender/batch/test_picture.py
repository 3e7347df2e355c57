# SPDX-License-Identifier: GPL-3.0-or-later
"""The picture of the parts that runs without a window can leave."""

from importlib import import_module

import bpy
import numpy as np
import pytest
from snapshot import snapshot

SIZE = (160, 96)


@pytest.fixture
def picture(package):
    """The module that renders."""
    return import_module(f"{package}.batch.picture")


def graph_of(obj):
    return bpy.data.collections[f"Reeb Graph {obj.name}"]


def pixels(path):
    """Colors of a PNG file, (n, 3), sRGB."""
    image = bpy.data.images.load(str(path))
    values = np.empty(4 * image.size[0] * image.size[1], np.float32)
    image.pixels.foreach_get(values)
    assert tuple(image.size) == SIZE
    bpy.data.images.remove(image)
    return values.reshape(-1, 4)[:, :3]


def hue(rgb):
    """Direction of the color away from grey, unit length."""
    away = rgb - rgb.mean(axis=-1, keepdims=True)
    return away / np.maximum(np.linalg.norm(away, axis=-1, keepdims=True), 1e-6)


def test_shows_the_colours_of_the_parts(obj, picture, tmp_path):
    bpy.ops.reeb_parts.decompose()
    picture.render_parts([(obj, None)], tmp_path / "parts.png", size=SIZE, samples=2)
    seen = pixels(tmp_path / "parts.png")
    coloured = seen[np.ptp(seen, axis=1) > 0.15]
    parts = obj.data.reeb_parts.parts
    likeness = hue(coloured) @ hue(np.array([part.color[:] for part in parts])).T
    # Light and shadow change how bright a colour is, hardly its hue: nothing else is that colourful.
    assert np.mean(likeness.max(axis=1) > 0.9) > 0.95
    assert len(set(likeness.argmax(axis=1).tolist())) > 2


def test_the_graph_lies_over_the_model(obj, picture, tmp_path):
    bpy.ops.reeb_parts.decompose()
    obj.location, obj.rotation_euler, obj.scale = (5, -3, 2), (0.3, 0.2, 1.0), (2, 2, 2)
    for name, graph in (("without", None), ("with", graph_of(obj))):
        picture.render_parts([(obj, graph)], tmp_path / f"{name}.png", size=SIZE, samples=2)
    without, with_graph = (pixels(tmp_path / f"{name}.png") for name in ("without", "with"))
    changed = np.abs(with_graph - without).max(axis=1) > 0.2
    model = np.ptp(without, axis=1) > 0.15
    assert 0.02 < changed.mean() < 0.3
    assert np.mean(model[changed]) > 0.8


def test_leaves_the_file_as_it_was(obj, picture, tmp_path):
    bpy.ops.reeb_parts.decompose()
    bpy.context.view_layer.update()
    before, scenes, worlds = snapshot(), list(bpy.data.scenes), list(bpy.data.worlds)
    picture.render_parts([(obj, graph_of(obj))], tmp_path / "parts.png", size=SIZE, samples=1)
    assert snapshot() == before
    assert (list(bpy.data.scenes), list(bpy.data.worlds)) == (scenes, worlds)


def test_hidden_objects_are_shown(obj, picture, tmp_path):
    bpy.ops.reeb_parts.decompose()
    obj.hide_render = True
    obj.hide_set(True)
    picture.render_parts([(obj, None)], tmp_path / "parts.png", size=SIZE, samples=1)
    assert np.mean(np.ptp(pixels(tmp_path / "parts.png"), axis=1) > 0.15) > 0.05


def test_turned_by_half_a_circle_looks_from_the_other_side(picture):
    front, back = picture.view_from(0), picture.view_from(180)
    assert np.allclose(front, picture.VIEW)
    assert np.allclose(back, (-front[0], -front[1], front[2]))


@pytest.fixture
def shown(picture, tmp_path):
    """A function that gives the colors of a picture of some objects, with their graphs if asked for."""

    def render(*objects, graphs=False):
        shown = [(obj, graph_of(obj) if graphs else None) for obj in objects]
        picture.render_parts(shown, tmp_path / "parts.png", size=SIZE, samples=2)
        return pixels(tmp_path / "parts.png")

    return render


@pytest.mark.parametrize("place", [(20, 20, 0), (3e4, 2e4, -1e4)])
def test_a_model_far_from_the_origin_looks_as_there(obj, shown, place):
    """The picture was empty: the camera stood at the other side of the origin, or saw nothing beyond its clip."""
    bpy.ops.reeb_parts.decompose()
    before = shown(obj, graphs=True)
    obj.location = place
    assert np.abs(shown(obj, graphs=True) - before).mean() < 0.01


def test_graphs_of_objects_far_apart_do_not_bury_them(make, tree, shown):
    """Nodes were balls of a share of the space between them: nothing of the models was seen."""
    objects = []
    for place in (0, 60):
        objects.append(make(tree, f"Tree {place}"))
        objects[-1].location.x = place
        bpy.ops.reeb_parts.decompose()
    model = np.ptp(shown(*objects), axis=1) > 0.15
    assert model.sum() > 40
    assert np.mean(np.ptp(shown(*objects, graphs=True)[model], axis=1) > 0.15) > 0.5


@pytest.mark.parametrize("scale", [0.01, 100])
def test_arcs_are_as_thick_on_a_scaled_object(obj, make, tree, shown, scale):
    """On one that is scaled by a hundredth, as many that are imported, none was seen."""
    bpy.ops.reeb_parts.decompose()
    before = shown(obj, graphs=True)
    vertices, faces = tree
    scaled = make((vertices / scale, faces), "Scaled")
    scaled.scale = 3 * (scale,)
    bpy.ops.reeb_parts.decompose()
    assert np.abs(shown(scaled, graphs=True) - before).mean() < 0.002


def test_a_child_is_sheared_as_its_parent_has_it(obj, make, tree, shown):
    """It was shown without that: a picture has it as the same mesh has it without a parent."""
    parent = bpy.data.objects.new("Parent", None)
    bpy.context.scene.collection.objects.link(parent)
    obj.parent, parent.scale, obj.rotation_euler = parent, (1, 4, 1), (0.4, 0.3, 0.8)
    bpy.context.view_layer.update()
    vertices, faces = tree
    world = np.array(obj.matrix_world)
    bpy.ops.reeb_parts.decompose()
    sheared = shown(obj)
    alone = make((vertices @ world[:3, :3].T + world[:3, 3], faces), "Alone")
    bpy.ops.reeb_parts.decompose()
    assert np.abs(shown(alone) - sheared).mean() < 0.01

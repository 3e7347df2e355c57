# SPDX-License-Identifier: GPL-3.0-or-later
"""Models whose faces have vertices of their own, as files keep them at seams: what works on parts crosses the seams."""

import importlib

import bpy
import numpy as np
import pytest
import shapes
from results import numbers

WAYS = ("grow", "shrink", "slide", "cut", "paint")


def arguments_of(way, obj, inside):
    """What to give to a tool. inside : (p,) bool, faces of the part that it is used on."""
    center = np.array([polygon.center[:] for polygon in obj.data.polygons])
    mine = center[inside]
    middle = mine[np.argsort(mine[:, 2], kind="stable")[len(mine) // 2]]
    return {"grow": {"rings": 3}, "shrink": {"rings": 2}, "slide": {"offset": 0.3}, "cut": {"location": middle},
            "paint": {"stroke": [{"name": "", "location": center[~inside][0], "radius": 0.4}]}}[way]


def seam_of(shape):
    """The shape with vertices of their own for the faces on either side of a plane, as at a seam of a UV map."""
    vertices, faces = shape
    beyond = vertices[faces].mean(axis=1)[:, 0] > 0.1
    return shapes.Shape(np.concatenate([vertices, vertices]), faces + len(vertices) * beyond[:, None])


def used(shape):
    """The shape without vertices of no face."""
    vertex, faces = np.unique(shape.faces, return_inverse=True)
    return shapes.Shape(shape.vertices[vertex], faces.reshape(shape.faces.shape))


@pytest.fixture(params=[shapes.unjoined, lambda shape: used(seam_of(shape))], ids=["every face", "a plane"])
def both(request, make, tree):
    """The tree, and the same with seams."""
    return make(tree), make(request.param(tree), "Seams")


def decomposed(obj):
    bpy.context.view_layer.objects.active = obj
    for other in bpy.context.view_layer.objects:
        other.select_set(other == obj)
    bpy.ops.reeb_parts.decompose()
    return obj.data.reeb_parts


@pytest.mark.parametrize("way", WAYS)
def test_tools_do_on_a_mesh_with_seams_what_they_do_without(both, way):
    found = []
    for obj in both:
        result = decomposed(obj)
        result.active = 1
        before = numbers(obj.data)
        arguments = arguments_of(way, obj, before == result.parts[1].number)
        assert getattr(bpy.ops.reeb_parts, way)(**arguments) == {"FINISHED"}
        after = numbers(obj.data)
        assert (after != before).any()
        found.append(after)
    assert np.array_equal(*found)


def test_outlines_and_curves_cross_seams(both, package):
    highlight, store = (importlib.import_module(f"{package}.{name}") for name in ("viewport.highlight", "scene.store"))
    curves = importlib.import_module(f"{package}.scene.pieces.cut_curves")
    steps = importlib.import_module(f"{package}.core.steps")
    lines = []
    for obj in both:
        result = decomposed(obj)
        listed = [part.number for part in result.parts]
        assert not any(len(highlight.without_outline(obj, [number])) for number in listed)
        smooth = steps.finished(curves.finding_curves(*curves.read(obj), store.load(obj.data).face_numbers))
        points = np.array([vertex.co[:] for vertex in obj.data.vertices])
        found = (highlight.outline(obj, listed[1:2])[0].reshape(-1, 2, 3), smooth.points(points)[smooth.segments])
        lines.append([np.unique(np.sort(each.round(4).reshape(-1, 6)), axis=0) for each in found])
    for whole, split in zip(*lines, strict=True):
        assert len(whole) > 10
        assert np.array_equal(whole, split)


def test_the_field_is_the_same_on_both_sides_of_a_seam(both, package):
    store = importlib.import_module(f"{package}.scene.store")
    values = []
    for obj in both:
        decomposed(obj)
        corner = np.array([loop.vertex_index for loop in obj.data.loops])
        values.append(store.load(obj.data).decomposition.field[corner])
    assert np.allclose(*values, atol=1e-6)


def test_hulls_and_rigid_bodies_cross_seams(both):
    found = []
    for obj in both:
        decomposed(obj)
        bpy.ops.reeb_parts.hulls()
        bpy.ops.reeb_parts.separate(hide=False)
        bpy.context.view_layer.objects.active = obj
        bpy.ops.reeb_parts.rigid_bodies()
        made = bpy.data.collections[f"Parts of {obj.name}"].objects
        joints = [item.location[:] for item in made if item.rigid_body_constraint is not None]
        sizes = sorted(item.dimensions[:] for item in made if item.name.startswith("UCX_"))
        assert len(joints) > 3
        assert len(sizes) > 3
        found.append((np.array(sorted(joints)), np.array(sizes)))
    for whole, split in zip(*found, strict=True):
        np.testing.assert_allclose(split, whole, atol=1e-3)


def test_uv_seams_are_marked_on_both_sides_of_a_seam(both):
    marked = []
    for obj in both:
        bpy.context.view_layer.objects.active = obj
        bpy.ops.reeb_parts.decompose(seams=True)
        ends = np.array([[obj.data.vertices[vertex].co[:] for vertex in edge.vertices]
                         for edge in obj.data.edges if edge.use_seam])
        marked.append(np.unique(np.sort(ends.round(4), axis=1).reshape(-1, 6), axis=0))
    assert len(marked[0]) > 10
    np.testing.assert_array_equal(*marked)

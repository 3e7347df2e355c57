# SPDX-License-Identifier: GPL-3.0-or-later
"""Hints: materials, seams and sharp edges of the mesh, and the parts that follow them."""

import bpy
import numpy as np
import pytest
import shapes
from results import numbers


@pytest.fixture
def ball(make):
    """A ball whose upper half is marked in all three ways."""
    shape = shapes.icosphere(3)
    obj = make(shape, "Ball")
    upper = shape.vertices[shape.faces].mean(axis=1)[:, 2] > 0
    for name in ("Lower", "Upper"):
        obj.data.materials.append(bpy.data.materials.new(name))
    obj.data.polygons.foreach_set("material_index", upper.astype(np.int32))
    sides = {}
    for face, polygon in enumerate(obj.data.polygons):
        for edge in polygon.edge_keys:
            sides.setdefault(edge, set()).add(bool(upper[face]))
    for edge in obj.data.edges:
        edge.use_seam = edge.use_edge_sharp = len(sides[edge.key]) == 2
    return obj, upper


def follows(mesh, upper):
    return len(set(zip(numbers(mesh).tolist(), upper.tolist(), strict=True))) == 2 == len(set(numbers(mesh).tolist()))


@pytest.mark.parametrize("kind", ["MATERIALS", "SEAMS", "SHARP"])
def test_parts_follow_what_is_marked(ball, kind):
    obj, upper = ball
    assert bpy.ops.reeb_parts.decompose(hints=kind, detail=0.5) == {"FINISHED"}
    assert follows(obj.data, upper)
    assert bpy.ops.reeb_parts.decompose(detail=0.5) == {"FINISHED"}
    assert not follows(obj.data, upper)


@pytest.mark.parametrize("kind", ["MATERIALS", "SEAMS"])
def test_what_reeb_parts_put_there_is_no_hint(ball, kind):
    obj, upper = ball
    assert bpy.ops.reeb_parts.decompose(n_parts=4, materials=True, seams=True) == {"FINISHED"}
    assert len(set(numbers(obj.data).tolist())) == 4
    assert bpy.ops.reeb_parts.decompose(hints=kind, detail=0.5, materials=True, seams=True) == {"FINISHED"}
    assert follows(obj.data, upper)


def test_in_edit_mode(ball):
    obj, upper = ball
    bpy.ops.object.mode_set(mode="EDIT")
    assert bpy.ops.reeb_parts.decompose(hints="MATERIALS", detail=0.5) == {"FINISHED"}
    bpy.ops.object.mode_set(mode="OBJECT")
    assert follows(obj.data, upper)


@pytest.mark.parametrize("kind", ["MATERIALS", "SEAMS", "SHARP"])
def test_to_read_them_leaves_nothing(make, kind):
    obj = make(([(0, 0, 0)], []), "Empty")
    with pytest.raises(RuntimeError, match="The mesh has no faces"):
        bpy.ops.reeb_parts.decompose(hints=kind)
    assert not obj.data.is_property_set("reeb_parts")

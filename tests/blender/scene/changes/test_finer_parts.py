# SPDX-License-Identifier: GPL-3.0-or-later
"""What is cut by hand through a candidate: graph, picking, marks and JSON name the part that is there.

They once named the part that the candidate had been in before.
"""

import importlib
import sys

import bpy
import numpy as np
import pytest
import shapes
from mathutils import Vector
from results import numbers

TIP = shapes.TREE_TIPS[0]
FAR = 1.7  # along the branch, beyond every cut below


@pytest.fixture
def modules(package):
    """pointing, graph_overlay, part_names and object_report of the extension."""
    names = "viewport.pointing", "viewport.graph_overlay", "scene.result.part_names", "scene.saving.object_report"
    return [importlib.import_module(f"{package}.{name}") for name in names]


@pytest.fixture
def mesh(obj):
    """The tree as one part, whose candidates are whole branches."""
    bpy.ops.reeb_parts.decompose(method="berretti", n_parts=1)
    return obj.data


def beyond(mesh):
    """Faces of the outer half of a branch, (p,) bool."""
    centers = np.array([polygon.center[:] for polygon in mesh.polygons])
    way = TIP / np.linalg.norm(TIP)
    along = centers @ way
    return (along > 1.4) & (np.linalg.norm(centers - along[:, None] * way, axis=1) < 0.6)


def cut(mesh):
    bpy.ops.reeb_parts.cut(location=1.4 * Vector(TIP).normalized())


def assign(mesh):
    bpy.ops.object.mode_set(mode="OBJECT")
    mesh.polygons.foreach_set("select", beyond(mesh))
    bpy.ops.reeb_parts.assign(new=True)


def paint(mesh):
    """Split something off, then paint the outer half of a branch into it as a second piece of its own."""
    cut(mesh)
    bpy.ops.reeb_parts.paint(stroke=[{"name": "", "location": tuple(Vector(shapes.TREE_TIPS[1])), "radius": 0.5}])


def slide(mesh):
    cut(mesh)
    bpy.ops.reeb_parts.slide(offset=-0.15)


@pytest.mark.parametrize("way", [cut, assign, slide, paint])
def test_everything_names_the_part_that_is_there(obj, mesh, modules, way):
    pointing, graph_overlay, part_names, object_report = modules
    way(mesh)
    tip = shapes.TREE_TIPS[1] if way is paint else TIP
    found = numbers(mesh)
    assert len(set(found.tolist())) > 1
    face = int(np.linalg.norm(np.array([p.center[:] for p in mesh.polygons]) - tip, axis=1).argmin())
    new = int(found[face])
    assert new != 1

    # The node at the tip: the empty, the JSON.
    node = min((item for item in bpy.data.objects if item.get("reeb_parts_role") == "node"),
               key=lambda item: (item.location - Vector(tip)).length)
    assert node["part"] == new
    report = object_report.object_report(obj)
    place = {part["index"]: part["number"] for part in report["parts"]}
    nearest = min(report["graph"]["nodes"], key=lambda item: np.linalg.norm(np.subtract(item["position"], tip)))
    assert place[nearest["part"]] == new

    # A point of the arc just below the tip: picking, the colour of the line.
    model = pointing.Model(obj)
    inner = 0.97 * Vector(tip)
    assert model.number(model.at(obj, inner, True)) == new
    points, colors = graph_overlay.colored_arcs(mesh)
    at = np.linalg.norm(points - np.array(inner), axis=1).argmin()
    np.testing.assert_allclose(colors[at], part_names.number_colors(mesh)[new], atol=1e-6)

    # The vertex group and the vertices of the stored result agree.
    stored = sys.modules[model.__class__.__module__].store.load(mesh)
    vertex = int(np.linalg.norm(np.array([v.co[:] for v in mesh.vertices]) - tip, axis=1).argmin())
    assert stored.shown[stored.decomposition.vertex_candidates[vertex]] == new
    group = obj.vertex_groups[part_names.part_name(mesh, new)].index
    assert group in [entry.group for entry in mesh.vertices[vertex].groups]

# SPDX-License-Identifier: GPL-3.0-or-later
"""Objects to separate, and what separates them."""

import importlib

import bpy
import numpy as np
import pytest
import shapes
from bulk import read
from pieces import WIDTH

SHAPES = {
    "tree": shapes.tube_tree,
    "genus two": lambda: shapes.genus_two(0.12),
    "open tube": lambda: shapes.cylinder(24, 16),
    "loose parts": lambda: shapes.together(shapes.tube_tree(), shapes.moved(shapes.dumbbell(40, 12), (9, 0, 0))),
}


@pytest.fixture
def rich(obj):
    """The tree with all that a mesh can carry."""
    rng = np.random.default_rng(0)
    mesh = obj.data

    def fill(attribute, key, width, dtype):
        values = rng.random(len(attribute.data) * width)
        attribute.data.foreach_set(key, (values if dtype is np.float32 else 9 * values).astype(dtype))

    for name in ("Map", "Light"):
        layer = mesh.uv_layers.new(name=name)
        layer.data.foreach_set("uv", rng.random(2 * len(mesh.loops)).astype(np.float32))
    for name, kind, domain in (
        ("Paint", "BYTE_COLOR", "CORNER"), ("Dust", "FLOAT_COLOR", "POINT"), ("wear", "FLOAT", "POINT"),
        ("flow", "FLOAT_VECTOR", "FACE"), ("layer", "INT", "FACE"), ("crease_edge", "FLOAT", "EDGE"),
        ("bevel_weight_edge", "FLOAT", "EDGE"),
    ):
        key, width = WIDTH.get(kind, ("value", 1))
        fill(mesh.attributes.new(name, kind, domain), key, width, np.int32 if kind == "INT" else np.float32)
    for key in ("use_seam", "use_edge_sharp"):
        mesh.edges.foreach_set(key, rng.random(len(mesh.edges)) < 0.1)
    for name in ("Red", "Green"):
        mesh.materials.append(bpy.data.materials.new(name))
    mesh.polygons.foreach_set("material_index", rng.integers(0, 2, len(mesh.polygons)).astype(np.int32))
    mesh.polygons.foreach_set("use_smooth", np.ones(len(mesh.polygons), bool))
    group = obj.vertex_groups.new(name="Arm")
    for index, weight in enumerate(rng.random(len(mesh.vertices)).tolist()):
        group.add([index], weight, "REPLACE")
    obj.shape_key_add(name="Basis")
    key = obj.shape_key_add(name="Fat")
    key.data.foreach_set("co", 1.1 * read(mesh.vertices, "co", np.float32, 3).ravel())
    directions = read(mesh.vertices, "normal", np.float32, 3) + 0.3 * rng.standard_normal(3)
    mesh.normals_split_custom_set_from_vertices(directions.tolist())
    return obj


@pytest.fixture(params=SHAPES)
def shape(request, make):
    return make(SHAPES[request.param](), "Tree")


@pytest.fixture
def separate(package):
    """The module behind the operator, to try parts that no decomposition would give."""
    return importlib.import_module(f"{package}.scene.pieces.part_meshes")

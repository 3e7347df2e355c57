# SPDX-License-Identifier: GPL-3.0-or-later
"""What the JSON says of objects that share a mesh, each with a scale of its own."""

import importlib
from collections import defaultdict

import bpy
import numpy as np
import pytest
from results import numbers


@pytest.fixture
def reports(package, obj):
    """A function that tells of the tree and of an object of the same mesh, scaled, with that object."""
    bpy.ops.reeb_parts.decompose()
    report = importlib.import_module(f"{package}.scene.saving.object_report").object_report

    def reports_of(scale):
        other = bpy.data.objects.new("Other", obj.data)
        other.scale = scale
        bpy.context.scene.collection.objects.link(other)
        bpy.context.view_layer.update()
        return report(obj), report(other), other

    return reports_of


def test_areas_lengths_and_radii_are_those_of_the_objects_own_scale(reports):
    """They were those of the object that was decomposed, beside boxes and positions of its own."""
    one, three, _ = reports((3, -3, 3))
    assert three["area"] == pytest.approx(9 * one["area"])
    assert [part["area"] for part in three["parts"]] == pytest.approx([9 * part["area"] for part in one["parts"]])
    assert [part["share"] for part in three["parts"]] == pytest.approx([part["share"] for part in one["parts"]])
    assert [cut["length"] for cut in three["cuts"]] == pytest.approx([3 * cut["length"] for cut in one["cuts"]])
    for wide, narrow in zip(three["graph"]["arcs"], one["graph"]["arcs"], strict=True):
        assert wide["radii"] == pytest.approx([3 * radius for radius in narrow["radii"]])


def test_areas_and_lengths_are_measured_where_directions_are_stretched_differently(reports):
    _, told, other = reports((1, 2, 5))
    mesh, number = other.data, numbers(other.data)
    points = np.array([other.matrix_world @ vertex.co for vertex in mesh.vertices])
    area, length = defaultdict(float), defaultdict(float)
    beside = defaultdict(list)
    for face in mesh.polygons:
        a, b, c = points[list(face.vertices)]
        area[number[face.index]] += np.linalg.norm(np.cross(b - a, c - a)) / 2
        for key in face.edge_keys:
            beside[key].append(number[face.index])
    for key, (first, second) in beside.items():
        if first != second:
            length[frozenset((first, second))] += np.linalg.norm(points[key[0]] - points[key[1]])
    assert {part["number"]: part["area"] for part in told["parts"]} == pytest.approx(dict(area))
    told_lengths = {frozenset(told["parts"][index]["number"] for index in cut["parts"]): cut["length"]
                    for cut in told["cuts"]}
    assert told_lengths == pytest.approx(dict(length))
    assert sum(part["share"] for part in told["parts"]) == pytest.approx(1)

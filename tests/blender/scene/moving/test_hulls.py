# SPDX-License-Identifier: GPL-3.0-or-later
"""reeb_parts.hulls: a convex object around each part, where the part is, with the name that an engine looks for."""

import bpy
import numpy as np
import pytest
from places import world_points
from snapshot import check_undo, snapshot


def hulls_of(obj):
    return [o for o in bpy.data.objects if o.get("reeb_parts_role") == "hull"]


@pytest.mark.parametrize("engine", ["UNREAL", "GODOT"])
def test_a_hull_around_each_part(obj, engine):
    obj.location, obj.scale = (1, 2, 3), (1, -2, 1)
    bpy.ops.reeb_parts.decompose()
    assert bpy.ops.reeb_parts.hulls(engine=engine) == {"FINISHED"}
    bpy.context.view_layer.update()
    parts = obj.data.reeb_parts.parts
    names = [f"UCX_Tree_{i + 1:02d}" if engine == "UNREAL" else f"Tree {part.name}-convcolonly"
             for i, part in enumerate(parts)]
    assert [hull.name for hull in hulls_of(obj)] == sorted(names)
    numbers = np.array([value.value for value in obj.data.attributes["reeb_part"].data])
    points = world_points(obj)
    for part, name in zip(parts, names, strict=True):
        hull = bpy.data.objects[name]
        mine = points[sorted({v for p in obj.data.polygons if numbers[p.index] == part.number for v in p.vertices})]
        # Of many corners some are kept: the box differs by little.
        assert world_points(hull).min(axis=0) == pytest.approx(mine.min(axis=0), abs=0.05 * np.ptp(mine, axis=0).max())
        assert world_points(hull).max(axis=0) == pytest.approx(mine.max(axis=0), abs=0.05 * np.ptp(mine, axis=0).max())
        assert hull.hide_render
        assert hull.display_type == "WIRE"


def test_several_hulls_of_a_part_are_numbered(obj):
    bpy.ops.reeb_parts.decompose(n_parts=1)
    assert bpy.ops.reeb_parts.hulls(count=4) == {"FINISHED"}
    names = [hull.name for hull in hulls_of(obj)]
    assert names == [f"UCX_Tree_{i + 1:02d}" for i in range(len(names))]
    assert 1 < len(names) <= 4
    bpy.ops.reeb_parts.hulls(engine="GODOT", count=4)
    part = obj.data.reeb_parts.parts[0].name
    assert [hull.name for hull in hulls_of(obj)] == [f"Tree {part}_{i + 1:02d}-convcolonly" for i in range(len(names))]
    bpy.ops.reeb_parts.hulls(engine="GODOT")
    assert [hull.name for hull in hulls_of(obj)] == [f"Tree {part}-convcolonly"]


def test_long_names_keep_the_ending(obj):
    bpy.ops.reeb_parts.decompose(n_parts=2)
    obj.name = "T" * 60
    bpy.ops.reeb_parts.hulls(engine="GODOT")
    assert len(hulls_of(obj)) == 2
    assert all("-convcolonly" in hull.name for hull in hulls_of(obj))


def test_twice_is_once_and_a_used_hull_is_kept(obj):
    bpy.ops.reeb_parts.decompose()
    bpy.ops.reeb_parts.hulls()
    once = snapshot()
    bpy.ops.reeb_parts.hulls()
    assert snapshot() == once
    mine = hulls_of(obj)[0]
    mine.location.x += 1
    bpy.ops.reeb_parts.hulls()
    assert mine in bpy.data.objects[:]
    assert mine not in hulls_of(obj)
    assert len(hulls_of(obj)) == len(obj.data.reeb_parts.parts)


def test_undo(obj):
    bpy.ops.reeb_parts.decompose()
    check_undo(bpy.ops.reeb_parts.hulls)

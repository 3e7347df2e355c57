# SPDX-License-Identifier: GPL-3.0-or-later
"""Names, colors and pins stay with their parts when an edit brings more faces that have the numbers of parts."""

import bpy
import pytest
import shapes
from mathutils import Matrix, Vector

FAR = 5.0  # more than the size of the tree


def named(obj):
    """Decompose an object and name all of its parts; where each is, by name."""
    bpy.ops.reeb_parts.decompose()
    for index, part in enumerate(obj.data.reeb_parts.parts):
        part.name = f"Branch {index}"
    return places(obj.data, ["Branch"])


def places(mesh, names):
    """The middles of parts, by their names, of those whose names begin so."""
    return {part.name: Vector(part.middle) for part in mesh.reeb_parts.parts if part.name.startswith(tuple(names))}


def check_places(mesh, before):
    """Named parts are where they were. The cuts may differ: they are alike in all that is alike."""
    after = places(mesh, before)
    assert set(after) == set(before)
    assert max((after[name] - before[name]).length for name in before) < 0.05


@pytest.mark.parametrize(("pinned", "edited"), [(False, False), (False, True), (True, False)])
def test_what_is_joined_in_has_parts_of_its_own(make, tree, pinned, edited):
    """Its faces have numbers of its own list, so that the names went over to it, and what was pinned grew into it."""
    obj = make(tree)
    bpy.ops.reeb_parts.decompose()
    if pinned:
        obj.data.reeb_parts.active = 1
        bpy.ops.reeb_parts.grow()
    before, held = named(obj), [part.name for part in obj.data.reeb_parts.parts if part.pinned]
    assert bool(held) == pinned
    other = make(shapes.horse(), "Other")
    other.location.y = FAR
    bpy.ops.reeb_parts.decompose()
    obj.select_set(True)
    bpy.context.view_layer.objects.active = obj
    bpy.ops.object.join()
    if edited:  # then only where it is tells what was joined
        obj.data.vertices[len(obj.data.vertices) - 1].co.y += 1e-4
        obj.data.vertices[0].co.y += 1e-4
    bpy.ops.reeb_parts.decompose()
    result = obj.data.reeb_parts
    check_places(obj.data, before)
    assert [part.name for part in result.parts if part.pinned and part.name in before] == held
    others = [part for part in result.parts if part.name not in before]
    assert len(others) > 3
    assert all(part.middle[1] > FAR / 2 for part in others)
    assert not any(part.pinned for part in others)


@pytest.mark.parametrize("pinned", [False, True])
@pytest.mark.parametrize(("kind", "settings"), [
    ("ARRAY", {"count": 3, "relative_offset_displace": (0.0, 1.4, 0.0)}),
    ("MIRROR", {"use_axis": (False, True, False)}),
])
def test_names_stay_where_they_were_beside_copies(make, kind, settings, pinned):
    """Each went to some copy, by the order of the faces; a pinned trunk and its copies were one part."""
    obj = make(shapes.horse())
    obj.data.transform(Matrix.Translation((0.0, FAR, 0.0)))
    bpy.ops.reeb_parts.decompose()
    if pinned:
        obj.data.reeb_parts.active = 0
        bpy.ops.reeb_parts.grow()
    before, held = named(obj), sum(part.pinned for part in obj.data.reeb_parts.parts)
    assert bool(held) == pinned
    modifier = obj.modifiers.new("Copies", kind)
    for name, value in settings.items():
        setattr(modifier, name, value)
    bpy.ops.object.modifier_apply(modifier="Copies")
    bpy.ops.reeb_parts.decompose()
    check_places(obj.data, before)
    assert sum(part.pinned for part in obj.data.reeb_parts.parts) == held * settings.get("count", 2)

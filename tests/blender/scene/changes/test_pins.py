# SPDX-License-Identifier: GPL-3.0-or-later
"""Another run leaves every part that was changed by hand as it is, face by face, whatever its own candidates are.

The candidates of the new run, which are not those that were cut by hand, once had one pin each: a border by hand went
to the nearest edge of theirs, or was gone.
"""

import bpy
import numpy as np
import pytest
import shapes
from mathutils import Matrix, Vector
from results import numbers
from snapshot import check_undo

METHODS = ("perceptual", "berretti", "lavoue", "liu")
TIP = shapes.TREE_TIPS[0]


def centers(mesh):
    return np.array([polygon.center[:] for polygon in mesh.polygons])


def choose(mesh, place):
    """Make the part at a place of the surface the active one and the only one that is chosen."""
    face = np.linalg.norm(centers(mesh) - place, axis=1).argmin()
    number, result = int(numbers(mesh)[face]), mesh.reeb_parts
    for index, part in enumerate(result.parts):
        part.selected = part.number == number
        if part.selected:
            result.active = index


def at_tip(work):
    """Work on the part of a branch."""
    def way(mesh):
        choose(mesh, TIP)
        work()
    return way


def merge(mesh):
    choose(mesh, TIP)
    bpy.ops.reeb_parts.merge_neighbour()


def merge_small(mesh):
    mesh.reeb_parts.n_parts = 20
    bpy.context.scene.reeb_parts.small = 10.0
    bpy.ops.reeb_parts.merge_small()


def cut(mesh):
    bpy.ops.reeb_parts.cut(location=1.4 * Vector(TIP).normalized())


def split_at_node(mesh):
    node = min((item for item in bpy.data.objects if item.get("reeb_parts_role") == "node"),
               key=lambda item: (item.location - Vector(TIP)).length)
    tree, bpy.context.view_layer.objects.active = bpy.context.object, node
    bpy.ops.reeb_parts.split_at_node()
    bpy.context.view_layer.objects.active = tree


def paint(mesh):
    choose(mesh, TIP)
    bpy.ops.reeb_parts.paint(stroke=[{"name": "", "location": shapes.TREE_TIPS[1], "radius": 0.4}])


def assign(mesh, new=False):
    choose(mesh, TIP)
    mesh.polygons.foreach_set("select", np.linalg.norm(centers(mesh) - 0.5 * TIP, axis=1) < 0.9)
    bpy.ops.reeb_parts.assign(new=new)


def assign_new(mesh):
    assign(mesh, new=True)


def assign_ring(mesh):
    """A ring around a branch, of which two parts are left."""
    from_tip = np.linalg.norm(centers(mesh) - TIP, axis=1)
    mesh.polygons.foreach_set("select", (from_tip > 0.5) & (from_tip < 0.8))
    bpy.ops.reeb_parts.assign(new=True)


def from_face_sets(mesh):
    bpy.ops.reeb_parts.face_sets()
    sets = np.zeros(len(mesh.polygons), np.int32)
    data = mesh.attributes[".sculpt_face_set"].data
    data.foreach_get("value", sets)
    sets[np.linalg.norm(centers(mesh) - 0.6 * TIP, axis=1) < 0.5] = 77
    data.foreach_set("value", sets)
    bpy.ops.reeb_parts.from_face_sets()


def lock(mesh):
    choose(mesh, TIP)
    mesh.reeb_parts.parts[mesh.reeb_parts.active].locked = True


WAYS = {
    "merge": merge,
    "merge small": merge_small,
    "split": at_tip(lambda: bpy.ops.reeb_parts.split()),
    "split at node": split_at_node,
    "grow": at_tip(lambda: bpy.ops.reeb_parts.grow()),
    "grow by rings": at_tip(lambda: bpy.ops.reeb_parts.grow(rings=2)),
    "shrink": at_tip(lambda: bpy.ops.reeb_parts.shrink()),
    "shrink by rings": at_tip(lambda: bpy.ops.reeb_parts.shrink(rings=-2)),
    "slide": at_tip(lambda: bpy.ops.reeb_parts.slide(offset=-0.15)),
    "cut": cut,
    "paint": paint,
    "assign": assign,
    "assign new": assign_new,
    "assign ring": assign_ring,
    "face sets": from_face_sets,
    "lock": lock,
}


@pytest.fixture(params=[True, False], ids=["symmetric", "one side"])
def mesh(obj, request):
    bpy.context.scene.reeb_parts.symmetry = request.param
    bpy.ops.reeb_parts.decompose()
    return obj.data


def by_hand(mesh, way):
    """Change parts by hand; the part of each face then, and which faces are pinned, (p,) each."""
    before = numbers(mesh)
    WAYS[way](mesh)
    after = numbers(mesh)
    assert way in ("lock", "merge small") or (after != before).any()
    pinned = np.isin(after, pins(mesh))
    assert pinned.any()
    return after, pinned


def pins(mesh):
    return [part.number for part in mesh.reeb_parts.parts if part.pinned]


def check(mesh, parts, pinned):
    """The pinned parts are what they were, and the list says so."""
    after = numbers(mesh)
    np.testing.assert_array_equal(after[pinned], parts[pinned])
    assert not np.isin(after[~pinned], parts[pinned]).any()
    assert sorted(pins(mesh)) == sorted(set(parts[pinned].tolist()))
    shares = {part.number: part.share for part in mesh.reeb_parts.parts}
    area = np.array([polygon.area for polygon in mesh.polygons])
    assert shares == pytest.approx({number: area[after == number].sum() / area.sum() for number in shares}, abs=1e-4)


@pytest.mark.parametrize("way", WAYS)
def test_another_run_changes_nothing(mesh, way):
    parts, pinned = by_hand(mesh, way)
    for _ in range(2):
        bpy.ops.reeb_parts.decompose()
        check(mesh, parts, pinned)
        np.testing.assert_array_equal(numbers(mesh), parts)


@pytest.mark.parametrize("way", WAYS)
def test_a_run_of_another_method_keeps_pinned_parts(mesh, way):
    parts, pinned = by_hand(mesh, way)
    for method in METHODS[1:]:
        bpy.ops.reeb_parts.decompose(method=method)
        check(mesh, parts, pinned)
    for detail in (0.0, 1.0, 0.5):
        mesh.reeb_parts.detail = detail
        check(mesh, parts, pinned)
    bpy.ops.reeb_parts.decompose(n_parts=20)
    check(mesh, parts, pinned)


def test_every_method_is_tried():
    choices = bpy.context.scene.reeb_parts.bl_rna.properties["method"].enum_items
    assert [choice.identifier for choice in choices] == list(METHODS)


@pytest.mark.parametrize("method", METHODS)
def test_a_run_of_each_method_keeps_what_was_done_after_it(obj, method):
    bpy.context.scene.reeb_parts.symmetry = False
    mesh = obj.data
    bpy.ops.reeb_parts.decompose(method=method)
    for way in ("cut", "grow by rings", "assign new"):
        WAYS[way](mesh)
    parts = numbers(mesh)
    pinned = np.isin(parts, pins(mesh))
    bpy.ops.reeb_parts.decompose(method=method)
    check(mesh, parts, pinned)
    np.testing.assert_array_equal(numbers(mesh), parts)


def test_it_is_one_step_of_undo(mesh):
    by_hand(mesh, "grow by rings")
    parts, name = numbers(mesh), mesh.name
    check_undo(lambda: bpy.ops.reeb_parts.decompose(method="berretti", detail=0.9))
    bpy.ops.ed.undo()
    np.testing.assert_array_equal(numbers(bpy.data.meshes[name]), parts)


def test_released_parts_go_back_to_the_detail(mesh):
    before = numbers(mesh)
    by_hand(mesh, "assign ring")
    bpy.ops.reeb_parts.decompose()
    bpy.ops.reeb_parts.release(everything=True)
    assert len(set(numbers(mesh).tolist())) == len(set(before.tolist()))
    assert not pins(mesh)
    bpy.ops.reeb_parts.decompose()
    assert len(set(numbers(mesh).tolist())) == len(set(before.tolist()))


@pytest.mark.parametrize("way", ["cut", "grow by rings", "assign ring"])
def test_pins_follow_the_faces_of_an_edited_mesh(mesh, way):
    """Each old face is left, moved a little, and a few are cut in two, whose halves are in the part that it was in."""
    import bmesh

    parts, _ = by_hand(mesh, way)
    with_number = mesh.attributes.new("was", "INT", "FACE")
    with_number.data.foreach_set("value", parts)
    work = bmesh.new()
    work.from_mesh(mesh)
    bmesh.ops.subdivide_edges(work, edges=[edge for edge in work.edges if edge.index % 7 == 0], cuts=1)
    bmesh.ops.triangulate(work, faces=work.faces[:])
    bmesh.ops.translate(work, verts=work.verts[:9], vec=(0.001, 0.0, 0.0))
    work.to_mesh(mesh)
    work.free()
    mesh.update()
    was = np.zeros(len(mesh.polygons), np.int32)
    mesh.attributes["was"].data.foreach_get("value", was)
    pinned = np.isin(was, pins(mesh))
    bpy.ops.reeb_parts.decompose()
    check(mesh, was, pinned)


def test_a_cut_beside_a_pinned_part_leaves_no_scraps(mesh):
    """Where the new cut of an edited mesh lies inside of what was not pinned, each face between was a part."""
    parts, pinned = by_hand(mesh, "merge")
    beside = next(number for number in parts[~pinned] if number != parts[0])
    edges = {edge for face in np.flatnonzero(parts == beside) for edge in mesh.polygons[face].edge_keys}
    rim = pinned & [bool(edges.intersection(polygon.edge_keys)) for polygon in mesh.polygons]
    found = np.where(rim, beside, parts)
    assert 5 < rim.sum() < 40
    mesh.attributes["reeb_part"].data.foreach_set("value", found)
    mesh.vertices[0].co.x += 1e-4
    bpy.ops.reeb_parts.decompose()
    check(mesh, found, pinned & ~rim)
    np.testing.assert_array_equal(numbers(mesh)[rim], found[rim])
    assert set(numbers(mesh).tolist()) == set(found.tolist())


def test_faces_that_are_new_within_a_pinned_part_are_pinned(mesh):
    """A few faces have no number: they are where most of their candidate is, as they were before."""
    parts, pinned = by_hand(mesh, "merge")
    inner = np.flatnonzero(np.linalg.norm(centers(mesh) - TIP, axis=1) < 0.5)[::5]
    assert pinned[inner].all()
    found = parts.copy()
    found[inner] = 0
    mesh.attributes["reeb_part"].data.foreach_set("value", found)
    mesh.vertices[0].co.x += 1e-4
    bpy.ops.reeb_parts.decompose()
    check(mesh, parts, pinned)


@pytest.mark.parametrize(("kind", "settings"), [
    ("ARRAY", {"relative_offset_displace": (3.0, 0.0, 0.0)}),
    ("MIRROR", {}),
])
def test_a_copy_of_a_pinned_part_is_a_pinned_part_of_its_own(obj, result, kind, settings):
    """It was one part in two places, as a limb of a half model once Mirror is applied; both had its name."""
    obj.data.transform(Matrix.Translation((5.0, 0.0, 0.0)))
    bpy.ops.reeb_parts.decompose()
    part = max(result.parts, key=lambda part: part.middle[2])
    result.active = list(result.parts).index(part)
    bpy.ops.reeb_parts.grow(rings=1)
    part = result.parts[result.active]
    part.name, part.color = "Limb", (1.0, 0.0, 0.0)
    middle, count = Vector(part.middle), (numbers(obj.data) == part.number).sum()
    modifier = obj.modifiers.new("Copies", kind)
    for name, value in settings.items():
        setattr(modifier, name, value)
    bpy.ops.object.modifier_apply(modifier="Copies")
    bpy.ops.reeb_parts.decompose()
    limb = result.parts["Limb"]
    assert limb.pinned
    assert (Vector(limb.middle) - middle).length < 1e-4
    assert (numbers(obj.data) == limb.number).sum() == count
    copies = [other for other in result.parts
              if other.pinned and (numbers(obj.data) == other.number).sum() == count and other.name != "Limb"]
    assert [tuple(copy.color) != (1.0, 0.0, 0.0) for copy in copies] == [True]

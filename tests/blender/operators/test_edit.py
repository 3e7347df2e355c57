# SPDX-License-Identifier: GPL-3.0-or-later
"""Parts changed by hand: locked, merged, split, grown, shrunk, painted; kept when the detail changes."""

import importlib
import re

import bpy
import numpy as np
import pytest
import shapes
from results import numbers
from snapshot import activate, check_undo, snapshot


@pytest.fixture
def parameters_of_result():
    return {"method": "berretti"}  # of few parts


def choose(result, *chosen):
    """Mark parts in the list by number; the first is active."""
    result.active = [part.number for part in result.parts].index(chosen[0])
    for part in result.parts:
        part.selected = part.number in chosen


def neighbours(mesh, number):
    """Numbers of the parts that share an edge with a part."""
    faces, around = numbers(mesh), {}
    for polygon in mesh.polygons:
        for key in polygon.edge_keys:
            around.setdefault(key, set()).add(int(faces[polygon.index]))
    return sorted(set().union(*(found for found in around.values() if number in found)) - {number})


def part(result, number):
    return next(part for part in result.parts if part.number == number)


def check(obj):
    """The list, the attribute and the groups agree."""
    faces = numbers(obj.data)
    parts = obj.data.reeb_parts.parts
    assert sorted(set(faces.tolist())) == [p.number for p in parts]
    assert sum(p.share for p in parts) == pytest.approx(1.0)
    for p in parts:
        index = obj.vertex_groups[p.group].index
        group = {v.index for v in obj.data.vertices if any(g.group == index for g in v.groups)}
        assert group == {v for f in obj.data.polygons if faces[f.index] == p.number for v in f.vertices}


def test_merge_makes_one_part_and_touches_no_other(obj, result):
    before = numbers(obj.data)
    other = neighbours(obj.data, 1)[0]
    choose(result, 1, other)
    bpy.ops.reeb_parts.merge()
    assert (numbers(obj.data) == np.where(before == other, 1, before)).all()
    assert part(result, 1).pinned
    check(obj)


def test_merge_needs_parts_that_touch(obj, result):
    apart = next(p.number for p in result.parts if p.number != 1 and p.number not in neighbours(obj.data, 1))
    choose(result, 1, apart)
    before = snapshot()
    with pytest.raises(RuntimeError, match="do not touch"):
        bpy.ops.reeb_parts.merge()
    assert snapshot() == before


def test_merged_parts_stay_at_every_detail(obj, result):
    other = neighbours(obj.data, 1)[0]
    choose(result, 1, other)
    bpy.ops.reeb_parts.merge()
    merged = numbers(obj.data) == 1
    for detail in (0.0, 0.9, 0.3, 1.0):
        result.detail = detail
        assert ((numbers(obj.data) == 1) == merged).all()
        check(obj)
    bpy.ops.reeb_parts.decompose(method="berretti", detail=1.0)
    assert ((numbers(obj.data) == 1) == merged).all()
    assert part(result, 1).pinned


def test_merge_into_neighbour(obj, result):
    count = len(result.parts)
    leaf = next(p.number for p in result.parts if len(neighbours(obj.data, p.number)) == 1)
    (receiver,) = neighbours(obj.data, leaf)
    before = numbers(obj.data)
    choose(result, leaf)
    bpy.ops.reeb_parts.merge_neighbour()
    assert len(result.parts) == count - 1
    assert (numbers(obj.data) == np.where(before == leaf, receiver, before)).all()
    check(obj)


@pytest.mark.parametrize(("chosen", "named", "left"), [
    (0, (0,), 0), (1, (1,), 0), (0, (0, 1), 1), (0, (), 1), (1, (0,), 0)])
def test_a_name_of_the_larger_part_outlives_a_neighbor_without_one(obj, result, chosen, named, left):
    """A limb that is joined to a scrap beside it stays the limb; a button does not give its name to the coat."""
    result.by_number, result.n_parts = True, 2
    both = sorted(result.parts, key=lambda p: -p.share)
    words = [f"named {index}" if index in named else p.name for index, p in enumerate(both)]
    for p, word in zip(both, words, strict=True):
        p.name = word
    choose(result, both[chosen].number)
    bpy.ops.reeb_parts.merge_neighbour()
    assert [p.name for p in result.parts] == [words[left]]


def test_parts_that_are_nearest_to_each_other_merge_and_take_no_third(obj, result):
    bpy.context.scene.reeb_parts.symmetry = False
    result.detail = 0.75
    before, count = numbers(obj.data), len(result.parts)
    into = {}
    for number in [p.number for p in result.parts]:
        choose(result, number)
        bpy.ops.reeb_parts.merge_neighbour()
        (into[number],) = set(numbers(obj.data)[before == number].tolist())
        bpy.ops.reeb_parts.release(everything=True)
        assert (numbers(obj.data) == before).all()
    low, high = next(pair for pair in into.items() if pair == (into[pair[1]], pair[1]))
    choose(result, low, high)
    bpy.ops.reeb_parts.merge_neighbour()
    assert len(result.parts) == count - 1
    assert len(set(numbers(obj.data)[np.isin(before, [low, high])].tolist())) == 1
    result.detail = 0.75
    choose(result, *into)  # all at once: groups of those that are nearest
    bpy.ops.reeb_parts.merge_neighbour()
    assert 1 <= len(result.parts) < count / 2
    check(obj)


def test_split_and_merge_again(obj, result):
    result.n_parts = 2
    before = numbers(obj.data)
    choose(result, 1)
    bpy.ops.reeb_parts.split()
    after = numbers(obj.data)
    assert len(result.parts) == 3
    assert set(after[before != 1]) == set(before[before != 1])
    (new,) = set(after.tolist()) - set(before.tolist())
    assert (before[after == new] == 1).all()
    check(obj)
    choose(result, 1, new)
    bpy.ops.reeb_parts.merge()
    assert (numbers(obj.data) == before).all()


def test_a_grain_does_not_split(obj, result):
    result.detail = 1.0
    choose(result, 1)
    with pytest.raises(RuntimeError, match="No cut"):
        bpy.ops.reeb_parts.split()


def test_lock_keeps_a_part_and_unlock_releases_it(obj, result):
    # A limb: what is left without it hangs together.
    number = next(p.number for p in reversed(result.parts) if len(neighbours(obj.data, p.number)) == 1)
    mask = numbers(obj.data) == number
    part(result, number).locked = True
    result.detail = 0.0
    assert ((numbers(obj.data) == number) == mask).all()
    assert len(result.parts) >= 2
    result.n_parts = 2
    assert len(result.parts) == 2
    assert ((numbers(obj.data) == number) == mask).all()
    part(result, number).locked = False
    result.detail = 0.0
    assert len(result.parts) == 1
    check(obj)


def test_unlocked_a_part_that_was_changed_by_hand_stays_so_until_it_is_released(obj, result):
    choose(result, 1, neighbours(obj.data, 1)[0])
    bpy.ops.reeb_parts.merge()
    merged = numbers(obj.data)
    for detail in (None, 0.9):  # also if other parts were listed meanwhile
        part(result, 1).locked = True
        if detail is not None:
            result.detail = detail
        part(result, 1).locked = False
        assert part(result, 1).pinned
        result.detail = 0.5
        assert ((numbers(obj.data) == 1) == (merged == 1)).all()
    choose(result, 1)
    bpy.ops.reeb_parts.release()
    assert not any(p.pinned for p in result.parts)


@pytest.mark.parametrize("locked", [False, True])
def test_a_lock_that_is_set_to_what_it_was_pins_nothing(obj, result, locked):
    """As Backspace over a lock that is open does, which sets it back to that."""
    for _ in range(2):
        result.parts[0].locked = locked
    result.parts[0].locked = False
    assert not result.parts[0].pinned


def test_a_locked_part_is_kept_by_another_run(obj, result):
    number = result.parts[-1].number
    mask = numbers(obj.data) == number
    part(result, number).locked = True
    bpy.ops.reeb_parts.decompose(method="berretti", detail=0.0)
    assert ((numbers(obj.data) == number) == mask).all()
    assert part(obj.data.reeb_parts, number).locked


def test_locked_parts_are_not_merged_or_split(obj, result):
    other = neighbours(obj.data, 1)[0]
    part(result, other).locked = True
    choose(result, 1, other)
    with pytest.raises(RuntimeError, match="locked"):
        bpy.ops.reeb_parts.merge()
    with pytest.raises(RuntimeError, match="locked"):
        bpy.ops.reeb_parts.split()


@pytest.mark.parametrize("outwards", [True, False])
def test_the_boundary_of_a_locked_part_does_not_slide(obj, result, outwards):
    choose(result, 1)
    part(result, 1).locked = True
    before = numbers(obj.data)
    with pytest.raises(RuntimeError, match="is locked"):
        bpy.ops.reeb_parts.slide(offset=0.1 if outwards else -0.1)
    assert (numbers(obj.data) == before).all()


def test_the_brush_is_not_offered_after_its_strokes():
    """In the panel of what was done last, a radius changed nothing: each dab has its own."""
    found = bpy.ops.reeb_parts.paint.get_rna_type().properties
    assert [prop.identifier for prop in found if not (prop.is_hidden or prop.identifier == "rna_type")] == []


def test_nothing_is_painted_into_a_locked_part(obj, result):
    choose(result, 1)
    other = next(p for p in obj.data.polygons if numbers(obj.data)[p.index] != 1)
    part(result, 1).locked = True
    before = numbers(obj.data)
    with pytest.raises(RuntimeError, match="is locked"):
        bpy.ops.reeb_parts.paint(stroke=[{"name": "", "location": other.center[:], "radius": 0.2}])
    assert (numbers(obj.data) == before).all()


def test_release_gives_back_to_the_detail(obj, result):
    before = numbers(obj.data)
    choose(result, 1, neighbours(obj.data, 1)[0])
    bpy.ops.reeb_parts.merge()
    bpy.ops.reeb_parts.release(everything=True)
    assert not any(p.pinned for p in result.parts)
    assert len(set(numbers(obj.data))) == len(set(before))
    check(obj)


@pytest.mark.parametrize("everything", [True, False])
def test_release_keeps_the_number_of_parts_that_was_typed(obj, result, everything):
    """The detail at which there are so many with pinned parts stayed, at which there are others without: 84 for 20."""
    result.n_parts = 3
    choose(result, *[p.number for p in result.parts if p.number != 1])
    bpy.ops.reeb_parts.split()
    result.n_parts = 8
    choose(result, *[p.number for p in result.parts if p.pinned])
    bpy.ops.reeb_parts.release(everything=everything)
    assert not any(p.pinned for p in result.parts)
    assert (len(result.parts), result.n_parts, result.by_number) == (8, 8, True)
    released, by_release = numbers(obj.data), result.detail
    result.n_parts = 8
    assert (numbers(obj.data) == released).all()
    assert result.detail == by_release
    check(obj)


def test_grow_and_shrink_move_the_boundary(obj, result):
    result.n_parts = 3
    number = result.parts[-1].number
    choose(result, number)
    before = numbers(obj.data) == number
    bpy.ops.reeb_parts.grow()
    grown = numbers(obj.data) == number
    assert (grown & before).sum() == before.sum() < grown.sum()
    check(obj)
    bpy.ops.reeb_parts.shrink()
    shrunk = numbers(obj.data) == number
    assert shrunk.sum() < grown.sum()
    check(obj)


@pytest.mark.parametrize("lock", [False, True])
def test_what_cannot_grow_says_why(obj, result, lock):
    """It said that nothing was left that is not locked, where nothing was."""
    result.n_parts = 1 + lock
    result.parts[-1].locked = lock
    choose(result, result.parts[0].number)
    with pytest.raises(RuntimeError, match="that is not locked" if lock else "that it could take"):
        bpy.ops.reeb_parts.grow()


@pytest.mark.parametrize("new", [False, True])
def test_faces_are_assigned(obj, result, new):
    before = numbers(obj.data)
    result.active = 0
    giver = neighbours(obj.data, 1)[0]
    chosen = np.zeros(len(before), bool)
    beside = {v for f in obj.data.polygons if before[f.index] == 1 for v in f.vertices}
    for polygon in obj.data.polygons:
        if before[polygon.index] == giver and beside.intersection(polygon.vertices):
            chosen[polygon.index] = True
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.ops.mesh.select_mode(type="FACE")
    bpy.ops.mesh.select_all(action="DESELECT")
    bpy.ops.object.mode_set(mode="OBJECT")
    obj.data.polygons.foreach_set("select", chosen)
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.ops.reeb_parts.assign(new=new)
    assert obj.mode == "EDIT"
    bpy.ops.object.mode_set(mode="OBJECT")
    after = numbers(obj.data)
    assert (after != before)[chosen].all()
    assert len(set(after[chosen])) >= 1
    result = obj.data.reeb_parts
    if new:
        assert result.parts[result.active].number in after[chosen]
    else:
        assert (after[chosen] == 1).all()
    check(obj)
    kept = after.copy()
    result.detail = 0.2
    result.detail = 0.5
    assert (numbers(obj.data)[chosen] == kept[chosen]).all()
    check(obj)


def test_assigned_faces_are_those_that_were_selected_and_what_they_cut_off_is_named(obj, capfd):
    bpy.context.scene.reeb_parts.symmetry = False
    bpy.ops.reeb_parts.decompose(n_parts=1)  # of many candidates
    result = obj.data.reeb_parts
    center = np.array([p.center[:] for p in obj.data.polygons])
    from_tip = np.linalg.norm(center - shapes.TREE_TIPS[1], axis=1)
    band = (from_tip > 0.5) & (from_tip < 1.0)
    obj.data.polygons.foreach_set("select", band)
    name = result.parts[0].name
    capfd.readouterr()
    bpy.ops.reeb_parts.assign(new=True)
    after = numbers(obj.data)
    ring, tip, rest = (set(after[faces].tolist()) for faces in (band, from_tip <= 0.5, from_tip >= 1.0))
    assert len(ring) == len(tip) == len(rest) == 1
    assert len(ring | tip | rest) == 3
    told = f"what is left of {name} is in 1 part more: {part(result, *tip).name}"
    assert told in capfd.readouterr().out
    check(obj)


def test_a_ring_within_a_candidate_leaves_two_parts(obj):
    """Its two ends were one part, which lay in two places, where the ring had no candidates beside it."""
    bpy.context.scene.reeb_parts.symmetry = False
    bpy.ops.reeb_parts.decompose(method="berretti")  # of few candidates
    result = obj.data.reeb_parts
    result.detail = 1.0  # each is a part
    candidates = numbers(obj.data)
    center = np.array([p.center[:] for p in obj.data.polygons])
    from_tip = np.linalg.norm(center - shapes.TREE_TIPS[3], axis=1)
    branch = candidates == candidates[from_tip.argmin()]
    ring = branch & (from_tip > 0.4) & (from_tip < 0.7)
    obj.data.polygons.foreach_set("select", ring)
    bpy.ops.reeb_parts.assign(new=True)
    after = numbers(obj.data)
    ends = branch & (from_tip <= 0.4), branch & (from_tip >= 0.7)
    parts = [set(after[faces].tolist()) for faces in (ring, *ends)]
    assert [len(part) for part in parts] == [1, 1, 1]
    assert len(set.union(*parts)) == 3
    np.testing.assert_array_equal(after[~branch], candidates[~branch])
    check(obj)


@pytest.mark.parametrize("way", ["new", "assigned", "painted"])
def test_faces_that_do_not_touch_are_parts_of_their_own_also_within_a_candidate(obj, capfd, way):
    """They were one part in several places, where one candidate had them, or where the part given to was smaller."""
    bpy.context.scene.reeb_parts.symmetry = False
    bpy.ops.reeb_parts.decompose(method="berretti")  # of few candidates
    result = obj.data.reeb_parts
    result.detail = 1.0  # each is a part
    center = np.array([p.center[:] for p in obj.data.polygons])
    from_tip = np.linalg.norm(center - shapes.TREE_TIPS[3], axis=1)
    branch = np.flatnonzero(numbers(obj.data) == numbers(obj.data)[from_tip.argmin()])
    first, *others = np.array_split(branch[np.argsort(from_tip[branch])], 8)[1::3]
    places = [first[:1], *others]  # one face, and larger ones farther down
    obj.data.polygons.foreach_set("select", np.isin(np.arange(len(center)), first[:1]))
    if way != "new":
        bpy.ops.reeb_parts.assign(new=True)
    obj.data.polygons.foreach_set("select", np.isin(np.arange(len(center)), np.concatenate(places)))
    capfd.readouterr()
    if way == "painted":
        faces = np.concatenate(others)
        bpy.ops.reeb_parts.paint(
            stroke=[{"name": "", "location": center[face], "radius": 1e-4} for face in faces])
    else:
        bpy.ops.reeb_parts.assign(new=way == "new")
    found = [np.unique(numbers(obj.data)[faces]).tolist() for faces in places]
    assert len({number for each in found for number in each}) == sum(map(len, found)) >= len(places)
    if way != "painted":
        joined = int((numbers(obj.data)[np.concatenate(places)] == result.parts[result.active].number).sum())
        apart = len(np.concatenate(places)) - joined
        assert f"; {apart} do not touch it and are parts of their own" in capfd.readouterr().out
    check(obj)


def test_a_stroke_takes_specks_along_and_leaves_what_lies_beyond(obj):
    """A ring painted around a branch cuts its tip off, which stays; a speck that the stroke leaves out goes along."""
    bpy.context.scene.reeb_parts.symmetry = False
    bpy.ops.reeb_parts.decompose(n_parts=1)  # of many candidates
    result = obj.data.reeb_parts
    center = np.array([p.center[:] for p in obj.data.polygons])
    from_tip = np.linalg.norm(center - shapes.TREE_TIPS[1], axis=1)
    band = np.flatnonzero((from_tip > 0.5) & (from_tip < 1.0))
    obj.data.polygons.foreach_set("select", np.isin(np.arange(len(center)), band[:1]))
    bpy.ops.reeb_parts.assign(new=True)
    ring = result.parts[result.active].number
    left_out = band[len(band) // 2]
    stroke = [{"name": "", "location": center[face], "radius": 1e-4} for face in band if face != left_out]
    bpy.ops.reeb_parts.paint(stroke=stroke)
    after = numbers(obj.data)
    assert (after[band] == ring).all()
    assert len({ring, *after[from_tip <= 0.5].tolist()}) == 2
    assert len(result.parts) == 3
    check(obj)


@pytest.mark.parametrize("offset", [0.3, -0.3])
def test_a_boundary_slides_by_a_distance(obj, result, offset):
    number = next(p.number for p in result.parts if len(neighbours(obj.data, p.number)) == 1)
    choose(result, number)
    before = numbers(obj.data) == number
    assert bpy.ops.reeb_parts.slide(offset=offset) == {"FINISHED"}
    after = numbers(obj.data) == number
    smaller, larger = (before, after) if offset > 0 else (after, before)
    assert not (smaller & ~larger).any()
    assert larger.sum() > smaller.sum() > 0
    centers = np.array([p.center[:] for p in obj.data.polygons])
    # No face that changed is farther from where the boundary was than the distance.
    rim = {v for p in obj.data.polygons if before[p.index] for v in p.vertices}
    rim &= {v for p in obj.data.polygons if not before[p.index] for v in p.vertices}
    points = np.array([obj.data.vertices[v].co[:] for v in rim])
    moved = centers[before != after]
    far = np.linalg.norm(moved[:, None] - points[None], axis=2).min(axis=1)
    assert far.max() < abs(offset) + 0.1
    check(obj)


@pytest.mark.parametrize("operator", ["grow", "shrink"])
def test_rings_are_as_far_as_the_same_distance_slid(obj, result, operator, package):
    number = next(p.number for p in result.parts if len(neighbours(obj.data, p.number)) == 1)
    choose(result, number)
    rings = 3 if operator == "grow" else -3
    width = boundary(package, obj, number).width
    before = numbers(obj.data)
    bpy.ops.ed.undo_push(message="before")
    getattr(bpy.ops.reeb_parts, operator)(rings=rings)
    by_rings = numbers(obj.data)
    assert ((by_rings == number).sum() > (before == number).sum()) == (rings > 0)
    check(obj)
    bpy.ops.ed.undo_push(message="after")
    bpy.ops.ed.undo()
    obj = bpy.data.objects["Tree"]
    bpy.ops.reeb_parts.slide(offset=rings * width)
    assert (numbers(obj.data) == by_rings).all()


def test_each_ring_holds_the_ones_before(obj, result, package):
    number = next(p.number for p in result.parts if len(neighbours(obj.data, p.number)) == 1)
    moving = boundary(package, obj, number)
    low, high = moving.most
    sizes = [(moving.slid(moving.offset(rings)) == number).sum() for rings in range(low, high + 1)]
    assert (np.diff(sizes) >= 0).all()
    assert 0 < sizes[0] < sizes[-low] == (moving.numbers == number).sum() < sizes[-1]


def test_growing_never_reaches_through_to_another_limb(obj, result):
    number = next(p.number for p in result.parts if len(neighbours(obj.data, p.number)) == 1)
    (trunk,) = neighbours(obj.data, number)
    choose(result, number)
    before = numbers(obj.data)
    bpy.ops.reeb_parts.grow(rings=10_000)
    after = numbers(obj.data)
    assert set(before[before != after].tolist()) == {trunk}
    assert (after[before == trunk] == number).all()


def test_a_boundary_slides_at_one_neighbor_only(obj, result, package):
    number = max((p.number for p in result.parts), key=lambda n: len(neighbours(obj.data, n)))
    around = sorted(neighbours(obj.data, number))
    assert len(around) > 2
    choose(result, number)
    before = numbers(obj.data)
    bpy.ops.reeb_parts.slide(offset=0.2, neighbor=around[1])
    after = numbers(obj.data)
    moved = before != after
    assert moved.any()
    assert (before[moved] == around[1]).all()
    assert (after[moved] == number).all()
    moving = boundary(package, obj, number)
    for other in around[1:]:
        face = moving.rim[(moving.numbers[moving.rim] == other).any(axis=1)][0, 0]
        assert moving.nearest_neighbor(moving.center[face]) == other


def boundary(package, obj, number):
    """As the tools read it."""
    stored = importlib.import_module(f"{package}.scene.store").load(obj.data)
    return importlib.import_module(f"{package}.viewport.modal.boundary").Boundary(obj, stored, number)


def test_of_an_object_that_is_scaled_to_nothing_no_boundary_can_be_moved(obj, result, package):
    """A ring of no width was divided by."""
    obj.scale = (0.0, 0.0, 0.0)
    bpy.context.view_layer.update()
    choose(result, 1)
    with pytest.raises(RuntimeError, match="Check the scale"):
        bpy.ops.reeb_parts.grow(rings=2)


def test_a_boundary_stops_at_a_locked_part(obj, result):
    choose(result, 1)
    for p in result.parts:
        if p.number != 1:
            p.locked = True
    before = numbers(obj.data)
    bpy.ops.reeb_parts.slide(offset=0.5)
    assert (numbers(obj.data) == before).all()


def test_edits_are_undone_and_redone(obj, result):
    choose(result, 1)
    check_undo(bpy.ops.reeb_parts.split)
    bpy.data.objects["Tree"].data.reeb_parts.detail = 0.1
    check(bpy.data.objects["Tree"])


def test_a_click_in_the_list_selects_faces_in_edit_mode(obj, result):
    wanted = numbers(obj.data) == result.parts[2].number
    choose(result, 1)
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.ops.mesh.select_mode(type="FACE")
    result.active = 2
    assert not any(p.selected for p in result.parts)
    bpy.ops.object.mode_set(mode="OBJECT")
    assert [p.select for p in obj.data.polygons] == wanted.tolist()
    bpy.ops.reeb_parts.mark(action="FACES")
    assert [p.number for p in result.parts if p.selected] == [result.parts[2].number]


def test_marks(obj, result):
    bpy.ops.reeb_parts.mark(action="ALL")
    assert all(p.selected for p in result.parts)
    result.parts[0].selected = False
    bpy.ops.reeb_parts.mark(action="INVERT")
    assert [p.selected for p in result.parts] == [True] + [False] * (len(result.parts) - 1)


def test_the_others_of_a_part_that_is_clicked_are_all_but_this_one(obj, result):
    """After a click and Ctrl+I all were marked, and M made one part of the whole."""
    result.active = 2
    for others in (True, False):
        bpy.ops.reeb_parts.mark(action="INVERT")
        assert [p.selected == others for p in result.parts] == [index != 2 for index in range(len(result.parts))]


def test_nodes_are_handles_of_their_parts(obj, result):
    nodes = [item for item in bpy.data.collections["Reeb Graph Tree"].objects if item.type == "EMPTY"]
    tip = next(item for item in nodes if item["kind"] == "maximum" and item["part"] != 1)
    activate(tip)
    assert bpy.ops.reeb_parts.from_nodes() == {"FINISHED"}
    assert bpy.context.view_layer.objects.active == obj
    assert result.parts[result.active].number == tip["part"]
    bpy.ops.reeb_parts.to_nodes()
    assert tip.select_get()
    assert {item["part"] for item in nodes if item.select_get()} == {tip["part"]}


def node_of_kind(kind):
    nodes = bpy.data.collections["Reeb Graph Tree"].objects
    return next(item for item in nodes if item.get("kind") == kind)


def test_a_part_splits_at_a_node(obj, result):
    tip = node_of_kind("maximum")
    result.n_parts = 1
    before = numbers(obj.data)
    activate(tip)
    assert bpy.ops.reeb_parts.split_at_node() == {"FINISHED"}
    after = numbers(obj.data)
    assert len(result.parts) == 2
    assert all(p.pinned for p in result.parts)
    assert set(before.tolist()) < set(after.tolist())
    # The tip's side is the limb: the face beside the tip is in the node's part, which is chosen.
    centers = np.array([p.center[:] for p in obj.data.polygons])
    nearest = np.linalg.norm(centers - np.array(tip.location), axis=1).argmin()
    assert after[nearest] == tip["part"] == result.parts[result.active].number
    assert (after == tip["part"]).sum() < len(after) / 2
    check(obj)
    result.detail = 0.0
    assert (numbers(obj.data) == after).all()


def test_a_node_of_a_locked_part_or_a_grain_splits_nothing(obj, result):
    tip = node_of_kind("maximum")
    part(result, tip["part"]).locked = True
    activate(tip)
    before = snapshot()
    with pytest.raises(RuntimeError, match="is locked"):
        bpy.ops.reeb_parts.split_at_node()
    assert snapshot() == before
    part(result, tip["part"]).locked = False
    result.detail = 1.0
    with pytest.raises(RuntimeError, match="No cut"):
        bpy.ops.reeb_parts.split_at_node()
    activate(obj)
    assert not bpy.ops.reeb_parts.split_at_node.poll()


@pytest.mark.parametrize("mode", ["EDIT", "SCULPT", "WEIGHT_PAINT", "VERTEX_PAINT"])
def test_in_other_modes(obj, result, mode):
    bpy.ops.object.mode_set(mode=mode)
    choose(result, 1, neighbours_in_object_mode(obj))
    bpy.ops.reeb_parts.merge()
    assert obj.mode == mode
    bpy.ops.object.mode_set(mode="OBJECT")
    check(obj)


def neighbours_in_object_mode(obj):
    mode = obj.mode
    bpy.ops.object.mode_set(mode="OBJECT")
    found = neighbours(obj.data, 1)[0]
    bpy.ops.object.mode_set(mode=mode)
    return found


@pytest.mark.parametrize("operator", ["split", "shrink", "grow", "merge_neighbour"])
def test_what_is_not_possible_with_one_of_several_parts_is_done_to_none(obj, result, operator):
    # One part less than there are candidates: only one can be split or give something away.
    result.n_parts = 1000
    finest = numbers(obj.data)
    result.n_parts = len(result.parts) - 1
    good = int(numbers(obj.data)[finest != numbers(obj.data)][0])
    # What one gives away must not be what the other has too little of.
    bad = next(p.number for p in reversed(result.parts) if p.number not in {good, *neighbours(obj.data, good)})
    if operator in ("grow", "merge_neighbour"):  # impossible where all around is locked
        bad = next(p.number for p in reversed(result.parts) if good not in neighbours(obj.data, p.number))
        for number in neighbours(obj.data, bad):
            part(result, number).locked = True
        assert any(not part(result, number).locked for number in neighbours(obj.data, good))
    assert good < bad
    choose(result, good, bad)
    before = snapshot()
    with pytest.raises(RuntimeError):
        getattr(bpy.ops.reeb_parts, operator)()
    assert snapshot() == before
    choose(result, good)
    assert getattr(bpy.ops.reeb_parts, operator)() == {"FINISHED"}
    assert snapshot() != before


@pytest.mark.parametrize("operator", ["split", "grow", "shrink", "merge_neighbour"])
def test_several_parts_at_once_are_as_one_after_the_other(make, tree, operator):
    shown = []
    for together in (True, False):
        obj = make(tree, "One")
        bpy.ops.reeb_parts.decompose(method="liu", n_parts=4)  # parts of many candidates
        mesh = obj.data
        chosen = [part.number for part in mesh.reeb_parts.parts][:2]
        for marked in ([chosen] if together else [[number] for number in chosen]):
            choose(mesh.reeb_parts, *marked)
            getattr(bpy.ops.reeb_parts, operator)()
        check(obj)
        shown.append(numbers(mesh))
    assert (shown[0] == shown[1]).all()


@pytest.mark.parametrize("edit", ["slide", "grow", "shrink"])
def test_a_part_that_touches_nothing_has_no_boundary_to_move(make, edit):
    cubes = shapes.together(shapes.icosphere(2), shapes.moved(shapes.icosphere(2), (5, 0, 0)))
    obj = make(cubes)
    bpy.ops.reeb_parts.decompose(pieces="separate")
    obj.data.reeb_parts.active = 0
    with pytest.raises(RuntimeError, match="shares no edge with another part"):
        getattr(bpy.ops.reeb_parts, edit)(**({"offset": 0.1} if edit == "slide" else {"rings": 1}))


def _grow(obj, small):
    while small in numbers(obj.data):
        bpy.ops.reeb_parts.grow(rings=2)


def _slide(obj, small):
    bpy.ops.reeb_parts.slide(offset=3.0)


def _paint(obj, small):
    place = [p.center[:] for p in obj.data.polygons if numbers(obj.data)[p.index] == small]
    bpy.ops.reeb_parts.paint(stroke=[{"name": "", "location": at, "radius": 0.1} for at in place])


def _assign(obj, small):
    obj.data.polygons.foreach_set("select", numbers(obj.data) == small)
    bpy.ops.reeb_parts.assign()


@pytest.mark.parametrize("way", [_grow, _slide, _paint, _assign])
def test_it_is_told_of_which_part_nothing_is_left(obj, result, capfd, way):
    """A neighbor that a part swallowed was gone without a word."""
    bpy.context.scene.reeb_parts.symmetry = False
    center = np.array([p.center[:] for p in obj.data.polygons])
    obj.data.polygons.foreach_set("select", np.linalg.norm(center - shapes.TREE_TIPS[0], axis=1) < 0.3)
    bpy.ops.reeb_parts.assign(new=True)
    small = result.parts[result.active].number
    (beside,) = neighbours(obj.data, small)
    part(result, small).name = "Knob"
    choose(result, beside)
    capfd.readouterr()
    way(obj, small)
    assert small not in numbers(obj.data)
    said = capfd.readouterr().out
    assert len(re.findall(r"nothing is left of ([^\n]*, )?Knob", said)) == 1


def test_a_part_that_grows_as_far_as_the_next_crease_tells_what_ended(obj, result, capfd):
    result.n_parts = 4
    choose(result, 1)
    count, said = len(result.parts), ""
    while len(result.parts) == count:
        capfd.readouterr()
        bpy.ops.reeb_parts.grow()
        said = capfd.readouterr().out
    assert "Nothing is left of Part" in said

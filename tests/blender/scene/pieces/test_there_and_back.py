# SPDX-License-Identifier: GPL-3.0-or-later
"""Show Original and Show Separated Parts: one or the other is seen, in every layer, scene and file."""

import importlib

import bpy
import pytest
from pieces import pieces_of
from snapshot import activate, check_undo


def test_the_original_is_hidden_and_comes_back(obj):
    bpy.ops.reeb_parts.decompose()
    bpy.ops.reeb_parts.separate()
    assert obj.hide_get()
    assert obj.hide_render
    assert bpy.context.view_layer.objects.active == pieces_of()[0]
    assert set(bpy.context.selected_objects) == set(pieces_of())
    bpy.ops.reeb_parts.show_original()
    assert not obj.hide_get()
    assert not obj.hide_render
    assert bpy.context.view_layer.objects.active == obj


def test_there_and_back_for_all_that_is_selected(make, tree, obj):
    """Of two models that were separated together only the active one came back, and only its pieces after that."""
    other = make(tree, "Other")
    obj.select_set(True)
    bpy.ops.reeb_parts.decompose()
    bpy.ops.reeb_parts.separate()
    pieces = set(bpy.context.selected_objects)
    for _ in range(2):
        bpy.ops.reeb_parts.show_original()
        assert set(bpy.context.selected_objects) == {obj, other}
        assert set(bpy.context.visible_objects) == {obj, other, *obj.children, *other.children}
        bpy.ops.reeb_parts.show_pieces()
        assert set(bpy.context.selected_objects) == pieces == set(bpy.context.visible_objects)


@pytest.mark.parametrize("way", ["objects", "hierarchy"])
def test_the_original_is_back_once_all_pieces_are_deleted(package, obj, way):
    """It was not rendered any more, and nothing said so."""
    watch = importlib.import_module(f"{package}.scene.changes.watch")
    bpy.ops.reeb_parts.decompose()
    bpy.ops.reeb_parts.hulls()
    bpy.ops.reeb_parts.separate()
    pieces = pieces_of()
    for piece in pieces[1:]:
        bpy.data.objects.remove(piece)
    assert not watch._is_untidy()
    kept = obj.reeb_parts_made.pieces
    if way == "objects":
        other = bpy.data.collections.new("Other")  # moved there, it does not say whose it is
        bpy.context.scene.collection.children.link(other)
        other.objects.link(pieces[0])
        kept.objects.unlink(pieces[0])
        assert not watch._is_untidy()
    bpy.data.objects.remove(pieces[0])
    if way == "hierarchy":
        bpy.data.collections.remove(kept)
    assert watch._is_untidy()
    watch._tidy()  # as a timer does
    assert not obj.hide_render
    assert not obj.hide_get()
    assert not watch._is_untidy()


@pytest.mark.parametrize("seen", [True, False])
def test_a_graph_that_was_hidden_stays_hidden_with_the_original(obj, seen):
    bpy.ops.reeb_parts.decompose()
    graph = next(layer for layer in bpy.context.view_layer.layer_collection.children
                 if layer.name.startswith("Reeb Graph"))
    graph.hide_viewport = not seen  # as of a model whose graph would be crowded
    bpy.ops.reeb_parts.separate()
    assert graph.hide_viewport
    for _ in range(2):
        bpy.ops.reeb_parts.show_original()
        assert graph.hide_viewport == (not seen)
        bpy.ops.reeb_parts.show_pieces()
        assert graph.hide_viewport


def test_a_graph_is_hidden_with_the_original_in_all_view_layers(obj):
    """In another one than that of the window it lay over the pieces."""
    bpy.ops.reeb_parts.decompose()
    bpy.context.scene.view_layers.new("Another")
    for command, seen in (("separate", False), ("show_original", True), ("show_pieces", False)):
        getattr(bpy.ops.reeb_parts, command)()
        bpy.context.view_layer.update()
        for layer in bpy.context.scene.view_layers:
            assert {item.visible_get(view_layer=layer) for item in (obj, *obj.children)} == {seen}


def test_the_original_or_its_pieces_are_seen(obj):
    """Both in the same place were speckled. Pieces are hidden in the view alone, which is no work on them."""
    bpy.ops.reeb_parts.decompose()
    bpy.ops.reeb_parts.separate(joints="DOWEL")
    dowels = [item for item in bpy.data.collections["Parts of Tree"].objects if "reeb_parts_dowel" in item]
    assert dowels
    bpy.ops.reeb_parts.show_original()
    assert all(piece.hide_get() for piece in (*pieces_of(), *dowels))
    bpy.ops.reeb_parts.show_pieces()
    assert not any(piece.hide_get() for piece in (*pieces_of(), *dowels))
    assert obj.hide_get()
    assert bpy.context.view_layer.objects.active == pieces_of()[0]
    assert set(bpy.context.selected_objects) == set(pieces_of())
    pieces_of()[1].location.x += 1.0
    kept = pieces_of()[1]
    bpy.ops.reeb_parts.show_original()
    count = len(pieces_of())
    bpy.ops.reeb_parts.separate()
    assert len(pieces_of()) == count
    assert not any(piece.hide_get() for piece in (*pieces_of(), kept))
    assert kept not in pieces_of()


def shown_pieces():
    """How many pieces are seen after Show Separated Parts, with their original hidden."""
    bpy.ops.reeb_parts.show_pieces()
    assert bpy.context.view_layer.objects["Tree"].hide_get()
    assert bpy.context.view_layer.objects.active == pieces_of()[0]
    return sum(piece.visible_get() for piece in pieces_of())


@pytest.mark.parametrize("hidden_by", ["exclude", "hide_viewport"])
def test_pieces_are_shown_though_their_collection_was_not_seen(obj, hidden_by):
    """The original was hidden, and nothing was seen in its place."""
    bpy.ops.reeb_parts.decompose()
    bpy.ops.reeb_parts.separate()
    bpy.ops.reeb_parts.show_original()
    setattr(bpy.context.view_layer.layer_collection.children["Parts of Tree"], hidden_by, True)
    activate(obj)
    assert shown_pieces() == len(pieces_of()) > 2


def test_pieces_are_shown_in_another_scene(obj):
    bpy.ops.reeb_parts.decompose()
    bpy.ops.reeb_parts.separate(hide=False)
    other = bpy.data.scenes.new("Other")
    other.collection.objects.link(obj)
    bpy.context.window.scene = other
    activate(obj)
    assert shown_pieces() == len(pieces_of()) > 2


def test_pieces_are_shown_in_a_file_that_got_their_original_alone(obj, tmp_path):
    bpy.ops.reeb_parts.decompose()
    bpy.ops.reeb_parts.separate()
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "tree.blend"))
    bpy.ops.wm.read_homefile(use_empty=True)
    with bpy.data.libraries.load(str(tmp_path / "tree.blend")) as (_, wanted):
        wanted.objects = ["Tree"]
    bpy.context.scene.collection.objects.link(bpy.data.objects["Tree"])
    bpy.data.objects["Tree"].hide_set(False)
    activate(bpy.data.objects["Tree"])
    assert shown_pieces() == len(pieces_of()) > 2


def test_pieces_are_shown_from_within_an_excluded_collection(obj):
    bpy.ops.reeb_parts.decompose()
    bpy.ops.reeb_parts.separate(hide=False)
    scene, ours = bpy.context.scene.collection, bpy.data.collections["Parts of Tree"]
    around = bpy.data.collections.new("Around")
    scene.children.link(around)
    around.children.link(ours)
    scene.children.unlink(ours)
    bpy.context.view_layer.layer_collection.children["Around"].exclude = True
    activate(obj)
    assert shown_pieces() == len(pieces_of()) > 2
    assert bpy.context.view_layer.layer_collection.children["Around"].exclude


def test_the_original_or_its_pieces_are_rendered(obj):
    """A piece that is out of renders, which is the user's work, stays so; that the others are for a while is none."""
    bpy.ops.reeb_parts.decompose()
    bpy.ops.reeb_parts.separate(joints="DOWEL")
    items = [item for item in bpy.data.collections["Parts of Tree"].objects if "Empty" not in item.name]
    out = pieces_of()[1]
    out.hide_render = True
    activate(out)
    for _ in range(2):
        bpy.ops.reeb_parts.show_original()
        assert not obj.hide_render
        assert all(item.hide_render for item in items)
        bpy.ops.reeb_parts.show_pieces()
        assert obj.hide_render
        assert [item for item in items if item.hide_render] == [out]
    bpy.ops.reeb_parts.show_original()
    count = len(pieces_of())
    bpy.ops.reeb_parts.separate()
    assert len(pieces_of()) == count
    assert out not in pieces_of()
    assert not any(piece.hide_render for piece in pieces_of())


def test_an_original_out_of_renders_has_pieces_out_of_renders(obj):
    bpy.ops.reeb_parts.decompose()
    obj.hide_render = True
    for _ in range(2):
        bpy.ops.reeb_parts.separate()
        assert obj.hide_render
        assert all(piece.hide_render for piece in pieces_of())
        bpy.ops.reeb_parts.show_original()
        assert obj.hide_render
    obj.hide_render = False
    bpy.ops.reeb_parts.separate()
    assert not any(piece.hide_render for piece in pieces_of())
    bpy.ops.reeb_parts.show_original()
    assert not obj.hide_render


def test_an_original_that_an_earlier_version_hid_is_rendered_again(obj):
    """It kept no note of what was before."""
    bpy.ops.reeb_parts.decompose()
    bpy.ops.reeb_parts.separate()
    obj.reeb_parts_made.property_unset("rendered")
    activate(obj)
    obj.hide_set(True)
    bpy.ops.reeb_parts.separate(which="ALL")
    assert not any(piece.hide_render for piece in pieces_of())
    obj.reeb_parts_made.property_unset("rendered")
    bpy.ops.reeb_parts.show_original()
    assert not obj.hide_render


def test_each_view_layer_shows_the_original_or_its_pieces(obj):
    other = bpy.context.scene.view_layers.new("Other")
    bpy.ops.reeb_parts.decompose()
    bpy.ops.reeb_parts.separate()
    assert obj.hide_get(view_layer=other)
    bpy.ops.reeb_parts.show_original()
    assert not obj.hide_get(view_layer=other)
    assert all(piece.hide_get(view_layer=other) for piece in pieces_of())


def test_instances_that_lack_the_original_in_renders_are_named(obj, capfd):
    collection = bpy.data.collections.new("Set")
    collection.objects.link(obj)
    instance = bpy.data.objects.new("Instance", None)
    instance.instance_type, instance.instance_collection = "COLLECTION", collection
    bpy.context.scene.collection.objects.link(instance)
    bpy.ops.reeb_parts.decompose()
    for hide in (False, True):
        capfd.readouterr()
        bpy.ops.reeb_parts.separate(hide=hide)
        said = capfd.readouterr().out
        assert ("Tree is missing from renders of instances of its collection: Instance" in said) == hide
        activate(obj)


def test_other_scenes_that_lack_the_original_in_renders_are_named(obj, capfd):
    """It is hidden in renders as such, and its pieces are in the scene of the window alone."""
    other = bpy.data.scenes.new("Shot 2")
    other.collection.objects.link(obj)
    bpy.ops.reeb_parts.decompose()
    for hide, linked in ((False, False), (True, False), (True, True)):
        if linked:
            other.collection.children.link(bpy.data.collections["Parts of Tree"])
        bpy.context.view_layer.objects.active = obj
        obj.hide_set(False)
        capfd.readouterr()
        bpy.ops.reeb_parts.separate(hide=hide)
        said = capfd.readouterr().out
        assert ("Tree is missing from renders of other scenes: Shot 2" in said) == (hide and not linked)


def test_showing_the_original_is_undone(obj):
    bpy.ops.reeb_parts.decompose()
    bpy.ops.reeb_parts.separate()
    check_undo(lambda: bpy.ops.reeb_parts.show_original())


def test_showing_pieces_is_undone(obj):
    bpy.ops.reeb_parts.decompose()
    bpy.ops.reeb_parts.separate()
    bpy.ops.reeb_parts.show_original()
    check_undo(lambda: bpy.ops.reeb_parts.show_pieces())


def test_pieces_know_an_original_that_was_renamed(obj):
    """Nothing hangs on its name: it can be shown again, and what is separated again takes the place of the pieces."""
    bpy.ops.reeb_parts.decompose(n_parts=3)
    bpy.ops.reeb_parts.separate()
    obj.name = "Renamed"
    bpy.context.view_layer.objects.active = pieces_of()[0]
    bpy.ops.reeb_parts.show_original()
    assert bpy.context.view_layer.objects.active == obj
    counts = len(bpy.data.objects), len(bpy.data.collections)
    bpy.ops.reeb_parts.separate()
    assert (len(bpy.data.objects), len(bpy.data.collections)) == counts
    collection = obj.reeb_parts_made.pieces
    assert [piece.name for piece in collection.objects] == [f"Renamed Part {number:02}" for number in (1, 2, 3)]
    assert collection.name == "Parts of Renamed"
    bpy.ops.reeb_parts.show_original()
    collection.name = "Mine"
    obj.name = "Again"
    bpy.ops.reeb_parts.show_pieces()
    assert collection.name == "Mine"


def test_pieces_of_a_file_that_knew_the_name_alone(obj):
    bpy.ops.reeb_parts.decompose(n_parts=3)
    bpy.ops.reeb_parts.separate()
    bpy.data.collections["Parts of Tree"]["reeb_parts_pieces_of"] = "Tree"
    bpy.ops.reeb_parts.show_original()
    assert bpy.context.view_layer.objects.active == obj


def moved_to(name, items):
    """Move objects to a collection, as M does."""
    collection = bpy.data.collections.get(name) or bpy.data.collections.new(name)
    if name not in bpy.context.scene.collection.children:
        bpy.context.scene.collection.children.link(collection)
    for item in items:
        for before in item.users_collection:
            before.objects.unlink(item)
        collection.objects.link(item)


def without_collection(obj):
    """Delete a collection as the Outliner does: what is in it goes to where it was."""
    collection = obj.reeb_parts_made.pieces
    for item in collection.objects:
        bpy.context.scene.collection.objects.link(item)
    bpy.data.collections.remove(collection)


AWAY = {
    "moved": lambda obj, items: moved_to("Mine", items),
    "some": lambda obj, items: moved_to("Mine", items[::2]),
    "in the collection of another's pieces": lambda obj, items: moved_to("Parts of Other", items),
    "collection deleted": lambda obj, items: without_collection(obj),
}


@pytest.mark.parametrize("way", AWAY)
def test_pieces_know_their_original_wherever_they_are(obj, make, tree, way):
    """Elsewhere they led to no original, which stayed hidden; the next run made all of them once more."""
    other = make(tree, "Other")
    for item in (other, obj):
        activate(item)
        bpy.ops.reeb_parts.decompose(n_parts=3, graph=False)
        bpy.ops.reeb_parts.hulls()
        activate(item)
        bpy.ops.reeb_parts.separate(joints="DOWEL")
    made = [item for item in obj.reeb_parts_made.pieces.objects if item not in (obj, other)]
    AWAY[way](obj, made)
    before = {item.name: [place.name for place in item.users_collection] for item in bpy.data.objects}
    activate(bpy.data.objects["Tree Part 01"])
    bpy.ops.reeb_parts.show_original()
    assert bpy.context.view_layer.objects.active == obj
    bpy.ops.reeb_parts.show_pieces()
    bpy.ops.reeb_parts.show_original()
    bpy.ops.reeb_parts.hulls()
    activate(obj)
    bpy.ops.reeb_parts.separate(joints="DOWEL")
    assert {item.name: [place.name for place in item.users_collection] for item in bpy.data.objects} == before
    assert not other.hide_render or other.hide_get()


def linked_to(name, items):
    """Link objects to a collection, as Shift+M does."""
    collection = bpy.data.collections.new(name)
    bpy.context.scene.collection.children.link(collection)
    for item in items:
        collection.objects.link(item)


MAKERS = {"separate": {"joints": "DOWEL"}, "hulls": {}, "armature": {}, "rigid_bodies": {}}


def test_what_is_linked_to_a_collection_is_made_anew_and_linked_there(obj):
    """That counted as work: a second set of pieces was made beside the first."""
    bpy.ops.reeb_parts.decompose(n_parts=3, graph=False)
    for name, style in MAKERS.items():
        known = set(bpy.data.objects)
        activate(obj)
        getattr(bpy.ops.reeb_parts, name)(**style)
        made = [item for item in bpy.data.objects if item not in known]
        assert made
        linked_to("All", made)
        linked_to("Some", made[::2])
        before = {item.name: {place.name for place in item.users_collection} for item in bpy.data.objects}
        activate(obj)
        getattr(bpy.ops.reeb_parts, name)(**style)
        assert set(made).isdisjoint(bpy.data.objects), name
        assert {item.name: {place.name for place in item.users_collection} for item in bpy.data.objects} == before
        for collection in ("All", "Some"):
            bpy.data.collections.remove(bpy.data.collections[collection])


def test_the_collection_that_pieces_are_linked_to_stays_excluded(obj):
    bpy.ops.reeb_parts.decompose(n_parts=3, graph=False)
    bpy.ops.reeb_parts.separate()
    linked_to("Mine", pieces_of())
    bpy.context.view_layer.layer_collection.children["Mine"].exclude = True
    for command in (bpy.ops.reeb_parts.show_pieces, bpy.ops.reeb_parts.separate):
        activate(obj)
        command()
        assert bpy.context.view_layer.layer_collection.children["Mine"].exclude
        bpy.context.view_layer.update()
        assert [piece.visible_get() for piece in pieces_of()] == [True] * 3
    assert set(bpy.data.collections["Mine"].objects) == set(pieces_of())


def test_fewer_hulls_lie_where_more_were_moved(obj):
    """One takes the places of several: it was to be put there once for each, which Blender refuses."""
    bpy.ops.reeb_parts.decompose(n_parts=2, graph=False)
    bpy.ops.reeb_parts.hulls(count=4)
    hulls = [item for item in obj.reeb_parts_made.pieces.objects if "reeb_parts_hull_of" in item]
    assert len(hulls) > 2
    moved_to("Mine", hulls)
    activate(obj)
    bpy.ops.reeb_parts.hulls(count=1)
    assert len(bpy.data.collections["Mine"].objects) == len(bpy.data.objects) - 1 == 2


def test_pieces_in_a_collection_of_the_users_that_is_excluded_are_shown(obj):
    """The original was hidden for pieces that nobody saw."""
    bpy.ops.reeb_parts.decompose(n_parts=3, graph=False)
    bpy.ops.reeb_parts.separate()
    moved_to("Mine", pieces_of())
    for command in (bpy.ops.reeb_parts.show_pieces, bpy.ops.reeb_parts.separate):
        bpy.ops.reeb_parts.show_original()
        bpy.context.view_layer.layer_collection.children["Mine"].exclude = True
        activate(obj)
        command()
        bpy.context.view_layer.update()
        assert [piece.visible_get() for piece in bpy.data.collections["Mine"].objects] == [True] * 3
        assert not obj.visible_get()


def test_pasted_pieces_are_pieces(obj):
    """They come without the original, and the next run leaves them to the user. In another file they know nothing."""
    bpy.ops.reeb_parts.decompose(n_parts=3, graph=False)
    bpy.ops.reeb_parts.separate()
    activate(pieces_of()[0])
    bpy.ops.view3d.copybuffer()
    for _ in range(2):
        bpy.ops.view3d.pastebuffer()
    assert len(bpy.data.objects) == 1 + 3 + 2
    bpy.ops.reeb_parts.show_original()
    assert bpy.context.view_layer.objects.active == obj
    assert not [item for item in bpy.context.visible_objects if item != obj]
    bpy.ops.reeb_parts.separate()
    assert len(bpy.data.objects) == 1 + 3 + 2
    bpy.ops.wm.read_homefile(use_empty=True)
    bpy.ops.view3d.pastebuffer()
    (alone,) = bpy.data.objects
    activate(alone)
    assert not bpy.ops.reeb_parts.show_original.poll()


def test_the_pieces_of_a_copy_are_its_own(obj):
    """A copy knows what the object knows, such as where pieces are."""
    bpy.ops.reeb_parts.decompose(n_parts=3, graph=False)
    bpy.ops.reeb_parts.separate()
    moved_to("Mine", pieces_of())
    bpy.ops.reeb_parts.show_original()
    copy = obj.copy()
    bpy.context.scene.collection.objects.link(copy)
    activate(copy)
    bpy.ops.reeb_parts.separate()
    assert len(bpy.data.collections["Mine"].objects) == 3
    assert len(copy.reeb_parts_made.pieces.objects) == 3
    activate(bpy.data.collections["Mine"].objects[0])
    bpy.ops.reeb_parts.show_original()
    assert bpy.context.view_layer.objects.active == obj


def test_the_original_is_back_once_the_collection_of_its_pieces_is_unlinked(package, obj):
    watch = importlib.import_module(f"{package}.scene.changes.watch")
    bpy.ops.reeb_parts.decompose(n_parts=3, graph=False)
    bpy.ops.reeb_parts.separate()
    bpy.context.scene.collection.children.unlink(obj.reeb_parts_made.pieces)
    assert watch._is_untidy()
    watch._tidy()
    assert obj.visible_get()
    assert not obj.hide_render

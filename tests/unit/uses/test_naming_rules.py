# SPDX-License-Identifier: GPL-3.0-or-later
"""The rules by which parts get their names, each at its limit: of boxes, of which only is known where they are."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from core.uses.naming.method import Suggestion, suggestions
from core.uses.naming.shapes import Shapes
from core.uses.naming.touching import Touching

# A creature that looks along -y: middle and size of the box of each part, its share of the surface, what it touches.
COW = {
    "body": ((0, 0, 1.0), (0.4, 1.2, 0.5), 0.5, ""),
    "head": ((0, -0.9, 1.4), (0.3, 0.4, 0.3), 0.15, "body"),
    "tail": ((0, 0.85, 1.1), (0.08, 0.5, 0.08), 0.03, "body"),
    **{f"{end} leg {side}": ((0.15 * side, y, 0.375), (0.12, 0.12, 0.75), 0.08, "body")
       for end, y in (("front", -0.5), ("hind", 0.5)) for side in (1, -1)},
}
# One that stands on two legs.
MAN = {
    "body": ((0, 0, 1.25), (0.4, 0.25, 0.7), 0.4, ""),
    "head": ((0, 0, 1.8), (0.2, 0.22, 0.3), 0.1, "body"),
    **{f"arm {side}": ((0.35 * side, 0, 1.3), (0.1, 0.1, 0.6), 0.1, "body") for side in (1, -1)},
    **{f"leg {side}": ((0.12 * side, 0, 0.45), (0.15, 0.15, 0.9), 0.15, "body") for side in (1, -1)},
}


NO_LOOPS = SimpleNamespace(n_loops=0)


def shapes_of(model, pairs=(), ground=(), graph=NO_LOOPS, **of_graph):
    """Shapes of boxes. pairs : names of parts that are mirror images of each other. ground : names of grounds.

    of_graph : which parts the nodes and points of the graph are in.
    """
    names = list(model)
    middle, size, share = (np.array([part[k] for part in model.values()], float) for k in range(3))
    cuts = [(names.index(name), k) for k, (_, _, _, on) in enumerate(model.values()) for name in on.split(", ") if name]
    side, twin = np.zeros(len(names), int), np.full(len(names), -1)
    for pair in pairs:
        one, other = map(names.index, pair)
        side[[one, other]], twin[[one, other]] = (1, -1), (other, one)
    parts = SimpleNamespace(count=len(names), share=share / share.sum(), cuts=np.array(cuts), side=side, twin=twin,
                            decomposition=SimpleNamespace(graph=graph), **of_graph)
    touching = Touching(parts, np.isin(names, ground))
    return Shapes(touching, middle - size / 2, middle + size / 2, middle, -np.sort(-size, axis=1), across=0)


def named(model, pairs=(), **changed):
    """The suggestion for each part of boxes, by its name. changed : parts that are added, or others; None for none."""
    model = {name: part for name, part in (model | changed).items() if part is not None}
    return dict(zip(model, suggestions(shapes_of(model, pairs)), strict=True))


def words(*arguments, **changed):
    """The word for each part of boxes."""
    return {name: found.word for name, found in named(*arguments, **changed).items()}


def test_a_cow_and_a_man_have_all_their_words():
    assert named(COW) == {
        "body": Suggestion("body"), "head": Suggestion("head"), "tail": Suggestion("tail"),
        "front leg 1": Suggestion("leg", "front", 1), "front leg -1": Suggestion("leg", "front", -1),
        "hind leg 1": Suggestion("leg", "back", 1), "hind leg -1": Suggestion("leg", "back", -1)}
    assert named(MAN) == {
        "body": Suggestion("body"), "head": Suggestion("head"), "arm 1": Suggestion("arm", "", 1),
        "arm -1": Suggestion("arm", "", -1), "leg 1": Suggestion("leg", "", 1), "leg -1": Suggestion("leg", "", -1)}


def test_where_a_model_stands_does_not_matter():
    place = np.array([3.0, -2.0, 5.0])
    for model in (COW, MAN):
        assert named({name: (place + middle, *more) for name, (middle, *more) in model.items()}) == named(model)


BLOCK = {"body": ((0, 0, 0), (1, 1, 1), 0.8, "")}


@pytest.mark.parametrize(("axis", "places"), [(0, ("right", "left")), (1, ("front", "back")), (2, ("bottom", "top"))])
def test_a_place_is_told_of_what_is_so_far_from_the_middle_of_the_body(axis, places):
    for sign, place in zip((-1, 1), places, strict=True):
        for distance, found in ((0.13, place), (0.11, "")):
            knob = (sign * distance * np.eye(3)[axis], (0.1, 0.1, 0.1), 0.1, "body")
            assert named(BLOCK, knob=knob)["knob"] == Suggestion("tip", found)


@pytest.mark.parametrize(("length", "more", "word"), [(0.185, {}, "limb"), (0.175, {}, "tip"), (
    0.185, {"end": ((0.4, 0, 0.2), (0.1, 0.1, 0.1), 0.1, "knob")}, "piece")])
def test_what_is_long_is_a_limb_and_what_others_hang_on_a_piece(length, more, word):
    assert words(BLOCK, knob=((0.4, 0, 0), (0.1, 0.1, length), 0.1, "body"), **more)["knob"] == word


def test_of_mirror_images_the_side_is_told_and_no_place_at_that_side():
    knobs = {name: ((x, 0.2, 0), (0.1, 0.1, 0.1), 0.1, "body") for name, x in (("one", 0.4), ("other", -0.4))}
    assert named(BLOCK, [("one", "other")], **knobs) == {
        "body": Suggestion("body"), "one": Suggestion("tip", "back", 1), "other": Suggestion("tip", "back", -1)}


def test_the_front_of_a_creature_is_where_its_head_is():
    for sign in (1, -1):
        cow = {name: ((x, sign * y, z), *part) for name, ((x, y, z), *part) in COW.items()}
        for y, place in ((-0.4, "front"), (0.4, "back")):
            assert named(cow, knob=((0, sign * y, 1), (0.1, 0.1, 0.1), 0.01, "body")) == named(COW) | {
                "knob": Suggestion("tip", place)}
    headless = {name: part for name, part in cow.items() if name != "head"}
    assert named(headless, knob=((0, -0.4, 1), (0.1, 0.1, 0.1), 0.01, "body"))["knob"].place == "front"


def cow(**parts):
    """A cow with some parts changed, or more."""
    return COW | parts


def man(**parts):
    """A man with some parts changed, or more."""
    return MAN | parts


def leg(x=-0.15, y=0.5, size=(0.12, 0.12, 0.75), low=0.0, on="body"):
    """A leg that stands on the ground, or so high above it."""
    return ((x, y, low + size[2] / 2), size, 0.08, on)


def head(y=-0.9, x=0.0, top=1.55, size=(0.2, 0.4, 0.3), share=0.15, on="body"):
    """The head of a cow."""
    return ((x, y, top - size[2] / 2), size, share, on)


def tail(y=0.85, width=0.08, length=0.5, share=0.03, on="body"):
    """The tail of a cow."""
    return ((0, y, 1.1), (width, length, 0.08), share, on)


def ear(x=0.12, top=1.65, share=0.01, on="head"):
    """An ear of a cow."""
    return ((x, -0.9, top - 0.1), (0.05, 0.05, 0.2), share, on)


def arm(x=0.35, z=1.3, length=0.6, on="body"):
    """An arm of a man."""
    return ((x, 0, z), (0.1, 0.1, length), 0.1, on)


def neck(width):
    """The neck of a man."""
    return ((0, 0, 1.63), (width, 0.1, 0.1), 0.02, "body")


# A part of a creature that is just on one side of a limit, what it is called, and the same on the other side.
@pytest.mark.parametrize(("part", "within", "word", "beyond", "other"), [
    # A body is so far above the ground: 0.08 of 1.55.
    ("head", cow(body=((0, 0, 0.69), (0.4, 1.2, 1.12), 0.5, "")), "head",
     cow(body=((0, 0, 0.68), (0.4, 1.2, 1.14), 0.5, "")), "tip"),
    # Feet are less far above it.
    ("hind leg -1", cow(**{"hind leg -1": leg(low=0.12)}), "leg", cow(**{"hind leg -1": leg(low=0.13)}), "limb"),
    # What is on the ground stands there unless it is longer than high, than it is to one side, and than a foot is.
    ("hind leg -1", cow(**{"hind leg -1": leg(size=(0.12, 0.59, 0.3))}), "leg",
     cow(**{"hind leg -1": leg(size=(0.12, 0.61, 0.3))}), "limb"),
    ("hind leg -1", cow(**{"hind leg -1": leg(size=(0.12, 0.74, 0.5))}), "leg",
     cow(**{"hind leg -1": leg(size=(0.12, 0.76, 0.5))}), "tip"),
    ("hind leg -1", cow(**{"hind leg -1": leg(-0.08, size=(0.12, 0.43, 0.1))}), "leg",
     cow(**{"hind leg -1": leg(-0.08, size=(0.12, 0.45, 0.1))}), "limb"),
    # A belly is in the midst.
    ("hind leg -1", cow(**{"hind leg -1": leg(-0.033)}), "leg", cow(**{"hind leg -1": leg(-0.03)}), "limb"),
    # What is on the ground and reaches above the middle of the body is long.
    ("hind leg -1", cow(**{"hind leg -1": leg(-0.8, size=(1.15, 1.15, 2.1))}), "leg",
     cow(**{"hind leg -1": leg(-0.8, size=(1.18, 1.18, 2.1))}), "tip"),
    # A model is upright if it is so many times as high as long, and has its head anywhere in the midst then.
    ("head", man(body=((0, 0, 1.25), (0.4, 1.62, 0.7), 0.4, "")), "head",
     man(body=((0, 0, 1.25), (0.4, 1.63, 0.7), 0.4, "")), "tip"),
    # A head is in the midst, 0.15 of 0.42, ahead, 0.15 of 1.7, high, 0.1 of 1.25 above the middle, and no speck.
    ("head", cow(head=head(x=0.062)), "head", cow(head=head(x=0.064)), "tip"),
    ("head", cow(head=head(-0.26, size=(0.2, 0.2, 0.3))), "head", cow(head=head(-0.25, size=(0.2, 0.2, 0.3))), "tip"),
    ("head", cow(head=head(top=1.13, size=(0.2, 0.4, 0.1))), "head",
     cow(head=head(top=1.12, size=(0.2, 0.4, 0.1))), "limb"),
    ("head", cow(head=head(share=0.0084), tail=tail(share=0.001)), "head",
     cow(head=head(share=0.0082), tail=tail(share=0.001)), "tip"),
    # It weighs twice as much as what is at the other end.
    ("head", cow(tail=tail(share=0.074)), "head", cow(tail=tail(share=0.076)), "tip"),
    # What hangs on a head is a muzzle if it is less than 0.3 as large.
    ("head", cow(muzzle=((0, -1.2, 1.4), (0.2, 0.2, 0.2), 0.044, "head")), "head",
     cow(muzzle=((0, -1.2, 1.4), (0.2, 0.2, 0.2), 0.046, "head")), "neck"),
    # A neck is long, and that of an upright creature less wide than shoulders.
    ("head", cow(head=head(size=(0.2, 0.4, 0.305)), muzzle=((0, -1.2, 1.45), (0.2, 0.2, 0.3), 0.05, "head")), "neck",
     cow(head=head(size=(0.2, 0.4, 0.31)), muzzle=((0, -1.2, 1.45), (0.2, 0.2, 0.3), 0.05, "head")), "piece"),
    ("neck", man(neck=neck(0.235), head=((0, 0, 1.8), (0.2, 0.22, 0.3), 0.1, "neck")), "neck",
     man(neck=neck(0.245), head=((0, 0, 1.8), (0.2, 0.22, 0.3), 0.1, "neck")), "piece"),
    # An ear is small, reaches nearly as high as the head, is beside the middle, and touches the head alone.
    ("ear", cow(ear=ear(share=0.044)), "ear", cow(ear=ear(share=0.046)), "limb"),
    ("ear", cow(ear=ear(top=1.5)), "ear", cow(ear=ear(top=1.48)), "limb"),
    ("ear", cow(ear=ear(0.026)), "ear", cow(ear=ear(0.0245)), "limb"),
    ("ear", cow(ear=ear()), "ear", cow(ear=ear(on="head, body")), "piece"),
    ("ear", cow(ear=ear()), "ear", cow(ear=ear(on="tail")), "limb"),
    # An arm is long, beside the body, above its lower end, and does not touch the head.
    ("arm 1", man(**{"arm 1": arm(length=0.132)}), "arm", man(**{"arm 1": arm(length=0.128)}), "tip"),
    ("arm 1", man(**{"arm 1": arm(0.097), "hand": ((0.35, 0, 0.4), (0.1, 0.1, 0.1), 0.01, "arm -1")}), "arm",
     man(**{"arm 1": arm(0.095), "hand": ((0.35, 0, 0.4), (0.1, 0.1, 0.1), 0.01, "arm -1")}), "limb"),
    ("arm 1", man(**{"arm 1": arm(z=0.91)}), "arm", man(**{"arm 1": arm(z=0.89)}), "limb"),
    ("arm 1", man(**{"arm 1": arm()}), "arm", man(**{"arm 1": arm(on="body, head")}), "piece"),
    # What is between it and the body is one, too, if it is beside the middle.
    ("pad", man(pad=((0.3, 0, 1.5), (0.1, 0.1, 0.1), 0.02, "body"), **{"arm 1": arm(on="body, pad")}), "piece",
     man(pad=((0.3, 0, 1.5), (0.1, 0.1, 0.1), 0.02, "body"), **{"arm 1": arm(on="pad")}), "arm"),
    ("shoulder", man(shoulder=((0.061, 0, 1.5), (0.1, 0.1, 0.1), 0.02, "body"), **{"arm 1": arm(on="shoulder")}), "arm",
     man(shoulder=((0.059, 0, 1.5), (0.1, 0.1, 0.1), 0.02, "body"), **{"arm 1": arm(on="shoulder")}), "piece"),
    # A tail is long, thin and behind, 0.3 of the length, and does not touch the head.
    ("tail", cow(tail=tail(width=0.2, length=0.262)), "tail", cow(tail=tail(width=0.2, length=0.258)), "tip"),
    ("tail", cow(tail=tail(width=0.29)), "tail", cow(tail=tail(width=0.31)), "tip"),
    ("tail", cow(tail=tail(0.6)), "tail", cow(tail=tail(0.56)), "limb"),
    ("tail", cow(tail=tail()), "tail", cow(tail=tail(on="body, head")), "piece"),
    # What legs hang on is no head, unless it reaches 0.1 of the height above the body.
    ("head", cow(head=head(top=1.395), **{f"front leg {side}": leg(0.15 * side, -0.7, on="head") for side in (1, -1)}),
     "head", cow(head=head(top=1.38), **{f"front leg {side}": leg(0.15 * side, -0.7, on="head") for side in (1, -1)}),
     "piece"),
])
def test_just_within_and_just_beyond_a_limit(part, within, word, beyond, other):
    assert (words(within)[part], words(beyond)[part]) == (word, other)


def test_a_creature_stands_on_both_sides():
    one_sided = words(cow(**{"hind leg -1": leg(0.18), "front leg -1": leg(0.18, -0.5)}))
    assert set(one_sided.values()) == {"body", "limb", "tip"}


def test_more_than_four_legs_have_no_head():
    """Legs that hang on each other are one, but for feet that touch the body."""
    five = words(cow(middle=leg(0.15, 0.0)))
    assert set(five.values()) == {"body", "leg", "limb", "tip"}
    assert set(words(cow(middle=leg(0.15, 0.0), shoe=leg(0.15, 0.0, (0.14, 0.2, 0.1), on="middle"))).values()) == {
        "body", "leg", "limb", "tip"}
    shoes = {f"shoe {name}": ((*part[0][:2], 0.05), (0.14, 0.2, 0.1), 0.01, name)
             for name, part in COW.items() if "leg" in name}
    assert set(words(cow(**shoes)).values()) == {"body", "leg", "head", "tail"}
    assert set(words(cow(middle=leg(0.15, 0.0, on="hind leg 1"))).values()) == {"body", "leg", "head", "tail"}
    assert "head" not in words(cow(middle=leg(0.15, 0.0, on="body, hind leg 1"))).values()


def test_of_two_heads_the_higher_one_is_the_head():
    for high, found in ((1.7, "second"), (1.5, "head")):
        heads = words(cow(second=((0, -0.8, high - 0.1), (0.2, 0.4, 0.2), 0.1, "body")))
        assert [name for name, word in heads.items() if word == "head"] == [found]


def test_in_front_or_back_is_told_of_legs_that_are_so_far_from_the_middle():
    """0.12 of 2.2."""
    for y, place in ((-0.27, "front"), (-0.26, ""), (0.26, ""), (0.27, "back")):
        assert named(COW, **{"hind leg -1": leg(y=y)})["hind leg -1"] == Suggestion("leg", place, -1)
    assert {found.place for found in named(COW, head=None, tail=None).values() if found.word == "leg"} == {""}


def test_the_side_is_told_of_a_leg_that_is_so_far_from_the_middle():
    """0.06 of 0.8; of mirror images it is known."""
    for x, side in ((0.05, 1), (0.046, 0), (-0.046, 0), (-0.05, -1)):
        assert named(MAN, third=leg(x, 0.0))["third"] == Suggestion("leg", "", side)
    beside = {"one": leg(-0.01, 0.0), "other": leg(0.01, 0.0)}
    found = named(MAN, [("one", "other")], **beside)
    assert (found["one"].side, found["other"].side) == (1, -1)


def test_of_mirror_images_that_have_two_words_that_counts_which_there_may_be_two_of():
    """One of the two is too short for an arm; and what is called tail is there once, so that neither of two is."""
    found = named(MAN, [("arm 1", "arm -1")], **{"arm -1": arm(-0.35, length=0.12)})
    assert (found["arm 1"], found["arm -1"]) == (Suggestion("arm", "", 1), Suggestion("arm", "", -1))
    found = words(COW, [("tail", "other")], other=((0.0, 0.85, 1.2), (0.08, 0.5, 0.08), 0.03, "body"))
    assert (found["tail"], found["other"]) == ("limb", "limb")


@pytest.mark.parametrize(("inner", "outer", "found"), [(1.66, 1.65, "horn"), (1.65, 1.65, "ear"), (1.64, 1.65, "ear")])
def test_of_two_pairs_of_ears_the_inner_one_are_horns_if_it_is_higher(inner, outer, found):
    pairs = {f"{name} {side}": ear(side * x, top) for name, x, top in (("inner", 0.05, inner), ("outer", 0.12, outer))
             for side in (1, -1)}
    for order in (pairs, dict(reversed(pairs.items()))):
        result = words(COW, [("inner 1", "inner -1"), ("outer 1", "outer -1")], **order)
        assert [result[name] for name in ("inner 1", "inner -1", "outer 1", "outer -1")] == [found, found, "ear", "ear"]


@pytest.mark.parametrize(("part", "ahead"), [
    ((0, 0.95, 0.9), -1),  # lower than the middle of the body
    ((0.07, 0.95, 1.2), -1),  # beside the midst
    ((0, 0.3, 1.2), -1),  # not so far from the body's middle
    ((0.05, 0.4, 1.2), 1),
])
def test_a_head_is_where_most_is_high_far_out_and_in_the_midst(part, ahead):
    assert shapes_of(COW).ahead == -1
    assert shapes_of(COW | {"more": (part, (0.1, 0.1, 0.1), 0.5, "body")}).ahead == ahead


def test_of_two_ways_to_look_the_first_counts_unless_the_other_has_a_head_and_more_words():
    whole, tailless, headless = shapes_of(COW), shapes_of(cow(tail=tail(0.56))), shapes_of(cow(head=head(x=0.064)))
    found = {name: suggestions(replace(one, others=(other,))) for name, one, other in (
        ("more", tailless, whole), ("less", whole, tailless), ("as many", headless, replace(headless, across=0)),
        ("a head", headless, tailless), ("no head", tailless, headless))}
    assert found["more"] == found["less"] == suggestions(whole)
    assert found["a head"] == found["no head"] == suggestions(tailless)
    assert found["as many"] == suggestions(headless)


def test_which_axis_is_across_a_creature_does_not_matter():
    turned = {name: ((y, x, z), (depth, width, height), *more)
              for name, ((x, y, z), (width, depth, height), *more) in COW.items()}
    for knob, back in (((-0.4, 0, 1), "front"), ((0.4, 0, 1), "back")):
        model = turned | {"knob": (knob, (0.1, 0.1, 0.1), 0.01, "body")}
        found = dict(zip(model, suggestions(replace(shapes_of(model), across=1)), strict=True))
        assert found == named(COW) | {"knob": Suggestion("tip", back)}


def test_a_ground_is_no_part_of_a_creature():
    """It touches all legs and is larger than all else."""
    floor = ((3, 0, -0.1), (9, 9, 0.2), 50, ", ".join(name for name in COW if "leg" in name))
    model = cow(floor=floor)
    found = dict(zip(model, suggestions(shapes_of(model, ground=["floor"])), strict=True))
    assert found == named(COW) | {"floor": Suggestion("ground")}
    alone = {"body": COW["body"], "floor": (*floor[:3], "body")}
    assert suggestions(shapes_of(alone, ground=["floor"])) == [Suggestion("body"), Suggestion("ground")]


def handled(nodes, arcs, handle=((0.6, 0, 0), (0.2, 0.1, 0.4), 0.1, "body"), model=BLOCK, **more):
    """Words for a block with a handle, which is part 1. arcs : two nodes each, and the parts of the points."""
    points = [points for _, points in arcs]
    graph = SimpleNamespace(
        n_loops=1, arcs=np.array([ends for ends, _ in arcs]), arc_points=np.cumsum([0, *map(len, points)]),
        point_arc=np.repeat(np.arange(len(arcs)), [len(part) for part in points]))
    names = {"body": model["body"], "handle": handle, **model, **more}
    shapes = shapes_of(names, graph=graph, point_part=np.concatenate(points), node_part=np.array(nodes))
    return dict(zip(names, (found.word for found in suggestions(shapes)), strict=True))


@pytest.mark.parametrize("graph", [
    ((0, 0), [((0, 1), [0, 0, 1, 1, 0])]), ((0, 0), [((0, 1), [1, 1])]),
    ((0, 1, 0), [((0, 1), [0, 1]), ((2, 1), [0, 1])]), ((0, 1, 0), [((0, 1), [0]), ((1, 2), [0])])])
def test_what_the_graph_enters_and_leaves_is_a_handle(graph):
    assert handled(*graph) == {"body": "body", "handle": "handle"}


@pytest.mark.parametrize(("graph", "changed", "word"), [
    (((0, 1), [((0, 1), [0, 1])]), {}, "limb"),  # it ends there
    (((0, 0), [((0, 1), [0, 1, 0, 1, 0])]), {}, "limb"),  # it is there twice
    (((0, 0), [((0, 1), [1, 1])]), {"handle": ((0.6, 0, 0), (0.2, 0.1, 0.4), 0.9, "body")}, "body"),
    (((0, 0), [((0, 1), [1, 1])]), {"end": ((0.8, 0, 0), (0.1, 0.1, 0.1), 0.1, "handle")}, "piece"),
    (((0, 0), [((0, 1), [1, 1])]), {"handle": ((0.6, 0, 0), (0.2, 0.1, 0.242), 0.1, "body")}, "handle"),
    (((0, 0), [((0, 1), [1, 1])]), {"handle": ((0.6, 0, 0), (0.2, 0.1, 0.238), 0.1, "body")}, "tip")])
def test_a_handle_is_smaller_than_the_one_part_that_it_touches_and_longer_than_wide(graph, changed, word):
    assert handled(*graph, **changed)["handle"] == word


def test_what_has_a_handle_is_no_creature():
    found = handled((0, 0), [((0, 1), [1, 1])], ((0.3, 0, 1), (0.2, 0.1, 0.4), 0.1, "body"), COW)
    assert found["handle"] == "handle"
    assert set(found.values()).isdisjoint({"head", "leg", "tail"})

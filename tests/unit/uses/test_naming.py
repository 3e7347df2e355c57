"""Suggested names: the bundled cow in any direction, limbs of a tree, the handle of a mug, and what changes nothing."""

from collections import Counter
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
import shapes
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from core import decompose
from core.mesh.corners import CornerTable
from core.mesh.grounds import are_ground
from core.mesh.polygons import PolygonMesh
from core.uses.naming.method import Suggestion, suggestions
from core.uses.naming.shapes import Shapes
from core.uses.naming.touching import Touching

SPOT = Path(__file__).parents[3] / "models" / "spot.obj"


def named(vertices, faces, result=None, turn=None, **level):
    """Suggestions for the parts of triangles, by label; turn : (3, 3), of the model once it is decomposed."""
    parts = (result or decompose(vertices, faces)).parts(**level)
    turn = np.eye(3) if turn is None else turn
    table = CornerTable.of(vertices @ turn.T, faces)
    corner = table.vertices[faces]
    area = np.linalg.norm(np.cross(corner[:, 1] - corner[:, 0], corner[:, 2] - corner[:, 0]), axis=1) / 2
    return suggestions(Shapes.of(parts, table, area, are_ground(PolygonMesh.of(vertices, faces)), turn))


@pytest.fixture(scope="module")
def cow():
    """Vertices and faces of the bundled model, its third axis up, and its decomposition."""
    vertices, faces = [], []
    for line in SPOT.read_text().splitlines():
        if line.startswith("v "):
            vertices.append([float(word) for word in line.split()[1:4]])
        elif line.startswith("f "):
            ring = [int(word.split("/")[0]) - 1 for word in line.split()[1:]]
            faces += [(ring[0], ring[i], ring[i + 1]) for i in range(1, len(ring) - 1)]
    vertices = np.array(vertices)[:, [0, 2, 1]] * [1.0, -1.0, 1.0]
    return vertices, np.array(faces), decompose(vertices, faces)


def words(names):
    return Counter(name.word for name in names)


def test_a_creature(cow):
    names = named(*cow, n_parts=10)
    found = words(names)
    assert (found["body"], found["head"], found["leg"]) == (1, 1, 4)
    legs = {(name.place, name.side) for name in names if name.word == "leg"}
    assert legs == {(place, side) for place in ("front", "back") for side in (1, -1)}


@pytest.mark.parametrize("width", [5, 50])
def test_a_creature_on_a_floor_has_its_names(cow, width):
    """The floor was the body then, and nothing else had a word."""
    vertices, faces, _ = cow
    square = np.array([(-1, -1), (1, -1), (1, 1), (-1, 1)]) * width / 2
    floor = shapes.Shape(np.column_stack([square, np.full(4, vertices[:, 2].min())]), np.array([(0, 1, 2), (0, 2, 3)]))
    shape = shapes.together(shapes.Shape(vertices, faces), floor)
    twice = np.concatenate([shape.faces, shape.faces[-2:, ::-1]])
    for with_floor in (shape.faces, twice):
        found = decompose(shape.vertices, with_floor)
        names = named(shape.vertices, with_floor, found)
        alone = [name for name in named(*cow) if name.word != "piece"]
        assert Counter(name for name in names if name.word != "piece") == Counter([*alone, Suggestion("ground")])
        assert names[found.parts().labels[-1]] == Suggestion("ground")
        assert Counter(named(shape.vertices, with_floor, found, n_parts=2)) == Counter(
            [Suggestion("ground"), Suggestion("body")])


def test_of_two_pairs_on_a_head_the_inner_higher_one_are_horns(cow):
    """Each ear touches a horn."""
    ears = [(name.word, name.side) for name in named(*cow) if name.word in {"ear", "horn"}]
    assert sorted(ears) == [("ear", -1), ("ear", 1), ("horn", -1), ("horn", 1)]


@pytest.mark.parametrize("turn", [((-1, 0, 0), (0, -1, 0), (0, 0, 1)), ((0, 1, 0), (-1, 0, 0), (0, 0, 1))])
def test_in_which_direction_it_walks_does_not_matter(cow, turn):
    names, turned = named(*cow, n_parts=10), named(*cow, turn=np.array(turn), n_parts=10)
    assert [(name.word, name.place) for name in turned if name.word != "piece"] == [
        (name.word, name.place) for name in names if name.word != "piece"]


def images_have_one_name(vertices, faces, result, turn, n_parts):
    parts = result.parts(n_parts=n_parts)
    names = named(vertices, faces, result, turn, n_parts=n_parts)
    for part in np.flatnonzero(parts.side).tolist():
        name, image = names[part], names[parts.twin[part]]
        assert (name.word, name.place) == (image.word, image.place)
        assert name.side == -image.side == parts.side[part]
        assert name.word not in {"body", "head", "neck", "tail"}
    return bool(parts.side.any())


def test_mirror_images_have_one_name(creature):
    assert sum(images_have_one_name(*creature, np.eye(3), count) for count in range(3, 40)) > 20


def test_mirror_images_have_one_name_in_a_pose():
    """No plane tells which way it looks, but the faces' images are known."""
    vertices, faces = shapes.mirrored_figure()
    vertices = shapes.posed(vertices)
    result = decompose(vertices, faces)
    assert result.plane is None
    for degrees in (0, 40, 90):
        assert sum(images_have_one_name(vertices, faces, result, heading(degrees), n) for n in range(3, 40)) > 20


def heading(degrees):
    """A turn about the third axis, (3, 3)."""
    cos, sin = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
    return np.array([(cos, -sin, 0), (sin, cos, 0), (0, 0, 1)])


CREATURES = {"horse": shapes.horse, "figure": shapes.mirrored_figure}


@pytest.fixture(scope="module", params=["cow", *CREATURES])
def creature(request):
    """Vertices, faces and decomposition of a symmetric creature."""
    if request.param == "cow":
        return request.getfixturevalue("cow")
    vertices, faces = CREATURES[request.param]()
    return vertices, faces, decompose(vertices, faces)


def test_nor_does_it_between_the_axes(creature):
    """All names and sides are the same in all 36 directions; images of each other differ in the side only."""
    names = named(*creature)
    assert "head" in words(names)
    twin = creature[2].parts().twin
    for degrees in range(0, 360, 10):
        assert named(*creature, turn=heading(degrees)) == names, degrees
    for name, image in zip(names, twin.tolist(), strict=True):
        assert image < 0 or names[image] == Suggestion(name.word, name.place, -name.side)


def test_nor_without_a_plane_of_symmetry(creature):
    """The longest axis tells then which way it looks; left and right are those of the world."""
    vertices, faces, _ = creature
    result = decompose(vertices, faces, {"symmetry": False})
    assert not len(result.mirror)
    names = named(vertices, faces, result)
    assert "head" in words(names)
    for degrees in range(0, 360, 10):
        turned = named(vertices, faces, result, heading(degrees))
        assert [(name.word, name.place) for name in turned] == [(name.word, name.place) for name in names], degrees
        legs = [name for name in turned if name.word == "leg"]
        assert sorted(name.side for name in legs) == sorted([1, -1] * (len(legs) // 2)), degrees


@pytest.mark.parametrize("scale", [1e-3, 1e4])
def test_neither_does_its_size(cow, scale):
    vertices, faces, result = cow
    assert named(vertices * scale, faces, result, n_parts=10) == named(*cow, n_parts=10)


def test_upside_down_it_has_no_head(cow):
    found = words(named(*cow, turn=np.diag([1.0, -1.0, -1.0]), n_parts=10))
    assert (found["head"], found["tail"], found["body"]) == (0, 0, 1)


def test_branches_of_a_tree_are_limbs():
    names = named(*shapes.tube_tree())
    assert words(names) == {"body": 1, "limb": 4}
    assert len({name.place for name in names}) == 5  # each points somewhere else


def test_one_part():
    assert named(*shapes.icosphere(), n_parts=1) == [Suggestion("body")]


def test_every_part_of_every_level_has_a_name(cow):
    for count in (2, 7, 40):
        names = named(*cow, n_parts=count)
        assert len(names) == count
        assert words(names)["body"] == 1
        assert all(name.word and name.side in (-1, 0, 1) for name in names)


def test_a_horse_has_a_neck_although_it_is_wider_than_the_head():
    found = words(named(*shapes.horse(0.055), n_parts=10))
    assert found == {"body": 1, "head": 1, "neck": 1, "tail": 1, "leg": 4, "limb": 2}


def test_an_insect_has_six_legs_and_what_is_larger_or_higher_is_not_called_its_head_or_tail():
    names = named(*shapes.insect(), n_parts=9)
    found = words(names)
    assert (found["leg"], found["body"]) == (6, 1)
    assert not found.keys() & {"head", "neck", "tail", "ear", "arm"}
    assert Counter((name.place, name.side) for name in names if name.word == "leg") == {("", 1): 3, ("", -1): 3}


def of_boxes(boxes):
    """Suggestions for a creature of boxes, each a part. boxes : middle and size of each."""
    pieces = [shapes.subdivide(shapes.subdivide(shapes.moved(
        shapes.box(size), np.subtract(middle, np.divide(size, 2))))) for middle, size in boxes]
    model = shapes.together(*pieces)
    hints = np.repeat(np.arange(len(boxes)), [len(piece.faces) for piece in pieces])
    return named(*model, decompose(*model, hints=hints), n_parts=len(boxes))


def test_legs_are_legs_down_to_the_shoes_however_far_the_arms_are_stretched():
    """A man of boxes: trunk, head, and on both sides arm, leg and shoe, which hang on each other."""
    names = of_boxes([((0, 0, 1.3), (0.6, 0.3, 0.8)), ((0, 0, 1.9), (0.3, 0.3, 0.4)),
                      *[((side * x, y, z), size) for x, y, z, size in (
                          (1.2, 0, 1.5, (1.8, 0.15, 0.15)), (0.14, 0, 0.6, (0.2, 0.2, 0.6)),
                          (0.14, -0.1, 0.15, (0.2, 0.4, 0.3))) for side in (1, -1)]])
    assert words(names) == {"body": 1, "head": 1, "arm": 2, "leg": 4}


# A bull that looks along -y: chest with the front legs, rump with the hind legs and the tail, head.
BULL = [((0, 0, 1.5), (0.9, 1.4, 1.0)), ((0, 1.3, 1.55), (0.8, 1.2, 0.8)), ((0, -1.0, 1.9), (0.5, 0.6, 0.6)),
        ((0, 2.0, 1.4), (0.1, 0.2, 1.0)),
        *[((side * 0.3, y, 0.55), (0.25, 0.25, 0.9 + 0.3 * (y > 1))) for y in (-0.55, 1.6) for side in (1, -1)]]


def test_a_rump_is_no_head():
    """It is larger than the head, but hind legs stand under it."""
    names = of_boxes(BULL)
    assert [name.word for name in names] == ["body", "piece", "head", "tail", "leg", "leg", "leg", "leg"]
    assert [name.place for name in names] == ["", "back", "", "", "front", "front", "back", "back"]


def test_a_muzzle_is_no_head():
    """Both ears are on the skull; nothing hangs on the muzzle, which is an eighth as large and lower."""
    ears = [((side * 0.2, -1.0, 2.3), (0.08, 0.08, 0.2)) for side in (1, -1)]
    names = of_boxes([*BULL, ((0, -1.4, 1.9), (0.2, 0.2, 0.2)), *ears])
    assert [name.word for name in names[2:4]] == ["head", "tail"]
    assert [(name.word, name.side) for name in names[8:]] == [("tip", 0), ("ear", 1), ("ear", -1)]


@pytest.mark.parametrize("seed", range(200))
def test_the_body_is_what_leaves_the_smallest_remainders(seed):
    """Any parts that touch in any way: each is taken away, and what hangs together then is added up."""
    rng = np.random.default_rng(seed)
    count = int(rng.integers(1, 20))
    cuts = np.array([pair for pair in rng.integers(0, count, (int(rng.integers(0, 2 * count)), 2)).tolist()
                     if pair[0] != pair[1]], np.int64).reshape(-1, 2)
    share = np.ones(count) if seed % 3 == 0 else rng.random(count)
    parts = SimpleNamespace(count=count, share=share, cuts=cuts)
    remainders = []
    for part in range(count):
        left = cuts[(cuts != part).all(axis=1)]
        graph = coo_array((np.ones(len(left)), left.T), (count, count))
        labels = connected_components(graph, directed=False)[1]
        beside = np.unique(cuts[(cuts == part).any(axis=1)])
        total = np.bincount(labels, share)
        remainders.append(max((total[labels[other]] for other in beside.tolist() if other != part), default=0.0))
    body = Touching(parts, np.zeros(parts.count, bool)).body
    assert remainders[body] == pytest.approx(min(remainders))

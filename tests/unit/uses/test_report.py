# SPDX-License-Identifier: GPL-3.0-or-later
"""The JSON of a decomposition, against its schema and against the arrays it was made from."""

import json
from pathlib import Path

import numpy as np
import pytest
import shapes

from core import ParameterError, Parameters, decompose
from core.result.decomposition import Decomposition
from core.uses.report import SCHEMA_VERSION, bounding_boxes, document, report

SCHEMA = Path(__file__).resolve().parents[3] / "docs" / "reeb_parts.schema.json"


@pytest.fixture(scope="module")
def result():
    return decompose(*shapes.tube_tree(), Parameters(method="berretti"))


@pytest.fixture(scope="module")
def validator():
    jsonschema = pytest.importorskip("jsonschema")
    schema = json.loads(SCHEMA.read_text())
    assert schema["properties"]["schema_version"]["const"] == SCHEMA_VERSION
    return jsonschema.Draft202012Validator(schema)


def test_document_is_valid(result, validator):
    made = document([report(result, name="tree", labels=True)], blender="5.2.0", files={"json": "a.json"},
                    problems=[{"name": "Cube", "problem": "It has no faces."}])
    validator.validate(json.loads(json.dumps(made, allow_nan=False)))


def test_schema_refuses_what_is_not_in_it(result, validator):
    made = document([report(result)])
    made["objects"][0]["parts"][0]["colour"] = "red"
    assert not validator.is_valid(made)


def test_numbers_agree_with_the_arrays(result):
    parts = result.parts()
    made = report(result, parts, labels=True)
    assert [part["faces"] for part in made["parts"]] == np.bincount(parts.labels).tolist()
    assert sum(part["share"] for part in made["parts"]) == pytest.approx(1.0)
    assert sum(part["area"] for part in made["parts"]) == pytest.approx(made["area"])
    assert made["labels"] == parts.labels.tolist()
    beside = {(a, b) for part in made["parts"] for a in [part["index"]] for b in part["neighbours"]}
    assert beside == {tuple(p) for c in made["cuts"] for p in (c["parts"], c["parts"][::-1])}


@pytest.mark.parametrize("pieces", ["together", "separate"])
def test_what_is_far_away_is_no_neighbor(pieces, validator):
    """Balls far apart: each hangs on the nearest larger one, so that all can be one part, but none touches another."""
    ball = shapes.icosphere(2)
    balls = shapes.together(*(shapes.moved(ball, place) for place in ((0, 0, 0), (100, 0, 0), (0, 300, 0))))
    result = decompose(*balls, Parameters(pieces=pieces))
    made = report(result)
    assert (len(made["parts"]), made["cuts"]) == (3, [])
    assert [part["neighbours"] for part in made["parts"]] == [[], [], []]
    assert result.parts(detail=0.0).count == 1
    assert len(result.parts().cuts) == len(result.links) == 2
    again = Decomposition.from_bytes(result.to_bytes())
    assert report(again, again.parts())["cuts"] == []
    validator.validate(document([made]))


def test_pieces_that_touch_without_an_edge_are_neighbors():
    """A beam in a tower and a ball far away from both."""
    tower = shapes.subdivide(shapes.subdivide(shapes.box((1.0, 1.0, 3.0))))
    beam = shapes.moved(shapes.subdivide(shapes.box((3.0, 0.5, 0.5))), (1.0, 0.2, 1.0))
    ball = shapes.moved(shapes.icosphere(2), (50.0, 0.0, 0.0))
    vertices, faces = shapes.together(tower, beam, ball)
    result = decompose(vertices, faces)
    piece = np.repeat([0, 1, 2], [len(shape.faces) for shape in (tower, beam, ball)])
    parts = result.group(piece[np.unique(result.candidates, return_index=True)[1]])
    name = dict(zip(parts.labels.tolist(), piece.tolist(), strict=True))
    made = report(result, parts)
    assert [{name[part] for part in cut["parts"]} for cut in made["cuts"]] == [{0, 1}]
    assert {name[part["index"]]: [name[other] for other in part["neighbours"]] for part in made["parts"]} == {
        0: [1], 1: [0], 2: []}


def test_graph_is_whole(result):
    graph = report(result)["graph"]
    assert len(graph["arcs"]) - len(graph["nodes"]) + graph["components"] == graph["loops"]
    for arc in graph["arcs"]:
        low, high = (graph["nodes"][node]["value"] for node in arc["nodes"])
        assert low <= high
        assert len(arc["points"]) == len(arc["radii"]) == len(arc["values"])
        assert arc["values"] == sorted(arc["values"])


def test_transform_moves_the_graph(result):
    move = np.eye(4)
    move[:3, 3] = (1, 2, 3)
    here, there = report(result)["graph"], report(result, transform=move)["graph"]
    for a, b in zip(here["nodes"], there["nodes"], strict=True):
        assert np.subtract(b["position"], a["position"]) == pytest.approx([1, 2, 3])


@pytest.mark.parametrize(("name", "value"), [
    ("transform", np.eye(3)), ("transform", np.full((4, 4), np.nan)), ("transform", "far"),
    ("colors", [(0, 0, 0)]), ("boxes", np.zeros((1, 2, 3))), ("numbers", [1]), ("names", ["only"])])
def test_what_is_not_one_for_each_part_is_refused(result, name, value):
    """An IndexError, or a report of fewer parts."""
    more = {"names": ["only"]} if name == "numbers" else {"numbers": [1]} if name == "names" else {}
    assert result.parts().count > 1
    with pytest.raises(ParameterError, match="of shape|There are [0-9]+ (numbers|names) for [0-9]+ parts") as caught:
        report(result, **{name: value, **more})
    assert caught.value.name in (name, *more)


@pytest.mark.parametrize("where", [slice(None), (0, 1)])
def test_what_is_no_finite_number_is_named(result, where):
    """The sentence asked for the very shape that it said was given."""
    colors = np.full((result.parts().count, 3), 0.5)
    colors[where] = np.nan
    for given in (colors, np.nan):
        with pytest.raises(ParameterError, match=r"^colors must be finite numbers of shape \(\d+, 3\), not nan\.$"):
            report(result, colors=given)


@pytest.mark.parametrize("number", ["a", 1.5, 0, -1])
def test_numbers_of_parts_are_whole_and_begin_at_1(result, number):
    """A ValueError, a part of number 1, and a report that its schema does not allow."""
    with pytest.raises(ParameterError, match="one for each part") as caught:
        report(result, numbers=[number] * result.parts().count)
    assert caught.value.name == "numbers"


@pytest.mark.parametrize("color", [(255, 0, 0), (-0.1, 0, 0)])
def test_colors_are_from_0_to_1(result, color):
    """Those of images, to 255, gave a report that its schema does not allow."""
    with pytest.raises(ParameterError, match="from 0 to 1") as caught:
        report(result, colors=[color] * result.parts().count)
    assert caught.value.name == "colors"


def test_parts_of_another_result_are_refused(result):
    other = decompose(*shapes.tube_tree(), Parameters(method="lavoue"))
    for parts in (other.parts(), result.parts().labels):
        with pytest.raises(ParameterError, match="of another result"):
            report(result, parts)
    copy = Decomposition.from_bytes(result.to_bytes())
    assert report(result, copy.parts(), labels=True) == report(result, labels=True)


def test_bounding_boxes_by_hand():
    points = np.array([[0, 0, 0], [1, 2, 3], [5, 5, 5]], float)
    boxes = bounding_boxes(np.array([0, 0, 1]), points, 2)
    assert boxes.tolist() == [[[0, 0, 0], [1, 2, 3]], [[5, 5, 5], [5, 5, 5]]]


def test_transform_turns_the_graph(result):
    """A quarter turn about z takes (x, y, z) to (-y, x, z)."""
    turn = np.eye(4)
    turn[:2, :2] = [(0, -1), (1, 0)]
    here, there = report(result)["graph"], report(result, transform=turn)["graph"]
    places = [[place for kind, name in (("nodes", "position"), ("arcs", "points")) for row in graph[kind]
               for place in np.reshape(row[name], (-1, 3))] for graph in (here, there)]
    x, y, z = np.transpose(places[0])
    np.testing.assert_allclose(places[1], np.stack([-y, x, z], axis=1))


def test_what_is_none_of_its_arguments_is_refused(result):
    """An AttributeError or a TypeError."""
    for arguments, sentence in (((5, {}), "decomposition must be a result of decompose, not int."),
                                ((result, {"numbers": 5}), "numbers must be a list, not int."),
                                ((result, {"names": 5}), "names must be a list, not int.")):
        with pytest.raises(ParameterError, match=f"^{sentence}$"):
            report(arguments[0], **arguments[1])

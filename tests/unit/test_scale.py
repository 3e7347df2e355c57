# SPDX-License-Identifier: GPL-3.0-or-later
"""Meshes of any size: the parts do not depend on the unit of length, from 1e-150 to 1e150."""

import json
import warnings

import numpy as np
import pytest
import shapes
from results import same_partition

from core.errors import EmptyMeshError, MeshError
from core.parameters import PRESETS, Parameters
from core.pipeline import decompose
from core.result.numbering import Numbering
from core.uses.report import document, report

SHAPES = {
    "tree": shapes.tube_tree(3, 0.2), "grid": shapes.flat_grid(9, 7), "crumbs": shapes.crumbs(60),
    "pieces": shapes.together(shapes.tube_tree(1, 0.2), shapes.moved(shapes.box(), (0.3, 0.2, 0.4))),
}
POWERS = (-500, 498)


@pytest.fixture(autouse=True)
def no_warnings():
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        yield


def assert_scaled(one, other, exponent):
    """The result of a mesh is to the last bit that of the mesh multiplied by 2**exponent."""
    wanted = one.scaled(exponent)
    for name in ("candidates", "vertex_candidates", "candidate_area", "candidate_pairs", "candidate_pair_length",
                 "field", "node_candidate", "point_candidate", "contacts"):
        np.testing.assert_array_equal(getattr(other, name), getattr(wanted, name), name)
    for name, values in vars(wanted.graph).items():
        np.testing.assert_array_equal(getattr(other.graph, name), values, name)
    np.testing.assert_array_equal(other.hierarchy.merges, wanted.hierarchy.merges)
    np.testing.assert_array_equal(other.hierarchy.salience, wanted.hierarchy.salience)
    assert other.notes == wanted.notes


@pytest.mark.parametrize("preset", PRESETS)
@pytest.mark.parametrize("name", SHAPES)
def test_powers_of_two_change_nothing(name, preset):
    vertices, faces = SHAPES[name]
    vertices = vertices / 2.0 ** np.frexp(np.abs(vertices).max())[1]
    parameters = Parameters.preset(preset)
    one = decompose(vertices, faces, parameters)
    for exponent in POWERS:
        other = decompose(np.ldexp(vertices, exponent), faces, parameters)
        assert_scaled(one, other, exponent)
        assert other.parts().share == pytest.approx(one.parts().share, rel=1e-9)
        assert json.dumps(document([report(other)]), allow_nan=False)
        numbers = [Numbering.of(d, *2 * [np.zeros(d.n_candidates, np.int64)]).parts(0.7, 0) for d in (one, other)]
        np.testing.assert_array_equal(numbers[0].candidate_numbers, numbers[1].candidate_numbers)


@pytest.mark.parametrize("scale", [1e-150, 1e-100, 1e-45, 1e-20, 1e-9, 1e9, 1e13, 1e20, 1e39, 1e100, 1e150])
def test_every_scale_has_the_parts_of_one(scale):
    vertices, faces = SHAPES["tree"]
    one, other = decompose(vertices, faces).parts(), decompose(scale * vertices, faces).parts()
    assert other.count == one.count > 1
    np.testing.assert_allclose(other.share, one.share, atol=0.01)
    assert np.mean(other.labels == one.labels) > 0.99
    assert other.area.sum() / scale**2 == pytest.approx(one.area.sum())


def furniture(name):
    """Vertices and quads of a piece of furniture, or a letter, made of cuboids: no two sides have one length."""
    solid = np.zeros((9, 4, 8), bool)
    if name == "bench":
        solid[:, :3, 3] = solid[[1, 7], :3, :3] = True
    elif name == "chair":
        solid[:4, :, 3] = solid[:4, 3, 4:] = True
        solid[np.ix_([0, 3], [0, 3], range(3))] = True
    elif name == "sofa":
        solid[:8, :, 0] = solid[:8, 3, :4] = solid[[0, 7], :, :3] = True
    elif name == "E":
        solid[0, 0, :7] = True
        solid[:4, 0, [0, 3, 6]] = True
    else:
        solid[2, 0, :6] = solid[:5, 0, 6] = True
    vertices, quads = shapes.blocks(solid)
    return vertices * (0.31, 0.4, 0.37), quads


def single(vertices):
    """Coordinates as Blender and most files keep them."""
    return vertices.astype(np.float32).astype(float)


@pytest.mark.parametrize("name", ["bench", "chair", "sofa", "E", "T"])
def test_in_single_precision_neither_unit_nor_place_change_the_parts(name):
    vertices, quads = furniture(name)
    parts = decompose(single(vertices), quads).parts()
    for other in (1.37 * vertices, 25.4 * vertices, vertices + (3.3, 7.1, -2.9)):
        assert same_partition(decompose(single(other), quads).parts().labels, parts.labels)


def test_a_vertex_of_no_face_can_be_anywhere():
    vertices, faces = shapes.with_unused_vertices(shapes.tube_tree(1, 0.2))
    unused = np.setdiff1d(np.arange(len(vertices)), faces)
    one = decompose(vertices, faces)
    for far in (1e30, 1.7e308):
        vertices[unused] = far, -far, 0
        assert_scaled(one, decompose(vertices, faces), 0)
        small = vertices / 2.0**90
        small[unused] = vertices[unused]
        assert decompose(small, faces).parts().count == one.parts().count


@pytest.mark.parametrize(("scale", "error", "message"), [
    (1e160, MeshError, "too large"), (1e307, MeshError, "too large"), (1e-160, EmptyMeshError, "zero area"),
    (1e-307, EmptyMeshError, "zero area"), (1e-323, EmptyMeshError, "zero area"), (0.0, EmptyMeshError, "zero area")])
def test_what_is_beyond_is_refused_in_a_sentence(scale, error, message):
    vertices, faces = SHAPES["tree"]
    with pytest.raises(error, match=message):
        decompose(scale * vertices, faces)

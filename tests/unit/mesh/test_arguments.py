# SPDX-License-Identifier: GPL-3.0-or-later
"""Arrays and parameters as callers give them: taken where the meaning is plain, else refused in a sentence."""

from collections import OrderedDict
from decimal import Decimal
from fractions import Fraction

import numpy as np
import pytest
import shapes

from core.errors import MeshError, ParameterError
from core.mesh.arguments import hints_of
from core.mesh.polygons import PolygonMesh
from core.parameters import Parameters
from core.pipeline import decompose

VERTICES, FACES = shapes.box()
HUGE = 10**40


def same(vertices, faces, polygon=None):
    """Whether these arrays are the box."""
    mesh = PolygonMesh.of(vertices, faces, polygon)
    wanted = PolygonMesh.of(VERTICES, FACES)
    return (np.array_equal(mesh.triangles.vertices, wanted.triangles.vertices)
            and np.array_equal(mesh.triangles.faces, wanted.triangles.faces)
            and np.array_equal(mesh.polygon, wanted.polygon) and mesh.triangles.faces.dtype == np.int64)


@pytest.mark.parametrize("take", [
    np.ndarray.tolist, lambda a: a.astype(str), lambda a: a.astype(str).tolist(), lambda a: a.astype(object),
    lambda a: a.astype(np.longdouble), lambda a: a.astype(np.float32), lambda a: [tuple(row) for row in a],
    lambda a: np.asfortranarray(a), lambda a: tuple(map(tuple, a.tolist())), lambda a: a.astype("S32"),
    lambda a: np.array([[Fraction(value) for value in row] for row in a.tolist()]),
    lambda a: [[Decimal(value) for value in row] for row in a.tolist()],
])
def test_kinds_of_arrays_whose_meaning_is_plain(take):
    assert same(take(VERTICES), FACES)
    assert same(VERTICES, take(FACES.astype(float)))


@pytest.mark.parametrize("kind", [np.int8, np.uint8, np.uint64, np.int32, np.float16, object, str])
def test_kinds_of_indices(kind):
    assert same(VERTICES, FACES.astype(kind))
    assert same(VERTICES, list(FACES.astype(kind)))
    assert same(VERTICES, FACES, np.arange(12).astype(kind))


def test_polygons_of_different_sizes_in_any_sequence():
    faces = [[0, 1, 2], [0, 2, 3, 1], (1, 2, 3), np.array([0, 3, 1])]
    wanted = PolygonMesh.of(VERTICES, faces)
    for given in (tuple(faces), np.array([*faces, None], object)[:4], [list(map(float, face)) for face in faces],
                  [list(map(np.int32, face)) for face in faces]):
        assert np.array_equal(PolygonMesh.of(VERTICES, given).triangles.faces, wanted.triangles.faces)


@pytest.mark.parametrize("vertices", [
    None, 7, "vertices", {}, {1: 2}, set(), object(), [[0, 0, 0], [1, 1]], [[0, 0, 1j]] * 8, VERTICES + 0j,
    VERTICES > 0,
    [["a", "b", "c"]] * 8, VERTICES.astype("M8[s]"), [[None] * 3] * 8, [[[]]], [[object()] * 3] * 8,
    (x for x in VERTICES),
    [[HUGE**9, 0, 0]] * 8, VERTICES.astype(bytes)[:, :2], np.zeros((8, 3), [("x", float)]), [[True, 0.5, None]] * 8,
], ids=lambda value: type(value).__name__)
def test_vertices_that_are_none(vertices):
    with pytest.raises(MeshError):
        decompose(vertices, FACES)


@pytest.mark.parametrize("faces", [
    None, 7, "faces", b"faces", {}, {1: (0, 1, 2)}, {(0, 1, 2)}, object(), [None] * 12,
    [[0, 1, 2], None, [1, 2, 3], [0, 1, 3]],
    [[0, 1, None]] * 12, [[0, 1, 2j]] * 12, FACES + 0j, FACES > 0, FACES + 0.5, FACES * np.nan, [["a", "b", "c"]] * 12,
    [["0", "1", "2"], ["0", "1"], ["x", "y", "z"], ["1", "2", "3"]], [[0, 1, HUGE]] * 12, [[0, 1, [2]]] * 12,
    ["012"] * 12,
    [[0, 1, 2], "013", [1, 2, 3], [0, 1, 2]], [[[0, 1], [2, 3]], [0, 1, 2], [0, 1, 3], [1, 2, 3]],
    np.zeros((2, 3, 3), int),
    FACES.astype("M8[s]"), (face for face in FACES), [[0, 1, 2**70]] * 12, [[True, False, True]] * 12,
    [[-1, 0, 1]] * 12,
    [[0, 1, float("inf")]] * 12, np.uint64(2**63) + FACES.astype(np.uint64), [[0], [], [1, 2], [0, 1, 2]], 5.0,
], ids=lambda value: type(value).__name__)
def test_faces_that_are_none(faces):
    with pytest.raises(MeshError):
        decompose(VERTICES, faces)


def test_an_index_beyond_all_integers_is_that_of_a_vertex_that_does_not_exist():
    faces = FACES.astype(np.uint64)
    faces[3, 1] = 2**63 + 5
    for given in (faces, list(faces), [*faces, np.array([0, 1, 2, 3], np.uint64)]):
        with pytest.raises(MeshError, match=r"^1 of 1[23] faces names a vertex that does not exist \(first: face 3;"):
            decompose(VERTICES, given)


def test_what_is_masked_is_refused():
    """Under the mask anything may be."""
    vertices, faces = np.ma.array(VERTICES), np.ma.array(FACES)
    assert same(vertices, faces)
    vertices[:2], faces[5] = np.ma.masked, np.ma.masked
    with pytest.raises(MeshError, match="^6 numbers are masked"):
        decompose(vertices, FACES)
    with pytest.raises(MeshError, match="^3 numbers are masked"):
        decompose(VERTICES, faces)
    with pytest.raises(MeshError, match="whole number for each of the 12 faces"):
        decompose(VERTICES, FACES, hints=np.ma.array(np.arange(12), mask=np.arange(12) == 3))


@pytest.mark.parametrize("hints", [
    np.arange(12) > 5, (np.arange(12) > 5).tolist(), np.uint64(2**63) + (np.arange(12) > 5).astype(np.uint64),
    np.uint64(2**64 - 2) + (np.arange(12) > 5).astype(np.uint64)])
def test_hints_may_be_truth_values_and_any_whole_numbers(hints):
    assert hints_of(hints, 12).tolist() == [0] * 6 + [1] * 6


def test_the_faces_that_are_wrong_are_listed():
    with pytest.raises(MeshError, match=r"^2 faces are no rows of whole numbers \(first: face 1\)") as caught:
        decompose(VERTICES, [[0, 1, 2], None, [1, 2, 3, 4], [0, 1.5, 3]])
    assert caught.value.faces.tolist() == [1, 3]


@pytest.mark.parametrize("polygon", [
    7, "polygons", {}, [None] * 12, np.full(12, 2**40), np.full(12, 12), [0.5] * 12, np.arange(12) + 0j, [[0]] * 12,
    [HUGE] * 12, np.full(12, np.nan), [True] * 12, np.arange(12).reshape(3, 4), [[0], 1] * 6,
], ids=lambda value: type(value).__name__)
def test_polygons_that_are_none(polygon):
    with pytest.raises(MeshError, match="12 whole numbers from 0"):
        decompose(VERTICES, FACES, polygon=polygon)


def test_numbers_that_no_triangle_has():
    result = decompose(*shapes.tube_tree(1), polygon=np.arange(0, len(shapes.tube_tree(1).faces)) // 3 * 2)
    assert result.n_faces == result.candidates.size


def test_parameters_as_a_mapping():
    wanted = Parameters.of({"detail": "0.25", "n_slabs": np.float32(50)})
    assert (wanted.detail, wanted.n_slabs) == (0.25, 50)
    assert Parameters.of(OrderedDict(method="berretti")).method == "berretti"
    for wrong in (7, "berretti", {"nonsense": 1}, {1: 2}, ["detail"], {"detail": None}):
        with pytest.raises(ParameterError):
            decompose(VERTICES, FACES, wrong)


@pytest.fixture(scope="module")
def coarse():
    """A box decomposed in few slabs, with parameters given as a mapping."""
    result = decompose(VERTICES, FACES, {"n_slabs": 8, "base_spacing": 0.05})
    assert result.parameters == Parameters(n_slabs=8, base_spacing=0.05)
    return result


@pytest.mark.parametrize("asked", [{"detail": "x"}, {"detail": [0.5]}, {"n_parts": []}, {"n_parts": "x"},
                                   {"n_parts": 1.5},
                                   {"n_parts": np.array([1])}, {"n_parts": -1}, {"n_parts": HUGE}, {"detail": 1j}])
def test_parts_that_cannot_be_asked_for(coarse, asked):
    with pytest.raises(ParameterError):
        coarse.parts(**asked)
    assert coarse.parts(detail=np.float32(0.5), n_parts="1").count == 1

# SPDX-License-Identifier: GPL-3.0-or-later
"""Stored results that were damaged, made by hand, or written by another version."""

import io
import json
import tracemalloc
import zipfile

import numpy as np
import pytest
import shapes

from core.errors import ReebError
from core.parameters import Parameters
from core.pipeline import decompose
from core.result.decomposition import Decomposition
from core.result.stored import DamagedError, NewerError, is_newer

RESULT = decompose(*shapes.tube_tree(1, 0.2))
DATA = RESULT.to_bytes()
COUNTS = RESULT.n_vertices, RESULT.n_faces


def changed(**changes):
    """The bytes of a result with other arrays; None leaves one out, a function gets the array."""
    with np.load(io.BytesIO(DATA)) as stored:
        arrays = dict(stored)
    for name, value in changes.items():
        name = name.replace("__", ".")
        arrays[name] = value(arrays[name].copy()) if callable(value) else value
    stream = io.BytesIO()
    np.savez_compressed(stream, **{name: array for name, array in arrays.items() if array is not None})
    return stream.getvalue()


def with_head(**changes):
    """The bytes of a result with other values in its head."""
    return changed(head=lambda head: np.frombuffer(
        json.dumps(json.loads(head.tobytes()) | changes).encode(), np.uint8))


def put(value, at=0):
    """A function that puts a value into an array."""

    def change(array):
        array.reshape(-1)[at] = value
        return array

    return change


@pytest.mark.parametrize("data", [
    b"", b"x", b"PK\x03\x04", bytes(1000), DATA[:100], DATA[: len(DATA) // 2], DATA[:-1], DATA[1:], b"[]" * 500,
    np.random.default_rng(0).bytes(5000),
], ids=len)
def test_what_is_no_result(data):
    with pytest.raises(DamagedError, match="damaged. Decompose again"):
        Decomposition.from_bytes(data)


def test_bytes_that_changed():
    """Either the damage is noticed, or it changed nothing that a result has."""
    rng = np.random.default_rng(1)
    noticed = 0
    for _ in range(300):
        data = bytearray(DATA)
        for at in rng.integers(0, len(data), rng.integers(1, 4)):
            data[at] = rng.integers(256)
        try:
            again = Decomposition.from_bytes(bytes(data), COUNTS)
        except ReebError:
            noticed += 1
        else:
            np.testing.assert_array_equal(again.candidates, RESULT.candidates)
            assert again.parts().count
    assert noticed > 200


NAMES = sorted(np.load(io.BytesIO(DATA)).files)


UNKNOWN_TO_0_1_0 = ("contacts", "mirror", "face_twin", "face_side", "links", "junctions", "junction_length")


@pytest.mark.parametrize("name", [name for name in NAMES if name not in (*UNKNOWN_TO_0_1_0, "head")])
def test_an_array_that_is_missing_or_of_another_shape_or_kind(name):
    key = name.replace(".", "__")
    for wrong in (None, np.array(["text"]), np.zeros((2, 2, 2)), np.array([object()], object), np.zeros(3, complex),
                  lambda array: np.concatenate([np.atleast_1d(array)] * 2), lambda array: array[None],
                  lambda array: array.astype("M8[s]") if array.dtype.kind == "i" else array.astype(str)):
        with pytest.raises(DamagedError):
            Decomposition.from_bytes(changed(**{key: wrong}), COUNTS)


def test_lengths_of_no_pairs_may_be_whole_numbers():
    """Version 0.1.0 wrote them so where no two candidates touch, as on a ball."""
    ball = decompose(*shapes.icosphere(1), Parameters.preset("Berretti 2009"))
    assert ball.n_candidates == 1
    with np.load(io.BytesIO(ball.to_bytes())) as stored:
        arrays = dict(stored)
    arrays["candidate_pair_length"] = np.empty(0, np.int64)
    stream = io.BytesIO()
    np.savez_compressed(stream, **arrays)
    again = Decomposition.from_bytes(stream.getvalue(), (ball.n_vertices, ball.n_faces))
    assert again.candidate_pair_length.dtype == np.float64
    assert again.parts().labels.tolist() == ball.parts().labels.tolist()


@pytest.mark.parametrize("name", ["mirror", "face_twin", "face_side"])
def test_a_plane_of_symmetry_of_another_shape_or_kind(name):
    mirrored = decompose(*shapes.mirrored_figure()).to_bytes()
    assert len(Decomposition.from_bytes(mirrored).mirror) == 4
    with np.load(io.BytesIO(mirrored)) as stored:
        arrays = {key: stored[key] for key in stored.files}
    for wrong in (np.zeros((2, 2)), np.array(["text"]), np.zeros(3, complex), np.full_like(arrays[name], 2**40, float),
                  np.concatenate([arrays[name]] * 2), arrays[name].astype(str), arrays[name][:2]):
        stream = io.BytesIO()
        np.savez_compressed(stream, **arrays | {name: wrong})
        if name == "mirror" and wrong.dtype == float and wrong.shape == (4,):
            continue  # a plane far away is a plane
        with pytest.raises(DamagedError):
            Decomposition.from_bytes(stream.getvalue())


@pytest.mark.parametrize("wrong", [[[0, RESULT.n_faces]], [[-1, 0]], [0, 1], [[0.0, 1.0]], [["a", "b"]]])
def test_links_that_are_none(wrong):
    assert len(Decomposition.from_bytes(changed(links=np.array([[0, 1]]))).links) == 1
    with pytest.raises(DamagedError):
        Decomposition.from_bytes(changed(links=np.array(wrong)))


@pytest.mark.parametrize("wrong", [
    {"junctions": [[1, 0]]}, {"junctions": [[0, 10**9]]}, {"junctions": [[-1, 0]]}, {"junctions": [0, 1]},
    {"junctions": [[0.5, 0.0]]}, {"junction_length": [np.nan]}, {"junction_length": 1.0}, {"junction_length": [[1.0]]}])
def test_junctions_that_are_none(wrong):
    fitting = {"junctions": [[0, 0]], "junction_length": [1.0]}
    for arrays, fits in ((fitting, True), (fitting | wrong, False)):
        data = changed(**{name: np.array(array) for name, array in arrays.items()})
        if fits:
            assert Decomposition.from_bytes(data).parts().count
        else:
            with pytest.raises(DamagedError):
                Decomposition.from_bytes(data)


@pytest.mark.parametrize(("name", "values"), [
    *((name, (-2, 10**9, 2**62)) for name in (
        "candidates", "vertex_candidates", "candidate_pairs", "node_candidate", "point_candidate", "hierarchy__merges",
        "graph__arcs", "graph__arc_points")),
    *((name, (np.nan, np.inf)) for name in ("candidate_area", "candidate_pair_length", "hierarchy__salience",
                                            "graph__node_value", "graph__node_position", "graph__point_radius")),
    ("candidate_area", (-1.0,)), ("graph__node_kind", (-1, 3)),
])
def test_values_out_of_range(name, values):
    for value in values:
        with pytest.raises(DamagedError):
            Decomposition.from_bytes(changed(**{name: put(value)}))


def test_merges_in_a_circle_and_candidates_without_a_face():
    with pytest.raises(DamagedError):
        Decomposition.from_bytes(changed(hierarchy__merges=lambda merges: merges * 0 + merges[:1]))
    with pytest.raises(DamagedError):
        Decomposition.from_bytes(changed(candidates=lambda candidates: candidates * 0))
    with pytest.raises(DamagedError):
        Decomposition.from_bytes(changed(candidate_area=lambda area: area * 0))


def test_a_result_of_another_mesh():
    assert Decomposition.from_bytes(DATA, COUNTS).n_faces == RESULT.n_faces
    for counts in ((0, 0), (COUNTS[0] + 1, COUNTS[1]), (COUNTS[1], COUNTS[0]), (10**12, 10**12)):
        with pytest.raises(DamagedError):
            Decomposition.from_bytes(DATA, counts)


@pytest.mark.parametrize("name", NAMES)
def test_little_is_read_of_what_is_huge(name):
    """Zeros pack to next to nothing: 100 MB in 440 kB."""
    kind = np.uint8 if name == "head" else np.int64
    shape = (100_000_000 // np.dtype(kind).itemsize,)
    stream = io.BytesIO()
    with (zipfile.ZipFile(io.BytesIO(DATA)) as old,
          zipfile.ZipFile(stream, "w", zipfile.ZIP_DEFLATED, compresslevel=1) as new):
        for info in old.infolist():
            if info.filename != f"{name}.npy":
                new.writestr(info.filename, old.read(info))
        with new.open(f"{name}.npy", "w") as file:
            head = {"descr": np.dtype(kind).str, "fortran_order": False, "shape": shape}
            np.lib.format.write_array_header_1_0(file, head)
            for _ in range(100):
                file.write(bytes(1_000_000))
    tracemalloc.start()
    try:
        with pytest.raises(DamagedError):
            Decomposition.from_bytes(stream.getvalue(), COUNTS)
        assert tracemalloc.get_traced_memory()[1] < 20_000_000
    finally:
        tracemalloc.stop()


@pytest.mark.parametrize("changes", [
    {"parameters": 7}, {"parameters": {"detail": "x"}}, {"parameters": {"nonsense": 1}}, {"notes": 7}, {"notes": [7]},
    {"seconds": []}, {"seconds": {"mesh": "x"}}, {"version": 7}, {"format": "1"}, {"format": True}, {"format": None},
])
def test_a_head_that_makes_no_sense(changes):
    with pytest.raises(DamagedError):
        Decomposition.from_bytes(with_head(**changes))


def test_a_head_that_is_no_json():
    for head in (b"", b"[]", b"{", b"7", b"\xff", b"[" * 100_000):
        with pytest.raises(DamagedError):
            Decomposition.from_bytes(changed(head=np.frombuffer(head, np.uint8)))


def test_a_newer_version_is_said_to_be_newer():
    for changes in ({"format": 2, "version": "0.10.0"}, {"version": "7.0.0", "parameters": {"nonsense": 1}},
                    {"version": "1.0.0", "parameters": {"method": "magic"}}):
        with pytest.raises(NewerError, match=f"Reeb Parts {changes['version']}, which is newer"):
            Decomposition.from_bytes(with_head(**changes))
    assert Decomposition.from_bytes(with_head(version="7.0.0")).version == "7.0.0"
    assert is_newer("0.10.0", "0.9.9")
    assert not is_newer("0.2.0", "0.2.0")
    assert not is_newer("", "0.2.0")

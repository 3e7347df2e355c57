# SPDX-License-Identifier: GPL-3.0-or-later
"""What two processes hand each other arrives as it was sent, bit by bit."""

import json
from dataclasses import fields, is_dataclass

import numpy as np
import pytest
import shapes

from core import Cancelled, EmptyMeshError, MeshError, ParameterError, Parameters, ReebError, decompose, handover
from core.errors import DisconnectedMeshError
from core.sentence import Sentence


def content(value):
    """Everything in a result, arrays with their types."""
    if is_dataclass(value):
        return {field.name: content(getattr(value, field.name)) for field in fields(value)}
    if isinstance(value, np.ndarray):
        return value.dtype.str, value.shape, value.tobytes()
    return value


@pytest.mark.parametrize("shape", [
    shapes.tube_tree(step=0.13), shapes.two_spheres(), shapes.with_fin(shapes.icosphere(2)), shapes.mirrored_figure(),
    shapes.with_unused_vertices(shapes.icosphere(2)), shapes.genus_two(),
], ids=["tree", "pieces", "fin", "symmetric", "unused", "genus two"])
def test_results(shape, tmp_path):
    made = decompose(shape.vertices, shape.faces, Parameters(detail=0.7))
    handover.write_result(tmp_path, 3, made)
    read = handover.read_result(tmp_path, 3)
    assert content(read) == content(made)
    assert [(note.message, note.values) for note in read.notes] == [(note.message, note.values) for note in made.notes]
    assert read.to_bytes() == made.to_bytes()


def test_requests(tmp_path):
    tree, torus = shapes.tube_tree(step=0.13), shapes.torus()
    given = [(s.vertices, s.faces.astype(np.int32), np.arange(len(s.faces), dtype=np.int32), mirror, hints)
             for s, mirror, hints in ((tree, np.empty(0), np.empty(0, np.int64)),
                                     (torus, np.array([1.0, 0, 0, 0.5]), np.arange(len(torus.faces))))]
    parameters = Parameters.preset("Berretti 2009", n_parts=3, base_spacing=1 / 300)
    handover.write_request(tmp_path, given, parameters)
    assert handover.read_request(tmp_path) == (2, parameters)
    for number, arrays in enumerate(given):
        assert [content(a) for a in handover.read_shape(tmp_path, number)] == [content(a) for a in arrays]


@pytest.mark.parametrize("error", [
    EmptyMeshError(Sentence("The mesh has only {n} faces.", n=np.int64(3))),
    MeshError(Sentence("Vertices must have shape (n, 3), not {shape}.", shape=(4, 2)), [1, 2]),
    DisconnectedMeshError(Sentence("{share:.0%} of {name}", share=np.float64(1 / 3), name="ä {n}")),
    ParameterError(Sentence("{name} must be {low} to {high}", name="x", low=0.1, high=2), "x"),
    ReebError("plain words with {braces}"), Cancelled(),
], ids=lambda error: type(error).__name__)
def test_errors(error):
    read = handover.error_of(json.loads(json.dumps(handover.plain_error(error))))
    assert type(read) is type(error)
    assert str(read) == str(error)
    for name in ("vertices", "faces", "name"):
        assert content(getattr(read, name, None)) == content(getattr(error, name, None))
    assert getattr(read.args[0], "message", None) == getattr(error.args[0], "message", None)


def test_an_error_of_another_module():
    class OtherError(ReebError):
        pass

    assert type(handover.error_of(handover.plain_error(OtherError(Sentence("no"))))) is ReebError


def test_nothing_that_could_run_code_is_read(tmp_path):
    np.savez(tmp_path / "shape_0.npz", vertices=np.array([{}], object), triangles=np.zeros(3), polygon=np.zeros(3))
    with pytest.raises(ValueError, match="pickle"):
        handover.read_shape(tmp_path, 0)


@pytest.mark.parametrize("share", [0.0, 0.3, 0.999])
def test_a_part_of_a_result_is_none(share, tmp_path):
    made = decompose(*shapes.icosphere(2))
    handover.write_result(tmp_path, 0, made)
    path = tmp_path / "result_0.npz"
    path.write_bytes(path.read_bytes()[: int(share * path.stat().st_size)])
    with pytest.raises(OSError, match="damaged"):
        handover.read_result(tmp_path, 0)

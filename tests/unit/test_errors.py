# SPDX-License-Identifier: GPL-3.0-or-later
"""Errors carry the indices of what is wrong."""

import copy
import pickle

import numpy as np
import pytest

from core.errors import (
    Cancelled,
    DisconnectedMeshError,
    EmptyMeshError,
    MeshError,
    ParameterError,
    ReebError,
    UnknownParameterError,
)
from core.result.stored import DamagedError, NewerError
from core.sentence import Sentence


@pytest.mark.parametrize("kind", [MeshError, EmptyMeshError, DisconnectedMeshError])
def test_mesh_errors_are_reeb_errors_and_value_errors(kind):
    error = kind("What is wrong.", vertices=[3, 5], faces=(1,))
    assert isinstance(error, ReebError)
    assert isinstance(error, ValueError)
    assert str(error) == "What is wrong."
    assert error.vertices.dtype == error.faces.dtype == np.int64
    assert error.vertices.tolist() == [3, 5]
    assert error.faces.tolist() == [1]


def test_parameter_error_names_the_parameter():
    error = ParameterError("sigma must be smaller.", "sigma")
    assert isinstance(error, ReebError)
    assert isinstance(error, ValueError)
    assert error.name == "sigma"


def test_cancelled_is_a_reeb_error_with_a_sentence():
    assert isinstance(Cancelled(), ReebError)
    assert not isinstance(Cancelled(), ValueError)
    assert str(Cancelled()) == "Cancelled."


@pytest.mark.parametrize("kind", [
    ReebError, Cancelled, ParameterError, UnknownParameterError, MeshError, EmptyMeshError, DisconnectedMeshError,
    DamagedError, NewerError])
@pytest.mark.parametrize("again", [copy.deepcopy, lambda error: pickle.loads(pickle.dumps(error))])
def test_every_error_gets_from_one_process_to_another(kind, again):
    """A pool of processes waits for ever for an error that it cannot unpickle."""
    error = again(kind(Sentence("{n} wrong.", n=2)))
    assert type(error) is kind
    assert str(error) == "2 wrong."
    assert error.args[0].values == {"n": 2}

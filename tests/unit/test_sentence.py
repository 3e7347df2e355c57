# SPDX-License-Identifier: GPL-3.0-or-later
"""Sentences are plain English to everybody but those who translate them."""

import copy
import json
import pickle

import numpy as np
import pytest

from core import MeshError, decompose
from core.sentence import Count, Sentence

THREE = Sentence("{n} edges of {name!r} are loose.", n=3, name="a {brace}")
TEXT = "3 edges of 'a {brace}' are loose."


def test_it_is_its_text():
    assert THREE == TEXT
    assert hash(THREE) == hash(TEXT)
    assert json.dumps([THREE]) == json.dumps([TEXT])
    assert str(ValueError(THREE)) == TEXT


def test_it_can_be_said_in_other_words():
    german = "Bei {name!r} sind {n} Kanten lose."
    assert german.format(**THREE.values) == "Bei 'a {brace}' sind 3 Kanten lose."
    assert THREE.message == "{n} edges of {name!r} are loose."


@pytest.mark.parametrize("protocol", range(pickle.HIGHEST_PROTOCOL + 1))
def test_it_survives_pickling(protocol):
    again = pickle.loads(pickle.dumps(THREE, protocol))
    assert (again, again.message, again.values) == (TEXT, THREE.message, THREE.values)


def test_it_survives_copying():
    again = copy.deepcopy(THREE)
    assert (again, again.message, again.values) == (TEXT, THREE.message, THREE.values)


def test_errors_carry_their_message_and_its_values():
    with pytest.raises(MeshError) as error:
        decompose([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]])
    (sentence,) = error.value.args
    assert sentence.values == {"n": 1, "least": 4}
    assert str(error.value) == sentence.message.format(n=1, least=4)


def test_notes_carry_their_message_and_its_values():
    corners = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0.5, 0.5, 1]]
    result = decompose(corners, [[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]])
    (note,) = (note for note in result.notes if "border edges" in note)
    assert note == "4 border edges: the surface is open there."
    assert note.values == {"n": 4}
    # What is written to a file is plain text.
    again = type(result).from_bytes(result.to_bytes())
    assert again.notes == result.notes


def test_words_that_a_number_chooses():
    message = "{n} {n:part is|parts are} named in {total} {total:file|files}"
    assert Sentence(message, n=1, total=np.int64(2)) == "1 part is named in 2 files"
    assert Sentence(message, n=0, total=1) == "0 parts are named in 1 file"
    assert message.format(n=Count(3), total=Count(1)) == "3 parts are named in 1 file"
    assert f"{Count(1234):,}" == "1,234"
    assert Sentence("{flag} {ratio:.1f}", flag=True, ratio=0.25).values == {"flag": True, "ratio": 0.25}

# SPDX-License-Identifier: GPL-3.0-or-later
"""Whether Blender can read the nodes of an .fbx without all memory, on files of a few nodes."""

import struct

import pytest

from core.fbx_nodes import is_believable

TEXT, NUMBER = b"S" + struct.pack("<I", 2) + b"ab", b"I" + struct.pack("<i", 7)
ARRAY = b"d" + struct.pack("<3I", 1, 0, 8) + bytes(8)


def node(place, size, properties=(), inside=(), count=None):
    """The bytes of a node that begins at some place, with numbers of so many bytes; inside: functions of a place."""
    head = struct.Struct("<3IB" if size == 4 else "<3QB")
    own = b"".join(properties)
    begin, children = place + head.size + 1 + len(own), b""
    for child in inside:
        children += child(begin + len(children))
    if inside:
        children += bytes(head.size)  # the end of the list
    count = len(properties) if count is None else count
    return head.pack(begin + len(children), count, len(own), 1) + b"N" + own + children


def fbx(size, count=None, number=NUMBER):
    """The bytes of a file: a node with a text and two nodes in it, then a node alone."""
    data = b"Kaydara FBX Binary  \0\x1a\0" + struct.pack("<I", 7400 if size == 4 else 7500)
    data += node(len(data), size, [TEXT], [lambda place: node(place, size, [ARRAY, number]),
                                           lambda place: node(place, size, [NUMBER], count=count)])
    data += node(len(data), size)
    return data + bytes(3 * size + 1) + b"whatever comes in the end"


@pytest.mark.parametrize("size", [4, 8])
@pytest.mark.parametrize(("count", "number", "believable"), [
    (None, NUMBER, True), (2**31, NUMBER, False), (3, NUMBER, False), (None, b"!" + NUMBER[1:], False),
    (None, b"S" + struct.pack("<I", 2**32 - 1), False),
])
def test_nodes_have_as_many_properties_as_they_say(tmp_path, size, count, number, believable):
    """A file of 36 kB with a few bytes too many took 16 GB of memory and most of a minute in Blender."""
    path = tmp_path / "model.fbx"
    path.write_bytes(fbx(size, count, number))
    assert is_believable(path) == believable


@pytest.mark.parametrize("size", [4, 8])
def test_a_file_that_was_cut_short_anywhere_is_not_believed(tmp_path, size):
    whole, path = fbx(size), tmp_path / "model.fbx"
    end = whole.index(b"whatever")
    for length in range(27, end, 7):
        path.write_bytes(whole[:length])
        assert not is_believable(path)
    path.write_bytes(whole[:end])
    assert is_believable(path)


def test_what_is_no_binary_fbx_is_for_the_importer_to_refuse(tmp_path):
    path = tmp_path / "model.fbx"
    for data in (b"", b"; FBX 7.4.0 project file", b"Kaydara"):
        path.write_bytes(data)
        assert is_believable(path)

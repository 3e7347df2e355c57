# SPDX-License-Identifier: GPL-3.0-or-later
"""What an .stl may have: several solids with any names, ends of lines of any kind, more than it says, or less."""

import re

import numpy as np
import pytest
import reeb_parts

CORNERS = [[[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 0, 0], [0, 0, 2.5], [1, 0, 0]],
           [[-1, 0, 0], [0, 1e-3, 0], [0, 0, 1]], [[0, 0, 0], [0, 0, 0], [0, 0, 1]]]


def solid(faces, name="model"):
    """A solid of words."""
    lines = ["facet normal 0 0 1\n  outer loop\n" + "".join(f"    vertex {x} {y} {z}\n" for x, y, z in corners)
             + "  endloop\nendfacet\n" for corners in faces]
    return f"solid {name}\n{''.join(lines)}endsolid {name}\n"


def binary(faces, head=b"solid of numbers"):
    """A file of numbers."""
    data = np.zeros(len(faces), [("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("color", "<u2")])
    data["corners"] = faces
    return head.ljust(80) + np.uint32(len(faces)).tobytes() + data.tobytes()


def counted(data, n_faces):
    """A file of numbers whose head counts so many faces."""
    return data[:80] + np.uint32(n_faces).tobytes() + data[84:]


WORDS = solid(CORNERS)
FILES = {
    "plain": WORDS.encode(),
    "two solids": (solid(CORNERS[:1]) + solid(CORNERS[1:])).encode(),
    "two solids without names": (solid(CORNERS[:2], "") + solid(CORNERS[2:], "")).encode(),
    "words in names": (solid(CORNERS[:2], "vertex 1 2 3") + solid(CORNERS[2:], "endfacet normal solid")).encode(),
    "a face as a name": solid(CORNERS, "facet normal").encode(),
    "faces as names": (solid(CORNERS[:2], "facet normal") + solid(CORNERS[2:], "a facet normal 1 2 3 of it")).encode(),
    "capitals": WORDS.upper().encode(),
    "tabs": WORDS.replace(" ", "\t").encode(),
    "windows": WORDS.replace("\n", "\r\n").encode(),
    "old mac": WORDS.replace("\n", "\r").encode(),
    "one line": " ".join(WORDS.split()).encode(),
    "PowerShell": WORDS.encode("utf-16"),
    "a byte order mark": b"\xef\xbb\xbf" + WORDS.encode(),
    "no last line": WORDS.rpartition("endsolid")[0].encode(),
    "numbers": binary(CORNERS),
    "numbers and more": binary(CORNERS) + b"more",
    "numbers and zeros": binary(CORNERS) + bytes(100),
    "words in the head": binary(CORNERS, b"facet normal"),
}


@pytest.mark.parametrize("name", FILES)
def test_faces_are_read_however_they_are_written(name, tmp_path):
    """Of words, trimesh found none without the last line, and was at a loss with names such as "vertex paint"."""
    (tmp_path / "model.stl").write_bytes(FILES[name])
    model = reeb_parts.read_model(tmp_path / "model.stl")
    assert np.allclose(model.vertices[model.faces], CORNERS, rtol=1e-6, atol=0)
    assert model.polygon.tolist() == [0, 1, 2, 3]
    assert model.up == "z"


def test_what_is_no_number_is_said_and_moves_no_label(tmp_path):
    """Of several solids, faces that have it were left out without a word: labels of all behind them were for others."""
    damaged = re.sub("vertex 0 0 2.5", "vertex 0 nan 2.5", solid(CORNERS[:2]) + solid(CORNERS[2:]))
    (tmp_path / "model.stl").write_text(damaged)
    model = reeb_parts.read_model(tmp_path / "model.stl")
    assert len(model.faces) == len(CORNERS)
    with pytest.raises(reeb_parts.MeshError, match="not a finite number"):
        reeb_parts.decompose(model)


@pytest.mark.parametrize(("data", "words"), [
    (WORDS[:-60].encode(), "ends before its last face"),
    (WORDS[:WORDS.rindex("vertex") + 9].encode(), "ends before its last face"),
    (binary(CORNERS)[:-1], "ends before its last face"),
    (counted(binary(CORNERS), 3), "its head counts 3 faces, and as many bytes as 1 more have follow"),
    (counted(binary(CORNERS), 0), "its head counts 0 faces, and as many bytes as 4 more have follow"),
    (counted(binary(CORNERS), 5), "ends before its last face"),
    (WORDS.replace("    vertex 1 0 0\n", "", 1).encode(), "a face has other than three corners"),
    (WORDS.replace("0.001", "x").encode(), "could not be read: x is no coordinate$"),
    (b"", "There is no mesh"), (b"nothing of it", "There is no mesh"),
    (binary(np.empty((0, 3, 3))), "There is no mesh"),
], ids=["cut off", "cut off in a face", "numbers cut off", "one face too few is counted", "none is counted",
         "one too many is counted", "two corners", "a word", "empty", "text", "no face"])
def test_what_cannot_be_read_is_said(data, words, tmp_path):
    (tmp_path / "model.stl").write_bytes(data)
    with pytest.raises(reeb_parts.ModelFileError, match=words):
        reeb_parts.read_model(tmp_path / "model.stl")

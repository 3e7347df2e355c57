# SPDX-License-Identifier: GPL-3.0-or-later
"""What an .off may have: faces of several sizes, colors, comments, and heads of several kinds."""

import pytest
import reeb_parts

PLACES = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0.5, 0.5, 1]]
FACES = [[3, 2, 1, 0], [0, 1, 4], [1, 2, 4], [4, 2, 3], [0, 4, 3]]
VERTEX_LINES = "".join(f"{x} {y} {z}\n" for x, y, z in PLACES)
FACE_LINES = "".join(f"{len(face)} {' '.join(map(str, face))}\n" for face in FACES)
FILES = {
    "plain": "OFF\n5 5 8\n" + VERTEX_LINES + FACE_LINES,
    "on the first line": "OFF 5 5 8\n" + VERTEX_LINES + FACE_LINES,
    "without a space": "OFF5 5 8\n" + VERTEX_LINES + FACE_LINES,
    "no word": "5 5 8\n" + VERTEX_LINES + FACE_LINES,
    "no edges": "OFF\n5 5\n" + VERTEX_LINES + FACE_LINES,
    "counts on lines of their own": "OFF\n5\n5\n" + VERTEX_LINES + FACE_LINES,
    "small letters": "off\n5 5 8\n" + VERTEX_LINES + FACE_LINES,
    "a comment first": "# of a house\n\n# OFF\nOFF\n5 5 8\n" + VERTEX_LINES + FACE_LINES,
    "colors of faces": "OFF\n5 5 0\n" + VERTEX_LINES + FACE_LINES.replace("\n", " 255 0 9\n", 3),
    "small colors of faces": "OFF\n5 5 0\n" + VERTEX_LINES + FACE_LINES.replace("\n", " 0.5 .5 1e-1 1\n"),
    "colors": "COFF\n5 5 0\n" + VERTEX_LINES.replace("\n", " 9 9 9 255\n") + FACE_LINES,
    "normals": "NOFF\n5 5 0\n" + VERTEX_LINES.replace("\n", " 0 0 1\n") + FACE_LINES,
    "all of it": "STCNOFF\n5 5 0\n" + VERTEX_LINES.replace("\n", " 0 0 1 1 1 1 1 0 0\n") + FACE_LINES,
    "comments": "OFF # of a house\n# OFF\n5 5 0 # counts\n\n" + (VERTEX_LINES + FACE_LINES).replace("\n", " # it\n \n"),
    "windows": "\ufeff" + ("OFF\n5 5 0\n" + VERTEX_LINES + FACE_LINES).replace("\n", "\r\n"),
    "old mac": ("OFF\n5 5 0\n" + VERTEX_LINES + FACE_LINES).replace("\n", "\r"),
    "edges and points": "OFF\n5 8 0\n" + VERTEX_LINES + "2 0 1\n1 3\n" + FACE_LINES + "0\n",
    "more behind": "OFF\n5 5 0\n" + VERTEX_LINES + FACE_LINES + "3 0 0 0\n",
}


@pytest.mark.parametrize("name", FILES)
def test_a_pyramid_is_read_however_it_is_written(name, tmp_path):
    """trimesh put its base, the first face, behind all others, and read no comments behind numbers."""
    (tmp_path / "model.off").write_text(FILES[name], encoding="utf-8", newline="")
    model = reeb_parts.read_model(tmp_path / "model.off")
    assert model.vertices.tolist() == PLACES
    assert model.polygon.tolist() == [0, 0, 1, 2, 3, 4]
    assert model.faces.tolist() == [[3, 2, 1], [3, 1, 0], *FACES[1:]]


def test_a_pentagon_is_a_face(tmp_path):
    (tmp_path / "model.off").write_text("OFF\n5 1 0\n0 0 0\n4 0 0\n4 4 0\n2 1 0\n0 4 0\n5 0 1 2 3 4\n")
    model = reeb_parts.read_model(tmp_path / "model.off")
    assert model.polygon.tolist() == [0, 0, 0]


@pytest.mark.parametrize(("text", "words"), [
    ("OFF BINARY\n5 5 0\n", "words"), ("4OFF\n1 0 0\n0 0 0 1\n", "three dimensions"), ("solid\n", "words"),
    ("OFF\n5 5 0\n" + VERTEX_LINES + FACE_LINES[:-9], "ends before"), ("OFF\n-1 1 0\n3 0 0 0\n", "ends before"),
    ("OFF\n5 5 0\n" + VERTEX_LINES + FACE_LINES.replace("3 1 2 4", "3 1 2"), "fewer corners"),
    ("OFF\n5 1 0\n" + VERTEX_LINES + "-3 0 1 2\n", "fewer corners"), ("OFF\n", "does not say how many"),
    ("OFF\n5 5 0\n" + VERTEX_LINES + FACE_LINES.replace("4 2 3", "5 2 3"), "not there")])
def test_a_damaged_file_is_one_sentence(text, words, tmp_path):
    (tmp_path / "model.off").write_text(text)
    with pytest.raises(reeb_parts.ModelFileError, match=words):
        reeb_parts.read_model(tmp_path / "model.off")

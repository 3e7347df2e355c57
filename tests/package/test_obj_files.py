# SPDX-License-Identifier: GPL-3.0-or-later
"""What an .obj may have: indices from behind, comments, ends of lines, and lines that are of no use here."""

import numpy as np
import pytest
import reeb_parts
import shapes

SQUARE = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n"
MORE = "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nvn 0 0 1\n"
FILES = {
    "relative": SQUARE + "f -4 -3 -2 -1\n",
    "relative texture": SQUARE + MORE + "f -4/-4 -3/-3 -2/-2 -1/-1\n",
    "relative normal": SQUARE + MORE + "f -4//-1 -3//-1 -2//-1 -1//-1\n",
    "relative both": SQUARE + MORE + "f -4/-4/-1 -3/-3/-1 -2/-2/-1 -1/-1/-1\n",
    "mixed signs": SQUARE + "f 1 -3 3 -1\n",
    "empty fields": SQUARE + "f 1// 2// 3// 4//\n",
    "faces first": "f 1 2 3 4\n" + SQUARE,
    "comments": "# v 9 9 9\n" + SQUARE.replace("\n", " # a corner\n") + "f 1 2 3 4 # all of them\n#f 1 2 3\n",
    "folder in a comment": "# C:\\models\\\n" + SQUARE + "f 1 2 3 4\n",
    "indented": SQUARE.replace("v", "  v") + "\tf 1 2 3 4\n",
    "tabs": SQUARE.replace(" ", "\t") + "f\t1\t2\t3\t4\n",
    "spaces": SQUARE.replace(" ", "   ").replace("\n", "  \n") + "f  1  2  3  4  \n",
    "windows": (SQUARE + "f 1 2 3 4\n").replace("\n", "\r\n"),
    "old mac": (SQUARE + "f 1 2 3 4\n").replace("\n", "\r"),
    "no last end": SQUARE + "f 1 2 3 4",
    "continued": SQUARE.replace("v 1 1", "v 1\\\n1") + "f 1 2 \\\n3 4\n",
    "continued in windows": (SQUARE + "f 1 2\\\n 3 4\n").replace("\n", "\r\n"),
    "continued at the end": SQUARE + "f 1 2 3 4 \\",
    "mark": "\ufeff" + SQUARE + "f 1 2 3 4\n",
    "lines and points": SQUARE + "p 1\nl 1 2 3\nf 1 2 3 4\nf 1 2\nf\n",
    "free forms": "cstype bezier\nvp 0 1\n" + SQUARE + "surf 0 1 0 1 1 2 3 4\nend\nf 1 2 3 4\n",
    "exponents": "v 0e0 0E-3 .0\nv +1.0e+00 0 0.\nv 10.E-1 1 0\nv 0 0.1e1 0\nf 1 2 3 4\n",
    "weights": SQUARE.replace("\n", " 1.0\n") + "f 1 2 3 4\n",
    "colors": SQUARE.replace("\n", " 0.5 0.25 1\n") + "f 1 2 3 4\n",
    "one color": SQUARE.replace("\n", " 0.5 0.25 1\n", 1) + "f 1 2 3 4\n",
    "names": "mtllib v.mtl\no f 1 2 3\n" + SQUARE + "g f\nusemtl f 1\ns off\nf 1 2 3 4\n",
}


def read(path, text):
    path.write_bytes(text.encode())
    return reeb_parts.read_model(path)


@pytest.mark.parametrize("name", FILES)
def test_a_square_is_read_however_it_is_written(name, tmp_path):
    model = read(tmp_path / "model.obj", FILES[name])
    assert model.vertices.tolist() == [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]]
    assert model.faces.tolist() == [[0, 1, 2], [0, 2, 3]]
    assert model.polygon.tolist() == [0, 0]


@pytest.mark.parametrize("corner", ["{0}", "{0}/{1}", "{0}//{1}", "{0}/{1}/{1}"])
def test_relative_indices_count_from_their_face(corner, tmp_path):
    """The vertices of a second object follow the faces of the first: -1 was its last vertex for both."""
    shape = shapes.octahedron()
    lines = []
    for place in (0.0, 5.0):
        lines += [f"v {x + place} {y} {z}" for x, y, z in shape.vertices]
        lines += ["vt 0 0", "vn 0 0 1"]
        lines += ["f " + " ".join(corner.format(index - len(shape.vertices), -1) for index in face)
                  for face in shape.faces.tolist()]
    model = read(tmp_path / "two.obj", "\n".join(lines))
    assert (model.faces == np.concatenate([shape.faces, shape.faces + len(shape.vertices)])).all()
    assert (model.polygon == np.arange(len(model.faces))).all()


def test_polygons_of_all_sizes_are_fans_where_they_are_convex(tmp_path):
    angle = np.linspace(0.0, 2 * np.pi, 6, endpoint=False)
    lines = [f"v {np.cos(a)} {np.sin(a)} 0" for a in angle] + ["f 1 2 3 4 5 6", "f 1 2 3", "f -6 -5 -4 -3 -2"]
    model = read(tmp_path / "fans.obj", "\n".join(lines))
    assert model.faces.tolist() == [[0, 1, 2], [0, 2, 3], [0, 3, 4], [0, 4, 5], [0, 1, 2],
                                    [0, 1, 2], [0, 2, 3], [0, 3, 4]]
    assert model.polygon.tolist() == [0, 0, 0, 0, 1, 2, 2, 2]


@pytest.mark.parametrize("line", ["f 1 2 5", "f 0 1 2", "f -5 -4 -3", "f 1 2 x", "f 1.5 2 3", "v 1 2", "v 1 2 y"])
def test_what_no_file_may_have_is_an_error(line, tmp_path):
    with pytest.raises(reeb_parts.ModelFileError, match="could not be read"):
        read(tmp_path / "damaged.obj", SQUARE + line + "\nf 1 2 3\n")


@pytest.mark.parametrize(("name", "text"), [
    ("flat.obj", "v 0 0\nv 1 0\nv 1 1\nf 1 2 3\n"), ("flat.off", "OFF\n3 1 0\n0 0\n1 0\n1 1\n3 0 1 2\n")])
def test_places_in_a_plane_are_no_vertices(name, text, tmp_path):
    """If none had three coordinates, the model was read, with vertices of shape (n, 2)."""
    with pytest.raises(reeb_parts.ModelFileError, match="a vertex has fewer than three coordinates"):
        read(tmp_path / name, text)

# SPDX-License-Identifier: GPL-3.0-or-later
"""Faces of .ply files with any numbers of corners, in words and in both byte orders."""

import struct

import numpy as np
import pytest
import reeb_parts
from reeb_parts import ply_files

#: A house: a cube with a roof, and a front with a notch, so that no fan of its first corner is right.
VERTICES = np.array([(x, y, z) for z in (0, 1) for x, y in ((0, 0), (4, 0), (4, 4), (2, 1), (0, 4))], float)
FACES = [[0, 4, 3, 2, 1], [5, 6, 7, 8, 9], *([i, (i + 1) % 5, 5 + (i + 1) % 5, 5 + i] for i in range(4)),
         [4, 0, 5], [4, 5, 9]]
CODES = {"char": "b", "uchar": "B", "short": "h", "ushort": "H", "int": "i", "uint": "I", "float": "f", "double": "d"}
KINDS = ("ascii", "binary_little_endian", "binary_big_endian")


def written(path, kind, faces=FACES, count="uchar", index="int", number="float", more=(), before="", after=(),
            comment="", name="vertex_indices"):
    """A .ply. more : names of other numbers of vertices; before, after : types of other numbers of faces."""
    lines = ["ply", f"format {kind} 1.0", *([f"comment {comment}"] if comment else ()),
             f"element vertex {len(VERTICES)}", *(f"property {number} {axis}" for axis in "xyz"),
             *(f"property uchar {entry}" for entry in more), f"element face {len(faces)}",
             *([f"property {before} flags"] if before else ()), f"property list {count} {index} {name}",
             *(f"property {entry}" for entry in after), "end_header"]
    rows = [[*((number, value) for value in place), *(("uchar", 7) for _ in more)] for place in VERTICES.tolist()]
    for face in faces:
        rows.append([*([(before, 3)] if before else ()), (count, len(face)), *((index, corner) for corner in face)])
        for entry in after:
            if entry.startswith("list"):
                rows[-1] += [("uchar", 2 * len(face)), *[("float", 0.5)] * (2 * len(face))]
            else:
                rows[-1].append((entry.split()[0], 9))
    header = "\n".join([*lines, ""]).encode("latin-1")
    if kind == "ascii":
        body = "".join(" ".join(str(value) for _, value in row) + "\n" for row in rows).encode()
    else:
        order = "<" if "little" in kind else ">"
        body = b"".join(struct.pack(order + CODES[kind], int(value) if kind not in ("float", "double") else value)
                        for row in rows for kind, value in row)
    path.write_bytes(header + body)
    return path


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("settings", [
    {}, {"count": "int", "index": "uint"}, {"index": "ushort", "number": "double", "name": "vertex_index"},
    {"more": ("red", "green", "blue"), "after": ("uchar red", "uchar green")},
    {"before": "short", "after": ("list uchar float texcoord", "int number")}, {"comment": "gelöscht"},
], ids=["plain", "large lists", "small indices", "colors", "textures", "words"])
def test_faces_of_several_sizes_are_polygons(kind, settings, tmp_path):
    """Those that Blender writes were refused: trimesh took all faces to have as many corners as the first."""
    model = reeb_parts.read_model(written(tmp_path / "house.ply", kind, **settings))
    assert (model.vertices == VERTICES).all()
    assert model.polygon.tolist() == [0, 0, 0, 1, 1, 1, 2, 2, 3, 3, 4, 4, 5, 5, 6, 7]
    for polygon, face in enumerate(FACES):
        assert set(model.faces[model.polygon == polygon].ravel().tolist()) == set(face)
    parts = reeb_parts.decompose(model).parts()
    assert len(parts.labels) == len(FACES)
    around = np.linalg.norm(np.roll(VERTICES[:5], -1, axis=0) - VERTICES[:5], axis=1).sum()
    assert parts.area.sum() == pytest.approx(2 * 10 + around)


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize(("size", "after"), [(3, ()), (4, ()), (3, ("list uchar float texcoord",))])
def test_faces_of_one_size_keep_vertices_and_order(kind, size, after, tmp_path):
    faces = [face[:size] for face in FACES[:6]]
    model = reeb_parts.read_model(written(tmp_path / "house.ply", kind, faces, after=after))
    assert (model.vertices == VERTICES).all()
    assert model.polygon.tolist() == np.repeat(np.arange(6), size - 2).tolist()
    first = model.faces[np.unique(model.polygon, return_index=True)[1]]
    assert [set(row) <= set(face) for row, face in zip(first.tolist(), faces, strict=True)] == [True] * 6


@pytest.mark.parametrize("rows", [
    [[0, 1, 2, 3, -1, 4, 5, 6, -1, 7, 8]], [[0, 1, 2, 3], [4, 5, 6]], [[0, 1, 2, 3, 3, 4, 4, 5, 6]]])
@pytest.mark.parametrize("kind", KINDS)
def test_strips_of_triangles_are_triangles(kind, rows, tmp_path):
    """As scans have them, ended by -1, by the row or by vertices that come twice: there was said to be no mesh."""
    path = written(tmp_path / "strips.ply", kind, rows)
    path.write_bytes(path.read_bytes().replace(b"element face", b"element tristrips"))
    model = reeb_parts.read_model(path)
    assert model.faces.tolist() == [[0, 1, 2], [2, 1, 3], [4, 5, 6]]
    assert model.polygon.tolist() == [0, 1, 2]


@pytest.mark.parametrize("kind", KINDS)
def test_lists_of_two_vertices_are_no_faces(kind, tmp_path):
    model = reeb_parts.read_model(written(tmp_path / "house.ply", kind, [[0, 1], *FACES, [2, 3]]))
    assert model.polygon.max() == len(FACES) - 1


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize(("faces", "words"), [([[0, 1, 10]], "a vertex that is not there"), ([], "There is no mesh"),
                                              ([[0, 1, -1], [0, 1, 2, 3]], "a vertex that is not there")])
def test_faces_that_are_none_are_said(kind, faces, words, tmp_path):
    with pytest.raises(reeb_parts.ModelFileError, match=words):
        reeb_parts.read_model(written(tmp_path / "house.ply", kind, faces))


@pytest.mark.parametrize("kind", KINDS)
def test_a_file_without_its_end_could_not_be_read(kind, tmp_path):
    path = written(tmp_path / "house.ply", kind)
    path.write_bytes(path.read_bytes()[:-7])
    with pytest.raises(reeb_parts.ModelFileError, match="could not be read: "):
        reeb_parts.read_model(path)


def test_a_file_of_vertices_alone_has_no_mesh(tmp_path):
    path = written(tmp_path / "house.ply", "ascii", [])
    path.write_bytes(path.read_bytes().replace(b"element face 0\nproperty list uchar int vertex_indices\n", b""))
    with pytest.raises(reeb_parts.ModelFileError, match="There is no mesh"):
        reeb_parts.read_model(path)


def test_numbers_of_other_types_are_left_to_trimesh(tmp_path):
    """It writes some itself."""
    import trimesh

    mesh = trimesh.Trimesh(VERTICES, [face[:3] for face in FACES], process=False,
                           face_attributes={"group": np.arange(len(FACES), dtype=np.int64)})
    mesh.export(tmp_path / "house.ply")
    with pytest.raises(Exception, match="type"):
        ply_files.read_ply(tmp_path / "house.ply")
    model = reeb_parts.read_model(tmp_path / "house.ply")
    assert (model.faces == mesh.faces).all()

# SPDX-License-Identifier: GPL-3.0-or-later
"""Models with names and comments in encodings other than UTF-8 are read as those without."""

import sys

import numpy as np
import pytest
import reeb_parts
import trimesh
from reeb_parts.batch.sources import read_list

WORDS = "Modell von Jürg, gelöscht ä".encode("latin-1")


def ascii_stl(mesh):
    """An .stl of words."""
    return trimesh.exchange.stl.export_stl_ascii(mesh).encode().replace(b"solid", b"solid " + WORDS, 1)


def binary_stl(mesh):
    """An .stl of numbers, with words in its header."""
    data = mesh.export(file_type="stl")
    return WORDS.ljust(80)[:80] + data[80:]


def ply(encoding):
    """A function that makes a .ply with a comment."""
    def make(mesh):
        data = mesh.export(file_type="ply", encoding=encoding)
        return data.replace(b"element vertex", b"comment " + WORDS + b"\nelement vertex", 1)

    return make


def obj(mesh):
    """An .obj with a comment, a name and a material."""
    return b"# " + WORDS + b"\nmtllib " + WORDS + b".mtl\no " + WORDS + b"\n" + mesh.export(file_type="obj").encode()


def off(mesh):
    """An .off with a comment."""
    return mesh.export(file_type="off").encode().replace(b"\n", b"\n# " + WORDS + b"\n", 1)


@pytest.mark.parametrize(("kind", "make"), [
    ("stl", ascii_stl), ("stl", binary_stl), ("ply", ply("ascii")), ("ply", ply("binary")), ("obj", obj), ("off", off),
], ids=["stl", "binary stl", "ply", "binary ply", "obj", "off"])
def test_names_and_comments_in_any_encoding(kind, make, tree, tmp_path):
    mesh = trimesh.Trimesh(*tree, process=False)
    (tmp_path / f"plain.{kind}").write_bytes(mesh.export(file_type=kind) if kind in ("stl", "ply")
                                             else mesh.export(file_type=kind).encode())
    data = make(mesh)
    assert WORDS in data
    (tmp_path / f"words.{kind}").write_bytes(data)
    found, expected = (reeb_parts.read_model(tmp_path / f"{name}.{kind}") for name in ("words", "plain"))
    assert np.allclose(found.vertices[found.faces], expected.vertices[expected.faces], atol=1e-5)
    assert (found.polygon == expected.polygon).all()


@pytest.mark.parametrize(("kind", "make"), [("obj", obj), ("off", off)])
@pytest.mark.parametrize("encoding", ["utf-16-le", "utf-16-be"])
def test_texts_in_utf16_are_read(kind, make, encoding, tree, tmp_path):
    """As PowerShell writes what a program says: there was no mesh in such an .obj."""
    text = make(trimesh.Trimesh(*tree, process=False)).decode("latin-1")
    (tmp_path / f"model.{kind}").write_bytes(f"\ufeff{text}".encode(encoding))
    assert (reeb_parts.read_model(tmp_path / f"model.{kind}").faces == tree[1]).all()


def test_a_list_in_utf16_is_read(tmp_path):
    (tmp_path / "list.txt").write_text("größe.obj\r\n\r\n# more\r\n", encoding="utf-16", newline="")
    assert read_list(tmp_path / "list.txt") == ["größe.obj"]


def test_a_file_that_was_cut_off_is_no_lack_of_a_package(tree, tmp_path):
    """Its numbers were taken for words in an encoding that a package had to find out."""
    data = trimesh.Trimesh(*tree, process=False).export(file_type="stl")
    (tmp_path / "torn.stl").write_bytes(data[:-20])
    with pytest.raises(reeb_parts.ModelFileError, match="ends before its last face"):
        reeb_parts.read_model(tmp_path / "torn.stl")


def test_what_follows_the_last_face_of_an_stl_is_not_read(tree, tmp_path):
    """There was said to be no mesh."""
    data = trimesh.Trimesh(*tree, process=False).export(file_type="stl")
    (tmp_path / "more.stl").write_bytes(data + b"more")
    assert len(reeb_parts.read_model(tmp_path / "more.stl").faces) == len(tree[1])


def test_a_package_that_is_not_there_is_a_lack_of_a_reader(tree, tmp_path, monkeypatch):
    monkeypatch.setattr(reeb_parts.model_files, "formats", lambda: (".ply", ".glb"))
    for kind, package in (("ply", "plyfile"), ("glb", "trimesh")):
        trimesh.Trimesh(*tree, process=False).export(tmp_path / f"tree.{kind}")
        with monkeypatch.context() as without:
            without.setitem(sys.modules, package, None)
            with pytest.raises(reeb_parts.model_files.NoReaderError, match="needs a package that is not there"):
                reeb_parts.read_model(tmp_path / f"tree.{kind}")

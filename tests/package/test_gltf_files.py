# SPDX-License-Identifier: GPL-3.0-or-later
"""What glTF files may have that is not read: a sentence names it, where trimesh gives zeros or nothing."""

import json
import sys

import numpy as np
import pytest
import reeb_parts
import trimesh
from reeb_parts.batch.records import files_of
from reeb_parts.model_files import NoReaderError


@pytest.fixture
def header(tmp_path):
    """The description of a file of one tetrahedron, whose numbers are in another file beside it."""
    places = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1.0]])
    mesh = trimesh.Trimesh(places, [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]], process=False)
    for name, data in trimesh.exchange.gltf.export_gltf(trimesh.Scene(mesh)).items():
        (tmp_path / name).write_bytes(data)
    return json.loads((tmp_path / "model.gltf").read_text(encoding="utf-8"))


def primitive(header):
    return header["meshes"][0]["primitives"][0]


def positions(header):
    return header["accessors"][primitive(header)["attributes"]["POSITION"]]


def sparse(header):
    positions(header)["sparse"] = {"count": 0}
    return "sparse positions"


def normalized(header):
    positions(header)["normalized"] = True
    return "normalized positions"


def fan(header):
    primitive(header)["mode"] = 6
    return "triangle fans"


def draco(header):
    primitive(header)["extensions"] = {"KHR_draco_mesh_compression": {"bufferView": 0, "attributes": {"POSITION": 0}}}
    del positions(header)["bufferView"]
    return "DracoPy"


def instances(header):
    header["extensionsUsed"] = ["EXT_mesh_gpu_instancing"]
    return "EXT_mesh_gpu_instancing"


def meshopt(header):
    header["extensionsRequired"] = ["EXT_meshopt_compression"]
    return "EXT_meshopt_compression"


def unplaced(header):
    header["scenes"] = [{}]
    return "meshes that are in no scene"


@pytest.mark.parametrize("change", [sparse, normalized, fan, draco, instances, meshopt, unplaced])
def test_what_is_not_read_is_named(change, header, tmp_path, monkeypatch):
    """Sparse and compressed positions were zeros, normalized ones thousands of times too large; fans were missing."""
    monkeypatch.setitem(sys.modules, "DracoPy", None)  # as where it is not installed
    words = change(header)
    (tmp_path / "model.gltf").write_text(json.dumps(header), encoding="utf-8")
    with pytest.raises(NoReaderError, match=words):
        reeb_parts.read_model(tmp_path / "model.gltf")


def test_what_draco_compressed_is_not_taken_for_zeros_if_it_is_damaged(header, tmp_path, monkeypatch):
    """Of several meshes the damaged one lay in a point, without a word; one alone was said to have no area."""
    (tmp_path / "DracoPy.py").write_text("def decode(data):\n    raise ValueError('damaged')\n", encoding="utf-8")
    monkeypatch.syspath_prepend(tmp_path)
    monkeypatch.delitem(sys.modules, "DracoPy", raising=False)
    header["meshes"][0]["primitives"].append(json.loads(json.dumps(primitive(header))))
    header["accessors"].append(dict(positions(header)))
    primitive(header)["attributes"]["POSITION"] = len(header["accessors"]) - 1
    draco(header)
    (tmp_path / "model.gltf").write_text(json.dumps(header), encoding="utf-8")
    with pytest.raises(reeb_parts.ModelFileError, match="what Draco has compressed in it cannot be unpacked"):
        reeb_parts.read_model(tmp_path / "model.gltf")


def test_a_byte_order_mark_hides_no_other_file(header, tmp_path):
    """Some editors write it; the digest of such a model did not know its numbers."""
    path = tmp_path / "model.gltf"
    path.write_text(json.dumps(header), encoding="utf-8-sig")
    assert sorted(files_of(path)) == sorted(tmp_path.iterdir())


@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig"])
def test_numbers_are_found_in_a_file_whose_name_is_written_as_an_address(encoding, header, tmp_path):
    """Blender writes names so. They were said not to be there, as was the file itself if an editor had marked it."""
    for number, buffer in enumerate(header["buffers"]):
        (tmp_path / buffer["uri"]).rename(tmp_path / f"n\xfcmbers of it {number}.bin")
        buffer["uri"] = f"n%C3%BCmbers%20of%20it%20{number}.bin"
    (tmp_path / "model.gltf").write_text(json.dumps(header), encoding=encoding)
    assert len(reeb_parts.read_model(tmp_path / "model.gltf").faces) == 4


@pytest.mark.parametrize("damage", [
    {"meshes": 3}, {"accessors": []}, {"meshes": [{}]}, {"meshes": [{"primitives": [3]}]}])
def test_a_damaged_file_is_one_sentence(damage, header, tmp_path):
    (tmp_path / "model.gltf").write_text(json.dumps(header | damage), encoding="utf-8")
    with pytest.raises(reeb_parts.ModelFileError, match=r"model\.gltf could not be read: "):
        reeb_parts.read_model(tmp_path / "model.gltf")


@pytest.mark.parametrize("header", [
    {"asset": {"version": "1.0"}, "meshes": {}},
    {"meshes": {"box": {"primitives": []}}},
    {"asset": {"version": "1.1"}},
])
def test_a_file_of_the_former_version_is_said_to_be_one(header, tmp_path):
    """Its meshes have names: 'str' object has no attribute 'get'."""
    (tmp_path / "model.gltf").write_text(json.dumps(header), encoding="utf-8")
    with pytest.raises(reeb_parts.ModelFileError, match="could not be read: it is of version 1 of glTF"):
        reeb_parts.read_model(tmp_path / "model.gltf")


def test_what_a_reader_refuses_without_a_word_is_damaged(header, tmp_path):
    """Triangles of two corners: the sentence ended with 'AssertionError:'."""
    indices = header["accessors"][primitive(header)["indices"]]
    indices["count"] = 2
    (tmp_path / "model.gltf").write_text(json.dumps(header), encoding="utf-8")
    with pytest.raises(reeb_parts.ModelFileError, match="it is damaged, or has what trimesh does not read"):
        reeb_parts.read_model(tmp_path / "model.gltf")


@pytest.mark.parametrize("index", [4, 5, 65535])
@pytest.mark.parametrize("n_meshes", [1, 2])
def test_a_face_with_a_vertex_that_is_not_there_is_damaged(index, n_meshes, header, tmp_path):
    """It was read, with faces of no vertices; of several meshes they were faces of the next one."""
    places = header["accessors"][primitive(header)["indices"]]
    places["componentType"] = 5123
    (tmp_path / "faces.bin").write_bytes(np.array([0, 2, 1, 0, 1, index, 0, 3, 2, 1, 2, 3], "<u2").tobytes())
    header["bufferViews"].append({"buffer": len(header["buffers"]), "byteLength": 24})
    header["buffers"].append({"uri": "faces.bin", "byteLength": 24})
    places["bufferView"], places["byteOffset"] = len(header["bufferViews"]) - 1, 0
    header["nodes"] = [{"mesh": 0}] * n_meshes
    header["scenes"] = [{"nodes": list(range(n_meshes))}]
    (tmp_path / "model.gltf").write_text(json.dumps(header), encoding="utf-8")
    with pytest.raises(reeb_parts.ModelFileError, match="could not be read: .*a face has a vertex that is not there"):
        reeb_parts.read_model(tmp_path / "model.gltf")

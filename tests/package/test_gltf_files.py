# SPDX-License-Identifier: GPL-3.0-or-later
"""What a glTF file may have: the same octahedra, however they are written."""

import base64
import json
import struct

import numpy as np
import pytest
import reeb_parts
import shapes
import trimesh
from reeb_parts.batch.records import digest_of, files_of
from reeb_parts.model_files import NoReaderError

VERTICES, FACES = shapes.octahedron().vertices.astype(np.float32), shapes.octahedron().faces
TYPES = {"f4": 5126, "u4": 5125, "u2": 5123, "i2": 5122, "u1": 5121}
COLUMNS = {1: "SCALAR", 3: "VEC3", 4: "VEC4", 16: "MAT4"}


class Gltf:
    """A file with one mesh, an octahedron, that node 0 shows."""

    def __init__(self):
        self.binary = b""
        self.header = {"asset": {"version": "2.0"}, "bufferViews": [], "accessors": [], "meshes": [],
                       "nodes": [{"mesh": 0}], "scenes": [{"nodes": [0]}], "scene": 0}
        self.mesh(VERTICES, FACES)

    def view(self, array, **more):
        start = len(self.binary)
        self.binary += array.tobytes() + bytes(-array.nbytes % 4)
        self.header["bufferViews"].append({"buffer": 0, "byteOffset": start, "byteLength": array.nbytes, **more})
        return len(self.header["bufferViews"]) - 1

    def numbers(self, array, **more):
        array = np.ascontiguousarray(array)
        self.header["accessors"].append({
            "bufferView": self.view(array), "componentType": TYPES[array.dtype.str[1:]], "count": len(array),
            "type": COLUMNS[array.size // len(array)], **more})
        return len(self.header["accessors"]) - 1

    def mesh(self, vertices, faces, **more):
        primitive = {"attributes": {"POSITION": self.numbers(vertices.astype(np.float32))},
                     "indices": self.numbers(np.asarray(faces, np.uint16).ravel()), **more}
        self.header["meshes"].append({"primitives": [primitive]})
        return primitive

    @property
    def primitive(self):
        return self.header["meshes"][0]["primitives"][0]

    @property
    def positions(self):
        return self.header["accessors"][self.primitive["attributes"]["POSITION"]]

    def write(self, path):
        self.header.setdefault("buffers", [{"byteLength": len(self.binary)}])
        text = json.dumps(self.header).encode()
        text += b" " * (-len(text) % 4)
        chunks = b"".join(struct.pack("<I4s", len(data), kind) + data
                          for kind, data in ((b"JSON", text), (b"BIN\0", self.binary)))
        path.write_bytes(struct.pack("<4s2I", b"glTF", 2, 12 + len(chunks)) + chunks)
        return path


def _sparse(file, vertices=VERTICES):
    """All positions of an accessor without any, or the second and fifth of others."""
    rows = np.arange(6, dtype=np.uint16) if vertices is VERTICES else np.array([1, 4], np.uint16)
    file.positions["sparse"] = {
        "count": len(rows), "indices": {"bufferView": file.view(rows), "componentType": TYPES["u2"]},
        "values": {"bufferView": file.view(VERTICES[rows])}}


def sparse(file):
    del file.positions["bufferView"]
    _sparse(file)


def sparse_over_others(file):
    wrong = VERTICES.copy()
    wrong[[1, 4]] = 9
    file.positions["bufferView"] = file.view(wrong)
    _sparse(file, wrong)


def whole_numbers(file):
    """With a pad behind each, as gltfpack has them."""
    rows = np.zeros((6, 4), np.int16)
    rows[:, :3] = VERTICES * 32767
    file.positions.update(bufferView=file.view(rows, byteStride=8), componentType=TYPES["i2"], normalized=True)


def instances(file):
    """Two, of which one is half as large, and turned."""
    values = {"TRANSLATION": [[0, 0, 0], [5, 0, 0]], "SCALE": [[1, 1, 1], [0.5, 0.5, 0.5]],
              "ROTATION": [[0, 0, 0, 1], [0, 0, 1, 0]]}
    file.header["nodes"][0]["extensions"] = {"EXT_mesh_gpu_instancing": {"attributes": {
        name: file.numbers(np.float32(rows)) for name, rows in values.items()}}}
    return [VERTICES, VERTICES * [-0.5, -0.5, 0.5] + [5, 0, 0]]


def morphed(file):
    """The weights of the node come before those of the mesh."""
    file.primitive["targets"] = [{}, {"POSITION": file.numbers(VERTICES)}]
    file.header["meshes"][0]["weights"] = [0, 9]
    file.header["nodes"][0]["weights"] = [1, 0.5]
    return [VERTICES * 1.5]


def skinned(file):
    """Where the bones are, and not where the node of the mesh is; the second vertex follows both bones."""
    weights = np.zeros((6, 4), np.float32)
    weights[:, 0] = 2
    weights[1] = [1, 1, 0, 0]
    joints = np.tile(np.array([0, 1, 0, 0], np.uint8), (6, 1))
    at_rest = np.tile(np.eye(4, dtype=np.float32), (2, 1, 1))
    at_rest[:, 3, 0] = -3  # column by column: three to the left
    file.primitive["attributes"] |= {"JOINTS_0": file.numbers(joints), "WEIGHTS_0": file.numbers(weights)}
    file.header["skins"] = [{"joints": [1, 2], "inverseBindMatrices": file.numbers(at_rest.reshape(2, 16))}]
    file.header["nodes"] = [{"mesh": 0, "skin": 0, "scale": [100, 100, 100]},
                            {"translation": [3, 0, 0], "children": [2]}, {"translation": [0, 0, 4]}]
    file.header["scenes"] = [{"nodes": [0, 1]}]
    moved = VERTICES.copy()
    moved[1, 2] += 2
    return [moved]


def fan(file):
    """A pyramid's four sides."""
    file.mesh(VERTICES, [0, 2, 1, 3, 0][:5], mode=6)
    file.header["meshes"][0]["primitives"] += file.header["meshes"].pop()["primitives"]
    return [VERTICES, VERTICES], np.concatenate([FACES, np.array([[0, 2, 1], [0, 1, 3], [0, 3, 0]]) + 6])


def strip(file):
    file.mesh(VERTICES, [0, 2, 1, 1, 3, 4], mode=5)
    file.header["meshes"][0]["primitives"] += file.header["meshes"].pop()["primitives"]
    return [VERTICES, VERTICES], np.concatenate([FACES, np.array([[0, 2, 1], [1, 4, 3]]) + 6])


def lines(file):
    more = [{"attributes": file.primitive["attributes"], "mode": mode} for mode in range(4)]
    file.header["meshes"][0]["primitives"] = [*more, file.primitive]


def on_a_camera(file):
    file.header["cameras"] = [{"type": "perspective", "perspective": {"yfov": 1, "znear": 0.1, "aspectRatio": 1.5}}]
    file.header["nodes"] = [{"camera": 0, "translation": [0, 5, 0], "mesh": 0, "children": [1]}, {"mesh": 0}]
    return [VERTICES + [0, 5, 0], VERTICES + [0, 5, 0]]


def no_scene(file):
    del file.header["scenes"], file.header["scene"]


def no_nodes(file):
    no_scene(file)
    del file.header["nodes"]


def second_scene(file):
    file.header["nodes"].append({"mesh": 0, "matrix": [2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 2, 0, 7, 0, 0, 1]})
    file.header["scenes"].append({"nodes": [1]})
    file.header["scene"] = 1
    return [VERTICES * 2 + [7, 0, 0]]


def many_nodes_in_a_row(file):
    file.header["nodes"] = [*({"translation": [0.5, 0, 0], "children": [n + 1]} for n in range(2000)), {"mesh": 0}]
    return [VERTICES + [1000, 0, 0]]


def circle(file):
    """Nodes that are their own grandchildren are in no place."""
    file.header["nodes"] += [{"mesh": 0, "children": [2]}, {"children": [1]}]


@pytest.mark.parametrize("change", [
    sparse, sparse_over_others, whole_numbers, instances, morphed, skinned, fan, strip, lines, on_a_camera, no_scene,
    no_nodes, second_scene, many_nodes_in_a_row, circle])
def test_the_shape_is_what_viewers_show(change, tmp_path):
    """trimesh gave other shapes of the first six, left out or refused others, and took minutes for the longest row."""
    file = Gltf()
    found = change(file) or [VERTICES]
    places, faces = found if isinstance(found, tuple) else (
        found, np.concatenate([FACES + 6 * n for n in range(len(found))]))
    model = reeb_parts.read_model(file.write(tmp_path / "model.glb"))
    assert np.abs(model.vertices - np.concatenate(places)).max() < 1e-4
    assert model.faces.tolist() == faces.tolist()


def test_models_that_trimesh_reads_right_are_the_same(tmp_path):
    """Objects in objects, mirrored, with several materials, once more: labels are for triangles in this order."""
    scene = trimesh.Scene()
    turn = trimesh.transformations.rotation_matrix(1, [1, 2, 3], [0.3, 0, 0])
    for n, parent in enumerate((None, "0", "1", None, "0")):
        mesh = trimesh.creation.uv_sphere(1 + n, count=[4, 4 + n])
        scene.add_geometry(mesh, node_name=str(n), geom_name=f"g{n}", parent_node_name=parent,
                           transform=turn @ np.diag([1, -1 if n % 2 else 1, 1.3, 1]))
    scene.graph.update("again", "world", matrix=turn @ turn, geometry="g2")
    scene.export(tmp_path / "model.glb")
    expected = trimesh.load_scene(tmp_path / "model.glb", process=False).dump()
    model = reeb_parts.read_model(tmp_path / "model.glb")
    assert np.abs(model.vertices - np.concatenate([mesh.vertices for mesh in expected])).max() < 1e-12
    sizes = np.cumsum([0, *(len(mesh.vertices) for mesh in expected)])
    assert (model.faces == np.concatenate(
        [mesh.faces + start for mesh, start in zip(expected, sizes, strict=False)])).all()


def test_numbers_in_another_file_or_in_the_text(tmp_path):
    """A byte order mark, as some editors write it, hid the names of other files from the digest."""
    file = Gltf()
    (tmp_path / "the numbers.bin").write_bytes(file.binary)
    path = tmp_path / "model.gltf"
    file.header["buffers"] = [{"byteLength": len(file.binary), "uri": "the%20numbers.bin"}]
    path.write_text("\ufeff" + json.dumps(file.header), encoding="utf-8")
    assert (reeb_parts.read_model(path).vertices == VERTICES).all()
    assert files_of(path) == [path, tmp_path / "the numbers.bin"]
    before = digest_of(path)
    (tmp_path / "the numbers.bin").write_bytes(file.binary[:-1] + b"\1")
    assert digest_of(path) != before
    file.header["buffers"][0]["uri"] = "data:application/gltf-buffer;base64," + base64.b64encode(file.binary).decode()
    path.write_text(json.dumps(file.header), encoding="utf-8")
    assert (reeb_parts.read_model(path).vertices == VERTICES).all()


@pytest.mark.parametrize(("name", "words"), [("KHR_draco_mesh_compression", "DracoPy"),
                                             ("EXT_meshopt_compression", "EXT_meshopt_compression")])
def test_compressed_meshes_need_a_reader(name, words, tmp_path):
    """They were all zeros, refused for ever as a mesh without an area."""
    file = Gltf()
    file.header["buffers"] = [{"byteLength": len(file.binary)}, {"byteLength": 999}]
    if words == name:
        for view in file.header["bufferViews"]:
            view |= {"buffer": 1, "extensions": {name: {"buffer": 0, "byteLength": 9}}}
    else:
        file.primitive["extensions"] = {name: {"bufferView": 0, "attributes": {"POSITION": 0}}}
        for entry in file.header["accessors"]:
            del entry["bufferView"]
    with pytest.raises(NoReaderError, match=words):
        reeb_parts.read_model(file.write(tmp_path / "model.glb"))


@pytest.mark.parametrize("damage", [
    {"meshes": 3}, {"scene": 9}, {"nodes": [{"mesh": 5}]}, {"accessors": []}, {"bufferViews": []},
    {"nodes": [{"mesh": 0, "skin": 0}]}, {"buffers": [{"byteLength": 4, "uri": "gone.bin"}]},
    {"asset": {"version": "1.0"}}, {"nodes": [{"mesh": 0, "matrix": [1]}]}, {"scenes": 1}, {"buffers": []}])
def test_a_damaged_file_is_one_sentence(damage, tmp_path):
    file = Gltf()
    file.primitive["attributes"] |= {"JOINTS_0": 0, "WEIGHTS_0": 0}
    file.header.update(damage)
    with pytest.raises(reeb_parts.ModelFileError, match=r"model\.glb could not be read: "):
        reeb_parts.read_model(file.write(tmp_path / "model.glb"))


def test_a_face_whose_vertex_is_not_there_is_one_sentence(tmp_path):
    file = Gltf()
    file.positions["count"] = 5
    with pytest.raises(reeb_parts.ModelFileError, match="a face has a vertex that is not there"):
        reeb_parts.read_model(file.write(tmp_path / "model.glb"))
    file.positions["count"] = 10**9
    with pytest.raises(reeb_parts.ModelFileError, match="it ends before its last number"):
        reeb_parts.read_model(file.write(tmp_path / "model.glb"))

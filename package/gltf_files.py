# SPDX-License-Identifier: GPL-3.0-or-later
"""Vertices and triangles of glTF files, .glb and .gltf, as a viewer shows them before anything moves.

trimesh reads most of them, but gives other shapes for what is sparse, normalised, morphed or skinned, leaves out fans,
further instances and what a camera has on it, and takes minutes for a thousand nodes in a row. Models that it reads
right come out the same here, and in the same order. Materials, normals and animations do not matter.
"""

from __future__ import annotations

import base64
import json
import struct
from collections.abc import Iterator
from functools import cache
from pathlib import Path
from typing import Any
from urllib.parse import unquote

import numpy as np

from .core.errors import ReebError
from .core.sentence import Sentence

_TYPES = {5120: "<i1", 5121: "<u1", 5122: "<i2", 5123: "<u2", 5125: "<u4", 5126: "<f4"}
_COLUMNS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4, "MAT4": 16}
_TRIANGLES, _STRIP, _FAN = 4, 5, 6
_DRACO, _INSTANCING = "KHR_draco_mesh_compression", "EXT_mesh_gpu_instancing"
_MESHOPT = ("EXT_meshopt_compression", "KHR_meshopt_compression")


class CompressionError(ReebError):
    """The meshes of a file are compressed in a way that nothing here reads."""


def read_gltf(path: Path) -> tuple[np.ndarray, np.ndarray]:
    """Read a .glb or .gltf.

    Parameters
    ----------
    path : Path
        Files that it names are looked for beside it.

    Returns
    -------
    vertices : (n, 3) float64
        Of all meshes, in the places that the scene gives them: morphed, skinned, once for each instance.
    triangles : (m, 3) int64
        In the order of the meshes. Lines and points are none.

    Raises
    ------
    CompressionError
        The meshes are compressed by meshopt.
    ImportError
        They are compressed by Draco, and DracoPy is not there.
    ValueError, LookupError, TypeError
        The file is damaged.
    OSError
        It, or another one that it names, cannot be read.
    """
    file = _File(path)
    vertices, triangles, count = [np.empty((0, 3))], [np.empty((0, 3), np.int64)], 0
    for points, faces in file.meshes():
        vertices.append(points)
        triangles.append(faces + count)
        count += len(points)
    return np.concatenate(vertices), np.concatenate(triangles)


def load_header(data: bytes) -> tuple[dict[str, Any], bytes | None]:
    """The description in a file, and of a .glb the numbers; whatever the file is called. Raises ValueError."""
    binary = None
    if data[:4] == b"glTF":
        (version,) = struct.unpack_from("<I", data, 4)
        if version != 2:
            raise ValueError(f"it is of version {version} of the format, not 2")
        chunks, at = {}, 12
        while at + 8 <= len(data):
            size, kind = struct.unpack_from("<I4s", data, at)
            chunks.setdefault(kind, data[at + 8 : at + 8 + size])
            at += 8 + size
        data, binary = chunks.get(b"JSON", b""), chunks.get(b"BIN\0")
    header = json.loads(data.decode("utf-8-sig", errors="replace"))
    if not isinstance(header, dict):
        raise ValueError("it has no description of a scene")
    if str(header.get("asset", {}).get("version", "2")).startswith("1"):
        raise ValueError("it is of version 1 of the format, not 2")
    return header, binary


class _File:
    """A file whose description has been read."""

    def __init__(self, path: Path) -> None:
        self._folder = path.parent
        self._header, self._binary = load_header(path.read_bytes())
        self._nodes = self._header.get("nodes", [])
        self._buffer = cache(self._read_buffer)
        self._primitives = cache(self._read_primitives)  # of meshes, which several nodes may show
        self._place = self._places()

    def meshes(self) -> Iterator[tuple[np.ndarray, np.ndarray]]:
        """Vertices and triangles of all that the scene shows, primitive by primitive."""
        if not self._nodes:  # a library of meshes, without places
            for index in range(len(self._header.get("meshes", ()))):
                yield from ((self._morphed(mesh, {}), mesh["faces"]) for mesh in self._primitives(index))
            return
        for index in self._shown():
            node = self._nodes[index]
            if "mesh" not in node or index not in self._place:
                continue
            for mesh in self._primitives(node["mesh"]):
                points = self._morphed(mesh, node)
                if "skin" in node and mesh["weights"] is not None:
                    yield _moved(points, mesh["faces"], self._bent(mesh, self._header["skins"][node["skin"]]))
                else:
                    for place in self._instances(index):
                        yield _moved(points, mesh["faces"], place[None])

    def _shown(self) -> Iterator[int]:
        """Nodes of the scene, parents before children, the last child of each first, as trimesh has them."""
        scenes = self._header.get("scenes")
        open_ = list(scenes[self._header.get("scene", 0)].get("nodes", ())) if scenes else self._roots()
        seen: set[int] = set()
        while open_:
            index = open_.pop()
            if index not in seen:
                seen.add(index)
                yield index
                open_ += self._nodes[index].get("children", ())

    def _roots(self) -> list[int]:
        """Nodes that are nobody's children."""
        children = {child for node in self._nodes for child in node.get("children", ())}
        return [index for index in range(len(self._nodes)) if index not in children]

    def _places(self) -> dict[int, np.ndarray]:
        """The matrix of each node, (4, 4), from its own axes to those of the scene; none for nodes in a circle."""
        places: dict[int, np.ndarray] = {}
        open_ = [(index, np.eye(4)) for index in self._roots()]
        while open_:
            index, parent = open_.pop()
            if index not in places:
                places[index] = parent @ _local(self._nodes[index])
                open_ += [(child, places[index]) for child in self._nodes[index].get("children", ())]
        return places

    def _instances(self, index: int) -> Iterator[np.ndarray]:
        """The matrices of a node, (4, 4): one, or one for each of its instances."""
        place = self._place[index]
        names = self._nodes[index].get("extensions", {}).get(_INSTANCING, {}).get("attributes", {})
        columns = {key.lower(): self._numbers(names[key])
                   for key in ("TRANSLATION", "ROTATION", "SCALE") if key in names}
        if not columns:
            yield place
            return
        for row in range(min(map(len, columns.values()))):
            yield place @ _local({key: values[row] for key, values in columns.items()})

    def _read_primitives(self, index: int) -> list[dict[str, Any]]:
        """What the primitives of a mesh that have triangles hold: points, faces, targets, joints and weights."""
        mesh, found = self._header["meshes"][index], []
        for primitive in mesh["primitives"]:
            mode = primitive.get("mode", _TRIANGLES)
            if mode not in (_TRIANGLES, _STRIP, _FAN) or "POSITION" not in primitive["attributes"]:
                continue
            attributes, faces = self._attributes(primitive)
            points = attributes["POSITION"].astype(np.float64)
            if faces is None:
                corner = (self._numbers(primitive["indices"], scaled=False).ravel() if "indices" in primitive
                          else np.arange(len(points)))
                faces = _faces(corner.astype(np.int64), mode)
            if len(faces) and not 0 <= faces.min() <= faces.max() < len(points):
                raise ValueError("a face has a vertex that is not there")
            moves = [target["POSITION"] for target in primitive.get("targets", ()) if "POSITION" in target]
            sets = sorted(name for name in attributes if name.startswith("WEIGHTS_"))
            found.append({
                "points": points, "faces": faces, "default": mesh.get("weights", ()),
                "targets": [target.get("POSITION") for target in primitive.get("targets", ())] if moves else [],
                "joints": [attributes[name.replace("WEIGHTS", "JOINTS")].astype(np.int64) for name in sets],
                "weights": np.concatenate([attributes[name] for name in sets], axis=1) if sets else None})
        return found

    def _attributes(self, primitive: dict[str, Any]) -> tuple[dict[str, np.ndarray], np.ndarray | None]:
        """Values of the vertices by name, and the triangles if they are compressed together with these."""
        names = {name: index for name, index in primitive["attributes"].items()
                 if name == "POSITION" or name.startswith(("JOINTS_", "WEIGHTS_"))}
        packed = primitive.get("extensions", {}).get(_DRACO)
        accessor = self._header["accessors"][names["POSITION"]]
        if packed is None or "bufferView" in accessor or "sparse" in accessor:  # or they are there uncompressed, too
            return {name: self._numbers(index, scaled=not name.startswith("JOINTS_"))
                    for name, index in names.items()}, None
        import DracoPy

        decoded = DracoPy.decode(self._view(packed["bufferView"]))
        data = {entry["unique_id"]: entry["data"] for entry in decoded.attributes}
        return ({name: data[packed["attributes"][name]] for name in names if name in packed["attributes"]},
                np.asarray(decoded.faces, np.int64).reshape(-1, 3))

    def _morphed(self, mesh: dict[str, Any], node: dict[str, Any]) -> np.ndarray:
        """Points of a primitive, (n, 3), in the mix of its shapes that a node or the mesh itself asks for."""
        points = mesh["points"]
        for target, weight in zip(mesh["targets"], node.get("weights", mesh["default"]), strict=False):
            if target is not None and weight:
                points = points + weight * self._numbers(target)
        return points

    def _bent(self, mesh: dict[str, Any], skin: dict[str, Any]) -> np.ndarray:
        """The matrix of each vertex, (n, 4, 4), as its bones are in the scene; the place of the node does not count."""
        bones = np.array([self._place[joint] for joint in skin["joints"]])
        if "inverseBindMatrices" in skin:
            at_rest = self._numbers(skin["inverseBindMatrices"]).reshape(-1, 4, 4).transpose(0, 2, 1)
            bones = bones @ at_rest[: len(bones)]
        weights = mesh["weights"].astype(np.float64)
        total = weights.sum(axis=1)
        matrices = np.where(total > 0, 0.0, 1.0)[:, None, None] * np.eye(4)
        weights /= np.where(total > 0, total, 1.0)[:, None]
        for joint, weight in zip(np.concatenate(mesh["joints"], axis=1).T, weights.T, strict=True):
            matrices += weight[:, None, None] * bones[joint]
        return matrices

    def _numbers(self, index: int, scaled: bool = True) -> np.ndarray:
        """The values of an accessor, a row for each; scaled : whole numbers that stand for -1..1 become that."""
        entry = self._header["accessors"][index]
        kind, columns, count = np.dtype(_TYPES[entry["componentType"]]), _COLUMNS[entry["type"]], entry["count"]
        if "bufferView" in entry:
            values = self._rows(entry["bufferView"], entry.get("byteOffset", 0), count, columns, kind)
        else:
            values = np.zeros((count, columns), kind)
        if sparse := entry.get("sparse"):
            values = values.copy()
            where, what = sparse["indices"], sparse["values"]
            rows = self._rows(where["bufferView"], where.get("byteOffset", 0), sparse["count"], 1,
                              np.dtype(_TYPES[where["componentType"]])).ravel()
            values[rows] = self._rows(what["bufferView"], what.get("byteOffset", 0), sparse["count"], columns, kind)
        if scaled and entry.get("normalized") and kind.kind in "iu":
            return np.maximum(values / np.iinfo(kind).max, -1.0)
        return values

    def _rows(self, view: int, start: int, count: int, columns: int, kind: np.dtype) -> np.ndarray:
        """Some rows of numbers out of a view, (count, columns); raises ValueError where it ends before."""
        data, size = self._view(view), columns * kind.itemsize
        step = self._header["bufferViews"][view].get("byteStride", size)
        if count < 0 or start < 0 or step < size or (count and start + (count - 1) * step + size > len(data)):
            raise ValueError("it ends before its last number")
        return np.ndarray((count, columns), kind, data, start, (step, kind.itemsize)) if count else np.empty(
            (0, columns), kind)

    def _view(self, index: int) -> bytes:
        """The bytes of a view; raises ValueError where they are not there, CompressionError where nobody reads them."""
        view = self._header["bufferViews"][index]
        packed = next((name for name in _MESHOPT if name in view.get("extensions", {})), None)
        buffer = self._header["buffers"][view["buffer"]]
        if packed and (view["buffer"] or self._binary is None) and "uri" not in buffer:
            raise CompressionError(Sentence("its meshes are compressed by {name}, which nothing here reads. Write it "
                                            "without that compression.", name=packed))
        start = view.get("byteOffset", 0)
        data = self._buffer(view["buffer"])[start : start + view["byteLength"]]
        if start < 0 or len(data) < view["byteLength"]:
            raise ValueError("it ends before its last number")
        return data

    def _read_buffer(self, index: int) -> bytes:
        """The bytes of a buffer: of the file itself, of its text, or of another file. Raises ValueError, OSError."""
        uri = self._header["buffers"][index].get("uri")
        if uri is None:
            if index or self._binary is None:
                raise ValueError(f"its buffer {index} is not there")
            return self._binary
        if uri.startswith("data:"):
            head, _, body = uri.partition(",")
            return base64.b64decode(body) if head.endswith(";base64") else unquote(body).encode("latin-1")
        return (self._folder / unquote(uri)).read_bytes()


def _local(node: dict[str, Any]) -> np.ndarray:
    """The matrix of a node, (4, 4), to the axes of its parent."""
    from trimesh.transformations import quaternion_matrix, translation_matrix

    matrix = np.eye(4)
    if "matrix" in node:
        matrix = np.array(node["matrix"], np.float64).reshape(4, 4).T
    if "translation" in node:
        matrix = matrix @ translation_matrix(node["translation"])
    if "rotation" in node:  # x, y, z, w
        matrix = matrix @ quaternion_matrix(np.reshape(node["rotation"], 4)[[3, 0, 1, 2]])
    if "scale" in node:
        matrix = matrix @ np.diag([*node["scale"], 1.0])
    return matrix


def _moved(points: np.ndarray, faces: np.ndarray, matrices: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Vertices and triangles in the place of some matrices, (n, 4, 4) or one for all; a mirror image looks outwards."""
    from trimesh.transformations import transform_points

    if np.median(np.linalg.det(matrices[:, :3, :3])) < 0:
        faces = faces[:, ::-1]
    if len(matrices) == 1:
        return transform_points(points, matrices[0]), faces
    return (matrices[:, :3, :3] @ points[:, :, None])[:, :, 0] + matrices[:, :3, 3], faces


def _faces(corner: np.ndarray, mode: int) -> np.ndarray:
    """Triangles, (m, 3), of the corners of a primitive; raises ValueError if they are not of three each."""
    if mode == _TRIANGLES:
        return corner.reshape(-1, 3)
    n = max(len(corner) - 2, 0)
    at = np.arange(n)
    if mode == _FAN:
        return np.stack([np.broadcast_to(corner[:1], n), corner[1 : n + 1], corner[2 : n + 2]], axis=1)
    # Every other triangle of a strip has its corners the other way round; some that join strips have no area.
    faces = np.stack([corner[at], corner[at + 1 + at % 2], corner[at + 2 - at % 2]], axis=1)
    return faces[(faces != np.roll(faces, 1, axis=1)).all(axis=1)]

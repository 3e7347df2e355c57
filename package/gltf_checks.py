# SPDX-License-Identifier: GPL-3.0-or-later
"""What glTF files, .glb and .gltf, may have that trimesh leaves out or takes for zeros without a word."""

from __future__ import annotations

import importlib.util
import json
import struct
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from .core.errors import ReebError
from .core.sentence import Sentence
from .damaged_files import DamagedFileError

_DRACO, _MESHOPT = "KHR_draco_mesh_compression", ("EXT_meshopt_compression", "KHR_meshopt_compression")
_INSTANCING = "EXT_mesh_gpu_instancing"
_FAN = 6  # a primitive's mode


def read_header(path: Path) -> dict[str, Any]:
    """The description in a file, which of a .glb is its first chunk; the numbers behind that are not read.

    Raises DamagedFileError if there is none, OSError if the file cannot be read.
    """
    with path.open("rb") as file:
        data = file.read(20)
        if data[:4] != b"glTF":
            data += file.read()
        elif len(data) < 20:
            raise DamagedFileError(Sentence("it ends in its head"))
        else:
            data = file.read(struct.unpack_from("<I", data, 12)[0])
    try:
        header = json.loads(data.decode("utf-8-sig", errors="replace"))
    except (ValueError, RecursionError) as error:
        raise DamagedFileError(Sentence("its description of a scene is no JSON ({words})", words=error)) from error
    if not isinstance(header, dict):
        raise DamagedFileError(Sentence("it has no description of a scene"))
    return header


def unread(header: dict[str, Any]) -> str:
    """Name what the meshes of a file have that trimesh does not read; empty if there is nothing.

    header : dict, of ``read_header``. Raises ReebError for a file of version 1, which is another format; LookupError,
    TypeError or AttributeError if it is damaged.
    """
    # There meshes have names in place of numbers, and no file needs to say its version.
    if isinstance(header.get("meshes"), dict) or str(header.get("asset", {}).get("version", "")).startswith("1."):
        raise ReebError(Sentence("it is of version 1 of glTF, and only 2 is read"))
    used = {*header.get("extensionsUsed", ()), *header.get("extensionsRequired", ())}
    for extension in (*_MESHOPT, _INSTANCING):
        if extension in used:
            return extension
    if header.get("meshes") and not any(scene.get("nodes") for scene in header.get("scenes", ())):
        return "meshes that are in no scene"
    for primitive in _primitives(header):
        if primitive.get("mode") == _FAN:
            return "triangle fans"
        places = header["accessors"][primitive["attributes"]["POSITION"]]
        for kind in ("sparse", "normalized"):
            if places.get(kind):
                return f"{kind} positions"
        if _is_packed(primitive, header) and importlib.util.find_spec("DracoPy") is None:
            return f"{_DRACO} without the package DracoPy"
    return ""


def is_packed(header: dict[str, Any]) -> bool:
    """Whether positions of a file are there compressed by Draco only. header : dict, as for ``unread``."""
    return any(_is_packed(primitive, header) for primitive in _primitives(header))


def _is_packed(primitive: dict[str, Any], header: dict[str, Any]) -> bool:
    """Whether positions of a primitive are."""
    places = header["accessors"][primitive["attributes"]["POSITION"]]
    return _DRACO in primitive.get("extensions", {}) and "bufferView" not in places


def _primitives(header: dict[str, Any]) -> Iterator[dict[str, Any]]:
    """The primitives of all meshes that have positions."""
    for mesh in header.get("meshes", ()):
        yield from (primitive for primitive in mesh["primitives"] if "POSITION" in primitive["attributes"])

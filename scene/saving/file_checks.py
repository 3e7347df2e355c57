# SPDX-License-Identifier: GPL-3.0-or-later
"""Whether a file that Blender has just written is all there.

On a full disk Blender's writers cut files short and report success. Each function reads a file back and returns whether
it ends where its own structure, or the mesh that it holds, says. A file whose structure cannot be followed is not
complete.
"""

from __future__ import annotations

import json
import mmap
import re
import struct
import zipfile
import zlib
from collections.abc import Callable
from functools import wraps
from pathlib import Path
from typing import NamedTuple

import bpy

_ZSTD, _SKIPPED, _SEEK_TABLE = b"\x28\xb5\x2f\xfd", b"\x5e\x2a\x4d\x18", b"\xb1\xea\x92\x8f"
_PNG = b"\x89PNG\r\n\x1a\n"
_PLY_BYTES = {"char": 1, "uchar": 1, "short": 2, "ushort": 2, "int": 4, "uint": 4, "float": 4, "double": 8}


def _following(read: Callable[..., bool]) -> Callable[..., bool]:
    """What cannot be read, since the file ends before, is not complete."""

    @wraps(read)
    def complete(path: Path, *arguments: object) -> bool:
        try:
            return read(path, *arguments)
        except (ValueError, KeyError, IndexError, OverflowError, FileNotFoundError, struct.error):
            return False

    return complete


@_following
def blend(path: Path) -> bool:
    """A scene: its blocks, or the pieces that it is compressed in, follow each other up to the last byte."""
    with path.open("rb") as file, mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ) as data:
        return _zstd(data) if data[:4] == _ZSTD else _blocks(data)


def _zstd(data: mmap.mmap) -> bool:
    """The table at the end, in the seekable format of Zstandard, fits the pieces before it."""
    count, _, magic = struct.unpack_from("<IB4s", data, len(data) - 9)
    start = len(data) - 9 - 8 * count
    if magic != _SEEK_TABLE or data[start - 8 : start - 4] != _SKIPPED:
        return False
    at = 0
    for size, _ in struct.iter_unpack("<II", data[start : len(data) - 9]):
        if data[at : at + 4] != _ZSTD:
            return False
        at += size
    return at == start - 8


def _blocks(data: mmap.mmap) -> bool:
    """The blocks of a scene that is not compressed lead to the one that ends it."""
    if data[:7] != b"BLENDER":
        return False
    # From Blender 5.0 the header tells its own length, and blocks have longer heads.
    at, head = (12, "<4sI16x") if data[7:8] in b"-_" else (int(data[7:9]), "<4s12xQ8x")
    size = struct.calcsize(head)
    while True:
        code, length = struct.unpack_from(head, data, at)
        at += size + length
        if code == b"ENDB":
            return at == len(data)


@_following
def png(path: Path) -> bool:
    """A picture: every chunk has its checksum, and the last is the end."""
    data, at, kind = path.read_bytes(), len(_PNG), b""
    if not data.startswith(_PNG):
        return False
    while kind != b"IEND":
        length, kind = struct.unpack_from(">I4s", data, at)
        (crc,) = struct.unpack_from(">I", data, at + 8 + length)
        if zlib.crc32(data[at + 4 : at + 8 + length]) != crc:
            return False
        at += 12 + length
    return at == len(data)


class Counts(NamedTuple):
    """How many vertices, faces and corners some meshes have together."""

    vertices: int
    faces: int
    corners: int


def model(meshes: list[bpy.types.Mesh], kind: str) -> Callable[[Path], bool]:
    """The function for a file that holds some meshes. kind : of export.KINDS."""
    counts = Counts(*(sum(len(getattr(mesh, items)) for mesh in meshes) for items in ("vertices", "polygons", "loops")))
    return lambda path: {"obj": _obj, "ply": _ply, "stl": _stl, "glb": _glb, "3mf": _3mf}[kind](path, counts)


@_following
def _obj(path: Path, counts: Counts) -> bool:
    """All vertices and faces, and in the library beside it all materials that are named."""
    text = path.read_bytes()
    found = {word: len(re.findall(rb"^%b " % word, text, re.M)) for word in (b"v", b"vt", b"vn", b"f")}
    corners = b" ".join(re.findall(rb"^f (.*)$", text, re.M)).split()
    if found[b"v"] != counts.vertices or found[b"f"] != counts.faces or not text.endswith(b"\n"):
        return False
    # A corner is v, v/vt, v//vn or v/vt/vn; each of these is of some corner.
    for place, word in ((1, b"vt"), (2, b"vn")):
        used = {corner.split(b"/")[place] for corner in corners if corner.count(b"/") >= place} - {b""}
        if len(used) != found[word]:
            return False
    if len(corners) != counts.corners:
        return False
    # An empty slot of materials has no name.
    named = set(re.findall(rb"^usemtl (.+)$", text, re.M))
    library = path.with_suffix(".mtl")
    materials = library.read_bytes() if library.exists() else b"\n"
    _, *blocks = re.split(rb"^newmtl ", materials, flags=re.M)
    there = {block.split(b"\n")[0] for block in blocks if b"\nillum " in block}
    return materials.endswith(b"\n") and named <= there


@_following
def _ply(path: Path, counts: Counts) -> bool:
    """As many bytes as its header says."""
    data = path.read_bytes()
    end = data.index(b"end_header\n") + len(b"end_header\n")
    expected, faces = end, 0
    for element in data[:end].decode().split("element ")[1:]:
        first, *properties = element.splitlines()
        name, count = first.split()
        kinds = [line.split()[1:] for line in properties if line.startswith("property ")]
        if name == "face":
            faces = int(count)
        # The list of a face is its number of corners, then the corners.
        expected += int(count) * sum(_PLY_BYTES[kind[1] if kind[0] == "list" else kind[0]] for kind in kinds)
        expected += counts.corners * sum(_PLY_BYTES[kind[2]] for kind in kinds if kind[0] == "list")
    return faces == counts.faces and expected == len(data)


@_following
def _stl(path: Path, counts: Counts) -> bool:
    """80 bytes of text, the number of triangles, 50 bytes each."""
    data = path.read_bytes()
    (count,) = struct.unpack_from("<I", data, 80)
    return count == counts.corners - 2 * counts.faces and len(data) == 84 + 50 * count


@_following
def _glb(path: Path, counts: Counts) -> bool:
    """As many bytes as it says, its description whole, and as many numbers as that counts."""
    data = path.read_bytes()
    magic, _, total, words = struct.unpack_from("<4s3I", data, 0)
    head = json.loads(data[20 : 20 + words])
    numbers = struct.unpack_from("<I", data, 20 + words)[0] if head.get("buffers") else 0
    binary = 8 + numbers if head.get("buffers") else 0
    counted = sum(buffer["byteLength"] for buffer in head.get("buffers", ()))
    there = bool(head.get("meshes")) == bool(counts.faces) and counted <= numbers
    return magic == b"glTF" and there and 20 + words + binary == total == len(data)


@_following
def _3mf(path: Path, counts: Counts) -> bool:
    """A zip whose entries have their checksums, and after whose directory nothing comes; its model is whole."""
    ends = path.read_bytes()[-22:-18] == b"PK\5\6"
    try:
        with zipfile.ZipFile(path) as package:
            return ends and package.testzip() is None and package.read("3D/3dmodel.model").endswith(b"</model>\n")
    except (zipfile.BadZipFile, zlib.error, OSError):
        return False


def text(written: str) -> Callable[[Path], bool]:
    """The function for a file that holds a text."""
    return lambda path: path.read_bytes() == written.encode()

# SPDX-License-Identifier: GPL-3.0-or-later
"""What of a damaged .fbx has Blender take all memory: its nodes say how many properties they have, and are believed.

A binary .fbx is a list of nodes. Each says where it ends and how many properties it has, then come its name, its
properties and the nodes in it; a node that ends nowhere closes a list.
"""

from __future__ import annotations

import struct
from pathlib import Path

_HEAD = 23  # bytes before the version
_LARGE = 7500  # version from which numbers in nodes have 64 bits
_SIZES = dict(zip(b"ZYBCIFDL", (1, 2, 1, 1, 4, 4, 8, 8), strict=True))  # bytes of a property, by the letter before it
_TEXTS, _ARRAYS = b"RS", b"bcilfd"  # of so many bytes as the first, or the third number of 32 bits says


def is_believable(path: Path) -> bool:
    """Whether Blender can read the nodes of an .fbx without more room than for its bytes; raises OSError.

    Nodes are read as its importer does it, which does not look at how many bytes the properties of a node should have.
    What is no binary .fbx is refused by the importer itself.
    """
    data = path.read_bytes()
    if not data.startswith(b"Kaydara FBX Binary"):
        return True
    try:
        (version,) = struct.unpack_from("<I", data, _HEAD)
        node = struct.Struct("<3IB" if version < _LARGE else "<3QB")
        place, last = _HEAD + 4, 0
        while True:
            end, count, _, name = node.unpack_from(data, place)
            if not end and place >= last:  # the outermost list ends, in which all others lie
                return True
            if count > len(data):
                return False
            place, last = place + node.size + name, max(last, end)
            for _ in range(count if end else 0):
                place += 1 + _size(data, place)
    except (struct.error, KeyError, IndexError):
        return False


def _size(data: bytes, place: int) -> int:
    """Bytes of a property behind its letter; raises KeyError or IndexError if there is no such property."""
    kind = data[place]
    if kind in _TEXTS:
        return 4 + struct.unpack_from("<I", data, place + 1)[0]
    if kind in _ARRAYS:
        return 12 + struct.unpack_from("<I", data, place + 9)[0]
    return _SIZES[kind]

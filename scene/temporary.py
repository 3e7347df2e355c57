# SPDX-License-Identifier: GPL-3.0-or-later
"""Data of Blender's that is there for a while only, and gone whatever happens meanwhile."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

import bmesh
import bpy


@contextmanager
def removed(collection: bpy.types.bpy_prop_collection, *blocks: bpy.types.ID) -> Iterator[None]:
    """Remove data blocks from the collection of ``bpy.data`` that they are in, once they have been used."""
    try:
        yield
    finally:
        for block in blocks:
            collection.remove(block)


@contextmanager
def freed(bm: bmesh.types.BMesh) -> Iterator[bmesh.types.BMesh]:
    """Free a BMesh once it has been used."""
    try:
        yield bm
    finally:
        bm.free()

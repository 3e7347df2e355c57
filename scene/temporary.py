# SPDX-License-Identifier: GPL-3.0-or-later
"""Remove what was made: data that is there for a while only, whatever happens meanwhile, and whole objects."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

import bmesh
import bpy

from . import transaction


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


def remove_object(obj: bpy.types.Object) -> None:
    """Remove an object, and its data unless others use them."""
    data = obj.data
    if data is not None and data.users == 1:
        transaction.discard(obj, data)
    else:
        transaction.discard(obj)

# SPDX-License-Identifier: GPL-3.0-or-later
"""What many objects are in and what hangs on them, found in one pass: Blender goes through the whole file for each."""

from __future__ import annotations

from collections import defaultdict
from dataclasses import dataclass

import bpy


@dataclass(frozen=True, eq=False)
class Surroundings:
    """What there is around the objects of the file now.

    Attributes
    ----------
    collections : dict of bpy.types.Object -> list of bpy.types.Collection
        What ``users_collection`` says of each.
    physics : set of bpy.types.Collection
        The collections of simulations.
    parents : set of bpy.types.Object
        Those that have ``children``.
    """

    collections: dict[bpy.types.Object, list[bpy.types.Collection]]
    physics: set[bpy.types.Collection | None]
    parents: set[bpy.types.Object]

    @classmethod
    def now(cls) -> Surroundings:
        """Look through the file."""
        worlds = [scene.rigidbody_world for scene in bpy.data.scenes if scene.rigidbody_world]
        physics = {used for world in worlds for used in (world.collection, world.constraints)}
        found = defaultdict(list)
        for collection in (*bpy.data.collections, *(scene.collection for scene in bpy.data.scenes)):
            for item in collection.objects:
                found[item].append(collection)
        return cls(found, physics, {item.parent for item in bpy.data.objects if item.parent is not None})

    def n_own_collections(self, item: bpy.types.Object) -> int:
        """How many collections an object is in, but for those of simulations."""
        return sum(collection not in self.physics for collection in self.collections.get(item, ()))

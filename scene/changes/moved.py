# SPDX-License-Identifier: GPL-3.0-or-later
"""A mesh that was moved as a whole since it was decomposed keeps its parts: the result and its graph go along.

So Blender's Apply and Set Origin do, and scaling all vertices in Edit Mode. As with an object that is scaled, the parts
stay those of the shape that was decomposed. So does half of a model that was not moved against its other half.
"""

from __future__ import annotations

from dataclasses import replace

import bpy
import numpy as np

from .. import bridge, property_updates, redraw, store, targets, transaction
from ..errors import SceneError
from ..graph import graph_follow, graph_objects
from ..reading import fingerprints, half_models


def load(mesh: bpy.types.Mesh) -> store.Stored:
    """What ``store.load`` does, for commands: where the mesh was moved as a whole, its result follows before."""
    try:
        return store.load(mesh)
    except SceneError:
        if not store.has_result(mesh) or mesh.is_editmode or not follow(mesh):
            raise
        return store.load(mesh)


def follow(mesh: bpy.types.Mesh) -> bool:
    """Make the result of a mesh that of the mesh where it is now; whether it was moved as a whole. Not in Edit Mode."""
    motion = fingerprints.motion_since(mesh, mesh.reeb_parts.fingerprint)
    if motion is None or not all(half_models.moves_with_its_image(obj, *motion) for obj in targets.users(mesh)):
        return False
    matrix, offset = motion
    try:
        stored = store.last(mesh)
    except SceneError:  # what is done with the parts says so
        return False
    # So the coordinates of the result stay, but for an offset: areas and lengths do, too.
    stretch = store.stretch_of(mesh) @ np.linalg.inv(matrix)
    decomposition = stored.decomposition.shifted(stretch @ offset)
    with transaction.transaction(), property_updates.quiet():
        store.save(mesh, replace(stored, decomposition=decomposition))
        mesh.reeb_parts.stretch = stretch.ravel().tolist()
        for obj in targets.users(mesh):
            graph_objects.put_back(obj, decomposition.graph, bridge.unstretch(stretch).T,
                                   float(np.cbrt(np.linalg.det(matrix))))
            graph_follow.soon(obj)
    redraw.viewports()
    return True

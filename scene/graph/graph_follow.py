# SPDX-License-Identifier: GPL-3.0-or-later
"""The graph goes with the shape that is seen: apart with Explode, along with a pose and other modifiers.

Each node and each point of an arc moves as the candidate part around it does, which is fitted to the evaluated mesh.
The nodes keep their locations, which are the graph's; a delta of theirs takes them to where they are seen. A mesh whose
modifiers make other faces than its own has its graph where it was, but for Subdivision beside those that move it, and
for the Mirror of a half model before these, with Subdivision or without: what lies on the other side goes with the
image there.
"""

from __future__ import annotations

import bpy
import numpy as np

from ...core.arrays.indexing import sums_by
from ...core.result.decomposition import Decomposition
from ...core.symmetry.plane import MirrorPlane
from ...core.uses.moving.motion import rigid_motions
from .. import bridge, redraw, store
from ..errors import SceneError
from ..reading import half_models, mesh_arrays
from ..reading.seen_points import seen_corners, seen_halves
from . import arc_curves, graph_finding, graph_objects

_RESTS = 1e-6  # a graph that moves less than this share of the model's size stays where it is

_waiting: set[int] = set()  # objects by session_uid
_places: dict[int, tuple[int, np.ndarray]] = {}  # by session_uid, of graphs that are not where they were: when, places
_count = 0


def forget() -> None:
    """Free what is kept in memory."""
    _places.clear()
    _waiting.clear()


def places(obj: bpy.types.Object) -> tuple[int, np.ndarray | None]:
    """Where the nodes and the points of the arcs are seen, (k + r, 3) float64 in the object's coordinates.

    None if that is where the graph has them. With a number that tells whether they have changed.
    """
    return _places.get(obj.session_uid, (0, None))


def soon(obj: bpy.types.Object) -> None:
    """Let the graph of an object follow once Blender has time: not within its own step of undo."""
    _waiting.add(obj.session_uid)
    if not bpy.app.timers.is_registered(_follow_waiting):
        bpy.app.timers.register(_follow_waiting, first_interval=0.0)


def stop() -> None:
    """Follow no more."""
    if bpy.app.timers.is_registered(_follow_waiting):
        bpy.app.timers.unregister(_follow_waiting)
    forget()


def _follow_waiting() -> float | None:
    waiting = set(_waiting)
    _waiting.clear()
    for obj in bpy.context.view_layer.objects if bpy.context.view_layer else ():
        # After removals there are places without an object.
        if obj is not None and obj.session_uid in waiting and store.has_parts(obj) and not obj.data.is_editmode:
            follow(bpy.context, obj)
    # The evaluation may have told of more: meanwhile ``soon`` has found this timer registered.
    return 0.0 if _waiting else None


def follow(context: bpy.types.Context, obj: bpy.types.Object) -> None:
    """Move the graph of an object that has parts to where its shape is seen; not in Edit Mode."""
    global _count
    collection = graph_finding.find(obj)
    if collection is None or not obj.is_editable:
        _places.pop(obj.session_uid, None)
        return
    try:
        stored = store.load(obj.data)
    except SceneError:  # the mesh was edited: the panel says so
        return
    graph = stored.decomposition.graph
    back = bridge.unstretch(store.stretch_of(obj.data)).T
    rest = arc_curves.places(graph, back)
    moved = _moved(context, obj, stored.decomposition, rest)
    _, known = places(obj)
    if moved is rest:
        _places.pop(obj.session_uid, None)
    elif known is None or not np.array_equal(known, moved):
        _count += 1
        _places[obj.session_uid] = _count, moved
    if graph_objects.shift(obj, graph, back, moved):
        redraw.viewports()


def _moved(
    context: bpy.types.Context, obj: bpy.types.Object, decomposition: Decomposition, rest: np.ndarray
) -> np.ndarray:
    """Where nodes and center points are seen that rest at some places, (k + r, 3); those very places if none moves."""
    seen = _seen(context, obj)
    if seen is None:
        return rest
    table = mesh_arrays.corner_table(obj.data, mesh_arrays.shown_points(obj))
    before = table.face_means(table.vertices)
    area = mesh_arrays.read(obj.data.polygons, "area", np.float32).astype(np.float64)
    moved_with = np.concatenate([decomposition.node_candidate, decomposition.point_candidate])

    def moved_by(before: np.ndarray, seen: np.ndarray) -> np.ndarray:
        """Where all is that goes with faces whose middles, (p, 3), were there before and are seen now."""
        motions = rigid_motions(before, seen, area, decomposition.candidates, decomposition.n_candidates)
        return motions.moved(rest, moved_with)

    moved, both = moved_by(before, seen), seen_halves(context, obj)
    plane = None if both is None else _plane(obj)
    if both is not None and plane is not None:
        stretch = store.stretch_of(obj.data)
        image = plane.mirrored(before @ stretch.T) @ bridge.unstretch(stretch).T
        mean = plane.heights(before @ stretch.T).mean()
        # What lies in the plane goes with the mesh itself.
        beyond = plane.heights(rest @ stretch.T) * mean < -_RESTS * mean**2
        moved = np.where(beyond[:, None], moved_by(image, both[1]), moved)
    size = np.ptp(before, axis=0).max()
    return rest if np.abs(moved - rest).max(initial=0.0) <= _RESTS * size else moved


def _seen(context: bpy.types.Context, obj: bpy.types.Object) -> np.ndarray | None:
    """The middle of each face as it is seen, (p, 3) float64; None if modifiers leave it, or make other faces."""
    points = seen_corners(context, obj)
    if points is None:
        return None
    _, face = mesh_arrays.face_corners(obj.data)
    return sums_by(face, points.astype(np.float64), len(obj.data.polygons)) / mesh_arrays.face_sizes(obj.data)[:, None]


def _plane(obj: bpy.types.Object) -> MirrorPlane | None:
    """The plane of a half model, in coordinates of its shape; None of any other."""
    stretch = store.stretch_of(obj.data)
    plane = half_models.half_plane(obj, mesh_arrays.shown_points(obj).astype(np.float64) @ stretch.T, stretch)
    return MirrorPlane.of(plane) if len(plane) else None

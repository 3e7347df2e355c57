# SPDX-License-Identifier: GPL-3.0-or-later
"""Notice that a decomposed mesh was edited, so that the panel can say so, or deleted, so that its graph goes, too.

And that all pieces of an object were deleted, so that it is seen again.

A mesh is looked at once it has been left alone for a moment: while it is sculpted, nothing is computed.
"""

from __future__ import annotations

import time
from collections.abc import Iterable

import bmesh
import bpy
from bpy.app.handlers import persistent
from bpy.app.translations import pgettext_rpt as rpt_

from .. import handlers, redraw, store, targets, transaction
from ..graph import graph_finding, graph_follow, graph_removal, graph_visibility
from ..modes import is_object_mode
from ..ours import orphan_outputs
from ..pieces import origins, piece_objects
from ..reading import fingerprints, seen_points
from ..showing import explode
from ..temporary import removed
from . import moved

REST = 0.3  # seconds
MOST_EDITED = 200_000  # vertices of a mesh that is looked at in Edit Mode: less than a tenth of a second

_waiting: set[int] = set()  # meshes by session_uid
_undriven: set[int] = set()  # objects by session_uid whose sliders are driven, but do nothing after an undo
_last = 0.0


def check(mesh: bpy.types.Mesh) -> None:
    """Set or take back the mark that a mesh differs from the one its result belongs to.

    In Edit Mode a large mesh is not looked at, nor one with shape keys, of which that mode shows one: once it is left.
    """
    result = mesh.reeb_parts
    if not mesh.is_editmode:
        edited = fingerprints.fingerprint(mesh) != result.fingerprint and not moved.follow(mesh)
    elif mesh.shape_keys or len(bmesh.from_edit_mesh(mesh).verts) > MOST_EDITED:
        return
    else:
        # To write the edits to the mesh itself would be a change of it, after which we would look again, and so on.
        copy = bpy.data.meshes.new("Reeb Parts")
        with removed(bpy.data.meshes, copy):
            bmesh.from_edit_mesh(mesh).to_mesh(copy)
            edited = fingerprints.fingerprint(copy) != result.fingerprint
    if result.edited != edited:
        result.edited = edited
        redraw.viewports()


@persistent
def _changed(scene: bpy.types.Scene, depsgraph: bpy.types.Depsgraph) -> None:
    deleted = depsgraph.id_type_updated("COLLECTION") or depsgraph.id_type_updated("SCENE")
    # Link Object Data changes no collection. Collections are gone through only where objects are not just moved.
    replaced = (depsgraph.id_type_updated("OBJECT")
                and any(update.is_updated_geometry for update in depsgraph.updates)
                and any(graph_finding.of_other_meshes()))
    if (replaced or (deleted and _is_untidy())) and not bpy.app.timers.is_registered(_tidy):
        # Not within Blender's own deletion, which has yet to become a step of undo.
        bpy.app.timers.register(_tidy, first_interval=0.0)
    elif deleted:
        _hide_graphs_soon()
    found = _changed_objects(depsgraph)
    if not found:
        return
    for obj in found:
        seen_points.evaluated(obj)
        graph_follow.soon(obj)
    _look_soon(obj.data for obj in found)
    _explode_soon(found)


def _changed_objects(depsgraph: bpy.types.Depsgraph) -> list[bpy.types.Object]:
    """Decomposed objects whose shape was evaluated anew."""
    return [update.id.original for update in depsgraph.updates
            if update.is_updated_geometry and isinstance(update.id, bpy.types.Object)
            and update.id.type == "MESH" and store.has_result(update.id.original.data)]


@persistent
def _animated(scene: bpy.types.Scene, depsgraph: bpy.types.Depsgraph) -> None:
    """Another frame is shown, which is no edit; whether a model is hidden may be animated."""
    found = _changed_objects(depsgraph)
    for obj in found:
        seen_points.evaluated(obj)
        graph_follow.soon(obj)
    _explode_soon(found)
    if not bpy.app.is_job_running("RENDER"):  # which shows frames of its own
        _hide_graphs_soon()


@persistent
def _opened(*_: object) -> None:
    """A file was opened: where graphs are seen is not stored, nor what was edited where the extension was off."""
    graph_follow.forget()
    graph_visibility.forget()
    seen_points.forget()
    graph_finding.know_all()
    for collection in bpy.data.collections:
        source = graph_finding.source_of(collection)
        if source is not None and any(modifier.show_viewport for modifier in source.modifiers):
            graph_follow.soon(source)
    _look_soon(mesh for mesh in bpy.data.meshes if store.has_result(mesh))


def _look_soon(meshes: Iterable[bpy.types.Mesh]) -> None:
    """Look at decomposed meshes once they have been left alone for a moment."""
    global _last
    _waiting.update(mesh.session_uid for mesh in meshes)
    _last = time.monotonic()
    if _waiting and not bpy.app.timers.is_registered(_look):
        bpy.app.timers.register(_look, first_interval=REST)


def _look() -> float | None:
    rested = time.monotonic() - _last
    if rested < REST:
        return REST - rested
    for mesh in bpy.data.meshes:
        if mesh.session_uid in _waiting and mesh.is_editable and store.has_result(mesh):
            check(mesh)
            if len(mesh.polygons) > mesh.reeb_parts.n_faces:
                _settle_joined(mesh)
    _waiting.clear()
    return None


def _settle_joined(mesh: bpy.types.Mesh) -> None:
    """Faces may have come by Join, which leaves all objects of the mesh in Object Mode."""
    users = targets.users(mesh)
    if users and all(obj.mode == "OBJECT" for obj in users):
        with transaction.transaction():
            orphan_outputs.settle_joined(users[0])


def _explode_soon(changed: list[bpy.types.Object]) -> None:
    """Give those of some objects their modifier whose slider a driver alone moves."""
    if any(map(_waits, changed)) and not bpy.app.timers.is_registered(_explode):
        bpy.app.timers.register(_explode, first_interval=0.0)


def _waits(obj: bpy.types.Object) -> bool:
    return obj.session_uid not in _undriven and explode.waits(obj)


def _explode() -> None:
    """Sliders that are driven only, which nobody has moved, do what they say; a step of undo by itself.

    What is made without one is not known to the steps around it, and ends Blender at undo. In other modes than Object
    Mode steps do not hold it: there it has to wait until the object is evaluated again.
    """
    layer = bpy.context.view_layer
    found = [obj for obj in layer.objects if obj is not None and _waits(obj)] if layer else []
    if not found or not is_object_mode(bpy.context):
        return
    with transaction.transaction():
        for obj in found:
            explode.begin(obj)
    manager = bpy.context.window_manager
    if len(manager.windows) and not bpy.app.background:
        with bpy.context.temp_override(window=manager.windows[0]):
            bpy.ops.ed.undo_push(message=rpt_("Explode"))


def _is_untidy() -> bool:
    """Whether anything is left of objects that were deleted."""
    return (any(graph_finding.left_behind()) or any(graph_finding.of_removed()) or any(origins.left_behind())
            or bool(piece_objects.hidden_for_nothing(bpy.context)))


@persistent
def _hide_graphs_soon(*_: object) -> None:
    """Models may have been hidden or shown, or shown alone."""
    if graph_visibility.is_due(bpy.context) and not bpy.app.timers.is_registered(_hide_graphs):
        bpy.app.timers.register(_hide_graphs, first_interval=0.0)


@persistent
def _undone(*_: object) -> None:
    graph_visibility.forget()
    graph_finding.know_more()
    # The step was undone in which they got their modifiers: made again, nothing before could be undone.
    _undriven.clear()
    _undriven.update(obj.session_uid for obj in bpy.data.objects if explode.waits(obj))
    _hide_graphs_soon()


def _hide_graphs() -> None:
    """Graphs are hidden or shown with their models."""
    with transaction.transaction():
        graph_visibility.follow(bpy.context)


def _tidy() -> None:
    """Remove the graphs of objects that were deleted; their pieces stay. Show objects whose pieces were deleted."""
    with transaction.transaction():
        # No other graphs are drawn: what is made without a step of undo of its own can end Blender at undo.
        for obj in list(graph_finding.left_behind()):
            graph_removal.remove(obj)
        graph_removal.remove_of_removed()
        for collection in list(origins.left_behind()):
            origins.forget_original(collection)
        for obj in piece_objects.hidden_for_nothing(bpy.context):
            piece_objects.show_original(bpy.context, obj)


@persistent
def _saving(*_: object) -> None:
    """A file is about to be written: without a window no timer has tidied."""
    if _is_untidy():
        _tidy()


def register() -> None:
    bpy.app.handlers.depsgraph_update_post.append(_changed)
    bpy.app.handlers.frame_change_post.append(_animated)
    bpy.app.handlers.load_post.append(_opened)
    bpy.app.handlers.save_pre.append(_saving)
    bpy.app.handlers.undo_post.append(_undone)
    bpy.app.handlers.redo_post.append(_undone)


def unregister() -> None:
    handlers.remove(bpy.app.handlers.redo_post, _undone)
    handlers.remove(bpy.app.handlers.undo_post, _undone)
    handlers.remove(bpy.app.handlers.save_pre, _saving)
    handlers.remove(bpy.app.handlers.load_post, _opened)
    handlers.remove(bpy.app.handlers.frame_change_post, _animated)
    handlers.remove(bpy.app.handlers.depsgraph_update_post, _changed)
    graph_follow.stop()
    graph_visibility.forget()
    seen_points.forget()
    for timer in (_look, _tidy, _explode, _hide_graphs):
        if bpy.app.timers.is_registered(timer):
            bpy.app.timers.unregister(timer)
    _waiting.clear()

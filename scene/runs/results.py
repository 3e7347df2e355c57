# SPDX-License-Identifier: GPL-3.0-or-later
"""The result of a run: whether it still fits its object, written to the object, and removed from it."""

from __future__ import annotations

from contextlib import suppress
from typing import Any, NamedTuple

import bpy
from bpy.app.translations import pgettext_rpt as rpt_

from ...core.result.numbering import NumberedParts, Numbering
from ...core.steps import Steps, finished
from ...core.uses.graph_folding import is_crowded, unfolded
from .. import bridge, outputs, property_updates, store, targets, transaction
from ..errors import SceneError
from ..graph import graph_finding, graph_objects, graph_removal
from ..moving import armature
from ..ours import orphan_outputs
from ..outputs import colors, seams, uv_map
from ..result import notes
from ..showing import explode, hidden
from . import succession
from .compute import Outcome


def check_unchanged(context: bpy.types.Context, outcomes: list[Outcome]) -> None:
    """Raise SceneError if an object that was computed is not in the scene any more, or was edited meanwhile."""
    for outcome, obj in zip(outcomes, objects_of(outcomes), strict=True):
        if obj is None or not obj.users_scene or obj.type != "MESH":
            raise SceneError(
                rpt_("{name} is gone; its parts were computed in vain.").format(name=outcome.object_name))
        if context.scene not in obj.users_scene:
            raise SceneError(
                rpt_("{name} is not in this scene. Go back to its own, and decompose it again.").format(name=obj.name))
        targets.check_object(obj)
        before, now = outcome.shape, bridge.read_shape(obj)
        # Another frame may show another shape of the mesh, which is no edit: the parts are those of the frame before.
        if before.digest != now.digest and before.fingerprint != now.fingerprint:
            raise SceneError(
                rpt_("{name} was changed while its parts were computed. Decompose it again.").format(name=obj.name))


def objects_of(outcomes: list[Outcome]) -> list[bpy.types.Object | None]:
    """The objects that were computed; None for those that are gone."""
    by_uid = {obj.session_uid: obj for obj in bpy.data.objects}
    return [by_uid.get(outcome.shape.object_uid) for outcome in outcomes]


def detail_of(obj: bpy.types.Object | None) -> dict[str, float | int]:
    """The detail and the number of parts that an object shows, as parameters of its next run; none without parts."""
    if obj is None or not store.has_parts(obj):
        return {}
    result = obj.data.reeb_parts
    # Blender stores 0.05 as 0.05000000074505806.
    return {"detail": float(f"{result.detail:.6g}"), "n_parts": result.n_parts if result.by_number else 0}


def write_result(context: bpy.types.Context, obj: bpy.types.Object, outcome: Outcome, settings: Any) -> int:
    """Write one object's parts and graph; Object Mode.

    Parameters
    ----------
    context : bpy.types.Context
    obj : bpy.types.Object
    outcome : Outcome
        With a decomposition.
    settings
        Has the values of OutputProperties and OverlayProperties.

    Returns
    -------
    kept : int
        Nodes of an earlier graph that were left alone, see graph_objects.draw_graph.
    """
    return finished(writing_result(context, obj, outcome, settings))


def writing_result(context: bpy.types.Context, obj: bpy.types.Object, outcome: Outcome, settings: Any) -> Steps[int]:
    """What ``write_result`` does, in steps."""
    mesh, decomposition = obj.data, outcome.decomposition
    assert decomposition is not None
    transaction.keep_mesh(mesh)
    _keep_colors(mesh)
    orphan_outputs.remove(obj)
    seams.claim_merged(obj.data)
    stored = succession.succeed(obj, outcome.shape, decomposition)
    numbered = stored.shown_parts()
    yield 0.1
    with property_updates.quiet():
        store.save(mesh, stored)
        yield 0.4
        _keep_facts(obj, outcome, stored.numbering, numbered.parts.count)
        outputs.write_outputs(obj, numbered, decomposition.field, settings)
        outputs.keep_places(mesh, numbered)
    store.mark_pins(mesh, stored)
    yield 0.8
    kept = 0
    # Other objects of the mesh show its parts, and a graph of theirs is that of the result before.
    for user in targets.users(mesh):
        explode.settle(user)
        if settings.graph and (user == obj or graph_finding.exists(user)):
            kept += draw_graph(context, user, numbered, settings)
        else:
            graph_removal.remove(user)
    return kept


def _keep_facts(obj: bpy.types.Object, outcome: Outcome, numbering: Numbering, count: int) -> None:
    """Keep what a run says of itself: its shape, time and notes, and the level of detail that has so many parts."""
    assert outcome.decomposition is not None
    result, parameters = obj.data.reeb_parts, outcome.decomposition.parameters
    result.object_name = obj.name
    result.stretch = outcome.shape.stretch.ravel().tolist()
    result.seconds = outcome.seconds
    notes.keep(result, outcome.decomposition.notes + outcome.shape.notes)
    result.detail, result.by_number, result.asked = parameters.detail, parameters.n_parts > 0, 0
    if result.by_number:
        store.go_to_number(result, numbering, count)
        result.asked = 0 if count == parameters.n_parts else parameters.n_parts


def draw_graph(context: bpy.types.Context, obj: bpy.types.Object, numbered: NumberedParts, settings: Any) -> int:
    """Draw the graph of parts that are stored with an object's mesh, hidden at first where it would cover the model.

    settings : has the values of OverlayProperties. Returns how many nodes of an earlier graph were left alone.
    """
    kept = graph_objects.draw_graph(context, obj, numbered, settings)
    graph_objects.set_hidden(context, obj, shows_clutter(numbered))
    return kept


def shows_clutter(numbered: NumberedParts) -> bool:
    """Whether the graph of some parts would cover the model rather than show anything; it is hidden at first then."""
    graph, parts = numbered.parts.decomposition.graph, numbered.parts
    return is_crowded(graph, unfolded(graph, parts.node_part, parts.point_part)[0])


def _keep_colors(mesh: bpy.types.Mesh) -> None:
    """Let the parts that take over numbers of the result before have its colors."""
    if store.has_result(mesh):
        with suppress(SceneError):  # it cannot be read any more
            outputs.keep_places(mesh, store.last(mesh).shown_parts())


class Left(NamedTuple):
    """What stays, as it was changed by hand: our UV map and colors by name, or ""; the weights of the armature."""

    uv_map: str
    colors: str
    weights: bool


def clear(obj: bpy.types.Object) -> Left:
    """Remove parts, graph and stored result of an object; Object Mode."""
    transaction.keep_mesh(obj.data)
    orphan_outputs.remove(obj)
    for user in targets.users(obj.data):
        explode.forget(user)
        hidden.forget(user)
        graph_removal.remove(user)
    hidden.forget_faces(obj.data)
    weights_stay = armature.clear(obj.data)
    map_that_stays = uv_map.remove(obj.data)
    colors_that_stay = colors.hand_over_painted(obj.data)
    outputs.remove_outputs(obj)
    transaction.unset_group(obj.data, "reeb_parts")
    return Left(map_that_stays, colors_that_stay, weights_stay)

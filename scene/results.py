# SPDX-License-Identifier: GPL-3.0-or-later
"""The result of a run, written to its object; and everything that was made of it, removed."""

from __future__ import annotations

from typing import Any

import bpy

from . import armature, explode, graph_objects, notes, outputs, reactions, store, uv_map
from .compute import Outcome


def write_result(context: bpy.types.Context, obj: bpy.types.Object, outcome: Outcome, settings: Any) -> None:
    """Write one object's parts and graph; Object Mode.

    Parameters
    ----------
    context : bpy.types.Context
    obj : bpy.types.Object
    outcome : Outcome
        With a decomposition.
    settings
        Has the values of OutputProperties and OverlayProperties.
    """
    mesh, decomposition = obj.data, outcome.decomposition
    assert decomposition is not None
    parameters = decomposition.parameters
    stored = store.succeed(mesh, decomposition)
    numbered = stored.shown_parts()
    result = mesh.reeb_parts
    with store.quiet():
        store.save(mesh, stored)
        result.object_name = obj.name
        result.stretch = outcome.shape.stretch.ravel().tolist()
        result.seconds = outcome.seconds
        notes.keep(result, decomposition.notes + outcome.shape.notes)
        result.detail, result.by_number = parameters.detail, parameters.n_parts > 0
        outputs.write_outputs(obj, numbered, decomposition.field, settings)
    store.mark_pins(mesh, stored)
    if settings.graph:
        graph_objects.draw_graph(context, obj, decomposition.graph, outcome.shape.stretch, settings)
        graph_objects.update_parts(obj, numbered)
    else:
        graph_objects.remove(obj)


def clear(obj: bpy.types.Object) -> None:
    """Remove parts, graph and stored result of an object; Object Mode."""
    for user in reactions.users(obj.data):
        explode.forget(user)
        armature.remove_modifier(user)
    uv_map.remove(obj.data)
    outputs.remove_outputs(obj)
    graph_objects.remove(obj)
    obj.data.property_unset("reeb_parts")

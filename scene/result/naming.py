# SPDX-License-Identifier: GPL-3.0-or-later
"""Names that are suggested for the parts of an object, in the language of the interface."""

from __future__ import annotations

from dataclasses import replace

import bpy
import numpy as np
from bpy.app.translations import pgettext_n as n_
from bpy.app.translations import pgettext_rpt as rpt_

from ...core.uses.naming.method import Suggestion, suggestions
from ...core.uses.naming.shapes import Shapes
from .. import bridge, store
from ..moving import skeleton
from ..reading import mesh_arrays, placing
from ..store import Stored

_WORDS = {word: word for word in (
    n_("body"), n_("head"), n_("neck"), n_("arm"), n_("leg"), n_("tail"), n_("ear"), n_("horn"), n_("handle"),
    n_("ground"), n_("limb"), n_("tip"), n_("piece"), n_("front"), n_("back"), n_("top"), n_("bottom"), n_("left"),
    n_("right"))}
_ENDINGS = {1: ".L", 0: "", -1: ".R"}


def suggested(obj: bpy.types.Object, stored: Stored) -> dict[int, str]:
    """A name for each part of an object that is shown, by number; Object Mode.

    Names of several parts may be the same.
    """
    numbered, shape = stored.shown_parts(), bridge.read_shape(obj)
    world, mesh = np.array(placing.world_matrix(obj), np.float64), obj.data
    whole = skeleton.whole_model(obj, shape, numbered)
    if whole is None:
        points = placing.transformed(mesh_arrays.shown_points(obj), world)
        parts, table, area = numbered.parts, mesh_arrays.corner_table(mesh, points), shape.face_area
        is_ground = shape.is_ground
        turn = world[:3, :3] @ bridge.unstretch(store.stretch_of(mesh))
    else:  # it has the names of what is seen
        turn = world[:3, :3] @ bridge.unstretch(shape.stretch)
        parts, area, is_ground = whole.parts, np.tile(shape.face_area, 2), np.tile(shape.is_ground, 2)
        table = replace(whole.table, vertices=whole.table.vertices @ turn.T + world[:3, 3])
    names = [_spoken(suggestion) for suggestion in suggestions(Shapes.of(parts, table, area, is_ground, turn))]
    return dict(zip(numbered.numbers.tolist(), names[: numbered.parts.count], strict=True))


def _spoken(suggestion: Suggestion) -> str:
    """A suggestion as a name."""
    word = rpt_(_WORDS[suggestion.word])
    if suggestion.place:
        word = rpt_("{place} {kind}").format(place=rpt_(_WORDS[suggestion.place]), kind=word)
    return word + _ENDINGS[suggestion.side]

# SPDX-License-Identifier: GPL-3.0-or-later
"""Names that are suggested for the parts of an object, in the language of the interface."""

from __future__ import annotations

import bpy
import numpy as np
from bpy.app.translations import pgettext_n as n_
from bpy.app.translations import pgettext_rpt as rpt_

from ..core.uses.naming import Shapes, Suggestion, suggestions
from . import bridge, mesh_arrays, store
from .store import Stored

_WORDS = {word: word for word in (
    n_("body"), n_("head"), n_("neck"), n_("arm"), n_("leg"), n_("tail"), n_("ear"), n_("handle"), n_("limb"),
    n_("tip"), n_("piece"), n_("front"), n_("back"), n_("top"), n_("bottom"), n_("left"), n_("right"))}
_ENDINGS = {1: ".L", 0: "", -1: ".R"}


def suggested(obj: bpy.types.Object, stored: Stored) -> dict[int, str]:
    """A name for each part of an object that is shown, by number; Object Mode.

    Names of several parts may be the same.
    """
    mesh = obj.data
    numbered = stored.shown_parts()
    world = np.array(bridge.world_matrix(obj), np.float64)
    points = mesh_arrays.shown_points(obj).astype(np.float64) @ world[:3, :3].T + world[:3, 3]
    vertex, face = mesh_arrays.face_corners(mesh)
    center = mesh_arrays.corner_table(mesh, points).face_means(points)
    turn = world[:3, :3] @ bridge.unstretch(store.stretch_of(mesh))
    shapes = Shapes.of(numbered.parts, center, bridge.read_shape(obj).face_area, points[vertex], face, turn)
    names = [_spoken(suggestion) for suggestion in suggestions(shapes)]
    return dict(zip(numbered.numbers.tolist(), names, strict=True))


def _spoken(suggestion: Suggestion) -> str:
    """A suggestion as a name."""
    word = rpt_(_WORDS[suggestion.word])
    if suggestion.place:
        word = rpt_("{place} {kind}").format(place=rpt_(_WORDS[suggestion.place]), kind=word)
    return word + _ENDINGS[suggestion.side]

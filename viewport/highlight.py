# SPDX-License-Identifier: GPL-3.0-or-later
"""The outline of the chosen parts, a fill of those without one, and all cuts, drawn over the active object.

Cuts are drawn where Separate would make them. Built when the choice or the parts change, drawn as often as the view is;
nothing is written anywhere.
"""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING

import bpy
import gpu
import numpy as np
from bpy.app.translations import pgettext_rpt as rpt_

from ..core.steps import Steps
from ..scene import bridge, store
from ..scene.errors import SceneError
from ..scene.graph import graph_finding
from ..scene.pieces import cut_curves
from ..scene.reading import mesh_arrays
from ..scene.reading.seen_points import seen_points, version
from ..scene.result.part_list import chosen_numbers
from ..scene.showing import explode, selection
from .idle import IdleSearch
from .lines import Lines, Surface
from .modal.view_tool import CHANGED

if TYPE_CHECKING:
    from ..core.uses.clean_cuts.curves import Curves

COLOR = (1.0, 1.0, 1.0, 0.9)
WIDTH = 2.5  # of lines, in pixels, as the next one
CUTS_COLOR, CUTS_WIDTH = (1.0, 1.0, 1.0, 0.6), 1.5

FILL = (1.0, 1.0, 1.0, 0.15)  # of loose pieces, which border on nothing

AT_ONCE = 6_000  # up to so many faces curves are found within a redraw
PLANAR_MOST = 400_000  # of more faces, planar ones are drawn as smooth ones, which are found several times as fast

_built = None  # what the lines and the surface below were built of
_lines: Lines | None = None
_cuts: Lines | None = None
_surface: Surface | None = None
_searches: IdleSearch[Curves] = IdleSearch(keep=4)


def forget() -> None:
    """Free what is kept in memory."""
    global _built, _lines, _cuts, _surface
    _built = _lines = _cuts = _surface = None
    _searches.forget()


def curves_of(obj: bpy.types.Object, cut: str) -> Curves | None:
    """The curves between the parts of an object that has some; None while they are looked for, and along faces.

    cut : as of properties.SeparateProperties.
    """
    if cut == "FACES":
        return None
    if len(obj.data.polygons) > PLANAR_MOST:
        cut = "SMOOTH"
    key = (store.state_of(obj.data), bridge.world_stretch(obj).tobytes(), cut)
    return _searches.of(key, partial(_finding, obj.name, obj.data.session_uid, cut), len(obj.data.polygons) <= AT_ONCE)


def _finding(name: str, uid: int, cut: str) -> Steps[Curves]:
    """Look for the curves of an object with a mesh. Raises SceneError."""
    obj = bpy.data.objects.get(name)
    if obj is None or obj.type != "MESH" or obj.data.session_uid != uid:
        raise SceneError(rpt_(CHANGED))
    face_numbers = store.load(obj.data).face_numbers
    return cut_curves.finding_curves(*cut_curves.read(obj), face_numbers, cut == "PLANAR")


def outline(obj: bpy.types.Object, numbers: list[int] | None, curves: Curves | None = None) -> tuple[np.ndarray]:
    """Where some parts border on others: ends of lines, (2 k, 3) float32, in the object's coordinates; in a tuple.

    Parameters
    ----------
    obj : bpy.types.Object
    numbers : list of int or None
        Of the parts; None for where any part borders on another one.
    curves : Curves, optional
        Without them, the lines are edges of faces; so they are where some faces of a part are hidden, which are in no
        part then.

    Raises
    ------
    SceneError
        The parts are out of date.
    """
    mesh = obj.data
    part, points = store.load(mesh).face_numbers, seen_points(bpy.context, obj)
    hidden, gone = _hidden(mesh, part)
    if curves is None or (hidden is not None and gone is None):
        mine = (part if numbers is None else np.isin(part, numbers)).astype(np.int64)
        if hidden is not None:
            mine[hidden] = 0
        table = mesh_arrays.joined_table(mesh)
        low, high = table.edge_labels(mine)
        return (points[table.edges[low < high].ravel()],)
    here = (~np.isin(curves.pair, gone or []).all(axis=1) if numbers is None
            else curves.around(np.setdiff1d(numbers, gone or [])))
    return (curves.points(points)[curves.segments[here].ravel()].astype(np.float32),)


def _hidden(mesh: bpy.types.Mesh, part: np.ndarray) -> tuple[np.ndarray | None, list[int] | None]:
    """Which faces are hidden, (p,) bool, and the parts that these are, if they are whole parts; None for none.

    part : (p,) int64, of each face.
    """
    if not selection.hides_faces(mesh) or not (hidden := selection.hidden_faces(mesh)).any():
        return None, None
    gone = selection.hidden_parts(mesh, part)
    return hidden, gone if np.array_equal(np.isin(part, gone), hidden) else None


def without_outline(obj: bpy.types.Object, numbers: list[int]) -> np.ndarray:
    """The surface of those of some parts that border on none, as loose pieces do: (t, 3, 3) float32 triangles.

    Raises
    ------
    SceneError
        The parts are out of date.
    """
    mesh = obj.data
    part = store.load(mesh).face_numbers
    mine = np.isin(part, numbers) & ~selection.hidden_faces(mesh)
    table = mesh_arrays.joined_table(mesh)
    low, high = table.edge_labels(mine.astype(np.int64))
    whole = mine & ~np.isin(part, part[table.corner_face[(low < high)[table.corner_edge]]])
    if not whole.any():
        return np.empty((0, 3, 3), np.float32)
    corners, of = mesh_arrays.triangles(mesh)
    return seen_points(bpy.context, obj)[corners[whole[of]]]


def draw() -> None:
    """Draw the outline of the chosen parts, and the cuts, in the viewport that Blender is drawing."""
    context = bpy.context
    settings = context.scene.reeb_parts
    obj = _chosen(context.object)
    if (obj is None or not (settings.highlight or settings.show_cuts) or not context.space_data.overlay.show_overlays
            or not obj.visible_in_viewport_get(context.space_data) or not _shows_parts(obj)):
        return
    _build(obj, chosen_numbers(obj.data) if settings.highlight else [], settings.show_cuts,
           context.scene.reeb_parts_use.cut)
    if _surface is not None:
        _surface.draw(obj.matrix_world, FILL, context.region_data.is_perspective)
    gpu.state.blend_set("ALPHA")
    if _cuts is not None:
        _cuts.draw(obj.matrix_world, CUTS_WIDTH, CUTS_COLOR)
    if _lines is not None:
        _lines.draw(obj.matrix_world, WIDTH, COLOR)
    gpu.state.blend_set("NONE")


def _chosen(active: bpy.types.Object | None) -> bpy.types.Object | None:
    """The selected object that is worked on, or that a selected node of a graph belongs to; in Object Mode."""
    if active is None or not active.select_get():
        return None
    of_node = graph_finding.part_of(active)  # a node that is selected lights its part
    obj = of_node[0] if of_node else active
    return obj if obj.type == "MESH" and obj.mode == "OBJECT" else None


def _shows_parts(obj: bpy.types.Object) -> bool:
    """Whether an object has parts that are up to date and where the mesh is."""
    return store.has_result(obj.data) and not store.is_edited(obj.data) and not explode.find(obj)


def _build(obj: bpy.types.Object, numbers: list[int], show_cuts: bool, cut: str) -> None:
    """Build what is drawn, if it is not what was drawn last. numbers : parts with an outline."""
    global _built, _lines, _cuts, _surface
    curves = curves_of(obj, cut)
    hidden = selection.hidden_faces(obj.data).tobytes() if selection.hides_faces(obj.data) else b""
    keys = obj.data.shape_keys
    mix = [(key.value, key.mute) for key in keys.key_blocks] + [obj.active_shape_key_index] if keys else []
    key = (obj.session_uid, store.state_of(obj.data), tuple(numbers), hash(hidden), tuple(mix), version(obj), show_cuts,
           cut, curves is None)
    if key == _built:
        return
    _built = key
    _lines = Lines.of(outline, obj, numbers, curves) if numbers else None
    _cuts = Lines.of(outline, obj, None, curves) if show_cuts else None
    _surface = Surface.of(without_outline, obj, numbers) if numbers else None

# SPDX-License-Identifier: GPL-3.0-or-later
"""The part under the pointer, filled and named, while the tool "Reeb Parts" is the active one.

A gizmo that covers the whole view: Blender asks it about every move of the pointer, lets it draw, and takes it away
with the tool. It uses no event, so that clicks and keys reach the keymap of the tool. Nothing is written anywhere.
"""

from __future__ import annotations

from dataclasses import dataclass

import blf
import bpy
import numpy as np

from ..scene import store
from ..scene.errors import SceneError
from ..scene.reading import mesh_arrays
from ..scene.reading.seen_points import seen_points, version
from ..scene.result import part_names
from ..scene.showing import explode
from . import idle, pointing
from .lines import Surface

FILL = (1.0, 1.0, 1.0, 0.35)
TEXT = 12  # of the name, in points


@dataclass(eq=False)
class Pointed:
    """The part under the pointer.

    Attributes
    ----------
    key : tuple
        Of the object and its parts, see pointing.result_key.
    number : int
    triangles : (t, 3, 3) float32
        In coordinates of the mesh; none where the parts are seen elsewhere.
    surface : Surface or None
        To draw the triangles; None until they are drawn.
    """

    key: tuple
    number: int
    triangles: np.ndarray
    surface: Surface | None = None


_pointed: Pointed | None = None
_mouse = (0, 0)  # in pixels of the region
_named_in = 0  # the region that has just been drawn with a part filled
_surface: tuple[tuple, np.ndarray, np.ndarray] | None = None  # triangles of an object and their parts, by its key


def forget() -> None:
    """Free what is kept in memory."""
    global _pointed, _surface
    _pointed = _surface = None


def clear() -> None:
    """Nothing is pointed at, until the pointer moves."""
    global _pointed
    _pointed = None


def number(obj: bpy.types.Object) -> int:
    """The part of an object that is filled, 0 for none."""
    return _pointed.number if _pointed is not None and _pointed.key == _key(obj) else 0


def name(obj: bpy.types.Object) -> str:
    """What the part of an object that is filled is called now, "" for none."""
    found = number(obj)
    return part_names.part_name(obj.data, found) if found else ""


def point(context: bpy.types.Context, mouse: tuple[int, int]) -> None:
    """The pointer has moved to a place of the region."""
    global _pointed, _mouse
    idle.moved()
    obj, _mouse = context.view_layer.objects.active, (mouse[0], mouse[1])
    try:
        model = pointing.model_of(obj)
        target = model.under(context, obj, context.region, _mouse)
    except SceneError:  # the panel says what is wrong
        target = None
    if target is None:
        _pointed = None
        return
    key, part = _key(obj), model.number(target)
    if _pointed is None or (_pointed.key, _pointed.number) != (key, part):
        _pointed = Pointed(key, part, _triangles(obj, key, model, part))


def _key(obj: bpy.types.Object) -> tuple:
    """Changes with the object, its mesh and its parts, and where these are seen."""
    return *pointing.result_key(obj), version(obj)


def _triangles(obj: bpy.types.Object, key: tuple, model: pointing.Model, part: int) -> np.ndarray:
    """The triangles of a part, (t, 3, 3) float32; none if the object is exploded."""
    global _surface
    if explode.find(obj):
        return np.empty((0, 3, 3), np.float32)
    if _surface is None or _surface[0] != key:
        corners, face = mesh_arrays.triangles(obj.data)
        _surface = key, seen_points(bpy.context, obj)[corners], model.numbers[face]
    return _surface[1][_surface[2] == part]


def draw(context: bpy.types.Context) -> None:
    """Fill the part, in the viewport that Blender is drawing."""
    global _named_in
    obj = context.view_layer.objects.active
    if _pointed is None or context.window.modal_operators or _pointed.key != _key(obj):
        return
    _named_in = context.region.as_pointer()
    if not len(_pointed.triangles):
        return
    if _pointed.surface is None:
        _pointed.surface = Surface(_pointed.triangles)
    _pointed.surface.draw(obj.matrix_world, FILL, context.region_data.is_perspective)


def draw_name() -> None:
    """Name the part beside the pointer, in the viewport that Blender is drawing."""
    global _named_in
    context = bpy.context
    if _pointed is None or context.region is None or _named_in != context.region.as_pointer():
        return
    _named_in = 0
    words, scale = name(context.view_layer.objects.active), context.preferences.system.ui_scale
    blf.size(0, TEXT * scale)
    blf.color(0, 1.0, 1.0, 1.0, 1.0)
    blf.enable(0, blf.SHADOW)
    blf.shadow(0, 6, 0.0, 0.0, 0.0, 0.8)  # an outline, as the fill is as light as the letters
    width, _ = blf.dimensions(0, words)
    left = min(_mouse[0] + 18 * scale, context.region.width - width - 4 * scale)
    blf.position(0, left, _mouse[1] + 12 * scale, 0)
    blf.draw(0, words)
    blf.disable(0, blf.SHADOW)


class REEB_PARTS_GT_hover(bpy.types.Gizmo):
    """Fills the part under the pointer."""

    bl_idname = "REEB_PARTS_GT_hover"

    def setup(self) -> None:
        self.use_draw_modal = False

    def test_select(self, context: bpy.types.Context, location: tuple[int, int]) -> int:
        point(context, location)
        context.region.tag_redraw()
        # Blender tells by the highlight that the pointer has left the view.
        return -1 if _pointed is None else 0

    def draw(self, context: bpy.types.Context) -> None:
        if self.is_highlight:
            draw(context)


class REEB_PARTS_GGT_hover(bpy.types.GizmoGroup):
    """Fills and names the part under the pointer."""

    bl_idname = "REEB_PARTS_GGT_hover"
    bl_label = "Reeb Parts Hover"
    bl_space_type = "VIEW_3D"
    bl_region_type = "WINDOW"
    bl_options = {"3D"}

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        return context.mode == "OBJECT" and store.has_parts(context.view_layer.objects.active)

    @classmethod
    def setup_keymap(cls, keyconfig: bpy.types.KeyConfig) -> bpy.types.KeyMap:
        # None of Blender's keys for gizmos: it uses no event. But Blender asks it only while such keys are held down as
        # its keymap has items for, so that there must be some.
        keymap = keyconfig.keymaps.new(cls.bl_label, space_type="VIEW_3D", region_type="WINDOW")
        for held in ({}, {"shift": True}, {"ctrl": True}, {"alt": True}):
            keymap.keymap_items.new("gizmogroup.gizmo_select", "F24", "PRESS", **held)
        return keymap

    def setup(self, context: bpy.types.Context) -> None:
        self.gizmos.new(REEB_PARTS_GT_hover.bl_idname)


register, unregister = bpy.utils.register_classes_factory((REEB_PARTS_GT_hover, REEB_PARTS_GGT_hover))

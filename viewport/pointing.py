# SPDX-License-Identifier: GPL-3.0-or-later
"""What lies under the pointer: a point of the graph, or a face of the mesh."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import bpy
import numpy as np
from bpy.app.translations import pgettext_rpt as rpt_
from bpy_extras import view3d_utils
from mathutils import Matrix, Vector
from mathutils.bvhtree import BVHTree
from numpy.typing import ArrayLike

from ..core.arrays.int64 import arange
from ..core.arrays.vectors import box_diagonal
from ..scene import store
from ..scene.errors import SceneError
from ..scene.graph import graph_finding, graph_follow
from ..scene.outputs.kept_aside import find_attribute
from ..scene.reading import mesh_arrays, seen_points
from ..scene.showing import selection
from .clipping import clip_planes, is_clipped
from .graph_lines import GraphLines, frontmost, nearest

if TYPE_CHECKING:
    from scipy.spatial import cKDTree

REACH = 10.0  # pixels around an arc, of a screen without scaling
ALIKE = 2.0  # so much nearer, arcs still cover each other
ON_SURFACE = 1e-4  # so near to the surface, as a share of its size, a place lies on it


def check_place(location: ArrayLike) -> None:
    """Raise SceneError unless a (3,) location, as a script may give it, is a place."""
    if not np.isfinite(location).all():
        raise SceneError(rpt_("The location is not finite. Give one on or beside the model."))


@dataclass(frozen=True, eq=False)
class Target:
    """A place on the model.

    Attributes
    ----------
    candidate : int
        The candidate part there.
    location : (3,) float64
        In the coordinates of the mesh, where it is seen; of the graph, where that is without modifiers.
    level : float
        Value of the field there.
    face : int
        Of the mesh; -1 on the graph.
    """

    candidate: int
    location: np.ndarray
    level: float
    face: int

    @property
    def on_graph(self) -> bool:
        return self.face < 0


class Model:
    """A decomposed object as the pointer meets it, read once; holds no Blender data.

    Raises
    ------
    SceneError
        There are no parts, or they are out of date.
    """

    def __init__(self, obj: bpy.types.Object) -> None:
        self.name = obj.name
        self.stored = store.load(obj.data)
        self.stretch = store.stretch_of(obj.data)
        self.lines = GraphLines.of(self.stored.decomposition, self.stretch)
        self.shown_lines = GraphLines.shown(self.stored, self.stretch).without(
            self.stored.shown, selection.hidden_parts(obj.data, self.stored.face_numbers))
        table = mesh_arrays.joined_table(obj.data, mesh_arrays.shown_points(obj))
        self.face_value = table.face_means(np.nan_to_num(self.stored.decomposition.field))
        # (p, 3) float64 each; of what is seen once ``look`` was called.
        self.face_center = table.face_means(table.vertices)
        self.face_normal = np.zeros_like(self.face_center)
        self._surface: SeenSurface | None = None  # the one that was looked at
        self._trees: dict[int, tuple[np.ndarray, cKDTree]] = {}

    def look(self, context: bpy.types.Context, obj: bpy.types.Object) -> SeenSurface:
        """The surface of the object as it is shown, on which ``face_center`` and all that is found by it are then."""
        surface = _surface_of(context, obj)
        if self._surface is not surface:
            self.face_center, self.face_normal = surface.face_center, surface.face_normal
            self._surface, self._trees = surface, {}
        return surface

    @property
    def numbers(self) -> np.ndarray:
        """(p,) int64, the part of each face."""
        return self.stored.face_numbers

    @property
    def tree(self) -> cKDTree:
        """Finds face centers; made when it is needed first."""
        return self._centers_of(0)[1]

    def _centers_of(self, part: int) -> tuple[np.ndarray, cKDTree]:
        """The faces of a part, those of all parts for 0, and what finds their centers."""
        from scipy.spatial import cKDTree

        if part not in self._trees:
            faces = np.flatnonzero(self.numbers == part) if part else arange(len(self.numbers))
            self._trees[part] = faces, cKDTree(self.face_center[faces])
        return self._trees[part]

    def _nearest_face(self, place: np.ndarray, part: int) -> int:
        """The face whose center is nearest to a (3,) place, of a part or, for 0, of all."""
        faces, tree = self._centers_of(part)
        return int(faces[tree.query(place)[1]])

    def number(self, target: Target) -> int:
        """The part that a target lies in."""
        return int(self.stored.shown[target.candidate])

    def at(self, obj: bpy.types.Object, location: Sequence[float], on_graph: bool) -> Target:
        """The place of the graph, or of the surface, nearest to a location in the world; SceneError if it is none.

        Of a graph without lines, as a ball may have, the place of the surface.
        """
        place = np.array(obj.matrix_world.inverted_safe() @ Vector(location), np.float64)
        check_place(place)
        if on_graph and len(self.lines.segments):
            segment, share, _ = nearest(self.lines.position, self.lines.segments, place)
            return _on_line(self.lines, segment, share)
        return self._on_face(self.face_at(obj, place), place)

    def face_at(self, obj: bpy.types.Object, place: ArrayLike) -> int:
        """The face that is nearest to a (3,) place, in coordinates of the mesh, as it is seen. Raises SceneError."""
        check_place(place)
        surface, place = self.look(bpy.context, obj), np.asarray(place, np.float64)
        _, _, face, distance = surface.tree.find_nearest(place.tolist())
        if face is not None and surface.n_faces == len(self.face_value):
            return face
        near = face is not None and distance <= ON_SURFACE * box_diagonal(self.face_center)
        return self._nearest_face(place, self._part_seen(obj, face) if near else 0)

    def _part_seen(self, obj: bpy.types.Object, face: int) -> int:
        """The part of a face that a modifier has made, which carries what that face did that it was made of; or 0."""
        seen = obj.evaluated_get(bpy.context.evaluated_depsgraph_get()).data
        attribute = find_attribute(seen, obj.data.reeb_parts.face_attribute, "INT", "FACE")
        if attribute is None:
            return 0
        number = attribute.data[face].value
        return number if (self.stored.shown == number).any() else 0

    def under(self, context: bpy.types.Context, obj: bpy.types.Object, region: bpy.types.Region,
              mouse: tuple[float, float], graph: bool = True, surface: bool = True) -> Target | None:
        """What is at a (2,) place of a region, in its pixels: of the graph first; None beside the model."""
        # Where the mesh was written within the event before, what Blender has evaluated is still of the mesh before.
        context.view_layer.update()
        target = self._graph_under(context, obj, region, mouse) if graph else None
        if target is not None or not surface:
            return target
        target = self.along(context, obj, *ray_of(region, mouse))
        if target is None or is_clipped(region.data, target.location[None], obj.matrix_world)[0]:
            return None
        return target

    def _graph_under(self, context: bpy.types.Context, obj: bpy.types.Object, region: bpy.types.Region,
                     mouse: tuple[float, float]) -> Target | None:
        arcs = graph_finding.arcs(obj)
        if arcs is None or not arcs.visible_get():
            return None
        _, places = graph_follow.places(obj)
        if places is None or len(places) != len(self.shown_lines.position):
            places = self.shown_lines.position
        points, scale = in_view(places, obj.matrix_world, region), context.preferences.system.ui_scale
        points[is_clipped(region.data, places, obj.matrix_world)] = np.nan
        segment, share, distance = frontmost(points, self.shown_lines.segments, np.array(mouse), ALIKE * scale)
        if segment < 0 or distance > REACH * scale:
            return None
        return _on_line(self.shown_lines, segment, share)

    def along(self, context: bpy.types.Context, obj: bpy.types.Object, start: ArrayLike,
              direction: ArrayLike) -> Target | None:
        """The place of the surface, as it is shown, that a ray meets first; (3,) float each, in the world."""
        back = obj.matrix_world.inverted_safe()
        ahead = back.to_3x3() @ Vector(direction)
        if not ahead.length:
            return None
        surface = self.look(context, obj)
        place = back @ Vector(_ahead_to(surface.box, obj.matrix_world, start, direction))
        location, _, face, _ = surface.tree.ray_cast(place, ahead)
        if face is None:
            return None
        location = np.array(location)
        if surface.n_faces != len(self.face_value):  # a modifier has made other faces
            face = self._nearest_face(location, self._part_seen(obj, face))
        return self._on_face(face, location)

    def _on_face(self, face: int, location: np.ndarray) -> Target:
        return Target(int(self.stored.decomposition.candidates[face]), location, float(self.face_value[face]), face)


@dataclass(frozen=True, eq=False)
class SeenSurface:
    """The surface of an object as it is shown, with its modifiers, ready for rays in the object's coordinates.

    Attributes
    ----------
    uid : int
        Of the object.
    points : (k, 3) float32
    box : (8, 3) float64
        The corners of the box around them.
    n_faces : int
    tree : BVHTree
    face_center, face_normal : (p, 3) float64
        Of the faces of the mesh itself, as they are seen.
    """

    uid: int
    points: np.ndarray
    box: np.ndarray
    n_faces: int
    tree: BVHTree
    face_center: np.ndarray
    face_normal: np.ndarray


_surfaces: list[SeenSurface] = []  # the last one


def _surface_of(context: bpy.types.Context, obj: bpy.types.Object) -> SeenSurface:
    """The surface of an object, read again only once its points have moved.

    Blender's own rays want a new tree whenever something was written to the mesh, be it the color of one face: of
    200,000 faces that takes 60 to 200 ms.
    """
    depsgraph = context.evaluated_depsgraph_get()
    seen = obj.evaluated_get(depsgraph).data
    points, n_faces = mesh_arrays.basis_points(seen), len(seen.polygons)
    if not _surfaces or (_surfaces[0].uid, _surfaces[0].n_faces) != (obj.session_uid, n_faces) or not np.array_equal(
            _surfaces[0].points, points):
        _surfaces.clear()
        tree = BVHTree.FromObject(obj, depsgraph)
        _surfaces.append(SeenSurface(obj.session_uid, points, _box_around(points), n_faces, tree,
                                     *seen_points.seen_faces(context, obj)))
    return _surfaces[0]


def _box_around(points: np.ndarray) -> np.ndarray:
    """The corners of the box around points, (k, 3): (8, 3) float64."""
    ends = np.array([points.min(axis=0, initial=np.inf), points.max(axis=0, initial=-np.inf)], np.float64)
    return np.stack(np.meshgrid(*ends.T), axis=-1).reshape(-1, 3)


def _ahead_to(box: np.ndarray, matrix: Matrix, start: ArrayLike, direction: ArrayLike) -> np.ndarray:
    """Where a ray comes near to a box, (8, 3) corners that a matrix takes to the world; all in the world, (3,) float64.

    Where it starts, if that is nearer: what follows is worked out in single precision.
    """
    start, direction = np.asarray(start, np.float64), np.asarray(direction, np.float64)
    whole = np.array(matrix, np.float64)
    height = (box @ whole[:3, :3].T + whole[:3, 3] - start) @ direction / (direction @ direction)
    before = height.min() - 0.1 * np.ptp(height)
    return start + max(before, 0.0) * direction if np.isfinite(before) else start


_models: list[tuple[tuple, Model]] = []  # the last one, with what it was read of


def model_of(obj: bpy.types.Object) -> Model:
    """What ``Model(obj)`` would be, read again only if the object or its parts have changed. Raises SceneError."""
    key = result_key(obj)
    if not _models or _models[0][0] != key or store.is_edited(obj.data):
        _models[:] = []
        _models[:] = [(key, Model(obj))]
    return _models[0][1]


def forget() -> None:
    """Free what is kept in memory."""
    _models.clear()
    _surfaces.clear()


def result_key(obj: bpy.types.Object) -> tuple:
    """Changes with the object, its mesh and its parts."""
    return obj.name, *store.state_of(obj.data)


def _on_line(lines: GraphLines, segment: int, share: float) -> Target:
    """The place some share along a segment of some lines."""
    low, high = lines.segments[segment]
    end = high if share > 0.5 else low
    blend = np.array([1.0 - share, share])
    return Target(int(lines.candidate[end]), blend @ lines.position[[low, high]],
                  float(blend @ lines.value[[low, high]]), -1)


def on_screen(positions: np.ndarray, matrix: Matrix, region: bpy.types.Region) -> np.ndarray:
    """Where points are seen, (m, 2) float64 in pixels of the region; nan behind the viewer."""
    return in_view(positions, matrix, region)[:, :2]


def in_view(positions: np.ndarray, matrix: Matrix, region: bpy.types.Region) -> np.ndarray:
    """Where points are seen, (m, 3) float64: in pixels of the region, and how deep; nan behind the viewer."""
    # Each region of a quad view has a view of its own.
    whole = np.array(region.data.perspective_matrix, np.float64) @ np.array(matrix, np.float64)
    seen = np.concatenate([positions, np.ones((len(positions), 1))], axis=1) @ whole.T
    seen = seen[:, :3] / np.where(seen[:, 3:] > 1e-9, seen[:, 3:], np.nan)
    seen[:, :2] = (seen[:, :2] + 1.0) * 0.5 * (region.width, region.height)
    return seen


def ray_of(region: bpy.types.Region, mouse: Sequence[float] | np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Where what is seen at a (2,) place of a region begins, in the world, and which way one looks there.

    Returns (3,) float64 each. A view without perspective begins as far away as it sees, a thousand meters, so that
    single precision would miss the faces of a model of a few millimeters.
    """
    view = region.data
    if view.is_perspective:
        start = np.array(view3d_utils.region_2d_to_origin_3d(region, view, mouse), np.float64)
        ahead = np.array(view3d_utils.region_2d_to_vector_3d(region, view, mouse), np.float64)
    else:
        # Where Blender's matrices take the middle of the depth that is seen, in the middle of the view, and its axes.
        across, up, deep, middle = np.linalg.inv(np.array(view.perspective_matrix, np.float64))[:3].T
        x, y = 2.0 * np.asarray(mouse, np.float64) / (region.width, region.height) - 1.0
        start, ahead = middle + x * across + y * up - deep, deep / np.linalg.norm(deep)
    into = 0.0
    for plane in clip_planes(view):
        height, rise = plane[:3] @ start + plane[3], plane[:3] @ ahead
        if height < 0.0 < rise:
            into = max(into, -height / rise)
    return start + into * ahead, ahead


def viewport_region(screen: bpy.types.Screen, x: int, y: int) -> tuple[bpy.types.Region, tuple[float, float]] | None:
    """The region of any viewport of a screen at a place of the window, as of ``view_region``."""
    for area in screen.areas:
        if area.type == "VIEW_3D" and 0 <= x - area.x < area.width and 0 <= y - area.y < area.height:
            return view_region(area, x, y)
    return None


def view_region(area: bpy.types.Area, x: int, y: int) -> tuple[bpy.types.Region, tuple[float, float]] | None:
    """The region of a viewport at a place of the window: (region, place in it), or None over a panel."""
    window = None
    for region in area.regions:
        place = x - region.x, y - region.y
        if 0 <= place[0] < region.width and 0 <= place[1] < region.height:
            if region.type != "WINDOW":
                return None
            window = region, place
    return window

# SPDX-License-Identifier: GPL-3.0-or-later
"""The truth about a piece: whether it is closed, crosses itself, looks outwards, and where it is thinnest."""

from __future__ import annotations

import json
from collections.abc import Iterator
from dataclasses import asdict, dataclass, fields

import bpy
import numpy as np
from mathutils.bvhtree import BVHTree

from ...core.arrays.indexing import renumbered, stable_order
from ...core.arrays.int64 import arange
from ...core.arrays.vectors import cross, lengths
from ...core.mesh.corners import CornerTable
from ...core.surface.reach import within_reach
from .. import transaction
from ..reading import mesh_arrays
from .closing import caps
from .closing.body_surface import crossing, search_tree

CHECK = "reeb_parts_check"  # on a piece: what was found, as JSON

# Of a mesh with more triangles only the caps are tried for crossings: all would take many seconds.
_MANY = 150_000
# At so many faces the thickness is measured.
_PLACES = 400


@dataclass(frozen=True)
class Check:
    """What is wrong with a mesh, as it is said in JSON.

    Attributes
    ----------
    open_edges : int
        Edges of one face only.
    branching_edges : int
        Edges of three faces or more.
    contrary_edges : int
        Edges of two faces of which one looks out and the other in.
    crossing_faces : int
        Faces that cross another one with which they have no corner in common.
    own_crossing_faces : int
        Those of them that no cap crosses: the model crosses itself there.
    all_tried : bool
        Whether all faces were tried for crossings; of large pieces it is those of caps only.
    inside_out : bool
        Whether a closed piece encloses less than nothing: its faces look inwards.
    volume : float or None
        In cubed units of the world; None unless the piece is closed and has no contrary edges.
    thinnest : float or None
        The smallest thickness that was measured, in units of the world; None if none was.
    """

    open_edges: int = 0
    branching_edges: int = 0
    contrary_edges: int = 0
    crossing_faces: int = 0
    own_crossing_faces: int = 0
    all_tried: bool = True
    inside_out: bool = False
    volume: float | None = None
    thinnest: float | None = None

    @property
    def sound(self) -> bool:
        """Whether a printer can use it."""
        return not (self.open_or_crossing or self.faces_wrong_way)

    @property
    def open_or_crossing(self) -> bool:
        """Whether it is not closed, or crosses itself."""
        return bool(self.open_edges or self.branching_edges or self.crossing_faces)

    @property
    def faces_wrong_way(self) -> bool:
        """Whether some faces look inwards, or all."""
        return bool(self.contrary_edges or self.inside_out)

    @property
    def as_model(self) -> bool:
        """Whether all that is wrong is so in the model, too: a cut that is closed leaves open what was open before."""
        return self.crossing_faces == self.own_crossing_faces and not self.inside_out

    def as_dict(self) -> dict:
        """For JSON."""
        return {"sound": self.sound, **asdict(self)}


@dataclass(frozen=True, eq=False)
class Faults:
    """Where something is wrong: masks of the faces of a mesh, (p,) bool each.

    Attributes
    ----------
    open, branching, contrary, crossing, thin : (p,) bool
        Faces at such edges, faces that cross others, and the face where the mesh is thinnest.
    """

    open: np.ndarray
    branching: np.ndarray
    contrary: np.ndarray
    crossing: np.ndarray
    thin: np.ndarray


def check(mesh: bpy.types.Mesh, stretch: np.ndarray) -> tuple[Check, Faults]:
    """Look for what is wrong with a mesh; not in Edit Mode.

    stretch : (3, 3), what the object does to its mesh, see bridge.world_stretch. Numbers are in units of the world.
    """
    points = mesh_arrays.basis_points(mesh).astype(np.float64) @ stretch.T
    triangles, face = mesh_arrays.triangles(mesh)
    n_faces = len(mesh.polygons)
    table = mesh_arrays.corner_table(mesh, points)
    open_, branching, contrary = _edge_faults(table)
    none = np.zeros(n_faces, bool)
    if not len(triangles):
        return Check(), Faults(none, none, none, none, none)
    a, b, c = (np.take(points, triangles[:, i], axis=0) for i in range(3))
    vector = cross(b - a, c - a)  # as long as twice the area
    places = _Places.of(points, triangles, vector)
    tried = _tried(mesh, face)
    near = arange(len(triangles))
    if not tried.all():
        near = np.flatnonzero(within_reach(points, triangles, tried, places.start, -places.out))
    tree = _tree(points, triangles[near])
    pairs = _crossing(tree, points, triangles, tried, near)
    crossed = _marked(n_faces, face[pairs])
    by_cap = _marked(n_faces, face[pairs[caps.is_cap(mesh)[face[pairs]].any(axis=1)]])
    thinnest, where = _thinnest(tree, places)
    volume = None
    if not (open_[0] or branching[0] or contrary[0]):
        volume = _enclosed(table)
    found = Check(open_[0], branching[0], contrary[0], int(crossed.sum()), int((crossed & ~by_cap).sum()),
                  bool(tried.all()), volume is not None and volume < 0, volume, thinnest)
    thin = _marked(n_faces, face[[where]] if thinnest is not None else np.empty(0, np.int64))
    return found, Faults(open_[1], branching[1], contrary[1], crossed, thin)


def keep(piece: bpy.types.Object, found: Check) -> None:
    """Keep with a piece what was found."""
    transaction.keep_keys(piece, CHECK)
    piece[CHECK] = json.dumps(asdict(found))


def kept(piece: bpy.types.Object) -> Check | None:
    """What was found, or None; None, too, if it was not written by us."""
    try:
        values = json.loads(piece[CHECK])
        own = {"own_crossing_faces": 0, "contrary_edges": 0, **values}  # files of before do not have them
        return Check(**{field.name: own[field.name] for field in fields(Check)})
    except (KeyError, ValueError, TypeError):
        return None


def _marked(count: int, indices: np.ndarray) -> np.ndarray:
    mask = np.zeros(count, bool)
    mask[indices] = True
    return mask


def _enclosed(table: CornerTable) -> float:
    """What closed faces enclose; each is taken for a fan around the mean of its corners.

    None of its corners is the first then. Booleans give faces another one, even those that they leave whole, and
    Blender folds a bent one along another diagonal then.
    """
    middles = table.face_means(table.vertices)
    return float(((middles - table.vertices.mean(axis=0)) * table.face_vectors()).sum() / 3)


def _edge_faults(table: CornerTable) -> Iterator[tuple[int, np.ndarray]]:
    """Edges of one face, of more than two, and contrary ones: how many, and which faces are there."""
    count = table.n_edge_faces
    for wrong in (count == 1, count > 2, table.contrary_edges()):
        yield int(wrong.sum()), _marked(table.n_faces, table.corner_face[wrong[table.corner_edge]])


def _tried(mesh: bpy.types.Mesh, face: np.ndarray) -> np.ndarray:
    """Which triangles are tried for crossings, (t,) bool."""
    if len(face) <= _MANY:
        return np.ones(len(face), bool)
    return caps.is_cap(mesh)[face]


def _tree(points: np.ndarray, triangles: np.ndarray) -> BVHTree:
    """A tree of some triangles."""
    used, place = renumbered(triangles) if len(triangles) < len(points) else (slice(None), triangles)
    return search_tree(points[used], place)


def _crossing(tree: BVHTree, points: np.ndarray, triangles: np.ndarray, tried: np.ndarray,
              near: np.ndarray) -> np.ndarray:
    """Pairs of triangles that cross, one of the two being tried; (k, 2) int64.

    near : (m,) int64, the triangles that the tree is of.
    """
    index = np.flatnonzero(tried)
    if not len(index):
        return np.empty((0, 2), np.int64)
    some = tree if tried.all() else _tree(points, triangles[index])
    pairs = crossing(some, tree, triangles[index], triangles[near])
    return np.stack([index[pairs[:, 0]], near[pairs[:, 1]]], axis=1)


@dataclass(frozen=True, eq=False)
class _Places:
    """Where the thickness is measured.

    Attributes
    ----------
    triangle : (k,) int64
    start : (k, 3) float64
        A little inside the middle of each.
    out : (k, 3) float64
        The direction it looks in, of length 1.
    depth : float
        How far inside.
    """

    triangle: np.ndarray
    start: np.ndarray
    out: np.ndarray
    depth: float

    @classmethod
    def of(cls, points: np.ndarray, triangles: np.ndarray, vector: np.ndarray) -> _Places:
        """Triangles of all sizes; vector : (t, 3), as long as twice the area."""
        area = lengths(vector)
        # Large triangles first: what is thin is thin over some area. Their bits are in the order of the areas.
        some = np.sort(stable_order(-area.view(np.int64))[:: max(len(area) // _PLACES, 1)][:_PLACES])
        some = some[area[some] > 0]
        out = vector[some] / area[some, None]
        depth = 1e-5 * float(np.linalg.norm([np.ptp(axis) for axis in points.T]))
        return cls(some, points[triangles[some]].mean(axis=1) - depth * out, out, depth)


def _thinnest(tree: BVHTree, places: _Places) -> tuple[float | None, int]:
    """The smallest distance from the middle of a triangle straight through to the other side, and that triangle.

    Only where the other side looks away: across an edge there is no thickness to measure.
    """
    thinnest, where = None, -1
    for index, place, out in zip(places.triangle.tolist(), places.start.tolist(), places.out.tolist(), strict=True):
        _, other, _, distance = tree.ray_cast(place, [-x for x in out])
        if other is None or -sum(x * y for x, y in zip(out, other, strict=True)) < 0.7:
            continue
        if thinnest is None or distance < thinnest:
            thinnest, where = distance + places.depth, index
    return thinnest, where

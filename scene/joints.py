# SPDX-License-Identifier: GPL-3.0-or-later
"""Joints between pieces: pegs and what they go into, dowels and holes for magnets, by Blender's own booleans.

Where they go and how large they are is found by core.uses.joint_places. Every result is checked: a cut whose joint
would leave a piece open, crossing itself or pierced stays without one.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterable
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import bpy
import numpy as np
from mathutils.bvhtree import BVHTree

from . import bridge, caps, mesh_arrays, piece_checks
from .steps import Steps, finished, stretched
from .temporary import removed
from .units import millimeters

if TYPE_CHECKING:
    from ..core.graph.reeb import ReebGraph
    from ..core.uses.joint_places import Cap, Joint, Places, Wanted
    from ..core.uses.joint_shapes import Solid
    from .settings import SeparateProperties

# Joints are at least so wide, in millimeters: what is smaller breaks off.
_LEAST = 2.0
# A joint that the solver fails at is tried again, so much smaller, and so often.
_AGAIN, _TRIES = 0.93, 2


@dataclass(frozen=True, eq=False)
class CutJoints:
    """What became of a cut between two pieces.

    Attributes
    ----------
    keys : (int, int)
        Of the pieces.
    kind : str
        What it was to have, of settings.JOINTS.
    count : int
        How many joints it has.
    width : float
        How wide they are, in millimeters.
    why : str
        Why there are none: "ROOM", "BENT", "BODY" or "RESULT", see operators.separate; "" where there are some, or
        where none were wanted.
    """

    keys: tuple[int, int]
    kind: str
    count: int
    width: float
    why: str


@dataclass(frozen=True, eq=False)
class Joined:
    """Pieces with joints.

    Attributes
    ----------
    meshes : dict of int -> bpy.types.Mesh
        By the keys of the pieces; those without joints are what they were.
    loose : list of bpy.types.Mesh
        Dowels, in their places.
    cuts : list of CutJoints
    """

    meshes: dict[int, bpy.types.Mesh]
    loose: list[bpy.types.Mesh]
    cuts: list[CutJoints]


def wanted_joints(style: SeparateProperties) -> Wanted:
    """What settings.SeparateProperties ask for, in units of the world."""
    from ..core.uses.joint_places import Wanted
    from ..core.uses.joint_shapes import Kind

    unit = millimeters()
    return Wanted(Kind(style.joints), style.joint_count, *(value / unit for value in (
        style.joint_clearance, style.joint_size, style.joint_depth, style.joint_wall, _LEAST)))


def join(context: bpy.types.Context, meshes: dict[int, bpy.types.Mesh], stretch: np.ndarray,
         wanted: Wanted, kind_of: Callable[[int, int], str] = lambda one, other: "",
         graph: ReebGraph | None = None) -> Joined:
    """Give pieces joints at the cuts between them; Object Mode.

    Parameters
    ----------
    context : bpy.types.Context
    meshes : dict of int -> bpy.types.Mesh
        Closed by caps. Those that get joints are removed, others take their places.
    stretch : (3, 3) float64
        What the object does to its mesh, see bridge.world_stretch.
    wanted : Wanted
    kind_of : callable(int, int) -> str
        The kind of joint between two pieces where it is another one, "NONE" for none; "" where it is not.
    graph : ReebGraph, optional
        Gives the axis where a cap is too bent to tell.

    Returns
    -------
    joined : Joined
    """
    return finished(joining(context, meshes, stretch, wanted, kind_of, graph))


def joining(context: bpy.types.Context, meshes: dict[int, bpy.types.Mesh], stretch: np.ndarray, wanted: Wanted,
            kind_of: Callable[[int, int], str], graph: ReebGraph | None) -> Steps[Joined]:
    """What ``join`` does, in steps."""
    from ..core.uses.joint_places import arc_direction, joint_places
    from ..core.uses.joint_shapes import Kind

    cuts = _cuts(meshes, stretch)
    keys = sorted({key for cut in cuts for key in cut.keys})
    checks = {key: piece_checks.check(meshes[key], stretch)[0] for key in keys}
    bodies = {key: _Body(meshes[key], stretch) for key, found in checks.items() if found.volume and found.volume > 0}
    planned: list[_Plan] = []
    for cut in sorted(cuts, key=lambda cut: -cut.cap.area()):
        yield 0.5 * len(planned) / len(cuts)
        kind = kind_of(*cut.keys) or wanted.kind.name
        own = replace(wanted, kind=Kind(kind)) if kind != "NONE" else None
        if own is None or not all(key in bodies for key in cut.keys):
            planned.append(_Plan(cut, own, None, "BODY" if own else "NONE"))
            continue
        # The smaller piece has the peg, the larger one has room for it.
        first = int(checks[cut.keys[0]].volume < checks[cut.keys[1]].volume)  # type: ignore[operator]
        pair = (_Side(bodies, cut, 0), _Side(bodies, cut, 1))
        along = arc_direction(graph, cut.cap.corners().mean(axis=(0, 1))) if graph is not None else None
        places = joint_places(cut.cap, pair, own, first, along)
        planned.append(_Plan(cut, own, places, "" if places.joints else "BENT" if places.bent else "ROOM"))
        for joint in places.joints:
            for side in (0, 1):
                if side == places.into or own.kind.both_sides:
                    bodies[cut.keys[side]].add_hole(_solid(joint, own, True))
    made, planned = yield from stretched(_fitting(_Work(context, meshes, checks, stretch), planned), 0.5, 1.0)
    for key, mesh in made.items():
        _spread_shape_keys(meshes[key], mesh)
        mesh.name = meshes[key].name
    bpy.data.batch_remove([meshes[key] for key in made])
    loose = [_dowel(joint, plan.wanted, bridge.unstretch(stretch)) for plan in planned
             if not plan.why and plan.places and plan.wanted and plan.wanted.kind is Kind.DOWEL
             for joint in plan.places.joints]
    return Joined({**meshes, **made}, loose, [plan.said() for plan in planned])


@dataclass(frozen=True, eq=False)
class _Cut:
    """A cap that two pieces share.

    Attributes
    ----------
    keys : (int, int)
        Of the pieces.
    cap : Cap
        In units of the world, looking from the first piece to the second.
    faces : ((k,), (k,)) int64
        In the two pieces.
    """

    keys: tuple[int, int]
    cap: Cap
    faces: tuple[np.ndarray, np.ndarray]


@dataclass(frozen=True, eq=False)
class _Plan:
    """What a cut is to have, or why it has nothing; tries : how often it has been made smaller."""

    cut: _Cut
    wanted: Wanted | None
    places: Places | None
    why: str
    tries: int = 0

    def smaller(self) -> _Plan:
        """The same with smaller joints, as a solver may stumble over one place; without, after so many times."""
        if self.tries >= _TRIES or self.places is None:
            return replace(self, why="RESULT")
        joints = tuple(replace(joint, radius=_AGAIN * joint.radius) for joint in self.places.joints)
        return replace(self, places=replace(self.places, joints=joints), tries=self.tries + 1)

    def said(self) -> CutJoints:
        joints = self.places.joints if self.places is not None and not self.why else ()
        width = 2 * joints[0].radius * millimeters() if joints else 0.0
        kind = self.wanted.kind.name if self.wanted is not None else "NONE"
        return CutJoints(self.cut.keys, kind, len(joints), width, "" if self.why == "NONE" else self.why)


def _cuts(meshes: dict[int, bpy.types.Mesh], stretch: np.ndarray) -> list[_Cut]:
    """What the pieces have in common: connected faces of caps with the same corners in two of them."""
    from ..core.surface.arrays import components
    from ..core.uses.joint_places import Cap

    keys = sorted(meshes)
    found = [_cap_faces(meshes[key]) for key in keys]
    corners = np.concatenate([points for _, points, _ in found]) if found else np.empty((0, 3), np.float32)
    if not len(corners):
        return []
    name = _names(corners, [place for _, _, place in found])
    piece = np.repeat(np.arange(len(keys)), [len(faces) for faces, _, _ in found])
    face = np.concatenate([faces for faces, _, _ in found])
    order = np.lexsort((piece, name))
    twice = np.flatnonzero((name[order][1:] == name[order][:-1]) & (piece[order][1:] != piece[order][:-1]))
    low, high = order[twice], order[twice + 1]
    cuts = []
    for a, b in np.unique(np.stack([piece[low], piece[high]], axis=1), axis=0).tolist():
        these = (piece[low] == a) & (piece[high] == b)
        one, other = face[low[these]], face[high[these]]
        sort = np.argsort(one)
        one, other = one[sort], other[sort]
        mesh = meshes[keys[a]]
        pairs, _ = mesh_arrays.corner_table(mesh).face_pairs()
        pairs = pairs[np.isin(pairs, one).all(axis=1)]
        count, label = components(len(one), *np.searchsorted(one, pairs).T)
        points = mesh_arrays.basis_points(mesh).astype(np.float64) @ stretch.T
        triangles, polygon = mesh_arrays.triangles(mesh)
        rims = points[_rims(triangles[np.isin(polygon, one)])]
        for index in range(count):
            mine = one[label == index]
            cap = Cap(points, triangles[np.isin(polygon, mine)], rims)
            cuts.append(_Cut((keys[a], keys[b]), cap, (mine, np.sort(other[label == index]))))
    return cuts


def _rims(triangles: np.ndarray) -> np.ndarray:
    """The edges of some triangles that one of them has, (s, 2)."""
    edges = np.sort(triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1)
    edges, count = np.unique(edges, axis=0, return_counts=True)
    return edges[count == 1]


def _cap_faces(mesh: bpy.types.Mesh) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """The faces of caps, the places of their corners, (c, 3) float32, and the face of each corner, from 0."""
    attribute = mesh.attributes.get(caps.CAP)
    if attribute is None:
        return np.empty(0, np.int64), np.empty((0, 3), np.float32), np.empty(0, np.int64)
    is_cap = mesh_arrays.read(attribute.data, "value", np.int32) == 1
    vertex, face = mesh_arrays.face_corners(mesh)
    here = is_cap[face]
    return np.flatnonzero(is_cap), mesh_arrays.basis_points(mesh)[vertex[here]], (np.cumsum(is_cap) - 1)[face[here]]


def _names(corners: np.ndarray, faces: list[np.ndarray]) -> np.ndarray:
    """A number for each face that faces with corners at the same places share, (f,) uint64."""
    place = _places(corners.astype(np.float64))
    # Sums of scattered numbers: those of different sets of places differ.
    scattered = np.random.default_rng(0).integers(0, 1 << 63, int(place.max()) + 1, dtype=np.uint64)
    count = [int(some.max(initial=-1)) + 1 for some in faces]
    start = np.cumsum([0, *count])
    face = np.concatenate([some + first for some, first in zip(faces, start, strict=False)])
    total = np.zeros(start[-1], np.uint64)
    np.add.at(total, face, scattered[place])
    return total


def _places(points: np.ndarray) -> np.ndarray:
    """A number for each place; points, (n, 3), that differ by rounding are at one."""
    from scipy.spatial import cKDTree

    from ..core.surface.arrays import components

    own, place = np.unique(points, axis=0, return_inverse=True)
    near = cKDTree(own).query_pairs(2e-6 * float(np.linalg.norm(np.ptp(own, axis=0))), output_type="ndarray")
    return components(len(own), *near.T)[1][place.ravel()]


class _Body:
    """The surface of a piece, for distances and for what is inside."""

    def __init__(self, mesh: bpy.types.Mesh, stretch: np.ndarray) -> None:
        self.points = mesh_arrays.basis_points(mesh).astype(np.float64) @ stretch.T
        self.triangles, self.polygon = mesh_arrays.triangles(mesh)
        attribute = mesh.attributes[caps.CAP]
        self.is_cap = (mesh_arrays.read(attribute.data, "value", np.int32) == 1)[self.polygon]
        self.whole, self.sides = self.tree(slice(None)), self.tree(~self.is_cap)
        self.holes: list[BVHTree] = []

    def add_hole(self, solid: Solid) -> None:
        """There will be a hole."""
        self.holes.append(BVHTree.FromPolygons(solid.points.tolist(), solid.faces))

    def tree(self, which: np.ndarray | slice) -> BVHTree:
        """The surface of some triangles."""
        triangles = self.triangles[which]
        return BVHTree.FromPolygons(self.points.tolist(), triangles.tolist(), all_triangles=True)


class _Side:
    """A piece as seen from one of its cuts: all of its surface but the cap of that cut; see joint_places.Body."""

    def __init__(self, bodies: dict[int, _Body], cut: _Cut, side: int) -> None:
        body = bodies[cut.keys[side]]
        self._whole = body.whole
        self._trees = [body.sides, *body.holes]
        others = body.is_cap & ~np.isin(body.polygon, cut.faces[side])
        if others.any():
            self._trees.append(body.tree(others))
        self._size = float(np.linalg.norm(np.ptp(body.points, axis=0)))

    def distance(self, points: np.ndarray) -> np.ndarray:
        return np.min([[tree.find_nearest(point)[3] or 0.0 for point in points.tolist()] for tree in self._trees],
                      axis=0, initial=np.inf) if len(points) else np.empty(0)

    def inside(self, points: np.ndarray) -> np.ndarray:
        return np.array([self._is_inside(point) for point in points.tolist()], bool)

    def _is_inside(self, point: list[float]) -> bool:
        # Directions that no mesh has for its own; most of the three are right.
        first, second, third = (0.287, 0.513, 0.809), (-0.743, 0.431, -0.512), (0.339, -0.871, 0.355)
        odd = self._crossings(point, first) % 2
        same = self._crossings(point, second) % 2 == odd
        return bool(odd if same else self._crossings(point, third) % 2)

    def _crossings(self, point: list[float], way: tuple[float, float, float]) -> int:
        count, step = 0, 1e-6 * self._size
        while True:
            place, _, _, _ = self._whole.ray_cast(point, way)
            if place is None or count > 1000:
                return count
            count += 1
            point = [x + step * d for x, d in zip(place, way, strict=True)]


@dataclass(frozen=True, eq=False)
class _Work:
    """What all steps of making joints need."""

    context: bpy.types.Context
    meshes: dict[int, bpy.types.Mesh]
    checks: dict[int, piece_checks.Check]
    stretch: np.ndarray


def _fitting(work: _Work, planned: list[_Plan]) -> Steps[tuple[dict[int, bpy.types.Mesh], list[_Plan]]]:
    """New meshes for the pieces with joints, and what was planned: smaller, or not at all, where it spoils a piece."""
    made: dict[int, bpy.types.Mesh] = {}
    again = {key for plan in planned if not plan.why for key in plan.cut.keys}
    every = len(again)
    while again:
        yield 1 - len(again) / every
        key = min(again)
        again.remove(key)
        if key in made:
            bpy.data.meshes.remove(made.pop(key))
        mine = [i for i, plan in enumerate(planned) if not plan.why and key in plan.cut.keys]
        if not mine:
            continue
        found = _with_joints(work, key, [planned[i] for i in mine])
        if found is not None:
            made[key] = found
            continue
        wrong = [i for i in mine if len(mine) == 1 or not _alone(work, key, planned[i])] or mine
        for i in wrong:
            planned[i] = planned[i].smaller()
            again |= set(planned[i].cut.keys)
    return made, planned


def _alone(work: _Work, key: int, plan: _Plan) -> bool:
    """Whether the joints of one cut leave a piece sound."""
    made = _with_joints(work, key, [plan])
    if made is None:
        return False
    bpy.data.meshes.remove(made)
    return True


def _with_joints(work: _Work, key: int, plans: Iterable[_Plan]) -> bpy.types.Mesh | None:
    """A piece with the joints of some of its cuts; None unless it is what it was but for these."""
    pegs, holes = [], []
    for plan in plans:
        assert plan.places is not None
        assert plan.wanted is not None
        receives = plan.cut.keys[plan.places.into] == key
        some = holes if receives or plan.wanted.kind.both_sides else pegs
        some += [(joint, plan.wanted, receives) for joint in plan.places.joints]
    solids = [([_solid(*one) for one in some], operation)
              for some, operation in ((pegs, "UNION"), (holes, "DIFFERENCE")) if some]
    more, less = (np.sum([_beyond(*one) for one in some] or [(0.0, 0.0)], axis=0) for some in (pegs, holes))
    # The solver takes some pieces for their outside; with more patience it does not.
    for patient in (False, True):
        made = _boolean(work.context, work.meshes[key], solids, bridge.unstretch(work.stretch), patient)
        if _is_fine(work, key, made, more[0] - less[1], more[1] - less[0]):
            return made
        bpy.data.meshes.remove(made)
    return None


def _is_fine(work: _Work, key: int, made: bpy.types.Mesh, least: float, most: float) -> bool:
    """Whether a piece with joints is as sound as it was, and larger by as much as it should be.

    It must have as many bodies as before, and no more tunnels; turned round, if the solver has taken its outside for
    its inside.
    """
    before = work.checks[key]
    assert before.volume is not None
    if _topology(made) != _topology(work.meshes[key]):
        return False
    found = piece_checks.check(made, work.stretch)[0]
    if found.volume is None or found.crossing_faces > before.crossing_faces:
        return False
    if found.volume < 0:
        made.flip_normals()
    slack = 1e-5 * before.volume
    return least - slack <= abs(found.volume) - before.volume <= most + slack


def _beyond(joint: Joint, wanted: Wanted, receives: bool) -> tuple[float, float]:
    """What of a joint lies on the other side of the cap, or on this one of a hole: at the least and at the most."""
    from ..core.uses.joint_shapes import volume_from

    clearance = wanted.clearance if receives or wanted.kind.both_sides else 0.0
    starts, end = (joint.high, joint.low), joint.high + joint.depth
    if wanted.kind.both_sides and not receives:
        starts, end = (-joint.low, -joint.high), joint.foot - joint.low
    least, most = (volume_from(wanted.kind, joint.radius, start, end, clearance) for start in starts)
    return least, most


def _topology(mesh: bpy.types.Mesh) -> tuple[int, int]:
    """How many bodies the faces of a mesh make, and its Euler characteristic."""
    from ..core.surface.arrays import components

    ends = mesh_arrays.edge_ends(mesh)
    count, _ = components(len(mesh.vertices), *ends.T)
    return count, len(mesh.vertices) - len(ends) + len(mesh.polygons)


def _dowel(joint: Joint, wanted: Wanted, to_mesh: np.ndarray) -> bpy.types.Mesh:
    """A dowel as a mesh, in its place."""
    made = replace(wanted, clearance=0.0)
    found = _solid(joint, made, True)
    mesh = bpy.data.meshes.new("Dowel")
    mesh.from_pydata((found.points @ to_mesh.T).tolist(), [], found.faces)
    return mesh


def _spread_shape_keys(mesh: bpy.types.Mesh, made: bpy.types.Mesh) -> None:
    """Give a mesh with joints the shape keys that it had without: each vertex moves as the nearest that there was."""
    keys = mesh.shape_keys
    if keys is None:
        return
    from scipy.spatial import cKDTree

    before, now = mesh_arrays.basis_points(mesh), mesh_arrays.basis_points(made)
    nearest = cKDTree(before).query(now)[1]
    holder = bpy.data.objects.new("Reeb Parts", made)
    with removed(bpy.data.objects, holder):
        for key in keys.key_blocks:
            new = holder.shape_key_add(name=key.name, from_mix=False)
            moved = now + (mesh_arrays.read(key.data, "co", np.float32, 3) - before)[nearest]
            new.data.foreach_set("co", moved.ravel())
            for name in ("slider_min", "slider_max", "value", "mute", "vertex_group", "interpolation"):
                setattr(new, name, getattr(key, name))
        for key in keys.key_blocks:
            made.shape_keys.key_blocks[key.name].relative_key = made.shape_keys.key_blocks[key.relative_key.name]
    made.shape_keys.use_relative = keys.use_relative


def _solid(joint: Joint, wanted: Wanted, hole: bool) -> Solid:
    """A peg, or what it goes into, in its place."""
    from ..core.uses.joint_shapes import solid

    hole = hole or wanted.kind.both_sides
    made = solid(wanted.kind, joint.radius, joint.low - joint.foot, joint.high + joint.depth,
                 wanted.clearance if hole else 0.0)
    return replace(made, points=joint.origin + made.points @ joint.axes)


def _boolean(context: bpy.types.Context, mesh: bpy.types.Mesh, tools: list[tuple[list[Solid], str]],
             to_mesh: np.ndarray, patient: bool) -> bpy.types.Mesh:
    """A mesh with solids added or taken away, which are caps.

    to_mesh : (3, 3), from the world to the mesh. patient : whether the solver is to expect crossings and holes.
    """
    material = Counter(mesh_arrays.read(mesh.polygons, "material_index", np.int32)[_is_cap(mesh)].tolist())
    index = material.most_common(1)[0][0] if material else 0
    base = bpy.data.objects.new("Reeb Parts", mesh)
    solids = [(bpy.data.objects.new("Reeb Parts", _tool(mesh, found, to_mesh, index)), operation)
              for found, operation in tools]
    with (removed(bpy.data.meshes, *(obj.data for obj, _ in solids)),
          removed(bpy.data.objects, base, *(obj for obj, _ in solids))):
        if mesh.shape_keys is not None:
            base.show_only_shape_key, base.active_shape_key_index = True, 0
        for obj in (base, *(obj for obj, _ in solids)):
            context.scene.collection.objects.link(obj)
        for obj, operation in solids:
            modifier = base.modifiers.new("Reeb Parts", "BOOLEAN")
            modifier.object, modifier.operation, modifier.solver = obj, operation, "EXACT"
            modifier.use_self = modifier.use_hole_tolerant = patient
        context.view_layer.update()
        depsgraph = context.evaluated_depsgraph_get()
        made = bpy.data.meshes.new_from_object(base.evaluated_get(depsgraph), preserve_all_data_layers=True,
                                               depsgraph=depsgraph)
    made.name = mesh.name
    return made


def _is_cap(mesh: bpy.types.Mesh) -> np.ndarray:
    return mesh_arrays.read(mesh.attributes[caps.CAP].data, "value", np.int32) == 1


def _tool(mesh: bpy.types.Mesh, solids: list[Solid], to_mesh: np.ndarray, material: int) -> bpy.types.Mesh:
    """A mesh of solids, with the materials of another mesh; all of it are caps."""
    made = bpy.data.meshes.new("Reeb Parts")
    start = np.cumsum([0, *(len(solid.points) for solid in solids)]).tolist()
    points = np.concatenate([solid.points for solid in solids]) @ to_mesh.T
    faces = [tuple(first + corner for corner in face)
             for solid, first in zip(solids, start, strict=False) for face in solid.faces]
    made.from_pydata(points.tolist(), [], faces)
    for slot in mesh.materials:
        made.materials.append(slot)
    made.polygons.foreach_set("material_index", np.full(len(faces), material, np.int32))
    made.attributes.new(caps.CAP, "INT", "FACE").data.foreach_set("value", np.ones(len(faces), np.int32))
    return made

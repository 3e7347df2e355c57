# SPDX-License-Identifier: GPL-3.0-or-later
"""Separated parts as rigid bodies of Blender's own simulation, with joints at the cuts."""

from __future__ import annotations

from collections.abc import Collection, Iterable
from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple

import bpy
import numpy as np
from mathutils import Matrix, Vector

from ...core.mesh.grounds import grounds_among
from .. import bridge, transaction
from ..ours import made_objects
from ..pieces import mesh_replacement, origins
from ..reading import mesh_arrays, placing
from ..result import part_names
from ..store import Stored

if TYPE_CHECKING:
    from ...core.uses.moving.body_joints import BodyJoints

#: How joints hold: the names of Blender's constraints.
KINDS = ("HINGE", "POINT", "FIXED")
# Blender solves the constraints of the whole world 10 times; so few let heavy parts sag away from light ones.
_ITERATIONS = 50
# Masses are as volumes, 1 kg on average, but within these: joints between much different ones are weak.
_LIGHTEST, _HEAVIEST = 0.1, 10.0
# How large joints are drawn: as a share of the diagonal of what is joined, those that hold nothing beside the others.
_DRAWN, _DRAWN_SMALLER = 0.05, 0.2


@dataclass(frozen=True, eq=False)
class RigidBodies:
    """What was made: bodies and joints, without those that only keep bodies from pushing each other away."""

    bodies: list[bpy.types.Object]
    joints: list[bpy.types.Object]


def make(context: bpy.types.Context, obj: bpy.types.Object, stored: Stored,
         pieces: dict[int, list[bpy.types.Object]], kind: str) -> RigidBodies:
    """Make rigid bodies of pieces, and joints at the cuts in place of earlier ones; Object Mode.

    A piece that is a rigid body already stays as it is, and so does the rigid body world if there is one. A floor or
    the like is a passive body, to which nothing is joined.

    Parameters
    ----------
    context : bpy.types.Context
    obj : bpy.types.Object
        That the pieces were separated from.
    stored : Stored
    pieces : dict of int -> list of bpy.types.Object
        By the number of their part.
    kind : str
        Of KINDS. A hinge bends about the longest line of the cut.

    Returns
    -------
    joined : RigidBodies
    """
    from ...core.uses.moving.body_joints import body_joints, overlapping  # imports SciPy
    from ...core.uses.moving.hulls import part_hulls

    collection = origins.make_collection(context, obj)
    numbered, shape = stored.shown_parts(), bridge.read_shape(obj)
    labels = numbered.parts.labels
    points = placing.transformed(mesh_arrays.shown_points(obj), placing.world_matrix(obj))
    table = mesh_arrays.joined_table(obj.data, points)
    ground = grounds_among(labels, shape.is_ground)
    hulls = [hull for (hull,) in part_hulls(table, labels)]
    found, overlaps = body_joints(table, labels, ground), overlapping(hulls)
    bodies = [pieces.get(number, []) for number in numbered.numbers.tolist()]
    site = _Site(_world(context), collection, _DRAWN * table.within(~ground[labels]).diagonal)
    _add_bodies(site, bodies, np.array([abs(hull.volume) for hull in hulls]), ground)
    wanted = [*_joints_at_cuts(site, bodies, found, kind), *_joints_within_parts(site, bodies)]
    holding_nothing = _joints_that_hold_nothing(site, bodies, overlaps[~ground[overlaps].any(axis=1)],
                                                found.pairs)
    earlier = remove_joints(obj, coming={_stands_for(joint) for joint in (*wanted, *holding_nothing)})
    joints, apart = ([_joint(site, joint) for joint in some] for some in (wanted, holding_nothing))
    for joint in (*joints, *apart):
        origins.claim(joint, obj)
    made_objects.mark([*joints, *apart])
    origins.hand_on(obj, earlier.gone, [(_stands_for(joint), joint) for joint in (*joints, *apart)])
    return RigidBodies([piece for some in bodies for piece in some], joints)


@dataclass(frozen=True, eq=False)
class _Site:
    """Where bodies and joints are made; size : of the empty of a joint, in units of the world."""

    physics: bpy.types.RigidBodyWorld
    collection: bpy.types.Collection
    size: float


#: The pieces of each part.
_Bodies = list[list[bpy.types.Object]]


class _Wanted(NamedTuple):
    """A joint that is to be made: of which kind, between which pieces, and where; size : of its empty."""

    kind: str
    ends: tuple[bpy.types.Object, bpy.types.Object]
    place: Matrix
    size: float

    @property
    def name(self) -> str:
        """What it is called, but for a number that Blender adds."""
        return part_names.fitted(" - ".join(end.name for end in self.ends))


def _add_bodies(site: _Site, bodies: _Bodies, volume: np.ndarray, ground: np.ndarray) -> None:
    """Make bodies of the pieces that are none. volume, ground : (count,), of the hull of each part; which are."""
    masses = (volume / max(volume[~ground].mean(), np.finfo(float).tiny)).clip(_LIGHTEST, _HEAVIEST).tolist()
    for some, mass, is_ground in zip(bodies, masses, ground.tolist(), strict=True):
        for piece in [piece for piece in some if piece.rigid_body is None]:
            _stand_upright(piece)
            _add_body(site.physics, piece, mass / len(some), is_ground)


def _joints_at_cuts(site: _Site, bodies: _Bodies, found: BodyJoints, kind: str) -> list[_Wanted]:
    """A joint for each cut between parts that both have pieces."""
    joints = []
    for (a, b), center, axis, hinge in zip(found.pairs.tolist(), found.center, found.axis, found.hinge, strict=True):
        if bodies[a] and bodies[b]:
            ends = _nearest(bodies[a], center), _nearest(bodies[b], center)
            joints.append(_Wanted(kind, ends, _place(center, axis, hinge), site.size))
    return joints


def _joints_within_parts(site: _Site, bodies: _Bodies) -> list[_Wanted]:
    """What was cut to fit the bed is held by the first piece of its part."""
    return [_Wanted("FIXED", (some[0], piece), _frame(piece), site.size)
            for some in bodies for piece in some[1:]]


def _joints_that_hold_nothing(site: _Site, bodies: _Bodies, overlaps: np.ndarray,
                              pairs: np.ndarray) -> list[_Wanted]:
    """Joints by which bodies that overlap at the start do not push each other away.

    overlaps, pairs : (k, 2) and (j, 2) int64, parts whose hulls overlap, and those that have joints.
    """
    held = {tuple(pair) for pair in pairs.tolist()}
    return [_Wanted("GENERIC", (one, other), _frame(one), _DRAWN_SMALLER * site.size)
            for a, b in overlaps.tolist() if (a, b) not in held for one in bodies[a] for other in bodies[b]]


def _world(context: bpy.types.Context) -> bpy.types.RigidBodyWorld:
    """The rigid body world of the scene, with collections for bodies and joints; made where it is not there."""
    scene = context.scene
    if scene.rigidbody_world is None:
        transaction.on_failure(bpy.ops.rigidbody.world_remove)
        bpy.ops.rigidbody.world_add()
    physics = scene.rigidbody_world
    for name, called in (("collection", "RigidBodyWorld"), ("constraints", "RigidBodyConstraints")):
        if getattr(physics, name) is None:  # Blender's own operators give them these names
            transaction.keep(physics, name)
            setattr(physics, name, bpy.data.collections.new(called))
    return physics


def _stand_upright(piece: bpy.types.Object) -> None:
    """Have the mesh of a piece carry what mirrors or shears it: Blender drops that of a body once it moves."""
    world = placing.world_matrix(piece)
    place, turn, scale = world.decompose()
    upright = Matrix.LocRotScale(place, turn, Vector(map(abs, scale)))
    is_sheared = not placing.is_alike(Matrix.LocRotScale(place, turn, scale), world)
    # Modifiers such as Mirror act along the axes of the mesh, of which a shear leaves none as it was.
    if placing.is_alike(upright, world) or piece.constraints or (is_sheared and piece.modifiers):
        return
    moved, mesh = upright.inverted_safe() @ world, piece.data.copy()
    placing.move(mesh, moved)
    mesh_replacement.replace(piece, mesh)
    transaction.keep(piece, "location", "rotation_euler", "rotation_quaternion", "rotation_axis_angle", "scale")
    for item in (piece, *piece.children):
        transaction.on_failure(setattr, item, "matrix_parent_inverse", item.matrix_parent_inverse.copy())
    for child in piece.children:
        child.matrix_parent_inverse = moved @ child.matrix_parent_inverse
    piece.matrix_parent_inverse = piece.matrix_parent_inverse @ piece.matrix_basis @ world.inverted_safe()
    piece.matrix_basis = upright


def _add_body(physics: bpy.types.RigidBodyWorld, piece: bpy.types.Object, mass: float, is_ground: bool) -> None:
    transaction.on_failure(_remove_body, physics.collection, piece)
    physics.collection.objects.link(piece)  # which makes it an active body
    body = piece.rigid_body
    body.type, body.collision_shape, body.mass = "ACTIVE", "CONVEX_HULL", mass
    if is_ground:  # what stands in a room is within its hull
        body.type, body.collision_shape = "PASSIVE", "MESH"


def _remove_body(bodies: bpy.types.Collection, piece: bpy.types.Object) -> None:
    if piece.name in bodies.objects:
        with bpy.context.temp_override(object=piece):
            bpy.ops.rigidbody.object_remove()


def _nearest(pieces: list[bpy.types.Object], place: np.ndarray) -> bpy.types.Object:
    """Of several pieces of a part, the one whose surface comes nearest to a place."""
    if len(pieces) == 1:
        return pieces[0]

    def distance(piece: bpy.types.Object) -> float:
        # In Edit Mode a mesh gives no points.
        own = np.array(piece.bound_box) if piece.data.is_editmode else mesh_arrays.basis_points(piece.data)
        points = placing.transformed(own, placing.world_matrix(piece))
        return float(np.linalg.norm(points - place, axis=1).min())

    return min(pieces, key=distance)


def _place(center: np.ndarray, axis: np.ndarray, hinge: np.ndarray) -> Matrix:
    """Where a joint is: x across the cut, z along the line that a hinge turns about."""
    place = Matrix.Identity(4)
    for column, vector in enumerate((axis, np.cross(hinge, axis), hinge, center)):
        place.col[column][:3] = vector.tolist()
    return place


def _frame(piece: bpy.types.Object) -> Matrix:
    """Where a piece is and how it is turned; not how it is mirrored, which an empty would drop like a body."""
    place, turn, _ = piece.matrix_world.decompose()
    return Matrix.LocRotScale(place, turn, None)


def _joint(site: _Site, wanted: _Wanted) -> bpy.types.Object:
    """An empty with a constraint between two bodies; one that is GENERIC holds nothing."""
    joint = bpy.data.objects.new(wanted.name, None)
    joint.matrix_world = wanted.place
    joint.empty_display_type, joint.empty_display_size = "ARROWS", wanted.size
    site.collection.objects.link(joint)
    site.physics.constraints.objects.link(joint)  # which makes it a constraint
    holds = joint.rigid_body_constraint
    holds.type, holds.object1, holds.object2 = wanted.kind, *wanted.ends
    holds.disable_collisions = True
    holds.use_override_solver_iterations, holds.solver_iterations = True, _ITERATIONS
    joint[made_objects.ROLE] = "joint"
    return joint


def remove_joints(obj: bpy.types.Object,
                  of: Iterable[bpy.types.Object] | None = None,
                  coming: Collection[str] = ()) -> made_objects.Earlier:
    """Remove joints of an object that the user has not worked on nor needs; they stand for what their names say.

    of : only those of these pieces. coming : what joints will be made now, see made_objects.needed.
    """
    joints = origins.made_of(obj, made_objects.ROLE)
    if of is not None:
        ends, held = set(of), [(joint, joint.rigid_body_constraint) for joint in joints]
        joints = [joint for joint, holds in held if holds is not None and {holds.object1, holds.object2} & ends]
    return made_objects.remove_untouched(joints, "joint", _former_looks, _stands_for, coming)


def _stands_for(joint: bpy.types.Object | _Wanted) -> str:
    """The two pieces, of which several joints may hold each other; see made_objects.StandsFor."""
    return part_names.without_number(joint.name)


def _former_looks(joint: bpy.types.Object) -> str:
    """What earlier versions kept of such an object; see made_objects.Former."""
    place = np.round(np.array(joint.matrix_basis), 5).tolist()
    holds = joint.rigid_body_constraint
    values = [] if holds is None else [
        round(value, 5) if isinstance(value, float) else value
        for name in sorted(holds.bl_rna.properties.keys()) if name not in ("rna_type", "object1", "object2")
        for value in [getattr(holds, name)]]
    return str([joint.name, joint.parent is not None, place, values])

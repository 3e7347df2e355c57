# SPDX-License-Identifier: GPL-3.0-or-later
"""The method: plan joints for all cuts, then fit them into the pieces."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING

import bpy
import numpy as np

from ...core.steps import Steps, stretched
from .. import bridge
from ..pieces import piece_checks
from ..reading import mesh_arrays
from ..reading.placing import millimeters
from ..temporary import removed
from .cuts import shared_cuts
from .fitting import Work, fitting
from .piece_surfaces import PieceSurface
from .planning import JointRoom, Plan, planning
from .solids import dowel

if TYPE_CHECKING:
    from ...core.graph.reeb import ReebGraph
    from ...core.uses.joints.room import Wanted
    from ..properties import SeparateProperties

# Joints are at least so wide, in millimeters: what is smaller breaks off.
_LEAST = 2.0


@dataclass(frozen=True, eq=False)
class CutJoints:
    """What became of a cut between two pieces.

    Attributes
    ----------
    keys : (int, int)
        Of the pieces.
    kind : str
        What it was to have, of properties.JOINTS.
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
class Dowel:
    """A dowel in its place. keys : (int, int), of the pieces that it goes into."""

    mesh: bpy.types.Mesh
    keys: tuple[int, int]


@dataclass(frozen=True, eq=False)
class JointedPieces:
    """Pieces with joints.

    Attributes
    ----------
    meshes : dict of int -> bpy.types.Mesh
        By the keys of the pieces; those without joints are what they were.
    loose : list of Dowel
    cuts : list of CutJoints
    """

    meshes: dict[int, bpy.types.Mesh]
    loose: list[Dowel]
    cuts: list[CutJoints]


def wanted_joints(style: SeparateProperties) -> Wanted:
    """What properties.SeparateProperties ask for, in units of the world."""
    from ...core.uses.joints.room import Wanted
    from ...core.uses.joints.shapes import Kind

    unit = millimeters()
    return Wanted(Kind(style.joints), style.joint_count, *(value / unit for value in (
        style.joint_clearance, style.joint_size, style.joint_depth, style.joint_wall, _LEAST)))


def joining(context: bpy.types.Context, meshes: dict[int, bpy.types.Mesh], stretch: np.ndarray, wanted: Wanted,
            kind_of: Callable[[int, int], str], graph: ReebGraph | None) -> Steps[JointedPieces]:
    """Give pieces joints at the cuts between them, in steps; Object Mode.

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
    graph : ReebGraph or None
        Gives the axis where a cap is too bent to tell.

    Returns
    -------
    joined : JointedPieces
    """
    cuts = shared_cuts(meshes, stretch)
    keys = sorted({key for cut in cuts for key in cut.keys})
    checks = {key: piece_checks.check(meshes[key], stretch)[0] for key in keys}
    volumes = {key: found.volume for key, found in checks.items() if found.volume and found.volume > 0}
    room = JointRoom({key: PieceSurface(meshes[key], stretch) for key in volumes}, volumes, graph)
    planned = yield from stretched(planning(cuts, room, wanted, kind_of), 0.0, 0.5)
    made, planned = yield from stretched(fitting(Work(context, meshes, checks, stretch), planned), 0.5, 1.0)
    for key, mesh in made.items():
        _spread_shape_keys(meshes[key], mesh)
        mesh.name = meshes[key].name
    bpy.data.batch_remove([meshes[key] for key in made])
    return JointedPieces({**meshes, **made}, _dowels(planned, stretch), [_said(plan) for plan in planned])


def _dowels(planned: list[Plan], stretch: np.ndarray) -> list[Dowel]:
    """The loose dowels of all cuts that have some."""
    from ...core.uses.joints.shapes import Kind

    return [Dowel(dowel(joint, plan.wanted, bridge.unstretch(stretch)), plan.cut.keys) for plan in planned
            if not plan.why and plan.places and plan.wanted and plan.wanted.kind is Kind.DOWEL
            for joint in plan.places.joints]


def _said(plan: Plan) -> CutJoints:
    """What became of a cut."""
    joints = plan.places.joints if plan.places is not None and not plan.why else ()
    width = 2 * joints[0].radius * millimeters() if joints else 0.0
    kind = plan.wanted.kind.name if plan.wanted is not None else "NONE"
    return CutJoints(plan.cut.keys, kind, len(joints), width, "" if plan.why == "NONE" else plan.why)


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
            moved = now + (mesh_arrays.key_points(key) - before)[nearest]
            mesh_arrays.set_key_points(new, moved)
            for name in ("slider_min", "slider_max", "value", "mute", "vertex_group", "interpolation"):
                setattr(new, name, getattr(key, name))
        for key in keys.key_blocks:
            made.shape_keys.key_blocks[key.name].relative_key = made.shape_keys.key_blocks[key.relative_key.name]
    made.shape_keys.use_relative = keys.use_relative

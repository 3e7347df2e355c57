# SPDX-License-Identifier: GPL-3.0-or-later
"""Joints put into pieces: every result is checked, and what spoils a piece is made smaller, or not at all."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import bpy
import numpy as np

from ...core.arrays.components import components
from ...core.steps import Steps
from .. import bridge
from ..pieces import piece_checks
from ..reading import mesh_arrays
from .planning import Plan
from .solids import solid_of, with_solids

if TYPE_CHECKING:
    from ...core.uses.joints.room import Joint, Wanted

# A joint that the solver fails at is tried again, so much smaller, and so often.
_AGAIN, _TRIES = 0.93, 2


@dataclass(frozen=True, eq=False)
class Work:
    """What all steps of making joints need."""

    context: bpy.types.Context
    meshes: dict[int, bpy.types.Mesh]
    checks: dict[int, piece_checks.Check]
    stretch: np.ndarray


def fitting(work: Work, planned: list[Plan]) -> Steps[tuple[dict[int, bpy.types.Mesh], list[Plan]]]:
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
            planned[i] = _smaller(planned[i])
            again |= set(planned[i].cut.keys)
    return made, planned


def _smaller(plan: Plan) -> Plan:
    """A plan with smaller joints, as a solver may stumble over one place; without joints after _TRIES times."""
    if plan.tries >= _TRIES or plan.places is None:
        return replace(plan, why="RESULT")
    joints = tuple(replace(joint, radius=_AGAIN * joint.radius) for joint in plan.places.joints)
    return replace(plan, places=replace(plan.places, joints=joints), tries=plan.tries + 1)


def _alone(work: Work, key: int, plan: Plan) -> bool:
    """Whether the joints of one cut leave a piece sound."""
    made = _with_joints(work, key, [plan])
    if made is None:
        return False
    bpy.data.meshes.remove(made)
    return True


def _with_joints(work: Work, key: int, plans: Iterable[Plan]) -> bpy.types.Mesh | None:
    """A piece with the joints of some of its cuts; None unless it is what it was but for these."""
    pegs, holes = [], []
    for plan in plans:
        assert plan.places is not None
        assert plan.wanted is not None
        receives = plan.cut.keys[plan.places.into] == key
        some = holes if receives or plan.wanted.kind.both_sides else pegs
        some += [(joint, plan.wanted, receives) for joint in plan.places.joints]
    solids = [([solid_of(*one) for one in some], operation)
              for some, operation in ((pegs, "UNION"), (holes, "DIFFERENCE")) if some]
    more, less = (np.sum([_beyond(*one) for one in some] or [(0.0, 0.0)], axis=0) for some in (pegs, holes))
    # The solver takes some pieces for their outside; with more patience it does not.
    for patient in (False, True):
        made = with_solids(work.context, work.meshes[key], solids, bridge.unstretch(work.stretch), patient)
        if _is_fine(work, key, made, more[0] - less[1], more[1] - less[0]):
            return made
        bpy.data.meshes.remove(made)
    return None


def _is_fine(work: Work, key: int, made: bpy.types.Mesh, least: float, most: float) -> bool:
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
    from ...core.uses.joints.shapes import volume_from

    clearance = wanted.clearance if receives or wanted.kind.both_sides else 0.0
    starts, end = (joint.high, joint.low), joint.high + joint.depth
    if wanted.kind.both_sides and not receives:
        starts, end = (-joint.low, -joint.high), joint.foot - joint.low
    least, most = (volume_from(wanted.kind, joint.radius, start, end, clearance) for start in starts)
    return least, most


def _topology(mesh: bpy.types.Mesh) -> tuple[int, int]:
    """How many bodies the faces of a mesh make, and its Euler characteristic."""
    ends = mesh_arrays.edge_ends(mesh)
    count, _ = components(len(mesh.vertices), *ends.T)
    return count, len(mesh.vertices) - len(ends) + len(mesh.polygons)

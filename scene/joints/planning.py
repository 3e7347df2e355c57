# SPDX-License-Identifier: GPL-3.0-or-later
"""What joints each cut is to have, and where: one cut after the other, as each leaves less room for the next."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from ...core.steps import Steps
from .cuts import Cut
from .piece_surfaces import PieceSurface, Side
from .solids import solid_of

if TYPE_CHECKING:
    from ...core.graph.reeb import ReebGraph
    from ...core.uses.joints.places import Places
    from ...core.uses.joints.room import Wanted


@dataclass(frozen=True, eq=False)
class Plan:
    """What a cut is to have, or why it has nothing; tries : how often it has been made smaller."""

    cut: Cut
    wanted: Wanted | None
    places: Places | None
    why: str
    tries: int = 0


@dataclass(frozen=True, eq=False)
class JointRoom:
    """What there is to put joints into.

    Attributes
    ----------
    surfaces : dict of int -> PieceSurface
        Of the closed pieces, by their keys.
    volumes : dict of int -> float
        Theirs.
    graph : ReebGraph or None
        Gives the axis where a cap is too bent to tell.
    """

    surfaces: dict[int, PieceSurface]
    volumes: dict[int, float]
    graph: ReebGraph | None


def planning(cuts: list[Cut], room: JointRoom, wanted: Wanted, kind_of: Callable[[int, int], str]) -> Steps[list[Plan]]:
    """Plan the joints of all cuts, those of the largest cap first; the surfaces of ``room`` get their holes."""
    planned: list[Plan] = []
    for cut in sorted(cuts, key=lambda cut: -cut.cap.area()):
        yield len(planned) / len(cuts)
        own = _wanted_at(cut, wanted, kind_of)
        if own is None:
            planned.append(Plan(cut, None, None, "NONE"))
        elif not all(key in room.surfaces for key in cut.keys):
            planned.append(Plan(cut, own, None, "BODY"))
        else:
            places = _places(cut, own, room)
            _keep_free_(room, cut, own, places)
            planned.append(Plan(cut, own, places, "" if places.joints else "BENT" if places.bent else "ROOM"))
    return planned


def _wanted_at(cut: Cut, wanted: Wanted, kind_of: Callable[[int, int], str]) -> Wanted | None:
    """What one cut is to have; None for no joints."""
    from ...core.uses.joints.shapes import Kind

    kind = kind_of(*cut.keys) or wanted.kind.name
    return replace(wanted, kind=Kind(kind)) if kind != "NONE" else None


def _places(cut: Cut, wanted: Wanted, room: JointRoom) -> Places:
    """Where the joints of a cut have room."""
    from ...core.uses.joints.cap import arc_direction
    from ...core.uses.joints.places import joint_places

    # The smaller piece has the peg, the larger one has room for it.
    first = int(room.volumes[cut.keys[0]] < room.volumes[cut.keys[1]])
    pair = (Side(room.surfaces, cut, 0), Side(room.surfaces, cut, 1))
    along = arc_direction(room.graph, cut.cap.corners().mean(axis=(0, 1))) if room.graph is not None else None
    return joint_places(cut.cap, pair, wanted, first, along)


def _keep_free_(room: JointRoom, cut: Cut, wanted: Wanted, places: Places) -> None:
    """Leave no room for other joints where those of a cut will have holes."""
    sides = (0, 1) if wanted.kind.both_sides else (places.into,)
    for joint in places.joints:
        for side in sides:
            room.surfaces[cut.keys[side]].add_hole(solid_of(joint, wanted, True))

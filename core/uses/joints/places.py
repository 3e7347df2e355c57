# SPDX-License-Identifier: GPL-3.0-or-later
"""Where two pieces can be joined across a cut: places for pegs that leave a wall around them, and their sizes."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...arrays.int64 import arange
from ...arrays.ties import rounded
from .cap import Cap, CapGrid, cap_axes
from .room import Body, Joint, Room, Wanted

# How often the deepest place is looked for between places.
_FINER = 3
# Of the inscribed width of the cut, the width of a joint that is as large as it likes to be; and the smaller sizes.
_SHARE, _SMALLER = 1 / 3, (1.0, 0.8, 0.64, 0.5, 0.4)


@dataclass(frozen=True, eq=False)
class Places:
    """The joints of a cut.

    Attributes
    ----------
    joints : tuple of Joint
        All of one size; none if there is no room.
    into : int
        The piece that receives them, 0 or 1.
    width : float
        The inscribed width of the cut.
    bent : bool
        Whether there are none because the cap has no axis.
    """

    joints: tuple[Joint, ...]
    into: int
    width: float
    bent: bool = False


def joint_places(cap: Cap, bodies: tuple[Body, Body], wanted: Wanted, first: int = 1,
                 along: np.ndarray | None = None) -> Places:
    """Find the places of joints: where there is most room, as large and as many as asked for, else fewer and smaller.

    Parameters
    ----------
    cap : Cap
    bodies : (Body, Body)
    wanted : Wanted
    first : int
        The piece that should receive the joints; if it cannot, the other does.
    along : (3,) float64, optional
        The axis, in either direction, where the cap is too bent to tell.

    Returns
    -------
    places : Places
    """
    frame = cap_axes(cap, along)
    if frame is None:
        return Places((), first, 0.0, bent=True)
    grid = CapGrid(cap, frame)
    room = Room(grid, bodies, wanted, *_candidates(grid, bodies))
    width = 2 * float(room.room.max(initial=0.0))
    radius = wanted.size / 2 if wanted.size else _SHARE * width / 2
    for count in range(wanted.count, 0, -1):
        for share in _SMALLER:
            if 2 * share * radius < wanted.least:
                break
            for into in (first, 1 - first):
                if found := room.joints(share * radius, into, count):
                    return Places(found, into, width)
    return Places((), first, width)


def _candidates(grid: CapGrid, bodies: tuple[Body, Body]) -> tuple[np.ndarray, np.ndarray]:
    """Places on the cap inside of both pieces, (k, 2), and how far the rims are; the deepest one first."""
    flat, step = grid.places()
    flat, room = _with_room(grid, bodies, np.concatenate([flat, np.zeros((1, 2))]))
    around = np.stack(np.meshgrid(*[arange(-2, 3)] * 2, indexing="ij"), axis=-1).reshape(-1, 2)
    for _ in range(_FINER):
        if not len(flat):
            break
        step /= 3
        finer, deeper = _with_room(grid, bodies, flat[rounded(room).argmax()] + step * around)
        flat, room = np.concatenate([finer, flat]), np.concatenate([deeper, room])
    order = np.argsort(-rounded(room), kind="stable")
    return flat[order], room[order]


def _with_room(grid: CapGrid, bodies: tuple[Body, Body], flat: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Those of some places that are on the cap and, beside it, inside of both pieces, and how far the rims are."""
    low, high = grid.heights(flat)
    on = np.isfinite(low)
    flat, low, high = flat[on], low[on], high[on]
    beside = 1e-3 * grid.size
    both = (bodies[0].inside(grid.world(flat, low - beside)) & bodies[1].inside(grid.world(flat, high + beside)))
    return flat[both], grid.depth(grid.world(flat[both], ((low + high) / 2)[both]))

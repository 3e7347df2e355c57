# SPDX-License-Identifier: GPL-3.0-or-later
"""How a cap is kept inside the model: pushed off the surface, led straight in from the rim, or along the surface."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np
from scipy.spatial import cKDTree

from ....core.arrays.int64 import arange
from ....core.uses.caps.surfaces import spread

if TYPE_CHECKING:
    from ....core.uses.caps.sleeves import Sleeve
    from .body_surface import BodySurface
    from .disc import Disc

# How often a surface that leaves the body is pushed back, and how near to the body's surface it may come, as a share
# of the distance from the curve.
_ROUNDS, _MARGIN = 10, 0.5
# Triangles are not pulled off if they cross more than so many, nor any more once that has not helped so many times in
# a row: of 537 surfaces of 153 models, those that came to cross nothing in the end had no more than one such time.
_HOPELESS, _IN_VAIN = 60, 3
# How far a cap goes straight in from the rim, at most, and how deep it lies under faces that it follows, as shares of
# the way through the body.
_STRAIGHT, _DEPTHS = 0.35, (0.35, 0.1)


def pushed(disc: Disc, curve: np.ndarray, body: BodySurface, side: float, held: np.ndarray | None = None) -> Disc:
    """The surface with the points that leave the body held a little inside it, and the others smooth between them.

    side : 1 if the faces of the body look outwards, -1 if they look inwards. held : (m,) bool, points that stay.
    """
    places = disc.places
    stays = np.zeros(len(places), bool) if held is None else held
    tried = np.flatnonzero(~stays)
    if not len(tried):
        return disc
    held = stays.copy()
    margin = _MARGIN * cKDTree(curve).query(places[tried])[0]
    for _ in range(_ROUNDS):
        on, normal = body.nearest(places[tried])
        out = side * ((places[tried] - on) * normal).sum(axis=1) > -0.5 * margin
        if not out.any():
            break
        places = places.copy()
        places[tried[out]] = on[out] - side * normal[out] * margin[out, None]
        held[tried[out]] = True
        places = _between(disc, curve, places, held)
    return replace(disc, places=places)


def _between(disc: Disc, curve: np.ndarray, places: np.ndarray, held: np.ndarray) -> np.ndarray:
    """The places with those that are not held smooth between the others."""
    fixed = np.concatenate([np.ones(len(curve), bool), held])
    return spread(disc.weights, np.concatenate([curve, places])[fixed], fixed)[len(curve) :]


def steep(disc: Disc, curve: np.ndarray, body: BodySurface, side: float) -> Disc:
    """The surface led straight into the body from its rim, where that is far from the faces on both sides; pulled off.

    Arguments as of ``pushed``.
    """
    beside, places = _led_in(disc, curve, body, side)
    return pulled(replace(disc, places=_between(disc, curve, places, beside)), curve, body, side, beside)


def _led_in(disc: Disc, curve: np.ndarray, body: BodySurface, side: float) -> tuple[np.ndarray, np.ndarray]:
    """Which points are next to the rim, (m,) bool, and all places, these ones straight in from the rim."""
    k = len(curve)
    of_rim = (disc.triangles < k).any(axis=1)
    beside = np.zeros(k + len(disc.places), bool)
    beside[disc.triangles[of_rim]] = True
    beside = np.flatnonzero(beside[k:])
    ahead = disc.following
    way = curve[ahead] - curve
    offset = disc.places[beside][:, None] - curve[None]
    along = ((offset * way).sum(axis=2) / np.maximum((way**2).sum(axis=1), 1e-300)).clip(0.0, 1.0)
    away = np.linalg.norm(offset - along[:, :, None] * way, axis=2)
    edge = away.argmin(axis=1)
    row = arange(len(edge))
    share, away = along[row, edge][:, None], away[row, edge]
    normal = np.where((body.own >= 0)[:, None], body.vertex_normals[body.own], 0.0)
    inwards = -side * ((1 - share) * normal[edge] + share * normal[ahead[edge]])
    length = np.linalg.norm(inwards, axis=1)
    known = (body.own[edge] >= 0) & (body.own[ahead[edge]] >= 0) & (length > 0.1)
    beside, share, away, edge = beside[known], share[known], away[known], edge[known]
    inwards = inwards[known] / length[known, None]
    foot = (1 - share) * curve[edge] + share * curve[ahead[edge]]
    room = body.free_way(foot, inwards, 1e-3 * float(np.median(away))) if len(foot) else away
    places = disc.places.copy()
    places[beside] = foot + inwards * np.minimum(away, _STRAIGHT * room)[:, None]
    held = np.zeros(len(places), bool)
    held[beside] = True
    return held, places


def pulled(disc: Disc, curve: np.ndarray, body: BodySurface, side: float, held: np.ndarray | None = None) -> Disc:
    """The surface with the triangles that cross the body pulled off the faces that they cross; the best of all tries.

    Arguments as of ``pushed``.
    """
    k, best, least, in_vain = len(curve), disc, 1 << 30, 0
    places, held = disc.places, np.zeros(len(disc.places), bool) if held is None else held
    for _ in range(_ROUNDS):
        with_body, within = body.crossings(np.concatenate([curve, places]), disc.triangles)
        in_vain += 1
        if len(with_body) + len(within) < least:
            best, least, in_vain = replace(disc, places=places), len(with_body) + len(within), 0
        if len(with_body) > _HOPELESS or in_vain == _IN_VAIN:
            break
        corner = disc.triangles[with_body[:, 0]].ravel() - k
        face = np.repeat(with_body[:, 1], 3)[corner >= 0]
        corner = corner[corner >= 0]
        normal = side * body.face_normals[face]
        height = ((places[corner] - body.points[body.triangles[face, 0]]) * normal).sum(axis=1)
        height += 0.5 * _MARGIN * cKDTree(curve).query(places[corner])[0] if len(corner) else 0.0
        if not (height > 0).any():
            break
        move, count = np.zeros_like(places), np.zeros(len(places))
        np.add.at(move, corner[height > 0], (-height[:, None] * normal)[height > 0])
        np.add.at(count, corner[height > 0], 1.0)
        places = places + move / np.maximum(count, 1.0)[:, None]
        held = held | (count > 0)
        places = _between(disc, curve, places, held)
    return best


def depths(sleeve: Sleeve, curve: np.ndarray, body: BodySurface,
           side: float) -> tuple[np.ndarray, np.ndarray, list[np.ndarray]]:
    """Vertices of a sleeve that are not on its curve, (j,) int64, where they are, and places under them, (j, 3) each.

    Half as deep as they are far from the curve, but at most such shares of the way through the body.
    """
    points = np.concatenate([body.points, body.points[sleeve.split].mean(axis=1)])
    normals = np.concatenate([body.vertex_normals, body.vertex_normals[sleeve.split].mean(axis=1)])
    vertex = np.setdiff1d(sleeve.triangles, body.own)
    on, inwards = points[vertex], -side * normals[vertex]
    away = cKDTree(curve).query(on)[0]
    room = np.full(len(points), np.inf)
    room[vertex] = body.free_way(on, inwards, 1e-3 * float(np.median(away))) if len(vertex) else 0.0
    # As deep as all around allow, so that what is under a dent does not come through beside it.
    least = room.copy()
    for i in range(3):
        np.minimum.at(least, sleeve.triangles[:, i], room[sleeve.triangles].min(axis=1))
    return vertex, on, [on + inwards * np.minimum(0.5 * away, share * least[vertex])[:, None] for share in _DEPTHS]

# SPDX-License-Identifier: GPL-3.0-or-later
"""Smooth curves along the borders between parts, found, judged, and chosen."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...arrays.components import components
from ...arrays.indexing import renumbered, stable_order
from ...mesh.corners import CornerTable
from ...steps import Steps, finished, stretched
from .band import Band
from .division import Division, divide
from .judging import judged
from .pins import Pins
from .shares import Diffusion
from .sides import Sides, sides_of

# How often shares are diffused, half an edge each time; where that goes wrong, as often as the next says.
STEPS = (10, 4, 2)
# Planes that are asked for may be so many edges away from the border.
REACH = 40


@dataclass(frozen=True, eq=False)
class CleanCuts:
    """Where faces are divided.

    Points have numbers: 0..n-1 are the vertices, n + e is the point on edge e.

    Attributes
    ----------
    edge : (k,) int64
        Edges that a curve crosses.
    share : (k,) float64
        Where, from the first vertex of the edge, 0, to the second, 1.
    face : (q,) int64
        Face of each fragment, rising; faces that neither are divided nor change their part have none.
    start : (q,) int64
        Point on the outline of the face at which the fragment begins, in the direction of the face's corners; it ends
        where the next fragment of the face begins. Two fragments are divided by a chord, three meet inside the face.
    label : (q,) int64
        Part of each fragment.
    odd : (o,) int64
        Faces of more than three corners that must be triangles before they can be divided; if there are any, divide
        these and ask again.
    planes : int
        Curves that lie in a plane.
    kept : int
        Groups of borders that stay along the edges of faces although they are not smooth, because a part would be
        lost or torn, because more than two faces meet at one of their edges, or because it was asked for.
    """

    edge: np.ndarray
    share: np.ndarray
    face: np.ndarray
    start: np.ndarray
    label: np.ndarray
    odd: np.ndarray
    planes: int = 0
    kept: int = 0


def clean_cuts(table: CornerTable, labels: np.ndarray, whole: np.ndarray | None = None,
               planar: bool = False) -> CleanCuts:
    """Find smooth curves along the borders between parts.

    Parameters
    ----------
    table : CornerTable
        n vertices, p faces. Any topology; borders where more than two faces meet at an edge are left alone.
    labels : (p,) int64
        Part of each face, 0 or more.
    whole : (e,) bool, optional
        Edges at which borders are to stay along edges, with all the borders that are connected with them.
    planar : bool
        Curves are to lie in planes wherever that tears no part, even if a plane is far from the border or the border
        follows a crease.

    Returns
    -------
    cuts : CleanCuts
        The same for any numbers of vertices and faces, but for rounding.

    Notes
    -----
    O(n) to find what lies near the borders; all else is for that only.
    """
    return finished(finding_cuts(table, labels, whole, planar))


def finding_cuts(table: CornerTable, labels: np.ndarray, whole: np.ndarray | None = None,
                 planar: bool = False) -> Steps[CleanCuts]:
    """What ``clean_cuts`` does, in steps."""
    band = Band.of(table, labels, (REACH if planar else max(STEPS)) + 2)
    if band is None:
        none = np.empty(0, np.int64)
        return CleanCuts(none, np.empty(0), none, none, none, none)
    taken = np.zeros(len(band.vertices), bool)
    failed = taken
    yield 0.05
    diffusion = Diffusion.of(band)
    yield 0.1
    found: list[CleanCuts] = []
    pins = Pins.of(band)
    low, high = band.edge_labels
    borders = np.unique(band.table.edges[low < high])
    tries = [(steps, pins, 0) for steps in STEPS]
    if planar:
        tries.insert(0, (max(STEPS), Pins.none(), REACH))
    for place, (steps, held, reach) in enumerate(tries):
        if taken[borders].all():
            break
        begin, end = (0.1 + 0.9 * (place + step) / len(tries) for step in (0, 1))
        sides = yield from stretched(sides_of(band, diffusion, held, steps, reach), begin, end)
        yield end
        division = divide(band, sides)
        yield end
        group, good, broken = judged(band, sides, division, reach > 0)
        if whole is not None:
            asked = group[band.table.edges[(low < high) & whole[band.edges]]]
            broken[asked], good[asked] = True, False
        # What is chosen must not come near a curve that has been chosen before.
        good[np.unique(group[taken & (group >= 0)])] = False
        used = (group >= 0) & good[group]
        found.append(_chosen(band, sides, division, used))
        taken |= used
        failed = (group >= 0) & broken[group] & ~taken
    return _together(band, found, failed)


def _chosen(band: Band, sides: Sides, division: Division, used: np.ndarray) -> CleanCuts:
    """What is divided around some vertices, (v,) bool, in numbers of the whole mesh."""
    vertex = np.concatenate([band.vertices, band.n_vertices + band.edges])
    inside = np.ones(len(band.faces), bool)
    inside[band.table.corner_face[~used[band.table.corner_vertex]]] = False
    begins = division.begins & (inside & division.concerned(band.labels))[division.face]
    edge = np.flatnonzero(~np.isnan(sides.share) & used[band.table.edges].all(axis=1))
    planes = np.unique(sides.plane[used & (sides.plane >= 0)])
    return CleanCuts(band.edges[edge], sides.share[edge], band.faces[division.face[begins]],
                     vertex[division.point[begins]], band.names[division.label[begins]],
                     band.faces[division.odd & inside], len(planes))


def _together(band: Band, found: list[CleanCuts], failed: np.ndarray) -> CleanCuts:
    """One answer of several, and how many groups of borders are at vertices that failed, (v,) bool."""
    low, high = band.edge_labels
    left = (low < high) & failed[band.table.edges].all(axis=1)
    _, vertex = renumbered(band.table.edges[left])
    kept = components(int(vertex.max(initial=-1)) + 1, vertex[:, 0], vertex[:, 1])[0] if left.any() else 0
    columns = {name: np.concatenate([getattr(one, name) for one in found])
               for name in ("edge", "share", "face", "start", "label", "odd")}
    order = stable_order(columns["face"])
    for name in ("face", "start", "label"):
        columns[name] = columns[name][order]
    return CleanCuts(**columns, planes=sum(one.planes for one in found), kept=kept)

# SPDX-License-Identifier: GPL-3.0-or-later
"""Pairs of parts that are near each other, and what they look like together.

Everything is relative to the whole: lengths to its diameter, areas to its area.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from ...arrays.indexing import last_of_each, run_starts
from ...arrays.int64 import arange, cumsum
from ...arrays.pairs import distinct_pairs, pair_keys
from ...arrays.ties import rounded
from ...arrays.vectors import middles_of_each
from ...mesh.triangles import TriMesh
from ...surface.contact import NEAR, SurfacePoints, diameter, near_pairs
from .part_shapes import PART, PartShapes

RADII = (0.004, 0.012, NEAR)  # within which surfaces are counted as touching, in units of the diameter
# Pairs of parts are looked at if either is among the MOST_NEAR that come nearest to the other, or as near. Where that
# would be more than MOST_PAIRS, it is fewer, but at least LEAST_NEAR. A blade of a lawn comes near hundreds of others;
# in 8 of 362 ordinary models a few pairs are more, and the parts of one of these change.
LEAST_NEAR, MOST_NEAR, MOST_PAIRS = 8, 48, 20_000
SLACK = 1e-3  # how much farther than the nearest two points others may be in a contact, in units of the diameter

#: Of a pair; in FEATURES those of its two parts follow, first of the smaller.
PAIR = ("same_piece", "salience", "distance", "gap", "near_small_1", "near_small_2", "near_small_3", "near_large_1",
        "near_large_2", "near_large_3", "elsewhere_small", "elsewhere_large", "inside_small", "inside_large",
        "normals", "agd_change", "log_ratio", "alike", "contact_spread", "contact_extent", "height")
# Properties of the whole model, such as its number of pieces, are left out: trees would recognize the training models
# by them.
FEATURES = (*PAIR, *(f"small_{n}" for n in PART), *(f"large_{n}" for n in PART))

#: Two parts each, (e,) int64 twice, to a number of each two, (e,) float64. There is no table of all: of thousands of
#: parts it would fill the memory.
Salience = Callable[[np.ndarray, np.ndarray], np.ndarray]


@dataclass(frozen=True, eq=False)
class PartPairs:
    """Pairs of parts that come near each other.

    Attributes
    ----------
    parts : (e, 2) int64
        The smaller index first.
    features : (e, len(FEATURES)) float64
    same_piece : (e,) bool
        Whether both lie in one piece.
    salience : (e,) float64
        Of the cut between them, 0..1; 1 between pieces.
    gap : (e,) float64
        Least distance of two points, in units of the diameter.
    faces : (e, 2) int64
        Faces of the mesh at these two points.
    shapes : PartShapes
        Of the c parts.
    """

    parts: np.ndarray
    features: np.ndarray
    same_piece: np.ndarray
    salience: np.ndarray
    gap: np.ndarray
    faces: np.ndarray
    shapes: PartShapes


def part_pairs(mesh: TriMesh, label: np.ndarray, salience: Salience, agd: np.ndarray) -> PartPairs:
    """Measure the pairs of parts that come nearer to each other than NEAR.

    Parameters
    ----------
    mesh : TriMesh
        m faces, n vertices; several pieces.
    label : (m,) int64
        Part of each face, 0..c-1; a part lies in one piece.
    salience : callable
        Of the cut between two parts of one piece; not asked of others.
    agd : (n,) float64
        Normalized, 0..1.

    Returns
    -------
    pairs : PartPairs
        Each pair once, with its FEATURES.
    """
    points = SurfacePoints.of(mesh, label)
    size = diameter(points.position, points.area)
    points = replace(points, position=points.position / size, area=points.area / points.area.sum() + 1e-12)
    shapes = PartShapes.of(mesh, label, points, agd)
    part, area, count = label[points.face], shapes.area, len(shapes.area)
    near = _Nearness.of(points, part)
    of_part = shapes.columns(touched=np.bincount(part, points.area * near.touching(), count) / area)
    near = near.of_neighbors(count)
    swap = area[near.parts[:, 0]] > area[near.parts[:, 1]]
    small, large = np.where(swap[:, None], near.parts[:, ::-1], near.parts).T
    same = shapes.piece[small] == shapes.piece[large]
    nearest, gap = near.nearest()
    cut = cut_between(salience, small, large, same)
    columns = {
        "same_piece": same, "salience": cut,
        "distance": np.linalg.norm(shapes.center[small] - shapes.center[large], axis=1), "gap": gap,
        **_share_columns(near, area, swap, of_part["touched"][small], of_part["touched"][large]),
        "inside_small": shapes.outside(small, large), "inside_large": shapes.outside(large, small),
        "agd_change": np.abs(shapes.agd[small] - shapes.agd[large]), "log_ratio": np.log(area[large] / area[small]),
        "alike": shapes.unlikeness(small, large),
        **_contact_columns(near, mesh.face_normals[points.face], agd[points.vertex], gap, area[small]),
        **{f"small_{n}": of_part[n][small] for n in PART}, **{f"large_{n}": of_part[n][large] for n in PART},
    }
    features = np.stack([columns[n] for n in FEATURES], axis=1).astype(float)
    return PartPairs(near.parts, features, same, cut, gap, points.face[nearest], shapes)


def unseen_neighbors(mesh: TriMesh, label: np.ndarray, seen: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Find the parts that share an edge and are not among some pairs, as where faces are larger than NEAR.

    Parameters
    ----------
    mesh : TriMesh
        m faces.
    label : (m,) int64
        Part of each face, 0..c-1.
    seen : (e, 2) int64
        Pairs of parts, the smaller index first.

    Returns
    -------
    parts : (k, 2) int64
        Each pair once, the smaller index first.
    faces : (k, 2) int64
        Of each pair a face of either that share an edge.
    """
    at_edge = label[mesh.edges.pairs]
    apart = np.flatnonzero(at_edge[:, 0] != at_edge[:, 1])
    parts, row = distinct_pairs(*np.sort(at_edge[apart], axis=1).T)
    edge = apart[last_of_each(row, -arange(len(row)), count=len(parts))]
    count = int(label.max()) + 1
    unseen = ~np.isin(pair_keys(parts, count), pair_keys(seen, count))
    return parts[unseen], mesh.edges.pairs[edge[unseen]]


def cut_between(salience: Salience, first: np.ndarray, second: np.ndarray, same_piece: np.ndarray) -> np.ndarray:
    """Salience of the cut between parts, (e,) float64: 1 between pieces. same_piece : (e,) bool."""
    cut = np.ones(len(same_piece))
    cut[same_piece] = salience(first[same_piece], second[same_piece])
    return cut


@dataclass(frozen=True, eq=False)
class _Nearness:
    """Where parts come near each other.

    Attributes
    ----------
    points : SurfacePoints
        In units of the diameter.
    parts : (e, 2) int64
        Pairs of parts, the smaller index first.
    ends : (k, 2) int64
        A point of one part, and the nearest point of the other.
    row : (k,) int64
        Their pair of parts.
    first : (k,) bool
        Whether the point lies in the first part of the pair.
    distance : (k,) float64
    """

    points: SurfacePoints
    parts: np.ndarray
    ends: np.ndarray
    row: np.ndarray
    first: np.ndarray
    distance: np.ndarray

    @classmethod
    def of(cls, points: SurfacePoints, label: np.ndarray) -> _Nearness:
        """label : (s,) int64, part of each point."""
        ends, distance = near_pairs(points, label, NEAR)
        parts, row = distinct_pairs(*np.sort(label[ends], axis=1).T)
        return cls(points, parts, ends, row, label[ends[:, 0]] == parts[row, 0], distance)

    def touching(self) -> np.ndarray:
        """(s,) bool, which points are near another part."""
        near = np.zeros(len(self.points.face), bool)
        near[self.ends[self.distance <= RADII[1], 0]] = True
        return near

    def nearest(self) -> tuple[np.ndarray, np.ndarray]:
        """The two nearest points of each pair of parts, (e, 2) int64, and their distance, (e,) float64."""
        k = last_of_each(self.row, -self.distance, -arange(len(self.row)), count=len(self.parts))
        return self.ends[k], self.distance[k]

    def of_neighbors(self, count: int) -> _Nearness:
        """The pairs of which either part is among those that come nearest to the other, of ``count`` parts."""
        most = max(LEAST_NEAR, MOST_PAIRS // count)
        gap, part = rounded(self.nearest()[1]), self.parts.T.ravel()
        order = np.lexsort((np.tile(gap, 2), part))
        start = run_starts(part[order])
        of_each = np.diff(start, append=len(part))
        farthest = order[start + np.minimum(of_each, min(most, MOST_NEAR)) - 1] % len(gap)
        rank = arange(len(part)) - np.repeat(start, of_each)
        row = order % len(gap)
        kept = np.zeros(len(gap), bool)
        kept[row[(gap[row] <= np.repeat(gap[farthest], of_each)) & (rank < most)]] = True
        ends = kept[self.row]
        return _Nearness(self.points, self.parts[kept], self.ends[ends], (cumsum(kept) - 1)[self.row[ends]],
                         self.first[ends], self.distance[ends])

    def share(self, area: np.ndarray) -> np.ndarray:
        """(e, 2, len(RADII)) float64, share of each of the two parts within the radii of the other."""
        share = np.zeros((len(self.parts), 2, len(RADII)))
        for k, radius in enumerate(RADII):
            for side, mine in enumerate((self.first, ~self.first)):
                rows = mine & (self.distance <= radius)
                share[:, side, k] = np.bincount(
                    self.row[rows], self.points.area[self.ends[rows, 0]], len(self.parts)) / area[self.parts[:, side]]
        return np.minimum(share, 1.0)


def _share_columns(
    near: _Nearness, area: np.ndarray, swap: np.ndarray, touched_small: np.ndarray, touched_large: np.ndarray
) -> dict[str, np.ndarray]:
    """How much of a part is near the other, and how much touches anything but the other.

    area : (c,) of each part. swap, touched_small, touched_large : (e,), whether the second part of a pair is the
    smaller, and how much of either touches anything.
    """
    share = near.share(area)
    small, large = np.where(swap[:, None, None], share[:, ::-1], share).transpose(1, 2, 0)
    return {**{f"near_small_{k + 1}": small[k] for k in range(len(RADII))},
            **{f"near_large_{k + 1}": large[k] for k in range(len(RADII))},
            "elsewhere_small": touched_small - small[1], "elsewhere_large": touched_large - large[1]}


def _contact_columns(
    near: _Nearness, normal: np.ndarray, level: np.ndarray, gap: np.ndarray, area_small: np.ndarray
) -> dict[str, np.ndarray]:
    """What the place is like where two parts touch, or come nearest.

    normal, level : (s, 3) and (s,), of each point. gap, area_small : (e,), of each pair.
    """
    row, count, position = near.row, len(near.parts), near.points.position
    point, other = near.ends.T
    contact = near.distance <= np.maximum(RADII[1], gap[row] + SLACK)
    weight = near.points.area[point] * contact + 1e-300
    total, middle = middles_of_each(row, position[point], weight, count)
    spread = np.sqrt(np.maximum(np.bincount(
        row, weight * ((position[point] - middle[row]) ** 2).sum(axis=1), count) / total, 0))
    return {"normals": np.bincount(row, weight * (normal[point] * normal[other]).sum(axis=1), count) / total,
            "contact_spread": spread, "contact_extent": spread / np.sqrt(area_small),
            "height": np.bincount(row, weight * level[point], count) / total}

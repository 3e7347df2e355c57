# SPDX-License-Identifier: GPL-3.0-or-later
"""Where the pieces of a surface touch each other, or nearly so, though they share no edge.

A piece here is a connected component of the faces: a sleeve, an eye, a wheel. Contact is measured between points
spread over the surface, the vertices and the centroids of the faces.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.spatial import cKDTree

from ..arrays.components import components
from ..arrays.indexing import is_last_of_each, last_of_each, sums_by
from ..arrays.int64 import arange
from ..arrays.pairs import both_ways, distinct_pairs
from ..arrays.ties import TIE, first_least
from ..arrays.vectors import weighted_sum
from ..mesh.triangles import TriMesh

# In units of the diameter of a surface: how near two pieces must come to touch, how near to belong to one body, and
# how much farther from each other than the nearest two points of two pieces other points may be to be linked.
TOUCH, NEAR, SLACK = 0.01, 0.03, 0.005
# A surface is a scene of several things if none of them is as long as this share of it, and if they have so many faces,
# the mean: the leaves of a hedge are no scene. Things are of pieces that come nearer to each other than a share of the
# diameter of both together; of a scene so many points are taken.
LONGEST, FACES_OF_A_THING, NEAR_OF_THINGS, POINTS_OF_SCENE = 1 / 3, 10, 0.06, 80_000
CROWD = 1_000  # pieces; of so many, those that touch are looked for first
MAX_POINTS = 8_000  # of a denser surface so many are taken
# Pairs of points near each other that are looked at one by one, and how many more for each label that would be
# searched otherwise.
MAX_PAIRS, MORE_PAIRS = 2_000_000, 1_000
COUNTED = 400  # points around which it is counted how many others are near
EQUALLY_NEAR = 8  # points that are looked at of each label, where as many are equally near
FEW_LABELS = 24  # up to so many it is faster to search the nearest of each than to look at all pairs of points
FAR_POINTS = 1_500  # to look farther than NEAR, where all pairs of points are compared in the end
# Of links from which on pieces that hang together are one to those who look farther: between thousands of pieces there
# would be eight times as many twice as far away, nearly all of them between two that hang together by others.
MANY_LINKS = 30_000


@dataclass(frozen=True, eq=False)
class SurfacePoints:
    """Points of a surface that stand for it.

    Attributes
    ----------
    position : (s, 3) float64
    face, vertex : (s,) int64
        A face that each point lies on, and the nearest corner of that face.
    area : (s,) float64
        That each point stands for; they sum to the area of the surface.
    """

    position: np.ndarray
    face: np.ndarray
    vertex: np.ndarray
    area: np.ndarray

    @classmethod
    def of(cls, mesh: TriMesh, group: np.ndarray, count: int = MAX_POINTS) -> SurfacePoints:
        """Vertices and face centroids of a mesh, of which each vertex is of a face; all, or ``count`` and some more.

        group : (m,) int64. Of each face, 0 or more; the middle of the largest face of each group is always taken.
        """
        face_at = np.empty(mesh.n_vertices, np.int64)
        face_at[mesh.faces[::-1]] = arange(mesh.n_faces)[::-1, None]
        corners = np.sort(mesh.faces, axis=1)  # of equally near ones the first vertex, whichever way the face turns
        offset = np.linalg.norm(mesh.vertices[corners] - mesh.face_centroids[:, None], axis=2)
        nearest = corners[arange(mesh.n_faces), first_least(offset)]
        points = cls(
            np.concatenate([mesh.vertices, mesh.face_centroids]),
            np.concatenate([face_at, arange(mesh.n_faces)]),
            np.concatenate([arange(mesh.n_vertices), nearest]),
            np.concatenate([mesh.vertex_area, mesh.face_area]) / 2)
        largest = np.flatnonzero(is_last_of_each(
            group, mesh.face_area, -arange(mesh.n_faces), count=int(group.max()) + 1))
        return points.some(count, mesh.n_vertices + largest)

    def some(self, count: int, always: np.ndarray) -> SurfacePoints:
        """About so many of the points, evenly spread over their order, and some that are always taken."""
        if len(self.face) <= count:
            return self
        chosen = np.union1d(np.linspace(0, len(self.face) - 1, count).astype(np.int64), always)
        area = self.area[chosen]
        return SurfacePoints(self.position[chosen], self.face[chosen], self.vertex[chosen],
                             area * self.area.sum() / area.sum())


def diameter(position: np.ndarray, area: np.ndarray) -> float:
    """Length of a rod that is spread as far about its middle as some points of a surface, (s, 3) and (s,)."""
    middle = weighted_sum(area, position) / area.sum()
    return float(_rod_length(weighted_sum(area, ((position - middle) ** 2).sum(axis=1)) / area.sum()))


def _rod_length(spread: np.ndarray) -> np.ndarray:
    """Lengths of rods, by the mean square of the distance of their points from the middle; (k,) float64 or one."""
    return np.sqrt(12.0 * spread)


def near_pairs(points: SurfacePoints, label: np.ndarray, radius: float) -> tuple[np.ndarray, np.ndarray]:
    """For every point and every other label nearby, the nearest point of that label.

    Parameters
    ----------
    points : SurfacePoints
    label : (s,) int64
        0 or more.
    radius : float
        How far to look.

    Returns
    -------
    pairs : (k, 2) int64
        A point, and the nearest one of another label.
    distance : (k,) float64
    """
    found = _near_points(points.position, label, radius)
    distance = np.sqrt(sum((at[found[:, 0]] - at[found[:, 1]]) ** 2 for at in points.position.T.copy()))
    cells, cell = distinct_pairs(found[:, 0], label[found[:, 1]])
    nearest = last_of_each(cell, -distance, -found[:, 1], count=len(cells))
    return found[nearest], distance[nearest]


def _near_points(position: np.ndarray, label: np.ndarray, radius: float) -> np.ndarray:
    """Pairs (k, 2) int64 of points of different labels, with the nearest of each other label within the radius."""
    n_labels = np.count_nonzero(np.bincount(label))
    if n_labels <= FEW_LABELS:
        return _nearest_of_each_label(position, label, radius)
    tree = cKDTree(position)
    every = max(len(position) // COUNTED, 1)  # to count all takes longer than to find them
    n_pairs = every * tree.query_ball_point(position[::every], radius, return_length=True).sum()
    if n_pairs > MAX_PAIRS + MORE_PAIRS * n_labels:
        return _nearest_of_each_label(position, label, radius)
    found = tree.query_pairs(radius, output_type="ndarray")
    found = found[label[found[:, 0]] != label[found[:, 1]]]
    return both_ways(found).astype(np.int64)


def _nearest_of_each_label(position: np.ndarray, label: np.ndarray, radius: float) -> np.ndarray:
    """Pairs (k, 2) int64 of a point and the nearest of another label, one label after the other.

    Faster than looking at all pairs of points where there are few labels, or thousands of points within the radius of
    each. Of points that are equally near there are all, up to EQUALLY_NEAR: the search must not choose among them.
    """
    found = [np.empty((0, 2), np.int64)]
    order = np.argsort(label, kind="stable")
    # Of thousands of labels most lie in a small part of what is longest.
    longest = np.ptp(position, axis=0).argmax()
    along = np.argsort(position[:, longest], kind="stable")
    sorted_along = position[along, longest]
    for mine in np.split(order, np.flatnonzero(np.diff(label[order])) + 1):
        low, high = position[mine].min(axis=0) - radius, position[mine].max(axis=0) + radius
        begin, end = np.searchsorted(sorted_along, low[longest]), np.searchsorted(sorted_along, high[longest], "right")
        others = along[begin:end]
        there = position[others]
        others = others[((there >= low) & (there <= high)).all(axis=1) & (label[others] != label[mine[0]])]
        search = cKDTree(position[mine])
        for count in (2, EQUALLY_NEAR):  # most have no second that is as near as the first
            distance, nearest = search.query(  # up to and with the radius
                position[others], k=count, distance_upper_bound=np.nextafter(radius, np.inf))
            other, rank = np.nonzero(np.isfinite(distance) & (distance <= (1 + TIE) * distance[:, :1]))
            found.append(np.stack([others[other], mine[nearest[other, rank]]], axis=1))
            others = others[other[rank == count - 1]]
    return np.concatenate(found)


@dataclass(frozen=True, eq=False)
class Bridges:
    """Links between the pieces of a surface.

    Attributes
    ----------
    vertices : (l, 2) int64
        Vertices of different pieces that a straight line joins.
    faces : (l, 2) int64
        A face at each of them.
    """

    vertices: np.ndarray
    faces: np.ndarray

    @classmethod
    def none(cls) -> Bridges:
        """No links."""
        return cls(np.empty((0, 2), np.int64), np.empty((0, 2), np.int64))

    def with_more(self, others: Bridges) -> Bridges:
        """These links and others after them."""
        return Bridges(np.concatenate([self.vertices, others.vertices]), np.concatenate([self.faces, others.faces]))


def bridges(mesh: TriMesh, connected: bool = False, n_faces: int | None = None) -> Bridges:
    """Link the pieces of a surface where they come nearest to each other.

    Pieces that touch are linked; a piece that touches none is linked to those that are near. Without ``connected``,
    the things of a scene are not linked to each other: between props in a long row is less than NEAR of its length.

    Parameters
    ----------
    mesh : TriMesh
        Every vertex has a face.
    connected : bool
        Whether to look farther and farther until all pieces hang together.
    n_faces : int, optional
        Number of its faces before long edges were split.

    Returns
    -------
    bridges : Bridges
        Not more than NEAR diameters long without ``connected``.
    """
    count, piece = mesh.face_components
    if count == 1:
        return Bridges.none()
    points = SurfacePoints.of(mesh, piece)
    size = diameter(points.position, points.area)
    near = NEAR * size
    # A crowd mostly hangs together by what touches, and all that is near would be many times as much.
    gaps = _Gaps.of(points, piece, (TOUCH + SLACK) * size if count > CROWD else near)
    if not connected:
        _, lengths = gaps.things()
        if (n_faces or mesh.n_faces) >= FACES_OF_A_THING * len(lengths) and lengths.max() < LONGEST * size:
            return _within_things(mesh, lengths.max())
    if count > CROWD:
        links = gaps.links(size)
        if components(count, *piece[links.faces].T)[0] == 1:
            return links
        gaps = _Gaps.of(points, piece, near)
    group, kept = piece, Bridges.none()
    while True:
        found = gaps.links(size)
        links = kept.with_more(found)
        n_bodies, body = components(count, *piece[links.faces].T)
        if n_bodies == 1 or not connected:
            return links
        if len(found.faces) > MANY_LINKS:
            group, kept = body[piece], links
        near *= 2
        gaps = _Gaps.of(SurfacePoints.of(mesh, piece, FAR_POINTS), group, near)


def _within_things(mesh: TriMesh, length: float) -> Bridges:
    """Link the pieces of each thing of a scene, of which the longest is about so long."""
    piece = mesh.face_components[1]
    points = SurfacePoints.of(mesh, piece, POINTS_OF_SCENE)
    gaps = _Gaps.of(points, piece, 2 * NEAR_OF_THINGS * length)
    thing, _ = gaps.things()
    return gaps.links(length, thing)


@dataclass(frozen=True, eq=False)
class _Gaps:
    """Where the pieces of a surface come near each other.

    Attributes
    ----------
    points : SurfacePoints
    piece : (s,) int64
        Of each point.
    ends : (k, 2) int64
        Points of different pieces, see ``near_pairs``.
    distance : (k,) float64
    pieces : (g, 2) int64
        Every two pieces that come near each other, once.
    row : (k,) int64
        The two pieces that the ends lie in.
    least : (g,) float64
        Distance between two pieces.
    """

    points: SurfacePoints
    piece: np.ndarray
    ends: np.ndarray
    distance: np.ndarray
    pieces: np.ndarray
    row: np.ndarray
    least: np.ndarray

    @classmethod
    def of(cls, points: SurfacePoints, piece_of_face: np.ndarray, near: float) -> _Gaps:
        """Look as far as ``near``, a length. piece_of_face : (m,) int64."""
        piece = piece_of_face[points.face]
        ends, distance = near_pairs(points, piece, near)
        pieces, row = distinct_pairs(*np.sort(piece[ends], axis=1).T)
        least = np.full(len(pieces), np.inf)
        np.minimum.at(least, row, distance)
        return cls(points, piece, ends, distance, pieces, row, least)

    @property
    def n_pieces(self) -> int:
        """Largest number of a piece, and one."""
        return int(self.piece.max()) + 1

    def links(self, size: float, thing: np.ndarray | None = None) -> Bridges:
        """Link pieces that touch, and those that are near and hang together by nothing else.

        size : the diameter. thing : (pieces,) int64, if pieces of different things are not to be linked.
        """
        first, second = self.pieces.T
        within = np.ones(len(first), bool) if thing is None else thing[first] == thing[second]
        touching = within & (self.least <= TOUCH * size)
        _, body = components(self.n_pieces, first[touching], second[touching])
        joins = touching | within & (body[first] != body[second])
        chosen = self.ends[joins[self.row] & (self.distance <= self.least[self.row] + SLACK * size)]
        vertices, link = distinct_pairs(*np.sort(self.points.vertex[chosen], axis=1).T)
        found = chosen[last_of_each(link, -arange(len(link)), count=len(vertices))]
        return Bridges(self.points.vertex[found], self.points.face[found])

    def things(self) -> tuple[np.ndarray, np.ndarray]:
        """Join pieces that are near each other beside what they form together.

        Returns the thing of each piece, (pieces,) int64, and the lengths of things, (things,) float64.
        """
        points, count = self.points, self.n_pieces
        place = points.position - points.position.mean(axis=0)
        moments = sums_by(self.piece, points.area[:, None] * np.column_stack(
            [np.ones(len(place)), place, (place**2).sum(axis=1)]), count)
        thing = arange(count)
        while True:
            first, second = thing[self.pieces].T
            near = self.least <= NEAR_OF_THINGS * _diameters(moments[first] + moments[second])
            count, joined = components(len(moments), first[near], second[near])
            if count == len(moments):
                return thing, _diameters(moments)
            moments, thing = sums_by(joined, moments, count), joined[thing]


def _diameters(moments: np.ndarray) -> np.ndarray:
    """``diameter`` of things, (k,) float64, by area, area times place and area times squared place, (k, 5)."""
    area, *place, square = moments.T
    area = np.maximum(area, np.finfo(float).tiny)
    return _rod_length(np.maximum(square / area - ((np.stack(place) / area) ** 2).sum(axis=0), 0.0))

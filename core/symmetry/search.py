# SPDX-License-Identifier: GPL-3.0-or-later
"""The plane in which a surface, or most of it, is its own mirror image.

Planes are tried across the principal axes and the axes of the coordinates, and each is improved as in the iterative
closest point method: points are mirrored, the nearest points of the surface found, and the plane laid anew halfway
between both [Podolak2006], [Besl1992].
"""

from __future__ import annotations

import numpy as np

from ..arrays.int64 import arange
from ..arrays.vectors import second_moments
from ..surface.ordering import principal_axes
from .plane import MirrorPlane, positive_sign
from .small_faces import Elements, SmallFaces

MATCH = 0.012  # how far a mirrored point may lie beside the surface where a plane is judged, in units of the size
LEAST = 0.85  # share of the area that must be matched for a plane to be one of symmetry
# Upper bounds of the points that stand for the surface, and that are mirrored: to choose among planes, and to find the
# place of one.
COARSE, FINE = (1_000, 100), (12_000, 500)
# Planes whose shares by few probes differ by less than EQUAL are equal: the first of them is taken, in all poses the
# same, unless by many probes one of those that differ by less than CLOSE is better by CLEAR.
EQUAL, CLOSE, CLEAR = 0.05, 0.1, 0.02
SOME = 300  # number of polygons by which it is seen whether a plane is exact; the first that is comes before all others
LIKELY = 0.5  # share of the area that the best plane must match already when few points are looked at
# A plane is improved until a step moves its normal and its offset by less: STILL where its place is to be found, ROUGH
# where it is only to be told from others.
STILL, ROUGH = 1e-7, 3e-3
STEPS, KEPT = 30, 0.8  # upper bound of these steps; share of the probes, the best ones, from which each is computed
EXACT = 0.02  # a share that is less than 1, or than the best there is, by this only is as good


def mirror_plane(faces: SmallFaces) -> MirrorPlane | None:
    """Find the plane in which most of a surface is its own mirror image.

    Parameters
    ----------
    faces : SmallFaces

    Returns
    -------
    plane : MirrorPlane or None
        The one that matches most, if it matches LEAST of the area; none for a surface without an area.
    """
    if not faces.mesh.area > 0:
        return None
    elements = faces.elements
    tried = [oriented(normal, 0.0) for normal in _directions(elements)]
    improved = _improved(tried, elements.some(COARSE[0]), elements.some(COARSE[1]), ROUGH)
    likely = [pair for pair in zip(tried, improved, strict=True) if pair[1].share >= LIKELY]
    if not likely:
        return None
    many, probes = elements.some(FINE[0]), elements.some(FINE[1])
    central, moved = _chosen(likely, faces.polygons, many, probes)
    # A plane through the middle, across a principal axis, is exact where the shape is, and the same in all poses.
    exact = judged(central, many, probes)
    if exact.share >= 1 - EXACT:  # none is better
        return faces.outwards(exact)
    best, = _improved([moved], many, probes)
    if best.share < LEAST:
        return None
    if len(many.area) < len(elements.area):
        best, = _improved([best], elements, probes)
    return faces.outwards(exact if exact.share >= best.share - EXACT else best)


def _chosen(
    likely: list[tuple[MirrorPlane, MirrorPlane]], polygons: Elements, surface: Elements, probes: Elements
) -> tuple[MirrorPlane, MirrorPlane]:
    """Which of some planes through the middle to take, each of which comes with what it was improved to.

    The first that is exact; without one the first of the nearly best, unless many probes say that another is better.
    """
    if len(likely) == 1:
        return likely[0]
    for pair in likely:
        if is_exact(polygons, pair[0]):
            return pair
    most = max(plane.share for _, plane in likely)
    first = next(pair for pair in likely if pair[1].share >= most - EQUAL)
    close = [pair for pair in likely if pair[1].share >= most - CLOSE]
    finer = [judged(plane, surface, probes).share for _, plane in close]
    good = [pair for pair, share in zip(close, finer, strict=True) if share >= max(finer) - CLEAR]
    return first if first in good else good[0]


def is_exact(polygons: Elements, plane: MirrorPlane) -> bool:
    """Whether some polygons, at equal steps of their number, all have exact images in a plane of their own frame."""
    image = polygons.chosen(arange(0, len(polygons.area), max(len(polygons.area) // SOME, 1))).mirrored(plane)
    return bool(polygons.same(image, polygons.nearest(image)[1]).all())


def _directions(elements: Elements) -> np.ndarray:
    """Unit normals of the planes to try, (k, 3): the principal axes and the axes of the coordinates."""
    tried = list(principal_axes(second_moments(elements.position, elements.area), np.eye(3))[::-1])
    for axis in np.eye(3):
        if max(abs(axis @ known) for known in tried) < np.cos(np.deg2rad(3.0)):
            tried.append(axis)
    return np.array(tried)


def _improved(
    planes: list[MirrorPlane], surface: Elements, probes: Elements, still: float = STILL
) -> list[MirrorPlane]:
    """The planes of symmetry near given ones, and their shares; still : by how little a plane moves that is found."""
    planes, moving = list(planes), list(range(len(planes)))
    worst = int(KEPT * len(probes.area))
    for _ in range(STEPS):
        found = surface.nearest(Elements.joined([probes.mirrored(planes[k]) for k in moving]))
        distance, nearest = (of_image.reshape(len(moving), -1) for of_image in found)
        used = distance <= np.partition(distance, worst, axis=1)[:, worst, None]
        before = [planes[k] for k in moving]
        for k, chosen, image in zip(moving, used, nearest, strict=True):
            planes[k] = _halfway(probes.position[chosen], surface.position[image[chosen]])
        moving = [k for k, plane in zip(moving, before, strict=True)
                  if np.abs(planes[k].normal - plane.normal).max() + abs(planes[k].offset - plane.offset) >= still]
        if not moving:
            break
    return [judged(plane, surface, probes) for plane in planes]


def judged(plane: MirrorPlane, surface: Elements, probes: Elements) -> MirrorPlane:
    """A plane with its share: that of the probes, by area, whose mirror images lie on the surface."""
    image = probes.mirrored(plane)
    matched = surface.matched(image, surface.nearest(image)[1], MATCH)
    return MirrorPlane(plane.normal, plane.offset, float(probes.area[matched].sum()))


def _halfway(before: np.ndarray, after: np.ndarray) -> MirrorPlane:
    """The plane that mirrors points best onto others, (k, 3): across their differences, through their middles."""
    apart, middle = before - after, (before + after) / 2
    center = middle.mean(axis=0)
    every = np.ones(len(apart))
    across, along = second_moments(apart, every), second_moments(middle - center, every)
    scale = np.trace(across) or 1.0, np.trace(along) or 1.0
    normal = np.linalg.eigh(across / scale[0] - along / scale[1])[1][:, -1]
    return oriented(normal, normal @ center)


def oriented(normal: np.ndarray, offset: float) -> MirrorPlane:
    """A plane whose normal's component of largest size is positive."""
    sign = positive_sign(normal)
    return MirrorPlane(sign * normal, float(sign * offset))

# SPDX-License-Identifier: GPL-3.0-or-later
"""Winding numbers: what lies inside of a surface, if it has holes or is several surfaces."""

from __future__ import annotations

import numpy as np

from ..arrays.vectors import inner_products
from ..mesh.triangles import TriMesh

# How far the mean winding number at the faces of a sheet may be from a whole number: half a tube has 0.20, a hemisphere
# 0.32, and a closed surface 0.5.
MOST_OF_SHEETS = 0.15


def winding_numbers(mesh: TriMesh, probe: np.ndarray, surface: np.ndarray, area: float) -> np.ndarray:
    """Measure how often a surface winds around the middles of some of its faces.

    Parameters
    ----------
    mesh : TriMesh
        m faces.
    probe : (k,) int64
        The faces at which it is measured.
    surface : (s,) int64
        Faces, spread evenly over the area, that stand for the whole surface.
    area : float
        Of the whole surface, in squared units of the vertices.

    Returns
    -------
    winding : (k,) float64
        [Jacobson2013], the mean of both sides of the face: on a closed surface 1/2, or -1/2 if it is inside out, and 0
        on a flat one. The solid angle of each face over 4 pi [Oosterom1983].
    """
    place = (mesh.vertices - mesh.vertices.mean(axis=0)) / np.sqrt(mesh.area)
    p, corners = place[mesh.faces[probe]].mean(axis=1), place[mesh.faces[surface]].transpose(1, 0, 2)
    square = (p**2).sum(axis=1)[:, None]

    def dot(a: np.ndarray, b: np.ndarray) -> np.ndarray:
        """Products (a - p) (b - p), (k, s), of corners a and b of the surface as seen from the probes."""
        return square - inner_products(p, a + b) + (a * b).sum(axis=1)

    a, b, c = corners
    normal = np.cross(b - a, c - a)
    volume = (normal * a).sum(axis=1) - inner_products(p, normal)
    la, lb, lc = (np.sqrt(np.maximum(dot(x, x), 0.0)) for x in (a, b, c))
    angle = 2 * np.arctan2(volume, la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb)
    angle[probe[:, None] == surface] = 0.0
    share = area / mesh.face_area[surface].sum()
    return np.clip(share * angle, -2 * np.pi, 2 * np.pi).sum(axis=1) / (4 * np.pi)

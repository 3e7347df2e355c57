# SPDX-License-Identifier: GPL-3.0-or-later
"""Sheets: pieces of a surface under which there is no solid, such as silhouettes, leaves and cloth.

What is measured of a solid, its thickness and the creases where limbs begin, does not exist on a sheet; its outline has
both. So a sheet is *inflated*: it is doubled, front and back stay joined at the border, and within they part as far as
the largest balls reach that the outline holds. Width becomes thickness, and where one ball ends and the next begins,
between the notches of the outline, lies a crease.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.sparse import csr_array, diags_array

from ..arrays.indexing import spread_evenly, sums_by
from ..arrays.int64 import arange
from ..arrays.nearest import nearest, search_tree
from ..arrays.pairs import symmetric_matrix
from ..arrays.systems import solved
from ..arrays.vectors import cross, row_products, unit
from ..mesh.labels import majority
from ..mesh.triangles import TriMesh, corner_sides
from .balls import ball_radius
from .preparation import split_edges
from .winding import MOST_OF_SHEETS, winding_numbers

# A sheet has at least this square of the length of its border, as a share of its area; a disc has 4 pi, a hemisphere
# 2 pi. What has less is a solid with a hole.
LEAST_BORDER = np.pi
N_PROBES, N_SURFACE = 100, 2_000  # upper bounds of the numbers of faces at which, and of which, windings are measured
MOST_AGAINST = 1e-3  # share of neighbors that may disagree on it; coarse copies are not perfect
LEAST_AREA = 0.05  # share of the area of a surface of several pieces below which a piece stays as it is
HEIGHT = 0.25  # of the inflated surface over that of the balls
PER_EDGE = 3  # number of balls that touch each edge of the outline
LARGEST_BALL = 0.6  # radius at which these begin to shrink, in units of the square root of the area; a disc has 0.56
# Points of outlines up to which balls are exact. The middle of a disc is equally far from all, each of which would be
# looked at for each ball; of more, balls may hold a point that is so much nearer than their border.
MOST_EXACT, SLACK = 20_000, 0.03
# Bounds of the height of the balls over that of a membrane: they pass over roughness, and over sheets that lie on
# each other, where straight distances mislead.
LOWEST, HIGHEST = 0.5, 1.5
WRINKLES = 0.15  # width over which a sheet is smoothed, in units of the square root of its area
# Share of their diagonal that is added to the matrices of linear systems: among needles, whose cotangents are as large
# as numbers of this precision can tell apart, they would have no solution.
ROUNDING = 1e-12


@dataclass(frozen=True, eq=False)
class Inflated:
    """A surface whose sheets are inflated.

    Attributes
    ----------
    mesh : TriMesh
        m' faces, n' vertices; a sheet has no border any more.
    face_source : (m',) int64
        Face of the surface given in which each face lies, or, on the back of a sheet, behind which.
    n_front : int
        Faces from this one on are backs of sheets.
    vertex_source : (n', 2) int64
        Vertices of the surface given in whose middle each vertex lay; mostly the same one twice.
    """

    mesh: TriMesh
    face_source: np.ndarray
    n_front: int
    vertex_source: np.ndarray

    def on_front(self, label: np.ndarray, count: int) -> np.ndarray:
        """Label of each face of the surface given: that of most of its front.

        label : (m',) int64, of each face. count : int, number of faces of the surface given. Returns (count,) int64.
        """
        front = slice(0, self.n_front)
        return majority(self.face_source[front], label[front], self.mesh.face_area[front], count)


def sheet_faces(mesh: TriMesh, order: np.ndarray) -> np.ndarray:
    """Find the faces of sheets.

    A piece is a sheet if it has a border long enough, if its faces are turned one way, and if the mean winding number
    [Jacobson2013] of the whole surface at its faces is nearly whole: on a closed surface, where it is 0 on one side and
    1 on the other, it is 1/2.

    Parameters
    ----------
    mesh : TriMesh
        m faces.
    order : (m,) float64
        Value of each face by which the faces are sorted to choose some of them evenly over the area.

    Returns
    -------
    sheet : (m,) bool
    """
    on_border = _border_edges(mesh)[mesh.edges.face_edges]
    if not on_border.any():
        return np.zeros(mesh.n_faces, bool)
    count, piece = mesh.face_components
    length = np.bincount(piece, (on_border * mesh.edge_length[mesh.edges.face_edges]).sum(axis=1), count)
    area = np.bincount(piece, mesh.face_area, count)
    open_ = (length**2 >= LEAST_BORDER * area) & (area >= LEAST_AREA * mesh.area)
    open_ &= np.bincount(piece, ~on_border.all(axis=1), count) > 0
    open_ &= _turned_one_way(mesh)
    if not open_.any():
        return np.zeros(mesh.n_faces, bool)
    among = np.flatnonzero(open_[piece])
    probe = among[spread_evenly(mesh.face_area[among], order[among], N_PROBES)]
    surface = spread_evenly(mesh.face_area, order, N_SURFACE)
    total = np.bincount(piece[probe], winding_numbers(mesh, probe, surface, mesh.area), count)
    mean = total / np.maximum(np.bincount(piece[probe], minlength=count), 1)
    return (open_ & (np.abs(mean - np.rint(mean)) <= MOST_OF_SHEETS))[piece]


def _turned_one_way(mesh: TriMesh) -> np.ndarray:
    """Whether neighbors agree on which side is out, by piece, (k,) bool; not so on a Moebius strip."""
    count, piece = mesh.face_components
    a, b = mesh.edges.pairs.T
    weight = np.minimum(mesh.face_area[a], mesh.face_area[b])
    return np.bincount(piece[a], weight * mesh.same_way, count) <= MOST_AGAINST * np.bincount(piece[a], weight, count)


def inflated(mesh: TriMesh, sheet: np.ndarray) -> Inflated:
    """Inflate the sheets of a surface.

    Parameters
    ----------
    mesh : TriMesh
        m faces, n vertices.
    sheet : (m,) bool
        Faces of sheets, whole pieces of the surface.

    Returns
    -------
    solid : Inflated

    Notes
    -----
    One sparse linear system over the vertices within the sheets.
    """
    held = _border(mesh)
    # An edge across a narrow limb from border to border is split, so that there is something to inflate.
    across = held[mesh.edges.vertices].all(axis=1) & ~_border_edges(mesh)
    across &= np.isin(arange(len(across)), mesh.edges.face_edges[sheet])
    source = np.repeat(arange(mesh.n_vertices), 2).reshape(-1, 2)
    source = np.concatenate([source, mesh.edges.vertices[across]])
    fine, face_source = split_edges(mesh, across)
    thin = sheet[face_source]
    even = thin & _with_area(fine)
    within = np.zeros(fine.n_vertices, bool)
    within[fine.faces[even]] = True
    within &= ~_border(fine)
    stiffness, area = _stiffness(fine, even)
    base, normal = _without_wrinkles(fine, even, stiffness, area)
    membrane = np.sqrt(_membrane(stiffness, area, within))
    height = np.clip(_ball_height(fine, even, within), LOWEST * membrane, HIGHEST * membrane)
    lift = HEIGHT * height[:, None] * normal
    back = arange(fine.n_vertices)
    back[within] = fine.n_vertices + arange(within.sum())
    vertices = np.concatenate([base + lift, (base - lift)[within]])
    faces = np.concatenate([fine.faces, back[fine.faces[thin][:, ::-1]]])
    return Inflated(TriMesh(vertices, faces), np.concatenate([face_source, face_source[thin]]), fine.n_faces,
                    np.concatenate([source, source[within]]))


def _with_area(mesh: TriMesh) -> np.ndarray:
    """Which faces have an area, (m,) bool."""
    return mesh.face_area > 1e-9 * mesh.area / mesh.n_faces


def _border_edges(mesh: TriMesh) -> np.ndarray:
    """Which edges have one face with an area, (e,) bool."""
    if not (mesh.edges.n_faces != 2).any():
        return np.zeros(len(mesh.edges.vertices), bool)
    return np.bincount(mesh.edges.face_edges[_with_area(mesh)].ravel(), minlength=len(mesh.edges.vertices)) == 1


def _border(mesh: TriMesh) -> np.ndarray:
    """Which vertices lie on a border, (n,) bool."""
    border = np.zeros(mesh.n_vertices, bool)
    border[mesh.edges.vertices[_border_edges(mesh)]] = True
    return border


def _stiffness(mesh: TriMesh, thin: np.ndarray) -> tuple[csr_array, np.ndarray]:
    """Minus the Laplacian of the faces ``thin``, (n, n), by cotangents [Pinkall1993], and the area at each vertex."""
    faces = mesh.faces[thin]
    ends, u, v = corner_sides(mesh.vertices, faces)
    cotangent = row_products(u, v) / np.repeat(2 * mesh.face_area[thin], 3)
    weights = symmetric_matrix(ends, 0.5 * cotangent, mesh.n_vertices)
    area = np.bincount(faces.ravel(), np.repeat(mesh.face_area[thin] / 3, 3), mesh.n_vertices)
    return diags_array(weights.sum(axis=1)).tocsr() - weights, area


def _membrane(stiffness: csr_array, area: np.ndarray, within: np.ndarray) -> np.ndarray:
    """Solution u, (n,), of Laplace(u) = -2 that is 0 at all vertices but those ``within``, (n,) bool.

    Across a strip 2 w wide it is w^2 - x^2 at x from the middle, the square of the height of a circle [Joshi2008]. In
    squared units of the vertices.
    """
    inside = np.flatnonzero(within)
    height = np.zeros(len(within))
    matrix = stiffness[inside][:, inside]
    matrix = matrix + diags_array(ROUNDING * np.abs(matrix.diagonal()))
    height[inside] = solved(matrix, 2 * area[inside])
    return np.maximum(np.nan_to_num(height), 0.0)


def _without_wrinkles(
    mesh: TriMesh, thin: np.ndarray, stiffness: csr_array, area: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Places and normals of the vertices, (n, 3) each, after the sheets are smoothed over WRINKLES, as heat flows.

    Vertices move along the smooth normals only: a flat sheet stays as it is, with its border.
    """
    count, piece = mesh.face_components
    width = np.zeros(mesh.n_vertices)
    width[mesh.faces] = WRINKLES * np.sqrt(np.bincount(piece, mesh.face_area, count))[piece][:, None]
    of_sheet = np.unique(mesh.faces[thin])
    flow = diags_array(width[of_sheet] ** 2) @ stiffness[of_sheet][:, of_sheet]
    mass = area[of_sheet] + 1e-12 * mesh.area + ROUNDING * np.abs(flow.diagonal())
    system = diags_array(mass) + flow
    normal = sums_by(mesh.faces[thin].ravel(), np.repeat(mesh.area_normals[thin], 3, axis=0), mesh.n_vertices)
    start = np.hstack([mass[:, None] * mesh.vertices[of_sheet], normal[of_sheet]])
    smooth = solved(system, start)
    smooth_normal = np.zeros((mesh.n_vertices, 3))
    smooth_normal[of_sheet] = unit(smooth[:, 3:])
    place, n = mesh.vertices.copy(), smooth_normal[of_sheet]
    place[of_sheet] += ((smooth[:, :3] - place[of_sheet]) * n).sum(axis=1, keepdims=True) * n
    return place, smooth_normal


def _ball_height(mesh: TriMesh, thin: np.ndarray, within: np.ndarray) -> np.ndarray:
    """Height at each vertex, (n,), up to which the largest balls reach that the outline of the sheets holds.

    thin, within : (m,) and (n,) bool, faces of the sheets and vertices within them; the height is 0 elsewhere.
    """
    root = np.sqrt(mesh.area)
    place = (mesh.vertices - mesh.vertices.mean(axis=0)) / root
    point, inwards, ends = _outline(mesh, thin, place)
    tree = search_tree(np.concatenate([point, ends]))
    radius = ball_radius(tree, point, inwards, LARGEST_BALL, SLACK if tree.n > MOST_EXACT else 0.0)
    center = point + radius[:, None] * inwards
    # The ball with the largest r^2 - |x - c|^2 is the nearest to x once each is moved into a fourth dimension, farther
    # the smaller it is. Two are found, for rounding must not choose among balls that are equally good.
    lifted = np.column_stack([center, np.sqrt(np.maximum((radius**2).max(initial=0.0) - radius**2, 0.0))])
    x, height = place[within], np.zeros(mesh.n_vertices)
    ball = nearest(search_tree(lifted), np.column_stack([x, np.zeros(len(x))]), [1, 2])[1] % len(center)
    height[within] = (radius[ball] ** 2 - ((x[:, None] - center[ball]) ** 2).sum(axis=2)).max(axis=1)
    return root * np.sqrt(np.maximum(height, 0.0))


def _outline(mesh: TriMesh, thin: np.ndarray, place: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Points on the border of sheets, (k, 3), the directions into the sheets there, (k, 3), and ends of border edges.

    place : (n, 3), of each vertex, in the unit of the result.
    """
    face, corner = np.nonzero(_border_edges(mesh)[mesh.edges.face_edges] & thin[:, None])
    start, end = place[mesh.faces[face, corner]], place[mesh.faces[face, (corner + 1) % 3]]
    inwards = unit(cross(mesh.face_normals[face], end - start))
    along = (arange(PER_EDGE) + 0.5)[:, None, None] / PER_EDGE
    return (start + along * (end - start)).reshape(-1, 3), np.tile(inwards, (PER_EDGE, 1)), start

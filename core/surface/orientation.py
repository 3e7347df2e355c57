# SPDX-License-Identifier: GPL-3.0-or-later
"""Which side of a face is outside: neighbors agree, and what encloses a volume faces away from it.

Creases are told from ridges, and thickness from distance, by the way faces are turned: a body whose faces look inwards
would be cut along its ridges. Where it is closed, the sign of its volume tells. Where it has holes, the winding number
does: half of all directions, seen from a face, end on the back of another. Sheets, which enclose nothing, keep the side
that their artist gave them.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ..arrays.components import components
from ..arrays.indexing import even_steps
from ..arrays.int64 import arange
from ..arrays.ties import TIE
from ..arrays.vectors import lengths, middles_of_each, row_products, weighted_sum
from ..mesh.copies import Copies
from ..mesh.corners import CornerTable
from ..mesh.polygons import PolygonMesh
from ..mesh.triangles import TriMesh
from ..sentence import Sentence
from .winding import MOST_OF_SHEETS, winding_numbers

N_PROBES, N_SURFACE = 40, 400  # upper bounds of the numbers of faces at which, and of which, windings are measured
LEAST_AREA = 0.002  # share of the area below which an open piece stays as it is
NOTHING = 1e-9  # a sum is 0 if below this, in units of the sum of sizes


def turn_outwards(mesh: TriMesh) -> tuple[TriMesh, tuple[Sentence, ...]]:
    """Turn faces so that neighbors agree and pieces that enclose a volume, if with holes, face away from it.

    Parameters
    ----------
    mesh : TriMesh
        m faces.

    Returns
    -------
    mesh : TriMesh
        The mesh that was given, if nothing was turned.
    notes : tuple of Sentence
        How many faces were turned.
    """
    flip = _agreeing(mesh)
    count, piece = mesh.face_components
    sign = np.where(flip, -1.0, 1.0)
    as_given = _sums(piece, sign * mesh.face_area, count)
    center = mesh.vertices.mean(axis=0)  # volumes are measured from here: far from the origin they would cancel
    volume = _sums(piece, sign * row_products(mesh.area_normals, mesh.face_centroids - center), count)
    borders = mesh.edges.n_faces[mesh.edges.face_edges] == 1
    closed = np.bincount(piece, borders.any(axis=1), count) == 0
    # What is folded flat encloses nothing.
    flip ^= np.where(closed & (volume != 0), volume < 0, as_given < 0)[piece]
    flip ^= _inside_out(_turned(mesh, flip), ~closed)[piece]
    note = Sentence("{n} {n:triangle faces inwards or against its|triangles face inwards or against their} "
                    "neighbors.", n=int(flip.sum()))
    return _turned(mesh, flip), (note,) if flip.any() else ()


def without_copies(given: PolygonMesh, copies: Copies) -> PolygonMesh:
    """The mesh in which copies of faces were found, without them; sides are chosen as ``of_either_side`` does."""
    given = copies.without(given)
    return replace(given, triangles=of_either_side(given.triangles, copies.has_other_side[given.polygon]))


def of_either_side(mesh: TriMesh, chosen: np.ndarray) -> TriMesh:
    """Choose a side of faces that were there twice, once for each side, whichever of the two was left.

    Neighbors agree where they can, and look away from the middle of their piece; flat ones, from that of the mesh.

    Parameters
    ----------
    mesh : TriMesh
        m faces.
    chosen : (m,) bool
        The faces that were there twice.

    Returns
    -------
    mesh : TriMesh
    """
    two = mesh.edges.n_faces[mesh.edges.pair_edge] == 2  # of more faces at an edge their order would choose two
    pairs, face = mesh.edges.pairs[two], arange(mesh.n_faces)
    mesh = _turned(mesh, chosen & _look_inwards(mesh, face, mesh.n_faces))  # one by one, where they cannot agree
    mesh = _turned(mesh, chosen & _of_other_sheet(mesh.n_faces, pairs, mesh.same_way[two]))
    count, patch = components(mesh.n_faces, *pairs.T)
    return _turned(mesh, chosen & _look_inwards(mesh, patch, count)[patch])


def _look_inwards(mesh: TriMesh, group: np.ndarray, count: int) -> np.ndarray:
    """Which of some groups of faces, (count,) bool, look to the middle of their piece, or in its plane to the whole's.

    group : (m,) int64, of each face.
    """
    n_pieces, piece = mesh.face_components
    _, of_piece = middles_of_each(piece, mesh.face_centroids, mesh.face_area, n_pieces)
    whole = weighted_sum(mesh.face_area, mesh.face_centroids) / max(mesh.area, 1e-300)
    inwards, clearly = [], []
    for middle in (of_piece[piece], whole):
        away = mesh.face_centroids - middle
        volume = np.bincount(group, row_products(mesh.area_normals, away), count)
        clearly.append(np.abs(volume) > TIE * np.bincount(group, mesh.face_area * lengths(away), count))
        inwards.append(volume < 0)
    return np.where(clearly[0], inwards[0], inwards[1] & clearly[1])


def _turned(mesh: TriMesh, flip: np.ndarray) -> TriMesh:
    """The mesh with some faces, (m,) bool, turned over; itself, if none is."""
    return TriMesh(mesh.vertices, np.where(flip[:, None], mesh.faces[:, ::-1], mesh.faces)) if flip.any() else mesh


def _sums(piece: np.ndarray, values: np.ndarray, count: int) -> np.ndarray:
    """Sum of the values of the faces of each piece, (count,) float64; 0 where it is nothing but rounding."""
    total = np.bincount(piece, values, count)
    return np.where(np.abs(total) > NOTHING * np.bincount(piece, np.abs(values), count), total, 0.0)


def _agreeing(mesh: TriMesh) -> np.ndarray:
    """Faces to turn, (m,) bool, so that all faces of each orientable piece agree."""
    same_way = mesh.same_way
    if not same_way.any():
        return np.zeros(mesh.n_faces, bool)
    return _of_other_sheet(mesh.n_faces, mesh.edges.pairs, same_way)


def _of_other_sheet(m: int, pairs: np.ndarray, same_way: np.ndarray) -> np.ndarray:
    """Those of m faces, (m,) bool, that have to be turned so that the faces of all pairs agree.

    pairs : (r, 2) int64. same_way : (r,) bool, the pairs that do not agree as they are.
    """
    # The double cover has each face twice: face f as given and face f + m flipped. A piece of the surface is orientable
    # if its two copies in the double cover are not connected.
    a, b = pairs.T
    other = np.where(same_way, m, 0)
    _, sheet = components(2 * m, np.concatenate([a, a + m]), np.concatenate([b + other, (b + m + other) % (2 * m)]))
    return (sheet[:m] != sheet[m:]) & (sheet[:m] > sheet[m:])


def against_neighbors(table: CornerTable) -> np.ndarray:
    """Find the polygons to turn so that neighbors agree.

    Pieces that are closed look outwards then, others to the side to which most of their area did. Pieces whose faces
    agree already stay as they are, and so do those that have one side only.

    Parameters
    ----------
    table : CornerTable
        p faces.

    Returns
    -------
    flip : (p,) bool
    """
    contrary = table.contrary_edges()
    if not contrary.any():
        return np.zeros(table.n_faces, bool)
    two, pairs, edge = _at_edges_of_two(table)
    same_way = contrary[edge]
    flip = _of_other_sheet(table.n_faces, pairs, same_way)
    count, piece = components(table.n_faces, *pairs.T)
    mends, one_sided = np.zeros((2, count), bool)
    mends[piece[pairs[same_way, 0]]] = True
    one_sided[piece[pairs[same_way ^ (flip[pairs[:, 0]] != flip[pairs[:, 1]]), 0]]] = True
    closed = np.bincount(piece[table.corner_face], ~two[table.corner_edge], count) == 0
    flip ^= _to_other_side(table, flip, piece, closed)[piece]
    return flip & (mends & ~one_sided)[piece]


def looks_inwards(table: CornerTable) -> bool:
    """Whether a mesh is closed, its faces agree, and it encloses less than nothing: they look inwards."""
    two = table.n_edge_faces == 2
    if not two.all() or table.contrary_edges().any():
        return False
    return bool(_volumes(table, table.face_vectors(), np.zeros(table.n_faces, np.int64), 1)[0] < 0)


def of_solids(table: CornerTable) -> np.ndarray:
    """Find the faces of closed pieces that look outwards, whose faces agree.

    Parameters
    ----------
    table : CornerTable
        p faces.

    Returns
    -------
    faces : (p,) bool
    """
    two, pairs, _ = _at_edges_of_two(table)
    count, piece = components(table.n_faces, *pairs.T)
    wrong = ~two | table.contrary_edges()
    solid = np.bincount(piece[table.corner_face], wrong[table.corner_edge], count) == 0
    return (solid & (_volumes(table, table.face_vectors(), piece, count) > 0))[piece]


def _at_edges_of_two(table: CornerTable) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Which edges have two faces, (e,) bool, the faces that meet there, (r, 2) int64, and where, (r,) int64."""
    two = table.n_edge_faces == 2
    pairs, edge = table.face_pairs()
    return two, pairs[two[edge]], edge[two[edge]]


def _volumes(table: CornerTable, vector: np.ndarray, piece: np.ndarray, count: int) -> np.ndarray:
    """Three times what each piece encloses, (count,) float64. vector : (p, 3), vector areas. piece : (p,) int64."""
    away = table.face_means(table.vertices) - table.vertices.mean(axis=0)
    return _sums(piece, row_products(vector, away), count)


def _to_other_side(table: CornerTable, flip: np.ndarray, piece: np.ndarray, closed: np.ndarray) -> np.ndarray:
    """Which of c pieces look to the wrong side once some faces are turned, (c,) bool; see ``against_neighbors``.

    flip : (p,) bool. piece : (p,) int64, of each face. closed : (c,) bool.
    """
    vector, sign = table.face_vectors(), np.where(flip, -1.0, 1.0)
    volume = _volumes(table, sign[:, None] * vector, piece, len(closed))
    as_given = _sums(piece, sign * lengths(vector), len(closed))
    return np.where(closed & (volume != 0), volume < 0, as_given < 0)


def _inside_out(mesh: TriMesh, chosen: np.ndarray) -> np.ndarray:
    """Which of some pieces, (c,) bool each, enclose a volume that their faces look into.

    The volume as seen from the middle of a piece, which lacks what is below its holes, rules most of them out at once.
    """
    if not chosen.any():
        return chosen
    count, piece = mesh.face_components
    area, middle = middles_of_each(piece, mesh.face_centroids, mesh.face_area, count)
    away = mesh.face_centroids - middle[piece]
    volume = _sums(piece, row_products(mesh.area_normals, away), count)
    inside_out = chosen & (volume < 0) & (area >= LEAST_AREA * mesh.area)
    for one in np.flatnonzero(inside_out):
        faces = np.flatnonzero(piece == one)
        probe, surface = (faces[even_steps(mesh.face_area[faces], most)] for most in (N_PROBES, N_SURFACE))
        inside_out[one] = winding_numbers(mesh, probe, surface, area[one]).mean() < -MOST_OF_SHEETS
    return inside_out

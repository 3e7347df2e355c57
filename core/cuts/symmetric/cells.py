# SPDX-License-Identifier: GPL-3.0-or-later
"""Cells: the candidates of the side of a shape that leads, and their images on the sides that follow.

The cell of a face that does not lead itself is the mirror image of the cell of that image of it which leads: a face of
a left arm, if the right side leads, gets the mirrored right arm.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from scipy.sparse import csr_array

from ...arrays.components import roots
from ...arrays.indexing import largest_of_each, renumbered
from ...arrays.int64 import arange, full
from ...arrays.pairs import edge_keys
from ...arrays.ties import rounded
from ...mesh.face_graph import FaceGraph, connect, fill_unlabeled
from ...mesh.labels import longest_neighbor, majority
from ...symmetry.group import SymmetryGroup

# Shares of the area of the pieces that the plane mirrors. What little of a candidate is left on the leading side joins
# a neighbor below LEAST_LEADING, and so does what lies across the plane below LEAST_ACROSS; a region without an image
# is one of its own from LEAST_ALONE on.
LEAST_LEADING, LEAST_ACROSS, LEAST_ALONE = 0.0004, 0.001, 0.005
OVERHANG = 0.25  # share of a candidate below which what reaches over the plane from a side that follows is cut off


@dataclass(frozen=True, eq=False)
class Cells:
    """The cells of all faces under a group of g symmetries, and what the hierarchy found is asked about them.

    Attributes
    ----------
    label : (p,) int64
        Cell of each face, 0..c-1.
    found : (c, g) int64
        The candidate in which most of each image of each cell lies; -1 for none.
    shares : tuple of g (c, c') sparse float64
        Of each image of each cell, the share of its area in each of the c' candidates found.
    leads : (c, g) bool
        Which images of a cell lie on the leading side; only the cell itself where it has no image.
    image : (c, g) int64
        The images of each cell; -1 for none.
    area : (c,) float64
    group : SymmetryGroup
    """

    label: np.ndarray
    found: np.ndarray
    shares: tuple[csr_array, ...]
    leads: np.ndarray
    image: np.ndarray
    area: np.ndarray
    group: SymmetryGroup


def make_cells(
    graph: FaceGraph, label: np.ndarray, group: SymmetryGroup, side: np.ndarray, whole: float, dissolved: np.ndarray
) -> Cells:
    """Divide all faces into cells.

    Parameters
    ----------
    graph : FaceGraph
        p faces.
    label : (p,) int64
        Candidate of each face.
    group : SymmetryGroup
    side : (p,) bool
        Which faces lie on the leading side.
    whole : float
        Area of the pieces that the planes mirror.
    dissolved : (p,) bool
        Faces that make no cells of their own: on the leading side what mostly consists of them joins a neighbor, on
        others they get the cells around them.

    Returns
    -------
    cells : Cells
        Each is connected.
    """
    least = LEAST_ALONE * whole
    images = _leading_images(graph, group, side, least)
    leading = _leading_cells(graph, label, images, whole, dissolved)
    name = _label_by_leader(graph, images, leading, dissolved)
    name = _without_unmirrored(graph, name, leading, least)
    return _cell_tables(graph, label, images, leading, name)


@dataclass(frozen=True, eq=False)
class _LeadingImages:
    """Of each of p faces the images, and the one whose cell it takes.

    Attributes
    ----------
    group : SymmetryGroup
    has : (g, p) bool
        Which images of each face there are.
    image : (g, p) int64
        The images; the face itself where it has none.
    element : (p,) int64
        The first symmetry that takes each face to the leading side; 0 for a face that lies there, or has no such image.
    surrounded : (p,) bool
        Faces of small regions without an image on the leading side: they get the cell around them.
    """

    group: SymmetryGroup
    has: np.ndarray
    image: np.ndarray
    element: np.ndarray
    surrounded: np.ndarray

    @cached_property
    def leader(self) -> np.ndarray:
        """(p,) int64, the image of each face whose cell, mirrored back, it takes."""
        return self.image[self.element, arange(len(self.element))]

    @cached_property
    def leads(self) -> np.ndarray:
        """(p,) bool, faces that are their own leaders."""
        return (self.element == 0) & ~self.surrounded


@dataclass(frozen=True, eq=False)
class _LeadingCells:
    """The c cells of the faces that lead.

    Attributes
    ----------
    group : SymmetryGroup
    cell : (p,) int64
        Cell of each face that leads; -1 of others.
    stabilizer : (c, g) bool
        The subgroup of the symmetries under which each cell is its own image.
    has_image : (c, g) bool
        Which images of each cell there are.
    """

    group: SymmetryGroup
    cell: np.ndarray
    stabilizer: np.ndarray
    has_image: np.ndarray

    @cached_property
    def coset(self) -> np.ndarray:
        """(c, g) int64, the first symmetry that takes the same image to each cell as each symmetry does."""
        return self.group.cosets(self.stabilizer)

    def names(self, cell: np.ndarray, element: np.ndarray) -> np.ndarray:
        """The name, one number, of what a symmetry takes to a cell; cell, element : int64 of shapes that broadcast."""
        return len(self.group.elements) * cell + self.coset[cell, element]

    def of_names(self, name: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """The leading cell of each name, and the symmetry that takes what has this name to it."""
        cell, element = np.divmod(name, len(self.group.elements))
        return cell, element

    def name_of_image(self, name: np.ndarray, element: np.ndarray | int) -> np.ndarray:
        """The name of the image of what has a name: the inverse takes the image back, and the name's symmetry on."""
        cell, to_leader = self.of_names(name)
        return self.names(cell, self.group.composition[to_leader, self.group.inverse[element]])


def _leading_images(graph: FaceGraph, group: SymmetryGroup, side: np.ndarray, least: float) -> _LeadingImages:
    """The images of the faces. side : (p,) bool, the leading one. least : area from which regions are not small."""
    has = group.image >= 0
    image = np.where(has, group.image, arange(len(side)))
    element = group.first_onto(side)
    without = ~has.all(axis=0) & ~side[image[element, arange(len(side))]]
    surrounded = without & ~_in_large_regions(graph, without, least)
    return _LeadingImages(group, has, image, element, surrounded)


def _in_large_regions(graph: FaceGraph, chosen: np.ndarray, least: float) -> np.ndarray:
    """Which of the chosen faces, (p,) bool, form connected regions of a least area."""
    count, region = graph.regions(chosen)
    return chosen & (np.bincount(region, graph.area, count) >= least)[region]


def _leading_cells(
    graph: FaceGraph, label: np.ndarray, images: _LeadingImages, whole: float, dissolved: np.ndarray
) -> _LeadingCells:
    """The candidates on the leading side, in connected cells; small and dissolved ones join a neighbor.

    label : (p,), candidate of each face. whole : area of the pieces that the planes mirror. dissolved : (p,) bool.
    """
    leads, leader, group = images.leads, images.leader, images.group
    leaders = _graph_of_leaders(graph, images)
    cell = _connected_cells(leaders, label, leads)
    in_cell = cell[leads]
    count = int(in_cell.max()) + 1
    candidate = np.empty(count, np.int64)
    candidate[in_cell] = label[leads]
    weight = graph.weight[leads]
    candidate_there = np.stack([majority(in_cell, there[leads] + 1, weight, count) - 1
                                for there in np.where(images.has, label[images.image], -1)], axis=1)
    stabilizer = group.generated_subgroups(candidate[:, None] == candidate_there)
    # A face counts for the cell of its leader: small is a cell that is so together with its images.
    follows = leads[leader]
    share = graph.area[follows] / max(whole, 1e-300)
    share = rounded(np.bincount(cell[leader][follows], share, count))
    largest = largest_of_each(candidate, share, int(candidate.max()) + 1)[candidate]
    overhangs = (np.bincount(in_cell, graph.area[leads], count)
                 < OVERHANG * 2 / len(group.elements) * np.bincount(label, graph.area)[candidate])
    across = stabilizer[:, 1:].any(axis=1)
    small = (((share < LEAST_LEADING) & (share < largest)) | overhangs
             | (across & (share < LEAST_ACROSS)))
    gone = np.bincount(in_cell, weight * dissolved[leads], count) > 0.5 * np.bincount(in_cell, weight, count)
    goal = _joined(leaders, cell, share, small, gone)
    left, cell[leads] = renumbered(goal[in_cell])
    return _LeadingCells(group, cell, stabilizer[left], candidate_there[left] >= 0)


def _graph_of_leaders(graph: FaceGraph, images: _LeadingImages) -> FaceGraph:
    """The graph of the faces that lead: two touch where they, or faces of which they are the leaders, do."""
    a, b = images.leader[graph.pairs.T]
    both = np.flatnonzero(images.leads[a] & images.leads[b])
    return FaceGraph(graph.n_faces, np.stack([a[both], b[both]], axis=1), graph.length[both], graph.area)


def _connected_cells(leaders: FaceGraph, label: np.ndarray, leads: np.ndarray) -> np.ndarray:
    """Connected places of one candidate, (p,) int64, numbered from 0, of the faces that lead; -1 for others."""
    _, place = leaders.regions(label)
    cell = full(len(label), -1)
    cell[leads] = renumbered(place[leads])[1]
    return cell


def _joined(
    graph: FaceGraph, cell: np.ndarray, area: np.ndarray, small: np.ndarray, gone: np.ndarray
) -> np.ndarray:
    """Cell that each cell becomes, (c,) int64: small ones join a larger neighbor.

    Those that are gone join one that is not, whatever its size, those beside such a one first.

    cell : (p,), of each face, -1 for none. area, small, gone : (c,).
    """
    touching, length = graph.boundaries(cell)
    goal = longest_neighbor(touching, length, len(area))
    goal = np.where(small & ~gone & (goal >= 0) & (area[goal] > area), goal, arange(len(area)))
    return roots(goal)[_beside(touching, length, gone)]


def _beside(touching: np.ndarray, length: np.ndarray, gone: np.ndarray) -> np.ndarray:
    """The cell around each cell that is gone, (c,) int64: itself for one that is not, and where all are gone.

    touching, length : cells that share a boundary, and how long it is.
    """
    around, inside = arange(len(gone)), gone.copy()
    while True:
        rim = inside[touching[:, 0]] != inside[touching[:, 1]]
        goal = longest_neighbor(touching[rim], length[rim], len(gone))
        now = inside & (goal >= 0)
        if not now.any():
            return around
        around[now] = around[goal[now]]
        inside &= ~now


def _label_by_leader(
    graph: FaceGraph, images: _LeadingImages, leading: _LeadingCells, dissolved: np.ndarray
) -> np.ndarray:
    """Name of the cell of each face, (p,) int64: that of its leader, mirrored back, or for some the one around them."""
    around = images.surrounded | dissolved & ~images.leads
    name = np.where(around, -1, leading.names(leading.cell[images.leader], images.element))
    return connect(graph, fill_unlabeled(graph, name))


def _without_unmirrored(graph: FaceGraph, name: np.ndarray, leading: _LeadingCells, least: float) -> np.ndarray:
    """Name of the cell of each face, (p,) int64, where small cells without their images joined those around them.

    An image counts if it is there and among the images of the neighbors. name : (p,) int64, of connected cells. least :
    area from which a cell is not small.
    """
    names, place = renumbered(name)
    pairs = graph.boundaries(place)[0]
    small = np.bincount(place, graph.area) < least
    free = np.bincount(pairs.ravel(), minlength=len(names)) == 0  # touches nothing that it could join
    dropped = small & ~free & _lack_an_image(names, pairs, leading)
    if not dropped.any():
        return name
    return connect(graph, fill_unlabeled(graph, np.where(dropped[place], -1, name)))


def _lack_an_image(names: np.ndarray, pairs: np.ndarray, leading: _LeadingCells) -> np.ndarray:
    """Which cells lack an image that their leaders have, or have it apart from all images of their neighbors.

    names : (n,) int64, rising. pairs : (k, 2) int64, places of cells that touch. Returns (n,) bool.
    """
    touching = edge_keys(*pairs.T, count=len(names))
    leader, _ = leading.of_names(names)
    lack = np.zeros(len(names), bool)
    for element in leading.group.elements[1:]:
        image = _places(names, leading.name_of_image(names, element))
        images_touch = np.isin(edge_keys(*image[pairs].T, count=len(names)), touching)
        beside = np.zeros(len(names), bool)
        beside[pairs[images_touch & (image[pairs] >= 0).all(axis=1)]] = True
        lack |= leading.has_image[leader, element] & ~(beside & (image >= 0))
    return lack


def _places(names: np.ndarray, wanted: np.ndarray) -> np.ndarray:
    """Place of each of some wanted names among the names there are, which rise; -1 where it is not there."""
    place = np.searchsorted(names, wanted).clip(max=len(names) - 1)
    return np.where(names[place] == wanted, place, -1)


def _cell_tables(
    graph: FaceGraph, label: np.ndarray, images: _LeadingImages, leading: _LeadingCells, name: np.ndarray
) -> Cells:
    """The cells of faces, by the names of these, (p,), and what was found of them; label : (p,), candidates found."""
    group, weight = images.group, graph.weight
    names, cell = renumbered(name)
    every = arange(len(names))
    image = _places(names, leading.name_of_image(names[:, None], group.elements))
    _, to_leader = leading.of_names(names)
    # A cell that follows takes over all that is known of its leading image, instead of its own, nearly the same
    # numbers: so that rounding cannot make the two sides differ. Its image under an element is the leading image's
    # under another.
    own_leader = image[every, to_leader]
    follows = (to_leader > 0) & (own_leader >= 0)
    leader = np.where(follows, own_leader, every)
    from_leader = group.composition[:, group.inverse[np.where(follows, to_leader, 0)]].T
    candidate_there = label[images.image]
    found = np.stack([majority(cell, there, weight, len(names)) for there in candidate_there], axis=1)
    found = np.where(image >= 0, found, -1)[leader[:, None], from_leader]
    shares = _shares(cell, candidate_there, weight)
    shares_of = tuple(shares[leader + len(names) * element] for element in from_leader.T)
    leads = (image >= 0) & (to_leader[image] == 0)
    leads[~leads.any(axis=1), 0] = True
    return Cells(cell, found, shares_of, leads, image, np.bincount(cell, graph.area), group)


def _shares(cell: np.ndarray, candidate_there: np.ndarray, weight: np.ndarray) -> csr_array:
    """Share of the area of each image of each cell that lies in each candidate, (g * c, c') sparse.

    cell, weight : (p,). candidate_there : (g, p), candidate in which each image of each face lies.
    """
    order, n_cells = len(candidate_there), int(cell.max()) + 1
    area = np.bincount(cell, weight, n_cells)
    row = cell + n_cells * arange(order)[:, None]
    size = order * n_cells, int(candidate_there.max()) + 1
    return csr_array((np.tile(weight / area[cell], order), (row.ravel(), candidate_there.ravel())), size)

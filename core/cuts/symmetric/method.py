# SPDX-License-Identifier: GPL-3.0-or-later
"""Candidates and their hierarchy made the same on both sides of a plane of symmetry, or of several.

One side leads: its candidates and their mirror images are those of the whole, and candidates across the plane are kept
where both of their halves agree. What parts two of them is what the hierarchy found says, across the plane the mean of
both sides; average linkage, each merge with its mirror image, makes a hierarchy of that. Any method of cutting can be
made symmetric in this way, because only labels and a hierarchy are asked for.

Planes across each other divide a shape in quarters, or in eighths, one of which leads. Where exact planes meet at other
angles, as those of a star or a gear do, a wedge leads, and the shape is turned, too (``symmetry.group``).
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from itertools import product

import numpy as np

from ...arrays.int64 import arange
from ...mesh.face_graph import FaceGraph
from ...mesh.labels import disagreement, majority
from ...symmetry.group import SymmetryGroup
from ..face_candidates import FaceCandidates
from .cells import make_cells
from .linkage import symmetric_linkage

# At these details the parts of both sides are compared with those found. Where more pairs of points than WORST come
# together or apart, the faces are too large to be mirrored, or what was found speaks against the plane.
DETAILS, WORST = (0.3, 0.4, 0.5, 0.6, 0.7), 0.05
# A part below CRUMB of the area of the part found in which it lies comes of the mirroring alone: where the cut between
# two twins runs along the plane, small candidates lie across it, and what is its own image can only join both twins at
# once. Crumbs are dissolved so often at most.
CRUMB, MOST_ROUNDS = 0.2, 8
MOST_WEDGES = 8  # upper bound of the number of wedges of which each is tried as the one that leads
MOST_CANDIDATES = 2_000  # every pair of them is compared; of more, such as the blades of a lawn, all stay as they are


def symmetric_candidates(
    candidates: FaceCandidates, twin: np.ndarray, height: np.ndarray, first: float | np.ndarray = 1.0,
    sure: bool = False,
) -> FaceCandidates:
    """Make candidates and their hierarchy symmetric.

    Parameters
    ----------
    candidates : FaceCandidates
        Of p faces; all candidates are in use, and all of them merge in the end.
    twin : (p,) or (k, p) int64
        Mirror image of each face in each of k planes; -1 for none. With several planes a face that has an image in one
        has images in all, and the image of its image does not depend on the order of the two planes.
    height : (p,) or (k, p) float64
        Signed distance of each face from each plane.
    first : float or (k,) float64
        Above 0 if the side to which the normal points is to lead where both are equally good, below 0 for the other.
    sure : bool
        Whether the planes are beyond doubt: then nothing that was found on a side speaks against them.

    Returns
    -------
    candidates : FaceCandidates
        Every candidate is connected. Twins have twin candidates, and candidates merge when and as their twins do. The
        very object that was given if everything stays as it was found.

    Notes
    -----
    Of both sides, or all quarters, that one leads whose parts, mirrored, are most like those found on the whole. If
    none is much like them, the last of several planes is left out; without any, everything stays as it was found.
    What comes out as a part at detail 0.5 though it is a small share of one found is no part.
    """
    if candidates.hierarchy.n_candidates > MOST_CANDIDATES:
        return candidates
    twin, height, first = np.atleast_2d(twin), np.atleast_2d(height), np.atleast_1d(first)
    group, beside = SymmetryGroup.of_planes(twin), height * first[:, None]
    wedges = [(beside * np.reshape(signs, (-1, 1)) >= 0).all(axis=0) for signs in product((1, -1), repeat=len(beside))]
    best = _best(candidates, group, wedges, np.inf if sure else WORST)
    if best is None and len(twin) > 1:
        return symmetric_candidates(candidates, twin[:-1], height[:-1], first[:-1], sure)
    return best or candidates


def turned_candidates(candidates: FaceCandidates, group: SymmetryGroup, height: np.ndarray) -> FaceCandidates:
    """Make candidates and their hierarchy alike in all wedges of a shape whose planes of symmetry meet in an axis.

    Parameters
    ----------
    candidates : FaceCandidates
        As ``symmetric_candidates`` has them, of p faces.
    group : SymmetryGroup
        All exact.
    height : (p,) float64
        Signed distance of each face from a plane through the middle that is none of symmetry.

    Returns
    -------
    candidates : FaceCandidates
        What ``symmetric_candidates`` returns.
    """
    if candidates.hierarchy.n_candidates > MOST_CANDIDATES:
        return candidates
    # Of all images of a face the one farthest above the plane leads; those that lead form a wedge.
    wedge = height >= height[group.image].max(axis=0) - 1e-6 * np.abs(height).max()
    wedges = [wedge[group.image[element]] for element in group.elements[:: -(-len(group.elements) // MOST_WEDGES)]]
    return _best(candidates, group, wedges, np.inf) or candidates


def _best(
    candidates: FaceCandidates, group: SymmetryGroup, wedges: list[np.ndarray], worst: float
) -> FaceCandidates | None:
    """The candidates that are most like those found, of those that some wedges make if they lead.

    wedges : of (p,) bool, which faces lie in each. worst : bound of how unlike they may be before crumbs are dissolved;
    None if all are less alike.
    """
    mirroring = _Mirroring(candidates, group)
    if not mirroring.whole > 0:  # what has images are specks without an area
        return None
    best, least = None, np.inf
    for wedge in wedges:
        made = mirroring.led_by(wedge, np.zeros(len(wedge), bool))
        error = mirroring.error(made)
        if error >= worst - 1e-9:
            continue
        if (cleaned := _without_crumbs(made, wedge, mirroring)) is not made:
            made, error = cleaned, mirroring.error(cleaned)
        if error < least - 1e-9:
            best, least = made, error
        if least <= 1e-9:  # no other can be better
            break
    return best


@dataclass(frozen=True, eq=False)
class _Mirroring:
    """What candidates found become under a group of symmetries."""

    found: FaceCandidates
    group: SymmetryGroup

    @cached_property
    def concerned(self) -> np.ndarray:
        """(p,) float64, area of the faces of pieces that are mirrored; 0 of others."""
        return _mirrored_area(self.found.graph, self.group.image)

    @cached_property
    def whole(self) -> float:
        """Area of the pieces that are mirrored."""
        return float(self.concerned.sum())

    @cached_property
    def parts_found(self) -> list[np.ndarray]:
        """The parts found, (p,) int64, at each of DETAILS."""
        return [self.found.parts(detail) for detail in DETAILS]

    @cached_property
    def salience(self) -> np.ndarray:
        """(c, c) float64, of what parts two of the candidates found."""
        return self.found.hierarchy.salience_table(arange(int(self.found.label.max()) + 1))

    @cached_property
    def touching(self) -> FaceGraph:
        """The graph of the faces, with contacts."""
        return self.found.touching_graph()

    def led_by(self, wedge: np.ndarray, dissolved: np.ndarray) -> FaceCandidates:
        """The candidates if a wedge leads and some faces make none of their own; wedge, dissolved : (p,) bool."""
        cells = make_cells(self.found.graph, self.found.label, self.group, wedge, self.whole, dissolved)
        tree = symmetric_linkage(cells, self.touching, self.salience)
        return replace(self.found, label=cells.label, hierarchy=tree)

    def error(self, made: FaceCandidates) -> float:
        """How unlike the parts of some candidates are to those found, the mean over DETAILS."""
        return float(np.mean([disagreement(made.parts(detail), parts, self.concerned)
                              for detail, parts in zip(DETAILS, self.parts_found, strict=True)]))


def _without_crumbs(made: FaceCandidates, wedge: np.ndarray, mirroring: _Mirroring) -> FaceCandidates:
    """Candidates that a wedge has made, (p,) bool, with crumbs dissolved."""
    found, group = mirroring.found.parts(0.5), mirroring.group
    leader = group.image[group.first_onto(wedge), arange(len(wedge))]
    dissolved = np.zeros(len(wedge), bool)
    for _ in range(MOST_ROUNDS):
        more = _are_crumbs(made.graph, made.parts(0.5), found, leader) & ~dissolved
        if not more.any():
            break
        dissolved |= more
        made = mirroring.led_by(wedge, dissolved)
    return made


def _are_crumbs(graph: FaceGraph, part: np.ndarray, found: np.ndarray, leader: np.ndarray) -> np.ndarray:
    """Faces of parts that are small beside the part found in which most of them lies, (p,) bool.

    On a side that follows only where the image is no such part: what is small there may be whole on the leading side.

    part, found, leader : (p,), of each face the part now, the one found, and the image on the leading side.
    """
    area = np.bincount(part, graph.weight)
    area_found = np.bincount(found, graph.weight)[majority(part, found, graph.weight, len(area))]
    image = majority(part, part[leader], graph.weight, len(area))
    # Measured on one side: in another pose a limb may be half as long.
    less = np.bincount(part, graph.weight[leader]) < 0.5 * area[image]
    return (area < CRUMB * area_found)[part] & ((leader == arange(len(leader))) | less[part])


def _mirrored_area(graph: FaceGraph, image: np.ndarray) -> np.ndarray:
    """Area of the faces, (p,), in the connected pieces that have a twin somewhere; 0 of those in others."""
    count, piece = graph.pieces
    return np.where((np.bincount(piece, (image[1:] >= 0).any(axis=0), count) > 0)[piece], graph.area, 0.0)

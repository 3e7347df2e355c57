# SPDX-License-Identifier: GPL-3.0-or-later
"""Symmetric candidates of a dense mesh, found on regions of its faces instead of the faces themselves."""

from __future__ import annotations

import numpy as np

from ..surface.arrays import components
from ..surface.labels import FaceGraph, majority
from .hierarchy import Hierarchy
from .symmetric import symmetric_candidates

MANY = 20_000  # number of faces from which on regions are faster, and slivers are small


def symmetric_on_regions(
    graph: FaceGraph, contacts: np.ndarray, label: np.ndarray, hierarchy: Hierarchy, twin: np.ndarray,
    height: np.ndarray, first: float, exact: bool = False,
) -> tuple[np.ndarray, Hierarchy]:
    """What ``symmetric_candidates`` makes of one plane, but for slivers beside the cuts.

    Regions are connected faces on one side of the plane, of one candidate, whose images are of one candidate, too: all
    that is asked of a face is the same within a region.

    Parameters
    ----------
    graph, contacts, label, hierarchy
        As ``symmetric_candidates`` has them, of p faces.
    twin : (p,) int64
        Mirror image of each face; -1 for none.
    height : (p,) float64
        Signed distance of each face from the plane.
    first : float
    exact : bool

    Returns
    -------
    label : (p,) int64
    hierarchy : Hierarchy
        What ``symmetric_candidates`` returns.
    """
    image = np.append(label, -1)[twin] + 1
    kind = (label * (int(label.max()) + 2) + image) * 3 + np.sign(height).astype(np.int64)
    a, b = graph.pairs.T
    same = np.flatnonzero(kind[a] == kind[b])
    count, region = components(graph.n_faces, a[same], b[same])
    of_region = np.zeros(count, np.int64)
    of_region[region] = np.arange(graph.n_faces)  # any face of it
    has = np.flatnonzero(twin >= 0)
    area = np.bincount(region, graph.area, count)
    regions = FaceGraph(count, *graph.boundaries(region), area)
    touching = region[contacts]
    own = label[of_region]
    found, tree = symmetric_candidates(
        regions, touching[touching[:, 0] != touching[:, 1]], own, hierarchy,
        majority(region[has], region[twin[has]], graph.area[has] + 1e-12 * graph.area.sum(), count),
        height[of_region], first, exact)
    return (label, hierarchy) if found is own else (found[region], tree)

# SPDX-License-Identifier: GPL-3.0-or-later
"""Symmetric candidates of a dense mesh, found on regions of its faces instead of the faces themselves."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ...arrays.int64 import arange
from ...mesh.face_graph import FaceGraph
from ...mesh.labels import majority
from ..face_candidates import FaceCandidates
from .method import symmetric_candidates

MANY_FACES = 20_000  # number of faces from which on regions are faster, and slivers beside cuts are small


def symmetric_on_regions(
    candidates: FaceCandidates, twin: np.ndarray, height: np.ndarray, first: float, sure: bool = False
) -> FaceCandidates:
    """What ``symmetric_candidates`` makes of one plane, but for slivers beside the cuts.

    Regions are connected faces on one side of the plane, of one candidate, whose images are of one candidate, too: all
    that is asked of a face is the same within a region.

    Parameters
    ----------
    candidates : FaceCandidates
        As ``symmetric_candidates`` has them, of p faces.
    twin : (p,) int64
        Mirror image of each face; -1 for none.
    height : (p,) float64
        Signed distance of each face from the plane.
    first : float
    sure : bool

    Returns
    -------
    candidates : FaceCandidates
        What ``symmetric_candidates`` returns.
    """
    graph, label = candidates.graph, candidates.label
    image = np.append(label, -1)[twin] + 1
    kind = (label * (int(label.max()) + 2) + image) * 3 + np.sign(height).astype(np.int64)
    count, region = graph.regions(kind)
    of_region = np.zeros(count, np.int64)
    of_region[region] = arange(graph.n_faces)  # any face of it
    has = np.flatnonzero(twin >= 0)
    area = np.bincount(region, graph.area, count)
    touching = region[candidates.contacts]
    regions = FaceCandidates(FaceGraph(count, *graph.boundaries(region), area),
                             touching[touching[:, 0] != touching[:, 1]], label[of_region], candidates.hierarchy)
    image_of_region = majority(
        region[has], region[twin[has]], graph.weight[has], count)
    made = symmetric_candidates(regions, image_of_region, height[of_region], first, sure)
    if made is regions:
        return candidates
    return replace(candidates, label=made.label[region], hierarchy=made.hierarchy)

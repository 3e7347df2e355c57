# SPDX-License-Identifier: GPL-3.0-or-later
"""Patches that end at level sets only, for cuts that stay on them."""

from __future__ import annotations

import numpy as np

from ...graph.level_sets import LevelSets, cut_at_levels, uniform_levels
from ...mesh.face_graph import FaceGraph
from ...mesh.labels import majority
from ..patches import SMALLEST, absorb_small

SLABS = 24  # number of slabs whose pieces are the patches of ``level_set_patches``


def level_set_patches(sets: LevelSets) -> np.ndarray:
    """Divide a surface into patches that end at level sets only: the pieces of SLABS slabs.

    Parameters
    ----------
    sets : LevelSets
        Level sets of one connected component, m faces.

    Returns
    -------
    label : (m,) int64
        Patch of each face, 0..c-1; every patch is connected.
    """
    coarse = cut_at_levels(sets.mesh, sets.values, uniform_levels(SLABS))
    piece = majority(coarse.element_face, coarse.element_piece, coarse.element_weight, sets.mesh.n_faces)
    return absorb_small(sets.mesh, FaceGraph.of(sets.mesh).regions(piece)[1], SMALLEST)

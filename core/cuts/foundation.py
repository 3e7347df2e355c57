# SPDX-License-Identifier: GPL-3.0-or-later
"""What is known of a component before it is cut, whatever the method."""

from __future__ import annotations

from typing import NamedTuple

from ..field.agd import ScalarField
from ..graph.level_sets import LevelSets
from ..surface.coarsening import Pyramid


class Foundation(NamedTuple):
    """What all methods and the Reeb graph of one component begin with.

    Attributes
    ----------
    pyramid : Pyramid
        Coarser copies of the component's mesh.
    field : ScalarField
        AGD of the component.
    sets : LevelSets
        Level sets of that field.
    """

    pyramid: Pyramid
    field: ScalarField
    sets: LevelSets

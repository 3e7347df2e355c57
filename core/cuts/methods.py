# SPDX-License-Identifier: GPL-3.0-or-later
"""The methods of cutting, behind one function: what each needs of a component is what it is given."""

from __future__ import annotations

from collections.abc import Callable

from ..field.agd import ScalarField
from ..graph.level_sets import LevelSets
from ..graph.reeb import ReebTopology
from ..parameters import PERCEPTUAL, Parameters
from ..surface.coarsening import Pyramid
from .berretti.method import berretti_candidates
from .hierarchy import Candidates
from .perceptual.boosted_trees import BoostedTrees
from .perceptual.method import perceptual_candidates


def find_candidates(
    sets: LevelSets,
    field: ScalarField,
    topology: ReebTopology,
    pyramid: Pyramid,
    parameters: Parameters,
    model: BoostedTrees | None = None,
    progress: Callable[[float], None] | None = None,
) -> Candidates:
    """Find the candidate parts of one component by the method that the parameters name.

    Parameters
    ----------
    sets : LevelSets
        Of one connected component.
    field : ScalarField
        Its AGD.
    topology : ReebTopology
        Its Reeb graph, simplified.
    pyramid : Pyramid
        Coarser copies of its mesh.
    parameters : Parameters
    model : BoostedTrees, optional
        What judges cuts in "perceptual"; the model that ships with the package without.
    progress : callable, optional
        Called with the share done, 0..1.

    Returns
    -------
    candidates : Candidates
    """
    if parameters.method == PERCEPTUAL:
        return perceptual_candidates(sets, field, pyramid, parameters, model, progress)
    return berretti_candidates(sets, topology, parameters)

# SPDX-License-Identifier: GPL-3.0-or-later
"""The methods of cutting behind one function, which gives each method what it needs of a component."""

from __future__ import annotations

from collections.abc import Callable

from ..field.agd import ScalarField
from ..graph.level_sets import LevelSets
from ..graph.reeb import ReebTopology
from ..parameters import BERRETTI, LAVOUE, LIU, PERCEPTUAL, Parameters
from ..surface.coarsening import Pyramid
from .berretti.method import berretti_candidates
from .boosted_trees import BoostedTrees
from .hierarchy import Candidates
from .lavoue.method import lavoue_candidates
from .liu.method import liu_candidates
from .perceptual.method import perceptual_candidates


def find_candidates(
    sets: LevelSets,
    field: ScalarField,
    topology: Callable[[], ReebTopology],
    pyramid: Pyramid,
    parameters: Parameters,
    model: BoostedTrees | None = None,
    progress: Callable[[float], None] | None = None,
) -> Candidates:
    """Find the candidate parts of one component by the method that the parameters name.

    Parameters
    ----------
    sets : LevelSets
        Level sets of one connected component.
    field : ScalarField
        AGD of the component.
    topology : callable
        Returns the Reeb graph of the component, simplified; the method "berretti" alone calls it.
    pyramid : Pyramid
        Coarser copies of the component's mesh.
    parameters : Parameters
    model : BoostedTrees, optional
        Model that judges cuts in the method "perceptual". Without it, the model that ships with the package.
    progress : callable, optional
        Called with the share done, 0..1.

    Returns
    -------
    candidates : Candidates

    Raises
    ------
    ReebError
        The model that ships with the package was trained on other features; only if it is needed.
    """
    if parameters.method == PERCEPTUAL:
        return perceptual_candidates(sets, field, pyramid, parameters, model, progress)
    if parameters.method == BERRETTI:
        candidates = berretti_candidates(sets, topology(), parameters)
        n_pieces, piece = sets.mesh.face_components
        return candidates if n_pieces == 1 else candidates.within(piece[sets.element_face])
    if parameters.method == LAVOUE:
        label, hierarchy = lavoue_candidates(sets.mesh, parameters.n_clusters)
    elif parameters.method == LIU:
        label, hierarchy = liu_candidates(sets.mesh, parameters.outline_weight, progress)
    else:
        raise AssertionError(parameters.method)  # Parameters takes no other
    return Candidates(label[sets.element_face], hierarchy)

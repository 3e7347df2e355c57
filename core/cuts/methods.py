# SPDX-License-Identifier: GPL-3.0-or-later
"""The methods of cutting behind one function, which gives each method what it needs of a component."""

from __future__ import annotations

from collections.abc import Callable

from ..graph.reeb import ReebTopology
from ..parameters import BERRETTI, LAVOUE, LIU, PERCEPTUAL, Parameters
from .berretti.method import berretti_candidates
from .boosted_trees import BoostedTrees
from .foundation import Foundation
from .hierarchy import Candidates
from .lavoue.method import lavoue_candidates
from .liu.method import liu_candidates
from .perceptual.method import perceptual_candidates


def find_candidates(
    foundation: Foundation,
    topology: Callable[[], ReebTopology],
    parameters: Parameters,
    model: BoostedTrees | None = None,
    progress: Callable[[float], None] | None = None,
) -> Candidates:
    """Find the candidate parts of one component by the method that the parameters name.

    Parameters
    ----------
    foundation : Foundation
    topology : callable
        Returns the Reeb graph of the component, simplified; the method "berretti" alone calls it.
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
        return perceptual_candidates(foundation, parameters, model, progress)
    sets = foundation.sets
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

# SPDX-License-Identifier: GPL-3.0-or-later
"""Every method that parameters can name is one that cuts."""

import numpy as np
import pytest
import shapes

from core.cuts.foundation import Foundation
from core.cuts.methods import find_candidates
from core.field.agd import protrusion_field
from core.graph.level_sets import cut_at_levels, uniform_levels
from core.graph.reeb import reeb_topology
from core.graph.simplify import without_ripples
from core.mesh.triangles import TriMesh
from core.parameters import METHODS, Parameters
from core.surface.coarsening import Pyramid


@pytest.fixture(scope="module")
def stages():
    """Pyramid, field and level sets of a small surface with limbs, and its topology."""
    mesh = TriMesh(*shapes.dumbbell(neck=0.05))
    pyramid = Pyramid(mesh)
    field = protrusion_field(pyramid, 0.005, True)
    sets = cut_at_levels(mesh, field.values, uniform_levels(50))
    return Foundation(pyramid, field, sets), lambda: without_ripples(sets, reeb_topology(sets), field)


@pytest.mark.parametrize("method", METHODS)
def test_each_method_partitions_the_surface_and_merges_all(stages, method):
    found = find_candidates(*stages, Parameters(method=method))
    sets, used = stages[0].sets, np.unique(found.element_candidate)
    assert found.element_candidate.shape == sets.element_face.shape
    assert used.tolist() == list(range(found.hierarchy.n_candidates))
    assert found.hierarchy.n_loose == 1


def test_no_two_methods_cut_alike(stages):
    """A name whose branch is another method's would go unseen by the partition alone."""
    found = [find_candidates(*stages, Parameters(method=method)) for method in METHODS]
    assert len({(f.element_candidate.tobytes(), f.hierarchy.salience.tobytes()) for f in found}) == len(METHODS)

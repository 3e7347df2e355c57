# SPDX-License-Identifier: GPL-3.0-or-later
"""The method of the paper, from level sets to candidates."""

import numpy as np
import pytest
import shapes
from heights import counted

from core.arrays.components import components
from core.cuts.berretti.boundary_search import concavities
from core.cuts.berretti.method import berretti_candidates
from core.cuts.berretti.regions import berretti_regions, with_finer
from core.graph.level_sets import cut_at_levels, uniform_levels
from core.graph.reeb import reeb_topology
from core.graph.simplify import simplify
from core.mesh.triangles import TriMesh
from core.parameters import Parameters
from core.surface.curvature import k_min

PAPER = Parameters.preset("Berretti 2009")


def candidates(shape, direction, **changes):
    values = shape.vertices @ np.asarray(direction, float)
    sets = cut_at_levels(TriMesh(*shape), (values - values.min()) / np.ptp(values), uniform_levels(50))
    topology = simplify(sets, reeb_topology(sets), 0.0025, 1, counted(sets))
    parameters = Parameters.preset("Berretti 2009", **changes)
    found = berretti_candidates(sets, topology, parameters)
    return sets, topology, found.element_candidate, found.hierarchy


@pytest.fixture(params=["tree", "genus 2", "dumbbell", "border"])
def made(request):
    return {
        "tree": lambda: candidates(shapes.tube_tree(), (0.3, 1, 0.2), small_region=0.02),
        "genus 2": lambda: candidates(shapes.surface_of_genus(2), (1, 0.1, 0)),
        "dumbbell": lambda: candidates(shapes.dumbbell(), (1, 0, 0.2)),
        "border": lambda: candidates(shapes.flat_grid(30, 20), (1, 0.4, 0)),
    }[request.param]()


def test_every_element_has_a_candidate_of_the_hierarchy(made):
    sets, _, element, hierarchy = made
    assert element.shape == sets.element_face.shape
    assert element.min() >= 0
    assert element.max() < hierarchy.n_candidates
    assert hierarchy.n_loose == 1


def test_a_candidate_is_made_of_whole_pieces(made):
    # The paper's cuts run along level sets.
    sets, _, element, _ = made
    assert len(np.unique(sets.element_piece * (element.max() + 1) + element)) == sets.n_pieces


def test_parts_of_the_papers_decision_are_connected(made):
    sets, _, element, hierarchy = made
    part = hierarchy.parts_at(0.5)[element]
    piece = np.empty(sets.n_pieces, np.int64)
    piece[sets.element_piece] = part
    same = piece[sets.contour_pieces[:, 0]] == piece[sets.contour_pieces[:, 1]]
    assert components(sets.n_pieces, *sets.contour_pieces[same].T)[0] == len(np.unique(part))


def test_without_concavity_the_regions_stay():
    sets, topology, element, hierarchy = candidates(shapes.tube_tree(), (0.3, 1, 0.2), concavity_weight=0.0)
    regions = berretti_regions(sets, topology, PAPER.small_region)
    kept = regions.hierarchy.parts(regions.hierarchy.n_candidates)[regions.piece_region]
    regions = with_finer(sets, topology, regions, PAPER.small_region)
    # What is finer merges first, and then the regions are what they were.
    assert regions.hierarchy.n_candidates > kept.max() + 1
    again = regions.hierarchy.parts(int(kept.max()) + 1)[regions.piece_region]
    assert len(np.unique(again * sets.n_pieces + kept)) == kept.max() + 1
    np.testing.assert_array_equal(element, regions.piece_region[sets.element_piece])
    np.testing.assert_array_equal(hierarchy.merges, regions.hierarchy.merges)


def test_concavity_pulls_cuts_into_creases():
    # Two handles, between whose feet the surface is concave: the narrowest level set is not that of the saddle.
    shape = shapes.surface_of_genus(2)
    height = shape.vertices @ (0.2, 1.0, 0.1)
    sets = cut_at_levels(TriMesh(*shape), (height - height.min()) / np.ptp(height), uniform_levels(50))
    topology = simplify(sets, reeb_topology(sets), 0.0025, 1, counted(sets))
    curvature = k_min(sets.mesh)

    def cuts(alpha):
        found = berretti_candidates(sets, topology, Parameters.preset("Berretti 2009", concavity_weight=alpha))
        element, hierarchy = found.element_candidate, found.hierarchy
        piece = np.empty(sets.n_pieces, np.int64)
        piece[sets.element_piece] = hierarchy.parts_at(0.5)[element]
        lower, upper = piece[sets.contour_pieces].T
        return np.flatnonzero((lower != upper) & (topology.contour_arc >= 0))

    def energy(contours):
        return concavities(sets, curvature, contours, PAPER.sigma)

    stay, slide = cuts(0.0), cuts(1.0)
    assert len(stay) == len(slide) >= 4
    assert np.mean(energy(slide)) < np.mean(energy(stay)) - 0.003
    assert max(np.sort(energy(slide)) - np.sort(energy(stay))) <= 0


def test_upright_dumbbell_has_no_branch_and_so_one_part():
    # Seen along its own axis every level set is one circle: the graph is one arc.
    _, _, element, hierarchy = candidates(shapes.dumbbell(), (0, 0, 1))
    assert hierarchy.n_candidates == 1
    assert (element == 0).all()

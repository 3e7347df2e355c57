# SPDX-License-Identifier: GPL-3.0-or-later
"""The way back to the caller's faces: what has no area there."""

import numpy as np
import pytest
import shapes

from core import Parameters, decompose
from core.cuts.face_candidates import FaceCandidates
from core.cuts.hierarchy import Hierarchy
from core.mesh.polygons import PolygonMesh
from core.result.assemble import face_graph_of, tables_of
from core.surface.preparation import repair


def test_faces_without_area_that_touch_only_each_other_follow_the_nearest():
    shape = shapes.two_spheres()
    n = len(shape.vertices)
    beside = shape.vertices[shape.vertices[:, 0].argmax()] + (0.1, 0, 0)
    vertices = np.concatenate([shape.vertices, [beside, beside]])
    chain = [[n, n, n + 1], [n + 1, n + 1, n]]
    found = decompose(vertices, np.concatenate([shape.faces, chain]))
    nearest = np.linalg.norm(shape.vertices[shape.faces].mean(axis=1) - beside, axis=1).argmin()
    two = found.parts(n_parts=2).labels
    assert (two[-2:] == two[nearest]).all()
    for count in range(1, found.n_candidates + 1):
        assert found.parts(n_parts=count).count == count


def test_a_vertex_is_of_the_candidate_of_most_of_the_area_around_it():
    vertices, faces = shapes.icosphere(3)
    given = PolygonMesh.of(vertices + 0.03 * np.random.default_rng(0).normal(size=vertices.shape), faces)
    working = repair(given)
    label = (given.triangles.face_centroids[:, 0] > 0) + 2 * (given.triangles.face_centroids[:, 1] > 0.1)
    graph = face_graph_of(given, working)
    candidates = FaceCandidates(graph, np.empty((0, 2), int), label, Hierarchy.of(4, [], []))
    around = np.zeros((len(vertices), 4))
    np.add.at(around, (faces, label[:, None]), given.triangles.face_area[:, None])
    assert tables_of(given, working, candidates).vertex_candidates.tolist() == around.argmax(axis=1).tolist()


@pytest.mark.parametrize(("more", "notes"), [(0, 0), (1, 1)])
def test_as_many_parts_as_there_can_be_are_not_too_many(more, notes):
    shape = shapes.tube_tree(step=0.2)
    most = decompose(*shape).n_candidates
    found = decompose(*shape, Parameters(n_parts=most + more)).notes
    assert len([note for note in found if "asked for" in note]) == notes


@pytest.mark.parametrize("half", [False, True])
def test_the_note_on_too_many_parts_is_that_of_the_run(half):
    """A result that is used again for another number says of this one what a run of its own would."""
    shape = shapes.tube_tree(step=0.2)
    mirror = [1.0, 0.0, 0.0, 2.0 * np.ptp(shape.vertices[:, 0])] if half else None
    few, many = (decompose(*shape, Parameters(n_parts=count), mirror=mirror) for count in (2, 5000))
    assert few.asked(many.parameters).notes == many.notes
    assert many.asked(few.parameters).notes == few.notes
    assert f"5000 parts were asked for; there are {many.n_candidates} at most." in many.notes
    assert not [note for note in few.notes if "asked for" in note]

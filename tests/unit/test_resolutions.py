# SPDX-License-Identifier: GPL-3.0-or-later
"""The same shape at two resolutions gets the same parts, within what the faces of the coarser mesh allow."""

from pathlib import Path

import numpy as np
import pytest
import shapes
from scipy.spatial import cKDTree

from core import Parameters, decompose
from core.mesh.triangles import TriMesh
from core.metrics import rand_index_error
from core.surface.coarsening import coarsen

SPOT = Path(__file__).parents[2] / "models" / "spot.obj"


def spot():
    """The bundled model."""
    rows = [line.split() for line in SPOT.read_text().splitlines()]
    vertices = [[float(x) for x in row[1:4]] for row in rows if row and row[0] == "v"]
    faces = [[int(x.split("/")[0]) - 1 for x in row[1:4]] for row in rows if row and row[0] == "f"]
    return np.array(vertices), np.array(faces)


def coarsened(shape, times):
    """A copy of about a quarter of the faces, so many times."""
    mesh = TriMesh(*shape)
    for _ in range(times):
        mesh = coarsen(mesh, mesh.vertex_area).mesh
    return mesh.vertices, mesh.faces


def difference(fine, coarse, parameters):
    """Rand index error between the parts of two meshes of one shape over the faces of the finer; numbers of parts."""
    ours, theirs = decompose(*fine, parameters).parts(), decompose(*coarse, parameters).parts()
    near = cKDTree(TriMesh(*coarse).face_centroids).query(TriMesh(*fine).face_centroids)[1]
    # What one or two of the larger faces make up is no part that a person would count.
    counts = ((parts.share > 0.004).sum() for parts in (ours, theirs))
    return rand_index_error(ours.labels, theirs.labels[near]), *counts


@pytest.mark.parametrize(("times", "n_faces", "limit"), [(1, 1358, 0.085), (2, 340, 0.125)])
def test_the_bundled_model_decimated(times, n_faces, limit):
    """Mean of four copies: in one, a cut at a leg more or less is chance."""
    errors, counts = [], []
    for stretch in (1.0, 1.01, 1.02, 1.03):  # which vertices a copy keeps is decided by their places
        vertices, faces = coarsened((spot()[0] * (stretch, 1.0, 1.0), spot()[1]), times)
        assert 0.9 * n_faces < len(faces) < 1.1 * n_faces
        error, ours, theirs = difference(spot(), (vertices / (stretch, 1.0, 1.0), faces), Parameters())
        errors.append(error)
        counts.append(abs(ours - theirs))
    assert np.mean(errors) < limit
    assert np.mean(counts) <= 2


def test_a_dumbbell_of_four_thousand_faces_and_of_four_hundred():
    # The coarser has a row of edges in the middle, where people cut; faces across it could be in one half only.
    error, ours, theirs = difference(shapes.dumbbell(), shapes.dumbbell(21, 10), Parameters())
    assert error < 0.05
    assert ours == theirs == 2


def test_a_tree_of_many_faces_and_of_few():
    """Mean of five pairs of densities: where a cut meets the larger faces is chance. What they allow is 0.012."""
    errors = []
    for fine, coarse in ((0.06, 0.2), (0.07, 0.2), (0.06, 0.15), (0.08, 0.25), (0.05, 0.18)):
        error, ours, theirs = difference(shapes.tube_tree(4, fine), shapes.tube_tree(4, coarse), Parameters())
        assert abs(ours - theirs) <= 1
        errors.append(error)
    assert np.mean(errors) < 0.028

# SPDX-License-Identifier: GPL-3.0-or-later
"""Points that are scattered over pieces."""

import numpy as np
import pytest
import shapes

from core.mesh.pieces import scattered
from core.mesh.triangles import TriMesh


@pytest.mark.parametrize("shape", [shapes.octahedron(), shapes.torus(24, 8)], ids=["alike", "of any size"])
def test_points_lie_on_their_faces_evenly(shape):
    mesh = TriMesh(*shape)
    some = np.arange(1, mesh.n_faces)
    face, point = scattered(mesh, some, mesh.face_area[some], 1000)
    assert np.isin(face, some).all()
    expected = 1000 * mesh.face_area[some] / mesh.face_area[some].sum()
    assert np.abs(np.bincount(face, minlength=mesh.n_faces)[some] - expected).max() < 1 + 1e-9
    shares = np.linalg.solve(mesh.corners[face].transpose(0, 2, 1), point[:, :, None])[:, :, 0]
    assert shares.min() >= -1e-9
    assert shares.sum(axis=1) == pytest.approx(1)
    # As often near each corner as elsewhere.
    assert shares.mean(axis=0) == pytest.approx(1 / 3, abs=0.02)

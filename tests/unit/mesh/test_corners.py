# SPDX-License-Identifier: GPL-3.0-or-later
"""The smallest and the largest label of the faces at each edge, at edges of any number of faces."""

import numpy as np
import pytest

from core.mesh.corners import edge_labels


@pytest.mark.parametrize("seed", range(3))
def test_they_are_those_of_all_faces_there(seed):
    """Edges of no face, of one, two and of several, in any order of the corners."""
    rng = np.random.default_rng(seed)
    n_edges, n_faces = 40, 30
    edge = rng.integers(0, n_edges - 5, 60)
    face = rng.integers(0, n_faces, len(edge))
    labels = rng.integers(0, 6, n_faces)
    low, high = edge_labels(edge, face, labels, n_edges)
    assert (low.dtype, high.dtype) == (np.int64, np.int64)
    for index in range(n_edges):
        there = labels[face[edge == index]]
        assert low[index] == (there.min() if len(there) else np.iinfo(np.int64).max)
        assert high[index] == (there.max() if len(there) else -1)
    assert np.bincount(edge, minlength=n_edges).max() > 3

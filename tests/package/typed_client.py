# SPDX-License-Identifier: GPL-3.0-or-later
"""How a script that is checked strictly uses the package; tools/lint.py has mypy look at it, nothing runs it."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from reeb_parts import (
    PRESETS,
    Decomposition,
    Hierarchy,
    MeshError,
    Parameters,
    Parts,
    ReebError,
    ReebGraph,
    TriMesh,
    decompose,
    face_colors,
    read_model,
)
from reeb_parts.core import metrics


def of_file(path: str, other: NDArray[np.int64]) -> tuple[NDArray[np.int64], float]:
    """Parts of a model, and how far they are from others."""
    model = read_model(path)
    result: Decomposition = decompose(model, parameters=Parameters.preset(next(iter(PRESETS))))
    parts: Parts = result.parts(n_parts=3)
    colors: NDArray[np.uint8] = face_colors(parts)
    labels: NDArray[np.int64] = parts.labels
    assert len(colors) == len(labels)
    return labels, metrics.rand_index_error(labels, other)


def of_arrays(vertices: NDArray[np.float64], faces: NDArray[np.int64]) -> tuple[int, float]:
    """Loops of the graph, and how salient the first cut is; 0 for what is no mesh."""
    try:
        result = decompose(vertices, faces, {"detail": 0.3}, hints=[1, 2], mirror=(1, 0, 0, 0))
    except MeshError as error:
        wrong: NDArray[np.int64] = error.faces
        return len(wrong), 0.0
    except ReebError:
        return 0, 0.0
    graph: ReebGraph = result.graph
    hierarchy: Hierarchy = result.hierarchy
    return graph.n_loops, float(hierarchy.salience[0])


def area(mesh: TriMesh) -> float:
    """What a name of the package is when it stands for a type."""
    return mesh.area

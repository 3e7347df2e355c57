# SPDX-License-Identifier: GPL-3.0-or-later
"""How far parts are from what people drew: every measure of core.metrics, averaged over the people."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np

from core.mesh.labels import majority
from core.mesh.triangles import TriMesh
from core.metrics import (
    agreement,
    consistency_error,
    cut_discrepancy,
    hamming_distance,
    mean_intersection_over_union,
    rand_index_error,
)

#: Measures by name: the heading of their column, and whether more is better.
MEASURES = {
    "error": ("Rand index error", False), "agreement": ("agreement (12)", True), "hamming": ("Hamming", False),
    "missing": ("Rm", False), "false_alarm": ("Rf", False), "global_error": ("GCE", False),
    "local_error": ("LCE", False), "discrepancy": ("cut discrepancy", False), "miou": ("mean IoU", True),
}


def score(mesh: TriMesh, labels: np.ndarray, people: np.ndarray) -> dict[str, float]:
    """Every measure of MEASURES, the mean over the people.

    mesh : TriMesh, m faces. labels : (m,) int64. people : (p, m) int64. The agreement is over vertices, as in the
    paper; NaN where a measure is defined for nobody.
    """
    vertex = vertex_labels(mesh, labels)
    used = vertex >= 0
    rows = []
    for person in people:
        missing, false_alarm = hamming_distance(labels, person, mesh.face_area)
        global_error, local_error = consistency_error(labels, person, mesh.face_area)
        rows.append({
            "error": rand_index_error(labels, person),
            "agreement": agreement(vertex[used], vertex_labels(mesh, person)[used]),
            "hamming": (missing + false_alarm) / 2, "missing": missing, "false_alarm": false_alarm,
            "global_error": global_error, "local_error": local_error,
            "discrepancy": cut_discrepancy(mesh, labels, person),
            "miou": mean_intersection_over_union(labels, person, mesh.face_area),
        })
    return {name: mean(row[name] for row in rows) for name in MEASURES}


def mean(values) -> float:
    """Mean of the finite values; NaN if there are none."""
    values = np.array([value for value in values if value is not None], float)
    values = values[np.isfinite(values)]
    return float(values.mean()) if len(values) else float("nan")


def vertex_labels(mesh: TriMesh, labels: np.ndarray) -> np.ndarray:
    """Label of most faces around each vertex, (n,) int64; -1 for a vertex of no face."""
    labels = np.asarray(labels, np.int64)
    return majority(mesh.faces.ravel(), np.repeat(labels, 3), np.ones(mesh.faces.size), mesh.n_vertices)


def typical(people: np.ndarray) -> int:
    """The person whose labels, (p, m), are nearest to those of all others."""
    apart = [np.mean([rand_index_error(one, other) for other in people]) for one in people]
    return int(np.argmin(apart))


def median_parts(people: np.ndarray) -> int:
    """Median of the people's numbers of parts."""
    return int(np.median([len(np.unique(person)) for person in people]))


def labels_path(out: Path, method: str, number: int) -> Path:
    """Where the labels that are scored are in the folder of a report, one number per face of the mesh."""
    return out / re.sub(r"\W+", "_", method.partition("=")[0].lower()) / f"{number}.npy"

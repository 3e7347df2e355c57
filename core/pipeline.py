# SPDX-License-Identifier: GPL-3.0-or-later
"""The one door: arrays in, a decomposition out. The stages of the method, in order."""

from __future__ import annotations

import numpy as np

from .cuts.methods import find_candidates
from .cuts.perceptual.boosted_trees import BoostedTrees
from .field.agd import protrusion_field
from .graph.level_sets import cut_at_levels, uniform_levels
from .graph.reeb import reeb_graph, reeb_topology
from .graph.simplify import without_ripples
from .parameters import Parameters
from .progress import Progress, Stopwatch
from .result.assemble import ComponentResult, assemble
from .result.decomposition import Decomposition
from .surface.coarsening import Pyramid
from .surface.polygons import PolygonMesh
from .surface.preparation import Component, WorkingMesh, components_worth_cutting, repair

# Shares of the whole time, on a mesh of some 100,000 vertices, at which the preparation of the whole mesh ends and
# at which the assembly of the result begins.
MESH_SHARE, PARTS_SHARE = 0.14, 0.9


def decompose(
    vertices,
    faces,
    parameters: Parameters | None = None,
    polygon=None,
    progress: Progress | None = None,
    model: BoostedTrees | None = None,
) -> Decomposition:
    """Cut a mesh into parts.

    Parameters
    ----------
    vertices : (n, 3) array_like of float
    faces : (m, k) array_like of int, or a sequence of index sequences
        Triangles, quads or polygons.
    parameters : Parameters, optional
        The default preset without.
    polygon : (m,) array_like of int, optional
        For triangles that are a triangulation of the caller's polygons: the polygon of each.
        Labels are then per polygon.
    progress : callable, optional
        Called as progress(stage, share) between and within stages, share rising from 0 to 1.
        What it raises ends the computation; raise ``Cancelled`` to cancel.
    model : BoostedTrees, optional
        What judges cuts in the method "perceptual"; the model that ships with the package without.

    Returns
    -------
    decomposition : Decomposition
        ``decomposition.parts().labels`` is one part per face.

    Raises
    ------
    MeshError
        Shapes, indices or coordinates are wrong, or the mesh is too small to have parts.
    ParameterError
        Raised by ``Parameters`` itself.

    Notes
    -----
    Deterministic. Time is about that of one Dijkstra search per base vertex (some 140), the
    rest grows with faces + crossings of faces and levels.
    """
    parameters = parameters or Parameters()
    watch = Stopwatch(progress)
    with watch.stage("mesh", MESH_SHARE):
        given = PolygonMesh.of(vertices, faces, polygon)
        working = repair(given)
        chosen = components_worth_cutting(working, parameters.loose_part)
    results = []
    for done, label in enumerate(chosen):
        width = (PARTS_SHARE - MESH_SHARE) / len(chosen)
        begin = MESH_SHARE + done * width
        watch.share = begin
        results.append(_decompose_component(working, label, parameters, model, watch, begin, width))
    with watch.stage("parts", 1.0):
        result = assemble(given, working, results, parameters, watch.seconds)
    watch.progress("done", 1.0)
    return result


def _decompose_component(
    working: WorkingMesh, label: int, parameters: Parameters, model: BoostedTrees | None,
    watch: Stopwatch, begin: float, width: float,
) -> ComponentResult:
    """All stages on one connected component; they take a share ``width`` of the whole from ``begin`` on."""
    with watch.stage("mesh", begin + 0.05 * width):
        component = Component.of(working, label)
        pyramid = Pyramid(component.mesh)
    with watch.stage("distances", begin + 0.4 * width) as progress:
        field = protrusion_field(pyramid, parameters.base_spacing, parameters.equalize, progress)
    with watch.stage("reeb graph", begin + 0.5 * width):
        levels = uniform_levels(parameters.n_slabs) if field.values.any() else np.empty(0)
        sets = cut_at_levels(component.mesh, field.values, levels)
        topology = without_ripples(sets, reeb_topology(sets), field)
        graph = reeb_graph(sets, topology)
    with watch.stage("cuts", begin + width) as progress:
        candidates = find_candidates(sets, field, topology, pyramid, parameters, model, progress)
    return ComponentResult(component, field, sets, topology, graph, candidates)

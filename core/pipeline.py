# SPDX-License-Identifier: GPL-3.0-or-later
"""``decompose``, which takes arrays, runs the stages of the method in order and returns a decomposition."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from functools import cache
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from .arrays.indexing import underflow_is_zero
from .cuts.boosted_trees import BoostedTrees
from .cuts.foundation import Foundation
from .cuts.hierarchy import Candidates
from .cuts.joining.method import JoinModel, fine_parts, join_parts
from .cuts.methods import find_candidates
from .field.agd import ScalarField, protrusion_field
from .graph.level_sets import LevelSets, cut_at_levels, uniform_levels
from .graph.reeb import ReebGraph, ReebTopology, reeb_graph, reeb_topology
from .graph.simplify import without_ripples
from .mesh.arguments import hints_of
from .mesh.copies import find_copies
from .mesh.grounds import find_standing
from .mesh.polygons import PolygonMesh
from .parameters import BERRETTI, TOGETHER, Parameters
from .progress import Progress, Stopwatch
from .result.assemble import assemble
from .result.component_results import ComponentResult, Findings
from .result.decomposition import Decomposition
from .result.half import of_half
from .result.on_ground import with_grounds
from .surface.coarsening import Pyramid
from .surface.ordering import Ordering, sorted_by_place
from .surface.orientation import without_copies
from .surface.preparation import Component, WorkingMesh, bodies, repair
from .symmetry.halves import completed, plane_of
from .symmetry.mirrors import Mirror, find_mirrors

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

try:
    from .second_thread import meanwhile
except ModuleNotFoundError:  # as in Blender's extension: what is to be done meanwhile is done when it is asked for
    from functools import partial as meanwhile  # type: ignore[assignment]

# Shares of the time of a run, 0..1, at which the preparation of the whole mesh ends and at which the assembly of the
# result begins; measured on a mesh of some 100,000 vertices. Progress is reported by them.
MESH_SHARE, PARTS_SHARE = 0.14, 0.9


@underflow_is_zero
def decompose(
    vertices: ArrayLike,
    faces: ArrayLike | Sequence[Sequence[int]],
    parameters: Parameters | Mapping[str, Any] | None = None,
    polygon: ArrayLike | None = None,
    progress: Progress | None = None,
    model: BoostedTrees | None = None,
    join_model: JoinModel | None = None,
    mirror: ArrayLike | None = None,
    hints: ArrayLike | None = None,
) -> Decomposition:
    """Cut a mesh into parts.

    Parameters
    ----------
    vertices : (n, 3) array_like of float
        Positions, in any unit of length.
    faces : (p, k) array_like of int, or a sequence of p index sequences
        Vertices of each face: triangles, quads or polygons.
    parameters : Parameters or mapping, optional
        A mapping has values by the names of parameters. Without it, the preset "Perceptual".
    polygon : (m,) array_like of int, optional
        For a caller who has cut polygons into triangles already: ``faces`` are then (m, 3) triangles, and this is the
        polygon of each. The faces of the result are the polygons.
    progress : callable, optional
        Called as progress(stage, share) between and within stages, share rising from 0 to 1. An exception that it
        raises ends the run; it raises ``Cancelled`` to cancel.
    model : BoostedTrees, optional
        Model that judges cuts in the method "perceptual". Without it, the model that ships with the package.
    join_model : JoinModel, optional
        Models that judge which parts of different pieces belong together. Without it, those that ship.
    mirror : (4,) array_like of float, optional
        For a half model: a plane, as its normal and its distance from the origin along it. What is decomposed is the
        mesh together with its image behind that plane; the parts are those of the mesh given.
    hints : (p,) array_like of int, optional
        A label for each of the p faces, or polygons, that the mesh brings along, such as its material: parts end there
        more likely than elsewhere, see ``cuts.hinted``.

    Returns
    -------
    decomposition : Decomposition
        ``decomposition.parts().labels`` is the part of each face, (p,) int64.

    Raises
    ------
    ParameterError
        A parameter is outside its range, or there is none of its name.
    MeshError
        A shape, a type, an index, a polygon's number or a coordinate is wrong; ``error.vertices`` and ``error.faces``
        say where.
    EmptyMeshError
        The mesh has too few faces to have parts, or no area.
    ReebError
        The model that ships with the package was trained on other features.

    Notes
    -----
    The result is deterministic. The time is about that of one search for shortest paths per base vertex, some 140; the
    time of all other steps grows with the number of faces plus that of crossings of faces and levels.
    """
    parameters = Parameters.of(parameters)
    plane = None if mirror is None else plane_of(mirror)
    watch = Stopwatch(progress)
    with watch.stage("mesh", 0.0):
        given = PolygonMesh.of(vertices, faces, polygon)
        hint = np.zeros(0, np.int64) if hints is None else hints_of(hints, given.n_polygons)
        if plane is not None:
            plane = plane * np.array([1.0, 1.0, 1.0, 2.0**-given.exponent])
        if copies := find_copies(given, plane):
            with_all = given
            given, hint = without_copies(given, copies), _of_faces(hint, copies.polygon)
        together = plane is None and parameters.pieces == TOGETHER
        # For a method that is as it was published ground is not cut off from a surface that goes on in it.
        standing = find_standing(given, terrain=parameters.traits.learned) if together else None

    def of_another(
        vertices: np.ndarray, triangles: np.ndarray, polygon: np.ndarray, hint: np.ndarray
    ) -> Decomposition:
        """The result for what is decomposed in place of the mesh; its vertices are in the unit of ``given``."""
        return decompose(np.ldexp(vertices, given.exponent), triangles, parameters, polygon, progress, model,
                         join_model, hints=hint if len(hint) else None)

    if standing is not None:
        left = standing.without_grounds(given)
        found = of_another(left.triangles.vertices, left.triangles.faces, left.polygon,
                           _of_faces(hint, standing.polygon))
        result = with_grounds(found, given, standing)
    elif plane is None:
        with watch.stage("mesh", 0.4 * MESH_SHARE):
            # From here on the unsorted mesh and its tables are free.
            given, ordering = sorted_by_place(given, parameters.pieces == TOGETHER)
            hint = _of_faces(hint, ordering.polygon)
        result = _decomposed(given, ordering, hint, parameters, watch, _Models(model, join_model))
    else:
        whole = completed(given, plane)
        result = of_half(of_another(whole.vertices, whole.triangles, whole.polygon, np.tile(hint, 2)), given)
    return result.with_copies(copies, with_all) if copies else result


def _of_faces(hint: np.ndarray, faces: np.ndarray) -> np.ndarray:
    """The hints of some faces, (k,) int64, or (0,) if there are none at all."""
    return hint[faces] if len(hint) else hint


class _Models(NamedTuple):
    """What judges cuts, and which parts of different pieces belong together; None for those that ship."""

    cuts: BoostedTrees | None
    joins: JoinModel | None


def _decomposed(
    given: PolygonMesh, ordering: Ordering, hint: np.ndarray, parameters: Parameters, watch: Stopwatch, models: _Models
) -> Decomposition:
    """The result for a sorted mesh without copies; hint : (p,) int64 or (0,). All else is as in ``decompose``."""
    with watch.stage("mesh", MESH_SHARE) as done_of_mesh:
        working = repair(given)
        done_of_mesh(0.9)
        found = bodies(working, parameters.pieces == TOGETHER, parameters.loose_part)
    # Planes of symmetry follow from the mesh alone, and are not asked for before the end.
    mirrors = meanwhile(_mirrors, working, found.decomposed, given.n_polygons, parameters)
    results = _on_bodies(found.decomposed, parameters, watch, models)
    with watch.stage("parts", 1.0):
        findings = Findings(given, working, found, results)
        result = assemble(findings, mirrors(), parameters, watch.seconds, hint)
        result = result.scaled(given.exponent).reordered(ordering)
    watch.progress("done", 1.0)
    return result


def _mirrors(
    working: WorkingMesh, chosen: list[Component], n_polygons: int, parameters: Parameters
) -> list[Mirror]:
    """The planes of symmetry, if the parameters ask for them."""
    return find_mirrors(working, chosen, n_polygons) if parameters.symmetry else []


def _on_bodies(
    chosen: list[Component], parameters: Parameters, watch: Stopwatch, models: _Models
) -> list[ComponentResult]:
    """What is found on each of the bodies, one after the other."""
    results = []
    width = (PARTS_SHARE - MESH_SHARE) / max(len(chosen), 1)
    for done, component in enumerate(chosen):
        watch.share = begin = MESH_SHARE + done * width
        found = decompose_component(component, parameters, watch, begin, width, models.cuts)
        with watch.stage("cuts", begin + width):
            results.append(join_pieces(found, parameters, models.joins))
    return results


def decompose_component(
    component: Component, parameters: Parameters, watch: Stopwatch, begin: float = 0.0, width: float = 1.0,
    model: BoostedTrees | None = None,
) -> ComponentResult:
    """All stages on one body, up to the candidates of its pieces, each piece with a hierarchy of its own.

    Parameters
    ----------
    component : Component
    parameters : Parameters
    watch : Stopwatch
    begin, width : float
        Shares of the time of the run at which the stages begin, and that they take.
    model : BoostedTrees, optional
        See ``decompose``.

    Returns
    -------
    result : ComponentResult
        Without contacts.

    Raises
    ------
    DisconnectedMeshError
        The pieces of the component do not hang together by its bridges.
    """
    foundation = level_sets_of(component, parameters, watch, begin, width)
    drawn = cache(meanwhile(_drawn, foundation.sets, foundation.field))
    if parameters.method == BERRETTI:  # cuts of all other methods can be found before the graph is there
        with watch.stage("reeb graph", begin + 0.5 * width):
            drawn()
    with watch.stage("cuts", begin + 0.95 * width) as progress:
        candidates = find_candidates(foundation, lambda: drawn()[0], parameters, model, progress)
    with watch.stage("reeb graph", begin + width):
        topology, graph = drawn()
    return ComponentResult(component, foundation.field, foundation.sets, topology, graph, candidates)


def _drawn(sets: LevelSets, field: ScalarField) -> tuple[ReebTopology, ReebGraph]:
    """The Reeb graph of a body, simplified, and the same with positions."""
    topology = without_ripples(sets, reeb_topology(sets), field)
    return topology, reeb_graph(sets, topology)


def level_sets_of(
    component: Component, parameters: Parameters, watch: Stopwatch, begin: float = 0.0, width: float = 1.0
) -> Foundation:
    """The stages on one body that all methods and the Reeb graph begin with; the arguments of ``decompose_component``.

    Raises DisconnectedMeshError if the pieces of the component do not hang together by its bridges.
    """
    pyramid = Pyramid(component.mesh, component.bridges.vertices)
    with watch.stage("distances", begin + 0.4 * width) as progress:
        field = protrusion_field(pyramid, parameters.base_spacing, parameters.equalize, progress)
    with watch.stage("reeb graph", begin + 0.45 * width):
        levels = uniform_levels(parameters.n_slabs) if field.values.any() else np.empty(0)
        sets = cut_at_levels(component.mesh, field.values, levels, component.bridges.faces)
    return Foundation(pyramid, field, sets)


def join_pieces(
    found: ComponentResult, parameters: Parameters, model: JoinModel | None = None
) -> ComponentResult:
    """Extend the hierarchies of the pieces of a body to one over all its candidates.

    Parameters
    ----------
    found : ComponentResult
        As ``decompose_component`` made it.
    parameters : Parameters
    model : JoinModel, optional
        What judges pairs of parts. Without it, the models that ship with the package.

    Returns
    -------
    result : ComponentResult
        With contacts.
    """
    if found.component.mesh.face_components[0] == 1:
        return found
    hierarchy = found.candidates.hierarchy
    parts = fine_parts(found.component.mesh, found.face_candidate, hierarchy, found.field.normalized,
                       learned=parameters.traits.learned)
    hierarchy, contacts = join_parts(parts, model)
    return replace(found, candidates=Candidates(found.candidates.element_candidate, hierarchy), contacts=contacts)

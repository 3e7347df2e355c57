# SPDX-License-Identifier: GPL-3.0-or-later
"""Which place of one surface is which place of another: of the same kind of body, in another pose or level of detail.

Grounds, such as a floor, are left out, and correspond to each other.

Both surfaces are represented by samples spread evenly over them, with the geodesic distances between all samples, which
are nearly the same in every pose. A plan says how much of each sample's area goes to which sample of the other surface;
it is sought so that distances are kept as well as possible, and so that samples go to such as have the same
distribution of distances to the whole surface: the fused Gromov-Wasserstein problem [Vayer2019], solved by proximal
steps [Xu2019] from several starts. Mirror images have the same distances; of plans that are equally good, the one is
taken whose places lie nearer to each other in space.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from ..arrays.indexing import inverse, underflow_is_zero
from ..arrays.int64 import arange, full
from ..errors import ParameterError
from ..field.agd import spread_base_vertices
from ..field.geodesic import GeodesicSolver
from ..mesh.arguments import whole_numbers
from ..mesh.copies import find_copies
from ..mesh.grounds import Standing, find_standing, grounds_among
from ..mesh.labels import majority
from ..mesh.polygons import PolygonMesh
from ..sentence import Sentence
from ..surface.coarsening import Pyramid
from ..surface.ordering import sorted_by_place
from ..surface.orientation import without_copies
from ..surface.preparation import Component, repair

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

SPACING = 0.006  # squared radius of the disc of a sample over the area: some 90 to 150 samples
VERTICES = 3_000  # upper bound of the number of vertices on which paths are searched
# Shares of the area, sorted by distance from a sample, at which these distances are compared.
QUANTILES = (0.02, 0.05, 0.1, 0.2, 0.35, 0.5, 0.65, 0.8, 0.9, 1.0)
PROFILE = 2.0  # weight of the difference of these distances, in units of the square root of the area
DISTANCE = 2.0  # weight of the change of distances, in units of the largest one
# Weights of positions from which the search starts, before it goes on without them; and the weight by which plans are
# judged that it leads to.
STARTS, JUDGED = (0.0, 0.3, 1.0, 3.0, 10.0, 30.0), 0.1
PROXIMAL_STEP = 0.01  # size of a proximal step: entropy of the change, in units of the costs
FIRST, LAST, ROUNDS = 15, 40, 60  # steps with and without positions; rounds that balance a plan in each of them


@dataclass(frozen=True, eq=False)
class Samples:
    """Points that represent a surface.

    With k samples and p faces of the caller:

    Attributes
    ----------
    distances : (k, k) float64
        Geodesic, in units of the largest one.
    weight : (k,) float64
        Share of the area that each sample stands for; the sum is 1.
    profile : (k, len(QUANTILES)) float64
        Quantiles of the distances from each sample to the surface, in units of the square root of the area.
    position : (k, 3) float64
        From the middle of the surface, in the same unit.
    face_sample : (p,) int64
        Sample that stands for each face; -1 for a face without area or of a ground.
    face_area : (p,) float64
        Share of the area; the sum is 1 but for grounds. Faces that lie on each other with the same corners divide that
        of one.
    is_ground : (p,) bool
        Whether each face is one of a ground.
    """

    distances: np.ndarray
    weight: np.ndarray
    profile: np.ndarray
    position: np.ndarray
    face_sample: np.ndarray
    face_area: np.ndarray
    is_ground: np.ndarray


@underflow_is_zero
def sample_surface(
    vertices: ArrayLike, faces: ArrayLike | Sequence[Sequence[int]], polygon: ArrayLike | None = None
) -> Samples:
    """Spread samples over a surface.

    Parameters
    ----------
    vertices, faces, polygon
        As ``decompose`` takes them.

    Returns
    -------
    samples : Samples

    Raises
    ------
    MeshError
        As ``decompose`` raises it.

    Notes
    -----
    A search for shortest paths per sample, on at most VERTICES vertices. Pieces that do not touch are linked where they
    are nearest.
    """
    given = PolygonMesh.of(vertices, faces, polygon)
    if copies := find_copies(given):
        given = without_copies(given, copies)
    standing = find_standing(given)
    samples = _sampled(given if standing is None else standing.without_grounds(given))
    if standing is not None:
        samples = _with_grounds(samples, given, standing)
    if copies:
        area = (samples.face_area / np.bincount(copies.original))[copies.original]
        samples = replace(samples, face_sample=samples.face_sample[copies.original], face_area=area,
                          is_ground=samples.is_ground[copies.original])
    return samples


def _with_grounds(samples: Samples, given: PolygonMesh, standing: Standing) -> Samples:
    """The samples of what stands on grounds, for the faces of all."""
    area, sample = np.bincount(given.polygon, given.triangles.face_area), full(given.n_polygons, -1)
    area, is_ground = area / area[standing.polygon].sum(), np.ones(given.n_polygons, bool)
    area[standing.polygon], sample[standing.polygon] = samples.face_area, samples.face_sample
    is_ground[standing.polygon] = False
    return replace(samples, face_sample=sample, face_area=area, is_ground=is_ground)


def _sampled(given: PolygonMesh) -> Samples:
    """Samples of a mesh without copies of faces and without grounds."""
    given, ordering = sorted_by_place(given)
    working = repair(given)
    body = Component.of(working, arange(working.mesh.n_faces))
    pyramid = Pyramid(body.mesh, body.bridges.vertices)
    steps = pyramid.until(lambda mesh: mesh.n_vertices <= VERTICES)
    mesh, area, links = pyramid.after(steps)
    unit = np.sqrt(area.sum())
    base = spread_base_vertices(mesh, GeodesicSolver(mesh, links), area, np.sqrt(SPACING) * unit)
    owner = base.distances.argmin(axis=0)
    for step in reversed(steps):
        owner = owner[step.owner]
    triangle = body.mesh.faces
    sample = majority(np.repeat(body.polygon, 3), owner[triangle].ravel(),
                      np.repeat(body.mesh.face_area, 3), given.n_polygons)
    face_area = np.bincount(body.polygon, body.mesh.face_area, given.n_polygons)
    sample = np.where(face_area > 0, sample, -1)
    face = inverse(ordering.polygon)
    sample, face_area = sample[face], (face_area / face_area.sum())[face]
    distances = base.distances[:, base.indices]
    distances = (distances + distances.T) / (2 * unit)
    weight = base.areas / base.areas.sum()
    position = mesh.vertices[base.indices] / unit
    return Samples(distances / max(distances.max(), 1e-300), weight, _profiles(distances, weight),
                   position - weight @ position, sample, face_area, np.zeros(len(sample), bool))


def _profiles(distances: np.ndarray, weight: np.ndarray) -> np.ndarray:
    """Quantiles of each row of distances, (k, len(QUANTILES)), by the weight of the columns."""
    order = np.argsort(distances, axis=1, kind="stable")
    share = np.cumsum(weight[order], axis=1)
    rows = np.take_along_axis(distances, order, axis=1)
    return np.stack([np.interp(QUANTILES, share[i], rows[i]) for i in range(len(rows))])


@underflow_is_zero
def correspond(source: Samples, target: Samples) -> np.ndarray:
    """Find which samples of one surface are which of another.

    Parameters
    ----------
    source, target : Samples
        Of k and l samples.

    Returns
    -------
    plan : (k, l) float64
        Area, as a share of the whole, that goes from each sample of the source to each of the target; rows sum to the
        weights of the one, columns to those of the other as nearly as some rounds come: within 5 % where surfaces
        are alike, a third for single samples of others.
    """
    profile = PROFILE * ((source.profile[:, None] - target.profile[None]) ** 2).mean(axis=2)
    place = ((source.position[:, None] - target.position[None]) ** 2).sum(axis=2)
    start = np.outer(source.weight, target.weight)
    plans = []
    for weight in STARTS:
        plan = _descend(source, target, profile + weight * place, start, FIRST)
        plans.append(_descend(source, target, profile, plan, LAST))
    judged = profile + JUDGED * place
    cost = [float(((judged + DISTANCE * _change(source, target, plan)) * plan).sum()) for plan in plans]
    return plans[int(np.argmin(cost))]


def _change(source: Samples, target: Samples, plan: np.ndarray) -> np.ndarray:
    """Change of squared distances that a plan makes, for each pair of samples, (k, l)."""
    return ((source.distances**2 @ source.weight)[:, None] + (target.distances**2 @ target.weight)[None]
            - 2 * source.distances @ plan @ target.distances.T)


def _descend(source: Samples, target: Samples, cost: np.ndarray, plan: np.ndarray, steps: int) -> np.ndarray:
    """Improve a plan by so many proximal steps. cost : (k, l), of each pair of samples."""
    for _ in range(steps):
        gradient = cost + DISTANCE * _change(source, target, plan)
        plan = _balanced(plan * np.exp((gradient.min() - gradient) / PROXIMAL_STEP), source.weight, target.weight)
    return plan


def _balanced(plan: np.ndarray, rows: np.ndarray, columns: np.ndarray) -> np.ndarray:
    """Scale rows and columns until they have the sums that they are to have [Cuturi2013]."""
    left = np.ones(len(rows))
    for _ in range(ROUNDS):
        right = columns / np.maximum(plan.T @ left, 1e-300)
        left = rows / np.maximum(plan @ right, 1e-300)
    plan = left[:, None] * plan * right
    return plan / plan.sum()


@underflow_is_zero
def carried_labels(
    source: Samples, source_labels: ArrayLike, target: Samples, target_labels: ArrayLike
) -> tuple[np.ndarray, np.ndarray]:
    """Find the part of one surface that each part of another corresponds to.

    Parameters
    ----------
    source : Samples
        Of a surface of p faces.
    source_labels : (p,) int64
        Part of each of its faces, from 0, all in use.
    target : Samples
        Of a surface of q faces.
    target_labels : (q,) int64
        Part of each of its faces, from 0, all in use.

    Returns
    -------
    label : (count of target,) int64
        Part of the source from which most of the area of each part of the target comes; of a ground the largest ground.
    share : (count of target,) float64
        How much of it, 0..1; 0 where none does.

    Raises
    ------
    ParameterError
        Labels are not whole numbers from 0, one for each face.
    """
    source_labels, target_labels = _checked(source, source_labels), _checked(target, target_labels)
    plan = correspond(source, target)
    from_source = _of_samples(source, source_labels, len(source.weight))
    mixture = (plan / np.maximum(plan.sum(axis=0), 1e-300)).T @ from_source  # what each sample of the target is
    to_target = _of_samples(target, target_labels, len(target.weight)) * target.weight[:, None]
    score = to_target.T @ mixture
    label, share = score.argmax(axis=1), score.max(axis=1) / np.maximum(score.sum(axis=1), 1e-300)
    grounds = grounds_among(source_labels, source.is_ground)
    if grounds.any():
        ground = grounds_among(target_labels, target.is_ground)
        area = np.bincount(source_labels, source.face_area * source.is_ground)
        label[ground], share[ground] = np.where(grounds, area, -1.0).argmax(), 1.0
    return label, share


def _checked(samples: Samples, labels: ArrayLike) -> np.ndarray:
    """Labels of the faces of a surface as (p,) int64; raises ParameterError if they are none."""
    found, count = whole_numbers(labels), len(samples.face_sample)
    # More labels than faces are not all in use, and tables of them would fill all memory.
    if found is None or found.shape != (count,) or not ((found >= 0) & (found < count)).all():
        raise ParameterError(Sentence("Labels must be {n} whole numbers from 0, one for each face.", n=count), "labels")
    return found


def _of_samples(samples: Samples, labels: np.ndarray, count: int) -> np.ndarray:
    """Share of the area of each sample that has each label, (k, n labels)."""
    kept = samples.face_sample >= 0
    n_labels = int(labels.max()) + 1
    place = samples.face_sample[kept] * n_labels + labels[kept]
    share = np.bincount(place, samples.face_area[kept], count * n_labels).reshape(count, n_labels)
    return share / np.maximum(share.sum(axis=1, keepdims=True), 1e-300)

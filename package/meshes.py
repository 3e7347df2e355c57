# SPDX-License-Identifier: GPL-3.0-or-later
"""``decompose`` for what other libraries call a mesh, and colors in the form that they take."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any, Protocol, overload

import numpy as np

from .core import pipeline
from .core.errors import MeshError, ParameterError
from .core.mesh.arguments import check_is_mesh
from .core.parameters import Parameters
from .core.progress import Progress
from .core.result.decomposition import Decomposition
from .core.result.parts import Parts
from .core.sentence import Sentence
from .core.uses.colors import part_colors

if TYPE_CHECKING:
    from numpy.typing import ArrayLike


class Mesh(Protocol):
    """What has vertices, (n, 3), and faces, (p, k): a ``trimesh.Trimesh``, a ``Model``, a ``TriMesh`` and others."""

    @property
    def vertices(self) -> Any: ...

    @property
    def faces(self) -> Any: ...


@overload
def decompose(vertices: Mesh, *, parameters: Parameters | Mapping[str, Any] | None = None,
              progress: Progress | None = None, mirror: ArrayLike | None = None,
              hints: ArrayLike | None = None) -> Decomposition: ...


@overload
def decompose(vertices: ArrayLike, faces: ArrayLike | Sequence[Sequence[int]],
              parameters: Parameters | Mapping[str, Any] | None = None, polygon: ArrayLike | None = None,
              progress: Progress | None = None, *, mirror: ArrayLike | None = None,
              hints: ArrayLike | None = None) -> Decomposition: ...


def decompose(vertices: Any, faces: Any = None, parameters: Parameters | Mapping[str, Any] | None = None,
              polygon: ArrayLike | None = None, progress: Progress | None = None, *,
              mirror: ArrayLike | None = None, hints: ArrayLike | None = None) -> Decomposition:
    """Cut a mesh into parts.

    Parameters
    ----------
    vertices : mesh or (n, 3) array_like of float
        A mesh is anything with ``vertices`` and ``faces``, such as a ``trimesh.Trimesh``; it is not changed.
    faces : (p, k) array_like of int, or a sequence of p index sequences
        Vertices of each face: triangles, quads or polygons. None with a mesh.
    parameters : Parameters or mapping, optional
        A mapping has values by the names of parameters. Without it, the preset "Perceptual".
    polygon : (m,) array_like of int, optional
        For a caller who has cut polygons into triangles already: ``faces`` are then (m, 3) triangles, and this is the
        polygon of each. The faces of the result are the polygons. A mesh that has a ``polygon`` brings it along.
    progress : callable, optional
        Called as progress(stage, share), share rising from 0 to 1. An exception that it raises ends the run.
    mirror : (4,) array_like of float, optional
        For a half model: a plane, as its normal and its distance from the origin along it. What is decomposed is the
        mesh together with its image behind that plane; the parts are those of the mesh given.
    hints : (p,) array_like of int, optional
        A label for each face that the mesh brings along, such as its material: parts end there more likely than
        elsewhere.

    Returns
    -------
    decomposition : Decomposition
        ``decomposition.parts().labels`` is the part of each face, (p,) int64.

    Raises
    ------
    ParameterError
        A parameter is outside its range, or there is none of its name.
    MeshError
        There are no faces to the vertices, or a shape, a type, an index or a coordinate is wrong.
    EmptyMeshError
        The mesh has too few faces to have parts, or no area.
    """
    _check_arguments(vertices, faces)
    if faces is None:
        mesh = vertices
        check_is_mesh(mesh)
        vertices, faces = np.asarray(mesh.vertices), mesh.faces
        polygon = getattr(mesh, "polygon", None) if polygon is None else polygon
    return pipeline.decompose(vertices, faces, parameters, polygon, progress, mirror=mirror, hints=hints)


def _check_arguments(mesh: Any, faces: Any) -> None:
    """Raise MeshError, which says what to give, for what is taken for vertices and faces by mistake."""
    kind = type(mesh).__name__
    if isinstance(faces, (Parameters, Mapping)):
        raise MeshError(Sentence("Parameters are given by name: decompose(mesh, parameters=...)."))
    if faces is not None and hasattr(mesh, "vertices"):
        raise MeshError(Sentence("{type} has faces of its own: give it alone, or its vertices and other faces.",
                                 type=kind))
    if faces is None and hasattr(mesh, "to_mesh"):
        raise MeshError(Sentence("{type} is no mesh: decompose what its to_mesh() gives.", type=kind))


def face_colors(parts: Parts) -> np.ndarray:
    """Color each face by its part, as ``trimesh.Trimesh.visual.face_colors`` takes it.

    parts : Parts, of p faces. Returns (p, 4) uint8, sRGB and opacity; color-blind people can tell the colors apart, and
    parts that touch differ. Raises ParameterError for what is no Parts.
    """
    if not isinstance(parts, Parts):
        raise ParameterError(Sentence("Colors are of parts, as parts() of a result gives them, not of {type}.",
                                      type=type(parts).__name__), "parts")
    color = np.column_stack([part_colors(parts.count, parts.cuts), np.ones(parts.count)])
    return (255 * color).round().astype(np.uint8)[parts.labels]

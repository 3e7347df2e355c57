# SPDX-License-Identifier: GPL-3.0-or-later
"""The report of a decomposition as JSON, by the schema of docs/json.md."""

from __future__ import annotations

import platform
from collections.abc import Iterable
from dataclasses import asdict
from typing import TYPE_CHECKING, Any

import numpy as np
import scipy

from ..arrays.indexing import bounds_of_each
from ..arrays.pairs import partners_of
from ..errors import ParameterError, wrong_kind
from ..graph.critical import KINDS
from ..mesh.arguments import numbers as as_numbers
from ..mesh.arguments import whole_numbers
from ..result.decomposition import Decomposition
from ..result.parts import Parts
from ..sentence import Sentence
from ..version import VERSION
from .colors import part_colors

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from ..graph.reeb import ReebGraph

SCHEMA_VERSION = 2  # version of docs/json.md


def document(
    reports: list[dict[str, Any]], *, blender: str = "", files: dict[str, Any] | None = None,
    problems: Iterable[dict[str, str]] = (),
) -> dict[str, Any]:
    """Put the reports of all objects into one JSON document, with the versions of what made them.

    Parameters
    ----------
    reports : list of dict
        One result of ``report`` per object.
    blender : str, optional
        The version of Blender.
    files : dict, optional
        The files that were written, by kind.
    problems : iterable of dict
        The name of each object that could not be decomposed, and why.

    Returns
    -------
    document : dict
        Takes ``json.dumps`` as it is.
    """
    versions = {"reeb_parts": VERSION, "python": platform.python_version(),
                "numpy": np.__version__, "scipy": scipy.__version__}
    if blender:
        versions["blender"] = blender
    return {"schema_version": SCHEMA_VERSION, "versions": versions, "objects": reports, "problems": list(problems),
            "files": files or {}}


def report(
    decomposition: Decomposition,
    parts: Parts | None = None,
    name: str = "",
    *,
    numbers: Iterable[int] | None = None,
    names: Iterable[str] | None = None,
    colors: ArrayLike | None = None,
    boxes: ArrayLike | None = None,
    transform: ArrayLike | None = None,
    labels: bool = False,
) -> dict[str, Any]:
    """Describe one decomposition by values that ``json.dumps`` takes.

    Parameters
    ----------
    decomposition : Decomposition
    parts : Parts, optional
        Parts that are described. Without them, those that the parameters of the run ask for.
    name : str
        Name of the object or file.
    numbers : (count,) iterable of int, optional
        Number of each part, 1 or more; 1, 2 ... without.
    names : (count,) iterable of str, optional
        Name of each part; ``parts.names`` without.
    colors : (count, 3) array_like of float, optional
        Color of each part, sRGB, 0..1; those of ``part_colors`` without.
    boxes : (count, 2, 3) array_like of float, optional
        Lowest and highest corner of each part, as ``bounding_boxes`` returns them; null in the report without.
    transform : (4, 4) array_like of float, optional
        Affine matrix that is applied to the positions of the graph.
    labels : bool
        Whether the report has the label of each face.

    Returns
    -------
    report : dict

    Raises
    ------
    ParameterError
        ``decomposition`` is none, ``parts`` are of another result, or one of the others has another shape, or values
        that are no such numbers; ``error.name`` says which.
    """
    if not isinstance(decomposition, Decomposition):
        raise wrong_kind("decomposition", "a result of decompose", decomposition)
    parts = decomposition.parts() if parts is None else parts
    _check_result(decomposition, parts)
    numbers, names = _numbers_and_names(parts, numbers, names)
    colors = part_colors(parts.count, parts.cuts) if colors is None else _checked("colors", colors, (parts.count, 3))
    if ((colors < 0) | (colors > 1)).any():
        raise ParameterError(Sentence("Colors must be from 0 to 1."), "colors")
    boxes = None if boxes is None else _checked("boxes", boxes, (parts.count, 2, 3))
    transform = np.eye(4) if transform is None else _checked("transform", transform, (4, 4))
    result = {
        "name": name,
        "vertices": decomposition.n_vertices,
        "faces": decomposition.n_faces,
        "area": float(parts.area.sum()),
        "parts": _parts(parts, numbers, names, colors, boxes),
        "cuts": [{"parts": pair, "length": length, "salience": salience}
                 for pair, length, salience in zip(*(of_cuts[parts.cut_touches].tolist() for of_cuts in (
                     parts.cuts, parts.cut_length, parts.cut_salience)), strict=True)],
        "graph": _graph(decomposition.graph, parts, transform),
        "parameters": asdict(decomposition.parameters),
        "notes": list(decomposition.notes),
        "seconds": {stage: float(time) for stage, time in decomposition.seconds.items()},
    }
    if labels:
        result["labels"] = parts.labels.tolist()
    return result


def _check_result(decomposition: Decomposition, parts: Parts) -> None:
    """Raise ParameterError if parts are not of a result, nor of its copy."""
    own = getattr(parts, "decomposition", None)
    if own is not decomposition and not (isinstance(own, Decomposition) and all(
            np.array_equal(getattr(own, name), getattr(decomposition, name))
            for name in ("candidates", "node_candidate", "point_candidate"))):
        raise ParameterError(Sentence("The parts are of another result: give the one that they were read from."),
                             "parts")


def _numbers_and_names(
    parts: Parts, numbers: Iterable[int] | None, names: Iterable[str] | None
) -> tuple[list[int], list[str]]:
    """Number and name of each part, those given or its own; raises ParameterError if they are none."""
    for given, iterable in (("numbers", numbers), ("names", names)):
        if iterable is not None and not isinstance(iterable, Iterable):
            raise wrong_kind(given, "a list", iterable)
    numbers = list(range(1, parts.count + 1) if numbers is None else numbers)
    names = list(parts.names if names is None else names)
    for given, values in (("numbers", numbers), ("names", names)):
        if len(values) != parts.count:
            raise ParameterError(Sentence("There are {n} {name} for {total} parts: each part needs one.",
                                          n=len(values), name=given, total=parts.count), given)
    whole = whole_numbers(numbers)
    if whole is None or (whole < 1).any():
        raise ParameterError(
            Sentence("Numbers must be {n} whole numbers from 1, one for each part.", n=parts.count), "numbers")
    return numbers, names


def _checked(name: str, values: ArrayLike, shape: tuple[int, ...]) -> np.ndarray:
    """Values as an array of finite numbers of a shape; raises ParameterError if they are none."""
    array = as_numbers(values)
    if array is None or array.shape != shape or not np.isfinite(array).all():
        given = type(values).__name__ if array is None else next(iter(array[~np.isfinite(array)]), array.shape)
        raise ParameterError(
            Sentence("{name} must be finite numbers of shape {shape}, not {given}.", name=name, shape=shape,
                     given=given), name)
    return array


def bounding_boxes(labels: np.ndarray, points: np.ndarray, count: int) -> np.ndarray:
    """Find the lowest and highest coordinates of each part.

    Parameters
    ----------
    labels : (c,) int64
        Part of each corner of each face, 0..count-1. Vertices on a cut have corners in several parts.
    points : (c, 3) float64
        Position of each corner.
    count : int
        Number of parts.

    Returns
    -------
    boxes : (count, 2, 3) float64
        Lowest and highest corner of each part, in the unit of ``points``.
    """
    return np.stack(bounds_of_each(labels, points, count), axis=1)


def _parts(
    parts: Parts, numbers: list[int], names: list[str], colors: np.ndarray, boxes: np.ndarray | None
) -> list[dict[str, Any]]:
    """Description of each part; the arguments are those of ``report``."""
    faces = np.bincount(parts.labels, minlength=parts.count)
    beside = partners_of(parts.cuts[parts.cut_touches], parts.count)
    return [
        {
            "index": index,
            "number": int(number),
            "name": name,
            "faces": int(faces[index]),
            "area": float(parts.area[index]),
            "share": float(parts.share[index]),
            "color": colors[index].tolist(),
            "bounding_box": None if boxes is None else boxes[index].tolist(),
            "neighbours": sorted(beside[index]),
            "twin": None if parts.twin[index] < 0 else int(parts.twin[index]),
        }
        for index, (number, name) in enumerate(zip(numbers, names, strict=True))
    ]


def _graph(graph: ReebGraph, parts: Parts, matrix: np.ndarray) -> dict[str, Any]:
    """Description of the graph; matrix : (4, 4), the ``transform`` of ``report``."""
    node_position = graph.node_position @ matrix[:3, :3].T + matrix[:3, 3]
    point_position = graph.point_position @ matrix[:3, :3].T + matrix[:3, 3]
    nodes = [
        {"kind": KINDS[kind], "value": value, "position": position, "part": part}
        for kind, value, position, part in zip(
            graph.node_kind.tolist(), graph.node_value.tolist(), node_position.tolist(),
            parts.node_part.tolist(), strict=True)
    ]
    arcs = []
    for arc, (ends, part) in enumerate(zip(graph.arcs.tolist(), parts.arc_part.tolist(), strict=True)):
        own = slice(graph.arc_points[arc], graph.arc_points[arc + 1])
        arcs.append({
            "nodes": ends, "part": part, "points": point_position[own].tolist(),
            "radii": graph.point_radius[own].tolist(), "values": graph.point_value[own].tolist(),
        })
    return {"nodes": nodes, "arcs": arcs, "loops": int(graph.n_loops), "components": graph.n_components}

# SPDX-License-Identifier: GPL-3.0-or-later
"""A decomposition as JSON, by the schema of docs/json.md."""

from __future__ import annotations

import platform
from dataclasses import asdict

import numpy as np
import scipy

from ..graph.critical import KINDS
from ..result.decomposition import VERSION, Decomposition, Parts
from .colors import part_colors

SCHEMA_VERSION = 2


def document(reports: list[dict], **more) -> dict:
    """The whole JSON: the reports of all objects and what they were made with.

    Parameters
    ----------
    reports : list of dict
        Of ``report``.
    more
        ``blender``, its version; ``files``, what was written.
    """
    versions = {"reeb_parts": VERSION, "python": platform.python_version(),
                "numpy": np.__version__, "scipy": scipy.__version__}
    if "blender" in more:
        versions["blender"] = more["blender"]
    return {"schema_version": SCHEMA_VERSION, "versions": versions, "objects": reports,
            "files": more.get("files", {})}


def report(
    decomposition: Decomposition,
    parts: Parts | None = None,
    name: str = "",
    *,
    numbers=None,
    names=None,
    colors=None,
    boxes=None,
    transform=None,
    labels: bool = False,
) -> dict:
    """One decomposition as what ``json.dumps`` takes.

    Parameters
    ----------
    decomposition : Decomposition
    parts : Parts, optional
        The parts to tell of; those of the parameters' detail without.
    name : str
        Of the object or file.
    numbers, names : (count,) sequences, optional
        Of the parts, if they are not numbered from 1 and named by number.
    colors : (count, 3) array_like, optional
        sRGB, 0..1; see ``part_colors`` without.
    boxes : (count, 2, 3) array_like, optional
        Lowest and highest corner of each part, see ``bounding_boxes``; null without.
    transform : (4, 4) array_like, optional
        Applied to the positions of the graph.
    labels : bool
        Also the label of each face.
    """
    parts = decomposition.parts() if parts is None else parts
    result = {
        "name": name,
        "vertices": decomposition.n_vertices,
        "faces": decomposition.n_faces,
        "area": float(parts.area.sum()),
        "parts": _parts(parts, numbers, names, colors, boxes),
        "cuts": [{"parts": pair, "length": length, "salience": salience}
                 for pair, length, salience in zip(parts.cuts.tolist(), parts.cut_length.tolist(),
                                                   parts.cut_salience.tolist(), strict=True)],
        "graph": _graph(decomposition.graph, parts, transform),
        "parameters": asdict(decomposition.parameters),
        "notes": list(decomposition.notes),
        "seconds": {stage: float(time) for stage, time in decomposition.seconds.items()},
    }
    if labels:
        result["labels"] = parts.labels.tolist()
    return result


def bounding_boxes(labels, points, count: int) -> np.ndarray:
    """Lowest and highest coordinates of labelled points.

    Parameters
    ----------
    labels : (e,) int64
        0..count-1. Give every corner of every face, so that parts share the vertices on cuts.
    points : (e, 3) float64

    Returns
    -------
    boxes : (count, 2, 3) float64
    """
    boxes = np.empty((count, 2, 3))
    boxes[:, 0], boxes[:, 1] = np.inf, -np.inf
    np.minimum.at(boxes[:, 0], labels, points)
    np.maximum.at(boxes[:, 1], labels, points)
    return boxes


def _parts(parts, numbers, names, colors, boxes) -> list[dict]:
    numbers = range(1, parts.count + 1) if numbers is None else numbers
    names = parts.names if names is None else names
    colors = part_colors(parts.count, parts.cuts) if colors is None else np.asarray(colors)
    faces = np.bincount(parts.labels, minlength=parts.count)
    beside = [[] for _ in range(parts.count)]
    for a, b in parts.cuts.tolist():
        beside[a].append(b)
        beside[b].append(a)
    return [
        {
            "index": index,
            "number": int(number),
            "name": name,
            "faces": int(faces[index]),
            "area": float(parts.area[index]),
            "share": float(parts.share[index]),
            "color": colors[index].tolist(),
            "bounding_box": None if boxes is None else np.asarray(boxes)[index].tolist(),
            "neighbours": sorted(beside[index]),
        }
        for index, (number, name) in enumerate(zip(numbers, names, strict=True))
    ]


def _graph(graph, parts, transform) -> dict:
    matrix = np.eye(4) if transform is None else np.asarray(transform, np.float64)
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

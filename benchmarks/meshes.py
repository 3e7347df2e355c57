# SPDX-License-Identifier: GPL-3.0-or-later
"""Meshes for the benchmarks: read from files, joined at their seams, refined to a size, and written with labels."""

from __future__ import annotations

import argparse
import io
import re
from collections.abc import Sequence
from pathlib import Path

import numpy as np


def load_mesh(path: Path) -> tuple[np.ndarray, np.ndarray]:
    """Vertices (n, 3) and triangles (m, 3) of a mesh file, in its own order."""
    if path.suffix.lower() == ".npz":
        with np.load(path) as data:
            return data["vertices"], data["faces"]
    import trimesh

    data = path.read_bytes()
    if path.suffix.lower() == ".obj":
        data = re.sub(rb"(?m)^[ \t]*(usemtl|mtllib|g|o|s)\b.*$", b"", data)  # materials and groups would sort the faces
    # Neither cleaned nor split at texture seams: labels are for the faces that are in the file.
    scene = trimesh.load_scene(io.BytesIO(data), file_type=path.suffix[1:].lower(), process=False, maintain_order=True,
                               skip_materials=True)
    meshes = list(scene.geometry.values())
    return stacked([mesh.vertices for mesh in meshes], [mesh.faces for mesh in meshes])[:2]


def stacked(vertices: Sequence[np.ndarray], faces: Sequence[np.ndarray]) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Several meshes, (n_i, 3) and (m_i, 3) each, as one: vertices, faces, and the number of the mesh of each face."""
    first = np.cumsum([0, *map(len, vertices)])
    return (np.concatenate(vertices), np.concatenate([f + start for f, start in zip(faces, first, strict=False)]),
            np.repeat(np.arange(len(faces)), list(map(len, faces))))


def joined(vertices: np.ndarray, faces: np.ndarray, same: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """One of the vertices in each cell of a grid of the step ``same``.

    Returns these vertices, (n',), the faces on them that keep three corners, (m', 3), and which faces do, (m,) bool.
    """
    _, first, place = np.unique(np.round(vertices / same), axis=0, return_index=True, return_inverse=True)
    faces = place.reshape(-1)[faces]
    whole = (faces != np.roll(faces, 1, axis=1)).all(axis=1)
    return first, faces[whole], whole


def joined_alone(
    vertices: np.ndarray, faces: np.ndarray, same: float
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Some faces with their vertices only, those at one place ``joined``; and which of the faces are kept."""
    used, faces = np.unique(faces, return_inverse=True)
    first, faces, whole = joined(vertices[used], faces.reshape(-1, 3), same)
    return vertices[used][first], faces, whole


def refined(vertices: np.ndarray, faces: np.ndarray, size: int) -> tuple[np.ndarray, np.ndarray]:
    """Halve edges, longest first, until there are ``size`` vertices; the shape stays as it is."""
    while len(vertices) < size:
        edge = np.sort(np.stack([faces, np.roll(faces, -1, axis=1)], axis=-1), axis=-1)  # (m, 3, 2)
        edges, number = np.unique(edge.reshape(-1, 2), axis=0, return_inverse=True)
        number = number.reshape(-1, 3)
        length = np.linalg.norm(vertices[edges[:, 0]] - vertices[edges[:, 1]], axis=1)
        rank = np.empty(len(edges), np.int64)
        rank[np.argsort(-length, kind="stable")] = np.arange(len(edges))
        # The longest edge of both its faces: no face is cut twice in one round.
        first = rank[number].argmin(axis=1)
        longest = number[np.arange(len(faces)), first]
        chosen = np.flatnonzero(np.bincount(longest, minlength=len(edges)) == np.bincount(number.ravel()))
        chosen = chosen[np.argsort(rank[chosen])][: size - len(vertices)]
        middle = np.full(len(edges), -1)
        middle[chosen] = len(vertices) + np.arange(len(chosen))
        vertices = np.concatenate([vertices, vertices[edges[chosen]].mean(axis=1)])
        cut = middle[longest] >= 0
        # Turn the corners so that the halved edge joins corners 0 and 1.
        a, b, c = (faces[cut, (first[cut] + k) % 3] for k in range(3))
        m = middle[longest[cut]]
        faces = np.concatenate([faces[~cut], np.stack([a, m, c], 1), np.stack([m, b, c], 1)])
    return vertices, faces


def source_and_target(description: str | None, source: str = "FOLDER") -> tuple[Path, Path]:
    """The two paths that a program which makes labelled meshes is called with; the folder OUT is made."""
    parser = argparse.ArgumentParser(description=description, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("source", type=Path, metavar=source)
    parser.add_argument("out", type=Path, metavar="OUT")
    options = parser.parse_args()
    options.out.mkdir(parents=True, exist_ok=True)
    return options.source, options.out


def some(models: list, source: Path) -> list:
    """What of ``source`` a program takes; without any the program ends with a sentence that says so."""
    if not models:
        raise SystemExit(f"{source} holds none of the models that are taken; see --help")
    return models


def write_labelled(path: Path, vertices: np.ndarray, faces: np.ndarray, **labels: np.ndarray) -> None:
    """Write a mesh and labels of its faces, such as ``human`` (k, m) or ``material`` (m,), as benchmarks read them."""
    np.savez_compressed(path, vertices=vertices.astype(np.float32), faces=faces.astype(np.int32),
                        **{name: label.astype(np.int16) for name, label in labels.items()})

# SPDX-License-Identifier: GPL-3.0-or-later
"""Models of games that bones move, and their labels: of each face, the part whose bones move it most."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass

import numpy as np
from meshes import joined, stacked

N_BONES = 4  # bones that move a vertex, at most
SAME = 1e-5  # share of the diagonal within which vertices are one

#: The coarse, the medium and the fine name of what a bone moves.
Names = tuple[str, str, str]


@dataclass(frozen=True, eq=False)
class Skinned:
    """A mesh and what moves it. bone, weight : (n, N_BONES), of each vertex. faces : (m, 3), turned outwards."""

    vertices: np.ndarray
    faces: np.ndarray
    bone: np.ndarray
    weight: np.ndarray


@dataclass(frozen=True, eq=False)
class Skeleton:
    """Names of bones, and the number of the bone that carries each, -1 for none."""

    names: list[str]
    carrier: list[int]


def labelled(pieces: list[Skinned], named: list[Names], without: Collection[str] = ()) -> dict[str, np.ndarray]:
    """Vertices, faces and labels, ``human`` (3, m), of some meshes that one skeleton moves.

    named : of each bone. without : coarse names of what is left out.
    """
    same = SAME * np.linalg.norm(np.ptp(pieces[0].vertices, axis=0))
    vertices, faces, human = [], [], []
    for piece in pieces:
        first, joined_faces, whole = joined(piece.vertices, piece.faces, same)
        part = np.stack([_most_moved(piece, piece.faces[whole], [names[k] for names in named]) for k in range(3)])
        kept = ~np.isin(part[0], list(without))
        used, corners = np.unique(joined_faces[kept], return_inverse=True)
        vertices.append(piece.vertices[first][used])
        faces.append(corners.reshape(-1, 3))
        human.append(part[:, kept])
    human = np.stack([np.unique(row, return_inverse=True)[1] for row in np.concatenate(human, axis=1)])
    vertices, faces, _ = stacked(vertices, faces)
    return {"vertices": vertices, "faces": faces, "human": human}


def _most_moved(piece: Skinned, faces: np.ndarray, named: list[str]) -> np.ndarray:
    """Name of the part whose bones move each face most, (m,) of str. named : of each bone."""
    parts, of_bone = np.unique(named, return_inverse=True)
    weight = np.zeros((len(piece.vertices), len(parts)))
    for k in range(N_BONES):
        np.add.at(weight, (np.arange(len(weight)), of_bone[piece.bone[:, k]]), piece.weight[:, k])
    return parts[weight[faces].sum(axis=1).argmax(axis=1)]

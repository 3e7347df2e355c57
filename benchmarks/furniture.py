# SPDX-License-Identifier: GPL-3.0-or-later
"""Furniture as meshes whose faces have the materials of its makers.

    python3 benchmarks/furniture.py FOLDER OUT

FOLDER holds catalogs of Sweet Home 3D (.sh3f), such as the five of its furniture 1.8: archives of .obj files, in which
a material is what one may give another color - the legs of a chair, the doors of a cupboard. OUT gets
CATALOG.NAME.npz with ``vertices``, ``faces`` and ``material`` of all that have LEAST_MATERIALS and at most MOST_FACES.
"""

from __future__ import annotations

import argparse
import tempfile
from pathlib import Path
from zipfile import ZipFile

import packages

packages.need("numpy", "trimesh", "tqdm")

import numpy as np
import trimesh
from meshes import joined
from tqdm import tqdm

LEAST_MATERIALS, MOST_FACES = 2, 20_000
SAME = 1e-6  # share of the diagonal within which vertices are one


def read(path: Path) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Vertices (n, 3), triangles (m, 3) and the number of the material of each, (m,), of an .obj file."""
    scene = trimesh.load_scene(path, process=False, group_material=True, skip_materials=True, maintain_order=True)
    vertices, faces, material, count = [np.empty((0, 3))], [np.empty((0, 3), np.int64)], [np.empty(0, np.int64)], 0
    for number, mesh in enumerate(scene.geometry.values()):
        if isinstance(mesh, trimesh.Trimesh):
            vertices.append(mesh.vertices)
            faces.append(mesh.faces + count)
            material.append(np.full(len(mesh.faces), number))
            count += len(mesh.vertices)
    return np.concatenate(vertices), np.concatenate(faces), np.concatenate(material)


def cleaned(vertices: np.ndarray, faces: np.ndarray, material: np.ndarray):
    """The same with vertices at one place joined, without those that no face has and faces that are lines."""
    used, faces = np.unique(faces, return_inverse=True)
    faces = faces.reshape(-1, 3)
    first, faces, whole = joined(vertices[used], faces, SAME * np.linalg.norm(np.ptp(vertices[used], axis=0)))
    return vertices[used][first], faces, np.unique(material[whole], return_inverse=True)[1]


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=Path, metavar="FOLDER")
    parser.add_argument("out", type=Path, metavar="OUT")
    options = parser.parse_args()
    options.out.mkdir(parents=True, exist_ok=True)
    for catalog in tqdm(sorted(options.folder.glob("*.sh3f"))):
        with tempfile.TemporaryDirectory() as folder, ZipFile(catalog) as archive:
            archive.extractall(folder, [name for name in archive.namelist() if name.lower().endswith(".obj")])
            for path in sorted(Path(folder).rglob("*.obj")):
                vertices, faces, material = read(path)
                if not len(faces):
                    continue
                vertices, faces, material = cleaned(vertices, faces, material)
                if len(faces) <= MOST_FACES and len(np.unique(material)) >= LEAST_MATERIALS:
                    np.savez_compressed(
                        options.out / f"{catalog.stem}.{path.stem}.npz", vertices=vertices.astype(np.float32),
                        faces=faces.astype(np.int32), material=material.astype(np.int16))


if __name__ == "__main__":
    main()

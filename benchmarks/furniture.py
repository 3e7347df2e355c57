# SPDX-License-Identifier: GPL-3.0-or-later
"""Furniture as meshes whose faces have the materials of its makers.

    python3 benchmarks/furniture.py FOLDER OUT

FOLDER holds catalogs of Sweet Home 3D (.sh3f), such as the five of its furniture 1.8: archives of .obj files, in which
a material is what one may give another color - the legs of a chair, the doors of a cupboard. OUT gets
CATALOG.NAME.npz with ``vertices``, ``faces`` and ``material`` of all that have LEAST_MATERIALS and at most MOST_FACES.
"""

from __future__ import annotations

import tempfile
from pathlib import Path
from zipfile import ZipFile

import packages

packages.need("numpy", "trimesh", "tqdm")

import numpy as np
import trimesh
from meshes import joined_alone, some, source_and_target, stacked, write_labelled
from tqdm import tqdm

LEAST_MATERIALS, MOST_FACES = 2, 20_000
SAME = 1e-6  # share of the diagonal within which vertices are one


def read(path: Path) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Vertices (n, 3), triangles (m, 3) and the number of the material of each, (m,), of an .obj file."""
    scene = trimesh.load_scene(path, process=False, group_material=True, skip_materials=True, maintain_order=True)
    meshes = [mesh if isinstance(mesh, trimesh.Trimesh) else trimesh.Trimesh() for mesh in scene.geometry.values()]
    return stacked([mesh.vertices for mesh in meshes], [mesh.faces for mesh in meshes])


def main() -> None:
    catalogs, out = source_and_target(__doc__)
    for catalog in tqdm(some(sorted(catalogs.glob("*.sh3f")), catalogs)):
        with tempfile.TemporaryDirectory() as folder, ZipFile(catalog) as archive:
            archive.extractall(folder, [name for name in archive.namelist() if name.lower().endswith(".obj")])
            for path in sorted(Path(folder).rglob("*.obj")):
                vertices, faces, material = read(path)
                if not len(faces):
                    continue
                same = SAME * np.linalg.norm(np.ptp(vertices[faces].reshape(-1, 3), axis=0))
                vertices, faces, whole = joined_alone(vertices, faces, same)
                names, material = np.unique(material[whole], return_inverse=True)
                if len(faces) <= MOST_FACES and len(names) >= LEAST_MATERIALS:
                    write_labelled(out / f"{catalog.stem}.{path.stem}.npz", vertices, faces, material=material)


if __name__ == "__main__":
    main()

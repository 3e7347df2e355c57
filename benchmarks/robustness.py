# SPDX-License-Identifier: GPL-3.0-or-later
"""How much of the parts is left when a mesh is changed: noise, smoothing, decimation, poses.

    python3 benchmarks/robustness.py [MESHES ...] [--preset NAME] [--only WORD]

Each mesh (default: the bundled Spot) is decomposed as it is and changed; the parts of the changed mesh
are brought back by the nearest face and compared with the parts of the mesh as it is. Prints, per change,
the mean over the meshes of the Rand index and of the paper's agreement (12) over faces (both 1 when
nothing changed), and the number of parts against that of the mesh as it is; and, where meshes come with
labels by people (the array ``human`` of an .npz), the Rand index error against these.
"""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

import packages

packages.need("numpy", "scipy", "tqdm", "trimesh", "fast_simplification", "manifold3d")

sys.path.append(str(packages.ROOT / "tests"))

import numpy as np
import shapes
from meshes import load_mesh
from scipy.spatial import cKDTree
from tqdm import tqdm

from core import PRESETS, Parameters, TriMesh, decompose
from core.metrics import agreement, rand_index_error

SPOT = packages.ROOT / "models" / "spot.obj"
SEED = 2009


def with_noise(share: float):
    """Gaussian noise along the normals; standard deviation in shares of the mean edge length."""

    def change(mesh: TriMesh) -> TriMesh:
        rng = np.random.default_rng(SEED)
        normal = mesh.vertex_area_normals
        normal /= np.maximum(np.linalg.norm(normal, axis=1, keepdims=True), np.finfo(float).tiny)
        step = share * mesh.edge_length.mean() * rng.standard_normal((mesh.n_vertices, 1))
        return TriMesh(mesh.vertices + step * normal, mesh.faces)

    return change


def smoothed(mesh: TriMesh) -> TriMesh:
    """Ten steps of Laplacian smoothing, halfway to the mean of the neighbors."""
    a, b = mesh.edges.vertices.T
    n, points = mesh.n_vertices, mesh.vertices
    degree = np.maximum(np.bincount(a, minlength=n) + np.bincount(b, minlength=n), 1)
    for _ in range(10):
        around = [np.bincount(a, c[b], n) + np.bincount(b, c[a], n) for c in points.T]
        points = 0.5 * points + 0.5 * np.stack(around, axis=1) / degree[:, None]
    return TriMesh(points, mesh.faces)


def decimated(share: float):
    """Quadric edge collapse down to a share of the faces."""

    def change(mesh: TriMesh) -> TriMesh:
        import fast_simplification

        points, faces = fast_simplification.simplify(
            mesh.vertices.astype(np.float32), mesh.faces.astype(np.int32), 1.0 - share)
        return TriMesh(points, faces)

    return change


def with_faces(count: int):
    """Quadric edge collapse down to so many faces; a mesh that has no more stays as it is."""

    def change(mesh: TriMesh) -> TriMesh:
        return decimated(count / mesh.n_faces)(mesh) if mesh.n_faces > count else mesh

    return change


def subdivided(mesh: TriMesh) -> TriMesh:
    """Every triangle cut into four."""
    import trimesh

    return TriMesh(*trimesh.remesh.subdivide(mesh.vertices, mesh.faces))


def finer_on_one_side(mesh: TriMesh) -> TriMesh:
    """The faces beyond the middle cut into four: where they end, vertices lie within edges."""
    along = mesh.face_centroids @ np.array([0.3, 1.0, 0.2])
    return TriMesh(*shapes.finer_in(shapes.Shape(mesh.vertices, mesh.faces), along > np.median(along))[0])


def torn(share: float):
    """Some edges split for one of their faces only, and this face with them."""

    def change(mesh: TriMesh) -> TriMesh:
        chosen = np.flatnonzero(np.random.default_rng(SEED).random(mesh.n_faces) < share)
        return TriMesh(*shapes.split_on_one_side(shapes.Shape(mesh.vertices, mesh.faces), chosen)[0])

    return change


def as_wall(hole: float, thickness: float):
    """Opened where it is lowest, for a share of its area, and with a wall, in diagonals of its box."""

    def change(mesh: TriMesh) -> tuple[TriMesh, None, np.ndarray]:
        """The mesh; None; and for each given face one of its two images, on one side of the wall or the other."""
        middle = mesh.face_centroids
        near = np.argsort(np.linalg.norm(middle - middle[middle[:, 1].argmin()], axis=1), kind="stable")
        kept = np.sort(near[np.cumsum(mesh.face_area[near]) > hole * mesh.area])
        wall = shapes.thickened(shapes.Shape(mesh.vertices, mesh.faces[kept]), thickness * mesh.diagonal)
        image = cKDTree(middle[kept]).query(middle)[1]
        return TriMesh(*wall), None, np.where(np.arange(mesh.n_faces) % 2, image, len(kept) + image)

    return change


def as_closed_halves(mesh: TriMesh) -> tuple[TriMesh, None, np.ndarray]:
    """One side of the plane of symmetry, closed there, and its mirror image; as it is if it has none or is not closed.

    Returns the mesh; None; and for each given face the nearest one of its half.
    """
    from manifold3d import Manifold, Mesh

    plane = decompose(mesh.vertices, mesh.faces).mirror
    solid = Manifold(Mesh(mesh.vertices.astype(np.float32), mesh.faces.astype(np.uint32)))
    if not len(plane) or solid.is_empty():
        return mesh, None, np.arange(mesh.n_faces)
    half = solid.trim_by_plane(plane[:3], plane[3]).to_mesh()
    vertices, faces = np.asarray(half.vert_properties, float)[:, :3], np.asarray(half.tri_verts, np.int64)
    image = vertices - 2 * (vertices @ plane[:3] - plane[3])[:, None] * plane[:3]
    both = TriMesh(np.concatenate([vertices, image]), np.concatenate([faces, faces[:, ::-1] + len(vertices)]))
    above = np.abs(vertices @ plane[:3] - plane[3])[faces].max(axis=1) > 1e-5 * mesh.diagonal
    outer = np.flatnonzero(np.tile(above, 2))
    return both, None, outer[cKDTree(both.face_centroids[outer]).query(mesh.face_centroids)[1]]


def as_quads(mesh: TriMesh) -> tuple[TriMesh, np.ndarray, np.ndarray]:
    """Triangles paired to quadrangles, flattest pairs first, and cut along the other diagonal.

    Returns the mesh, the polygon of each of its faces, and the polygon of each given face.
    """
    pairs = mesh.edges.pairs[np.argsort(np.abs(mesh.dihedral), kind="stable")]
    edge = mesh.edges.pair_edge[np.argsort(np.abs(mesh.dihedral), kind="stable")]
    free, chosen = np.ones(mesh.n_faces, bool), []
    for row, (one, other) in enumerate(pairs.tolist()):
        if free[one] and free[other]:
            free[one] = free[other] = False
            chosen.append(row)
    one, other = pairs[chosen].T
    faces, polygon = mesh.faces.copy(), np.arange(mesh.n_faces)
    corner = (mesh.edges.face_edges[one] == edge[chosen][:, None]).argmax(axis=1)
    a, b, c = (mesh.faces[one, (corner + k) % 3] for k in range(3))
    d = mesh.faces[other].sum(axis=1) - a - b
    faces[one], faces[other] = np.stack([c, a, d], axis=1), np.stack([d, b, c], axis=1)
    polygon[other] = one
    polygon = np.unique(polygon, return_inverse=True)[1].reshape(-1)
    return TriMesh(mesh.vertices, faces), polygon, polygon


def bent(angle: float):
    """The mesh wound around an axis: along its longest direction it turns by so many degrees."""

    def change(mesh: TriMesh) -> TriMesh:
        middle = mesh.vertices.mean(axis=0)
        _, _, axes = np.linalg.svd(mesh.vertices - middle, full_matrices=False)
        along, across, up = ((mesh.vertices - middle) @ axes.T).T
        radius = np.ptp(along) / np.radians(angle)
        turn = along / radius
        bent_points = np.stack([(radius + up) * np.sin(turn), across, (radius + up) * np.cos(turn)], axis=1)
        return TriMesh(bent_points, mesh.faces)

    return change


def twisted(angle: float):
    """The mesh twisted about its longest direction by so many degrees from end to end."""

    def change(mesh: TriMesh) -> TriMesh:
        middle = mesh.vertices.mean(axis=0)
        _, _, axes = np.linalg.svd(mesh.vertices - middle, full_matrices=False)
        along, across, up = ((mesh.vertices - middle) @ axes.T).T
        turn = np.radians(angle) * along / np.ptp(along)
        points = np.stack([along, np.cos(turn) * across - np.sin(turn) * up,
                           np.sin(turn) * across + np.cos(turn) * up], axis=1)
        return TriMesh(points, mesh.faces)

    return change


CHANGES = {
    "as it is": lambda mesh: mesh,
    "noise, 0.1 % of an edge": with_noise(0.001),
    "noise, 5 % of an edge": with_noise(0.05),
    "noise, 10 % of an edge": with_noise(0.1),
    "noise, 20 % of an edge": with_noise(0.2),
    "noise, 40 % of an edge": with_noise(0.4),
    "10 steps of smoothing": smoothed,
    "decimated to half": decimated(0.5),
    "decimated to 10 %": decimated(0.1),
    "decimated to 2,000 faces": with_faces(2000),
    "decimated to 800 faces": with_faces(800),
    "decimated to 300 faces": with_faces(300),
    "subdivided": subdivided,
    "finer on one side": finer_on_one_side,
    "2 % of faces split at an edge that is whole for the next": torn(0.02),
    "30 % of faces split so": torn(0.3),
    "a wall of 0.005 with a hole of 0.002": as_wall(0.002, 0.005),
    "a wall of 0.008 around half of it": as_wall(0.5, 0.008),
    "one side and its mirror image, each closed": as_closed_halves,
    "quads instead of triangles": as_quads,
    "bent by 45 degrees": bent(45.0),
    "bent by 90 degrees": bent(90.0),
    "twisted by 60 degrees": twisted(60.0),
}


def compare(
    mesh: TriMesh, labels: np.ndarray, people: np.ndarray, change, parameters: Parameters
) -> tuple[float, float, float, float]:
    """Rand index, agreement and ratio of the numbers of parts of a mesh and its changed copy; error against people.

    labels, people : (m,) and (k, m), the error is NaN without people.
    """
    changed, polygon, place = change(mesh), None, None
    if isinstance(changed, tuple):
        changed, polygon, place = changed
    parts = decompose(changed.vertices, changed.faces, parameters, polygon=polygon).parts()
    if place is not None:
        back = parts.labels[place]
    elif changed.n_faces == mesh.n_faces:
        back = parts.labels
    else:
        back = parts.labels[cKDTree(changed.face_centroids).query(mesh.face_centroids)[1]]
    error = np.mean([rand_index_error(back, person) for person in people]) if len(people) else np.nan
    return 1 - rand_index_error(back, labels), agreement(back, labels), parts.count / (labels.max() + 1), error


def people_of(path: Path) -> np.ndarray:
    """What people said of the faces of a mesh, (k, m) int64; k is 0 where nobody did."""
    if path.suffix == ".npz":
        with np.load(path) as stored:
            if "human" in stored:
                return stored["human"]
    return np.empty((0, 0), np.int64)


def main() -> int:
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("meshes", nargs="*", type=Path, default=[SPOT], metavar="MESHES")
    parser.add_argument("--preset", choices=list(PRESETS), default=next(iter(PRESETS)), metavar="NAME")
    parser.add_argument("--only", default="", metavar="WORD", help="changes with this word in their name")
    arguments = parser.parse_args()
    parameters = Parameters.preset(arguments.preset)
    changes = {name: change for name, change in CHANGES.items() if arguments.only in name}
    rows = {name: [] for name in changes}
    for path in tqdm(arguments.meshes, unit="mesh", disable=None):
        mesh, people = TriMesh(*load_mesh(path)), people_of(path)
        labels = decompose(mesh.vertices, mesh.faces, parameters).parts().labels
        for name, change in changes.items():
            rows[name].append(compare(mesh, labels, people, change, parameters))
    print(f"| {arguments.preset}, {len(arguments.meshes)} meshes | Rand index | agreement (12) | parts | people |")
    print("| --- | --- | --- | --- | --- |")
    for name, values in rows.items():
        rand, agree, ratio, error = np.mean(values, axis=0)
        print(f"| {name} | {rand:.3f} | {agree:.2f} | x {ratio:.2f} | {error:.3f} |")
    return 0


if __name__ == "__main__":
    sys.exit(main())

# SPDX-License-Identifier: GPL-3.0-or-later
"""Coarse meshes that are no mirror images face by face, though their shape is: parts are symmetric within a face."""

import numpy as np
import pytest
import shapes
from scipy.spatial import cKDTree

from core import TriMesh, decompose
from core.metrics import rand_index_error


def figure_of_two_tessellations():
    """A figure of few faces, of which one side has each of them in four; the shape is the same to rounding."""
    figure = shapes.mirrored_figure(0.2)
    fine = shapes.subdivide(figure)
    left = TriMesh(*figure).face_centroids[:, 0] < 0
    right = TriMesh(*fine).face_centroids[:, 0] > 0
    vertices, faces = shapes.together(shapes.Shape(figure.vertices, figure.faces[left]),
                                      shapes.Shape(fine.vertices, fine.faces[right]))
    return vertices, faces


def table_of_triangles():
    """A table whose quads are all divided along the diagonal from the same corner."""
    vertices, faces = shapes.table_of_blocks()
    return vertices, shapes.split_quads(np.asarray(faces))


def two_tables():
    """Two bodies, each the image of the other but for the diagonals."""
    vertices, faces = table_of_triangles()
    size = np.ptp(vertices[:, 0])
    return shapes.together(shapes.Shape(vertices - (size, 0, 0), faces), shapes.Shape(vertices + (size, 0, 0), faces))


def mirrored_points(vertices, faces, plane):
    """Faces of points spread over the surface, and faces of the points nearest to their mirror images."""
    corner = vertices[faces]
    area = np.linalg.norm(np.cross(corner[:, 1] - corner[:, 0], corner[:, 2] - corner[:, 0]), axis=1)
    rng = np.random.default_rng(0)
    face = rng.choice(len(faces), 200_000, p=area / area.sum())
    points = (corner[face] * rng.dirichlet(np.ones(3), len(face))[:, :, None]).sum(axis=1)
    image = points - 2 * (points @ plane[:3] - plane[3])[:, None] * plane[:3]
    return face, face[cKDTree(points).query(image)[1]]


def at_a_cut(vertices, faces, labels):
    """Whether each face has a corner at which there is another part; a corner is a place, not a vertex."""
    place = np.unique(vertices.round(6), axis=0, return_inverse=True)[1].reshape(-1)[faces]
    low, high = np.full(place.max() + 1, labels.max()), np.zeros(place.max() + 1, int)
    np.minimum.at(low, place, labels[:, None])
    np.maximum.at(high, place, labels[:, None])
    return (low < high)[place].any(axis=1)


# As Rand index errors. The side of the table goes on above each of the two outer sides of a leg: of two triangles there
# one may be unlike its image, which is 8 of 656 faces between a leg, 0.08 of the area, and the top, 0.69.
@pytest.mark.parametrize(("shape", "most"), [
    (figure_of_two_tessellations(), 0.01), (table_of_triangles(), 1.05 * 2 * 8 / 656 * (0.08 + 0.69)),
    (two_tables(), 0.01)])
@pytest.mark.parametrize("seed", range(2))
def test_parts_are_symmetric_within_a_face(shape, most, seed):
    rng = np.random.default_rng(seed)
    vertices, faces = shape[0] @ shapes.rotation(rng).T, shape[1]
    found = decompose(vertices, faces)
    assert len(found.mirror) == 4
    face, image = mirrored_points(vertices, faces, found.mirror)
    for detail in (0.4, 0.5, 0.6):
        parts = found.parts(detail)
        assert (parts.twin >= 0).all()
        assert np.array_equal(parts.twin[parts.twin], np.arange(parts.count))
        unlike = parts.twin[parts.labels[face]] != parts.labels[image]
        near = at_a_cut(vertices, faces, parts.labels)
        # Beside the plane what is nearest to the image of a point may be the point itself.
        assert (unlike & ~near[face] & ~near[image]).mean() < 1e-4
        assert rand_index_error(parts.labels[face], parts.labels[image]) < most

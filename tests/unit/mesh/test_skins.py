# SPDX-License-Identifier: GPL-3.0-or-later
"""Second skins, such as outlines, and the inner walls of hollow bodies have the parts of what they run along."""

import numpy as np
import pytest
import shapes

from core import decompose
from core.mesh.copies import find_copies
from core.mesh.polygons import PolygonMesh
from core.uses.correspondence import sample_surface
from core.uses.descriptors import part_descriptors

RNG = np.random.default_rng(3)
FIGURE = shapes.mirrored_figure()
PIECES = shapes.together(FIGURE, shapes.moved(shapes.torus(), (0.0, 0.0, 3.0)))
QUADS = shapes.Shape(*shapes.cross_of_blocks(6, 2))


def skin(shape, distance):
    """The shape once more, so far above itself, and turned inside out; polygons begin with another corner."""
    vertices, faces = shape
    normal = np.zeros_like(vertices)
    corner = vertices[faces]
    across = np.cross(corner[:, 1] - corner[:, 0], corner[:, 2] - corner[:, 0])
    for column in faces.T:
        np.add.at(normal, column, across)
    normal /= np.linalg.norm(normal, axis=1)[:, None]
    return shapes.Shape(vertices + distance * normal, np.roll(faces[:, ::-1], 1, axis=1))


def dumbbell(scale=1.0):
    """A body of revolution with two balls: its radius so many times as large."""
    height = np.linspace(-2.0, 2.0, 60)
    radius = 0.25 + 0.75 * np.clip(1 - ((np.abs(height) - 1.2) / 0.8) ** 2, 0, 1) ** 0.5
    radius[[0, -1]] = 0.0
    return shapes.lathe(scale * radius, height * (1 - 0.05 * (1 - scale)), 24)


@pytest.mark.parametrize("distance", [0.03, -0.03])
@pytest.mark.parametrize("shape", [FIGURE, PIECES, QUADS], ids=["triangles", "pieces", "quads"])
def test_a_mesh_with_a_second_skin_has_the_parts_of_the_mesh(shape, distance):
    """A fox with an outline came in two parts instead of ten."""
    alone, both = decompose(*shape), shapes.together(shape, skin(shape, distance))
    result = decompose(*both)
    n_faces = len(shape.faces)
    for count in {1, 2, min(5, alone.n_candidates), alone.n_candidates}:
        expected, labels = alone.parts(n_parts=count).labels, result.parts(n_parts=count).labels
        # Below a ridge, four narrow faces of an inner skin are nearer to others than to their own.
        assert (labels[:n_faces] != labels[n_faces:]).sum() <= (4 if distance < 0 else 0)
        assert len(np.unique(np.stack([expected, labels[:n_faces]]), axis=1).T) == count == labels.max() + 1
    assert result.candidate_area.sum() > 1.8 * alone.candidate_area.sum()
    assert np.isfinite(result.field).all()
    assert result.notes[-1].startswith(f"{n_faces} faces run along others as a second skin")
    assert (result.face_twin[:n_faces] == alone.face_twin).all()


@pytest.mark.parametrize("own_corners", [False, True])
def test_the_order_of_a_mesh_does_not_tell_its_skin(own_corners):
    both = shapes.together(PIECES, skin(PIECES, 0.02))
    both = shapes.unjoined(both) if own_corners else both
    mixed, _, faces = shapes.shuffled(both, RNG)
    n_faces = len(PIECES.faces)
    copies = find_copies(PolygonMesh.of(*mixed))
    original = np.empty(2 * n_faces, np.int64)
    original[faces] = faces[copies.polygon[copies.original]]
    assert (original == np.tile(np.arange(n_faces), 2)).all()


def test_no_skin_are_an_image_a_duplicate_and_what_has_other_faces():
    mirrored = shapes.inside_out(shapes.Shape(FIGURE.vertices * (1.0, -1.0, 1.0), FIGURE.faces))
    finer = shapes.inside_out(shapes.subdivide(FIGURE))
    for other in (mirrored, shapes.moved(FIGURE, (0.03, 0.0, 0.0)), shapes.moved(finer, (9.0, 0.0, 0.0)),
                  shapes.moved(skin(FIGURE, 0.03), (1.0, 0.0, 0.0))):
        assert find_copies(PolygonMesh.of(*shapes.together(FIGURE, other))) is None


def test_pieces_without_an_extent_are_no_skins():
    """Two triangles of no area, each at one place, beside a figure with an outline."""
    points = np.repeat([(2.0, 0.0, 0.0), (2.0, 0.01, 0.0)], 3, axis=0)
    flat = shapes.Shape(points, np.arange(6).reshape(2, 3))
    both = shapes.together(FIGURE, skin(FIGURE, 0.02), flat)
    assert find_copies(PolygonMesh.of(*both)).n_copies == len(FIGURE.faces)


@pytest.mark.parametrize(("size", "found"), [(0.3, True), (0.45, False)])
def test_nine_tenths_of_the_area_are_of_skins(size, found):
    """Beside a figure with its outline a ball of 6 or 12 hundredths of the area of both."""
    both = shapes.together(FIGURE, skin(FIGURE, 0.02))
    area = PolygonMesh.of(*both).triangles.area
    ball = shapes.icosphere(2, np.sqrt(size**2 * area / (4 * np.pi)))
    share = (ball_area := PolygonMesh.of(*ball).triangles.area) / (area + ball_area)
    assert (share < 0.1) == found
    beside = shapes.together(both, shapes.moved(ball, (5.0, 0.0, 0.0)))
    assert (find_copies(PolygonMesh.of(*beside)) is not None) == found


@pytest.mark.parametrize("inner", [dumbbell(0.9), shapes.subdivide(dumbbell(0.9))], ids=["like", "finer"])
def test_a_hollow_body_has_the_parts_of_the_body(inner):
    """Prints with walls of a fiftieth of their diameter lost up to half of their parts."""
    outer = dumbbell()
    alone = decompose(*outer)
    result = decompose(*shapes.together(outer, shapes.inside_out(inner)))
    labels, expected = result.parts(n_parts=3).labels, alone.parts(n_parts=3).labels
    assert len(np.unique(np.stack([expected, labels[:len(outer.faces)]]), axis=1).T) == 3 == labels.max() + 1
    # The walls of a ball are one part, up to the first row of faces beside a cut.
    end = np.abs(inner.vertices[inner.faces][:, :, 2].mean(axis=1)) > 1.0
    upper = inner.vertices[inner.faces][:, :, 2].mean(axis=1) > 0
    for side in (upper, ~upper):
        assert len(np.unique(labels[len(outer.faces):][end & side])) == 1
    assert len(np.unique(labels[len(outer.faces):][end])) == 2


def test_what_is_small_in_a_hollow_body_is_part_of_the_cavity():
    bubble = shapes.inside_out(shapes.moved(shapes.icosphere(0, 0.03), (0.0, 0.0, 0.97)))
    ball, inner = shapes.icosphere(3), shapes.inside_out(shapes.icosphere(2, 0.93))
    copies = find_copies(PolygonMesh.of(*shapes.together(ball, inner, bubble)))
    assert copies.n_copies == len(inner.faces) + len(bubble.faces)
    assert find_copies(PolygonMesh.of(*shapes.together(ball, bubble))) is None


def test_no_cavity_is_what_looks_outwards_is_open_or_lies_deep_within():
    ball, inner = shapes.icosphere(3), shapes.icosphere(2, 0.93)
    inside_out = shapes.inside_out(inner)
    for other in (inner, shapes.Shape(inside_out.vertices, inside_out.faces[1:]),
                  shapes.inside_out(shapes.icosphere(2, 0.5)), shapes.moved(inside_out, (0.5, 0.0, 0.0))):
        assert find_copies(PolygonMesh.of(*shapes.together(ball, other))) is None


def test_a_skin_counts_neither_in_samples_nor_in_descriptors():
    both = shapes.together(FIGURE, skin(FIGURE, 0.02))
    alone, samples = sample_surface(*FIGURE), sample_surface(*both)
    n_faces = len(FIGURE.faces)
    assert (samples.face_sample == np.tile(alone.face_sample, 2)).all()
    np.testing.assert_allclose(samples.face_area[:n_faces] + samples.face_area[n_faces:], alone.face_area)
    one, two = (decompose(*shape).parts(n_parts=4) for shape in (FIGURE, both))
    found = part_descriptors(*both, two)
    for row in part_descriptors(*FIGURE, one):
        assert np.abs(found - row).max(axis=1).min() < 0.02

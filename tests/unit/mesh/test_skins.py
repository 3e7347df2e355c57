# SPDX-License-Identifier: GPL-3.0-or-later
"""Second skins, such as outlines, have the parts of what they are skins of."""

import numpy as np
import pytest
import shapes

from core import decompose
from core.mesh.copies import find_copies
from core.mesh.pieces import Pieces, measured
from core.mesh.polygons import PolygonMesh
from core.mesh.skins import find_skins
from core.mesh.triangles import TriMesh
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


def test_each_of_two_like_bodies_has_its_own_skin():
    bodies = [shapes.moved(shape, (x, 0, 0)) for x in (0, 5) for shape in (FIGURE, skin(FIGURE, 0.02))]
    copies, n_faces = find_copies(PolygonMesh.of(*shapes.together(*bodies))), len(FIGURE.faces)
    original = copies.polygon[copies.original].reshape(4, n_faces)
    assert (original == np.array([[0], [0], [2], [2]]) * n_faces + np.arange(n_faces)).all()


@pytest.mark.parametrize("offset", [(50, 0, 0), (-50, 0, 0)])
def test_the_skin_of_an_open_mesh_is_the_one_that_looks_inwards_wherever_it_is(offset):
    half = shapes.moved(shapes.half_of(FIGURE), offset)
    copies = find_copies(PolygonMesh.of(*shapes.together(skin(half, 0.02), half)))
    assert copies.polygon.tolist() == list(range(len(half.faces), 2 * len(half.faces)))


def test_as_many_faces_that_meet_otherwise_are_no_skin():
    """A ball of triangles and one of rings around it, of 320 faces each."""
    angle = np.linspace(0, np.pi, 12)
    rings = shapes.lathe(1.03 * np.sin(angle), -1.03 * np.cos(angle), 16)
    ball = shapes.icosphere(2)
    assert len(rings.faces) == len(ball.faces)
    assert find_copies(PolygonMesh.of(*shapes.together(ball, shapes.inside_out(rings)))) is None


def test_of_three_pieces_that_are_alike_those_are_a_pair_that_are_nearest_to_each_other():
    """A tiny figure in the large one, its middle beyond that of the skin: the skin is nearest to it."""
    outline = skin(FIGURE, 0.02)
    middle, its_middle = (measured(TriMesh(*shape), np.zeros(len(shape.faces), np.int64), 1)[1][0]
                          for shape in (FIGURE, outline))
    tiny = shapes.Shape(0.05 * (FIGURE.vertices - middle) + its_middle + 3 * (its_middle - middle), FIGURE.faces)
    given = PolygonMesh.of(*shapes.together(FIGURE, tiny, outline))
    assert find_skins(given, Pieces.of(given, np.arange(given.triangles.n_vertices))).tolist() == [-1, -1, 0]


def test_a_skin_may_have_places_in_common_with_what_it_runs_along():
    """Where the normal of a vertex is 0, an outline is where the mesh is: both would be one piece by their places."""
    outline = skin(FIGURE, 0.02)
    outline.vertices[7] = FIGURE.vertices[7]
    copies = find_copies(PolygonMesh.of(*shapes.together(FIGURE, outline)))
    n_faces = len(FIGURE.faces)
    assert copies.polygon.tolist() == list(range(n_faces))
    assert not copies.has_other_side.any()
    np.testing.assert_array_equal(copies.original, np.tile(np.arange(n_faces), 2))


@pytest.mark.parametrize(("count", "found"), [(3, False), (4, True)])
def test_of_so_few_faces_that_none_may_be_left_out_none_are_a_skin(count, found):
    fan = shapes.Shape(shapes.tetrahedron().vertices, shapes.tetrahedron().faces[:count])
    assert (find_copies(PolygonMesh.of(*shapes.together(fan, skin(fan, 0.01)))) is not None) == found


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


ROUND = np.linspace(0, np.pi, 41)  # from pole to pole


def has_skin(radius):
    """Whether a ball has a skin, a body of revolution of the same faces. radius : (41,), of its rings."""
    ball, around = (shapes.lathe(rings * np.sin(ROUND), -rings * np.cos(ROUND), 24) for rings in (np.ones(41), radius))
    copies = find_copies(PolygonMesh.of(*shapes.together(ball, shapes.inside_out(around))))
    assert copies is None or copies.n_copies == len(around.faces)
    return copies is not None


@pytest.mark.parametrize(("share", "found"), [(0.028, True), (0.032, False)])
def test_a_skin_is_three_hundredths_of_the_diameter_away_at_most(share, found):
    """Around a ball: the diameter of the mesh is that of the skin."""
    diameter = np.sqrt(12.0) / (1 - share * np.sqrt(12.0))
    assert has_skin(np.full(41, 1 + share * diameter)) == found


@pytest.mark.parametrize(("angle", "found"), [(55, True), (65, False)])
def test_a_skin_looks_the_other_way_but_for_sixty_degrees(angle, found):
    """In folds, whose sides are turned by so much from the ball."""
    assert has_skin(1.03 * (1 + np.tan(np.radians(angle)) * ROUND[1] * (np.arange(41) % 2 - 0.5))) == found


@pytest.mark.parametrize(("bulge", "found"), [(8, True), (9, False)])
def test_seven_tenths_of_a_skin_run_along(bulge, found):
    """All but so many of its 40 rings and the next, which go off to 1.4: 0.74 of its area, or 0.698."""
    assert has_skin(np.where(np.arange(41) <= bulge, 1.4, 1.03)) == found


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

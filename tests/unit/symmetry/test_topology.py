# SPDX-License-Identifier: GPL-3.0-or-later
"""The mirror symmetry of a mesh as its polygons hang together, in any pose."""

import numpy as np
import pytest
import shapes

from core.mesh.polygons import PolygonMesh
from core.mesh.triangles import TriMesh
from core.surface.preparation import repair
from core.symmetry import topology as module
from core.symmetry.images import Images
from core.symmetry.search import mirror_plane
from core.symmetry.small_faces import SmallFaces
from core.symmetry.topology import topology_mirror


def found(vertices, faces):
    given = PolygonMesh.of(vertices, faces)
    working = repair(given)
    return topology_mirror(working.mesh, working.polygon, given.n_polygons)


def exact_twins(vertices, faces):
    """Those in the plane of a figure that is not posed."""
    mesh = SmallFaces.of(TriMesh(vertices, faces))
    return Images(mesh, mirror_plane(mesh)).exact_twins


@pytest.fixture(scope="module")
def figure():
    return shapes.mirrored_figure()


@pytest.mark.parametrize("seed", range(3))
def test_a_posed_figure_has_the_twins_it_has_in_the_pose_it_was_made_in(figure, seed):
    rng = np.random.default_rng(seed)
    vertices, faces = figure
    twin = exact_twins(*figure)
    assert mirror_plane(SmallFaces.of(TriMesh(shapes.posed(vertices), faces))) is None
    (shuffled, shuffled_faces), _, face = shapes.shuffled(shapes.Shape(shapes.posed(vertices), faces), rng)
    mirror = found(7.0 * (shuffled @ shapes.rotation(rng).T + rng.normal(size=3) * 10), shuffled_faces)
    expected = np.argsort(face)[twin[face]]
    assert np.array_equal(mirror.twin, expected)
    side = np.sign(vertices[faces].mean(axis=1)[:, 0])[face]
    side[expected == np.arange(len(faces))] = 0
    assert abs(mirror.side @ side) == np.abs(side).sum()
    assert np.array_equal(mirror.side[mirror.twin], -mirror.side)


def test_the_first_side_is_that_of_positive_x(figure):
    vertices, faces = figure
    mirror = found(shapes.posed(vertices), faces)
    assert vertices[faces].mean(axis=1)[mirror.side == 1, 0].min() > 0


def test_polygons_are_mirrored_whatever_diagonals_they_were_cut_along(figure):
    """Of a figure each of whose triangles is divided into three quads; the triangles of these are no twins."""
    vertices, faces = figure
    middles, inverse = np.unique(np.sort(np.stack([faces, np.roll(faces, -1, 1)], 2).reshape(-1, 2), 1), axis=0,
                                 return_inverse=True)
    n, e = len(vertices), len(middles)
    edge = n + inverse.reshape(-1, 3)
    center = n + e + np.arange(len(faces))
    quads = np.stack([np.stack([faces[:, k], edge[:, k], center, edge[:, k - 1]], axis=1) for k in range(3)], axis=1)
    points = np.concatenate([vertices, vertices[middles].mean(axis=1), vertices[faces].mean(axis=1)])
    mirror = found(shapes.posed(points), quads.reshape(-1, 4))
    of_face = mirror.twin.reshape(-1, 3)
    assert np.array_equal(of_face // 3, np.repeat(exact_twins(*figure)[:, None], 3, axis=1))


def test_a_detail_on_one_side_hides_itself_alone(figure):
    """A hand of one arm is divided finer, and a face of a leg taken away."""
    vertices, faces = figure
    twin, center = exact_twins(*figure), vertices[faces].mean(axis=1)
    hand = np.flatnonzero(center[:, 0] > 1.2)
    leg = np.flatnonzero(center[:, 2] < -1.0)[:1]
    middle = len(vertices) + np.arange(len(hand))
    fine = np.concatenate([np.stack([faces[hand, k], faces[hand, (k + 1) % 3], middle], axis=1) for k in range(3)])
    kept = np.setdiff1d(np.arange(len(faces)), np.concatenate([hand, leg]))
    points = np.concatenate([vertices, center[hand]])
    mirror = found(shapes.posed(points), np.concatenate([faces[kept], fine]))
    number = np.full(len(faces), -1)
    number[kept] = np.arange(len(kept))
    known = mirror.twin[: len(kept)]
    assert np.array_equal(known[known >= 0], number[twin[kept]][known >= 0])
    lost = np.flatnonzero(known < 0)
    hidden = center[np.concatenate([hand, twin[hand], leg, twin[leg]])]
    away = np.linalg.norm(center[kept][lost][:, None] - hidden, axis=2).min(axis=1)
    assert away.max() < 0.2
    assert len(lost) < 0.2 * len(kept)


def test_pieces_on_both_sides_are_twins(figure):
    """Two patches, each a piece of its own."""
    vertices, faces = figure
    patch = shapes.flat_grid(4, 3, 0.05)
    patch = shapes.Shape(patch.vertices, patch.faces[1:])  # without a corner it is no image of itself
    image = shapes.Shape(patch.vertices * (-1, 1, 1), patch.faces[:, ::-1])
    whole = shapes.together(shapes.Shape(shapes.posed(vertices), faces), shapes.moved(patch, (0.12, -0.4, 1.9)),
                            shapes.moved(image, (-0.12, -0.4, 1.9)))
    mirror = found(*whole)
    n, m = len(faces), len(patch.faces)
    assert np.array_equal(mirror.twin[n:], np.concatenate([n + m + np.arange(m), n + np.arange(m)]))
    assert np.array_equal(mirror.side[n:], np.repeat([1, -1], m))


@pytest.mark.parametrize("shape", [
    shapes.tube_tree(step=0.13),  # no symmetry
    shapes.torus(12, 8),  # each face is like each other
    shapes.cylinder(6, 8),
    shapes.box(),
], ids=["tree", "torus", "cylinder", "box"])
def test_what_has_no_symmetry_or_many_has_none(shape):
    assert found(*shape) is None


def test_a_mesh_stretched_on_one_side_has_none(figure):
    """One half four times as large: edges are no images of each other, though they hang together alike."""
    vertices, faces = figure
    assert found(np.where(vertices[:, :1] > 0, 4.0, 1.0) * vertices, faces) is None


def test_dense_meshes_are_not_looked_at(figure, monkeypatch):
    monkeypatch.setattr(module, "MOST_POLYGONS", len(figure.faces) - 1)
    assert found(*figure) is None


def test_images_grow_over_what_is_as_long_but_for_a_bend(figure):
    """A hand that is three times as large as the other hangs together alike, and is not its image."""
    vertices, faces = figure
    far = vertices[:, 0] > 0.9
    for size, grown in ((1.5, True), (3.5, False)):
        points = vertices.copy()
        points[far] = (0.9, 0, 0) + size * (points[far] - (0.9, 0, 0))
        mesh = TriMesh(points, faces)
        half = module.HalfEdges.of(mesh, np.arange(len(faces)))
        twin = exact_twins(*figure)
        known = module._consistent(half, module._only_images(half)[-1], mesh.face_area[half.polygon])
        hand = far[faces].all(axis=1)
        known[(hand | hand[twin])[half.polygon]] = -1
        partner = module._grown(half, known)
        assert (partner[hand[half.polygon]] >= 0).mean() == pytest.approx(float(grown), abs=0.2)


@pytest.mark.parametrize(("turned", "has_sides"), [(0.04, True), (0.06, False)])
def test_what_is_turned_onto_itself_has_no_sides(turned, has_sides):
    """Four polygons: two that are images of each other beside the middle, and two that another region swaps."""
    twin = np.array([1, 0, 3, 2])
    share = np.array([0.5 - turned / 2, 0.5 - turned / 2, turned])
    beside = np.array([True, True, False])
    regions = module._Regions(np.array([0, 1, 2, 2]), np.array([1, 0, -1]), share, beside, turned)
    middle = np.array([(1.0, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0)])
    found = module._with_sides(regions, twin, np.append(share[:2], [turned / 2] * 2), middle)
    assert (found is not None) == has_sides
    assert found is None or found.side.tolist() == [1, -1, 0, 0]

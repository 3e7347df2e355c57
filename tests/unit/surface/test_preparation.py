# SPDX-License-Identifier: GPL-3.0-or-later
"""The working copy: repaired, turned outwards, refined, and always with a way back."""

import numpy as np
import pytest
import shapes

from core.mesh.polygons import PolygonMesh
from core.mesh.triangles import TriMesh
from core.surface.preparation import MAX_EDGE, _separate_fans, bodies, repair, split_long_edges, worth_cutting


def repaired(shape, polygon=None):
    return repair(PolygonMesh.of(*shape, polygon))


def volume(mesh):
    return np.einsum("ij,ij->", mesh.area_normals, mesh.face_centroids - mesh.vertices.mean(axis=0)) / 3


def has_note(working, text):
    return any(text in note for note in working.notes)


SHAPES = {
    "sphere": shapes.icosphere, "genus 2": lambda: shapes.surface_of_genus(2),
    "inside out": lambda: shapes.inside_out(shapes.icosphere(2)),
    "unjoined": lambda: shapes.unjoined(shapes.icosphere(2)),
    "fin": lambda: shapes.with_fin(shapes.icosphere(2)), "bowtie": lambda: shapes.bowtie(shapes.icosphere(1)),
    "unused": lambda: shapes.with_unused_vertices(shapes.icosphere(2)),
    "flat faces": lambda: shapes.with_flat_faces(shapes.icosphere(2)), "crumbs": lambda: shapes.crumbs(60),
    "border": lambda: shapes.flat_grid(6, 4),
}


@pytest.mark.parametrize("name", SHAPES)
def test_the_way_back(name):
    given = PolygonMesh.of(*SHAPES[name]())
    working = repair(given)
    mesh = working.mesh
    np.testing.assert_array_equal(mesh.vertices, given.triangles.vertices[working.vertex_source])
    assert np.unique(mesh.faces).tolist() == list(range(mesh.n_vertices))  # every vertex is used
    assert (np.diff(working.vertex_source) >= 0).all()
    # The corners of each triangle are where the caller's are, in either direction.
    own, theirs = mesh.corners, given.triangles.corners[working.polygon]
    np.testing.assert_array_equal(np.sort(own.reshape(-1, 9), axis=1), np.sort(theirs.reshape(-1, 9), axis=1))
    assert mesh.area == pytest.approx(given.triangles.area)


def test_a_sound_mesh_stays_as_it_is():
    shape = shapes.surface_of_genus(1)
    working = repaired(shape)
    np.testing.assert_array_equal(working.mesh.vertices, shape.vertices)
    np.testing.assert_array_equal(working.mesh.faces, shape.faces)
    assert working.notes == ()


@pytest.mark.parametrize("make", [shapes.box, shapes.icosphere, shapes.tube_tree, shapes.torus])
def test_seams_are_joined(make):
    whole, working = TriMesh(*make()), repaired(shapes.unjoined(make()))
    assert working.mesh.euler_characteristic == whole.euler_characteristic
    assert working.mesh.face_components[0] == 1
    assert (working.mesh.edges.n_faces == 2).all()
    assert has_note(working, f"{3 * whole.n_faces - whole.n_vertices} coincident border vertices")


def test_minus_zero_is_zero():
    vertices, faces = shapes.unjoined(shapes.octahedron())
    vertices[vertices == 0] *= np.random.default_rng(0).choice([-1.0, 1.0], (vertices == 0).sum())
    assert repaired((vertices, faces)).mesh.euler_characteristic == 2


def test_closed_parts_that_touch_stay_two_parts():
    # Two boxes with a side in common: each has vertices of its own there.
    two = shapes.together(shapes.box(), shapes.moved(shapes.box(), (1, 0, 0)))
    working = repaired(two)
    assert working.mesh.face_components[0] == 2
    assert working.mesh.n_vertices == 16


def test_fans_are_separated():
    shape = shapes.bowtie(shapes.icosphere(1))
    working = repaired(shape)
    assert working.mesh.n_vertices == len(shape.vertices) + 1
    assert (working.vertex_source == 0).sum() == 2
    assert working.mesh.euler_characteristic == 4  # two spheres
    assert volume(working.mesh) == pytest.approx(volume(TriMesh(*shape)))


def n_fans(shape):
    """Around all vertices together, counted one by one."""
    vertices, faces = shape
    around = [[] for _ in range(len(vertices))]
    for a, b, c in faces.tolist():
        for vertex, *ends in ((a, b, c), (b, c, a), (c, a, b)):
            fans = [fan for fan in around[vertex] if fan & set(ends)]
            around[vertex] = [fan for fan in around[vertex] if fan not in fans] + [set(ends).union(*fans)]
    return sum(len(fans) for fans in around)


@pytest.mark.parametrize("make", [
    lambda: shapes.icosphere(1), lambda: shapes.lathe([0, 1, 1, 0], [0, 1, 2, 3], 90),  # tips of 90 faces
    lambda: shapes.flat_grid(4, 4), lambda: shapes.with_fin(shapes.icosphere(1)),
    lambda: shapes.bowtie(shapes.with_unused_vertices(shapes.icosphere(2))),
    lambda: shapes.bowtie(shapes.flat_grid(3, 3)), lambda: shapes.together(*[shapes.tetrahedron()] * 3)])
@pytest.mark.parametrize("seed", range(4))
def test_each_fan_gets_a_vertex(make, seed):
    """Whatever way the faces are turned, and where some are missing."""
    vertices, faces = make()
    rng = np.random.default_rng(seed)
    turned = rng.random(len(faces)) < 0.1 * seed
    faces = np.where(turned[:, None], faces[:, ::-1], faces)[rng.random(len(faces)) < 1 - 0.1 * seed]
    mesh, source = _separate_fans(TriMesh(vertices, faces))
    assert mesh.n_vertices == n_fans((vertices, faces))
    assert (source[mesh.faces] == faces).all()
    assert (np.diff(source) >= 0).all()


@pytest.mark.parametrize("make", [shapes.icosphere, shapes.box, shapes.torus,
                                  lambda: shapes.surface_of_genus(2), lambda: shapes.moved(shapes.box(), 1e4)])
@pytest.mark.parametrize("seed", range(3))
def test_faces_are_turned_outwards(make, seed):
    shape = make()
    right = TriMesh(*shape)
    rng = np.random.default_rng(seed)
    mixed = np.where(rng.random(len(shape.faces))[:, None] < 0.3, shape.faces[:, ::-1], shape.faces)
    for faces in (mixed, shape.faces[:, ::-1]):
        working = repaired((shape.vertices, faces))
        # The repaired normals are those of the shape as it was made.
        np.testing.assert_allclose(working.mesh.face_normals, right.face_normals, atol=1e-12)
        n_wrong = (np.sort(faces) == np.sort(shape.faces)).all() and (faces != shape.faces).any(axis=1).sum()
        assert has_note(working, f"{n_wrong} triangles face inwards")


def test_each_loose_part_is_turned_on_its_own():
    shape = shapes.together(shapes.icosphere(1), shapes.inside_out(shapes.moved(shapes.box(), (5, 0, 0))))
    working = repaired(shape)
    assert volume(working.mesh) == pytest.approx(volume(TriMesh(*shapes.icosphere(1))) + 1)


def test_open_surfaces_keep_the_side_most_of_them_face():
    vertices, faces = shapes.flat_grid(6, 4)
    some = faces.copy()
    some[[3, 10, 11]] = some[[3, 10, 11], ::-1]
    np.testing.assert_allclose(repaired((vertices, some)).mesh.face_normals[:, 2], 1)
    few = faces[:, ::-1].copy()
    few[[3, 10, 11]] = few[[3, 10, 11], ::-1]
    np.testing.assert_allclose(repaired((vertices, few)).mesh.face_normals[:, 2], -1)


def test_a_moebius_band_goes_through():
    n = 20
    angle = 2 * np.pi * np.arange(n) / n
    wide = np.array([-0.3, 0.3])[:, None]
    far = 1 + wide * np.cos(angle / 2)
    band = np.stack([far * np.cos(angle), far * np.sin(angle), wide * np.sin(angle / 2)], axis=-1)
    vertices = band.transpose(1, 0, 2).reshape(-1, 3)
    quads = np.array([(2 * i, 2 * i + 2, 2 * i + 3, 2 * i + 1) for i in range(n - 1)] + [(2 * n - 2, 1, 0, 2 * n - 1)])
    working = repaired((vertices, shapes.split_quads(quads)))
    assert working.mesh.euler_characteristic == 0
    assert (working.mesh.edges.n_faces == 1).sum() == 2 * n


@pytest.mark.parametrize(("name", "text"), [
    ("fin", "1 edge joins more than two faces"), ("border", "20 border edges"),
    ("unused", "9 vertices belong to no face"), ("flat faces", "10 faces have zero area"),
    ("unjoined", "coincident border vertices"), ("inside out", "320 triangles face inwards"),
])
def test_notes_say_what_is_odd(name, text):
    assert has_note(repaired(SHAPES[name]()), text)


def test_faces_with_a_repeated_corner_go():
    shape = shapes.with_flat_faces(shapes.icosphere(1), 4)
    working = repaired(shape)
    # Needles of three different corners stay.
    assert working.mesh.n_faces == len(shape.faces) - 4
    assert (np.sort(working.mesh.faces, axis=1)[:, :-1] != np.sort(working.mesh.faces, axis=1)[:, 1:]).all()


# Refinement ------------------------------------------------------------------------------------


@pytest.mark.parametrize("make", [
    shapes.box, lambda: shapes.box((1, 2, 30)), shapes.tube_tree, shapes.dumbbell, shapes.two_spheres,
    lambda: shapes.with_fin(shapes.icosphere(1)), lambda: shapes.flat_grid(3, 2), shapes.tetrahedron])
@pytest.mark.parametrize("share", [0.5, 0.1, 0.05])
def test_refined(make, share):
    mesh = TriMesh(*make())
    limit = share * np.sqrt(mesh.area)
    fine, parent = split_long_edges(mesh, limit)
    assert fine.edge_length.max() <= limit * (1 + 1e-9)
    np.testing.assert_array_equal(fine.vertices[: mesh.n_vertices], mesh.vertices)
    # Each face keeps its area, its plane and its side.
    np.testing.assert_allclose(np.bincount(parent, fine.face_area), mesh.face_area, rtol=1e-9)
    np.testing.assert_allclose(fine.face_normals, mesh.face_normals[parent], atol=1e-6)
    # Conforming: no gaps, no new borders, the same topology.
    assert fine.euler_characteristic == mesh.euler_characteristic
    assert fine.edges.n_faces.max() == mesh.edges.n_faces.max()
    border, fine_border = (m.edge_length[m.edges.n_faces == 1].sum() for m in (mesh, fine))
    assert fine_border == pytest.approx(border)
    assert fine.face_components[0] == mesh.face_components[0]


def test_fine_enough_is_left_alone():
    mesh = TriMesh(*shapes.icosphere(2))
    fine, parent = split_long_edges(mesh, 10.0)
    assert fine is mesh
    assert parent.tolist() == list(range(mesh.n_faces))


def test_needles_do_not_multiply_past_bounds():
    rng = np.random.default_rng(0)
    start = rng.random((3000, 1, 3))
    corners = start + np.stack([0 * start[:, 0], rng.normal(size=(3000, 3)), 1e-5 * rng.normal(size=(3000, 3))], 1)
    mesh = TriMesh(corners.reshape(-1, 3), np.arange(9000).reshape(-1, 3))
    fine, _ = split_long_edges(mesh, 1e-4)
    assert fine.n_faces < 4 * 50_000
    assert fine.area == pytest.approx(mesh.area)


def test_a_body_alone_has_the_whole_budget():
    """It had half of what its constant said, once several bodies were to share less than that."""
    working = repaired(shapes.box((100, 1, 0.3)))
    (body,) = bodies(working, True, 0.01).decomposed
    fine, _ = split_long_edges(working.mesh, MAX_EDGE * np.sqrt(working.mesh.area))
    assert body.mesh.n_faces == fine.n_faces


@pytest.mark.parametrize("scale", [1e-6, 1e6])
def test_refinement_scales(scale):
    vertices, faces = shapes.box((1, 2, 5))
    one, _ = split_long_edges(TriMesh(vertices, faces), 0.3)
    two, _ = split_long_edges(TriMesh(scale * vertices, faces), 0.3 * scale)
    np.testing.assert_array_equal(one.faces, two.faces)


@pytest.mark.parametrize("make", [
    lambda: shapes.box((1, 2, 3)), lambda: shapes.flat_grid(3, 2), lambda: shapes.octahedron(),
    lambda: shapes.half_of(shapes.lathe([0, 1, 0.6, 0], [0, 1, 2, 3], 8))])
def test_the_mirror_image_is_split_like_the_mesh(make):
    """Also where both diagonals of what is left of a face are equal; faces and vertices come in the same order."""
    vertices, faces = make()[:2]
    image = TriMesh(vertices * (-1, 1, 1), faces[:, ::-1])
    one, source = split_long_edges(TriMesh(vertices, faces), 0.21)
    two, image_source = split_long_edges(image, 0.21)
    np.testing.assert_array_equal(one.vertices * (-1, 1, 1), two.vertices)
    np.testing.assert_array_equal(np.sort(one.faces, axis=1), np.sort(two.faces, axis=1))
    np.testing.assert_array_equal(source, image_source)


def exploded(shape, gap, rng):
    """Every face with vertices of its own, each moved by up to a gap, as a share of the diagonal."""
    apart = shapes.unjoined(shape)
    way = rng.normal(size=apart.vertices.shape)
    way /= np.linalg.norm(way, axis=1, keepdims=True)
    diagonal = np.linalg.norm(np.ptp(shape.vertices, axis=0))
    return shapes.Shape(apart.vertices + gap * diagonal * rng.random((len(way), 1)) * way, apart.faces)


@pytest.mark.parametrize("make", [lambda: shapes.icosphere(3), lambda: shapes.torus(24, 12), lambda: shapes.box(),
                                  lambda: shapes.moved(shapes.tube_tree(3, 0.2), 1e3), lambda: shapes.flat_grid(8, 5)])
def test_seams_that_gape_within_rounding_are_joined(make):
    shape = make()
    for seed in range(3):
        working = repaired(exploded(shape, 2e-5, np.random.default_rng(seed)))
        assert working.mesh.n_vertices == len(shape.vertices)
        assert working.mesh.euler_characteristic == TriMesh(*shape).euler_characteristic
        assert has_note(working, "are treated as joined")


def test_gaps_that_one_can_see_stay_open():
    """Every face a twentieth smaller: two thousandths of the diagonal between corners that were one."""
    shape = shapes.icosphere(2)
    apart = shapes.unjoined(shape)
    middle = np.repeat(apart.vertices.reshape(-1, 3, 3).mean(axis=1), 3, axis=0)
    working = repaired((middle + 0.95 * (apart.vertices - middle), apart.faces))
    assert working.mesh.n_vertices == 3 * len(shape.faces)
    assert not has_note(working, "treated as joined")


@pytest.mark.parametrize("make", [shapes.icosphere, shapes.torus, shapes.box])
def test_patches_that_never_met_are_one_surface(make):
    """Eight patches, each moved by a ten-thousandth of the diagonal: more than rounding does, less than one can see."""
    shape = make()
    patch = ((shape.vertices[shape.faces].mean(axis=1) > 0.013) @ (1, 2, 4)).astype(int)
    given = PolygonMesh.of(*shapes.in_patches(shape, patch, 1e-4, np.random.default_rng(1)))
    working = repair(given)
    assert (working.mesh.edges.n_faces == 2).all()
    assert working.mesh.euler_characteristic == TriMesh(*shape).euler_characteristic
    assert working.mesh.n_vertices == len(shape.vertices)
    # All vertices at one place have one value.
    np.testing.assert_array_equal(working.joined[working.joined], working.joined)
    assert len(np.unique(working.joined)) == len(shape.vertices)
    # Faces across seams touch there.
    across = patch[working.stitches]
    assert (across[:, 0] != across[:, 1]).all()
    assert len(np.unique(across.min(axis=1) * 8 + across.max(axis=1))) >= 6


def test_a_piece_as_small_as_the_gap_keeps_its_faces():
    speck = shapes.flat_grid(3, 3)
    speck = shapes.Shape(5e-6 * speck.vertices, speck.faces)
    working = repaired(shapes.together(shapes.icosphere(2), shapes.moved(speck, (0, 0, 2))))
    assert working.mesh.n_faces == len(shapes.icosphere(2).faces) + len(speck.faces)


@pytest.mark.parametrize(("many", "few", "kept"), [(20, 1, 1), (20, 30, 0), (27, 5, 0)])
def test_of_many_bodies_the_larger_are_decomposed_and_of_equal_ones_all_or_none(many, few, kept):
    """Balls of 80 faces, as many as are not too many, beside tetrahedra: with too many in all no tetrahedron stays."""
    places = 10.0 * np.arange(50)
    balls = [shapes.moved(shapes.icosphere(1), (x, 0, 0)) for x in places[:many]]
    small = [shapes.moved(shapes.tetrahedron(), (x, 100, 0)) for x in places[:few]]
    working = repaired(shapes.together(*balls, *small))
    sizes = np.bincount(working.mesh.face_components[1])[worth_cutting(working, working.mesh.face_components[1], 0.0)]
    assert np.bincount(sizes, minlength=81)[[80, 4]].tolist() == [many, kept]

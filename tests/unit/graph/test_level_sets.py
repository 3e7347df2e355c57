# SPDX-License-Identifier: GPL-3.0-or-later
"""Level sets by hand on a few faces, then identities on everything."""

import numpy as np
import pytest
import shapes
from results import same_partition

from core.arrays.components import components
from core.graph.level_sets import cut_at_levels, uniform_levels
from core.mesh.triangles import TriMesh

SURFACES = {
    **{f"genus {g}": (lambda g=g: shapes.surface_of_genus(g, 0.2)) for g in range(4)},
    "border": lambda: shapes.flat_grid(12, 9), "two spheres": shapes.two_spheres,
    "fin": lambda: shapes.with_fin(shapes.icosphere(2)), "box": shapes.box,
    "flat faces": lambda: shapes.with_flat_faces(shapes.icosphere(2)),
    "crumbs": lambda: shapes.crumbs(50),
}


def cut(shape, values, levels):
    return cut_at_levels(TriMesh(*shape), np.asarray(values, float), np.asarray(levels, float))


def slope_of(mesh, seed):
    values = mesh.vertices @ np.random.default_rng(seed).normal(size=3)
    return (values - values.min()) / np.ptp(values)


def test_uniform_levels():
    np.testing.assert_allclose(uniform_levels(4), [0.25, 0.5, 0.75])
    assert len(uniform_levels(1)) == 0


# By hand ---------------------------------------------------------------------------------------


def test_one_triangle():
    # Values 0, 1, 1 at (0, 0), (1, 0), (0, 1): below one half lies the corner, a quarter of it.
    sets = cut(([(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(0, 1, 2)]), [0, 1, 1], [0.5])
    assert sets.element_slab.tolist() == [0, 1]
    assert sets.element_area == pytest.approx([0.125, 0.375])
    assert sets.n_pieces == 2
    assert sets.n_contours == 1
    assert sets.contour_pieces.tolist() == [[0, 1]]
    assert sets.contour_length == pytest.approx([np.sqrt(0.5)])
    np.testing.assert_allclose(sets.contour_center, [(0.25, 0.25, 0)])
    assert sorted(sets.segment_points[0].tolist()) == [[0, 0.5, 0], [0.5, 0, 0]]
    assert sets.vertex_piece.tolist() == [0, 1, 1]


def test_three_levels_of_one_triangle():
    # Values 0, 1, 2 along a right triangle: the middle value divides it into two halves.
    sets = cut(([(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(0, 1, 2)]), [0, 1, 2], [0.5, 1.0, 1.5])
    # Below 0.5: (0.5 / 1) (0.5 / 2) = 1/8 of the area; below 1: 1/2; below 1.5: 7/8.
    assert sets.element_area == pytest.approx(np.array([1, 3, 3, 1]) / 16)
    assert sets.n_contours == 3


def test_square_in_strips():
    sets = cut(shapes.flat_grid(1, 1), [0, 0, 1, 1], [0.25, 0.5, 0.75])  # the value is x
    assert sets.n_pieces == 4
    assert sets.n_contours == 3
    assert sets.piece_area == pytest.approx([0.25] * 4)
    assert sets.contour_length == pytest.approx([1, 1, 1])
    order = sets.contour_level.argsort()
    np.testing.assert_allclose(sets.contour_center[order], [(0.25, 0.5, 0), (0.5, 0.5, 0), (0.75, 0.5, 0)])
    assert sets.piece_slab[sets.contour_pieces[order]].tolist() == [[0, 1], [1, 2], [2, 3]]
    assert sets.n_loops == 0


def test_octahedron_at_half_height():
    vertices, faces = shapes.octahedron()
    sets = cut((vertices, faces), vertices[:, 2], [-0.5, 0.5])
    assert sets.n_pieces == 3
    assert sets.n_contours == 2
    # Squares with diagonals of length 1; the tips are quarters of the triangles.
    assert sets.contour_length == pytest.approx([2 * np.sqrt(2)] * 2)
    side = np.sqrt(3) / 2
    area = sets.piece_area[np.argsort(sets.piece_slab)]
    assert area == pytest.approx([4 * side / 4, 8 * side - 2 * side, 4 * side / 4])
    np.testing.assert_allclose(np.sort(sets.contour_center, axis=0), [(0, 0, -0.5), (0, 0, 0.5)], atol=1e-12)
    np.testing.assert_allclose(sets.segment_length, np.sqrt(0.5))
    np.testing.assert_allclose(sets.contour_radius, np.sqrt(2) / 4)  # middles of the sides


def test_three_valleys_and_two_hills():
    # A strip of eight triangles: heights 0 1 0 1 0 along x.
    sets = cut(shapes.flat_grid(4, 1), np.repeat([0, 1, 0, 1, 0], 2), [0.5])
    assert np.bincount(sets.piece_slab).tolist() == [3, 2]
    assert sets.n_contours == 4
    assert sets.contour_length == pytest.approx([1] * 4)
    assert sorted(sets.piece_area) == pytest.approx([0.5, 0.5, 1, 1, 1])
    assert sets.vertex_piece[::2].tolist() == sets.vertex_piece[1::2].tolist()
    assert len(set(sets.vertex_piece.tolist())) == 5


def test_a_ring_of_eight_triangles_has_one_loop():
    # An annulus of four quads, value x: the level x = 0 crosses both arms.
    angle = np.pi / 2 * np.arange(4)
    ring = np.stack([np.cos(angle), np.sin(angle), 0 * angle], axis=1)
    this, following = np.arange(4), (np.arange(4) + 1) % 4
    faces = shapes.split_quads(np.stack([this, 4 + this, 4 + following, following], axis=1))
    vertices = np.concatenate([ring, 2 * ring])
    sets = cut((vertices, faces), vertices[:, 0], [-0.5, 0.0, 0.5])
    # Slab x < -0.5 is one piece, so is x > 0.5; the two between fall into two arms each.
    assert np.bincount(sets.piece_slab).tolist() == [1, 2, 2, 1]
    assert np.bincount(sets.contour_level).tolist() == [2, 2, 2]
    assert sets.n_loops == 1


def test_a_vertex_on_a_level_counts_as_above():
    sets = cut(shapes.flat_grid(1, 1), [0, 0, 1, 1], [0.0, 1.0])
    assert sets.vertex_slab.tolist() == [1, 1, 2, 2]
    assert sets.piece_slab[sets.vertex_piece].tolist() == [1, 1, 2, 2]
    # The upper slab has no width; it is there, so that the field's highest vertex has a piece.
    assert sets.piece_area[np.argsort(sets.piece_slab)] == pytest.approx([1, 0])


def test_no_levels_is_one_piece_for_each_component():
    sets = cut(shapes.two_spheres(), np.zeros(324), [])
    assert sets.n_pieces == 2
    assert sets.n_contours == 0
    assert sets.piece_area.sum() == pytest.approx(sets.mesh.area)


# Identities ------------------------------------------------------------------------------------


@pytest.fixture(params=list(SURFACES))
def sets(request):
    mesh = TriMesh(*SURFACES[request.param]())
    return cut_at_levels(mesh, slope_of(mesh, 0), uniform_levels(23))


def test_areas_sum_to_the_surface(sets):
    assert sets.piece_area.sum() == pytest.approx(sets.mesh.area)
    np.testing.assert_allclose(np.bincount(sets.element_face, sets.element_area, sets.mesh.n_faces),
                               sets.mesh.face_area, atol=1e-12 * sets.mesh.area)
    assert (sets.element_area >= 0).all()


def test_elements_are_the_faces_that_meet_each_slab(sets):
    np.testing.assert_array_equal(sets.element_slab, sets.piece_slab[sets.element_piece])
    low, high = (sets.values[sets.mesh.faces].min(axis=1), sets.values[sets.mesh.faces].max(axis=1))
    bounds = np.concatenate([[-np.inf], sets.levels, [np.inf]])
    assert (low[sets.element_face] < bounds[sets.element_slab + 1]).all()
    assert (high[sets.element_face] >= bounds[sets.element_slab]).all()


def test_pieces_are_what_a_flood_fill_finds(sets):
    elements = list(zip(sets.element_face.tolist(), sets.element_slab.tolist(), strict=True))
    slabs = sets.vertex_slab.tolist()
    around = {element: [] for element in elements}
    ends = sets.mesh.edges.vertices[sets.mesh.edges.pair_edge].tolist()
    for (f, g), (a, b) in zip(sets.mesh.edges.pairs.tolist(), ends, strict=True):
        for slab in range(min(slabs[a], slabs[b]), max(slabs[a], slabs[b]) + 1):
            around[f, slab].append((g, slab))
            around[g, slab].append((f, slab))
    piece = dict(zip(elements, sets.element_piece.tolist(), strict=True))
    seen, count = set(), 0
    for start in elements:
        if start in seen:
            continue
        count, todo = count + 1, [start]
        seen.add(start)
        while todo:
            here = todo.pop()
            assert piece[here] == piece[start]
            for other in around[here]:
                if other not in seen:
                    seen.add(other)
                    todo.append(other)
    assert count == sets.n_pieces


def test_each_contour_joins_one_piece_below_and_one_above(sets):
    np.testing.assert_array_equal(sets.piece_slab[sets.contour_pieces[:, 0]], sets.contour_level)
    np.testing.assert_array_equal(sets.piece_slab[sets.contour_pieces[:, 1]], sets.contour_level + 1)
    # All segments of a contour, not just one, lie between these two pieces.
    element = {(f, s): p for f, s, p in zip(sets.element_face.tolist(), sets.element_slab.tolist(),
                                            sets.element_piece.tolist(), strict=True)}
    for face, level, contour in zip(sets.segment_face.tolist(), sets.segment_level.tolist(),
                                    sets.segment_contour.tolist(), strict=True):
        assert [element[face, level], element[face, level + 1]] == sets.contour_pieces[contour].tolist()


def test_contours_are_closed_or_end_at_borders(sets):
    ends = sets.segment_edges + len(sets.mesh.edges.vertices) * sets.segment_level[:, None]
    edge, count = np.unique(ends, return_counts=True)
    np.testing.assert_array_equal(count, sets.mesh.edges.n_faces[edge % len(sets.mesh.edges.vertices)])


def test_segments_lie_on_their_level_and_in_their_face(sets):
    # The field is linear in space here, so the value at each point is known.
    value = sets.mesh.vertices[:, None, :] - sets.mesh.vertices[0]
    slope = np.linalg.lstsq(value[:, 0], sets.values - sets.values[0], rcond=None)[0]
    at = (sets.segment_points - sets.mesh.vertices[0]) @ slope + sets.values[0]
    np.testing.assert_allclose(at, np.repeat(sets.levels[sets.segment_level][:, None], 2, axis=1), atol=1e-9)
    corners = sets.mesh.faces[sets.segment_face]
    for k in (0, 1):
        ends = sets.mesh.edges.vertices[sets.segment_edges[:, k]]
        assert (corners[:, :, None] == ends[:, None, :]).any(axis=1).all()


def test_vertices_lie_in_a_piece_of_a_face_around_them(sets):
    np.testing.assert_array_equal(sets.piece_slab[sets.vertex_piece], sets.vertex_slab)
    corner_piece = sets.vertex_piece[sets.mesh.faces]
    for face in np.random.default_rng(0).choice(sets.mesh.n_faces, 20):
        own = sets.element_piece[sets.element_face == face]
        assert np.isin(corner_piece[face], own).all()


@pytest.mark.parametrize("genus", range(4))
@pytest.mark.parametrize("seed", range(2))
def test_loops_are_the_genus(genus, seed):
    # The rings lie along x, and the levels are close enough to see every one.
    mesh = TriMesh(*shapes.surface_of_genus(genus))
    values = mesh.vertices @ (1.0, 0.1 + 0.2 * seed, 0.03)
    levels = np.linspace(values.min(), values.max(), 81)[1:-1]
    assert cut_at_levels(mesh, values, levels).n_loops == genus


@pytest.mark.parametrize("seed", range(4))
def test_loops_never_exceed_the_genus(seed):
    rng = np.random.default_rng(seed)
    for genus in range(4):
        mesh = TriMesh(*shapes.surface_of_genus(genus, 0.2))
        sets = cut_at_levels(mesh, rng.random(mesh.n_vertices), uniform_levels(int(rng.integers(2, 30))))
        assert sets.n_loops <= genus
        assert components(sets.n_pieces, *sets.contour_pieces.T)[0] == 1


def test_a_level_through_every_value_finds_every_loop():
    # The exact Reeb graph: a random field on a surface of genus 3 has exactly three loops.
    mesh = TriMesh(*shapes.surface_of_genus(3, 0.25))
    values = np.random.default_rng(3).random(mesh.n_vertices)
    order = np.sort(values)
    assert cut_at_levels(mesh, values, (order[1:] + order[:-1]) / 2).n_loops == 3


def test_sphere_zones_have_the_area_archimedes_gave_them():
    vertices, faces = shapes.icosphere(4)
    levels = np.linspace(-1, 1, 11)[1:-1]
    sets = cut((vertices, faces), vertices[:, 2], levels)
    assert sets.n_pieces == 10
    np.testing.assert_allclose(sets.piece_area[np.argsort(sets.piece_slab)], 0.2 * 2 * np.pi, rtol=0.01)
    radius = np.sqrt(1 - levels**2)
    order = np.argsort(sets.contour_level)
    np.testing.assert_allclose(sets.contour_length[order], 2 * np.pi * radius, rtol=0.01)
    np.testing.assert_allclose(sets.contour_radius[order], radius, rtol=0.01)


def test_long_quads_are_cut_as_well_as_short_ones():
    # No vertex between the ends of a prism: every slab is one piece all the same.
    vertices, polygons = shapes.prism(8)
    shape = shapes.Shape(vertices, shapes.split_quads(np.array(polygons[:8])))
    sets = cut(shape, vertices[:, 2] / 6, uniform_levels(20))
    assert sets.n_pieces == 20
    assert sets.n_contours == 19
    sides = 8 * 2 * 0.5 * np.sin(np.pi / 8)
    np.testing.assert_allclose(sets.contour_length, sides)
    np.testing.assert_allclose(sets.piece_area, sides * 6 / 20)


@pytest.mark.parametrize("seed", range(3))
def test_permuted_shifted_and_scaled(seed):
    rng = np.random.default_rng(seed)
    shape = shapes.surface_of_genus(2, 0.2)
    other, vertex, _ = shapes.shuffled(shape, rng)
    mesh = TriMesh(*shape)
    values, levels = slope_of(mesh, seed), uniform_levels(17)
    one = cut_at_levels(mesh, values, levels)
    two = cut_at_levels(TriMesh(2.0 * other.vertices, other.faces), 8 * values[vertex] - 4, 8 * levels - 4)
    assert two.n_loops == one.n_loops
    np.testing.assert_allclose(np.sort(two.piece_area), 4 * np.sort(one.piece_area), atol=1e-9)
    np.testing.assert_allclose(np.sort(two.contour_length), 2 * np.sort(one.contour_length), atol=1e-9)
    assert same_partition(one.vertex_piece[vertex], two.vertex_piece)


def test_a_contour_around_an_apex_on_its_level_is_the_apex():
    """All of its segments have no length."""
    sets = cut(shapes.tetrahedron(), [0, 0, 0, 1], [0.5, 1.0])
    apex = np.flatnonzero(sets.contour_level == 1)
    assert sets.contour_length[apex].tolist() == [0.0]
    np.testing.assert_allclose(sets.contour_center[apex], [shapes.tetrahedron()[0][3]], atol=1e-12)
    assert sets.contour_radius[apex] == pytest.approx(0.0, abs=1e-12)

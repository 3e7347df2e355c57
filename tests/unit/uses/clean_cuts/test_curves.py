# SPDX-License-Identifier: GPL-3.0-or-later
"""The curves between parts as lines: all of the borders of the divided faces, and nothing else."""

from collections import Counter
from dataclasses import replace

import numpy as np
import pytest
import shapes

from core.mesh.corners import CornerTable
from core.uses.clean_cuts.curves import curves_of
from core.uses.clean_cuts.method import CleanCuts, clean_cuts


def no_cuts():
    return CleanCuts(*(np.empty(0, kind) for kind in (np.int64, float, np.int64, np.int64, np.int64, np.int64)))


def slices(table, count):
    """Slices between two poles, with ragged borders."""
    x, y, z = table.face_means(table.vertices).T
    return ((np.arctan2(y, x) + 0.3 + 0.4 * np.sin(4 * z)) % (2 * np.pi) * count / (2 * np.pi)).astype(np.int64) + 1


def divided(table, labels, cuts):
    """The outline of each piece, as points, and its part, face by face, by hand."""
    n = len(table.vertices)
    crossed, marks = set(cuts.edge.tolist()), {}
    for face, start, label in zip(cuts.face.tolist(), cuts.start.tolist(), cuts.label.tolist(), strict=True):
        marks.setdefault(face, []).append((start, label))
    for face in range(table.n_faces):
        outline = []
        for corner in np.flatnonzero(table.corner_face == face):
            outline.append(int(table.corner_vertex[corner]))
            if int(table.corner_edge[corner]) in crossed:
                outline.append(n + int(table.corner_edge[corner]))
        found = marks.get(face, [(outline[0], int(labels[face]))])
        middle = [("middle", face)] if len(found) == 3 else []
        for (start, label), (end, _) in zip(found, [*found[1:], found[0]], strict=True):
            first = outline.index(start)
            steps = (outline.index(end) - first) % len(outline)
            ring = [outline[(first + k) % len(outline)] for k in range(steps + 1 if steps else len(outline))]
            yield label, ring + middle


def borders(table, labels, cuts):
    """Sides of the pieces between two parts: (side, the two parts), by hand."""
    at = {}
    for label, ring in divided(table, labels, cuts):
        for a, b in zip(ring, [*ring[1:], ring[0]], strict=True):
            at.setdefault(frozenset((a, b)), set()).add(label)
    return Counter((side, pair) for side, parts in at.items()
                   for pair in zip(sorted(parts), sorted(parts)[1:], strict=False))


def found_borders(table, labels, cuts, curves):
    """What the curves say, in the same names."""
    names = {tuple(table.edges[edge].tolist()): len(table.vertices) + edge for edge in range(len(table.edges))}
    names |= {ends[::-1]: point for ends, point in names.items()}
    known = [a if a == b else names[a, b] for a, b in curves.ends.tolist()]
    faces = np.flatnonzero(np.bincount(cuts.face, minlength=1) == 3).tolist()
    known += [("middle", face) for face in faces]
    return Counter((frozenset((known[a], known[b])), tuple(pair))
                   for (a, b), pair in zip(curves.segments.tolist(), curves.pair.tolist(), strict=True))


def quads(n_ring=24, n_tube=10):
    """A torus of quadrilaterals."""
    around, across = np.meshgrid(np.arange(n_ring), np.arange(n_tube), indexing="ij")
    u, v = 2 * np.pi * around / n_ring, 2 * np.pi * across / n_tube
    radius = 1 + 0.4 * np.cos(v)
    points = np.stack([radius * np.cos(u), radius * np.sin(u), 0.4 * np.sin(v)], axis=-1).reshape(-1, 3)

    def at(i, j):
        return ((i % n_ring) * n_tube + j % n_tube).ravel()

    faces = np.stack([at(around, across), at(around + 1, across), at(around + 1, across + 1),
                      at(around, across + 1)], axis=1)
    return points, faces


SURFACES = {
    "closed": lambda: shapes.icosphere(3), "open": lambda: shapes.moved(shapes.flat_grid(14, 11), (-6.7, -5.2, 0)),
    "three faces at an edge": lambda: shapes.with_fin(shapes.icosphere(2)), "quadrilaterals": quads,
    "several pieces": lambda: shapes.together(shapes.icosphere(2), shapes.moved(shapes.icosphere(3), (3, 0, 0))),
}


@pytest.mark.parametrize("planar", [False, True])
@pytest.mark.parametrize("name", SURFACES)
def test_curves_are_the_sides_between_parts_of_the_divided_faces(name, planar):
    table = CornerTable.of(*SURFACES[name]())
    labels = slices(table, 4)
    cuts = clean_cuts(table, labels, planar=planar)
    curves = curves_of(table, labels, cuts)
    assert len(cuts.face)
    assert found_borders(table, labels, cuts, curves) == borders(table, labels, cuts)
    assert (curves.pair[:, 0] < curves.pair[:, 1]).all()
    middle = curves.points(table.vertices)[len(curves.ends):]
    assert len(middle) == (np.bincount(cuts.face) == 3).sum()


def test_parts_that_meet_in_three_meet_at_one_point_inside_a_face():
    table = CornerTable.of(*shapes.icosphere(4))
    labels = slices(table, 3)
    cuts = clean_cuts(table, labels)
    curves = curves_of(table, labels, cuts)
    count = np.bincount(curves.segments.ravel())
    inner = np.arange(len(count)) >= len(curves.ends)
    assert inner.any()
    assert (count[inner] == 3).all()
    assert (count[~inner] >= 2).all()  # closed: no curve ends


@pytest.mark.parametrize("name", SURFACES)
def test_without_cuts_they_are_the_edges_between_faces_of_different_parts(name):
    table = CornerTable.of(*SURFACES[name]())
    labels = slices(table, 4)
    curves = curves_of(table, labels, no_cuts())
    assert found_borders(table, labels, no_cuts(), curves) == borders(table, labels, no_cuts())
    chosen = [2, 3]
    low, high = table.edge_labels(np.isin(labels, chosen).astype(np.int64))
    wanted = {frozenset(ends) for ends in table.edges[low < high].tolist()}
    assert {frozenset(curves.ends[ends, 0].tolist()) for ends in curves.segments[curves.around(chosen)]} == wanted


def test_curves_go_along_with_the_vertices():
    """Their points are linear in the vertices: a map of these is a map of those."""
    table = CornerTable.of(*shapes.icosphere(3))
    labels = slices(table, 3)
    curves = curves_of(table, labels, clean_cuts(table, labels))
    bend = np.array([[1.0, 0.2, 0.0], [0.0, 2.0, 0.3], [0.1, 0.0, 0.5]])
    assert curves.points(table.vertices @ bend.T + 3) == pytest.approx(curves.points(table.vertices) @ bend.T + 3)


def test_without_borders_there_is_nothing():
    table = CornerTable.of(*shapes.octahedron())
    curves = curves_of(table, np.ones(8, np.int64), no_cuts())
    assert len(curves.segments) == len(curves.points(table.vertices)) == 0
    assert not curves.around([1]).any()


def test_numbers_of_32_bits_as_blender_has_them():
    """Of so many vertices that the number of a face times theirs does not fit into 32 bits."""
    vertices, faces = shapes.icosphere(3)
    table = CornerTable.of(vertices, faces)
    labels = slices(table, 4)
    many = 1_800_000
    far = CornerTable.of(np.concatenate([np.zeros((many, 3)), vertices]), faces + many)
    arrays = {name: getattr(far, name).astype(np.int32) for name in
              ("edges", "corner_vertex", "corner_edge", "corner_face")}
    far = replace(far, **arrays)
    one, other = (curves_of(each, labels, clean_cuts(each, labels)) for each in (table, far))
    assert np.array_equal(one.segments, other.segments)
    assert np.array_equal(one.pair, other.pair)
    assert np.array_equal(one.points(table.vertices), other.points(far.vertices))

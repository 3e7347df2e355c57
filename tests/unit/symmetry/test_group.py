# SPDX-License-Identifier: GPL-3.0-or-later
"""The group of symmetries of a shape, and parts that are alike under all of them."""

import numpy as np
import pytest
import shapes
from scipy.spatial import cKDTree

from core import decompose
from core.metrics import rand_index_error
from core.symmetry.group import SymmetryGroup


def rays(count):
    """The star's polygons cut so finely that its rays can be parts; and all its symmetries."""
    vertices, faces = shapes.prism_of_rays(count)
    quads = faces
    for _ in range(4):
        vertices, quads = quartered(vertices, quads)
    vertices = vertices[:, [1, 0, 2]] / (1, 1, 2)  # a ray along x
    turns = np.arange(count) * 2 * np.pi / count
    maps = [np.array([(np.cos(t), -np.sin(t) * side, 0), (np.sin(t), np.cos(t) * side, 0), (0, 0, flip)])
            for t in turns for side in (1, -1) for flip in (1, -1)]
    return vertices, quads, maps


def quartered(vertices, quads):
    """Each quad as four: its corners, the middles of its sides, and its own middle."""
    sides = np.sort(np.stack([quads, np.roll(quads, -1, axis=1)], axis=2), axis=2)
    known, place = np.unique(sides.reshape(-1, 2), axis=0, return_inverse=True)
    n, middle = len(vertices), place.reshape(-1, 4) + len(vertices)
    center = n + len(known) + np.arange(len(quads))
    vertices = np.concatenate([vertices, vertices[known].mean(axis=1), vertices[quads].mean(axis=1)])
    four = [np.stack([quads[:, k], middle[:, k], center, middle[:, k - 1]], axis=1) for k in range(4)]
    return vertices, np.concatenate(four)


def moved_faces(vertices, faces, linear):
    """The face at the place of each face's image."""
    centers = vertices[faces].mean(axis=1)
    distance, image = cKDTree(centers).query(centers @ linear.T)
    assert distance.max() < 1e-9
    return image


@pytest.mark.parametrize("count", [3, 5, 8])
def test_two_mirrors_make_the_group_of_a_star(count):
    vertices, faces, maps = rays(count)
    images = [moved_faces(vertices, faces, linear) for linear in maps]
    # Two planes next to each other, and front and back.
    group = SymmetryGroup.generated(np.array([images[2], images[6], images[1]]), 64)
    assert {image.tobytes() for image in group.image} == {image.tobytes() for image in images}
    assert (group.image[0] == np.arange(len(faces))).all()
    for u in range(len(maps)):
        for v in range(len(maps)):
            assert (group.image[group.composition[u, v]] == group.image[u][group.image[v]]).all()
        assert group.composition[u, group.inverse[u]] == group.composition[group.inverse[u], u] == 0


def test_what_the_first_planes_generate_comes_first():
    turn = 1j ** np.arange(4)  # a plus of four arms along the axes
    place = {complex(arm): k for k, arm in enumerate(turn)}
    across, along, slanted, other = (np.array([place[complex(arm)] for arm in arms], np.int64)
                                     for arms in (-turn.conj(), turn.conj(), 1j * turn.conj(), -1j * turn.conj()))
    group = SymmetryGroup.generated(np.array([across, along, slanted, other]), 64)
    assert group.image[:4].tolist() == [[0, 1, 2, 3], across.tolist(), along.tolist(), across[along].tolist()]
    assert len(group.image) == 8


def test_planes_across_each_other():
    vertices, faces, _ = rays(4)
    twins = np.array([moved_faces(vertices, faces, np.diag(signs)) for signs in ((-1, 1, 1), (1, -1, 1), (1, 1, -1))])
    planes, made = SymmetryGroup.of_planes(twins), SymmetryGroup.generated(twins, 64)
    assert {image.tobytes() for image in planes.image} == {image.tobytes() for image in made.image}
    for u in range(8):
        for v in range(8):
            assert (planes.image[planes.composition[u, v]] == planes.image[u][planes.image[v]]).all()


def test_what_has_no_image_has_none_of_that_either():
    """Faces 0 and 1 are images in one plane, 0 and 2 in the other."""
    group = SymmetryGroup.of_planes(np.array([[1, 0, -1], [2, -1, 0]]))
    assert group.image.tolist() == [[0, 1, 2], [1, 0, -1], [2, -1, 0], [-1, 2, -1]]
    assert group.first_onto(np.array([False, False, True])).tolist() == [2, 3, 0]


def test_too_large_a_group_is_none():
    vertices, faces, maps = rays(5)
    images = np.array([moved_faces(vertices, faces, linear) for linear in maps])
    assert SymmetryGroup.generated(images, 19) is None
    assert len(SymmetryGroup.generated(images, 20).image) == 20


def test_generated_sets_are_the_subgroups():
    vertices, faces, maps = rays(3)
    images = [moved_faces(vertices, faces, linear) for linear in maps]
    group = SymmetryGroup.generated(np.array([images[2], images[6]]), 64)
    every = np.arange(len(group.image))
    subgroups = group.generated_subgroups((np.arange(1 << len(every))[:, None] >> every & 1) == 1)
    assert sorted({int(row.sum()) for row in subgroups}) == [1, 2, 3, 6]  # of the triangle's six symmetries
    assert len(np.unique(subgroups, axis=0)) == 6


def test_cosets_of_a_subgroup_divide_the_group():
    vertices, faces, maps = rays(3)
    images = [moved_faces(vertices, faces, linear) for linear in maps]
    group = SymmetryGroup.generated(np.array([images[2], images[6]]), 64)
    order = len(group.elements)
    subgroups = np.unique(group.generated_subgroups(
        (np.arange(1 << order)[:, None] >> np.arange(order) & 1) == 1), axis=0)
    for subgroup, coset in zip(subgroups, group.cosets(subgroups), strict=True):
        assert (np.bincount(coset)[coset] == subgroup.sum()).all()
        for element in range(order):
            same = group.composition[np.flatnonzero(subgroup), element]  # the element, and then one of the subgroup
            assert coset[element] == same.min()
            assert (coset[same] == coset[element]).all()


@pytest.mark.parametrize("count", [3, 5, 7, 12])
def test_rays_of_a_star_are_cut_alike(count):
    vertices, faces, maps = rays(count)
    rng = np.random.default_rng(count)
    found = decompose(vertices @ shapes.rotation(rng).T + rng.normal(size=3), faces)
    images = np.array([moved_faces(vertices, faces, linear) for linear in maps])
    # Where a cut runs along a plane of symmetry, a face across it, its own image, goes to one of two images.
    beside = (images == np.arange(len(faces))).sum(axis=0) == 1
    assert beside.mean() > 0.9
    counts = {found.parts(float(detail)).count for detail in np.linspace(0.1, 1.0, 10)}
    assert max(counts) > 1
    for count in counts:
        labels = found.parts(n_parts=count).labels
        assert all(rand_index_error(labels[beside], labels[image[beside]]) == 0 for image in images)

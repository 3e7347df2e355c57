# SPDX-License-Identifier: GPL-3.0-or-later
"""The solids of joints: closed, of the volume worked out by hand, and with the same gap everywhere."""

import numpy as np
import pytest

from core.uses.joints.shapes import OUTLINES, REACH, Kind, solid, volume, volume_from

KINDS = list(Kind)


def triangles(made):
    return np.array([(face[0], face[i], face[i + 1]) for face in made.faces for i in range(1, len(face) - 1)])


def distance_to_surface(points, made):
    """How far points outside of a convex solid are from the planes of its faces: the largest of the heights."""
    heights = []
    for face in made.faces:
        a, b, c = made.points[list(face[:3])]
        normal = np.cross(b - a, c - b)
        heights.append((points - a) @ normal / np.linalg.norm(normal))
    return np.max(heights, axis=0)


@pytest.mark.parametrize("kind", KINDS)
def test_a_solid_is_closed_and_looks_outwards(kind):
    made = solid(kind, 2.0, -1.0, 5.0, 0.1)
    corners = triangles(made)
    edges = np.concatenate([corners[:, [0, 1]], corners[:, [1, 2]], corners[:, [2, 0]]])
    assert len(np.unique(edges, axis=0)) == len(edges)
    assert {tuple(edge) for edge in edges.tolist()} == {tuple(edge[::-1]) for edge in edges.tolist()}
    assert volume(made) > 0
    assert np.ptp(made.points[:, 2]) == pytest.approx(6.2)


def test_volumes_worked_out_by_hand():
    """A square peg 2 wide and 3 long: a box, and where its end is narrower a part of a pyramid."""
    narrow = 0.15
    base, top = 4.0, (2 - 2 * narrow) ** 2
    frustum = narrow / 3 * (base + top + np.sqrt(base * top))
    assert volume(solid(Kind.SQUARE, 1.0, 0.0, 3.0)) == pytest.approx(4 * (3 - narrow) + frustum, rel=1e-12)
    area = 48 * np.tan(np.pi / 48)  # of a polygon around a circle of radius 1
    assert volume(solid(Kind.MAGNET, 1.0, -1.0, 1.0)) == pytest.approx(2 * area, rel=1e-12)
    # The smaller holes are, the nearer to the volume of a joint of that size.
    assert volume(solid(Kind.MAGNET, 1.0, -1.0, 1.0, 0.5)) == pytest.approx(1.5**2 * area * 3, rel=1e-12)


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("scale", [1e-3, 1.0, 1e3])
def test_volumes_scale_and_parts_of_them_add_up(kind, scale):
    whole = volume(solid(kind, scale, -scale, 2 * scale, 0.1 * scale))
    assert whole == pytest.approx(scale**3 * volume(solid(kind, 1.0, -1.0, 2.0, 0.1)), rel=1e-9)
    upper = volume_from(kind, scale, 0.3 * scale, 2 * scale, 0.1 * scale)
    if kind.both_sides:
        assert upper + volume_from(kind, scale, -0.3 * scale, scale, 0.1 * scale) == pytest.approx(whole, rel=1e-9)
    else:
        area = upper - volume_from(kind, scale, 1.3 * scale, 2 * scale, 0.1 * scale)
        assert upper + 1.4 * area == pytest.approx(whole, rel=1e-9)


@pytest.mark.parametrize("kind", KINDS)
def test_the_gap_is_the_clearance_everywhere(kind):
    """Every face of the hole lies as far from the joint as asked, but for the end where the peg stands."""
    peg, hole = solid(kind, 1.0, -1.0, 3.0), solid(kind, 1.0, -1.0, 3.0, 0.2)
    for face, other in zip(peg.faces, hole.faces, strict=True):
        middle = hole.points[list(other)].mean(axis=0)
        a, b, c = peg.points[list(face[:3])]
        normal = np.cross(b - a, c - b)
        assert (middle - a) @ normal / np.linalg.norm(normal) == pytest.approx(0.2, rel=1e-6)
    assert distance_to_surface(hole.points, peg).min() >= 0.2 * (1 - 1e-9)


@pytest.mark.parametrize("kind", KINDS)
def test_the_reach_holds_the_outline(kind):
    assert np.linalg.norm(OUTLINES[kind], axis=1).max() == pytest.approx(REACH[kind])
    assert np.ptp(OUTLINES[kind][:, 0]) == pytest.approx(2.0, rel=0.01)


def test_a_key_fits_one_way_round_only():
    """Turned by half, a key of the same hole sticks out of it."""
    hole = solid(Kind.KEY, 1.0, 0.0, 3.0, 0.1)
    key = solid(Kind.KEY, 1.0, 0.0, 3.0).points
    assert distance_to_surface(key, hole).max() < 0
    for turned in (key * [-1, -1, 1], key[:, [1, 0, 2]] * [-1, 1, 1], key[:, [1, 0, 2]] * [1, -1, 1]):
        assert distance_to_surface(turned, hole).max() > 0.1

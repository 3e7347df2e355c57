# SPDX-License-Identifier: GPL-3.0-or-later
"""Rims of a wall that is cut across: one lies within the other."""

import numpy as np
import pytest

from core.uses.caps.rims import nested_rims


def rim(radius, bent, height=0.0, count=40):
    """A closed curve over a circle around the z axis, twice up and twice down on its way; (count, 3)."""
    angle = 2 * np.pi * np.arange(count) / count
    return np.stack([radius * np.cos(angle), radius * np.sin(angle), height + bent * np.cos(2 * angle)], axis=1)


def nested(outer, inner):
    """How many vertices the rims have that are found to lie within each other; the inner one goes round backwards."""
    first, second = np.arange(len(outer)), len(outer) + np.arange(len(inner))
    ends = np.stack([np.append(first, second), np.append(np.roll(first, -1), np.roll(second, 1))], axis=1)
    found = nested_rims(np.concatenate([outer, inner]), ends, np.tile([1, 2], (len(ends), 1)))
    return [[len(own) for own in ring] for ring in found]


@pytest.mark.parametrize("bent", [0.0, 0.2, 0.35])
def test_a_wall_has_two_rims_however_bent_its_cut_is(bent):
    """Where a leg meets the body both are bent alike; they were taken for rims of two holes, whose caps crossed."""
    assert nested(rim(1.0, bent), rim(0.9, bent, count=30)) == [[40, 30]]


def test_a_rim_far_above_or_beside_another_is_not_within_it():
    assert nested(rim(1.0, 0.35), rim(0.9, 0.35, height=0.5)) == []
    assert nested(rim(1.0, 0.0), rim(0.5, 0.0, height=0.5)) == []
    assert nested(rim(1.0, 0.0), rim(0.5, 0.0) + [2.0, 0.0, 0.0]) == []


def test_a_flat_rim_in_the_middle_of_a_bent_one_is_within_it():
    assert nested(rim(1.0, 0.35), rim(0.3, 0.0)) == [[40, 40]]

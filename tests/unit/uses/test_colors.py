# SPDX-License-Identifier: GPL-3.0-or-later
"""Colors differ where parts touch, and the first sixteen all do."""

import numpy as np
import pytest

from core.errors import ParameterError
from core.uses.colors import PALETTE, PALETTES, chosen_colors, distance_matrix, part_colors


def test_first_sixteen_are_distinct():
    colors = part_colors(16, np.empty((0, 2), int))
    assert colors.shape == (16, 3)
    assert len(np.unique(colors, axis=0)) == 16
    assert ((colors >= 0) & (colors <= 1)).all()


@pytest.mark.parametrize("name", PALETTES)
@pytest.mark.parametrize("seed", range(5))
@pytest.mark.parametrize("count", [2, 16, 17, 60, 300])
def test_neighbors_differ(count, seed, name):
    rng = np.random.default_rng(seed)
    pairs = np.sort(rng.integers(0, count, (3 * count, 2)), axis=1)
    pairs = np.unique(pairs[pairs[:, 0] != pairs[:, 1]], axis=0)
    chosen = chosen_colors(count, pairs, PALETTES[name])
    a, b = pairs.T
    assert (chosen[a] != chosen[b]).all()
    if count <= 16:
        assert len(np.unique(chosen)) == count


@pytest.mark.parametrize("n_rings", [1, 4])
def test_a_part_among_neighbors_of_all_colors_gets_one_of_its_own(n_rings):
    # The last part touches all others, of which each of a ring touches the next ones, but few of another ring.
    count = 16 * n_rings
    ring = np.array([(a, a + step) for a in range(count) for step in range(1, 4) if a // 16 == (a + step) // 16])
    pairs = np.concatenate([ring, np.stack([np.arange(count), np.full(count, count)], axis=1)])
    colors = part_colors(count + 1, pairs)
    assert (colors[pairs[:, 0]] != colors[pairs[:, 1]]).any(axis=1).all()
    # All but a few of those around keep theirs.
    assert (colors[:count] != part_colors(count, ring)).any(axis=1).sum() == n_rings


def test_no_part_has_the_color_of_one_that_touches_very_many():
    """A body with thousands of spines: its color was that used least, and in the end spines had it, too."""
    count = 2_000
    colors = part_colors(count, np.stack([np.zeros(count - 1, int), np.arange(1, count)], axis=1))
    assert (colors[1:] != colors[0]).any(axis=1).all()



@pytest.mark.parametrize("name", PALETTES)
def test_any_two_colors_of_a_palette_differ_visibly(name):
    """Colors of touching parts are never equal, see above: so they are this far apart."""
    lab = cielab(PALETTES[name])
    distance = np.linalg.norm(lab[:, None] - lab[None], axis=2)
    assert distance[np.triu_indices(len(lab), 1)].min() >= 25.0


def cielab(colors):
    """CIELAB of 1976 with the white point D65; colors: (c, 3), sRGB."""
    linear = np.where(colors <= 0.04045, colors / 12.92, ((colors + 0.055) / 1.055) ** 2.4)
    xyz = linear @ np.array([[0.4124564, 0.2126729, 0.0193339], [0.3575761, 0.7151522, 0.1191920],
                             [0.1804375, 0.0721750, 0.9503041]]) / [0.95047, 1.0, 1.08883]
    f = np.where(xyz > (6 / 29) ** 3, np.cbrt(xyz), xyz / (3 * (6 / 29) ** 2) + 4 / 29)
    return np.stack([116 * f[:, 1] - 16, 500 * (f[:, 0] - f[:, 1]), 200 * (f[:, 1] - f[:, 2])], axis=1)


def test_cielab_of_known_colors():
    known = {(1.0, 1.0, 1.0): (100, 0, 0), (0.0, 0.0, 0.0): (0, 0, 0), (1.0, 0.0, 0.0): (53.24, 80.09, 67.20)}
    np.testing.assert_allclose(cielab(np.array(list(known))), list(known.values()), atol=0.02)


def test_neighbors_are_told_apart_by_color_blind_people():
    # A star: the center against fifteen others, all in the distance of the palette itself.
    apart = distance_matrix()
    assert apart[~np.eye(len(PALETTE), dtype=bool)].min() > 0.02
    pairs = np.stack([np.zeros(3, int), np.arange(1, 4)], axis=1)
    colors = part_colors(4, pairs)
    assert distance_matrix(colors)[0, 1:].min() > 0.2


def test_the_first_colors_differ_most():
    apart = distance_matrix()
    nearest = [apart[index, :index].min() for index in range(1, len(PALETTE))]
    assert min(nearest[:10]) > 0.12  # eleven colors for most models
    for index in range(7, len(PALETTE)):
        assert nearest[index - 1] >= apart[index:, :index].min(axis=1).max() - 1e-12


def test_distance_is_a_symmetric_difference():
    apart = distance_matrix(np.array([(0, 0, 0), (1, 1, 1), (1, 0, 0), (1, 0, 0)], float))
    np.testing.assert_allclose(apart, apart.T)
    assert apart[2, 3] == 0
    assert apart[0, 1] == pytest.approx(np.sqrt(3), rel=0.01)  # the same for all three views
    # Red is darker without the cone for it: nearer to black than the 1 of normal vision.
    assert apart[0, 2] < 0.75


def test_same_answer_twice_and_more_parts_keep_the_colors_of_the_first():
    none = np.empty((0, 2), int)
    np.testing.assert_array_equal(part_colors(40, none), part_colors(40, none))
    np.testing.assert_array_equal(part_colors(40, none)[:20], part_colors(20, none))
    assert part_colors(0, none).shape == (0, 3)


@pytest.mark.parametrize(("count", "neighbors", "wrong"), [
    ("x", [], "count"), (2.5, [], "count"), (-1, [], "count"), (3, None, "neighbors"), (3, [(0, 3)], "neighbors"),
    (3, [(-1, 0)], "neighbors"), (3, [(0, 1, 2)], "neighbors")])
def test_what_are_no_parts_is_refused_by_name(count, neighbors, wrong):
    with pytest.raises(ParameterError) as caught:
        part_colors(count, neighbors)
    assert caught.value.name == wrong


def test_lists_and_small_numbers_are_taken():
    assert part_colors(np.int8(2), [(0, 1)]).tolist() == PALETTE[:2].tolist()
    assert part_colors(0, []).shape == (0, 3)

# SPDX-License-Identifier: GPL-3.0-or-later
"""BoostedTrees in whole arrays against trees walked by hand."""

from pathlib import Path

import numpy as np
import pytest

from core import ReebError
from core.cuts.boosted_trees import ROWS, BoostedTrees
from core.cuts.perceptual.features import FEATURES
from core.cuts.perceptual.method import cut_model


def two_trees() -> BoostedTrees:
    """x0 <= 1 ? (x1 <= 2 ? 0.1 : 0.2) : 0.4, and x1 <= 0 ? -1 : 1 with one node to spare."""
    return BoostedTrees(
        feature=np.array([[0, 1], [1, 0]]),
        threshold=np.array([[1, 2], [0, np.inf]], np.float32),
        mask=np.array([[0b100, 0b110], [0b10, 0xFFFF]], np.uint16) | np.uint16(0xFFF8),
        leaf=np.array([[0.1, 0.2, 0.4], [-1.0, 1.0, 0.0]]), names=("x", "y"))


def by_hand(x, y):
    total = ((0.1 if y <= 2 else 0.2) if x <= 1 else 0.4) + (-1.0 if y <= 0 else 1.0)
    return 1 / (1 + np.exp(-total))


def test_every_leaf_by_hand():
    rows = np.array([(x, y) for x in (0, 1, 1.5) for y in (-1, 0, 1, 2, 3)], float)
    np.testing.assert_allclose(two_trees().predict(rows), [by_hand(*r) for r in rows], rtol=1e-12)


@pytest.mark.parametrize("error", [1e-12, -1e-12])
def test_rounding_does_not_decide_at_a_threshold(error):
    rows = np.array([(x, y) for x in (0, 1, 2) for y in (0, 1, 2)], float)
    assert two_trees().predict(rows + error).tolist() == two_trees().predict(rows).tolist()


def test_answers_are_those_of_the_trainer():
    """Rows on and beside thresholds; tests/data/trees_by_trainer.py made the file."""
    path = Path(__file__).resolve().parents[2] / "data" / "trees_by_trainer.npz"
    with np.load(path, allow_pickle=False) as stored:
        rows, expected = stored["rows"], stored["expected"]
    model = BoostedTrees.read(path, tuple(f"Column_{i}" for i in range(rows.shape[1])))
    np.testing.assert_allclose(model.predict(rows), expected, rtol=1e-9)


def test_many_rows_are_each_row_alone():
    rows = np.random.default_rng(0).normal(size=(2 * ROWS + 3, len(FEATURES)))
    model = cut_model()
    together = model.predict(rows)
    assert together.tolist() == [model.predict(row[None])[0] for row in rows]
    # The least and the most that the leaves can add up to.
    least, most = (1 / (1 + np.exp(-end(model.leaf, axis=1).sum())) for end in (np.min, np.max))
    assert 0 < least < together.min() < together.max() < most < 1
    assert model.predict(rows[:0]).shape == (0,)


def test_reading_gives_back_what_was_written(tmp_path):
    two_trees().write(tmp_path / "trees.npz")
    again = BoostedTrees.read(tmp_path / "trees.npz", ("x", "y"))
    rows = np.random.default_rng(1).normal(size=(50, 2))
    np.testing.assert_allclose(again.predict(rows), two_trees().predict(rows), rtol=1e-6)


@pytest.mark.parametrize(("names", "first"), [
    (("x", "y", "z"), "z"), (("z", "x", "y"), "z"), (("x",), "y"), (("y",), "x"), (("x", "z"), "y"),
])
def test_a_model_of_other_features_is_refused(tmp_path, names, first):
    """What is missing or unknown is named, not what merely stands in another place for that."""
    two_trees().write(tmp_path / "trees.npz")
    with pytest.raises(ReebError, match=rf"trees.npz was trained on other features \(first: {first}\)"):
        BoostedTrees.read(tmp_path / "trees.npz", names)


def test_a_model_of_the_features_in_another_order_is_refused(tmp_path):
    two_trees().write(tmp_path / "trees.npz")
    with pytest.raises(ReebError, match=r"trees.npz was trained on the features in another order"):
        BoostedTrees.read(tmp_path / "trees.npz", ("y", "x"))


def test_shipped_coefficients_are_trees_on_these_features():
    model = cut_model()
    assert model.feature.max() < len(FEATURES)
    assert model.leaf.shape[1] <= 16
    # The leftmost leaf is possible until a node sends the row right; no node rules out all leaves.
    leaves = (1 << model.leaf.shape[1]) - 1
    assert ((model.mask & leaves) > 0).all()

# SPDX-License-Identifier: GPL-3.0-or-later
"""Makes trees_by_trainer.npz: a small model, rows on and beside its thresholds, the trainer's own answers.

    python3 tests/data/trees_by_trainer.py
"""

import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1] / "benchmarks"))

import packages  # noqa: E402

packages.need("numpy", "scipy", "lightgbm")

import lightgbm  # noqa: E402
import numpy as np  # noqa: E402
from train import SETTINGS, trees_of  # noqa: E402

rng = np.random.default_rng(0)
rows = rng.normal(size=(800, 6)).astype(np.float32)
share = 1 / (1 + np.exp(-(rows[:, 0] * rows[:, 1] + np.abs(rows[:, 2]) - 1)))
settings = SETTINGS | {"min_data_in_leaf": 5, "feature_fraction": 1.0}
booster = lightgbm.train(settings, lightgbm.Dataset(rows, share), 12)
trees = trees_of(booster)
asked = rows[:60].copy()
nodes = np.isfinite(trees.threshold)
column, edge = trees.feature[nodes][:40], trees.threshold[nodes][:40]
asked[np.arange(40), column] = edge  # exactly on a threshold
np.savez_compressed(HERE / "trees_by_trainer.npz", rows=asked, expected=booster.predict(asked),
                    feature=trees.feature, threshold=trees.threshold, mask=trees.mask, leaf=trees.leaf,
                    names=np.array(trees.names))

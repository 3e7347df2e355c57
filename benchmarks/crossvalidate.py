# SPDX-License-Identifier: GPL-3.0-or-later
"""How good are cuts on meshes, and on categories, that were not learned from?

    python3 benchmarks/crossvalidate.py MESHES --bodies FOLDER --kind half|category|groups --out LABELS

Decomposes every mesh with a model that has not seen it and writes its parts to LABELS/N.npy, one
number per face, for the benchmark's own measures; prints the Rand index error per category.

"half": two halves of every category, each learned without the other - everything, the states to
learn from included, comes from one half. "category" and "groups": one category, or each fifth of
the categories, is left out of learning. There the meshes to learn from were merged by models that
may have seen the category left out, which shapes the states they met but no answer.

Posed bodies (--bodies, see train.py) are learned from as well, but not where people are left out.
"""

from __future__ import annotations

import argparse
from pathlib import Path

import packages

packages.need("numpy", "scipy", "lightgbm")

import numpy as np
from people import Run, Subject, category_of
from train import (
    N_MODELS,
    ROUNDS_FURTHER,
    Further,
    add_variants,
    by_category,
    fit_many,
    folds_of,
    learn,
    learn_further,
    pieces,
    read_subjects,
)

from core.cuts.boosted_trees import BoostedTrees
from core.cuts.perceptual.method import SHARE_AT_HALF
from core.metrics import rand_index_error
from core.pipeline import decompose


def models_by_fold(subjects: dict[int, Subject], variants: dict[int, Subject], bodies: list[Further], kind: str,
                   rounds: int) -> dict[int, BoostedTrees]:
    """A model for each mesh, trained without the fold it is in."""
    fold = folds_of(list(subjects), kind)
    models = {}
    if kind == "half":
        for half in (0, 1):
            seen = {n: s for n, s in subjects.items() if fold[n] != half}
            fold_inside = folds_of(list(seen), kind)
            runs = learn(seen, fold_inside, rounds)
            add_variants(runs, {n: variants[n] for n in seen}, fold_inside)
            models[half] = fitted([r for of_mesh in runs.values() for r in of_mesh], bodies)
    else:
        groups = folds_of(list(subjects), "groups")
        runs = learn(subjects, groups, rounds)
        add_variants(runs, variants, groups)
        for left_out in sorted(set(fold.values())):
            seen = [r for n in subjects if fold[n] != left_out for r in runs[n]]
            unseen = {category_of(n) for n in subjects if fold[n] == left_out}
            models[left_out] = fitted(seen, [] if "Human" in unseen else bodies)
    return {n: models[fold[n]] for n in subjects}


def fitted(runs: list[Run], bodies: list[Further]) -> BoostedTrees:
    """A model of what ships' making, from some meshes of the benchmark and some bodies."""
    return fit_many(runs, N_MODELS, learn_further(runs, bodies, ROUNDS_FURTHER, SHARE_AT_HALF))


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("meshes", type=Path)
    parser.add_argument("--kind", choices=("half", "category", "groups"), default="half")
    parser.add_argument("--bodies", nargs="*", type=Path, default=[], metavar="FOLDER")
    parser.add_argument("--rounds", type=int, default=2)
    parser.add_argument("--out", type=Path, required=True)
    options = parser.parse_args()
    subjects = read_subjects(options.meshes)
    variants = read_subjects(options.meshes, changed=True)
    options.out.mkdir(parents=True, exist_ok=True)
    models = models_by_fold(subjects, variants, pieces(options.bodies), options.kind, options.rounds)
    errors, parts = {}, {}
    for number, model in models.items():
        with np.load(options.meshes / f"{number}.npz") as stored:
            vertices, faces, human = (stored[k] for k in ("vertices", "faces", "human"))
        labels = decompose(vertices, faces, model=model).parts().labels
        np.save(options.out / f"{number}.npy", labels)
        errors[number] = np.mean([rand_index_error(labels, person) for person in human])
        parts[number] = abs(np.log2((labels.max() + 1) / subjects[number].median_parts))
    for name, value in by_category(errors).items():
        print(f"{name:12} {value:.4f}")
    print(f"mean over categories {np.mean(list(by_category(errors).values())):.4f}; "
          f"mean absolute log2 of parts over people's median {np.mean(list(parts.values())):.3f}")


if __name__ == "__main__":
    main()

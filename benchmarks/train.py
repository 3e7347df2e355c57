# SPDX-License-Identifier: GPL-3.0-or-later
"""Learn from people which cuts to keep; writes cut_model.npz and sheet_model.npz.

    python3 benchmarks/train.py MESHES --bodies FOLDER [--solids] [--labelled FOLDER...]
                                [--out core/cuts/perceptual] [--rounds 2]

MESHES holds N.npz with ``vertices`` (n, 3), ``faces`` (m, 3) and ``human`` (people, m): the layout
in which princeton.py writes the Princeton Segmentation Benchmark. Cuts are learned without
their category or any other knowledge of what the mesh shows. The model of sheets is learned from
the same meshes, which are closed, and from figures made at random, see known_sheets.py.

The model of closed surfaces learns from more: from the large pieces of models whose parts are known
otherwise, such as by the bones that move them: PACK.NAME.npz of the same layout, with a coarse
labelling first. The labels of --bodies, which posed_bodies.py makes and which what ships was learned
from, say which small things belong together; those of --labelled say nothing of ears and others
without a bone. And from bodies made at random (--solids, see known_solids.py).

The model first sees the states that merging with people's help goes through, then, round by round,
those that its own merging reaches on meshes it was not trained on: a model that never met its own
mistakes does not know how to go on from them.
"""

from __future__ import annotations

import argparse
import time
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import packages

packages.need("numpy", "scipy", "lightgbm", "fast_simplification")

import lightgbm
import numpy as np
from known_sheets import known_sheets
from known_solids import known_solids
from people import Run, Subject, category_of, merge_and_record, mesh_numbers, prepare, varied

from core.arrays.indexing import renumbered
from core.cuts.boosted_trees import BoostedTrees
from core.cuts.perceptual.features import FEATURES
from core.cuts.perceptual.method import SHARE_AT_HALF, SHEET_SHARE_AT_HALF
from core.mesh.triangles import TriMesh

N_TREES = 250
SETTINGS = {
    "objective": "cross_entropy", "learning_rate": 0.06, "num_leaves": 16, "min_data_in_leaf": 100,
    "feature_fraction": 0.3, "bagging_fraction": 0.4, "bagging_freq": 1, "max_bin": 63,
    "lambda_l2": 5.0, "verbose": -1, "num_threads": 1, "deterministic": True, "force_row_wise": True,
    "seed": 1,
}
POWER = 0.75  # a row counts by the pairs of faces it concerns, to this power; every run counts alike
N_FOLDS = 5
# How much sheets and solids made at random, and pieces of labelled models, count beside a mesh of the benchmark.
KNOWN_WEIGHT, PIECE_WEIGHT = 0.25, 0.06
LEAST_PIECE = 0.1  # share of the area of its model from which on a piece is learned from
MAX_OF_PACK = 16  # so many pieces of one pack's models, which are alike: the largest
COARSE = 1  # so many labellings of a model, the first, are coarser than what people make of the benchmark's meshes
DETAIL = 0.03  # share of the area of a piece below which labels of models say nothing of what they leave together
ROUNDS_FURTHER = 1  # of its own merging on solids and pieces
N_MODELS = 3  # in what ships; their mean is steadier than each
# First of their seeds, of closed surfaces and of sheets. With others more of the plain shapes that tests know get a
# part too many or too few, see docs/experiments.md.
SEED, SHEET_SEED = 100, 200


#: A run, and how much it counts beside one on a mesh of the benchmark.
Counted = tuple[Run, float]


def fit(runs: list[Run], seed: int = 1, n_trees: int = N_TREES, more: Sequence[Counted] = ()) -> BoostedTrees:
    """Boosted trees from the states met on some meshes.

    Parameters
    ----------
    runs : list of Run
    seed : int
    n_trees : int
    more : sequence of Counted
        States met on other surfaces.

    Returns
    -------
    trees : BoostedTrees
    """
    counts = [1.0] * len(runs) + [count for _, count in more]
    runs = [*runs, *(run for run, _ in more)]
    weight = [count * r.weight**POWER / (r.weight**POWER).sum() for count, r in zip(counts, runs, strict=True)]
    rows, share = (np.concatenate([getattr(r, name) for r in runs]) for name in ("rows", "share"))
    weight = np.concatenate(weight)
    weight *= len(weight) / weight.sum()
    kept = weight > 0.2  # the others are half of the rows and four per cent of the weight
    data = lightgbm.Dataset(rows[kept], np.clip(share[kept], 0, 1), weight=weight[kept],
                            feature_name=list(FEATURES))
    return trees_of(lightgbm.train(SETTINGS | {"seed": seed}, data, n_trees))


def fit_many(runs: list[Run], count: int, more: Sequence[Counted] = (), seed: int = SEED) -> BoostedTrees:
    """The mean of several models that differ by their random choices: by seeds from a given one on."""
    return mean_of([fit(runs, seed=seed + i, more=more) for i in range(count)])


def mean_of(models: list[BoostedTrees]) -> BoostedTrees:
    """The trees of several models over the same features, whose sum is the mean of theirs."""
    feature, threshold, mask, leaf = (np.concatenate([getattr(m, name) for m in models])
                                      for name in ("feature", "threshold", "mask", "leaf"))
    return BoostedTrees(feature, threshold, mask, leaf / len(models), models[0].names)


def trees_of(booster) -> BoostedTrees:
    """The arrays of a trained model."""
    infos = booster.dump_model()["tree_info"]
    n_leaves = max(t["num_leaves"] for t in infos)
    shape = (len(infos), n_leaves - 1)
    trees = BoostedTrees(
        np.zeros(shape, np.int64), np.full(shape, np.inf, np.float32), np.full(shape, 0xFFFF, np.uint16),
        np.zeros((len(infos), n_leaves)), tuple(booster.feature_name()))
    for tree, info in enumerate(infos):
        _add_nodes(trees, tree, info["tree_structure"], 0, 0)
    return trees


def _add_nodes(trees: BoostedTrees, tree: int, node: dict, leaf: int, inner: int) -> tuple[int, int]:
    """Write a node and what is below it; the next free leaf and inner node."""
    if "split_feature" not in node:
        trees.leaf[tree, leaf] = node["leaf_value"]
        return leaf + 1, inner
    trees.feature[tree, inner] = node["split_feature"]
    # Rounded down: rows are rounded to 32 bits as well, and "at or below" must stay so.
    threshold = np.float32(node["threshold"])
    if threshold > node["threshold"]:
        threshold = np.nextafter(threshold, np.float32(-np.inf))
    trees.threshold[tree, inner] = threshold
    middle, free = _add_nodes(trees, tree, node["left_child"], leaf, inner + 1)
    ruled_out = (1 << middle) - (1 << leaf)
    trees.mask[tree, inner] = 0xFFFF & ~ruled_out
    return _add_nodes(trees, tree, node["right_child"], middle, free)


def fit_folds(runs: dict[int, list[Run]], fold: dict[int, int], seed: int) -> dict[int, BoostedTrees]:
    """A model for each fold, from the meshes of all others."""
    return {left_out: fit([r for n in runs if fold[n] != left_out for r in runs[n]], seed)
            for left_out in sorted(set(fold.values()))}


def learn(subjects: dict[int, Subject], fold: dict[int, int], rounds: int,
          tell=print) -> dict[int, list[Run]]:
    """States for training, met by models that did not know the mesh.

    Parameters
    ----------
    subjects : dict of Subject by mesh number
    fold : dict of int by mesh number
        Meshes of one fold are not trained on together.
    rounds : int
    tell : callable

    Returns
    -------
    runs : dict of lists of Run by mesh number
        By people's help, then one of each round.
    """
    runs = {n: [merge_and_record(s)] for n, s in subjects.items()}
    for number in range(rounds):
        start = time.perf_counter()
        models = fit_folds(runs, fold, seed=number + 1)
        for n, subject in subjects.items():
            runs[n].append(merge_and_record(subject, models[fold[n]].predict))
        last = {n: r[-1] for n, r in runs.items()}
        tell(f"round {number}: {summary(last, subjects)}, {time.perf_counter() - start:.0f} s")
    return runs


def add_variants(runs: dict[int, list[Run]], variants: dict[int, Subject], fold: dict[int, int]):
    """Add the states of changed copies of the meshes, by people's help and by models."""
    models = fit_folds(runs, fold, seed=50)
    for n, variant in variants.items():
        runs[n] += [merge_and_record(variant), merge_and_record(variant, models[fold[n]].predict)]


@dataclass(frozen=True, eq=False)
class Further:
    """A surface to learn from beside the meshes of the benchmark.

    Attributes
    ----------
    subject : Subject
    count : float
        How much it counts beside a mesh of the benchmark.
    half : int
        0 or 1; surfaces of one half are never judged by a model that has learned from that half.
    detail : float
        Share of the area below which its labels say nothing of what they leave together: an ear has no bone.
    """

    subject: Subject
    count: float
    half: int
    detail: float = 0.0

    def met(self, model=None) -> Run:
        """The states that merging it goes through, without those that its labels say nothing of."""
        run = merge_and_record(self.subject, model)
        is_detail = run.rows[:, FEATURES.index("small_log_area")] < np.log(max(self.detail, 1e-9))
        known = (run.share >= 0.5) | ~is_detail
        return replace(run, rows=run.rows[known], share=run.share[known], weight=run.weight[known])


def sheets() -> list[Further]:
    """Sheets made at random."""
    made = [prepare(*mesh) for mesh in known_sheets().values()]
    return [Further(subject, KNOWN_WEIGHT, place % 2)
            for place, subject in enumerate(s for s in made if s.label.any())]  # one patch leaves nothing to judge


def solids() -> list[Further]:
    """Bodies made at random."""
    return [Further(prepare(*mesh), KNOWN_WEIGHT, place % 2) for place, mesh in enumerate(known_solids().values())]


def pieces(folders: list[Path], detail: float = 0.0) -> list[Further]:
    """The large pieces of labelled models, at most MAX_OF_PACK of a pack: the largest. detail : see ``Further``."""
    packs: dict[str, list] = {}
    for path in sorted((path for folder in folders for path in folder.glob("*.npz")), key=lambda path: path.name):
        with np.load(path) as stored:
            vertices, faces, human = (stored[k] for k in ("vertices", "faces", "human"))
        human = human[COARSE:]
        mesh = TriMesh(vertices.astype(float), faces.astype(np.int64))
        found = packs.setdefault(path.stem.split(".")[0], [])
        for piece in range(mesh.face_components[0]):
            inside = mesh.face_components[1] == piece
            share, labels = mesh.face_area[inside].sum() / mesh.area, human[:, inside]
            if share >= LEAST_PIECE and (labels != labels[:, :1]).any():
                used, own = np.unique(mesh.faces[inside], return_inverse=True)
                labels = np.stack([renumbered(person)[1] for person in labels])
                found.append((share, mesh.vertices[used], own.reshape(-1, 3), labels))
    return [Further(prepare(*piece), PIECE_WEIGHT, place % 2, detail) for place, found in enumerate(packs.values())
            for _, *piece in sorted(found, key=lambda piece: -piece[0])[:MAX_OF_PACK]]


def learn_further(people: list[Run], further: list[Further], rounds: int, decision: float, tell=print) -> list[Counted]:
    """States that further surfaces go through: with their labels' help, then met by models that did not know them.

    Parameters
    ----------
    people : list of Run
        Of the benchmark's meshes, which all models learn from as well.
    further : list of Further
    rounds : int
    decision : float
        Share of people at which the error is told.
    tell : callable

    Returns
    -------
    runs : list of Counted
        Of each surface by people's help, then one of each round.
    """
    if not further:
        return []
    runs = [[one.met()] for one in further]
    for number in range(rounds):
        models = [fit(people, seed=60 + number, more=[
            (run, one.count) for one, of_one in zip(further, runs, strict=True) if one.half != left_out
            for run in of_one]) for left_out in (0, 1)]
        for one, of_one in zip(further, runs, strict=True):
            of_one.append(one.met(models[one.half].predict))
        error = np.mean([of_one[-1].error_at(decision) for of_one in runs])
        tell(f"round {number} of {len(further)} further surfaces: error {error:.4f}")
    return [(run, one.count) for one, of_one in zip(further, runs, strict=True) for run in of_one]


DECISIONS = (0.4, 0.45, 0.5, 0.55, 0.6)


def summary(runs: dict[int, Run], subjects: dict[int, Subject]) -> str:
    """Mean over categories of the error at several decisions, and of the number of parts."""
    errors = [over_categories({n: r.error_at(d) for n, r in runs.items()}) for d in DECISIONS]
    best = over_categories({n: r.error.min() for n, r in runs.items()})
    parts = np.mean([abs(np.log2(r.n_parts(0.5) / subjects[n].median_parts)) for n, r in runs.items()])
    text = " ".join(f"{e:.4f}" for e in errors)
    return f"error at {DECISIONS[0]}-{DECISIONS[-1]}: {text}, best stop {best:.4f}, parts {parts:.2f}"


def over_categories(values: dict[int, float]) -> float:
    """Mean over the categories of their means."""
    return float(np.mean(list(by_category(values).values())))


def by_category(values: dict[int, float]) -> dict[str, float]:
    """Mean of each category."""
    groups: dict[str, list[float]] = {}
    for number, value in values.items():
        groups.setdefault(category_of(number), []).append(value)
    return {name: float(np.mean(group)) for name, group in groups.items()}


def folds_of(numbers: list[int], kind: str) -> dict[int, int]:
    """Fold of each mesh: "half" of each category, one "category" each, or "groups" of categories."""
    categories = [category_of(n) for n in numbers]
    names = list(dict.fromkeys(categories))
    if kind == "half":
        return {n: categories[:i].count(categories[i]) % 2 for i, n in enumerate(numbers)}
    place = {n: names.index(c) for n, c in zip(numbers, categories, strict=True)}
    return place if kind == "category" else {n: p % N_FOLDS for n, p in place.items()}


def read_subjects(folder: Path, changed: bool = False, tell=print) -> dict[int, Subject]:
    """Measure every mesh of the benchmark, as it is or changed by ``varied``."""
    subjects, start = {}, time.perf_counter()
    for number in mesh_numbers(folder):
        with np.load(folder / f"{number}.npz") as stored:
            vertices, faces, human = (stored[k] for k in ("vertices", "faces", "human"))
        if changed:
            vertices = varied(vertices.astype(float), faces, np.random.default_rng(number))
        subjects[number] = prepare(vertices, faces, human)
    count = np.mean([s.label.max() + 1 for s in subjects.values()])
    tell(f"{len(subjects)} meshes of {len({category_of(n) for n in subjects})} categories, "
         f"{count:.0f} candidates each, {time.perf_counter() - start:.0f} s")
    return subjects


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("meshes", type=Path)
    parser.add_argument("--solids", action="store_true")
    parser.add_argument("--labelled", nargs="*", type=Path, default=[], metavar="FOLDER")
    parser.add_argument("--bodies", nargs="*", type=Path, default=[], metavar="FOLDER")
    parser.add_argument("--out", type=Path, default=packages.ROOT / "core" / "cuts" / "perceptual")
    parser.add_argument("--rounds", type=int, default=2)
    options = parser.parse_args()
    subjects = read_subjects(options.meshes)
    variants = read_subjects(options.meshes, changed=True)
    fold = folds_of(list(subjects), "groups")
    runs = learn(subjects, fold, options.rounds)
    add_variants(runs, variants, fold)
    people = [r for of_mesh in runs.values() for r in of_mesh]
    further = [*(solids() if options.solids else []), *pieces(options.labelled, DETAIL), *pieces(options.bodies)]
    for name, beside, rounds, decision, seed in (
            ("cut_model", further, ROUNDS_FURTHER, SHARE_AT_HALF, SEED),
            ("sheet_model", sheets(), options.rounds, SHEET_SHARE_AT_HALF, SHEET_SEED)):
        model = fit_many(people, N_MODELS, learn_further(people, beside, rounds, decision), seed)
        model.write(options.out / f"{name}.npz")
        print(f"{name}.npz: {len(model.leaf)} trees on {len(FEATURES)} features")


if __name__ == "__main__":
    main()

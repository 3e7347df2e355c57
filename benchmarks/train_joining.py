# SPDX-License-Identifier: GPL-3.0-or-later
"""Learn which parts of several pieces belong together; writes join_model.npz and distant_model.npz.

    python3 benchmarks/train_joining.py FOLDER... [--hints FOLDER...] [--apart FOLDER...] [--out FOLDER] [--folds N]

Folders hold NAME.npz with ``vertices`` (n, 3), ``faces`` (m, 3) and labels of the faces: ``human`` (k, m), or in
``--hints`` an artist's ``material`` (m,), which counts a tenth to a quarter, and only for parts of different pieces.
The meshes of ``--apart`` are closed surfaces: each is taken apart along one person's cuts, and the pieces are moved a
little, so that they run into each other as the pieces of an artist do.

The first model judges parts that come near each other. What it says of meshes that it has not learned from is what the
second sees, beside all pairs of the largest parts: packs are left out in turn for that (a pack is what a name begins
with, up to the first dot; a category of the benchmark is one, too).

What ships was learned from rigged models, from what robots.py, game_models.py and aircraft.py make (FOLDER...), from
models with materials (--hints) and from half of the benchmark (--apart).

--folds leaves packs out in turn and prints the Rand index error on the packs left out, instead of writing models.
"""

from __future__ import annotations

import argparse
from dataclasses import dataclass
from pathlib import Path

import packages

packages.need("numpy", "scipy", "lightgbm", "tqdm", "joblib")

import joblib
import lightgbm
import numpy as np
from people import category_of, working_mesh
from tqdm import tqdm
from train import mean_of, trees_of

from core.arrays.components import components
from core.arrays.indexing import renumbered
from core.cuts.boosted_trees import BoostedTrees
from core.cuts.joining.distant import FEATURES as DISTANT_FEATURES
from core.cuts.joining.distant import DistantPairs
from core.cuts.joining.method import FineParts, JoinModel, compare_distant, fine_parts, join_parts, near_odds
from core.cuts.joining.pairs import FEATURES
from core.mesh.labels import majority
from core.mesh.triangles import TriMesh
from core.metrics import rand_index_error
from core.parameters import Parameters
from core.pipeline import decompose_component
from core.progress import Stopwatch
from core.surface.preparation import bodies

SETTINGS = {
    "objective": "cross_entropy", "learning_rate": 0.05, "num_leaves": 16, "min_data_in_leaf": 20,
    "feature_fraction": 0.4, "bagging_fraction": 0.7, "bagging_freq": 1, "max_bin": 63, "lambda_l2": 5.0,
    "verbose": -1, "num_threads": 1, "deterministic": True, "force_row_wise": True,
}
DISTANT_SETTINGS = SETTINGS | {
    "learning_rate": 0.08, "min_data_in_leaf": 60, "feature_fraction": 0.5}
N_TREES, N_MODELS, N_FOLDS = 200, 3, 5
#: What a mesh counts, by what its labels are: for pairs near each other, and for all pairs.
KINDS = {"human": 1.0, "hints": 0.1, "apart": 1.0}
DISTANT_KINDS = KINDS | {"hints": 0.25}
SHIFT = 0.003  # of the diagonal: how far the pieces of a mesh that is taken apart are moved
MAX_PAIRS = 60  # pairs of a mesh, or parts, count as the square root of their number up to this
SAMPLE = 600  # of all pairs of a body so many are learned from


@dataclass(frozen=True, eq=False)
class Body:
    """The fine parts of one body, and how people label its faces.

    Attributes
    ----------
    parts : FineParts
    face_candidate, polygon : (m,) int64
        Candidate of each face of the body's mesh, and the face of the mesh given that it lies in.
    face_area : (m,) float64
    n_pieces : int
    shares : list of (c, people's parts) float64
        Of each part, the share of its area with each label of each person.
    """

    parts: FineParts
    face_candidate: np.ndarray
    polygon: np.ndarray
    face_area: np.ndarray
    n_pieces: int
    shares: list[np.ndarray]

    def together(self, pairs: np.ndarray) -> np.ndarray:
        """Share of people who put two points of the two parts of each pair, (e, 2), into one part."""
        first, second = pairs.T
        return np.clip(np.mean([(share[first] * share[second]).sum(axis=1) for share in self.shares], axis=0), 0, 1)


@dataclass(frozen=True, eq=False)
class Subject:
    """One mesh with labels. kind : "human", "hints" or "apart"."""

    name: str
    bodies: list[Body]
    human: np.ndarray
    kind: str

    @property
    def pack(self) -> str:
        """What the name begins with: models of one pack share pieces. Of a mesh of the benchmark, its category."""
        return category_of(int(self.name)) if self.name.isdigit() else self.name.split(".")[0]

    @property
    def of_several(self) -> list[Body]:
        """Bodies in which there is something to join."""
        return [body for body in self.bodies if body.n_pieces > 1 and len(body.parts.candidate) > 1]


def taken_apart(vertices: np.ndarray, faces: np.ndarray, human: np.ndarray, seed: int):
    """The vertices and faces of a mesh in pieces, cut along one person's cuts and moved a little."""
    rng = np.random.default_rng(seed)
    mesh, label = TriMesh(vertices, faces), human[rng.integers(len(human))]
    pairs = mesh.edges.pairs
    count, piece = components(mesh.n_faces, *pairs[label[pairs[:, 0]] == label[pairs[:, 1]]].T)
    corners, place = np.unique(np.stack([np.repeat(piece, 3), faces.ravel()], axis=1), axis=0, return_inverse=True)
    move = rng.normal(size=(count, 3))
    move *= SHIFT * np.linalg.norm(np.ptp(vertices, axis=0)) / np.linalg.norm(move, axis=1, keepdims=True)
    return vertices[corners[:, 1]] + move[corners[:, 0]], place.reshape(-1, 3)


def prepare(name: str, vertices: np.ndarray, faces: np.ndarray, human: np.ndarray, kind: str) -> Subject:
    """Everything that does not depend on the models of joining."""
    parameters, found = Parameters(), []
    working, owner = working_mesh(vertices, faces)
    for component in bodies(working, True, parameters.loose_part).decomposed:
        result = decompose_component(component, parameters, Stopwatch(None))
        parts = fine_parts(component.mesh, result.face_candidate, result.candidates.hierarchy, result.field.normalized)
        shares, polygon = [], owner[component.polygon]
        for person in human:
            table = np.zeros((len(parts.candidate), person.max() + 1))
            np.add.at(table, (parts.part, person[polygon]), component.mesh.face_area + 1e-300)
            shares.append(table / table.sum(axis=1, keepdims=True))
        found.append(Body(parts, result.face_candidate, polygon, component.mesh.face_area,
                          component.mesh.face_components[0], shares))
    return Subject(name, found, human, kind)


def read(path: Path, kind: str, seed: int) -> Subject:
    """One mesh of a folder. seed : of how it is taken apart, if it is."""
    with np.load(path) as stored:
        vertices, faces = stored["vertices"].astype(float), stored["faces"].astype(np.int64)
        human = stored["material"][None] if kind == "hints" else stored["human"]
    human = np.stack([renumbered(person)[1] for person in human])
    if kind == "apart":
        vertices, faces = taken_apart(vertices, faces, human, seed)
    return prepare(path.stem, vertices, faces, human, kind)


# Learning -----------------------------------------------------------------------------------------


def fit(rows: list[tuple[np.ndarray, np.ndarray, np.ndarray]], settings: dict, names: tuple[str, ...], n_trees: int,
        n_models: int) -> BoostedTrees:
    """The mean of several models that differ by their random choices.

    rows : features (e, f), what is to be foretold (e,), and weight (e,), of each body.
    """
    data = [np.concatenate(column) for column in zip(*rows, strict=True)]
    return mean_of([trees_of(lightgbm.train(settings | {"seed": seed}, lightgbm.Dataset(
        data[0], data[1], weight=data[2], feature_name=list(names)), n_trees)) for seed in range(n_models)])


def fit_near(subjects: list[Subject]) -> BoostedTrees:
    """What judges pairs of parts that come near each other."""
    rows = []
    for subject in subjects:
        for body in subject.of_several:
            pairs = body.parts.pairs
            chosen = _asked(subject, pairs.same_piece)
            if chosen.any():
                weight = np.sqrt(pairs.shapes.area[pairs.parts].min(axis=1))[chosen]
                weight *= KINDS[subject.kind] * np.sqrt(min(len(weight), MAX_PAIRS)) / weight.sum()
                rows.append((pairs.features[chosen], body.together(pairs.parts)[chosen], weight))
    return fit(rows, SETTINGS, FEATURES, N_TREES, N_MODELS)


def fit_distant(subjects: list[Subject], distant: dict[int, list[DistantPairs]]) -> BoostedTrees:
    """What judges all pairs of the largest parts.

    distant : of each subject, by id(), the pairs of its bodies, measured with what a model says of near pairs that did
    not learn from the subject.
    """
    rows, rng = [], np.random.default_rng(0)
    for subject in subjects:
        for body, pairs in zip(subject.of_several, distant[id(subject)], strict=True):
            area, piece = body.parts.pairs.shapes.area, body.parts.pairs.shapes.piece
            chosen = np.flatnonzero(_asked(subject, piece[pairs.parts[:, 0]] == piece[pairs.parts[:, 1]]))
            if len(chosen):
                chosen = rng.permutation(chosen)[:SAMPLE]
                weight = np.sqrt(area[pairs.parts[chosen]].min(axis=1))
                weight *= 1000 * DISTANT_KINDS[subject.kind] * np.sqrt(min(len(area), MAX_PAIRS)) / weight.sum()
                rows.append((pairs.features[chosen], body.together(pairs.parts[chosen]), weight))
    return fit(rows, DISTANT_SETTINGS, DISTANT_FEATURES, N_TREES, N_MODELS)


def _asked(subject: Subject, same_piece: np.ndarray) -> np.ndarray:
    """Which pairs of a subject are learned from, (e,) bool."""
    return ~same_piece if subject.kind == "hints" else np.ones(len(same_piece), bool)


def learn(
    subjects: list[Subject], n_folds: int = N_FOLDS
) -> tuple[dict[int, BoostedTrees], dict[int, list[DistantPairs]]]:
    """Models of near pairs that have not learned from a fold of the packs, by fold, and all pairs seen with them."""
    near, distant = {}, {}
    fold = folds_of(subjects, n_folds)
    for left_out in tqdm(range(n_folds), desc="near pairs"):
        near[left_out] = fit_near([s for s in subjects if fold[s.pack] != left_out])
    for subject in tqdm(subjects, desc="all pairs"):
        model = near[fold[subject.pack]]
        distant[id(subject)] = [compare_distant(body.parts, near_odds(body.parts, model))
                                for body in subject.of_several]
    return near, distant


def folds_of(subjects: list[Subject], n_folds: int) -> dict[str, int]:
    """Fold of each pack."""
    return {pack: number % n_folds for number, pack in enumerate(sorted({subject.pack for subject in subjects}))}


# Judging ------------------------------------------------------------------------------------------


def error(subject: Subject, model: JoinModel) -> tuple[float, int]:
    """Rand index error of the parts of detail 0.5, mean over people, and how many parts there are."""
    labels, first = np.full(subject.human.shape[1], -1), 0
    for body in subject.bodies:
        hierarchy = body.parts.hierarchy
        if body.n_pieces > 1:
            hierarchy, _ = join_parts(body.parts, model)
        part = hierarchy.parts_at(0.5)[body.face_candidate]
        of_face = majority(body.polygon, part, body.face_area + 1e-300, len(labels))
        labels = np.where(of_face >= 0, first + of_face, labels)
        first += int(part.max()) + 1
    names, labels = renumbered(labels)
    return float(np.mean([rand_index_error(labels, person) for person in subject.human])), len(names)


def validate(subjects: list[Subject], n_folds: int) -> None:
    """Print the errors on packs, and categories, that the models have not seen; of near pairs alone, and of all."""
    near, distant = learn(subjects, n_folds)
    fold = folds_of(subjects, n_folds)
    models = {left_out: JoinModel(model, fit_distant([s for s in subjects if fold[s.pack] != left_out], distant))
              for left_out, model in near.items()}
    for kind in KINDS:
        some = [s for s in subjects if s.kind == kind]
        rows = [(s, error(s, JoinModel(models[fold[s.pack]].near, None)), error(s, models[fold[s.pack]])) for s in some]
        for subject, before, now in rows:
            median = np.median([person.max() + 1 for person in subject.human])
            print(f"{subject.name:40} {before[0]:.3f} -> {now[0]:.3f}, {before[1]:4d} -> {now[1]:4d} parts, "
                  f"people {median:.0f}")
        for name, of in (("all", rows), ("of several pieces", [r for r in rows if r[0].of_several])):
            if of:
                figures = np.array([[*before, *now] for _, before, now in of]).mean(axis=0)
                print(f"{kind}, {name} {len(of)}: {figures[0]:.4f} -> {figures[2]:.4f}, "
                      f"{figures[1]:.1f} -> {figures[3]:.1f} parts")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folders", nargs="+", type=Path, metavar="FOLDER")
    parser.add_argument("--hints", nargs="*", type=Path, default=[], metavar="FOLDER")
    parser.add_argument("--apart", nargs="*", type=Path, default=[], metavar="FOLDER")
    parser.add_argument("--folds", type=int, default=0, metavar="N")
    parser.add_argument("--jobs", type=int, default=1, metavar="N", help="meshes measured at a time")
    parser.add_argument("--out", type=Path, metavar="FOLDER",
                        default=Path(__file__).resolve().parents[1] / "core" / "cuts" / "joining")
    options = parser.parse_args()
    given = {"human": options.folders, "hints": options.hints, "apart": options.apart}
    tasks = [(path, kind, seed) for kind, folders in given.items() for folder in folders
             for seed, path in enumerate(sorted(folder.glob("*.npz")))]
    subjects = list(tqdm(joblib.Parallel(options.jobs, return_as="generator")(
        joblib.delayed(read)(*task) for task in tasks), total=len(tasks), desc="meshes"))
    if options.folds:
        validate(subjects, options.folds)
        return
    _, distant = learn(subjects)
    for name, model in (("join_model", fit_near(subjects)), ("distant_model", fit_distant(subjects, distant))):
        model.write(options.out / f"{name}.npz")
        print(f"{name}.npz: {len(model.leaf)} trees on {len(model.names)} features of {len(subjects)} meshes")


if __name__ == "__main__":
    main()

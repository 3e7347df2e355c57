# SPDX-License-Identifier: GPL-3.0-or-later
"""Learn which parts of several pieces belong together; writes core/cuts/joining/join_model.npz.

    python3 benchmarks/train_joining.py FOLDER... [--hints FOLDER...] [--apart FOLDER...] [--out FILE] [--folds N]

Folders hold NAME.npz with ``vertices`` (n, 3), ``faces`` (m, 3) and labels of the faces: ``human`` (k, m), or in
``--hints`` an artist's ``material`` (m,), which counts a fifth, and only for parts of different pieces. The meshes
of ``--apart`` are closed surfaces: each is taken apart along one person's cuts, and the pieces are moved a little, so
that they run into each other as the pieces of an artist do. --folds leaves packs out in turn (a pack is what a name
begins with, up to the first dot) and prints the Rand index error on the packs left out, instead of writing a model.
"""

from __future__ import annotations

import argparse
from dataclasses import dataclass
from pathlib import Path

import packages

packages.need("numpy", "scipy", "lightgbm", "tqdm")

import lightgbm
import numpy as np
from tqdm import tqdm
from train import trees_of

from core.cuts.boosted_trees import BoostedTrees
from core.cuts.hierarchy import Hierarchy
from core.cuts.joining.method import FineParts, fine_parts, join_parts
from core.cuts.joining.pairs import FEATURES
from core.metrics import rand_index_error
from core.parameters import Parameters
from core.pipeline import decompose_component
from core.progress import Stopwatch
from core.surface.arrays import components, renumbered
from core.surface.labels import majority
from core.surface.mesh import TriMesh
from core.surface.polygons import PolygonMesh
from core.surface.preparation import bodies, repair

SETTINGS = {
    "objective": "cross_entropy", "learning_rate": 0.05, "num_leaves": 16, "min_data_in_leaf": 20,
    "feature_fraction": 0.4, "bagging_fraction": 0.7, "bagging_freq": 1, "max_bin": 63, "lambda_l2": 5.0,
    "verbose": -1, "num_threads": 1, "deterministic": True, "force_row_wise": True,
}
N_TREES, N_MODELS = 200, 3
HINT_WEIGHT = 0.2
SHIFT = 0.003  # of the diagonal: how far the pieces of a mesh that is taken apart are moved
MAX_PAIRS = 60  # of a mesh count in full; more count as the square root of their number


@dataclass(frozen=True, eq=False)
class Body:
    """The fine parts of one body, and how people label its faces.

    Attributes
    ----------
    parts : FineParts
    hierarchy : Hierarchy
        Of each piece on its own.
    face_candidate, polygon : (m,) int64
        Candidate of each face of the body's mesh, and the face of the mesh given that it lies in.
    face_area : (m,) float64
    n_pieces : int
    together : (e,) float64
        Share of people who put two points of the two parts of each pair into one part.
    """

    parts: FineParts
    hierarchy: Hierarchy
    face_candidate: np.ndarray
    polygon: np.ndarray
    face_area: np.ndarray
    n_pieces: int
    together: np.ndarray


@dataclass(frozen=True, eq=False)
class Subject:
    """One mesh with labels."""

    name: str
    bodies: list[Body]
    human: np.ndarray
    is_hint: bool

    @property
    def pack(self) -> str:
        """What the name begins with: models of one pack share pieces."""
        return self.name.split(".")[0]


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


def prepare(name: str, vertices: np.ndarray, faces: np.ndarray, human: np.ndarray, is_hint: bool) -> Subject:
    """Everything that does not depend on the model."""
    parameters, found = Parameters(), []
    for component in bodies(repair(PolygonMesh.of(vertices, faces)), True, parameters.loose_part):
        result = decompose_component(component, parameters, Stopwatch(None))
        parts = fine_parts(component.mesh, result.face_candidate, result.candidates.hierarchy, result.field.normalized)
        shares = []
        for person in human:
            table = np.zeros((len(parts.candidate), person.max() + 1))
            np.add.at(table, (parts.part, person[component.polygon]), component.mesh.face_area + 1e-300)
            shares.append(table / table.sum(axis=1, keepdims=True))
        first, second = parts.pairs.parts.T
        together = np.mean([(share[first] * share[second]).sum(axis=1) for share in shares], axis=0)
        found.append(Body(parts, result.candidates.hierarchy, result.face_candidate, component.polygon,
                          component.mesh.face_area, component.mesh.face_components[0], together))
    return Subject(name, found, human, is_hint)


def read(folder: Path, kind: str) -> list[Subject]:
    """The meshes of a folder. kind : "human", "hints" or "apart"."""
    subjects = []
    for seed, path in enumerate(tqdm(sorted(folder.glob("*.npz")), desc=folder.name)):
        with np.load(path) as stored:
            vertices, faces = stored["vertices"].astype(float), stored["faces"].astype(np.int64)
            human = stored["material"][None] if kind == "hints" else stored["human"]
        human = np.stack([renumbered(person)[1] for person in human])
        if kind == "apart":
            vertices, faces = taken_apart(vertices, faces, human, seed)
        subjects.append(prepare(path.stem, vertices, faces, human, kind == "hints"))
    return subjects


def fit(subjects: list[Subject]) -> BoostedTrees:
    """The mean of several models that differ by their random choices."""
    rows, share, weight = [], [], []
    for subject in subjects:
        for body in subject.bodies:
            pairs = body.parts.pairs
            chosen = ~pairs.same_piece if subject.is_hint else np.ones(len(body.together), bool)
            if chosen.any():
                own = np.sqrt(pairs.area[pairs.parts].min(axis=1))[chosen]
                rows.append(pairs.features[chosen])
                share.append(np.clip(body.together, 0, 1)[chosen])
                counts = HINT_WEIGHT if subject.is_hint else 1.0
                weight.append(counts * own / own.sum() * np.sqrt(min(len(own), MAX_PAIRS)))
    data = [np.concatenate(column) for column in (rows, share, weight)]
    models = [trees_of(lightgbm.train(SETTINGS | {"seed": seed}, lightgbm.Dataset(
        data[0], data[1], weight=data[2], feature_name=list(FEATURES)), N_TREES)) for seed in range(N_MODELS)]
    feature, threshold, mask, leaf = (np.concatenate([getattr(m, name) for m in models])
                                      for name in ("feature", "threshold", "mask", "leaf"))
    return BoostedTrees(feature, threshold, mask, leaf / N_MODELS, FEATURES)


def error(subject: Subject, model: BoostedTrees) -> tuple[float, int]:
    """Rand index error of the parts of detail 0.5, mean over people, and how many parts there are."""
    labels, first = np.full(subject.human.shape[1], -1), 0
    for body in subject.bodies:
        hierarchy = body.hierarchy
        if body.n_pieces > 1:
            hierarchy, _ = join_parts(body.parts, hierarchy, model)
        part = hierarchy.parts(hierarchy.n_parts(0.5))[body.face_candidate]
        of_face = majority(body.polygon, part, body.face_area + 1e-300, len(labels))
        labels = np.where(of_face >= 0, first + of_face, labels)
        first += int(part.max()) + 1
    names, labels = renumbered(labels)
    return float(np.mean([rand_index_error(labels, person) for person in subject.human])), len(names)


def validate(subjects: list[Subject], more: list[Subject], n_folds: int) -> None:
    """Print the error on packs that the model has not seen."""
    packs = sorted({subject.pack for subject in subjects})
    scores = []
    for fold in range(n_folds):
        left_out = set(packs[fold::n_folds])
        model = fit([s for s in [*subjects, *more] if s.pack not in left_out])
        scores += [(s, *error(s, model)) for s in subjects if s.pack in left_out]
    for subject, wrong, count in scores:
        median = np.median([person.max() + 1 for person in subject.human])
        print(f"{subject.name:40} {wrong:.3f} {count:4d} parts, people {median:.0f}")
    print(f"mean of {len(scores)}: {np.mean([wrong for _, wrong, _ in scores]):.4f}, "
          f"{np.mean([count for *_, count in scores]):.1f} parts")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folders", nargs="+", type=Path, metavar="FOLDER")
    parser.add_argument("--hints", nargs="*", type=Path, default=[], metavar="FOLDER")
    parser.add_argument("--apart", nargs="*", type=Path, default=[], metavar="FOLDER")
    parser.add_argument("--folds", type=int, default=0, metavar="N")
    parser.add_argument("--out", type=Path, metavar="FILE",
                        default=Path(__file__).resolve().parents[1] / "core" / "cuts" / "joining" / "join_model.npz")
    options = parser.parse_args()
    subjects = [s for folder in options.folders for s in read(folder, "human")]
    more = [s for folder in options.hints for s in read(folder, "hints")]
    more += [s for folder in options.apart for s in read(folder, "apart")]
    if options.folds:
        validate(subjects, more, options.folds)
        return
    model = fit([*subjects, *more])
    model.write(options.out)
    print(f"{options.out}: {len(model.leaf)} trees on {len(FEATURES)} features of {len(subjects) + len(more)} meshes")


if __name__ == "__main__":
    main()

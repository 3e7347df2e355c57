# SPDX-License-Identifier: GPL-3.0-or-later
"""Posed human bodies of many builds whose parts are the bones that move them, to learn from (train.py --bodies).

    python3 benchmarks/posed_bodies.py BODY.npz OUT

BODY.npz is a body with its bones and shapes, such as MakeHuman's base mesh (CC0, https://www.makehumancommunity.org):
``vertices`` (n, 3) and ``faces`` (m, 4), quads, y upwards; of each of b bones ``bone_names``, ``bone_parent``, -1 for
none and before its children, and ``bone_head_vertices`` (b, 8), in whose middle it begins, -1 for fewer; weights as
``weight_bone``, ``weight_vertex`` and ``weight``, one entry each; and targets, changes of shape, as ``target_names``
and the range ``target_start`` of each in ``target_vertex`` and ``target_delta`` (k, 3). OUT gets COUNT bodies, each
bent and shaped at random, as human.SEED.npz: ``vertices``, ``faces`` (m', 3) and ``human`` (3, m'): coarse, medium and
fine parts. What ships was learned from these.
"""

from __future__ import annotations

import re

import packages

packages.need("numpy", "scipy")

import numpy as np
from meshes import source_and_target, write_labelled
from scipy.spatial.transform import Rotation

COUNT, FIRST = 16, 100  # bodies, and the seed of the first
#: What bones, without Left and Right, are called, and their coarse, medium and fine parts; the first that fits counts.
PARTS = (
    (r"Head", "head", "head", "head"), (r"Neck", "torso", "neck", "neck"),
    (r"Hand(Thumb|Index|Middle|Ring|Pinky)", "arm", "lower arm", r"finger \1"), (r"Hand", "arm", "lower arm", "hand"),
    (r"ForeArm", "arm", "lower arm", "lower arm"), (r"Arm", "arm", "upper arm", "upper arm"),
    (r"Foot|Toe", "leg", "lower leg", "foot"), (r"UpLeg", "leg", "upper leg", "upper leg"),
    (r"Leg", "leg", "lower leg", "lower leg"), (r"", "torso", "torso", "torso"))
#: Degrees, one standard deviation, by which bones are bent about an axis at random.
BEND = {"Arm": 35, "ForeArm": 35, "UpLeg": 25, "Leg": 25, "Spine": 8, "Spine1": 8, "Spine2": 8, "Neck": 10, "Head": 12,
        "Hand": 12, "Foot": 10}
# Of the targets that change the whole body so many are mixed, of the others so many, up to such an amount.
WHOLE, DETAILS, MOST = 2, 6, 0.8
LEAST_WHOLE = 0.2

Body = dict[str, np.ndarray]


def parts_of(bone: str) -> list[str]:
    """The coarse, medium and fine part that a bone moves, with a side unless it lies in the middle."""
    side = ".L" if bone.startswith("Left") else ".R" if bone.startswith("Right") else ""
    for pattern, *names in PARTS:
        found = re.search(pattern, bone)
        if found:
            named = [found.expand(name) for name in names]
            return [name + ("" if name in ("head", "neck", "torso") else side) for name in named]
    raise AssertionError(bone)  # the last pattern fits everything


def shaped(body: Body, rng: np.random.Generator) -> np.ndarray:
    """Vertices of the body with some targets mixed at random."""
    vertices, start = body["vertices"].astype(float), body["target_start"]
    is_whole = np.char.startswith(body["target_names"], "universal-")
    for targets, count, least in ((np.flatnonzero(is_whole), WHOLE, LEAST_WHOLE),
                                  (np.flatnonzero(~is_whole), DETAILS, 0.0)):
        for target in rng.choice(targets, count, replace=False):
            entries = slice(start[target], start[target + 1])
            vertices[body["target_vertex"][entries]] += (
                rng.uniform(least, MOST) * body["target_delta"][entries].astype(float))
    return vertices


def posed(body: Body, vertices: np.ndarray, rng: np.random.Generator) -> np.ndarray:
    """Vertices with all bones bent at random, blended by their weights."""
    heads = [vertices[ends[ends >= 0]].mean(axis=0) for ends in body["bone_head_vertices"]]
    world = np.tile(np.eye(4), (len(heads), 1, 1))
    for bone, (name, parent, head) in enumerate(zip(body["bone_names"], body["bone_parent"], heads, strict=True)):
        bend = np.radians(BEND.get(re.sub("Left|Right", "", name), 0.0))
        local = np.eye(4)
        axis, angle = rng.normal(size=3), rng.normal(0.0, bend) if bend else 0.0
        local[:3, :3] = Rotation.from_rotvec(angle * axis / np.linalg.norm(axis)).as_matrix()
        local[:3, 3] = head - local[:3, :3] @ head
        world[bone] = (world[parent] if parent >= 0 else np.eye(4)) @ local
    moves, at, weight = body["weight_bone"], body["weight_vertex"].astype(int), body["weight"].astype(float)
    there = np.einsum("kij,kj->ki", world[moves][:, :3, :3], vertices[at]) + world[moves][:, :3, 3]
    total, moved = np.bincount(at, weight, len(vertices)), np.zeros_like(vertices)
    np.add.at(moved, at, weight[:, None] * there)
    return np.where(total[:, None] > 0, moved / np.maximum(total, 1e-9)[:, None], vertices)


def labelled(body: Body) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """The vertices in use, triangles of them, (m', 3), and the coarse, medium and fine part of each, (3, m').

    A triangle has the part of two of its corners, a corner that of the bone that moves it most.
    """
    quads, weight = body["faces"], body["weight"].astype(float)
    faces = np.concatenate([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]])
    faces = faces[(faces != np.roll(faces, -1, axis=1)).all(axis=1)]
    used, faces = np.unique(faces, return_inverse=True)
    order, strongest = np.argsort(weight, kind="stable"), np.zeros(len(body["vertices"]), int)
    strongest[body["weight_vertex"][order]] = body["weight_bone"][order]
    names = np.array([parts_of(bone) for bone in body["bone_names"]])[strongest[used]]
    faces = faces.reshape(-1, 3)
    a, b, c = (np.array([np.unique(column, return_inverse=True)[1] for column in names.T])[:, faces[:, corner]]
               for corner in range(3))
    return used, faces, np.where(b == c, b, a)


def main() -> None:
    source, out = source_and_target(__doc__, "BODY.npz")
    with np.load(source) as stored:
        body = dict(stored)
    used, faces, human = labelled(body)
    for seed in range(FIRST, FIRST + COUNT):
        rng = np.random.default_rng(seed)
        vertices = posed(body, shaped(body, rng), rng)
        write_labelled(out / f"human.{seed}.npz", vertices[used], faces, human=human)


if __name__ == "__main__":
    main()

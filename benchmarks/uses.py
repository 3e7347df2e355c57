# SPDX-License-Identifier: GPL-3.0-or-later
"""How good bones, hulls and seams of parts are on many models; no Blender is needed.

    python3 benchmarks/uses.py MODELS ...

MODELS are .obj files or .npz files with vertices and faces, or folders with such. Each is decomposed with the default
preset. A line tells, for each, how many bones its parts have; of how many joints, each bent by 60 degrees to four
sides, some face is turned over, and how many faces; in how many poses the volume changes by more than 10 %; the volume
of the hulls over that of the parts with at most 1, 2, 4 and 8 hulls a part; and the seconds and the length, with the
diagonal of the model as unit, of the seams of the whole model as one chart. The last line is of all: sums, and means of
the rest.
"""

from __future__ import annotations

import argparse
import sys
import time
from pathlib import Path

import packages

packages.need("numpy", "scipy", "trimesh")

import numpy as np
from meshes import load_mesh

from core import decompose
from core.mesh.corners import CornerTable
from core.uses.maps.unfold import unfolding_seams
from core.uses.moving.bone_trees import following
from core.uses.moving.bones import BoneSurface
from core.uses.moving.hulls import part_hulls, part_volumes
from core.uses.moving.limbs import limb_bones
from core.uses.moving.skinning import BENT, bends, smooth_weights, turned_over

HULLS = (1, 2, 4, 8)
COLUMNS = ("parts", "bones", "poses", "joints that turn faces", "faces", "poses, volume", "1 hull", "2", "4", "8",
           "seconds", "seams")


def main() -> int:
    """Measure all models; returns the exit status."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("models", nargs="+", type=Path, metavar="MODELS")
    rows = []
    print("; ".join(COLUMNS))
    for path in parser.parse_args().models:
        for file in sorted(file for kind in ("obj", "npz") for file in path.rglob(f"*.{kind}")) or [path]:
            rows.append(measured(*load_mesh(file)))
            print(f"{file.stem}:", *(f"{value:g}" for value in rows[-1]), flush=True)
    total = np.array(rows)
    clean = ((total[:, 3] == 0) & (total[:, 5] == 0)).sum()
    print(f"all {len(rows)}, {clean} that bend well:", *(f"{value:g}" for value in (*total[:, :6].sum(axis=0),
                                                                                *total[:, 6:].mean(axis=0))))
    return 0


def measured(vertices: np.ndarray, faces: np.ndarray) -> tuple[float, ...]:
    """The values of a line. vertices : (n, 3). faces : (m, 3)."""
    result = decompose(vertices, faces)
    parts, table = result.parts(), CornerTable.of(vertices, faces)
    graph = result.graph
    bones, _, part_bone = limb_bones(BoneSurface(
        table, parts.labels, np.linalg.norm(table.face_vectors(), axis=1), np.nan_to_num(result.field),
        np.concatenate([graph.point_position, graph.node_position]),
        np.concatenate([parts.point_part, parts.node_part])))
    volume = np.abs(part_volumes(table, parts.labels)).sum()
    hulls = [round(sum(hull.volume for some in part_hulls(table, parts.labels, count) for hull in some) / volume, 3)
             for count in HULLS]
    start = time.perf_counter()
    seams = unfolding_seams(table, np.zeros(len(table.edges), bool))
    seconds = time.perf_counter() - start
    length = table.edge_length(np.flatnonzero(seams)).sum() / np.linalg.norm(np.ptp(vertices, axis=0))
    return (parts.count, len(bones.head), *bent(table, faces, part_bone[parts.labels], bones), *hulls,
            round(seconds, 2), round(length, 3))


def bent(table: CornerTable, faces: np.ndarray, labels: np.ndarray, bones) -> tuple[int, int, int, int]:
    """Poses, joints that turn a face over, such faces, and poses that change the volume by more than 10 %."""
    full = smooth_weights(table, labels, bones).of_bones(len(bones.head))
    beyond, before = following(bones.parent, bones.order), volume_of(table.vertices, faces)
    poses = joints = turned = changed = 0
    for bone in np.flatnonzero(bones.parent >= 0).tolist():
        share, along = full[:, beyond[bone]].sum(axis=1), bones.tail[bone] - bones.head[bone]
        over = turned_over(table, share, bones.head[bone], along, BENT).sum()
        joints, turned = joints + (over > 0), turned + over
        for turn in bends(along, BENT):
            moved = table.vertices + share[:, None] * ((table.vertices - bones.head[bone]) @ (turn - np.eye(3)).T)
            poses, changed = poses + 1, changed + (abs(volume_of(moved, faces) / before - 1) > 0.1)
    return poses, int(joints), int(turned), int(changed)


def volume_of(points: np.ndarray, faces: np.ndarray) -> float:
    """What a surface encloses, measured from the middle of its corners."""
    a, b, c = (points - points.mean(axis=0))[faces].transpose(1, 0, 2)
    return float((a * np.cross(b, c)).sum()) / 6


if __name__ == "__main__":
    sys.exit(main())

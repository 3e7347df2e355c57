# SPDX-License-Identifier: GPL-3.0-or-later
"""Models of robots as labelled meshes: their parts are the links that their joints move.

    python3 benchmarks/robots.py FOLDER OUT

FOLDER holds robot descriptions (URDF) and their meshes, such as robots/ of example-robot-data 6.0.0 or pybullet_data/
of pybullet 3.2.7; of these, what ROBOTS names is taken, each at rest. OUT gets PACK.NAME.npz with ``vertices``,
``faces`` and ``human``: a coarse labelling, a chain of links from a fork to the next in one part; a medium one by links
that joints move; a fine one with links down to LEAST[-1] of the area. Meshes of links are reduced to FACES in all.
"""

from __future__ import annotations

import os
from dataclasses import dataclass
from pathlib import Path

import packages

packages.need("numpy", "scipy", "trimesh", "yourdfpy", "collada", "fast_simplification", "tqdm")

import fast_simplification
import numpy as np
import trimesh
import yourdfpy
from meshes import joined_alone, some, source_and_target, stacked, write_labelled
from tqdm import tqdm

from core.arrays.components import components
from core.mesh.triangles import TriMesh

ROBOTS = (
    "a1_description/urdf/a1", "alex_description/urdf/alex_nub_hands", "allegro_hand_description/urdf/allegro_left_hand",
    "anymal_b_simple_description/robots/anymal", "anymal_c_simple_description/urdf/anymal", "b1_description/urdf/b1",
    "baxter_description/urdf/baxter", "bolt_description/robots/bolt", "centauro_description/urdf/centauro",
    "finger_edu_description/robots/finger_edu", "g1_description/urdf/g1_29dof_rev_1_0", "go1_description/urdf/go1",
    "go2_description/urdf/go2", "human_description/robots/human", "hyq_description/robots/hyq_no_sensors",
    "icub_description/robots/icub", "kinova_description/robots/kinova", "laikago_description/urdf/laikago",
    "panda_description/urdf/panda", "pr2_description/urdf/pr2", "quadruped_description/urdf/quadruped",
    "romeo_description/urdf/romeo", "so_arm_description/urdf/so100", "solo_description/robots/solo",
    "solo_description/robots/solo12", "talos_data/robots/talos_full_v2", "tiago_description/robots/tiago",
    "tiago_description/robots/tiago_dual", "tiago_pro_description/robots/tiago_pro", "ur_description/urdf/ur10_robot",
    "xarm_description/urdf/xarm7", "z1_description/urdf/z1", "quadruped/microtaur/microtaur", "quadruped/minitaur",
    "quadruped/vision60", "quadruped/spirit40", "aliengo/aliengo", "r2d2", "racecar/racecar", "kuka_iiwa/model",
    "mini_cheetah/mini_cheetah", "xarm/xarm6_with_gripper", "pr2_gripper")
FACES = 12_000
SPECK = 2e-4  # share of the area of the robot below which a piece is left out
LEAST = 0.015, 0.004  # share of the area below which a link belongs to the one that carries it: medium, fine
SAME = 1e-6  # share of the diagonal within which vertices are one


@dataclass(frozen=True, eq=False)
class Robot:
    """A robot at rest. link : (m,) of str, of each face. carrier : dict of link to the link that carries it."""

    mesh: TriMesh
    link: np.ndarray
    carrier: dict[str, str]


def read(path: Path) -> Robot:
    """The robot of a description; links that no joint moves against each other are one."""
    description = yourdfpy.URDF.load(str(path), filename_handler=lambda fname: find(path, fname))
    description.update_cfg([_at_rest(joint) for joint in description.actuated_joints])
    joint_of = {joint.child: joint for joint in description.robot.joints}

    def body_of(link: str) -> str:
        while link in joint_of and joint_of[link].type == "fixed":
            link = joint_of[link].parent
        return link

    graph, vertices, faces, link = description.scene.graph, [], [], []
    for node in graph.nodes_geometry:
        transform, name = graph[node]
        geometry = description.scene.geometry[name]
        if isinstance(geometry, trimesh.Trimesh) and len(geometry.faces):
            while node not in description.link_map:
                node = graph.transforms.parents[node]
            vertices.append(trimesh.transform_points(geometry.vertices, transform))
            faces.append(geometry.faces)
            link.append(body_of(node))
    carrier = {name: body_of(joint_of[name].parent) for name in map(body_of, description.link_map) if name in joint_of}
    vertices, faces, number = stacked(vertices, faces)
    return Robot(TriMesh(vertices, faces.astype(np.int64)), np.array(link)[number], carrier)


def find(description: Path, name: str) -> str:
    """The file of a mesh that a description names, below the description's folder or one above it."""
    steps = Path(name.removeprefix("package://")).parts
    for folder in description.parents[:6]:
        for first in range(len(steps)):
            if (path := folder.joinpath(*steps[first:])).is_file():
                return os.fspath(path)
    return name


def _at_rest(joint) -> float:
    """The position nearest to 0 that a joint can take."""
    limit = joint.limit
    if limit is None or limit.lower is None or limit.upper is None or limit.lower > limit.upper:
        return 0.0
    return min(max(0.0, limit.lower), limit.upper)


def reduced(robot: Robot) -> Robot:
    """The robot with few faces, its vertices joined and without specks; links get faces by the root of their area."""
    names, of_face = np.unique(robot.link, return_inverse=True)
    width = np.sqrt(np.bincount(of_face, robot.mesh.face_area))
    same, speck = SAME * np.linalg.norm(np.ptp(robot.mesh.vertices, axis=0)), SPECK * robot.mesh.area
    vertices, faces = [], []
    for number in range(len(names)):
        goal = max(150, int(FACES * width[number] / width.sum()))
        v, f = _without_specks(*joined_alone(robot.mesh.vertices, robot.mesh.faces[of_face == number], same)[:2], speck)
        if len(f) > goal:
            fewer = fast_simplification.simplify(v.astype(np.float32), f.astype(np.int32), target_count=goal)
            v, f = fewer if len(fewer[1]) > 20 else (v, f)
        vertices.append(v)
        faces.append(f)
    vertices, faces, number = stacked(vertices, faces)
    mesh = TriMesh(vertices.astype(float), faces.astype(np.int64))
    solid = mesh.face_area > 0
    return Robot(TriMesh(mesh.vertices, mesh.faces[solid]), names[number[solid]], robot.carrier)


def _without_specks(vertices: np.ndarray, faces: np.ndarray, least: float) -> tuple[np.ndarray, np.ndarray]:
    """A mesh without the pieces of less area than ``least``."""
    mesh = TriMesh(vertices, faces)
    piece = components(len(vertices), *mesh.edges.vertices.T)[1][faces[:, 0]]
    used, faces = np.unique(faces[np.bincount(piece, mesh.face_area)[piece] > least], return_inverse=True)
    return vertices[used], faces.reshape(-1, 3)


def labels(robot: Robot) -> np.ndarray:
    """A coarse, a medium and a fine label of each face, (3, m) int64."""
    names, of_face = np.unique(robot.link, return_inverse=True)
    share = dict(zip(names, np.bincount(of_face, robot.mesh.face_area) / robot.mesh.area, strict=True))
    above = {name: _carried_by(name, robot.carrier, share) for name in share}
    medium, tree = _merged(share, above, LEAST[0])
    fine, _ = _merged(share, above, LEAST[1])
    chain = _chains(tree)
    return np.stack([np.unique([of[link] for link in robot.link], return_inverse=True)[1]
                     for of in ({name: chain[medium[name]] for name in medium}, medium, fine)])


def _carried_by(name: str, carrier: dict[str, str], with_mesh: dict[str, float]) -> str | None:
    """The nearest link with a mesh that carries a link."""
    while name in carrier:
        name = carrier[name]
        if name in with_mesh:
            return name
    return None


def _merged(
    share: dict[str, float], above: dict[str, str | None], least: float
) -> tuple[dict[str, str], dict[str, str | None]]:
    """Link that each is a part of when small ones join their carriers, or the largest they carry; and the tree."""
    part, share, above = {name: name for name in share}, dict(share), dict(above)
    while len(share) > 1 and min(share.values()) < least:
        small = min(share, key=share.__getitem__)
        below = [name for name in share if above[name] == small]
        goal = above[small] or max(below, key=share.__getitem__, default=None)
        if goal is None:
            break
        for name in below:
            above[name] = goal
        if above[small] is None:
            above[goal] = None
        share[goal] += share.pop(small)
        part = {name: goal if of == small else of for name, of in part.items()}
    return part, {name: above[name] for name in share}


def _chains(above: dict[str, str | None]) -> dict[str, str]:
    """The first link of the chain that each link lies in; chains end where links fork."""
    below = {name: [other for other in above if above[other] == name] for name in above}
    first, open_ = {}, [(name, name) for name in above if above[name] is None]
    while open_:
        name, of = open_.pop()
        first[name] = of
        goes_on = len(below[name]) == 1 and above[name] is not None
        open_ += [(other, of if goes_on else other) for other in below[name]]
    return first


def main() -> None:
    folder, out = source_and_target(__doc__)
    for name in tqdm(some([name for name in ROBOTS if (folder / f"{name}.urdf").is_file()], folder)):
        robot = reduced(read(folder / f"{name}.urdf"))
        pack = "robot_" + name.split("/")[0].removesuffix("_description")
        path = out / f"{pack}.{Path(name).name}.npz"
        write_labelled(path, robot.mesh.vertices, robot.mesh.faces, human=labels(robot))


if __name__ == "__main__":
    main()

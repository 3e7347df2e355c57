# SPDX-License-Identifier: GPL-3.0-or-later
"""Models for the simulator MuJoCo as labelled meshes: their parts are the bodies that their joints move.

    python3 benchmarks/mujoco_models.py FOLDER OUT

FOLDER holds the packages dm_control 1.0.50, robosuite 1.5.2 and gymnasium_robotics 1.4.2, unpacked; of these, what
MODELS names is taken, in the pose it starts in. OUT gets PACK.NAME.npz, as robots.py writes them: people and animals of
simple solids, a dog and a rat under one skin, a fly, hands and robots.
"""

from __future__ import annotations

from pathlib import Path

import packages

packages.need("numpy", "scipy", "trimesh", "mujoco", "yourdfpy", "collada", "fast_simplification", "tqdm")

import mujoco
import numpy as np
import trimesh
from meshes import some, source_and_target, stacked, write_labelled
from robots import Robot, labels, reduced
from tqdm import tqdm

from core.mesh.triangles import TriMesh

SUITE, WALKERS = "dm_control/suite", "dm_control/locomotion/walkers/assets"
ROBOTS, GRIPPERS = "robosuite/models/assets/robots", "robosuite/models/assets/grippers"
SKIN = -1  # in place of a group of solids
#: By pack and name: the file, and the group of solids in it that is to be seen.
MODELS = {
    "biped.humanoid": (f"{SUITE}/humanoid.xml", 0), "biped.humanoid_cmu": (f"{SUITE}/humanoid_CMU.xml", 0),
    "biped.humanoid_v2019": (f"{WALKERS}/humanoid_CMU_V2019.xml", 2), "biped.walker": (f"{SUITE}/walker.xml", 0),
    "cheetah.cheetah": (f"{SUITE}/cheetah.xml", 0), "fish_mj.fish": (f"{SUITE}/fish.xml", 0),
    "quadruped_mj.quadruped": (f"{SUITE}/quadruped.xml", 0), "ant_mj.ant": ("dm_control/third_party/ant/ant.xml", 0),
    "boxhead.boxhead": ("dm_control/locomotion/soccer/assets/boxhead/boxhead.xml", 0),
    "dog.dog": (f"{WALKERS}/dog_v2/dog.xml", SKIN), "rodent.rodent": (f"{WALKERS}/rodent.xml", SKIN),
    "rodent.rodent_solids": (f"{WALKERS}/rodent.xml", 2), "fly.fly": (f"{WALKERS}/fruitfly_v2/fruitfly.xml", 1),
    "robot_shadow.hand": ("gymnasium_robotics/envs/assets/hand/reach.xml", 1),
    "robot_fetch.fetch_mj": ("gymnasium_robotics/envs/assets/fetch/reach.xml", 0),
    "robot_kinova.jaco_arm": ("dm_control/third_party/kinova/jaco_arm.xml", 0),
    **{f"{pack}.{name}": (f"{ROBOTS}/{name}/robot.xml", 1) for pack, name in (
        ("robot_baxter", "baxter"), ("robot_gr1", "gr1"), ("robot_kuka_iiwa", "iiwa"), ("robot_kinova", "jaco"),
        ("robot_kinova", "kinova3"), ("robot_sawyer", "sawyer"), ("robot_spot", "spot"), ("robot_spot", "spot_arm"),
        ("robot_tiago", "tiago"), ("robot_ur", "ur5e"), ("robot_xarm", "xarm7"))},
    **{f"{pack}.{name}": (f"{GRIPPERS}/{name}.xml", 1) for pack, name in (
        ("robot_spot", "bd_gripper"), ("robot_gr1", "fourier_right_hand"), ("robot_inspire", "inspire_right_hand"),
        ("robot_kinova", "jaco_three_finger_gripper"), ("robot_sawyer", "rethink_gripper"),
        ("robot_robotiq", "robotiq_gripper_140"), ("robot_robotiq", "robotiq_gripper_s"))},
}


def read(path: Path, group: int) -> Robot:
    """The model of a file; bodies that no joint moves against each other are one."""
    model = mujoco.MjModel.from_xml_path(str(path))
    moved = np.arange(model.nbody)
    for body in range(1, model.nbody):  # a body comes after the one that carries it
        if not model.body_jntnum[body]:
            moved[body] = moved[model.body_parentid[body]]
    vertices, faces, body = _skin(model) if group == SKIN else _solids(model, group)
    names = [f"{k} {model.body(k).name}" for k in range(model.nbody)]
    carrier = {names[k]: names[moved[model.body_parentid[k]]] for k in np.unique(moved) if k}
    return Robot(TriMesh(vertices, faces.astype(np.int64)), np.array([names[moved[k]] for k in body]), carrier)


def _solids(model: mujoco.MjModel, group: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Vertices, faces and the body of each face, of the solids of a group that bodies carry."""
    state = mujoco.MjData(model)
    mujoco.mj_forward(model, state)
    vertices, faces, body = [], [], []
    for k in np.flatnonzero((model.geom_group == group) & (model.geom_bodyid > 0)):
        solid = _solid(model, k)
        if solid is not None:
            vertices.append(solid.vertices @ state.geom_xmat[k].reshape(3, 3).T + state.geom_xpos[k])
            faces.append(solid.faces)
            body.append(model.geom_bodyid[k])
    vertices, faces, number = stacked(vertices, faces)
    return vertices, faces, np.array(body)[number]


def _solid(model: mujoco.MjModel, k: int) -> trimesh.Trimesh | None:
    """The mesh of one solid, in its own frame; none of planes and what else has no end."""
    kind, size, types = model.geom_type[k], model.geom_size[k], mujoco.mjtGeom
    if kind == types.mjGEOM_MESH:
        mesh = model.mesh(model.geom_dataid[k])
        first, first_face = int(mesh.vertadr[0]), int(mesh.faceadr[0])
        return trimesh.Trimesh(model.mesh_vert[first:first + int(mesh.vertnum[0])],
                               model.mesh_face[first_face:first_face + int(mesh.facenum[0])], process=False)
    if kind == types.mjGEOM_SPHERE:
        return trimesh.creation.icosphere(2, size[0])
    if kind == types.mjGEOM_ELLIPSOID:
        return trimesh.creation.icosphere(2, 1.0).apply_scale(size)
    if kind == types.mjGEOM_CAPSULE:
        capsule = trimesh.creation.capsule(2 * size[1], size[0], count=[12, 12])
        return capsule.apply_translation([0, 0, -capsule.bounds.mean(axis=0)[2]])
    if kind == types.mjGEOM_CYLINDER:
        return trimesh.creation.cylinder(size[0], 2 * size[1], sections=16)
    return trimesh.creation.box(2 * size) if kind == types.mjGEOM_BOX else None


def _skin(model: mujoco.MjModel) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Vertices, faces and the body that moves each face most, of a model under a skin."""
    weight = np.zeros((model.nskinvert, model.nbody))
    bone = np.repeat(model.skin_bonebodyid, model.skin_bonevertnum)
    np.add.at(weight, (model.skin_bonevertid, bone), model.skin_bonevertweight)
    return model.skin_vert.astype(float), model.skin_face, weight[model.skin_face].sum(axis=1).argmax(axis=1)


def main() -> None:
    folder, out = source_and_target(__doc__)
    mujoco.set_mju_user_warning(lambda _: None)  # or it leaves a log in the folder it is called from
    there = [item for item in MODELS.items() if (folder / item[1][0]).is_file()]
    for name, (file, group) in tqdm(some(there, folder)):
        robot = reduced(read(folder / file, group))
        write_labelled(out / f"{name}.npz", robot.mesh.vertices, robot.mesh.faces, human=labels(robot))


if __name__ == "__main__":
    main()

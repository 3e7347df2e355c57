# SPDX-License-Identifier: GPL-3.0-or-later
"""Files of models far from the origin, as surveys have them, and of very small ones: their positions last."""

import json

import numpy as np
import pytest
import reeb_parts
import shapes
import trimesh
from reeb_parts.batch.records import RECORD, Settings
from reeb_parts.batch.work import do_model
from reeb_parts.outputs import colored_bytes, part_files
from scipy.spatial import cKDTree

from core import Parameters

SURVEY = (500_000.0, 5_000_000.0, 100.0)  # meters east and north
KINDS = ["colored.ply", "colored.glb", "colored.obj", "ply", "glb", "obj", "off"]


def ring(place=(0.0, 0.0, 0.0), scale=1.0):
    vertices, faces = shapes.torus()
    return reeb_parts.Model("ring", scale * vertices + place, faces, np.arange(len(faces)))


def files_of(model, kind):
    """Bytes of the files of a kind, by name."""
    parts = reeb_parts.decompose(model).parts(n_parts=3)
    if kind.startswith("colored"):
        return {kind: colored_bytes(model, parts, kind.removeprefix("colored"))}
    return part_files(model, parts, kind)


def corners(files, folder):
    """Corners of all faces that files have, (m, 3)."""
    found = []
    for name, data in files.items():
        (folder / name).write_bytes(data)
        meshes = trimesh.load_scene(folder / name, process=False).dump()
        found += [mesh.vertices[mesh.faces].reshape(-1, 3) for mesh in meshes]
    return np.concatenate(found)


@pytest.mark.parametrize(("place", "scale"), [((0, 0, 0), 1.0), ((0, 0, 0), 1e-6), (SURVEY, 1.0), (SURVEY, 1e3)])
@pytest.mark.parametrize("kind", KINDS)
def test_positions_are_those_of_the_model(kind, place, scale, tmp_path):
    model = ring(place, scale)
    found = corners(files_of(model, kind), tmp_path)
    assert len(found) == 3 * len(model.faces)
    size = np.linalg.norm(np.ptp(model.vertices, axis=0))
    there, back = (cKDTree(a).query(b)[0].max() for a, b in ((found, model.vertices), (model.vertices, found)))
    assert max(there, back) < 2e-5 * size


@pytest.mark.parametrize(("place", "single"), [((0, 0, 0), True), ((10, 0, 0), True), (SURVEY, False)])
def test_single_precision_is_kept_where_it_is_enough(place, single, tmp_path):
    model = ring(place)
    head = files_of(model, "colored.ply")["colored.ply"].partition(b"end_header")[0]
    assert (head.count(b"property float"), head.count(b"property double")) == ((3, 0) if single else (0, 3))
    (tmp_path / "ring.glb").write_bytes(files_of(model, "colored.glb")["colored.glb"])
    scene = trimesh.load_scene(tmp_path / "ring.glb")
    origins = np.array([scene.graph[name][0][:3, 3] for name in scene.graph.nodes_geometry])
    assert len(origins) == 3
    middle = (model.vertices.min(axis=0) + model.vertices.max(axis=0)) / 2
    assert origins == pytest.approx(np.tile((0, 0, 0) if single else middle, (3, 1)))


@pytest.mark.parametrize(("place", "kind", "words"), [
    (SURVEY, "stl", "off by up to 0.25"), (SURVEY, "ply", ""), ((0, 0, 0), "stl", "")])
def test_who_asks_for_a_format_that_is_too_coarse_is_told(place, kind, words, reeb_parts_command, tmp_path):
    model = ring(place)
    np.savez(tmp_path / "ring.npz", vertices=model.vertices, faces=model.faces)
    done = reeb_parts_command("decompose", tmp_path / "ring.npz", "--parts", tmp_path / "out", "--parts-format", kind)
    assert done.returncode == 0, done.stderr
    assert ("single precision" in done.stderr) == bool(words)
    assert words in done.stderr
    do_model({"path": str(tmp_path / "ring.npz"), "name": "ring.npz", "folder": str(tmp_path / "batch"),
              "blender": None, "retry": False, "settings": Settings(Parameters(), parts=kind).to_dict()})
    notes = json.loads((tmp_path / "batch" / RECORD).read_text())["model"]["notes"]
    assert any("single precision" in note and words in note for note in notes) == bool(words)

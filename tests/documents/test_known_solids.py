# SPDX-License-Identifier: GPL-3.0-or-later
"""Bodies that the cut model learns from: closed, in one piece, and labelled as they were made."""

import sys
from pathlib import Path

import numpy as np
import pytest

sys.path.append(str(Path(__file__).resolve().parents[2] / "benchmarks"))

import known_solids
from known_solids import Part, certainty, cuboid, labels_of, largest_piece, meshed, rod, united

from core.mesh.triangles import TriMesh


@pytest.fixture(autouse=True)
def not_decimated(monkeypatch):
    """The package that decimates is one of the benchmarks' own."""
    monkeypatch.setattr(known_solids, "decimated", lambda shape, rng: shape)
    monkeypatch.setattr(known_solids, "COUNTS", dict.fromkeys(known_solids.COUNTS, 2))


def test_the_same_seed_makes_the_same_bodies():
    first, again, other = (known_solids.known_solids(seed) for seed in (1, 1, 2))
    assert list(first) == list(again) == list(other)
    for name, mesh in first.items():
        assert all(a.tobytes() == b.tobytes() for a, b in zip(mesh, again[name], strict=True))
        assert mesh[0].tobytes() != other[name][0].tobytes()


def test_bodies_are_one_piece_and_closed_but_for_plain_ones():
    for name, (vertices, faces, people) in known_solids.known_solids(3).items():
        mesh = TriMesh(vertices, faces)
        assert mesh.face_components[0] == 1
        sides = np.sort(np.stack([faces, np.roll(faces, -1, axis=1)], axis=-1).reshape(-1, 2), axis=1)
        if not name.startswith("plain"):
            assert (np.unique(sides, axis=0, return_counts=True)[1] % 2 == 0).all()
        assert people.shape[1] == len(faces)
        assert name.startswith("plain") == (people.max() == 0) or name.startswith("blocks")


def test_a_face_belongs_to_the_nearest_part():
    rng = np.random.default_rng(0)
    parts = [Part(cuboid((-1, 0, 0), (1, 1, 1), 0.1)), Part(rod((0, 0, 0), (2, 0, 0), (0.4, 0.4)), 0)]
    shape = largest_piece(meshed(united([part.distance for part in parts], 0.0), 6.0, 0.4, rng))
    x = shape.vertices[shape.faces].mean(axis=1)[:, 0]
    for person in labels_of(shape, parts, 0.0, rng):
        assert (person[x < -0.2] == 0).all()
        assert (person[x > 0.2] == 1).all()


@pytest.mark.parametrize(("sure", "cut"), [(0.0, 0), (0.5, 2), (0.7, 3), (1.0, 4)])
def test_so_many_people_cut_as_it_is_certain(sure, cut):
    rng = np.random.default_rng(0)
    parts = [Part(rod((-2, 0, 0), (0, 0, 0), (0.5, 0.5))), Part(rod((0, 0, 0), (2, 0, 0), (0.5, 0.5)), 0, sure)]
    shape = meshed(united([part.distance for part in parts], 0.0), 6.0, 0.5, rng)
    people = labels_of(shape, parts, 0.0, rng)
    assert [person.max() for person in people].count(1) == cut


def test_certainty_rises_or_falls_between_its_ends():
    assert [certainty(x, 1.0, 0.6) for x in (1.2, 1.0, 0.8, 0.6, 0.1)] == pytest.approx([0, 0, 0.5, 1, 1])

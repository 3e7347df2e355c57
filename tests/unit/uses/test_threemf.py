# SPDX-License-Identifier: GPL-3.0-or-later
"""3MF files: what is written is what is read, by a reader that holds files to the rules of the specification."""

import numpy as np
import pytest
import shapes
from threemf_reader import read_3mf

from core.uses.threemf import Assembly, ColoredMesh, write_3mf


def ball(name="Ball", color=(1.0, 0.5, 0.0), shift=0.0):
    vertices, faces = shapes.icosphere(2)
    return ColoredMesh(name, color, vertices + shift, faces)


def test_bodies_come_back_with_names_colors_and_places(tmp_path):
    bodies = (ball(), ball("Other", (0.0, 1.0, 0.2), 5.0))
    write_3mf(tmp_path / "it.3mf", [Assembly("Both", bodies), Assembly("One", (ball(shift=-3.0),))])
    found, places = read_3mf(tmp_path / "it.3mf")
    assert [(body.name, body.color) for body in found] == [("Ball", "#FF8000"), ("Other", "#00FF33"),
                                                          ("Ball", "#FF8000")]
    for body, written in zip(found, (*bodies, ball(shift=-3.0)), strict=True):
        assert body.vertices == pytest.approx(written.vertices, rel=1e-8)
        assert (body.triangles == written.triangles).all()
    low = -3.0 + shapes.icosphere(2)[0].min(axis=0)
    assert places == pytest.approx(np.stack([-low, -low]))


@pytest.mark.parametrize("name", ["<&>\"'", "tab\tand\nline", "null\0 bell\x07 \ud800", "Kopf ü 頭 🙂", ""])
def test_names_of_any_letters(tmp_path, name):
    write_3mf(tmp_path / "it.3mf", [Assembly(name, (ball(name),))])
    (body,), _ = read_3mf(tmp_path / "it.3mf")
    assert body.name == "".join(letter for letter in name if letter not in "\0\x07\ud800")


def test_what_the_format_has_no_place_for_is_left_out(tmp_path):
    flat = ColoredMesh("Flat", (0, 0, 0), np.eye(3), np.array([[0, 1, 1]]))
    vertices, faces = shapes.icosphere(1)
    more = ColoredMesh("More", (0, 0, 0), np.concatenate([[[99.0, 99, 99]], vertices]),
                       np.append(faces + 1, [[5, 5, 6]], 0))
    write_3mf(tmp_path / "it.3mf", [Assembly("Whole", (flat, more)), Assembly("Nothing", (flat,))])
    (body,), places = read_3mf(tmp_path / "it.3mf")
    assert (len(body.vertices), len(body.triangles), len(places)) == (len(vertices), len(faces), 1)


def test_the_same_bodies_give_the_same_bytes(tmp_path):
    for name in ("a", "b"):
        write_3mf(tmp_path / name, [Assembly("Whole", (ball(), ball("Other")))])
    assert (tmp_path / "a").read_bytes() == (tmp_path / "b").read_bytes()


@pytest.mark.parametrize("size", [1e-12, 1e12])
def test_numbers_of_any_size(tmp_path, size):
    vertices, faces = shapes.icosphere(1)
    write_3mf(tmp_path / "it.3mf", [Assembly("Whole", (ColoredMesh("Ball", (0, 0, 0), size * vertices, faces),))])
    (body,), _ = read_3mf(tmp_path / "it.3mf")
    assert body.vertices == pytest.approx(size * vertices, rel=1e-8, abs=1e-8 * size)

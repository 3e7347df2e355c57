# SPDX-License-Identifier: GPL-3.0-or-later
"""Pictures: what is in front is seen, nothing is missed, and a shape fills what its outline says."""

import tracemalloc
import warnings
import zlib

import numpy as np
import pytest
import shapes

from core import decompose
from core.mesh.triangles import TriMesh
from core.uses import pictures
from core.uses.pictures import picture, png

RED, BLUE = (1.0, 0.0, 0.0), (0.0, 0.0, 1.0)


def hue(image):
    """Per pixel 0 for the background, 1 for red, 2 for blue."""
    red, green, blue = image.astype(int).transpose(2, 0, 1)
    return np.where(green == 255, 0, np.where(red > blue, 1, 2))


def test_a_ball_fills_its_disc_without_holes():
    mesh = TriMesh(*shapes.icosphere(4))
    seen = hue(picture(mesh, np.tile(RED, (mesh.n_faces, 1)), 100)) > 0
    radius = 0.94 * 100 / 2
    x, y = np.meshgrid(np.arange(100) - 50, np.arange(100) - 49)
    distance = np.hypot(x, y)
    assert seen[distance < radius - 1].all()
    assert not seen[distance > radius + 1].any()


@pytest.mark.parametrize("up", ["y", "z"])
@pytest.mark.parametrize("chunk", [500, pictures.CHUNK])
def test_of_two_balls_the_one_in_front_is_seen_whole(up, chunk, monkeypatch):
    monkeypatch.setattr(pictures, "CHUNK", chunk)
    ball = shapes.icosphere(2)
    toward = pictures._tilted(pictures.UPRIGHT[up], -1.0)[2]
    both = TriMesh(*shapes.together(shapes.moved(ball, 5 * toward), ball))
    color = np.repeat([RED, BLUE], len(ball.faces), axis=0)
    assert set(hue(picture(both, color, 60, up)).ravel().tolist()) == {0, 1}
    swapped = TriMesh(*shapes.together(shapes.moved(ball, -5 * toward), ball))
    assert set(hue(picture(swapped, color, 60, up)).ravel().tolist()) == {0, 2}


@pytest.mark.parametrize("chunk", [300, pictures.CHUNK])
def test_of_any_triangles_each_pixel_shows_the_nearest_one_that_it_lies_in(chunk, monkeypatch):
    """By the barycentric coordinates of all pixels in all triangles, some of them slender, some beyond the picture."""
    monkeypatch.setattr(pictures, "CHUNK", chunk)
    rng, size, rows = np.random.default_rng(4), 50, range(10, 45)
    place, height = rng.uniform(-20, 70, (60, 3, 2)), rng.uniform(-9, 9, (60, 3))
    place[::2, 2] = place[::2, 0] + 0.02 * (place[::2, 2] - place[::2, 1])
    row, column = np.mgrid[rows.start:rows.stop, :size].reshape(2, -1)
    corners = np.concatenate([place.transpose(0, 2, 1), np.ones((60, 1, 3))], axis=1)
    weight = np.linalg.solve(corners, np.stack([column, row, np.ones(len(row))])[None])
    depth = np.where((weight >= 0).all(axis=1), (weight * height[:, :, None]).sum(axis=1), -np.inf)
    expected = np.where(np.isfinite(depth.max(axis=0)), depth.argmax(axis=0), -1)
    np.testing.assert_array_equal(pictures._nearest_faces(place, height, rows, size), expected)
    assert len(set(expected.tolist())) > 30


@pytest.mark.parametrize(("up", "axis"), [("y", 1), ("z", 2)])
def test_what_is_up_is_up(up, axis):
    mesh = TriMesh(*shapes.icosphere(3))
    color = np.where(mesh.face_centroids[:, [axis]] > 0, RED, BLUE)
    rows = hue(picture(mesh, color, 80, up))
    assert (rows[:30] != 2).all()
    assert (rows[:30] == 1).any()


def test_the_order_of_the_faces_and_of_the_vertices_is_of_no_account():
    shape = shapes.tube_tree(step=0.2)
    mesh = TriMesh(*shape)
    other, _, face = shapes.shuffled(shape, np.random.default_rng(1))
    color = np.random.default_rng(2).random((mesh.n_faces, 3))
    first, second = picture(mesh, color, 60, "y"), picture(TriMesh(*other), color[face], 60, "y")
    # On an edge between two faces either may be seen.
    assert (first != second).any(axis=2).mean() < 0.005


def test_a_png_holds_the_image():
    image = np.random.default_rng(0).integers(0, 256, (5, 7, 3)).astype(np.uint8)
    data = png(image)
    assert data[16:24] == (7).to_bytes(4, "big") + (5).to_bytes(4, "big")
    rows = np.frombuffer(zlib.decompress(data[data.index(b"IDAT") + 4:data.index(b"IEND") - 8]), np.uint8)
    assert (rows.reshape(5, 22)[:, 1:].reshape(5, 7, 3) == image).all()


def test_large_pictures_are_drawn_in_bands_and_are_the_same(monkeypatch):
    shape = shapes.tube_tree(step=0.2)
    mesh, graph = TriMesh(*shape), decompose(*shape).graph
    color = np.random.default_rng(0).random((mesh.n_faces, 3))
    whole = picture(mesh, color, 90, "y", graph, fine=2)
    monkeypatch.setattr(pictures, "CHUNK", 180 * 2 * 7)  # seven rows, which leaves six
    assert np.array_equal(picture(mesh, color, 90, "y", graph, fine=2), whole)


def test_memory_does_not_grow_with_the_picture(monkeypatch):
    monkeypatch.setattr(pictures, "CHUNK", 100_000)
    mesh = TriMesh(*shapes.icosphere(2))
    tracemalloc.start()
    try:
        image = picture(mesh, np.tile(RED, (mesh.n_faces, 1)), 1000, "y", fine=2)
        most = tracemalloc.get_traced_memory()[1]
    finally:
        tracemalloc.stop()
    assert most < image.nbytes + 60e6  # four million pixels at once take 160 MB and more


def test_faces_without_area_give_no_warning():
    vertices, faces = shapes.icosphere(1)
    flat = np.vstack([faces, [[0, 0, 1], [0, 1, 1], [2, 2, 2]]])
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        seen = picture(TriMesh(vertices, flat), np.tile(RED, (len(flat), 1)), 40)
    assert (seen == picture(TriMesh(vertices, faces), np.tile(RED, (len(faces), 1)), 40)).all()

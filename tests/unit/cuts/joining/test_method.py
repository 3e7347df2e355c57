# SPDX-License-Identifier: GPL-3.0-or-later
"""Parts over several pieces: of shells that touch, of bodies far apart, of a mesh that was taken apart."""

from itertools import pairwise
from types import SimpleNamespace

import numpy as np
import pytest
import shapes

from core import Parameters, TriMesh, decompose
from core.arrays.components import components
from core.cuts.hierarchy import Hierarchy
from core.cuts.joining import method
from core.cuts.joining.distant import DistantPairs
from core.cuts.joining.linkage import JudgedPairs
from core.cuts.joining.method import JoinModel, fine_parts, join_model, join_parts, near_odds
from core.metrics import rand_index_error


def shells(shape, label):
    """Each group of faces with vertices of its own, a little apart: nothing is joined again."""
    center = shape.vertices[shape.faces].mean(axis=1)
    found = []
    for k in range(label.max() + 1):
        used, faces = np.unique(shape.faces[label == k], return_inverse=True)
        middle = center[label == k].mean(axis=0)
        found.append(shapes.Shape(middle + 0.999 * (shape.vertices[used] - middle), faces.reshape(-1, 3)))
    return shapes.together(*found)


def pieces_of(name):
    """A shape, its faces in the order of its pieces, and these as shells."""
    shape = {"dumbbell": shapes.dumbbell, "tree": shapes.tube_tree}[name]()
    center = shape.vertices[shape.faces].mean(axis=1)
    if name == "dumbbell":
        label = (center[:, 2] > 0).astype(int)
    else:
        label = decompose(*shape).parts(n_parts=5).labels
    order = np.argsort(label, kind="stable")
    shape = shapes.Shape(shape.vertices, shape.faces[order])
    return shape, label[order], shells(shape, label[order])


@pytest.mark.parametrize("name", ["dumbbell", "tree"])
@pytest.mark.parametrize("preset", ["Perceptual", "Berretti 2009"])
def test_a_mesh_taken_apart_and_pushed_together(name, preset):
    shape, label, apart = pieces_of(name)
    result = decompose(*apart, Parameters.preset(preset))
    assert result.graph.n_components == 1
    assert result.parts(0.0).count == 1
    edges = TriMesh(*apart).edges.pairs
    links = np.concatenate([edges, result.contacts])
    for n in range(1, min(result.n_candidates, 40) + 1):
        labels = result.parts(n_parts=n).labels
        assert np.unique(labels).tolist() == list(range(n))
        same = links[labels[links[:, 0]] == labels[links[:, 1]]]
        assert components(len(labels), *same.T)[0] == n
    if preset == "Perceptual":
        whole = decompose(*shape)
        count = label.max() + 1
        error = rand_index_error(whole.parts(n_parts=count).labels, result.parts(n_parts=count).labels)
        assert error < 0.1


@pytest.mark.parametrize("salience", [0.2, 0.8])
def test_parts_of_large_faces_beside_a_dense_piece_join_as_the_method_of_cutting_says(salience):
    """The points that stand for the surface lie on the ball, so that none of the two halves of the plate are near."""
    plate = shapes.flat_grid(6, 6, 2.0)
    mesh = TriMesh(*shapes.together(plate, shapes.moved(shapes.icosphere(5, 0.2), (6.0, 6.0, 0.2))))
    middle = mesh.face_centroids[:, 0]
    on_plate = np.arange(mesh.n_faces) < len(plate.faces)
    label = np.where(on_plate, (middle > 6.0).astype(int), 2)
    found = Hierarchy.of(3, [(0, 1)], [salience])
    parts = fine_parts(mesh, label, found, np.zeros(mesh.n_vertices))
    assert parts.neighbors.tolist() == [[0, 1]]
    assert label[parts.neighbor_faces].tolist() == [[0, 1]]
    hierarchy, contacts = join_parts(parts, JoinModel(join_model().near, None))
    assert (hierarchy.salience_between(*np.array([[0], [1]]))[0] < 0.5) == (salience < 0.5)
    assert parts.neighbor_faces.tolist()[0] in contacts.tolist()


class Judge:
    """A model that gives pairs the shares that their first feature is."""

    def predict(self, features):
        return features[:, 0]


def known_parts(area, **more):
    """Fine parts of which only what is named is known."""
    near = dict(parts=np.array([[0, 1]]), shapes=SimpleNamespace(area=np.asarray(area, float)))
    return SimpleNamespace(candidate=np.zeros(len(area), int), pairs=SimpleNamespace(**near, **more), within=0.25)


def test_a_salience_has_its_say_in_the_odds_of_two_parts_of_one_piece():
    for same_piece, expected in ((True, 0.75 * np.log(9) + 0.25 * np.log(1 / 4)), (False, np.log(9))):
        parts = known_parts([1, 1], features=np.array([[0.9]]), salience=np.array([0.8]), same_piece=same_piece)
        assert near_odds(parts, Judge()) == pytest.approx(expected, abs=1e-3)


def test_what_is_said_of_a_pair_that_comes_near_weighs_more_than_what_is_said_of_any_pair():
    parts = known_parts([0.25, 0.36, 0.39])
    near = JudgedPairs(np.array([[0, 1]]), np.array([2.0]), np.array([0.5]), np.ones(1, bool))
    every = DistantPairs(np.array([[0, 2], [0, 1], [1, 2]]), np.array([[0.9], [0.5], [0.1]]))
    found = method._with_distant(parts, near, every, Judge())
    assert found.members.tolist() == [[0, 1], [0, 2], [1, 2]]
    assert found.score == pytest.approx([method.NEARNESS * 2 / (method.NEARNESS + 1), np.log(9), -np.log(9)], abs=1e-3)
    assert found.weight == pytest.approx([0.5 * (method.NEARNESS + 1), 0.5, 0.6])
    assert found.near.tolist() == [True, False, False]


class Equal:
    """A model that gives all pairs one share."""

    def __init__(self, share):
        self.share = share

    def predict(self, features):
        return np.full(len(features), self.share)


def balls(*radii, apart=0.0):
    """A row of balls that touch, or nearly so, and the piece of each face."""
    at = np.cumsum([0.0, *(a + b + apart for a, b in pairwise(radii))])
    row = [shapes.moved(shapes.icosphere(3, radius), (x, 0.0, 0.0)) for radius, x in zip(radii, at, strict=True)]
    return TriMesh(*shapes.together(*row)), np.repeat(np.arange(len(radii)), 1280)


def joined(mesh, label, hierarchy, share, **options):
    """The hierarchy over parts of which all pairs are one with some certainty, and the contacts."""
    parts = fine_parts(mesh, label, hierarchy, np.zeros(mesh.n_vertices), **options)
    return parts, *join_parts(parts, JoinModel(Equal(share), None))


@pytest.mark.parametrize(("share", "salience"), [(0.25, 0.75), (0.5, 0.5), (0.75, 0.5 * (0.5 + method.FINE))])
def test_a_salience_is_how_unsure_it_is_that_two_are_one(share, salience):
    _, hierarchy, contacts = joined(*balls(1.0, 1.0), Hierarchy.of(2, [], []), share)
    assert hierarchy.merges.tolist() == [[0, 1]]
    assert hierarchy.salience[0] == pytest.approx(salience, abs=1e-3)
    assert (contacts // 1280).tolist() == [[0, 1]]


def test_small_parts_are_more_often_one_with_others():
    """Even odds are multiplied by a tenth power of how many times smaller than a tenth of the area it is."""
    parts, hierarchy, _ = joined(*balls(1.0, 0.2), Hierarchy.of(2, [], []), 0.5)
    odds = (method.LARGE / parts.pairs.shapes.area.min()) ** method.EASE
    assert odds > 1.05
    assert hierarchy.salience[0] == pytest.approx(
        np.interp(odds / (1 + odds), [0.5, 1.0], [0.5, method.FINE]), abs=1e-3)


def test_contacts_are_where_pieces_touch_and_where_parts_merge():
    """Of three balls in a ring two merges join all; the third two touch as well, but not where all are apart."""
    ball, corner = shapes.icosphere(3), 2.0 * np.array([(0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (0.5, np.sqrt(0.75), 0.0)])
    for size, count in ((1.0, 3), (1.02, 2)):
        mesh = TriMesh(*shapes.together(*(shapes.moved(ball, size * at) for at in corner)))
        _, _, contacts = joined(mesh, np.repeat(np.arange(3), 1280), Hierarchy.of(3, [], []), 0.5)
        assert len(contacts) == count
        assert (contacts[:, 0] // 1280 != contacts[:, 1] // 1280).all()


@pytest.mark.parametrize(("learned", "salience", "count"), [
    (True, 0.05, 2), (True, 0.07, 3), (False, 0.19, 2), (False, 0.21, 3)])
def test_candidates_of_a_piece_are_together_below_a_salience(learned, salience, count):
    mesh, label = balls(1.0, 1.0)
    label = np.where((label == 0) & (mesh.face_centroids[:, 2] > 0), 2, label)
    parts, hierarchy, _ = joined(mesh, label, Hierarchy.of(3, [(0, 2)], [salience]), 0.5, learned=learned)
    assert len(parts.candidate) == count
    assert parts.within == (method.WITHIN if learned else 0.0)
    assert hierarchy.n_loose == 1
    assert (hierarchy.salience[0] == salience) == (count == 2)


def test_two_far_spheres():
    result = decompose(*shapes.two_spheres(3))
    assert result.parts(0.0).count == 1
    assert [result.parts(n_parts=n).count for n in range(1, result.n_candidates + 1)] == list(
        range(1, result.n_candidates + 1))
    assert result.parts(0.002).count == result.parts().count == 2
    assert result.contacts.shape == (1, 2)
    assert (result.contacts[0] < 1280).sum() == 1  # a face of each


def jointed_figure():
    """Eleven balls drawn out, that run into each other: trunk, head, shoulders, and four limbs of two each."""
    def drawn(center, radii):
        ball = shapes.icosphere(3)
        return shapes.Shape(ball.vertices * radii + center, ball.faces)

    pieces = [drawn((0, 0, 0), (0.5, 0.35, 0.7)), drawn((0, 0, 1), (0.28, 0.28, 0.3)),
              drawn((0, 0, 0.62), (0.85, 0.14, 0.14))]
    for side in (1, -1):
        pieces += [drawn((0.95 * side, 0, 0.25), (0.14, 0.14, 0.42)), drawn((side, 0, -0.45), (0.11, 0.11, 0.36)),
                   drawn((0.25 * side, 0, -1), (0.17, 0.17, 0.45)), drawn((0.27 * side, 0, -1.75), (0.13, 0.13, 0.42))]
    return shapes.together(*pieces), np.repeat(np.arange(len(pieces)), 1280)


@pytest.mark.parametrize("seed", [None, 1])
def test_limbs_of_a_jointed_figure_stay_apart_though_they_touch_the_same_shoulders(seed):
    shape, piece = jointed_figure()
    if seed is not None:
        rng = np.random.default_rng(seed)
        shape, _, face = shapes.shuffled(shapes.Shape(shape.vertices @ shapes.rotation(rng), shape.faces), rng)
        piece = piece[face]
    result = decompose(*shape)
    bodies = [(0,), (3, 4), (5, 6), (7, 8), (9, 10)]  # the trunk, and the limbs
    for detail in (0.4, 0.5, 0.6):
        labels = result.parts(detail).labels
        of_piece = [np.unique(labels[piece == k]).tolist() for k in range(11)]
        assert all(len(parts) == 1 for parts in of_piece)
        of_body = [{of_piece[k][0] for k in body} for body in bodies]
        assert sum(map(len, of_body)) == len(set.union(*of_body))  # no two have a part in common

# SPDX-License-Identifier: GPL-3.0-or-later
"""Parts of posed figures are symmetric, though no plane mirrors these; and which planes are beyond doubt."""

import numpy as np
import pytest
import shapes

from core import Parameters, decompose
from core.mesh.polygons import PolygonMesh
from core.mesh.triangles import TriMesh
from core.parameters import METHODS
from core.result.decomposition import Decomposition
from core.result.numbering import Numbering
from core.surface.preparation import bodies, repair
from core.symmetry.mirrors import Mirror


@pytest.fixture(scope="module")
def posed():
    vertices, faces = shapes.mirrored_figure()
    return shapes.posed(vertices), faces


@pytest.mark.parametrize("method", METHODS)
def test_parts_of_a_posed_figure_are_exactly_symmetric_at_every_detail(posed, method):
    result = decompose(*posed, parameters=Parameters(method=method))
    twin = result.face_twin
    assert result.plane is None
    assert (twin >= 0).all()
    for detail in np.linspace(0.1, 1.0, 10):
        labels = result.parts(detail=detail).labels
        pairs = np.unique(np.stack([labels, labels[twin]]), axis=1)
        assert len(pairs.T) == labels.max() + 1  # each part has one image, a part


def test_parts_on_both_sides_are_named_by_side(posed):
    vertices, faces = shapes.mirrored_figure()
    result = decompose(*posed)
    nothing = np.full(result.n_candidates, -1)
    numbered = Numbering.of(result, nothing, np.zeros(0, np.int64)).parts(0.5)
    names, labels = np.array(numbered.names), numbered.parts.labels
    middle = np.bincount(labels, vertices[faces].mean(axis=1)[:, 0]) / np.bincount(labels)
    ends = np.array([name[-2:] for name in names])
    assert ((ends == ".L") == (middle > 0.2)).all()
    assert ((ends == ".R") == (middle < -0.2)).all()
    assert (ends == ".L").sum() == (ends == ".R").sum() >= 2


def test_the_symmetry_of_a_pose_is_stored(posed):
    result = decompose(*posed)
    again = Decomposition.from_bytes(result.to_bytes())
    assert np.array_equal(again.face_twin, result.face_twin)
    assert np.array_equal(again.face_side, result.face_side)
    assert again.plane is None


def test_without_symmetry_nothing_has_a_twin(posed):
    assert len(decompose(*posed, parameters=Parameters(symmetry=False)).face_twin) == 0


@pytest.mark.parametrize("divided", [False, True])
def test_a_figure_whose_front_is_the_image_of_its_back_is_named_by_side(divided):
    """Also where its quads are divided along one diagonal or the other, so that the faces are no exact images."""
    solid = np.zeros((16, 2, 14), bool)
    solid[6:10] = True
    solid[:, :, 10:12] = True  # the arms
    vertices, faces = shapes.blocks(solid)
    if divided:
        turned = np.where(np.random.default_rng(0).random((len(faces), 1)) < 0.5, np.roll(faces, 1, axis=1), faces)
        faces = turned[:, [0, 1, 2, 0, 2, 3]].reshape(-1, 3)
    result = decompose(vertices, faces)
    parts, middle = result.parts(), vertices[faces].mean(axis=1)[:, 0]
    assert np.abs(result.plane.normal) == pytest.approx([1, 0, 0])
    assert set(parts.side[parts.labels[np.abs(middle) > 4]].tolist()) == {-1, 1}
    assert (parts.side[parts.labels] * np.sign(middle) >= 0).all()


@pytest.mark.parametrize("count", [3, 5, 8])
def test_a_face_of_a_star_lies_as_far_beside_as_no_image_of_it(count):
    vertices, faces = shapes.prism_of_rays(count)
    (body,) = bodies(repair(PolygonMesh.of(vertices, faces)), True, 0.01).decomposed
    mirror = Mirror.of(body.mesh, body.polygon, len(faces))
    image = mirror.group.image
    assert len(image) == 4 * count
    apart = np.abs(mirror.beside - mirror.beside[image[1:]])
    assert apart[image[1:] != np.arange(len(faces))].min() > 1e-3 * np.ptp(mirror.beside)


@pytest.mark.parametrize(("lump", "least", "most"), [(0.0, 1.0, 1.0), (0.34, 0.95, 0.99), (0.4, 0.85, 0.95)])
def test_nothing_found_speaks_against_a_plane_that_mirrors_nearly_all(lump, least, most):
    """A figure with a lump on one hand: none of its faces has an exact image any more, but most have one."""
    vertices, faces = shapes.mirrored_figure()
    beside = vertices - vertices[vertices[:, 0].argmax()]
    swollen = vertices + lump * beside * np.exp(-(beside**2).sum(axis=1, keepdims=True) / (4 * lump**2 + 1e-9))
    uneven = (lump > 0) * 1e-3 * np.sin(50 * vertices)
    mirror = Mirror.of(TriMesh(swollen + uneven, faces), np.arange(len(faces)), len(faces))
    assert least <= round(mirror.share, 6) <= most
    assert (mirror.exact, mirror.sure) == (lump == 0, least >= 0.95)

"""Half models completed by their images: the parts of the whole, which is the image of which, and their sides."""

import numpy as np
import pytest
import shapes
from results import same_partition

from core import decompose
from core.mesh.corners import CornerTable
from core.mesh.polygons import PolygonMesh
from core.result.whole import whole_of
from core.symmetry.halves import completed, completed_table, open_sides
from core.symmetry.plane import MirrorPlane

X = np.array([1.0, 0, 0, 0])


def whole(half, plane=X, **level):
    """A half model completed, and its result."""
    result = decompose(*half, mirror=plane)
    table, graph = CornerTable.of(*half), result.graph
    area = np.linalg.norm(table.face_vectors(), axis=1)
    return whole_of(result.parts(**level), table, area, np.array(plane, float), graph.node_position,
                    graph.point_position), result


@pytest.mark.parametrize("sign", [1, -1])
def test_a_figure(sign):
    """Body and head are whole, arms and legs are there twice; its plane may look to either side."""
    half = shapes.half_of(shapes.mirrored_figure())
    found, result = whole(half, sign * X)
    parts, given, count = found.parts, result.parts(), len(half.faces)
    assert (given.count, parts.count) == (4, 6)
    expected = completed(PolygonMesh.of(*half), X)
    assert same_partition(parts.labels, decompose(expected.vertices, expected.triangles).parts().labels)
    np.testing.assert_array_equal(parts.labels[:count], given.labels)
    np.testing.assert_array_equal(parts.twin[parts.labels[:count]], parts.labels[count:])
    assert parts.twin[parts.twin].tolist() == list(range(6))
    across = found.table.face_means(found.table.vertices)[:, 0]
    for part in range(6):
        mine = across[parts.labels == part]
        assert parts.side[part] == (0 if mine.min() < 0 < mine.max() else np.sign(mine.mean()))
    assert parts.area.sum() == pytest.approx(2 * given.area.sum(), rel=1e-3)
    low, high = found.table.edge_labels(parts.labels)
    assert {tuple(cut) for cut in parts.cuts.tolist()} == set(zip(low[low < high], high[low < high], strict=True))
    # A node is in a part of its side.
    side = np.sign(result.graph.node_position[:, 0]) * parts.side[parts.node_part]
    assert (side >= 0).all()


def test_a_part_that_meets_its_image_along_little_is_there_twice():
    """As legs do that touch at the thighs: here a figure that is said to have a very large surface."""
    half = shapes.half_of(shapes.mirrored_figure())
    result = decompose(*half, mirror=X)
    one, table, graph = result.parts(0.0), CornerTable.of(*half), result.graph
    counts = [whole_of(one, table, area * np.linalg.norm(table.face_vectors(), axis=1), X, graph.node_position,
                       graph.point_position).parts for area in (1, 1e6)]
    assert [parts.count for parts in counts] == [1, 2]
    assert counts[1].cuts.tolist() == [[0, 1]]


@pytest.mark.parametrize("shape", [
    (shapes.box_quads()[0] + 1.0, shapes.box_quads()[1]), shapes.half_of(shapes.torus())])
def test_corner_by_corner_as_by_triangles(shape):
    """The box has no border: nothing of it is joined."""
    given = CornerTable.of(*shape)
    table, image = completed_table(given, MirrorPlane(X[:3], 0.0))
    expected = completed(PolygonMesh.of(*shape), X)
    np.testing.assert_array_equal(table.vertices, expected.vertices)
    middle = table.face_means(table.vertices)
    np.testing.assert_allclose(middle[given.n_faces :], middle[: given.n_faces] * (-1, 1, 1), atol=1e-12)
    vectors = table.face_vectors()
    np.testing.assert_allclose(vectors[given.n_faces :], vectors[: given.n_faces] * (-1, 1, 1), atol=1e-12)
    assert (np.bincount(table.corner_edge) == 2).all()
    np.testing.assert_array_equal(table.edges[table.corner_edge],
                                  np.sort([table.corner_vertex, table.corner_vertex[table.next_corner]], axis=0).T)
    np.testing.assert_allclose(table.vertices[image], given.vertices * (-1, 1, 1), atol=1e-12)


def test_what_closes_a_half_in_the_plane_does_not_part_it_from_its_image():
    vertices, quads = shapes.box_quads()
    half, mirror = CornerTable.of(vertices, quads), MirrorPlane(X[:3], 0.0)
    inside = (vertices[quads][:, :, 0] == 0).all(axis=1)
    table, image = completed_table(half, mirror)
    _, expected = completed_table(CornerTable.of(vertices, quads[~inside]), mirror)
    assert (image == expected).all()
    beside = np.tile(~inside, 2)[table.corner_face]
    assert (np.bincount(table.corner_edge[beside], minlength=len(table.edges)) == 2).all()
    assert open_sides(half, mirror).sum() == inside.sum() * 4 == 4


def test_whole_models_have_no_contacts_of_the_half():
    """Their faces are others."""
    half = shapes.half_of(shapes.mirrored_figure())
    ball = shapes.icosphere(1)
    lowest = half.vertices[half.vertices[:, 0].argmax()]
    both = shapes.together(half, shapes.moved(ball, lowest - ball.vertices[ball.vertices[:, 0].argmin()]))
    found, result = whole(both)
    assert len(result.contacts)
    assert found.parts.decomposition.contacts.shape == (0, 2)

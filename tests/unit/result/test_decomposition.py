# SPDX-License-Identifier: GPL-3.0-or-later
"""The result: parts at any detail, in a lasting order, and the same after storing."""

import io
import json
from dataclasses import fields, replace

import numpy as np
import pytest
import shapes
from decompositions import decomposition_of

from core.cuts.hierarchy import Hierarchy
from core.errors import ParameterError, ReebError
from core.graph.reeb import ReebGraph
from core.mesh.face_graph import FaceGraph
from core.mesh.triangles import TriMesh
from core.parameters import Parameters
from core.pipeline import decompose
from core.result.decomposition import Decomposition


def row():
    """Seven faces in a row, four candidates: 0 1 1 2 2 2 3, merged 2-3, then 0-1, then all."""
    return decomposition_of(
        [0, 1, 1, 2, 2, 2, 3], [1.0, 2.0, 6.0, 1.0], [(0, 1), (1, 2), (2, 3)], [0.5, 1.5, 2.5],
        [(2, 3), (0, 1), (1, 2)], [0.2, 0.4, 0.9], 5, vertex_candidates=np.array([0, 1, 2, 3, -1], np.int64),
        contacts=np.array([(0, 3)], np.int64), notes=("odd",), seconds={"mesh": 0.1})


@pytest.fixture(scope="module")
def tree():
    return decompose(*shapes.tube_tree(step=0.2), parameters=Parameters.preset("Berretti 2009", small_region=0.01))


def test_a_row_by_hand():
    result = row()
    # Detail 0.7 keeps salience 0.3 and above. The largest part comes first, then the order of faces.
    parts = result.parts(detail=0.7)
    assert parts.labels.tolist() == [1, 2, 2, 0, 0, 0, 0]
    assert parts.vertex_labels.tolist() == [1, 2, 0, 0, -1]
    assert parts.area.tolist() == [7, 1, 2]
    assert parts.share.tolist() == [0.7, 0.1, 0.2]
    assert parts.cuts.tolist() == [[0, 2], [1, 2]]
    assert parts.cut_length.tolist() == [1.5, 0.5]
    assert parts.cut_salience.tolist() == [0.9, 0.4]
    assert parts.names == ("Part 01", "Part 02", "Part 03")
    assert parts.names is parts.names  # made anew for each part, the names of 2,000 parts took 30 s in one .glb
    assert result.parts(n_parts=2).labels.tolist() == [1, 1, 1, 0, 0, 0, 0]
    assert result.parts(n_parts=4).labels.tolist() == [1, 2, 2, 0, 0, 0, 3]
    assert result.parts(n_parts=1).labels.tolist() == [0] * 7
    assert result.parts(n_parts=9).count == 4


def test_each_is_a_line_in_a_notebook(tree):
    """All arrays of a result were 39,000 characters."""
    assert repr(row().parts(n_parts=3)) == "<Parts: 3 of 7 faces>"
    assert repr(row().hierarchy) == "<Hierarchy: 4 candidates, 3 merges>"
    assert repr(row()) == "<Decomposition by perceptual: 7 faces, 2 parts, 0 nodes, 0 arcs, 0 loops>"
    assert repr(TriMesh(*shapes.octahedron())) == "<TriMesh: 6 vertices, 8 faces>"
    assert repr(tree.graph) == f"<ReebGraph: {tree.graph.n_nodes} nodes, {tree.graph.n_arcs} arcs, 0 loops>"
    assert len(repr(tree)) < 120


def test_without_either_the_parameters_decide():
    result = row()
    assert result.parts().count == result.parts(detail=0.5).count
    assert replace(result, parameters=Parameters(detail=0.0)).parts().count == 1
    assert replace(result, parameters=Parameters(n_parts=3)).parts().count == 3
    # A detail that is asked for beats the number in the parameters.
    assert replace(result, parameters=Parameters(n_parts=3)).parts(detail=1.0).count == 4


@pytest.mark.parametrize("asked", [{"detail": 1.5}, {"detail": float("nan")}, {"n_parts": -1}, {"n_parts": 2.5}])
def test_out_of_range(asked):
    with pytest.raises(ParameterError):
        row().parts(**asked)


@pytest.mark.parametrize("make", [shapes.icosphere, lambda: shapes.tube_tree(step=0.2)])
def test_lengths_are_float64_where_there_are_none_too(make):
    result = decompose(*make())
    whole = result.parts(n_parts=1)
    assert whole.cuts.shape == (0, 2)
    for lengths in (whole.cut_length, whole.cut_salience, result.graph.point_length, result.candidate_pair_length):
        assert lengths.dtype == np.float64


def test_any_grouping():
    parts = row().group(np.array([7, 3, 3, 7]))  # candidates 0 and 3 do not touch
    assert parts.labels.tolist() == [1, 0, 0, 0, 0, 0, 1]
    assert parts.cuts.tolist() == [[0, 1]]
    assert parts.cut_length.tolist() == [3]


def test_parts_that_only_a_link_joins_do_not_touch():
    """Candidates 0 and 1 share an edge without a length, 1 and 2 a link and then a contact, too, 2 and 3 a link."""
    result = replace(row(), candidate_pair_length=np.zeros(3), contacts=np.array([(2, 4), (5, 6)]),
                     links=np.array([(2, 4), (5, 6)]))
    assert result.pair_touches.tolist() == [True, False, False]  # each link is a contact, too
    result = replace(result, contacts=np.array([(1, 3), (2, 4), (5, 6)]))
    assert result.pair_touches.tolist() == [True, True, False]
    with_edges = replace(result, candidate_pair_length=row().candidate_pair_length)
    assert with_edges.pair_touches.all()  # however many links there are beside an edge
    parts = result.parts(n_parts=4)
    assert parts.cuts.tolist() == [[0, 2], [0, 3], [1, 2]]  # of candidates 2 and 1, 2 and 3, 0 and 1
    assert parts.cut_touches.tolist() == [True, False, True]


@pytest.mark.parametrize("rounding", [-1e-15, 0.0, 1e-15, 1e-7])
def test_of_two_parts_as_large_as_each_other_the_first_is_part_0_in_every_pose(rounding):
    result = replace(row(), candidate_area=np.array([1.0, 2.0, 6.0, 6.0 * (1 + rounding)]))
    assert result.parts(n_parts=4).labels.tolist() == [1, 2, 2, 0, 0, 0, 3]


@pytest.mark.parametrize("groups", [[0], np.zeros(10_000, int), np.zeros((3, 2), int), "x", [0.5, 1, 2], None, 7])
def test_a_grouping_that_is_none_is_refused(groups, tree):
    with pytest.raises(ParameterError, match=r"Groups must be \d+ whole numbers, one for each candidate."):
        tree.group(groups)


def test_every_number_of_parts(tree):
    for n in range(tree.hierarchy.n_loose, tree.n_candidates + 1):
        parts = tree.parts(n_parts=n)
        assert parts.count == n
        assert np.unique(parts.labels).tolist() == list(range(n))
        np.testing.assert_array_equal(parts.candidate_part[tree.candidates], parts.labels)
        assert parts.area.argmax() == 0
        first = [np.flatnonzero(parts.labels == i).mean() for i in range(1, n)]
        assert first == sorted(first)
        assert parts.share.sum() == pytest.approx(1)
        assert len(parts.names) == n
        assert parts.node_part.shape == (tree.graph.n_nodes,)
        assert parts.arc_part.shape == (tree.graph.n_arcs,)
        assert parts.point_part.shape == tree.graph.point_value.shape


def test_a_cut_at_some_detail_is_as_salient_as_that_detail_needs(tree):
    for detail in (0.3, 0.5, 0.8):
        parts = tree.parts(detail=detail)
        assert (parts.cut_salience >= 1 - detail - 1e-9).all()
    assert (tree.parts(n_parts=2).cut_salience == tree.hierarchy.salience[-1]).all()


def test_arcs_lie_in_the_part_of_most_of_their_points(tree):
    parts = tree.parts()
    for arc in range(tree.graph.n_arcs):
        inside = parts.point_part[tree.graph.arc_points[arc]: tree.graph.arc_points[arc + 1]]
        assert (inside == parts.arc_part[arc]).sum() == np.bincount(inside).max()


def assert_equal(one, two):
    for item in fields(Decomposition):
        a, b = getattr(one, item.name), getattr(two, item.name)
        if isinstance(a, np.ndarray):
            assert a.dtype == b.dtype
            np.testing.assert_array_equal(a, b)
        elif item.name not in ("hierarchy", "graph"):
            assert a == b
    for name in ("merges", "salience", "n_candidates", "n_loose"):
        np.testing.assert_array_equal(getattr(one.hierarchy, name), getattr(two.hierarchy, name))
    for item in fields(ReebGraph):
        a, b = getattr(one.graph, item.name), getattr(two.graph, item.name)
        assert type(a) is type(b)
        np.testing.assert_array_equal(a, b)


@pytest.mark.parametrize("make", [
    row, lambda: decompose(*shapes.icosphere(1)), lambda: decompose(*shapes.crumbs(30)),
    lambda: decompose(*shapes.with_unused_vertices(shapes.two_spheres()))])
def test_stored_and_read_back(make, tree):
    for result in (make(), tree):
        again = Decomposition.from_bytes(result.to_bytes())
        assert_equal(result, again)
        np.testing.assert_array_equal(result.parts().labels, again.parts().labels)
        assert_equal(again, Decomposition.from_bytes(again.to_bytes()))


def test_contacts_are_stored_and_what_was_stored_without_them_opens():
    result = decompose(*shapes.two_spheres())
    assert result.contacts.shape == (1, 2)
    data = result.to_bytes()
    np.testing.assert_array_equal(Decomposition.from_bytes(data).contacts, result.contacts)
    with np.load(io.BytesIO(data)) as stored:
        arrays = {name: stored[name] for name in stored.files if name != "contacts"}
    stream = io.BytesIO()
    np.savez_compressed(stream, **arrays)
    former = Decomposition.from_bytes(stream.getvalue())
    assert former.contacts.shape == (0, 2)
    np.testing.assert_array_equal(former.parts().labels, result.parts().labels)


def test_what_another_version_stored_is_refused():
    data = row().to_bytes()
    with np.load(io.BytesIO(data)) as stored:
        arrays = dict(stored)
    head = json.loads(arrays["head"].tobytes())
    arrays["head"] = np.frombuffer(json.dumps(head | {"format": 99}).encode(), np.uint8)
    stream = io.BytesIO()
    np.savez(stream, **arrays)
    with pytest.raises(ReebError, match="another version. Decompose again"):
        Decomposition.from_bytes(stream.getvalue())


def test_sizes(tree):
    assert tree.n_faces == len(shapes.tube_tree(step=0.2).faces)
    assert tree.n_vertices == len(shapes.tube_tree(step=0.2).vertices)
    assert tree.n_candidates == tree.candidates.max() + 1


def test_a_result_stored_by_the_first_version_has_its_parameters():
    with np.load(io.BytesIO(row().to_bytes())) as stored:
        arrays = {name: stored[name] for name in stored.files}
    head = json.loads(arrays["head"].tobytes())
    now = head["parameters"]
    then = {name: value for name, value in now.items() if name in {"method", "detail", "sigma"}}
    head["parameters"] = then | {"levels": 80, "alpha": 0.25, "equalise": False}
    arrays["head"] = np.frombuffer(json.dumps(head).encode(), np.uint8)
    stream = io.BytesIO()
    np.savez_compressed(stream, **arrays)
    parameters = Decomposition.from_bytes(stream.getvalue()).parameters
    assert parameters == Parameters(
        **then, pieces="separate", symmetry=False, n_slabs=80, concavity_weight=0.25, band_ratio=0.25, equalize=False)


def test_a_twin_is_the_twin_of_its_twin():
    result = decompose(*shapes.mirrored_figure())
    rng = np.random.default_rng(0)
    grouped = [result.group(rng.integers(0, 5, result.n_candidates)) for _ in range(20)]
    for parts in (*(result.parts(n_parts=n + 1) for n in range(result.n_candidates)), *grouped):
        has = np.flatnonzero(parts.twin >= 0)
        np.testing.assert_array_equal(parts.twin[parts.twin[has]], has)


@pytest.mark.parametrize("seed", range(3))
def test_contacts_are_between_faces_that_are_near_in_any_order_of_the_faces(seed):
    tower = shapes.subdivide(shapes.subdivide(shapes.box((1.0, 1.0, 3.0))))
    beam = shapes.moved(shapes.subdivide(shapes.box((3.0, 0.5, 0.5))), (1.0, 0.2, 1.0))
    vertices, faces = shapes.together(tower, beam)
    faces = np.random.default_rng(seed).permutation(faces)
    contacts = decompose(vertices, faces).contacts
    assert len(contacts)
    corners = vertices[faces]
    longest = np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=2).max()
    apart = np.linalg.norm(np.diff(corners.mean(axis=1)[contacts], axis=1), axis=2)
    assert apart.max() < longest + 0.03 * np.ptp(vertices, axis=0).max()


def test_twins_are_on_the_side_of_their_faces():
    """Seven faces in a row, mirrored in the middle one: candidates 0 and 3 are images of each other, and 1 and 2."""
    result = replace(row(), candidates=np.array([0, 1, 1, 1, 2, 2, 3]), face_twin=np.arange(7)[::-1],
                     face_side=np.array([1, 1, 1, 0, -1, -1, -1], np.int8), mirror=np.array([1.0, 0, 0, 0]))
    parts = result.group(np.arange(4))
    place = parts.candidate_part
    assert parts.twin[place].tolist() == place[[3, 2, 1, 0]].tolist()
    assert parts.side[place].tolist() == [1, 1, -1, -1]
    assert result.group(np.array([0, 1, 1, 2])).side.sum() == 0  # the middle is its own image


def test_of_several_pairs_in_a_cut_the_most_salient_counts():
    """Candidates 0, 1 and 2, 3 are two parts, which touch by 0 and 2, 0.9, and by 1 and 3, 0.4, or the other way."""
    for pairs in ([(0, 2), (1, 3)], [(1, 3), (0, 2)]):
        result = replace(row(), candidate_pairs=np.array(pairs), candidate_pair_length=np.array([1.0, 2.0]),
                         hierarchy=Hierarchy.of(4, [(1, 3), (0, 2), (0, 1)], [0.4, 0.9, 0.95]))
        assert result.group(np.array([0, 0, 1, 1])).cut_salience.tolist() == [0.9]


def test_areas_grow_with_the_square_of_lengths():
    larger = row().scaled(3)
    assert larger.candidate_area.tolist() == [64.0, 128.0, 384.0, 64.0]
    assert larger.candidate_pair_length.tolist() == [4.0, 12.0, 20.0]


def test_a_moved_mesh_has_its_graph_and_its_plane_elsewhere(tree):
    offset = np.array([1.0, 2.0, 3.0])
    moved = replace(tree, mirror=np.array([0.6, 0.8, 0.0, 5.0])).shifted(offset)
    assert moved.graph.node_position == pytest.approx(tree.graph.node_position + offset)
    assert moved.graph.point_position == pytest.approx(tree.graph.point_position + offset)
    assert moved.mirror == pytest.approx([0.6, 0.8, 0.0, 7.2])
    assert len(replace(tree, mirror=np.empty(0)).shifted(offset).mirror) == 0


def test_a_stretched_mesh_has_other_areas_and_lengths():
    """Candidates grow by 2, 8, 9 and 18, all by 9; of the three pairs the last has no edge, so that the root tells."""
    result, pairs = row(), np.array([(0, 1), (2, 3)])
    before = FaceGraph(7, pairs, np.ones(2), np.ones(7))
    now = FaceGraph(7, pairs, np.array([2.0, 5.0]), np.array([2.0, 8.0, 8.0, 9.0, 9.0, 9.0, 18.0]))
    larger = result.remeasured(before, now)
    assert larger.candidate_area.tolist() == [2.0, 16.0, 54.0, 18.0]
    assert larger.candidate_pair_length.tolist() == [1.0, 7.5, 7.5]


def test_radii_of_a_mesh_stretched_alike_everywhere_grow_with_it(tree):
    none = np.empty((0, 2), np.int64)
    before, now = (FaceGraph(tree.n_faces, none, np.empty(0), area * np.ones(tree.n_faces)) for area in (1.0, 4.0))
    assert tree.remeasured(before, now).graph.point_radius == pytest.approx(2.0 * tree.graph.point_radius)

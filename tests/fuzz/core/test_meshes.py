# SPDX-License-Identifier: GPL-3.0-or-later
"""Whatever mesh comes in: a sound result or an error of ours, and nothing else."""

import json
import warnings
from contextlib import contextmanager

import numpy as np
import pytest
from fuzz import budget
from fuzz.core.meshes import DAMAGES, REFUSED, SHAPES, build, hints_of
from hypothesis import HealthCheck, Phase, given, seed, settings
from hypothesis import strategies as st
from scipy.spatial import cKDTree

from core import Parameters, ReebError, decompose
from core.arrays.components import components
from core.cuts.perceptual import method as perceptual
from core.field import agd
from core.mesh.borders import GAP
from core.mesh.polygons import PolygonMesh
from core.result.decomposition import Decomposition
from core.result.numbering import Numbering
from core.surface.preparation import bodies, repair
from core.symmetry import images as mirror_images
from core.symmetry import small_faces
from core.uses.report import document, report

damages = st.tuples(st.sampled_from(sorted(DAMAGES)), st.floats(0, 1, width=16), st.integers(0, 99)).map(list)
cases = st.fixed_dictionaries({
    "shape": st.sampled_from(sorted(SHAPES)),
    "seed": st.integers(0, 999),
    "damages": st.lists(damages, max_size=4),
    "polygons": st.booleans(),
    "dense": st.booleans(),
    "hints": st.sampled_from(["", "", "grains", "stripes"]),
    "parameters": st.fixed_dictionaries({}, optional={
        "method": st.sampled_from(["perceptual", "berretti", "lavoue"]),
        "pieces": st.sampled_from(["together", "separate"]),
        "base_spacing": st.sampled_from([0.005, 0.02, 0.05]),
        "equalize": st.booleans(),
        "n_slabs": st.sampled_from([10, 100]),
        "detail": st.floats(0, 1, width=16),
        "n_parts": st.integers(0, 12),
    }),
})


@contextmanager
def few_are_many(wanted):
    """If wanted, meshes of hundreds of faces go the ways of dense ones, over coarse copies."""
    with pytest.MonkeyPatch.context() as patch:
        if wanted:
            patch.setattr(agd, "FIELD_VERTICES", 200)
            patch.setattr(perceptual, "MAX_FACES", 800)
            patch.setattr(small_faces, "DENSE", 500)
            patch.setattr(mirror_images, "DENSE", 500)
        yield


def check(case):
    """Decompose the mesh of a case and look at what comes out; whether it was decomposed."""
    with few_are_many(case.get("dense", False)):
        return check_as_it_is(case)


def check_as_it_is(case):
    """The same, whatever counts as dense."""
    vertices, faces, polygon = build(case)
    given_arrays = vertices.copy(), faces.copy()
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        try:
            result = decompose(vertices, faces, Parameters(**case["parameters"]), polygon,
                               hints=hints_of(case, faces, polygon))
        except ReebError as error:
            sentence = str(error)
            result = None
        finally:
            np.testing.assert_array_equal(vertices, given_arrays[0])
            np.testing.assert_array_equal(faces, given_arrays[1])
        if result is None:
            assert sentence.endswith(".")
            assert "\n" not in sentence
            return False
        assert np.isfinite(vertices).all()
        assert faces.min() >= 0
        assert faces.max() < len(vertices)
        assert_sound(result, vertices, faces, polygon)
        assert_stored(result)
        assert_same_again(case, result, vertices, faces, polygon)
    return True


def assert_sound(result, vertices, faces, polygon):
    """Labels complete, parts connected and nested, numbers exact."""
    n_faces = len(faces) if polygon is None else polygon.max() + 1
    assert result.candidates.shape == (n_faces,)
    count = result.n_candidates
    assert np.unique(result.candidates).tolist() == list(range(count))
    used = np.zeros(len(vertices), bool)
    used[faces] = True
    assert result.field.shape == (len(vertices),)
    assert ((result.field[used] >= 0) & (result.field[used] <= 1)).all()
    assert np.isnan(result.field[~used]).all()
    assert ((result.vertex_candidates >= 0) == used).all()
    assert result.vertex_candidates.max() < count
    assert np.isfinite(result.candidate_area).all()
    # Candidates hang together along edges; vertices at one place count as one.
    if polygon is None:  # polygons made at random may lie apart themselves
        assert connected(result.candidates, vertices, faces, result.contacts)
    former = None
    for n in sorted({1, 2, 3, count // 2, count - 1, count} & set(range(1, count + 1))):
        parts = result.parts(n_parts=n)
        assert parts.count == n
        assert np.unique(parts.labels).tolist() == list(range(n))
        part = np.empty(count, np.int64)
        part[result.candidates] = parts.labels
        assert (part[result.candidates] == parts.labels).all()
        pairs = result.candidate_pairs
        same = part[pairs[:, 0]] == part[pairs[:, 1]]
        assert components(count, *pairs[same].T)[0] == n
        touching = np.unique(np.sort(part[pairs[~same]], axis=1), axis=0)
        assert {tuple(t) for t in touching.tolist()} == {tuple(c) for c in parts.cuts.tolist()}
        if former is not None:  # each coarser part is a union of these
            assert len({*zip(part.tolist(), former.tolist(), strict=True)}) == n
        former = part
        assert parts.share.sum() == pytest.approx(1)
    by_detail = [result.parts(detail) for detail in (0.0, 0.3, 0.5, 0.8, 1.0)]
    assert [parts.count for parts in by_detail] == sorted(parts.count for parts in by_detail)
    assert (by_detail[0].count, by_detail[-1].count) == (1, count)
    for coarse, fine in zip(by_detail, by_detail[1:], strict=False):
        assert len({*zip(coarse.labels.tolist(), fine.labels.tolist(), strict=True)}) == fine.count
    graph = result.graph
    assert np.isfinite(graph.node_position).all()
    assert np.isfinite(graph.point_position).all()
    assert np.isfinite(graph.point_radius).all()
    assert (graph.node_value[graph.arcs[:, 0]] <= graph.node_value[graph.arcs[:, 1]]).all()


def connected(label, vertices, faces, contacts):
    """Whether the faces of each label hang together along edges, or by contacts; those of no area may lie apart.

    Vertices within GAP of each other count as one. Three corners on a line, or a speck within the rounding of
    coordinates, have an area that is rarely exactly 0.
    """
    corners = vertices[faces] - vertices[faces[0, 0]]
    corners /= np.abs(corners).max() or 1.0
    area = 0.5 * np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1)
    solid = area > 1e-12
    used = np.unique(faces)
    _, at, place = np.unique(vertices[used] + 0.0, axis=0, return_index=True, return_inverse=True)
    spots = vertices[used[at]] - vertices[used[0]]
    spots /= np.abs(spots).max() or 1.0
    near = cKDTree(spots).query_pairs(1.01 * GAP * np.linalg.norm(np.ptp(spots, axis=0)), output_type="ndarray")
    name = np.zeros(len(vertices), np.int64)
    name[used] = components(len(spots), *near.T)[1][place.reshape(-1)]
    faces = name[faces]
    edges = np.sort(faces[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1)
    _, edge = np.unique(edges, axis=0, return_inverse=True)
    n = len(faces)
    owner = np.repeat(np.arange(n), 3)
    # A face is joined to its edges, each of which counts once for each label that meets there.
    _, node = np.unique(np.stack([edge.reshape(-1), label[owner]], axis=1), axis=0, return_inverse=True)
    one, other = contacts[label[contacts[:, 0]] == label[contacts[:, 1]]].T
    _, piece = components(n + node.max() + 1, np.concatenate([owner, one]),
                          np.concatenate([n + node.reshape(-1), other]))
    return len(np.unique(piece[:n][solid])) <= len(np.unique(label))


def assert_stored(result):
    """It can be stored and read, reported and numbered."""
    again = Decomposition.from_bytes(result.to_bytes())
    np.testing.assert_array_equal(again.candidates, result.candidates)
    np.testing.assert_array_equal(again.hierarchy.merges, result.hierarchy.merges)
    assert json.dumps(document([report(result, labels=True)]), allow_nan=False)
    none = np.zeros(result.n_candidates, np.int64)
    numbering = Numbering.of(result, none, none)
    for detail in (0.2, 0.9):
        assert (numbering.parts(detail, 0).candidate_numbers > 0).all()


def assert_same_again(case, result, vertices, faces, polygon):
    """The same mesh has the same parts, twice as large, too, unless it is so dense that a coarser copy is measured."""
    if case["seed"] % 4:  # it takes as long again
        return
    fine = bodies(repair(PolygonMesh.of(vertices, faces, polygon)), True, 0.0).decomposed
    larger = 2 if max((body.mesh.n_vertices for body in fine), default=0) <= agd.FIELD_VERTICES else 1
    again = decompose(larger * vertices, faces, Parameters(**case["parameters"]), polygon,
                      hints=hints_of(case, faces, polygon))
    np.testing.assert_array_equal(again.candidates, result.candidates)
    np.testing.assert_array_equal(again.hierarchy.merges, result.hierarchy.merges)


def search(number, examples):
    """Try cases; what fails is made as small as possible, stored, and raised."""
    last = []
    tried = [0, 0]

    @settings(max_examples=examples, deadline=None, database=None, derandomize=not budget.SECONDS,
              report_multiple_bugs=False, suppress_health_check=list(HealthCheck),
              phases=(Phase.explicit, Phase.generate, Phase.shrink))
    @given(cases)
    def attempt(case):
        last[:] = [case]
        tried[0] += 1
        tried[1] += check(case)

    try:
        (seed(number)(attempt) if budget.SECONDS else attempt)()
    except Exception:
        budget.store("mesh", last[0])
        raise
    finally:
        budget.count("meshes", tried[0])
        budget.count("meshes decomposed", tried[1])


def test_any_mesh():
    errors = []
    for number in budget.rounds(1):
        try:
            search(number, 20)
        except Exception as error:  # other cases are looked for; raised below
            if not budget.SECONDS:
                raise
            errors.append(error)
    assert errors == []


def test_stored_cases():
    for case in budget.stored("mesh"):
        check(case)


def test_each_kind_of_damage_is_refused_or_not():
    for name in DAMAGES:
        case = {"shape": "ball", "seed": 2, "damages": [[name, 0.2, 1]], "polygons": False, "parameters": {}}
        assert check(case) == (name not in REFUSED), name

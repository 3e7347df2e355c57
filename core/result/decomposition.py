# SPDX-License-Identifier: GPL-3.0-or-later
"""The result: candidate parts, the hierarchy over them, the graph; and parts at any detail."""

from __future__ import annotations

import io
import json
from dataclasses import asdict, dataclass, fields
from functools import cached_property

import numpy as np

from ..cuts.hierarchy import Hierarchy
from ..errors import ReebError
from ..graph.reeb import ReebGraph
from ..parameters import Parameters
from ..sentence import Sentence
from ..surface.labels import majority
from ..uses.colors import part_colors

VERSION = "0.1.0"
_FORMAT = 1  # of to_bytes


@dataclass(frozen=True, eq=False)
class Parts:
    """Parts at one level of detail.

    With p faces and n vertices of the caller:

    Attributes
    ----------
    labels : (p,) int64
        Part of each face, 0..count-1. Part 0 is the largest; the others follow the order of
        their faces, so that poses of one mesh number their parts alike.
    vertex_labels : (n,) int64
        Part of each vertex; -1 for a vertex of no face.
    candidate_part : (c,) int64
        Part of each candidate.
    area, share : (count,) float64
        In squared units of the vertices, and of the whole.
    cuts : (e, 2) int64
        Parts that touch, smaller number first.
    cut_length, cut_salience : (e,) float64
        In units of the vertices; how much the cut deserves to be there, 0..1.
    colors : (count, 3) float64
        sRGB, 0..1.
    node_part, arc_part, point_part : (k,), (q,), (r,) int64
        Part of each node, arc and centre point of the graph.
    """

    labels: np.ndarray
    vertex_labels: np.ndarray
    candidate_part: np.ndarray
    area: np.ndarray
    share: np.ndarray
    cuts: np.ndarray
    cut_length: np.ndarray
    cut_salience: np.ndarray
    colors: np.ndarray
    node_part: np.ndarray
    arc_part: np.ndarray
    point_part: np.ndarray

    @property
    def count(self) -> int:
        return len(self.area)

    @property
    def names(self) -> tuple[str, ...]:
        """Part 01, Part 02 and so on."""
        return tuple(f"Part {i + 1:02d}" for i in range(self.count))


@dataclass(frozen=True, eq=False)
class Decomposition:
    """What ``decompose`` returns; ``parts()`` reads any level of detail from it.

    With p faces and n vertices of the caller and c candidate parts:

    Attributes
    ----------
    candidates : (p,) int64
        The finest part of each face, 0..c-1.
    vertex_candidates : (n,) int64
        The same for each vertex; -1 for a vertex of no face.
    candidate_area : (c,) float64
    candidate_pairs : (e, 2) int64
        Candidates that touch, smaller number first.
    candidate_pair_length : (e,) float64
    hierarchy : Hierarchy
    field : (n,) float64
        Normalised average geodesic distance, 0..1; nan for a vertex of no face.
    graph : ReebGraph
    node_candidate, point_candidate : (k,), (r,) int64
        The candidate in which each node and centre point of the graph lies.
    parameters : Parameters
    notes : tuple of str
        What is odd about the mesh, one ``Sentence`` each; plain text after ``from_bytes``.
    seconds : dict
        Time of each stage.
    version : str
    """

    candidates: np.ndarray
    vertex_candidates: np.ndarray
    candidate_area: np.ndarray
    candidate_pairs: np.ndarray
    candidate_pair_length: np.ndarray
    hierarchy: Hierarchy
    field: np.ndarray
    graph: ReebGraph
    node_candidate: np.ndarray
    point_candidate: np.ndarray
    parameters: Parameters
    notes: tuple[str, ...]
    seconds: dict[str, float]
    version: str = VERSION

    @property
    def n_faces(self) -> int:
        return len(self.candidates)

    @property
    def n_vertices(self) -> int:
        return len(self.vertex_candidates)

    @property
    def n_candidates(self) -> int:
        return len(self.candidate_area)

    @cached_property
    def _face_order(self) -> np.ndarray:
        """(c,) mean index of each candidate's faces."""
        index = np.arange(self.n_faces)
        return np.bincount(self.candidates, index) / np.bincount(self.candidates)

    @cached_property
    def pair_merge(self) -> np.ndarray:
        """(e,) int64, the merge of the hierarchy that joins each pair of candidates that touch."""
        return self.hierarchy.merge_of(*self.candidate_pairs.T)

    @cached_property
    def _pair_salience(self) -> np.ndarray:
        return np.append(self.hierarchy.salience, 1.0)[self.pair_merge]

    def parts(self, detail: float | None = None, n_parts: int | None = None) -> Parts:
        """Parts at a level of detail or of an exact number; nothing is computed again.

        Parameters
        ----------
        detail : float, optional
            0..1.
        n_parts : int, optional
            1 or more, instead of a detail; clipped to what the mesh allows. Without either,
            the parameters decide.

        Returns
        -------
        parts : Parts

        Raises
        ------
        ParameterError
            A value out of range.
        """
        if detail is None and n_parts is None:
            detail, n_parts = self.parameters.detail, self.parameters.n_parts
        asked = Parameters(detail=self.parameters.detail if detail is None else detail,
                           n_parts=n_parts or 0)
        count = asked.n_parts or self.hierarchy.n_parts(asked.detail)
        return self.group(self.hierarchy.parts(count))

    def group(self, candidate_part: np.ndarray) -> Parts:
        """Parts from any grouping of the candidates: (c,) int64, whole numbers from 0."""
        candidate_part = self._in_order(candidate_part)
        area = np.bincount(candidate_part, self.candidate_area)
        cuts, length, salience = self._cuts(candidate_part)
        used = self.vertex_candidates >= 0
        vertex = np.where(used, candidate_part[self.vertex_candidates], -1)
        points = candidate_part[self.point_candidate]
        return Parts(
            labels=candidate_part[self.candidates], vertex_labels=vertex,
            candidate_part=candidate_part, area=area, share=area / area.sum(), cuts=cuts,
            cut_length=length, cut_salience=salience, colors=part_colors(len(area), cuts),
            node_part=candidate_part[self.node_candidate],
            arc_part=self._arc_parts(points), point_part=points)

    def _in_order(self, part: np.ndarray) -> np.ndarray:
        """Number parts: the largest first, then by the mean index of their faces."""
        _, part = np.unique(part, return_inverse=True)
        part = part.reshape(-1)
        area = np.bincount(part, self.candidate_area)
        weight = np.bincount(self.candidates, minlength=self.n_candidates)
        middle = np.bincount(part, weight * self._face_order) / np.bincount(part, weight)
        middle[np.lexsort((middle, -area))[0]] = -1.0
        place = np.empty(len(area), np.int64)
        place[np.argsort(middle, kind="stable")] = np.arange(len(area))
        return place[part]

    def _cuts(self, part: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Pairs of parts that touch, length and salience of each."""
        ends = np.sort(part[self.candidate_pairs], axis=1).reshape(-1, 2)
        apart = ends[:, 0] != ends[:, 1]
        cuts, where = np.unique(ends[apart], axis=0, return_inverse=True)
        where = where.reshape(-1)
        length = np.bincount(where, self.candidate_pair_length[apart], len(cuts))
        salience = np.zeros(len(cuts))
        np.maximum.at(salience, where, self._pair_salience[apart])
        return cuts.reshape(-1, 2), length, salience

    def _arc_parts(self, point_part: np.ndarray) -> np.ndarray:
        """The part that most centre points of each arc lie in; every arc has a point."""
        return majority(self.graph.point_arc, point_part, np.ones(len(point_part)),
                        self.graph.n_arcs)

    def to_bytes(self) -> bytes:
        """Everything, compressed; ``from_bytes`` reads it back."""
        arrays = {f"hierarchy.{n}": getattr(self.hierarchy, n) for n in ("merges", "salience")}
        arrays |= {f"graph.{f.name}": getattr(self.graph, f.name) for f in fields(ReebGraph)}
        arrays |= {name: getattr(self, name) for name in _ARRAYS}
        head = {"format": _FORMAT, "parameters": asdict(self.parameters), "notes": self.notes,
                "seconds": self.seconds, "version": self.version}
        arrays["head"] = np.frombuffer(json.dumps(head).encode(), np.uint8)
        stream = io.BytesIO()
        np.savez_compressed(stream, **arrays)
        return stream.getvalue()

    @classmethod
    def from_bytes(cls, data: bytes) -> Decomposition:
        """Read what ``to_bytes`` wrote.

        Raises
        ------
        ReebError
            Written by a version this one does not know.
        """
        with np.load(io.BytesIO(data), allow_pickle=False) as stored:
            arrays = {name: stored[name] for name in stored.files}
        head = json.loads(arrays.pop("head").tobytes())
        if head["format"] != _FORMAT:
            raise ReebError(
                Sentence("The stored parts were written by another version. Decompose again."))
        graph = {f.name: arrays[f"graph.{f.name}"] for f in fields(ReebGraph)}
        graph["n_components"] = int(graph["n_components"])
        hierarchy = Hierarchy.of(len(arrays["candidate_area"]), arrays["hierarchy.merges"],
                                 arrays["hierarchy.salience"])
        return cls(hierarchy=hierarchy, graph=ReebGraph(**graph),
                   parameters=Parameters(**head["parameters"]), notes=tuple(head["notes"]),
                   seconds=head["seconds"], version=head["version"],
                   **{name: arrays[name] for name in _ARRAYS})


_ARRAYS = ("candidates", "vertex_candidates", "candidate_area", "candidate_pairs",
           "candidate_pair_length", "field", "node_candidate", "point_candidate")

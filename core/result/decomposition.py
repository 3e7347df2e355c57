# SPDX-License-Identifier: GPL-3.0-or-later
"""The result of a run: candidates, the hierarchy over them and the Reeb graph; parts are read from it at any detail."""

from __future__ import annotations

from dataclasses import dataclass, fields, replace
from dataclasses import field as attribute
from functools import cached_property
from typing import Any

import numpy as np

from ..arrays.indexing import inverse, renumbered, sums_by
from ..arrays.int64 import arange, full
from ..arrays.pairs import distinct_pairs
from ..arrays.ties import first_largest
from ..cuts.hierarchy import Hierarchy
from ..errors import ParameterError
from ..graph.reeb import ReebGraph
from ..mesh.arguments import whole_numbers
from ..mesh.borders import border_note
from ..mesh.copies import Copies
from ..mesh.face_graph import FaceGraph
from ..mesh.labels import majority
from ..mesh.polygons import PolygonMesh
from ..parameters import Parameters
from ..sentence import Sentence
from ..surface.ordering import Ordering
from ..symmetry.plane import MirrorPlane
from ..version import VERSION
from . import stored
from .parts import Parts


@dataclass(frozen=True, eq=False)
class Decomposition:
    """The result of ``decompose``; ``parts`` reads the parts at any level of detail from it.

    With p faces and n vertices of the caller, c candidates, and a graph of k nodes and r center points:

    Attributes
    ----------
    candidates : (p,) int64
        Candidate of each face, 0..c-1.
    vertex_candidates : (n,) int64
        Candidate of each vertex; -1 for a vertex without a face.
    candidate_area : (c,) float64
        Area of each candidate, in squared units of the vertices.
    candidate_pairs : (e, 2) int64
        Candidates that touch or that a link joins, smaller index first.
    candidate_pair_length : (e,) float64
        Length of the boundary between the two candidates of each pair, in units of the vertices.
    hierarchy : Hierarchy
        The order in which the candidates merge.
    field : (n,) float64
        Normalized average geodesic distance at each vertex, 0..1; nan for a vertex without a face.
    graph : ReebGraph
        Reeb graph of all components.
    node_candidate : (k,) int64
        Candidate in which each node of the graph lies.
    point_candidate : (r,) int64
        Candidate in which each center point of the graph lies.
    contacts : (t, 2) int64
        Faces that touch, or nearly so, though they share no edge, and ``links``.
    mirror : (4,) float64 or (0,)
        Normal of the plane of symmetry and its distance from the origin along it; empty if none was found, as in a
        pose.
    face_twin : (p,) int64 or (0,)
        Mirror image of each face, -1 for none; empty without symmetry.
    face_side : (p,) int8 or (0,)
        1 for a face on the side to which the normal of the plane points, -1 on the other, 0 in the middle. Without a
        plane the way from the other side to the first one takes its place.
    parameters : Parameters
        The parameters of the run.
    notes : tuple of str
        One ``Sentence`` for each oddity of the mesh; plain text after ``from_bytes``.
    seconds : dict of str -> float
        Seconds that each stage took.
    version : str
        Version of Reeb Parts that made the result.
    links : (l, 2) int64
        Those of ``contacts`` whose faces do not touch: each body hangs on the nearest that is larger, so that all can
        be one part. Where pieces are decomposed separately, each is a body.
    junctions : (m, 2) int64
        Three candidates and more that meet at edges: junctions, 0..j-1, and their candidates, see
        ``core.result.junctions``.
    junction_length : (j,) float64
        Length of the edges of each junction, in units of the vertices.
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
    contacts: np.ndarray
    mirror: np.ndarray
    face_twin: np.ndarray
    face_side: np.ndarray
    parameters: Parameters
    notes: tuple[str, ...]
    seconds: dict[str, float]
    version: str = VERSION
    links: np.ndarray = attribute(default_factory=lambda: np.empty((0, 2), np.int64))
    junctions: np.ndarray = attribute(default_factory=lambda: np.empty((0, 2), np.int64))
    junction_length: np.ndarray = attribute(default_factory=lambda: np.empty(0))

    def __repr__(self) -> str:
        graph = self.graph
        return (f"<Decomposition by {self.parameters.method}: {self.n_faces} faces, {self.parts().count} parts, "
                f"{graph.n_nodes} nodes, {graph.n_arcs} arcs, {graph.n_loops} loops>")

    @property
    def n_faces(self) -> int:
        """Number of the caller's faces, p."""
        return len(self.candidates)

    @property
    def n_vertices(self) -> int:
        """Number of the caller's vertices, n."""
        return len(self.vertex_candidates)

    @property
    def n_candidates(self) -> int:
        """Number of candidates, c."""
        return len(self.candidate_area)

    @cached_property
    def _face_order(self) -> np.ndarray:
        """(c,) float64, mean index of each candidate's faces."""
        index = arange(self.n_faces)
        return np.bincount(self.candidates, index) / np.bincount(self.candidates)

    @property
    def plane(self) -> MirrorPlane | None:
        """The plane of symmetry, or None."""
        return MirrorPlane.of(self.mirror) if len(self.mirror) else None

    @cached_property
    def candidate_twin(self) -> np.ndarray:
        """(c,) int64, mirror image of each candidate; -1 for none."""
        if not len(self.face_twin):
            return full(self.n_candidates, -1)
        image = np.where(self.face_twin >= 0, self.candidates[self.face_twin], -1)
        return majority(self.candidates, image + 1, np.ones(self.n_faces), self.n_candidates) - 1

    @cached_property
    def candidate_side(self) -> np.ndarray:
        """(c,) float64, sum of ``face_side`` over the faces of each candidate; 0 without a plane."""
        if not len(self.face_side):
            return np.zeros(self.n_candidates)
        return np.bincount(self.candidates, self.face_side, self.n_candidates)

    @cached_property
    def pair_touches(self) -> np.ndarray:
        """(e,) bool, whether the candidates of each pair touch; else only a link joins them."""
        e, t = len(self.candidate_pairs), len(self.contacts)
        joined = np.sort(self.candidates[np.concatenate([self.contacts, self.links])], axis=1)
        places, place = distinct_pairs(*np.concatenate([self.candidate_pairs, joined]).T)
        n_contacts, n_links = (np.bincount(own, minlength=len(places))[place[:e]]
                               for own in (place[e : e + t], place[e + t :]))
        # On half a model a link may be the image of one between what touches here.
        return (n_links == 0) | (n_contacts > n_links) | (self.candidate_pair_length > 0)

    @cached_property
    def pair_merge(self) -> np.ndarray:
        """(e,) int64, merge that joins each pair of touching candidates, see ``Hierarchy.merge_of``."""
        return self.hierarchy.merge_of(*self.candidate_pairs.T)

    @cached_property
    def pair_salience(self) -> np.ndarray:
        """(e,) float64, salience of the merge that joins each pair of touching candidates; 1 where no merge does."""
        return np.append(self.hierarchy.salience, 1.0)[self.pair_merge]

    def parts(self, detail: float | None = None, n_parts: int | None = None) -> Parts:
        """Read the parts at a level of detail, or an exact number of parts; nothing is computed again.

        Without arguments, the parameters of the run decide.

        Parameters
        ----------
        detail : float, optional
            0..1: cuts of salience 1 - detail and above stay.
        n_parts : int, optional
            Exact number of parts, which takes precedence over ``detail``; clipped to what the mesh allows. 0 leaves the
            decision to the detail.

        Returns
        -------
        parts : Parts

        Raises
        ------
        ParameterError
            A value is outside its range; ``error.name`` says which.
        """
        if detail is None and n_parts is None:
            detail, n_parts = self.parameters.detail, self.parameters.n_parts
        asked = Parameters(detail=self.parameters.detail if detail is None else detail,
                           n_parts=0 if n_parts is None else n_parts)
        count = asked.n_parts or self.hierarchy.n_parts(asked.detail)
        return self.group(self.hierarchy.parts(count))

    def asked(self, parameters: Parameters) -> Decomposition:
        """Give the result as that of a run which asked for other detail or another number of parts.

        parameters : Parameters. Returns a Decomposition of the same candidates, with the note of such a run where more
        parts are asked for than there can be; this one, with all that is known of it, if nothing else is asked for.
        """
        if parameters == self.parameters:
            return self
        before = too_many(self.parameters.n_parts, self.n_candidates)
        notes = tuple(note for note in self.notes if note not in before)
        return replace(self, parameters=parameters, notes=notes + too_many(parameters.n_parts, self.n_candidates))

    def group(self, candidate_part: np.ndarray) -> Parts:
        """Make parts of any grouping of the candidates.

        Part 0 is the part of most area; of parts whose areas differ by rounding only, as those of twins do, the first
        of them. The others are sorted by the mean index of their faces, so that the parts of a mesh have the same
        labels in all its poses.

        Parameters
        ----------
        candidate_part : (c,) int64
            Any whole numbers, equal for the candidates of one part.

        Returns
        -------
        parts : Parts

        Raises
        ------
        ParameterError
            They are not c whole numbers.
        """
        groups = whole_numbers(candidate_part)
        if groups is None or groups.shape != (self.n_candidates,):
            raise ParameterError(Sentence("Groups must be {n} whole numbers, one for each candidate.",
                                          n=self.n_candidates))
        _, part = renumbered(groups)
        area = np.bincount(part, self.candidate_area)
        n_faces = np.bincount(self.candidates, minlength=self.n_candidates)
        middle = np.bincount(part, n_faces * self._face_order) / np.bincount(part, n_faces)
        order = np.argsort(middle, kind="stable")
        middle[order[first_largest(area[order])]] = -1.0
        return Parts(self, inverse(np.argsort(middle, kind="stable"))[part])

    def scaled(self, exponent: int) -> Decomposition:
        """Copy the result of a mesh as that of the mesh multiplied by 2**exponent.

        exponent : int. Returns a Decomposition of the same parts, with other areas, lengths and positions.
        """
        graph = replace(self.graph, **{
            name: np.ldexp(getattr(self.graph, name), exponent)
            for name in ("node_position", "point_position", "point_radius", "point_length")})
        mirror = np.concatenate([self.mirror[:3], np.ldexp(self.mirror[3:], exponent)])
        return replace(self, graph=graph, mirror=mirror, candidate_area=np.ldexp(self.candidate_area, 2 * exponent),
                       candidate_pair_length=np.ldexp(self.candidate_pair_length, exponent),
                       junction_length=np.ldexp(self.junction_length, exponent))

    def shifted(self, offset: np.ndarray) -> Decomposition:
        """Copy the result of a mesh as that of the mesh moved, with other positions and another plane of symmetry.

        offset : (3,) float64.
        """
        graph = replace(self.graph, node_position=self.graph.node_position + offset,
                        point_position=self.graph.point_position + offset)
        mirror = self.mirror.copy()
        mirror[3:] += mirror[:3] @ offset if len(mirror) else 0.0
        return replace(self, graph=graph, mirror=mirror)

    def remeasured(self, before: FaceGraph, now: FaceGraph) -> Decomposition:
        """Copy the result of a mesh as that of the mesh stretched, with other areas, lengths and radii.

        Each area and length changes as the faces and edges do that are there; what has none of them, and radii, by the
        square root of the factor of the whole area, which is exact where all directions are stretched alike.

        Parameters
        ----------
        before, now : FaceGraph
            Of the p faces as they were when they were decomposed, and stretched; with the same pairs.

        Returns
        -------
        decomposition : Decomposition
            Of the same parts; positions and the plane of symmetry stay.
        """
        scale = float(np.sqrt(_ratio(now.area.sum(), before.area.sum(), 1.0)))
        area = _ratio(self._area_sums(now), self._area_sums(before), scale**2)
        length = _ratio(self._pair_sums(now), self._pair_sums(before), scale)
        graph = replace(self.graph, point_radius=scale * self.graph.point_radius)
        return replace(self, graph=graph, candidate_area=self.candidate_area * area,
                       candidate_pair_length=self.candidate_pair_length * length,
                       junction_length=scale * self.junction_length)

    def _area_sums(self, graph: FaceGraph) -> np.ndarray:
        """(c,) float64, area of the faces of each candidate."""
        return np.bincount(self.candidates, graph.area, self.n_candidates)

    def _pair_sums(self, graph: FaceGraph) -> np.ndarray:
        """(e,) float64, length of the edges between the two candidates of each pair."""
        found = np.sort(self.candidates[graph.pairs], axis=1)
        every = np.concatenate([np.sort(self.candidate_pairs, axis=1).reshape(-1, 2), found])
        pairs, place = distinct_pairs(*every.T)
        n_pairs = len(self.candidate_pairs)
        return sums_by(place[n_pairs:], graph.length, len(pairs))[place[:n_pairs]]

    def reordered(self, ordering: Ordering) -> Decomposition:
        """Copy the result of a mesh that was sorted as that of the mesh in the caller's order.

        ordering : Ordering. Returns a Decomposition of the same parts.
        """
        face, vertex = inverse(ordering.polygon), inverse(ordering.vertex)
        twin, side = self.face_twin, self.face_side
        if len(twin):
            twin, side = np.append(ordering.polygon, -1)[twin[face]], side[face]
        return replace(self, candidates=self.candidates[face], vertex_candidates=self.vertex_candidates[vertex],
                       field=self.field[vertex], contacts=ordering.polygon[self.contacts],
                       links=ordering.polygon[self.links], face_twin=twin, face_side=side)

    def with_copies(self, copies: Copies, given: PolygonMesh) -> Decomposition:
        """Copy the result of a mesh without its copies of faces as that of the whole mesh.

        Parameters
        ----------
        copies : Copies
        given : PolygonMesh
            The whole mesh: p faces.

        Returns
        -------
        decomposition : Decomposition
            Of the same parts; each copy is in contact with the face of which it is one, and in its candidate.
        """
        face, kept = copies.original, copies.polygon
        label = self.candidates[face]
        lies = np.flatnonzero(copies.is_copy)
        area = np.ldexp(np.bincount(given.polygon, given.triangles.face_area), 2 * given.exponent)
        # Where several faces meet, the home of a vertex may be of others than the originals of its own.
        vertex = given.vertex_labels(label)
        vertex[copies.vertex] = self.vertex_candidates
        has_twins = len(self.face_twin) > 0
        return replace(
            self, candidates=label, candidate_area=np.bincount(label, area, self.n_candidates),
            vertex_candidates=vertex, field=self.field[copies.home],
            contacts=np.concatenate([kept[self.contacts], np.stack([kept[face[lies]], lies], axis=1)]),
            links=kept[self.links], face_twin=copies.images(self.face_twin) if has_twins else self.face_twin,
            face_side=self.face_side[face] if has_twins else self.face_side,
            notes=(*_without_rims(self.notes, copies.n_rims), copies.note))

    def to_arrays(self) -> dict[str, np.ndarray]:
        """All arrays by name, those of hierarchy and graph as "hierarchy.merges" and so on; not copied."""
        arrays = {f"hierarchy.{name}": getattr(self.hierarchy, name) for name in ("merges", "salience")}
        arrays |= {f"graph.{f.name}": np.asarray(getattr(self.graph, f.name)) for f in fields(ReebGraph)}
        return arrays | {name: getattr(self, name) for name in stored.TABLES}

    @classmethod
    def from_arrays(cls, arrays: dict[str, np.ndarray], parameters: Parameters, notes: tuple[str, ...],
                    seconds: dict[str, float], version: str = VERSION) -> Decomposition:
        """Put a decomposition together from what ``to_arrays`` gives, and from its other attributes."""
        graph: dict[str, Any] = {f.name: arrays[f"graph.{f.name}"] for f in fields(ReebGraph)}
        graph["n_components"] = int(graph["n_components"])
        hierarchy = Hierarchy.of(len(arrays["candidate_area"]), arrays["hierarchy.merges"],
                                 arrays["hierarchy.salience"])
        return cls(hierarchy=hierarchy, graph=ReebGraph(**graph), parameters=parameters, notes=notes,
                   seconds=seconds, version=version, **{name: arrays[name] for name in stored.TABLES})

    def to_bytes(self) -> bytes:
        """Write the whole result: returns compressed bytes that ``from_bytes`` reads."""
        return stored.write(self.to_arrays(), self.parameters, self.notes, self.seconds, self.version)

    @classmethod
    def from_bytes(cls, data: bytes, counts: tuple[int, int] | None = None) -> Decomposition:
        """Read a result that ``to_bytes`` wrote, also one of version 0.1.0.

        Parameters
        ----------
        data : bytes
            Anything; no more is read than a result of such a mesh can have.
        counts : (int, int), optional
            Numbers of vertices and faces of the mesh that the result is of, if they are known.

        Returns
        -------
        decomposition : Decomposition

        Raises
        ------
        DamagedError
            The bytes are damaged, ``to_bytes`` did not write them, or they are of another mesh.
        NewerError
            A newer version wrote them, and this one does not know their layout.
        ReebError
            They have a layout that this version does not know any more.
        """
        return cls.from_arrays(*stored.read(data, counts))


def _without_rims(notes: tuple[str, ...], n_rims: int) -> tuple[str, ...]:
    """Notes in which so many edges count as no borders."""
    found = border_note(n_rims)

    def mended(note: str) -> str:
        if isinstance(note, Sentence) and note.message == found.message:
            return border_note(note.values["n"] - n_rims)
        return note

    return tuple(note for note in map(mended, notes) if note != border_note(0))


def too_many(asked: int, n_candidates: int) -> tuple[Sentence, ...]:
    """A note where more parts are asked for than there can be, or none."""
    if asked <= n_candidates:
        return ()
    return (Sentence("{asked} parts were asked for; there are {n} at most.", asked=asked, n=n_candidates),)


def _ratio(now: np.ndarray, before: np.ndarray, otherwise: float) -> np.ndarray:
    """Quotients of two arrays; where there is none, another number."""
    there = np.asarray(before) > 0
    return np.where(there, now / np.where(there, before, 1.0), otherwise)

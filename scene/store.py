# SPDX-License-Identifier: GPL-3.0-or-later
"""The result kept with its mesh: in the .blend file, through undo, until the mesh is edited.

Beside the decomposition, three numbers of each candidate are stored: ``previous_number``, which it was given when
the mesh was decomposed; ``pinned``, the number of the part that it stays in whatever the detail, 0 for none;
``shown``, the number of the part that it is in now.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property, lru_cache

import bpy
import numpy as np
from bpy.app.translations import pgettext_rpt as rpt_

from ..core.result.decomposition import Decomposition
from ..core.result.numbering import NumberedParts, Numbering
from . import property_updates, targets, transaction
from .errors import SceneError, load_core, translated
from .reading import fingerprints
from .result import part_names

# The last few results read or computed, by their bytes: undo and redo bring back older ones.
_read: dict[bytes, Decomposition] = {}
_KEEP = 4

# A mesh that is being edited is taken to have had at most so many times its vertices and faces before, or so many.
_GROWTH, _SMALL = 16, 1_000_000


class UnreadableError(SceneError):
    """What is stored with a mesh is damaged, or of another version; it is kept until the mesh is decomposed again."""


@dataclass(frozen=True, eq=False)
class Stored:
    """A decomposition and the numbers of its parts.

    Attributes
    ----------
    decomposition : Decomposition
        With c candidates.
    previous_number, pinned, shown : (c,) int64
        Numbers of parts, 0 for none; see core.result.numbering.Numbering.of for the first two. They are stored in
        this order, as int32.
    """

    decomposition: Decomposition
    previous_number: np.ndarray
    pinned: np.ndarray
    shown: np.ndarray

    @cached_property
    def numbering(self) -> Numbering:
        """The numbers of the parts at every level of detail."""
        return _numbering(self.decomposition, self.previous_number.tobytes(), self.pinned.tobytes())

    @cached_property
    def face_numbers(self) -> np.ndarray:
        """(p,) int64, the number of the part that each face is in now."""
        return self.shown[self.decomposition.candidates]

    def parts(self, detail: float, n_parts: int) -> NumberedParts:
        """Parts at a level of detail, or of an exact number if that is not 0."""
        return self.numbering.parts(detail, n_parts)

    def shown_parts(self) -> NumberedParts:
        """Parts as they are now."""
        return self.numbering.numbered(self.shown)

    def showing(self, numbered: NumberedParts) -> Stored:
        """The result with other parts of the decomposition shown."""
        return replace(self, shown=numbered.candidate_numbers)


def has_result(mesh: bpy.types.Mesh) -> bool:
    """Whether a decomposition is stored with the mesh; every button asks at each redraw, and its bytes are not read."""
    return mesh.is_property_set("reeb_parts") and mesh.reeb_parts.is_property_set("data")


def has_parts(obj: bpy.types.Object | None) -> bool:
    """Whether an object is a mesh that a decomposition is stored with; None is not."""
    return obj is not None and obj.type == "MESH" and has_result(obj.data)


def state_of(mesh: bpy.types.Mesh) -> tuple[object, ...]:
    """Changes with what is stored with a mesh: what is made of that can be kept as long as this stays.

    By its seconds another run is told that has the same parts: what it replaced may have been unreadable.
    """
    result = mesh.reeb_parts
    return mesh.session_uid, result.fingerprint, result.numbers, result.seconds


def is_edited(mesh: bpy.types.Mesh) -> bool:
    """Whether the mesh was edited since: only the quick checks, for the panel."""
    result = mesh.reeb_parts
    return result.edited or (
        len(mesh.vertices) != result.n_vertices or len(mesh.polygons) != result.n_faces
    )


def load(mesh: bpy.types.Mesh) -> Stored:
    """The stored result of a mesh in Object Mode.

    Raises
    ------
    SceneError
        There is none, or the mesh was edited since.
    """
    if not has_result(mesh):
        raise SceneError(rpt_("{name} has no parts yet. Decompose it first.").format(name=targets.name_of(mesh)))
    if mesh.is_editmode:
        raise SceneError(rpt_("{name} is being edited. Leave Edit Mode first.").format(name=targets.name_of(mesh)))
    result = mesh.reeb_parts
    if (fingerprints.fingerprint(mesh) != result.fingerprint
            or (result.n_vertices, result.n_faces) != (len(mesh.vertices), len(mesh.polygons))):
        raise SceneError(
            rpt_("{name} was edited since it was decomposed. Decompose it again.").format(name=targets.name_of(mesh)))
    fingerprints.keep_shape(result.fingerprint)
    return last(mesh)


def last(mesh: bpy.types.Mesh) -> Stored:
    """The stored result of a mesh that has one, in any mode; the mesh may have been edited since.

    Raises UnreadableError.
    """
    result = mesh.reeb_parts
    # While the mesh is edited, it may have other counts; what is read for it stays in proportion to it.
    most = _GROWTH * (len(mesh.vertices) + len(mesh.polygons)) + _SMALL
    if not (result.n_vertices <= most and result.n_faces <= most):
        raise _damaged()
    decomposition = _decomposition(result.data, (result.n_vertices, result.n_faces))
    numbers = result.numbers
    if len(numbers) != 3 * 4 * decomposition.n_candidates:
        raise _damaged()
    rows = np.frombuffer(numbers, np.int32).astype(np.int64).reshape(3, -1)
    previous, pinned, shown = rows
    listed = np.array([part.number for part in result.parts], np.int64)
    every = np.concatenate([rows.ravel(), listed])
    if (every < 0).any() or (every > part_names.MAX_NUMBER).any() or (shown == 0).any():
        raise _damaged()
    if not np.array_equal(np.sort(listed), np.unique(shown)):  # a script has changed the list
        raise _damaged()
    return Stored(decomposition, previous, pinned, shown)


def check_list(mesh: bpy.types.Mesh) -> None:
    """Raise UnreadableError if a script has changed the list of parts so that none is the active one: a quick check."""
    result = mesh.reeb_parts
    if not 0 <= result.active < len(result.parts):
        raise _damaged()


def _damaged() -> UnreadableError:
    """The error that says that a stored result is damaged."""
    load_core()
    from ..core.result.stored import DamagedError

    return UnreadableError(translated(DamagedError()))


def save(mesh: bpy.types.Mesh, stored: Stored) -> None:
    """Keep a result with its mesh; Object Mode."""
    transaction.keep_result(mesh)
    transaction.drop_former_group(mesh, "reeb_parts")
    result = mesh.reeb_parts
    data = stored.decomposition.to_bytes()
    _remember(data, stored.decomposition)
    result.data = data
    save_numbers(mesh, stored)
    result.fingerprint = fingerprints.fingerprint(mesh)
    fingerprints.keep_shape(result.fingerprint)
    result.n_vertices, result.n_faces = len(mesh.vertices), len(mesh.polygons)
    result.edited = False
    graph = stored.decomposition.graph
    result.n_nodes, result.n_arcs, result.n_loops = graph.n_nodes, graph.n_arcs, int(graph.n_loops)


def save_numbers(mesh: bpy.types.Mesh, stored: Stored) -> None:
    """Keep which candidate has which number."""
    transaction.keep_result(mesh)
    rows = np.stack([stored.previous_number, stored.pinned, stored.shown])
    mesh.reeb_parts.numbers = rows.astype(np.int32).tobytes()


def go_to_number(result: bpy.types.PropertyGroup, numbering: Numbering, count: int) -> None:
    """Let the detail be where there are so many parts, and know how many there can be."""
    result.fewest, result.most = numbering.n_range
    result.detail = numbering.detail_of(count)


def stretch_of(mesh: bpy.types.Mesh) -> np.ndarray:
    """What the object did to its mesh when it was decomposed, (3, 3) float64; see bridge.world_stretch."""
    stretch = np.array(mesh.reeb_parts.stretch[:], np.float64).reshape(3, 3)
    return stretch if np.isfinite(stretch).all() else np.eye(3)


def _decomposition(data: bytes, counts: tuple[int, int]) -> Decomposition:
    if data not in _read:
        core = load_core()
        try:
            _remember(data, core.Decomposition.from_bytes(data, counts))
        except core.ReebError as error:
            raise UnreadableError(translated(error)) from error
    found = _read[data]
    if (found.n_vertices, found.n_faces) != counts:
        raise _damaged()
    return found


def _remember(data: bytes, decomposition: Decomposition) -> None:
    _read[data] = decomposition
    while len(_read) > _KEEP:
        del _read[next(iter(_read))]


@lru_cache(_KEEP)
def _numbering(decomposition: Decomposition, previous: bytes, pinned: bytes) -> Numbering:
    """While the detail is dragged, the numbers of all levels stay the same."""
    return Numbering.of(decomposition, np.frombuffer(previous, np.int64), np.frombuffer(pinned, np.int64))


def forget() -> None:
    """Free what is kept in memory."""
    _read.clear()
    _numbering.cache_clear()


def mark_pins(mesh: bpy.types.Mesh, stored: Stored) -> None:
    """Tell the list which parts stay whatever the detail."""
    transaction.keep_result(mesh)
    pinned = set(stored.pinned.tolist())
    with property_updates.quiet():
        for part in mesh.reeb_parts.parts:
            part.pinned = part.number in pinned

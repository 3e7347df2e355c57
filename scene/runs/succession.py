# SPDX-License-Identifier: GPL-3.0-or-later
"""A new result for a mesh that had one: its parts take over numbers, and what was changed by hand stays as it is."""

from __future__ import annotations

from dataclasses import dataclass, replace

import bpy
import numpy as np

from ...core.arrays.int64 import arange
from ...core.arrays.pairs import are_among
from ...core.arrays.vectors import box_diagonal, middles_of_each
from ...core.mesh.labels import majority
from ...core.parameters import Parameters
from ...core.result.decomposition import Decomposition
from ...core.result.numbering import inherited
from .. import bridge, property_updates, store
from ..bridge import Shape
from ..changes import pins
from ..errors import SceneError
from ..ours import orphan_outputs
from ..outputs import face_attribute
from ..reading import mesh_arrays
from ..result import part_names
from ..store import Stored
from ..transaction import keep_result

BESIDE = 0.05  # share of the model's size within which the middle of a part stays where it was, whatever the faces are


@dataclass(frozen=True, eq=False)
class _Former:
    """What faces were in until now.

    number : (p,) int64, the part of each face, 0 for one that is new; pinned : (p,) int64, the same of faces of pinned
    parts, 0 for others.
    """

    number: np.ndarray
    pinned: np.ndarray

    def of_candidates(self, decomposition: Decomposition) -> tuple[np.ndarray, np.ndarray]:
        """The number that most faces of each candidate had, and that they are pinned to, (c,) int64 each."""
        found, weight = decomposition, np.ones(len(self.number))
        return (majority(found.candidates, self.number, weight, found.n_candidates),
                majority(found.candidates, self.pinned, weight, found.n_candidates))


def succeed(obj: bpy.types.Object, shape: Shape, decomposition: Decomposition) -> Stored:
    """A new result for an object's mesh; its parts take over the numbers of those that the faces were in until now.

    If it is the result of before, only the level of detail changes. Pinned parts keep their faces: candidates are
    cut where they reach into one. New faces are pinned where most of their candidate is. shape : of the object, see
    ``bridge.read_shape``.
    """
    parameters = decomposition.parameters
    old = _last(obj.data)
    if old is not None and _is_same(old.decomposition, decomposition):
        same = replace(old, decomposition=decomposition)
        return same.showing(same.parts(parameters.detail, parameters.n_parts))
    previous = pinned = np.zeros(decomposition.n_candidates, np.int64)
    former = _former(obj.data, old, parameters)
    if former is not None and not (len(former.number) == decomposition.n_faces and former.number.any()):
        previous = _at_places(obj.data, decomposition)
        _forget_all_but(obj.data, previous)
        locked = [part.number for part in obj.data.reeb_parts.parts if part.locked]
        pinned = np.where(np.isin(previous, locked), previous, 0)
    elif former is not None:
        if old is None:
            former = _without_joined(obj.data, former)
            _forget_deleted(obj.data, former.number)
            former = _copies_apart(obj, shape, decomposition, former)
        previous, pinned = former.of_candidates(decomposition)
        if former.pinned.any():
            decomposition = _cut_around_pins(obj, shape, decomposition, former, pinned[decomposition.candidates])
            previous, pinned = former.of_candidates(decomposition)
    numbers = inherited(decomposition, parameters.detail, parameters.n_parts, previous, pinned)
    return Stored(decomposition, previous_number=numbers, pinned=pinned, shown=numbers)


def _at_places(mesh: bpy.types.Mesh, decomposition: Decomposition) -> np.ndarray:
    """The number of the part that was where the part of each candidate is now, (c,) int64; 0 for none.

    For a mesh whose faces do not tell, as after QuadriFlow: of two parts, each has to be the nearest to the other.
    """
    from ...core.arrays.nearest import nearest, search_tree  # here, since Blender's panels come up without SciPy

    parameters = decomposition.parameters
    parts = decomposition.parts(parameters.detail, parameters.n_parts)
    listed = [part for part in mesh.reeb_parts.parts  # which may be damaged
              if 0 < part.number <= part_names.MAX_NUMBER and np.isfinite(part.middle).all()]
    if not listed:
        return np.zeros(decomposition.n_candidates, np.int64)
    center, area = mesh_arrays.face_middles(mesh)
    now = middles_of_each(parts.labels, center, area + 1e-300, parts.count)[1]
    before = np.array([part.middle[:] for part in listed])
    distance, place = nearest(search_tree(before), now)
    near = distance < BESIDE * box_diagonal(center)
    mutual = nearest(search_tree(now), before)[1][place] == arange(parts.count)
    numbers = np.array([part.number for part in listed])[place]
    return np.where(near & mutual, numbers, 0)[parts.candidate_part]


def _forget_deleted(mesh: bpy.types.Mesh, numbers: np.ndarray) -> None:
    """Forget names, colors and locks of parts that were shown and have no face any more; others may come back.

    numbers : (p,) int64, the part that each face was in.
    """
    shown = {part.number for part in mesh.reeb_parts.parts}
    hidden = [entry.number for entry in mesh.reeb_parts.names if entry.number not in shown]
    _forget_all_but(mesh, np.append(numbers, hidden))


def _forget_all_but(mesh: bpy.types.Mesh, numbers: np.ndarray) -> None:
    """Forget names, colors and locks of all but some parts: their numbers will be those of others."""
    result = mesh.reeb_parts
    keep_result(mesh)
    for index in reversed(range(len(result.names))):
        if result.names[index].number not in numbers:
            result.names.remove(index)
    with property_updates.quiet():
        for part in result.parts:
            if part.number not in numbers:
                part.locked = part.only_locked = False


def _is_same(one: Decomposition, other: Decomposition) -> bool:
    """Whether two decompositions of one mesh have the same parts at every level."""
    return all(np.array_equal(*pair) for pair in (
        (one.candidates, other.candidates),
        (one.hierarchy.merges, other.hierarchy.merges),
        (one.hierarchy.salience, other.hierarchy.salience),
    ))


def _cut_around_pins(obj: bpy.types.Object, shape: Shape, decomposition: Decomposition, former: _Former,
                     most: np.ndarray) -> Decomposition:
    """The decomposition with candidates none of which has faces of two pinned parts, or of one and of others.

    most : (p,) int64, what most faces of each face's candidate are pinned to; new faces go with them.
    """
    from ...core.result.editing.finer_candidates import scraps_joined, split_around

    pinned = np.where(former.number > 0, former.pinned, most)
    if np.array_equal(pinned, most):
        return decomposition
    finer = split_around(decomposition, pinned, *bridge.face_graph(obj, shape))
    return scraps_joined(finer, pinned, former.number)


def _without_joined(mesh: bpy.types.Mesh, former: _Former) -> _Former:
    """Take the faces that Join has brought from other meshes for new ones: their numbers are those of other lists."""
    joined = orphan_outputs.joined_faces(mesh, former.number)
    return _Former(np.where(joined, 0, former.number), np.where(joined, 0, former.pinned)) if joined.any() else former


def _copies_apart(obj: bpy.types.Object, shape: Shape, decomposition: Decomposition, former: _Former) -> _Former:
    """Let parts that an edit has put in several places, as Mirror and Array do, be another part in each.

    The one that is nearest to where the part was keeps its number; what is less than half as large stays with it. The
    others of a pinned part are pinned, too, those of another one are new.
    """
    from ...core.result.editing.changes import components_of

    mesh = obj.data
    try:
        before = store.last(mesh)
    except SceneError:
        return former
    contacts = decomposition.contacts[~are_among(decomposition.contacts, decomposition.links)]  # links are no contacts
    touching = bridge.face_graph(obj, shape)[0].with_contacts(contacts)
    piece = touching.regions(former.number)[1]
    number, pinned, (center, area) = former.number.copy(), former.pinned.copy(), mesh_arrays.face_middles(mesh)
    several = np.bincount(former.number[np.unique(piece, return_index=True)[1]]) > 1  # of each number
    for part in mesh.reeb_parts.parts:
        if not (0 < part.number < len(several) and several[part.number]):
            continue
        if components_of(before.decomposition, before.shown == part.number).max() > 0:
            continue
        there = np.flatnonzero(former.number == part.number)
        place = np.unique(piece[there], return_inverse=True)[1]
        size, middle = middles_of_each(place, center[there], area[there] + 1e-300, int(place.max()) + 1)
        stays = int(np.linalg.norm(middle - np.array(part.middle), axis=1).argmin())
        for index in set(np.flatnonzero(2 * size > size[stays]).tolist()) - {stays}:
            copy = there[place == index]
            new = pins.free_number(mesh, before, np.unique(number).tolist()) if former.pinned[copy[0]] else 0
            number[copy] = pinned[copy] = new
    return _Former(number, pinned)


def _last(mesh: bpy.types.Mesh) -> Stored | None:
    """What is stored with a mesh; None if that is nothing, of another version, or of the mesh before it was edited."""
    if not store.has_result(mesh):
        return None
    try:
        return store.load(mesh)
    except SceneError:
        return None


def _former(mesh: bpy.types.Mesh, old: Stored | None, parameters: Parameters) -> _Former | None:
    """The parts of a mesh's faces until now, None if it had none. Survives edits of the mesh.

    old : what ``_last`` returns; its parts at the level of detail that the new ones are to have.
    """
    if not store.has_result(mesh):
        return None
    result = mesh.reeb_parts
    if old is not None:
        # A part of a finer level that the user has named or colored is found again by the next run, too.
        kept = np.isin(old.shown, [entry.number for entry in result.names])
        number = old.parts(parameters.detail, parameters.n_parts).candidate_numbers
        candidates = old.decomposition.candidates
        return _Former(np.where(kept, old.shown, number)[candidates], old.pinned[candidates])
    attribute = face_attribute.find(mesh)  # what is left is on the faces
    faces = np.zeros(len(mesh.polygons), np.int64)
    if attribute is not None and len(attribute.data) == len(faces):
        faces = mesh_arrays.read(attribute.data, "value", np.int32).astype(np.int64)
        _number_images_(mesh, faces)
        faces[(faces < 0) | (faces > part_names.MAX_NUMBER)] = 0  # what is stored may be damaged
    pinned = [part.number for part in result.parts if part.pinned]
    return _Former(faces, np.where(np.isin(faces, pinned), faces, 0))


def _number_images_(mesh: bpy.types.Mesh, numbers: np.ndarray) -> None:
    """Give faces that Blender's Symmetrize has made of a part the number of its image, of which no face is left.

    numbers : (p,) int64, the part of each face; what it has copied has the numbers of the other side.
    """
    known = set(np.unique(numbers).tolist())
    lost = {number: image for number, image in part_names.twins(mesh).items() if number in known and image not in known}
    middle = {part.number: np.array(part.middle) for part in mesh.reeb_parts.parts}
    center = mesh_arrays.face_middles(mesh)[0] if lost else None
    for number, image in lost.items():
        nearer = np.linalg.norm(center - middle[image], axis=1) < np.linalg.norm(center - middle[number], axis=1)
        numbers[nearer & (numbers == number)] = image

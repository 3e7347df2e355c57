# SPDX-License-Identifier: GPL-3.0-or-later
"""Parts that are like a part, on all models of the file, and names of parts carried from one model to another."""

from __future__ import annotations

from itertools import chain

import bpy
import numpy as np
from bpy.app.translations import pgettext_rpt as rpt_

from .. import bridge, store
from ..errors import SceneError
from ..result import part_list, part_names
from . import moved, reactions


def objects_with_parts(context: bpy.types.Context, selected: bool = False) -> list[bpy.types.Object]:
    """Objects of the view layer whose parts can be worked on, the active one first; one per mesh.

    selected : bool, whether only the active one and selected ones. Those are left out that are linked from a file, were
    edited since they were decomposed, or are being edited.
    """
    layer = context.view_layer
    objects = [layer.objects.active, *(layer.objects.selected if selected else layer.objects)]
    first: dict[bpy.types.Mesh, bpy.types.Object] = {}
    for obj in objects:
        if store.has_parts(obj) and obj.data not in first and _can_be_read(obj):
            first[obj.data] = obj
    return list(first.values())


def _can_be_read(obj: bpy.types.Object) -> bool:
    try:
        part_list.check_parts(obj)
        moved.load(obj.data)
    except SceneError:
        return False
    return True


def find_similar(context: bpy.types.Context, obj: bpy.types.Object, limit: float) -> tuple[int, int]:
    """Mark the parts that are like the active part of an object, in the lists of all objects.

    Parameters
    ----------
    context : bpy.types.Context
    obj : bpy.types.Object
        In Object Mode, with parts.
    limit : float
        How far from the active part those are that are marked, see ``core.uses.descriptors.distances``.

    Returns
    -------
    n_parts, n_objects : int
        How many are marked besides the active part, and on how many objects.
    """
    from ...core.uses.descriptors import distances

    objects = objects_with_parts(context)
    described = {other: _descriptors(other) for other in objects}
    numbers, rows = described[obj]
    one = rows[numbers.tolist().index(part_list.active_number(obj.data))]
    n_parts = n_objects = 0
    for other in objects:
        numbers, rows = described[other]
        found = set(numbers[distances(one, rows) <= limit].tolist())
        part_list.mark_numbers(other.data, found)
        n_parts += len(found) - (other == obj)
        n_objects += bool(found)
    return n_parts, n_objects


def _descriptors(obj: bpy.types.Object) -> tuple[np.ndarray, np.ndarray]:
    """Number and descriptor of each part of an object, (count,) int64 and (count, d) float64."""
    from ...core.uses.descriptors import part_descriptors

    numbered = store.load(obj.data).shown_parts()
    shape = bridge.read_shape(obj)
    return numbered.numbers, part_descriptors(shape.vertices, shape.triangles, numbered.parts, shape.polygon)


def carry_names(context: bpy.types.Context, source: bpy.types.Object, everywhere: bool) -> tuple[int, int]:
    """Give the parts of other objects the names of those parts of one that they correspond to.

    Parameters
    ----------
    context : bpy.types.Context
    source : bpy.types.Object
        In Object Mode, with parts, of which the user has named some.
    everywhere : bool
        All objects with parts, not only selected ones.

    Returns
    -------
    n_parts, n_objects : int
        How many parts were named, and on how many objects.

    Raises
    ------
    SceneError
        No part of the source has a name of its own, or no other such object has parts.
    """
    names = part_names.kept_names(source.data)
    targets = [obj for obj in objects_with_parts(context, not everywhere) if obj.data != source.data]
    if not names:
        raise SceneError(rpt_("No part of {name} has a name of its own. Double-click parts in the list to name "
                              "them.").format(name=source.name))
    if not targets:
        raise SceneError(rpt_("Select other decomposed objects, too; the active one gives the names."))
    return sum(_carry(names, source, target) for target in targets), len(targets)


def _carry(names: dict[int, str], source: bpy.types.Object, target: bpy.types.Object) -> int:
    """Name the parts of a target; how many got a name."""
    numbered = store.load(target.data).shown_parts()
    found, share = _corresponding(source, target)
    numbers, sure = numbered.numbers.tolist(), share * numbered.parts.share
    # Of several parts that come from one, the one that most of it goes to has the plain name.
    order = np.argsort(-sure, kind="stable")
    origin = {numbers[label]: found[label] for label in order if found[label] in names and share[label] > 0}
    mesh = target.data
    # Their former names are free for others.
    reactions.give_names(mesh, {number: part_names.own_name(mesh, number) for number in origin})
    twin = numbered.parts.twin
    middle = {number for label, number in enumerate(numbers) if twin[label] == label}
    return reactions.give_names(mesh, _distinct_names(names, source.data, mesh, origin, middle))


def _distinct_names(names: dict[int, str], source: bpy.types.Mesh, target: bpy.types.Mesh,
                    origin: dict[int, int], middle: set[int]) -> dict[int, str]:
    """A name that no other part has for each part of a target; those of mirror images are mirror images.

    names : of the parts of the source, by number. origin : the source's part for each of the target's, by numbers, the
    surest first: of two images the surer one decides. middle : the target's parts that are their own mirror images;
    these get no side from a part that has an image.
    """
    result = target.reeb_parts
    images, source_images = part_names.twins(target), part_names.twins(source)
    carried = {names[other] for other in origin.values()}
    taken = {entry.name for entry in (*result.parts, *result.names) if entry.number not in origin}
    sides = {part.number: 1 if part.own_name.endswith(".L") else -1 for part in result.parts}
    given: dict[int, str] = {}
    for number, other in origin.items():
        if number in given:
            continue
        image = images.get(number)
        fresh: tuple[str, ...]
        if image in origin and image not in given and _is_one_name(names, other, origin[image], source_images):
            fresh = _free_pair(names[other], sides[number], taken, carried)
            given |= dict(zip((number, image), fresh, strict=True))
        else:
            sided = number not in middle or other not in source_images
            fresh = (_free(names[other] if sided else part_names.without_side(names[other]), taken, carried),)
            given[number] = fresh[0]
        taken.update(fresh)
    return given


def _is_one_name(names: dict[int, str], one: int, other: int, images: dict[int, int]) -> bool:
    """Whether parts that are mirror images have one name with two sides, by the parts of the source they come from.

    Where these are mirror images, too, or have no side, they may have two names, which the user has given them.
    """
    words = [part_names.without_number(names[number]) for number in (one, other)]
    mirrored = [bpy.utils.flip_name(word) for word in words]
    if images.get(one) == other:
        return words[0] == mirrored[1] != mirrored[0]
    return words != mirrored or words[0] == words[1]


def _free(name: str, taken: set[str], carried: set[str]) -> str:
    """A name that is not taken, or with a number behind it, and then none that is carried to another part."""
    return name if name not in taken else part_names.distinct(part_names.without_number(name), taken | carried)


def _free_pair(name: str, side: int, taken: set[str], carried: set[str]) -> tuple[str, str]:
    """A name for a part and the one for its mirror image, neither taken, with one number behind both.

    side : of the part, 1 for left, -1 for right, if the name has none.
    """
    stem = part_names.of_side(part_names.without_number(name), side, is_image=False)
    forms = chain((name,), (part_names.with_ending(stem, count) for count in range(len(taken | carried) + 1)))
    for index, form in enumerate(forms):
        pair = form, bpy.utils.flip_name(form)
        if form != pair[1] and not taken.intersection(pair) and not (index and carried.intersection(pair)):
            return pair
    # So long a name that its side is cut off where a number comes behind it.
    found = _free(name, taken, carried)
    return found, _free(name, taken | {found}, carried)


def _corresponding(source: bpy.types.Object, target: bpy.types.Object) -> tuple[list[int], np.ndarray]:
    """Number of the source's part for each part of the target, and how sure that is, (count,) 0..1."""
    from ...core.mesh.labels import majority
    from ...core.mesh.triangles import TriMesh
    from ...core.uses.correspondence import carried_labels, sample_surface

    from_parts, to_parts = (store.load(obj.data).shown_parts() for obj in (source, target))
    shapes = [bridge.read_shape(obj) for obj in (source, target)]
    if np.array_equal(shapes[0].triangles, shapes[1].triangles):
        # The same mesh in another pose: triangle by triangle, as one of them may have been divided into these.
        labels = [numbered.parts.labels[shape.polygon]
                  for numbered, shape in zip((from_parts, to_parts), shapes, strict=True)]
        area = TriMesh(shapes[1].vertices, shapes[1].triangles).face_area
        label = majority(labels[1], labels[0], area, to_parts.parts.count)
        return from_parts.numbers[label].tolist(), np.ones(len(label))
    samples = [sample_surface(shape.vertices, shape.triangles, shape.polygon) for shape in shapes]
    label, share = carried_labels(samples[0], from_parts.parts.labels, samples[1], to_parts.parts.labels)
    return from_parts.numbers[label].tolist(), share

# SPDX-License-Identifier: GPL-3.0-or-later
"""Names and colors of parts, by their numbers; those that the user gave are kept while the part is not shown."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Container

import bpy
import numpy as np

from ...core.result.parts import default_name
from .. import transaction

#: The largest number that a part has: colors are looked up in a table of all numbers.
MAX_NUMBER = 1_000_000

#: The color that Blender's Backspace sets over the color of a part, sRGB: a black that can hardly be chosen.
NO_COLOR = (1e-5, 1e-5, 1e-5)

_LONGEST, _ROOM = 63, 8  # bytes of a name in Blender, and of the longest number behind it


def part_name(mesh: bpy.types.Mesh, number: int) -> str:
    """The name that the user gave to a part, or else its own: as the list has it where it lists the part."""
    return shown_name(number, own_name(mesh, number), kept_names(mesh))


def all_names(mesh: bpy.types.Mesh) -> dict[int, str]:
    """What ``part_name`` says of each part of the list."""
    kept = kept_names(mesh)
    return {part.number: shown_name(part.number, part.own_name or default_name(part.number), kept)
            for part in mesh.reeb_parts.parts}


def shown_name(number: int, own: str, kept: dict[int, str]) -> str:
    """What a part is called: as the user says, or else its own name, numbered if the user gave that to another part.

    kept : of ``kept_names``.
    """
    return kept.get(number) or distinct(own, kept.values())


def own_name(mesh: bpy.types.Mesh, number: int) -> str:
    """The name of a part until the user gives it another; mirror images end in .L and .R while they are shown."""
    shown = next((part.own_name for part in mesh.reeb_parts.parts if part.number == number), "")
    return shown or default_name(number)


def free_name(mesh: bpy.types.Mesh, number: int, name: str) -> str:
    """A name for a part that no other part of the mesh has: with .001 and so on behind it if one has it."""
    others = {part.name for part in mesh.reeb_parts.parts if part.number != number}
    others |= {entry.name for entry in mesh.reeb_parts.names if entry.number != number}
    return distinct(name, others)


class Naming:
    """Gives names to several parts of a mesh, one after the other: what is asked for each is looked up once for all.

    ``free`` and ``keep`` say and do what ``free_name`` and ``keep_name`` do, for a part, or two images, after another.
    """

    def __init__(self, mesh: bpy.types.Mesh) -> None:
        transaction.keep_result(mesh)
        self._names, parts = mesh.reeb_parts.names, mesh.reeb_parts.parts
        self._own = {part.number: part.own_name or default_name(part.number) for part in reversed(parts)}
        self._known: dict[int, list[str]] = {}  # all names that belong to a number
        self._places: dict[int, int] = {}  # in the list of names, whose items move when it grows
        for part in parts:
            self._known.setdefault(part.number, []).append(part.name)
        for index, entry in enumerate(self._names):
            self._places.setdefault(entry.number, index)
            self._known.setdefault(entry.number, []).append(entry.name)
        self._taken = Counter(name for names in self._known.values() for name in names)
        self._full: Counter[str] = Counter()  # how many endings of a name are taken for sure, the first ones

    def free(self, names: dict[int, str]) -> dict[int, str]:
        """Names for parts, by number, that no other ones have, with one number behind all; ``keep`` comes next."""
        for own in [own for number in names for own in self._known[number]]:
            self._taken[own] -= 1
            if not self._taken[own]:
                self._released(own)
        count = max(self._full[name] for name in names.values())
        while any(self._taken[with_ending(name, count)] for name in names.values()):
            count += 1
        if len(names) == 1:  # of two, either may be what has an ending
            self._full[next(iter(names.values()))] = count
        return {number: with_ending(name, count) for number, name in names.items()}

    def keep(self, number: int, name: str, given: bool) -> None:
        """Remember the name that a part has now, and whether nobody typed it; ``end`` comes after all."""
        kept = "" if name == self._own[number] else name
        if number not in self._places and kept:
            self._places[number] = len(self._names)
            self._names.add().number = number
        if number in self._places:
            entry = self._names[self._places[number]]
            entry.name, entry.given = kept, given
        self._known[number] = [name, kept]
        self._taken.update(self._known[number])

    def end(self) -> None:
        """Forget what says nothing any more."""
        _drop_empty(self._names)

    def _released(self, name: str) -> None:
        """A name is free, so that fewer endings of what it begins with are taken for sure."""
        self._full.pop(name, None)
        stem, dot, number = name.rpartition(".")
        if dot and number.isdecimal():
            self._full[stem] = min(self._full[stem], int(number))
        if len(name.encode()) > _LONGEST - _ROOM:  # its stem was cut, and may be that of any long name
            self._full.clear()


def distinct(name: str, others: Container[str]) -> str:
    """A name that is none of some others, with .001 and so on behind it if needed; at most 63 bytes, as in Blender."""
    count = 0
    while (free := with_ending(name, count)) in others:
        count += 1
    return free


def with_ending(name: str, count: int) -> str:
    """A name with a number behind it, none for 0; at most 63 bytes, as in Blender."""
    return fitted(name, f".{count:03d}" if count else "")


def fitted(name: str, ending: str = "") -> str:
    """A name with an ending, of which that remains which Blender keeps, 63 bytes; its version 4 cuts letters apart."""
    return name.encode()[: _LONGEST - len(ending)].decode(errors="ignore") + ending


def without_number(name: str) -> str:
    """A name without the number that Blender, or ``distinct``, has put behind it."""
    return re.sub(r"\.\d{3,}$", "", name)


def lacks_side(name: str, suggested: str) -> bool:
    """Whether a name is a suggested one but for its side: it was given while the part was still its own image."""
    return bpy.utils.flip_name(suggested) != suggested and without_number(name) == suggested[:-2]


def twins(mesh: bpy.types.Mesh) -> dict[int, int]:
    """The number of the mirror image of each part of the list that has one there."""
    numbers = {part.own_name: part.number for part in mesh.reeb_parts.parts}
    images = {number: numbers.get(bpy.utils.flip_name(name), number) for name, number in numbers.items()}
    return {number: image for number, image in images.items() if image != number}


def in_pairs(mesh: bpy.types.Mesh, names: dict[int, str]) -> list[dict[int, str]]:
    """Names of parts by number, those of two mirror images together if one is the other's flipped, else one by one."""
    images, left, found = twins(mesh), dict(names), []
    for number, name in names.items():
        if number not in left:
            continue
        both = [number]
        image = images.get(number)
        fits = len(name.encode()) <= _LONGEST - _ROOM  # behind a longer one, a number takes the place of the side
        if fits and image is not None and left.get(image) == bpy.utils.flip_name(name) != name:
            both.append(image)
        found.append({each: left.pop(each) for each in both})
    return found


def of_side(name: str, side: int, is_image: bool) -> str:
    """The name of one side of a part that is there twice.

    name : of the part. side : 1 for .L, -1 for .R, 0 for a part that is there once. is_image : if the name has a side,
    it is that of the part, and its image has the other.
    """
    if not side:
        return name
    flipped = bpy.utils.flip_name(name)
    if flipped != name:
        return flipped if is_image else name
    return name + (".L" if side > 0 else ".R")


def without_side(name: str) -> str:
    """The name without the side, .L or .R, that it ends in, or that its number follows."""
    return re.sub(r"\.[LR](?=(\.\d{3,})?$)", "", name)


def with_object(obj: bpy.types.Object, name: str, names: Container[str]) -> str:
    """The name of a part as an object or a file of its own: with the object's before it, unless it is there.

    names : those of all parts. Of two parts, "Leg" and "Tree Leg" of a tree, the second is "Tree Tree Leg".
    """
    before = f"{obj.name} "
    return name if name.startswith(before) and name[len(before):] not in names else before + name


def keep_name(mesh: bpy.types.Mesh, number: int, name: str, given: bool = False) -> None:
    """Remember a name, also while its part is not shown. given : nobody typed it, see ``ReebName``."""
    own = own_name(mesh, number)
    if entry := _keep(mesh, number, name != own):
        entry.name, entry.given = "" if name == own else name, given
        _drop_empty(mesh.reeb_parts.names)


def kept_names(mesh: bpy.types.Mesh) -> dict[int, str]:
    """The names that the user gave to parts, by number."""
    return {entry.number: entry.name for entry in mesh.reeb_parts.names if entry.name}


def unnamed_twin(part: bpy.types.PropertyGroup) -> bpy.types.PropertyGroup | None:
    """The mirror image of a part in the list, if nobody has typed a name for it and the part's has a side."""
    mirrored = bpy.utils.flip_name(part.own_name)
    if mirrored == part.own_name or bpy.utils.flip_name(part.name) == part.name:
        return None
    mesh = part.id_data
    twin = next((other for other in mesh.reeb_parts.parts if other.own_name == mirrored), None)
    entry = None if twin is None else _kept(mesh, twin.number)
    return None if entry is not None and entry.name and not entry.given else twin


def keep_color(mesh: bpy.types.Mesh, number: int, color: tuple[float, float, float] | None) -> None:
    """Remember a color, also while its part is not shown. color : three values, sRGB; None for the palette's."""
    if entry := _keep(mesh, number, color is not None):
        entry.color, entry.has_color = color or (0.0, 0.0, 0.0), color is not None
        _drop_empty(mesh.reeb_parts.names)


def kept_colors(mesh: bpy.types.Mesh) -> dict:
    """The colors that the user gave to parts, by number."""
    return {entry.number: entry.color[:] for entry in mesh.reeb_parts.names if entry.has_color}


def number_colors(mesh: bpy.types.Mesh) -> np.ndarray:
    """The color of each part of the list by its number, (largest number + 1, 4) float32, sRGB and alpha."""
    parts = mesh.reeb_parts.parts
    known = [part for part in parts if 0 <= part.number <= MAX_NUMBER]
    colors = np.ones((max((part.number for part in known), default=0) + 1, 4), np.float32)
    for part in known:
        colors[part.number, :3] = part.color
    return colors


def _kept(mesh: bpy.types.Mesh, number: int) -> bpy.types.PropertyGroup | None:
    return next((entry for entry in mesh.reeb_parts.names if entry.number == number), None)


def _keep(mesh: bpy.types.Mesh, number: int, make: bool) -> bpy.types.PropertyGroup | None:
    """The entry of a number; made if it is not there and asked for."""
    transaction.keep_result(mesh)
    entry = _kept(mesh, number)
    if entry is None and make:
        entry = mesh.reeb_parts.names.add()
        entry.number = number
    return entry


def _drop_empty(names: bpy.types.bpy_prop_collection) -> None:
    for index in reversed(range(len(names))):
        if not names[index].name and not names[index].has_color:
            names.remove(index)

# SPDX-License-Identifier: GPL-3.0-or-later
"""A vertex group for each part: written, kept up to date, taken back; Object Mode.

Blender has no way to write weights in bulk but a list of vertices per group, so only what changes is written.
"""

import numpy as np

from . import bridge


def group_changes(vertex: np.ndarray, before: np.ndarray, after: np.ndarray) -> tuple[dict, dict]:
    """Which vertices come to which parts, and which go.

    A vertex is in every part that has a face there, so that parts share those on cuts.

    Parameters
    ----------
    vertex : (c,) int32
        Of each corner.
    before, after : (c,) int
        Number of the part of the corner's face; 0 for none.

    Returns
    -------
    come, gone : dict of number -> (k,) int64
    """
    count = int(vertex.max(initial=-1)) + 1
    (old, old_more), (new, new_more) = (_members(vertex, numbers, count) for numbers in (before, after))
    # Vertices with several parts are few, and looked at one by one.
    several = np.zeros(count, bool)
    several[old_more[1]] = several[new_more[1]] = True
    moved, cut = np.flatnonzero((old != new) & ~several), np.flatnonzero(several)
    old_pairs, new_pairs = (
        np.concatenate([more[0].astype(np.int64) * count + more[1], first[cut].astype(np.int64) * count + cut])
        for first, more in ((old, old_more), (new, new_more))
    )
    found = []
    for first, mine, others in ((new, new_pairs, old_pairs), (old, old_pairs, new_pairs)):
        number, shared = np.divmod(np.setdiff1d(mine, others, assume_unique=True), count)
        found.append(_by_number(np.concatenate([first[moved], number]), np.concatenate([moved, shared])))
    return tuple(found)


def _members(vertex, numbers, count):
    """A part of each vertex, 0 for none; and the other parts of those on cuts, as numbers and vertices."""
    first = np.zeros(count, numbers.dtype)
    first[vertex] = numbers
    left = np.flatnonzero(first[vertex] != numbers)
    vertex, numbers = vertex[left], numbers[left]
    part, more = first.copy(), [(numbers[:0], vertex[:0])]
    while len(vertex):  # as often as parts meet in one vertex
        part[vertex] = numbers
        where = np.unique(vertex)
        more.append((part[where], where))
        left = part[vertex] != numbers
        vertex, numbers = vertex[left], numbers[left]
    return first, [np.concatenate(values) for values in zip(*more, strict=True)]


def _by_number(numbers, vertices):
    """Vertices of each number above 0."""
    # Small whole numbers are sorted much faster.
    order = np.argsort(numbers.astype(np.int16) if numbers.max(initial=0) < 2**15 else numbers, kind="stable")
    numbers, vertices = numbers[order], vertices[order]
    bounds = np.flatnonzero(np.diff(numbers, prepend=0))
    return dict(zip(numbers[bounds].tolist(), np.split(vertices, bounds)[1:], strict=True))


def plan_groups(obj):
    """Let there be groups from the next update on."""
    obj.data.reeb_parts.has_groups = True


def write_groups(obj, numbers, before):
    """Make each part's group hold the part's vertices.

    numbers : (p,) int64, the part of each face. before : the same as it is written now, or None.
    """
    vertex, face = bridge.face_corners(obj.data)
    parts = {part.number: part for part in obj.data.reeb_parts.parts}
    fresh = [number for number, part in parts.items() if part.group not in obj.vertex_groups]
    if before is None or np.isin(before, fresh).any():
        before = np.zeros_like(numbers)
    # Only at the corners of faces that changed can a vertex have come or gone.
    near = np.zeros(len(obj.data.vertices), bool)
    near[vertex[(numbers != before)[face]]] = True
    near = near[vertex]
    near_face = face[near]
    come, gone = group_changes(vertex[near], before.astype(np.int32)[near_face], numbers.astype(np.int32)[near_face])
    active = obj.vertex_groups.active_index
    for number in sorted(parts):
        part = parts[number]
        if part.group not in obj.vertex_groups:
            part.group = obj.vertex_groups.new(name=part.name).name
        group = obj.vertex_groups[part.group]
        if number in gone:
            group.remove(gone[number].tolist())
        if number in come:
            group.add(come[number].tolist(), 1.0, "REPLACE")
    if active >= 0:
        obj.vertex_groups.active_index = active


def remove_group(obj, name):
    """Remove a group, if it is there; the active one stays active."""
    group = obj.vertex_groups.get(name) if name else None
    if group is None:
        return
    active = obj.vertex_groups.active
    former = active.name if active else ""
    obj.vertex_groups.remove(group)
    if former in obj.vertex_groups:
        obj.vertex_groups.active_index = obj.vertex_groups[former].index


def remove_groups(obj):
    """Remove the vertex groups that were made, and no other."""
    result = obj.data.reeb_parts
    for part in result.parts:
        remove_group(obj, part.group)
        part.group = ""
    result.has_groups = False


def rename_group(obj, part):
    """Give the part's vertex group the part's name, or the nearest that is free."""
    if part.group in obj.vertex_groups:
        group = obj.vertex_groups[part.group]
        group.name = part.name
        part.group = group.name

# SPDX-License-Identifier: GPL-3.0-or-later
"""Holes that a cut has left: closed walks along border edges."""

from __future__ import annotations

from bmesh.types import BMEdge, BMLoop, BMVert


def holes_with(edges: list[BMEdge]) -> tuple[list[list[BMVert]], int]:
    """Vertices around each hole with some of the edges, so that a face on them looks outwards."""
    done, holes, left = set(), [], 0
    for edge in edges:
        if edge in done:
            continue
        around = _around(edge)
        if around is None:
            done.add(edge)
            left += 1
            continue
        done.update(edge for edge, _ in around)
        holes += _simple([vertex for _, vertex in around])
    return holes, left


def _around(start: BMEdge) -> list[tuple[BMEdge, BMVert]] | None:
    """Edges of a hole in order, each with the vertex it leads to; None if faces do not lie in one sheet."""
    loop = start.link_loops[0]
    edge, vertex = start, loop.vert
    around = []
    while True:
        around.append((edge, vertex))
        loop = _next_border(loop, vertex)
        if loop is None:
            return None
        edge = loop.edge
        if edge == start:
            return around
        vertex = edge.other_vert(vertex)


def _next_border(loop: BMLoop, vertex: BMVert) -> BMLoop | None:
    """Turn around a vertex from one border edge to the other of the same sheet of faces."""
    while True:
        loop = loop.link_loop_prev if loop.vert == vertex else loop.link_loop_next
        if loop.edge.is_boundary:
            return loop
        if len(loop.edge.link_loops) != 2:
            return None
        loop = loop.link_loop_radial_next


def _simple(vertices: list[BMVert]) -> list[list[BMVert]]:
    """Take a closed walk apart into closed walks that meet no vertex twice."""
    walks: list[list[BMVert]] = []
    path: list[BMVert] = []
    place: dict[BMVert, int] = {}
    for vertex in vertices:
        if vertex in place:
            at = place[vertex]
            walks.append(path[at:])
            for gone in path[at:]:
                del place[gone]
            del path[at:]
        place[vertex] = len(path)
        path.append(vertex)
    return [walk for walk in [*walks, path] if len(walk) > 2]

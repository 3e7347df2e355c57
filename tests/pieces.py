# SPDX-License-Identifier: GPL-3.0-or-later
"""What a mesh can carry, put on it; and what separated parts have kept of it, element by element."""

import json
from dataclasses import dataclass

import bmesh
import bpy
import numpy as np
from bulk import read
from scipy.spatial import cKDTree

KEEP = {"hide": False, "center": False}  # beside the object, in its place
WHOLE = {"cut": "FACES"}  # faces stay whole, so that those of the pieces can be compared with those of the object
# Of types of attributes, what their values are called and how many there are.
WIDTH = {"FLOAT_VECTOR": ("vector", 3), "FLOAT2": ("vector", 2), "FLOAT_COLOR": ("color", 4),
         "BYTE_COLOR": ("color", 4), "INT32_2D": ("value", 2), "INT16_2D": ("value", 2)}
KEYS = ("Fat", "Long")
_INDEX = {"POINT": "vertices", "EDGE": "edges", "FACE": "polygons", "CORNER": "loops"}


@dataclass(frozen=True, eq=False)
class Pieces:
    """How separated parts compare with the object they come from.

    Attributes
    ----------
    faces, lost, caps : int
        Faces of the object, how many of them are in no piece or in several, and faces that are caps.
    new_borders, new_branches : int
        Edges with one face, and with three or more, that had another number in the object.
    area : float
        By which share the area without caps differs.
    differences : dict of str -> float
        Largest difference of each thing that elements carry; of names, the number that differ.
    volume, voids : float
        By which share the pieces together enclose more than the object, and what share of that lies between
        caps, each hole without sign; nan unless the object is closed.
    """

    faces: int
    lost: int
    caps: int
    new_borders: int
    new_branches: int
    area: float
    differences: dict
    volume: float
    voids: float


def furnish(obj):
    """Give a mesh of its own all kinds of things to carry, and every element a number to be known by."""
    mesh, rng = obj.data, np.random.default_rng(0)
    points = read(mesh.vertices, "co", width=3)
    for domain, name in _INDEX.items():
        attribute = mesh.attributes.new(f"index {domain}", "INT", domain)
        attribute.data.foreach_set("value", np.arange(len(getattr(mesh, name)), dtype=np.int32))
    mesh.uv_layers.new(name="Map").data.foreach_set("uv", rng.random(2 * len(mesh.loops)).astype(np.float32))
    for name, kind, domain, key, width in (
        ("Paint", "BYTE_COLOR", "CORNER", "color_srgb", 4), ("Dust", "FLOAT_COLOR", "POINT", "color", 4),
        ("crease_edge", "FLOAT", "EDGE", "value", 1), ("layer", "INT", "FACE", "value", 1),
    ):
        values = rng.random(width * len(getattr(mesh, _INDEX[domain])))
        attribute = mesh.attributes.new(name, kind, domain)
        attribute.data.foreach_set(key, (1000 * values).astype(np.int32) if kind == "INT" else np.float32(values))
    for name in ("Skin", "Nail"):
        mesh.materials.append(bpy.data.materials.new(name))
    mesh.polygons.foreach_set("material_index", rng.integers(0, 2, len(mesh.polygons)).astype(np.int32))
    mesh.polygons.foreach_set("use_smooth", np.ones(len(mesh.polygons), bool))
    for key in ("use_seam", "use_edge_sharp"):
        mesh.edges.foreach_set(key, rng.random(len(mesh.edges)) < 0.1)
    group = obj.vertex_groups.new(name="Arm")
    for index, weight in enumerate(rng.random(len(points)).tolist()):
        group.add([index], weight, "REPLACE")
    obj.shape_key_add(name="Basis")
    for name, scale in zip(KEYS, ((1.2, 1.2, 1.0), (1.0, 1.0, 1.5)), strict=True):
        key = obj.shape_key_add(name=name)
        key.data.foreach_set("co", (points * np.float32(scale)).ravel())
        key.value = 0.0
    size = np.ptp(points, axis=0).max()
    directions = read(mesh.vertices, "normal", width=3) + 0.3 * np.sin(20 * points / size)
    mesh.normals_split_custom_set_from_vertices(directions.tolist())


def compare(obj, pieces) -> Pieces:
    """Compare the pieces that were separated, with caps, from a furnished object with it; Object Mode."""
    mesh = obj.data
    carried, sums = _carried(obj), _Sums()
    faces, edge_faces = np.zeros(len(mesh.polygons), np.int64), _edge_faces(mesh)
    area, closed = 0.0, bool((edge_faces == 2)[np.unique(_corners(mesh, "edge_index"))].all())
    for piece in pieces:
        cap = caps_of(piece.data)
        kept = _kept(piece.data, cap)
        faces += np.bincount(kept["FACE"][1], minlength=len(faces))
        area += read(piece.data.polygons, "area")[kept["FACE"][0]].sum(dtype=np.float64)
        now, before = _edge_faces(piece.data), np.zeros(len(piece.data.edges), np.int64)
        before[kept["EDGE"][0]] = edge_faces[kept["EDGE"][1]]
        sums.add(new_borders=((now == 1) & (before != 1)).sum(), new_branches=((now > 2) & (now != before)).sum(),
                 caps=cap.sum())
        for name, (domain, values) in _carried(piece).items():
            here, there = kept[domain]
            sums.largest(name, _difference(values[here], carried[name][1][there]))
    whole = read(mesh.polygons, "area").sum(dtype=np.float64)
    volume = _volume(mesh, np.ones(len(mesh.polygons), bool)) if closed else np.nan
    together = sum(_volume(piece.data, np.ones(len(piece.data.polygons), bool)) for piece in pieces)
    return Pieces(len(faces), int((faces != 1).sum()), sums.total["caps"], sums.total["new_borders"],
                  sums.total["new_branches"], float(area / whole - 1), sums.most,
                  together / volume - 1, _voids(pieces) / abs(volume))


def rims(meshes, size) -> tuple[float, float]:
    """By how many degrees the rims of caps turn from edge to edge, and by how much per length, in radians times size.

    A rim is where a cap and another face meet, or where an open edge is, and ends where it branches.
    """
    angles, total, length = [], 0.0, 0.0
    for mesh in meshes:
        corner_edge = _corners(mesh, "edge_index")
        cap = np.repeat(caps_of(mesh), read(mesh.polygons, "loop_total", np.int32))
        faces, caps = (np.bincount(corner_edge[mask], minlength=len(mesh.edges)) for mask in (~cap, cap))
        ends = read(mesh.edges, "vertices", np.int32, width=2)[(faces == 1) & (caps == 1)]
        points = read(mesh.vertices, "co", width=3).astype(np.float64)
        length += np.linalg.norm(points[ends[:, 0]] - points[ends[:, 1]], axis=1).sum()
        order = np.argsort(ends.ravel(), kind="stable")
        count = np.bincount(ends.ravel(), minlength=len(points))
        at = np.flatnonzero(count == 2)
        place = np.cumsum(count)[at] - 2
        other = ends[:, ::-1].ravel()[order]
        back, ahead = points[at] - points[other[place]], points[other[place + 1]] - points[at]
        angle = np.arctan2(np.linalg.norm(np.cross(back, ahead), axis=1), (back * ahead).sum(axis=1))
        angles.append(angle)
        total += angle.sum()
    every = np.concatenate(angles) if angles else np.empty(0)
    return (float(np.degrees(every.mean())) if len(every) else 0.0), total * size / max(length, 1e-30)


def pieces_of(name="Tree"):
    """The objects that the parts of an object have become, by their numbers."""
    found = [obj for obj in bpy.data.collections[f"Parts of {name}"].objects if "reeb_parts_number" in obj]
    return sorted(found, key=lambda piece: piece["reeb_parts_number"])


def volume(mesh) -> float:
    """What a mesh encloses, by Blender; negative if it is inside out."""
    bm = bmesh.new()
    bm.from_mesh(mesh)
    found = bm.calc_volume(signed=True)
    bm.free()
    return found


def is_sound(piece) -> bool:
    """Whether the check of a separated part found nothing wrong."""
    found = json.loads(piece["reeb_parts_check"])
    return not (found["open_edges"] or found["branching_edges"] or found["contrary_edges"] or found["crossing_faces"]
                or found["inside_out"])


def closed_volume(mesh) -> float | None:
    """What a mesh encloses; None unless it is closed."""
    if not (_edge_faces(mesh) == 2).all():
        return None
    return _volume(mesh, np.ones(len(mesh.polygons), bool))


def elements(mesh, mask):
    """For each domain, the elements that belong to some faces."""
    corner = np.repeat(mask, read(mesh.polygons, "loop_total", np.int32))
    return {
        "FACE": np.flatnonzero(mask), "CORNER": np.flatnonzero(corner),
        "POINT": np.unique(read(mesh.loops, "vertex_index", np.int32)[corner]),
        "EDGE": np.unique(read(mesh.loops, "edge_index", np.int32)[corner]),
    }


def borders(mesh):
    """Edges of one face, by the places of their ends; and how many edges are no proper ones."""
    bm = bmesh.new()
    bm.from_mesh(mesh)
    found = {frozenset(tuple(round(x, 5) for x in v.co) for v in e.verts) for e in bm.edges if e.is_boundary}
    bad = sum(not (edge.is_boundary or edge.is_contiguous) for edge in bm.edges)
    bm.free()
    return found, bad


def same_places(points, others):
    """Whether points are the same in any order."""
    return len(points) == len(others) and max(cKDTree(points).query(others)[0].max(),
                                              cKDTree(others).query(points)[0].max()) < 1e-4


class _Sums:
    """Totals and largest differences by name."""

    def __init__(self):
        self.total, self.most = {}, {}

    def add(self, **counts):
        for name, count in counts.items():
            self.total[name] = self.total.get(name, 0) + int(count)

    def largest(self, name, difference):
        self.most[name] = max(self.most.get(name, 0.0), difference)


def _carried(obj) -> dict:
    """Domain and values of all that the elements of an object's mesh carry."""
    mesh = obj.data
    group = obj.vertex_groups["Arm"].index
    weights = [next((g.weight for g in v.groups if g.group == group), -1.0) for v in mesh.vertices]
    slots = read(mesh.polygons, "material_index", np.int32)
    names = np.array([material.name for material in mesh.materials])
    return {
        "positions": ("POINT", read(mesh.vertices, "co", width=3)),
        "UV map": ("CORNER", read(mesh.uv_layers["Map"].data, "uv", width=2)),
        "byte colours": ("CORNER", read(mesh.attributes["Paint"].data, "color_srgb", width=4)),
        "float colours": ("POINT", read(mesh.attributes["Dust"].data, "color", width=4)),
        "face numbers": ("FACE", read(mesh.attributes["layer"].data, "value", np.int32)),
        "creases": ("EDGE", read(mesh.attributes["crease_edge"].data, "value")),
        "seams": ("EDGE", read(mesh.edges, "use_seam", bool)),
        "sharp edges": ("EDGE", read(mesh.edges, "use_edge_sharp", bool)),
        "weights": ("POINT", np.array(weights)),
        "materials": ("FACE", names[slots]),
        "normals": ("CORNER", read(mesh.corner_normals, "vector", width=3)),
        **{f"key {key}": ("POINT", read(mesh.shape_keys.key_blocks[key].data, "co", width=3)) for key in KEYS},
    }


def _difference(values, others) -> float:
    """The largest difference, of vectors its length; how many differ where they are no numbers."""
    if values.dtype.kind in "bU":
        return float((values != others).sum())
    gap = values.astype(np.float64) - others
    return float((np.linalg.norm(gap, axis=1) if gap.ndim > 1 else np.abs(gap)).max(initial=0.0))


def _kept(mesh, cap) -> dict:
    """For each domain, the elements of faces that are no caps, and what their numbers were."""
    corner = np.flatnonzero(~np.repeat(cap, read(mesh.polygons, "loop_total", np.int32)))
    here = {"FACE": np.flatnonzero(~cap), "CORNER": corner,
            "POINT": np.unique(_corners(mesh, "vertex_index")[corner]),
            "EDGE": np.unique(_corners(mesh, "edge_index")[corner])}
    return {domain: (found, read(mesh.attributes[f"index {domain}"].data, "value", np.int32)[found])
            for domain, found in here.items()}


def caps_of(mesh):
    """Which faces are caps, (p,) bool."""
    if "reeb_cap" not in mesh.attributes:
        return np.zeros(len(mesh.polygons), bool)
    return read(mesh.attributes["reeb_cap"].data, "value", np.int32) == 1


def _edge_faces(mesh):
    """How many faces each edge has."""
    return np.bincount(_corners(mesh, "edge_index"), minlength=len(mesh.edges))


def _corners(mesh, key):
    return read(mesh.loops, key, np.int32)


def _triangles(mesh, chosen):
    """Corners of the triangles of some faces, (t, 3)."""
    mesh.calc_loop_triangles()
    triangles = read(mesh.loop_triangles, "vertices", np.int32, width=3)
    return triangles[chosen[read(mesh.loop_triangles, "polygon_index", np.int32)]]


def _volume(mesh, chosen) -> float:
    """What faces enclose; for a closed surface, wherever the origin is."""
    points = read(mesh.vertices, "co", width=3).astype(np.float64)
    return _enclosed((points - points.mean(axis=0))[_triangles(mesh, chosen)])


def _enclosed(triangles) -> float:
    a, b, c = triangles.transpose(1, 0, 2)
    return float((a * np.cross(b, c)).sum() / 6)


def _voids(pieces) -> float:
    """The volume between caps: all the caps around a hole through the object are one closed surface."""
    triangles = np.concatenate([
        read(piece.data.vertices, "co", width=3).astype(np.float64)[_triangles(piece.data, caps_of(piece.data))]
        for piece in pieces
    ])
    _, place = np.unique(triangles.reshape(-1, 3), axis=0, return_inverse=True)
    label = np.arange(place.max(initial=-1) + 1)
    corners = place.reshape(-1, 3)
    while True:  # the smallest label spreads over what is connected
        smallest = label[corners].min(axis=1)
        spread = label.copy()
        np.minimum.at(spread, corners.ravel(), np.repeat(smallest, 3))
        if (spread == label).all():
            break
        label = spread
    own = label[corners[:, 0]]
    return sum(abs(_enclosed(triangles[own == one] - triangles[own == one][0, 0])) for one in np.unique(own))

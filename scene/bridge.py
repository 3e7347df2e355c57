# SPDX-License-Identifier: GPL-3.0-or-later
"""The shape of an object as arrays for core, and the way between the coordinates of mesh and shape.

Everything is read in bulk on the main thread, so that the computation can run in another process.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import bmesh
import bpy
import numpy as np

from ..core.arrays.vectors import cross, lengths
from ..core.mesh.corners import CornerTable
from ..core.mesh.face_graph import FaceGraph
from ..core.mesh.grounds import are_ground
from ..core.mesh.polygons import MIN_FACES, PolygonMesh
from ..core.sentence import Sentence
from ..core.steps import Steps, finished
from . import targets
from .ours import modifiers
from .reading import face_hints, fingerprints, mesh_arrays
from .reading.half_models import half_plane
from .reading.mesh_arrays import shown_points
from .reading.placing import world_matrix
from .temporary import freed, removed


@dataclass(frozen=True, eq=False)
class Shape:
    """The geometry of an object as it is in the world, up to place and rotation.

    Attributes
    ----------
    object_uid : int
        The object by its session_uid, which it keeps when it is renamed, or comes back by an undo.
    vertices : (n, 3) float64
        Along the object's axes, in units of the world.
    triangles : (m, 3) int32
    polygon : (m,) int32
        The face of the mesh that each triangle lies in.
    stretch : (3, 3) float64
        Symmetric; takes the mesh's coordinates to ``vertices``.
    mirror : (4,) float64 or (0,)
        Of a half model the plane behind which its other half is, see ``half_models``.
    hints : (p,) int64 or (0,)
        Of each face of the mesh, see ``face_hints``; empty for none.
    digest : str
        Equal for equal vertices, triangles and polygons.
    fingerprint : str
        Of the mesh; stays when shape keys or the object's scale are animated, see ``fingerprints``.
    notes : tuple of Sentence
    problem : Sentence or None
        Why there are too few faces, where modifiers make those that are seen.
    """

    object_uid: int
    vertices: np.ndarray
    triangles: np.ndarray
    polygon: np.ndarray
    stretch: np.ndarray
    mirror: np.ndarray
    hints: np.ndarray
    digest: str
    fingerprint: str
    notes: tuple[Sentence, ...]
    problem: Sentence | None = None

    @property
    def arrays(self) -> tuple[np.ndarray, ...]:
        """As core.handover takes a shape."""
        return self.vertices, self.triangles, self.polygon, self.mirror, self.hints

    @property
    def is_ground(self) -> np.ndarray:
        """(p,) bool, which faces are those of a floor or the like, see core.mesh.grounds."""
        return are_ground(PolygonMesh.of(self.vertices, self.triangles, self.polygon))

    @property
    def face_area(self) -> np.ndarray:
        """Area of each face of the mesh, (p,) float64."""
        return _face_area(self.vertices, self.triangles, self.polygon)


def read_shape(obj: bpy.types.Object, hints: str = face_hints.NONE) -> Shape:
    """Read the mesh of an object: all of it, hidden or not, before any modifier but what mirrors half a model.

    hints : one of face_hints.KINDS, what to read besides its geometry.
    """
    return finished(reading_shape(obj, hints))


def reading_shape(obj: bpy.types.Object, hints: str) -> Steps[Shape]:
    """Read the mesh of an object as ``read_shape`` does, in steps of which none takes long."""
    mesh = obj.data
    if obj.mode == "EDIT":
        # A copy as a mesh of its own can be read in bulk; the edit mesh itself cannot.
        copy = bpy.data.meshes.new("Reeb Parts")
        with removed(bpy.data.meshes, copy):
            with freed(bmesh.from_edit_mesh(mesh).copy()) as edit:
                edit.to_mesh(copy)
            points, (triangles, polygon) = mesh_arrays.basis_points(copy), mesh_arrays.triangles(copy)
            hint, fingerprint = face_hints.read(copy, hints), fingerprints.fingerprint(copy)
    else:
        points = shown_points(obj)
        yield 0.3
        triangles, polygon = mesh_arrays.triangles(mesh)
        yield 0.6
        hint, fingerprint = face_hints.read(mesh, hints), fingerprints.fingerprint(mesh)
    yield 0.7
    stretch = world_stretch(obj)
    vertices = points.astype(np.float64)
    # Blender makes of an infinite coordinate that a script sets the largest number there is.
    vertices[np.abs(points) == np.finfo(np.float32).max] = np.inf
    if not np.array_equal(stretch, np.eye(3)):
        with np.errstate(invalid="ignore"):  # of coordinates at no finite place, which are refused later
            vertices = vertices @ stretch.T
    mirror = half_plane(obj, vertices, stretch)
    yield 0.8
    digest = fingerprints.digest(vertices, triangles, polygon)
    return Shape(obj.session_uid, vertices, triangles, polygon, stretch, mirror, hint, digest, fingerprint,
                 _notes(obj, len(mirror) > 0), _problem(obj, int(polygon[-1]) + 1 if len(polygon) else 0))


def world_stretch(obj: bpy.types.Object) -> np.ndarray:
    """What the object's world matrix does to its mesh besides turning and moving it, (3, 3).

    The symmetric factor of the polar decomposition, rounded so that it does not change when the object
    is only rotated. A mirrored object gives that of the object itself.
    """
    matrix = np.array(world_matrix(obj), dtype=np.float64)[:3, :3]
    if not np.isfinite(matrix).all() or not matrix.any():
        return matrix
    _, scales, axes = np.linalg.svd(matrix)
    stretch = (axes.T * scales) @ axes
    return np.round(stretch, 5 - round(float(np.log10(scales.max()))))


def unstretch(stretch: np.ndarray) -> np.ndarray:
    """The (3, 3) matrix that takes coordinates of a shape back to those of its mesh; see ``Shape.stretch``."""
    return np.linalg.pinv(stretch)


def face_graph(obj: bpy.types.Object, shape: Shape | None = None) -> tuple[FaceGraph, CornerTable]:
    """Which faces of an object's mesh share an edge, with areas and lengths, and their corners; Object Mode.

    In coordinates of the shape, see ``Shape.vertices``. Edges go across seams as Decompose does, see
    ``mesh_arrays.joined_table``; corners have their own vertices, each of which is in a part. shape : what
    ``read_shape`` gives for the object, if it is known already.
    """
    shape, mesh = shape or read_shape(obj), obj.data
    table = mesh_arrays.joined_table(mesh, shape.vertices)
    return _graph_of(table, shape.face_area), replace(table, corner_vertex=mesh_arrays.face_corners(mesh)[0])


def stretched_graphs(obj: bpy.types.Object, *stretches: np.ndarray) -> list[FaceGraph]:
    """The faces of an object's mesh with areas and lengths as ``face_graph`` gives them, once for each (3, 3) stretch.

    Not in Edit Mode.
    """
    points, divided = shown_points(obj).astype(np.float64), mesh_arrays.triangles(obj.data)
    each = [points @ stretch.T for stretch in stretches]
    return [_graph_of(mesh_arrays.joined_table(obj.data, stretched), _face_area(stretched, *divided))
            for stretched in each]


def _graph_of(table: CornerTable, area: np.ndarray) -> FaceGraph:
    """Which faces of a table share an edge; area : (p,) float64."""
    pairs, edge = table.face_pairs()
    return FaceGraph(table.n_faces, pairs, table.edge_length(edge), area)


def _face_area(points: np.ndarray, triangles: np.ndarray, polygon: np.ndarray) -> np.ndarray:
    """Area of each face, (p,) float64, from its triangles, (m, 3) int64; polygon : (m,) int64, the face of each."""
    a, b, c = points[triangles].transpose(1, 0, 2)
    return np.bincount(polygon, 0.5 * lengths(cross(b - a, c - a)))


def face_centers(obj: bpy.types.Object) -> np.ndarray:
    """Mean of the corners of each face, (p, 3) float64, along the object's axes in units of the world."""
    points = shown_points(obj).astype(np.float64) @ world_stretch(obj).T
    return mesh_arrays.corner_table(obj.data).face_means(points)


def _problem(obj: bpy.types.Object, n_faces: int) -> Sentence | None:
    """What to do where modifiers make the faces that are seen, as Skin, Screw and Geometry Nodes do; else None."""
    if n_faces >= MIN_FACES or not obj.modifiers:
        return None
    seen = obj.evaluated_get(bpy.context.evaluated_depsgraph_get()).data
    if len(seen.polygons) < MIN_FACES:
        return None
    return Sentence("The faces of {name} are made by its modifiers. Apply these (Object > Convert > Mesh) and try "
                    "again.", name=obj.name)


def _notes(obj: bpy.types.Object, is_half: bool) -> tuple[Sentence, ...]:
    notes = []
    # One of ours only moves the parts in the view; and the mirror of half a model was there.
    count = sum(not (modifier.name.startswith("Reeb Parts") or modifiers.only_shades(modifier))
                for modifier in obj.modifiers) - is_half
    if count == 1:
        notes.append(Sentence("{name} was decomposed as it is before its modifier was applied.", name=obj.name))
    elif count:
        notes.append(Sentence("{name} was decomposed as it is before its {n} modifiers were applied.",
                              name=obj.name, n=count))
    if any(modifier.type == "BOOLEAN" for modifier in obj.modifiers):
        notes.append(Sentence("Faces that a Boolean modifier adds to {name} are in no part and have no color.",
                              name=obj.name))
    if obj.data.users > 1 and (users := len(targets.users(obj.data))) > 1:
        notes.append(Sentence("{n} objects share this mesh; all of them show its parts.", n=users))
    return tuple(notes)

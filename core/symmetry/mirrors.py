# SPDX-License-Identifier: GPL-3.0-or-later
"""The mirror symmetry of the caller's mesh: planes of the whole or of its bodies, and how its faces hang together."""

from __future__ import annotations

from dataclasses import dataclass, field, replace

import numpy as np

from ..arrays.int64 import arange
from ..mesh.labels import majority
from ..mesh.triangles import TriMesh
from ..surface.preparation import MAX_EDGE, Component, WorkingMesh, split_long_edges
from .group import SymmetryGroup
from .images import Images
from .plane import MirrorPlane
from .search import LEAST, mirror_plane
from .small_faces import SmallFaces
from .topology import TopologyMirror, topology_mirror

SURE = 0.95  # share of the area that a plane must mirror for nothing that was found to speak against it
LEAST_BODY = 0.1  # share of the area below which a body has no plane of its own
WHOLE_BUDGET = 50_000  # number of faces up to which several bodies as a whole are refined without an early stop
LARGEST_GROUP = 64  # upper bound of the number of symmetries of a shape
# Share of the area with both kinds of twins for which these must be the same: else a plane mirrors a shape one way, and
# how faces hang together another way.
AGREEING = 0.5


@dataclass(frozen=True, eq=False)
class Mirror:
    """A mirror symmetry, and what it does to the caller's p faces; all arrays are empty without one.

    Attributes
    ----------
    plane : (4,) or (0,) float64
        Normal, and distance from the origin; empty if the mesh is symmetric in another pose only.
    twin : (p,) int64
        Mirror image of each face; -1 for none.
    height : (p,) float64
        Signed distance of each face from the plane, or the side on which it lies; 0 for a face that is its own image,
        or that has none.
    first : float
        1.0 or -1.0, the side of the first face beside the plane: it leads where both sides are equally good.
    exact : bool
        Whether all faces are exact mirror images of others, or of themselves; or whether twins hang together alike.
    across : tuple of Mirror
        Of an exact one: others across it and each other that are exact, too. Of one of faces that are too large: those
        of ``within``.
    within : tuple of Images
        If the faces are too large to be mirrored, what the planes in which smaller ones are to be do, this one first;
        then a twin is the face that most of an image lies in.
    group : SymmetryGroup or None
        Of an exact one, if other exact planes meet it or each other at less than a right angle, as those of a star do:
        the group that all of them generate.
    beside : (p,) float64
        Signed distance of each face from a plane that is none of the group's; empty without a group.
    share : float
        Share of the area that the plane mirrors, 0..1.
    """

    plane: np.ndarray
    twin: np.ndarray
    height: np.ndarray
    first: float = 1.0
    exact: bool = False
    across: tuple[Mirror, ...] = ()
    within: tuple[Images, ...] = ()
    group: SymmetryGroup | None = None
    beside: np.ndarray = field(default_factory=lambda: np.empty(0))
    share: float = 0.0

    @property
    def sure(self) -> bool:
        """Whether nothing that was found on one side speaks against it."""
        return self.exact or self.share >= SURE

    @classmethod
    def of(cls, mesh: TriMesh, polygon: np.ndarray, n_polygons: int) -> Mirror | None:
        """The plane of symmetry of small faces that lie in some of the caller's; None if there is none."""
        faces = SmallFaces(mesh, polygon, n_polygons)
        plane = mirror_plane(faces)
        if plane is None:
            return None
        images = Images(faces, plane)
        if (images.twins < 0).all():
            return None
        across = tuple(cls._in(other.plane, other.exact_twins, mesh, polygon) for other in images.exact[1:])
        if images.within:
            across = tuple(cls._in(other.plane, other.twins, mesh, polygon) for other in images.within[1:])
        mirror = replace(cls._in(plane, images.twins, mesh, polygon), exact=bool(images.exact), across=across,
                         within=tuple(images.within))
        return mirror._with_group([cls._in(other.plane, other.exact_twins, mesh, polygon) for other in images.meeting])

    def _with_group(self, meeting: list[Mirror]) -> Mirror:
        """This one with the group that it, those across it and some that meet at other angles generate."""
        if not meeting:
            return self
        planes = (self, *self.across, *meeting)
        twins = np.array([plane.twin for plane in planes])
        group = SymmetryGroup.generated(np.where(twins < 0, arange(len(self.twin)), twins), LARGEST_GROUP)
        if group is None:
            return self
        # The normal of this plane is the sum of all normals, each with a factor of its own: it is none of the planes.
        steps = np.modf(arange(1, len(planes) + 1) * np.sqrt(2.0))[0] + 0.5
        beside = sum(step * plane.height for step, plane in zip(steps, planes, strict=True))
        return replace(self, group=group, beside=beside)

    def parting(self, part: np.ndarray) -> Mirror:
        """Of this plane and those across it the one in which most faces are in a part that has another as its image.

        A figure whose front is the image of its back, too, is left and right in this one. This one if several are
        equal. part : (p,) int64.
        """
        if not self.across:
            return self
        count = int(part.max(initial=-1)) + 1

        def limbs(plane: Mirror) -> int:
            image = np.where(plane.twin >= 0, part[plane.twin], -1)
            image = majority(part, image + 1, np.ones(len(part)), count) - 1
            return int(np.count_nonzero((image[part] >= 0) & (image[part] != part)))

        return max((self, *self.across), key=limbs)

    @classmethod
    def of_topology(cls, found: TopologyMirror) -> Mirror:
        """The symmetry of a mesh in another pose: without a plane."""
        return cls(np.empty(0), found.twin, found.side.astype(np.float64), exact=True)

    def with_topology(self, found: TopologyMirror, area: np.ndarray) -> Mirror:
        """This one with the twins that follow from how faces hang together, which are exact whatever the pose.

        Faces without such a twin keep that in the plane. This one itself if it is exact, or if both disagree.
        area : (p,) float64.
        """
        both = (self.twin >= 0) & (found.twin >= 0)
        if self.exact or area[both & (self.twin == found.twin)].sum() < AGREEING * area[both].sum():
            return self
        side = found.side if area @ (found.side * self.height) >= 0 else -found.side
        by_plane = (found.twin < 0) & (self.twin >= 0) & (found.twin[self.twin] < 0)
        return replace(self, twin=np.where(by_plane, self.twin, found.twin),
                       height=np.where(by_plane, self.height, side), within=(), across=(), exact=True)

    @classmethod
    def of_faces(cls, images: Images, mesh: TriMesh) -> Mirror:
        """A plane that is known, and what it does to the small faces of a mesh."""
        if images.faces.mesh is not mesh:
            images = Images(SmallFaces.of(mesh), images.plane)
        return cls._in(images.plane, images.small, mesh, arange(mesh.n_faces))

    @classmethod
    def _in(cls, plane: MirrorPlane, twin: np.ndarray, mesh: TriMesh, polygon: np.ndarray) -> Mirror:
        """A plane and its twins, (p,), with how far beside it faces lie."""
        n_polygons = len(twin)
        area, beside = np.bincount(polygon, mesh.face_area, n_polygons), plane.heights(mesh.face_centroids)
        height = np.bincount(polygon, mesh.face_area * beside, n_polygons)
        height = np.divide(height, area, out=np.zeros_like(height), where=area > 0)
        height[twin == arange(n_polygons)] = 0.0
        clear = np.abs(beside) >= 0.5 * np.abs(beside).max()
        first = float(np.sign(beside[clear.argmax()]))
        return cls(np.append(plane.normal, plane.offset), twin, height, first, share=plane.share)

    @classmethod
    def joined(cls, mirrors: list[Mirror]) -> Mirror:
        """Several that concern different faces as one; the plane is that of the first."""
        if not mirrors:
            return cls(np.empty(0), np.empty(0, np.int64), np.empty(0))
        return cls(mirrors[0].plane, np.max([mirror.twin for mirror in mirrors], axis=0),
                   np.sum([mirror.height for mirror in mirrors], axis=0))


def find_mirrors(working: WorkingMesh, components: list[Component], n_polygons: int) -> list[Mirror]:
    """Find the mirror symmetry of the whole, or, if it has no plane, the planes of large bodies.

    Without any plane the mesh may still be symmetric but for its pose, see ``topology_mirror``.

    Parameters
    ----------
    working : WorkingMesh
    components : list of Component
        Those that were decomposed.
    n_polygons : int
        Number of the caller's faces.

    Returns
    -------
    mirrors : list of Mirror
        The largest body first.
    """
    if len(components) == 1 and len(components[0].faces) == working.mesh.n_faces:
        mesh, polygon, large = components[0].mesh, components[0].polygon, []
    else:
        mesh, parent = split_long_edges(working.mesh, MAX_EDGE * np.sqrt(working.mesh.area), WHOLE_BUDGET)
        polygon = working.polygon[parent]
        large = [part for part in components if part.mesh.area >= LEAST_BODY * working.mesh.area]
    whole = Mirror.of(mesh, polygon, n_polygons)
    if whole is not None and not all(_covers(whole, part) for part in large):
        whole = None
    if whole is not None and whole.exact:  # nothing can add to it
        return [whole]
    posed = topology_mirror(working.mesh, working.polygon, n_polygons)
    if whole is not None:
        area = np.bincount(working.polygon, working.mesh.face_area, n_polygons)
        return [whole if posed is None else whole.with_topology(posed, area)]
    large.sort(key=lambda part: -part.mesh.area)
    of_bodies = [Mirror.of(part.mesh, part.polygon, n_polygons) for part in large]
    found = [mirror for mirror in of_bodies if mirror is not None]
    return found or ([] if posed is None else [Mirror.of_topology(posed)])


def _covers(mirror: Mirror, component: Component) -> bool:
    """Whether a plane is one of symmetry of a component, too, or mirrors it on another."""
    has_twin = mirror.twin[component.polygon] >= 0
    return bool(component.mesh.face_area[has_twin].sum() >= LEAST * component.mesh.area)

# SPDX-License-Identifier: GPL-3.0-or-later
"""What can be repaired of a piece: faces that look inwards, holes, and caps that cross something."""

from __future__ import annotations

import bmesh
import bpy
import numpy as np
from bmesh.types import BMesh

from ...core.surface.orientation import against_neighbors
from .. import transaction
from ..ours import made_objects
from ..ours.surroundings import Surroundings
from ..reading import mesh_arrays, mesh_groups
from ..reading.matrix_layers import as_bmesh
from . import mesh_replacement, piece_checks, piece_objects
from .closing import cap_looks, caps
from .piece_checks import Check


def repair(piece: bpy.types.Object, stretch: np.ndarray) -> tuple[Check, Check]:
    """Give a piece a mesh that is repaired as far as that is possible; Object Mode.

    Faces that look otherwise than their neighbors, or inwards, are turned, holes are closed, and caps that cross
    something are made anew of flat triangles; what does not make the piece better is left. The old mesh is removed.

    Parameters
    ----------
    piece : bpy.types.Object
        Its mesh is its own.
    stretch : (3, 3) float64
        What the object does to its mesh, see bridge.world_stretch.

    Returns
    -------
    before, after : Check
    """
    old = piece.data
    found = piece_checks.check(old, stretch)
    before, mesh = found[0], old
    for step, faults in ((_agreeing, _wrong_ways), (_closed, _faults), (_turned, _wrong_ways),
                         (_without_crossing_caps, _faults)):
        candidate = mesh.copy()
        step(candidate, found[1])
        cap_looks.map_caps(candidate)
        checked = piece_checks.check(candidate, stretch)
        if faults(checked[0]) < faults(found[0]):
            mesh, found = _replaced(mesh, candidate, old), checked
        else:
            bpy.data.meshes.remove(candidate)
    if mesh != old:
        ours = made_objects.is_as_made(piece, piece_objects.former_looks, Surroundings.now())
        mesh_replacement.replace(piece, mesh)
        if ours:
            transaction.keep_keys(piece, made_objects.MADE)
            made_objects.mark([piece])
    piece_checks.keep(piece, found[0])
    return before, found[0]


def _faults(found: Check) -> int:
    return (found.open_edges + found.branching_edges + found.contrary_edges + found.crossing_faces
            + found.inside_out)


def _wrong_ways(found: Check) -> int:
    """What turning faces can mend. Polygons that are turned are divided otherwise, so that others cross each other."""
    return found.contrary_edges + found.inside_out


def _replaced(mesh: bpy.types.Mesh, better: bpy.types.Mesh, old: bpy.types.Mesh) -> bpy.types.Mesh:
    """The better mesh; the other one is removed unless it is what there was before."""
    if mesh != old:
        bpy.data.meshes.remove(mesh)
    return better


def _agreeing(mesh: bpy.types.Mesh, faults: piece_checks.Faults) -> None:
    """Turn faces that look otherwise than their neighbors."""
    flip = against_neighbors(mesh_arrays.corner_table(mesh))
    with as_bmesh(mesh, normals=True) as bm:
        bm.faces.ensure_lookup_table()
        bmesh.ops.reverse_faces(bm, faces=[bm.faces[i] for i in np.flatnonzero(flip).tolist()], flip_multires=True)
        mesh_groups.write(bm, mesh)


def _turned(mesh: bpy.types.Mesh, faults: piece_checks.Faults) -> None:
    """Turn all faces round."""
    mesh.flip_normals()


def _closed(mesh: bpy.types.Mesh, faults: piece_checks.Faults) -> None:
    """Close all holes."""
    with as_bmesh(mesh, normals=True) as bm:
        _fill_holes(bm)
        mesh_groups.write(bm, mesh)


def _without_crossing_caps(mesh: bpy.types.Mesh, faults: piece_checks.Faults) -> None:
    """Remove the caps with faces that cross others, and close the holes that they leave."""
    with as_bmesh(mesh, normals=True) as bm:
        layer = bm.faces.layers.int.get(caps.CAP)
        if layer is None:
            return
        bm.faces.ensure_lookup_table()
        wrong = {face for i in np.flatnonzero(faults.crossing).tolist() if (face := bm.faces[i])[layer]}
        reached = list(wrong)
        while reached:
            beside = {face for edge in reached.pop().edges for face in edge.link_faces if face[layer]} - wrong
            wrong |= beside
            reached += beside
        bmesh.ops.delete(bm, geom=list(wrong), context="FACES")
        _fill_holes(bm)
        mesh_groups.write(bm, mesh)


def _fill_holes(bm: BMesh) -> None:
    """Close holes by triangles, which are caps."""
    layer = caps.cap_layer(bm)
    before = set(bm.faces)
    bmesh.ops.holes_fill(bm, edges=[edge for edge in bm.edges if edge.is_boundary], sides=0)
    new = [face for face in bm.faces if face not in before]
    new = bmesh.ops.triangulate(bm, faces=new, ngon_method="BEAUTY")["faces"] if new else []
    for face in new:
        face[layer] = 1

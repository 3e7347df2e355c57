# SPDX-License-Identifier: GPL-3.0-or-later
"""Parts as meshes of their own."""

import bmesh
import numpy as np



def part_mesh(mesh, mask: np.ndarray):
    """A copy of a mesh with some of its faces only, and all they carry.

    Parameters
    ----------
    mesh : bpy.types.Mesh
        In Object Mode.
    mask : (p,) bool
        Faces to keep; loose edges and vertices are left out.

    Returns
    -------
    copy : bpy.types.Mesh
        With UVs, colours, groups, shape keys and materials; without the stored parts.
    """
    copy = mesh.copy()
    copy.property_unset("reeb_parts")
    bm = bmesh.new()
    try:
        bm.from_mesh(copy)
        bm.faces.ensure_lookup_table()
        bmesh.ops.delete(bm, geom=[bm.faces[i] for i in np.flatnonzero(~mask).tolist()], context="FACES")
        bmesh.ops.delete(bm, geom=[v for v in bm.verts if not v.link_faces], context="VERTS")
        bm.to_mesh(copy)
    finally:
        bm.free()
    return copy

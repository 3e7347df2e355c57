# SPDX-License-Identifier: GPL-3.0-or-later
"""The symmetry of a surface, found from the mesh alone: planes of mirroring, turns, and which face is whose image.

What makes parts symmetric by it is ``cuts.symmetric``, on the caller's faces.

- ``plane``: a plane of symmetry, and what it does to points
- ``small_faces``: small faces that stand for a surface, and the search for those nearest to others
- ``search``: the plane in which a surface is its own mirror image
- ``images``: the mirror twin of each face
- ``topology``: the twins that follow from how polygons hang together, whatever the pose
- ``group``: the mirrorings and turns that map a shape onto itself
- ``mirrors``: all of this for the caller's mesh and its bodies
- ``halves``: half models, whose other side is their mirror image
"""

# SPDX-License-Identifier: GPL-3.0-or-later
"""The surface that the method works on: the mesh repaired and divided in components, and what is measured on it.

Made ready for a field:

- ``ordering``: an order of faces and vertices that the shape alone decides
- ``preparation``: the caller's surface, repaired and refined, and its components
- ``small_faces``: small faces that stand for a surface, and the search for those nearest to others
- ``orientation``: which side of a face is outside
- ``winding``: what lies inside of a surface, by winding numbers
- ``contact``: where the pieces of a surface touch
- ``reach``: triangles that rays and other triangles can meet
- ``coarsening``: coarser copies of a dense mesh

Measured on it:

- ``denoising``: the noise of a surface, as of a scan, and the surface without it
- ``curvature``: how a surface bends
- ``balls``: the largest balls that touch a surface from one side
- ``sheets``: flat pieces, under which there is no solid, inflated

Symmetry:

- ``symmetry``: the plane in which a surface is its own mirror image
- ``mirror_plane``: such a plane, and what it does to points
- ``mirror_images``: the mirror twin of each face
- ``topology_mirror``: the twins that follow from how polygons hang together, whatever the pose
- ``halves``: half models, whose other side is their mirror image
"""

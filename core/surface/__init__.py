# SPDX-License-Identifier: GPL-3.0-or-later
"""Geometry and labels on it: from the caller's arrays to connected triangle meshes that are ready for a field.

Where data enters:

- ``arguments``: what a caller gives as arrays, taken or refused
- ``mesh``: the triangle mesh that every stage works on, and its checks
- ``polygons``: the caller's mesh with its polygons cut into triangles
- ``ears``: how polygons are cut into triangles
- ``copies``: faces that lie on others with the same corners
- ``corners``: the caller's polygons, corner by corner
- ``cut_edges``: the edges between parts, looked at again and again
- ``half_edges``: the sides of polygons, and which lies across which edge

The working copy, and what is measured on it:

- ``preparation``: the caller's surface, repaired and refined, and its components
- ``ordering``: an order of faces and vertices that the shape alone decides
- ``borders``: border vertices that are one, apart at seams only
- ``small_faces``: small faces that stand for a surface, and the search for those nearest to others
- ``orientation``: which side of a face is outside
- ``winding``: what lies inside of a surface, by winding numbers
- ``contact``: where the pieces of a surface touch
- ``reach``: triangles that rays and other triangles can meet
- ``coarsening``: coarser copies of a dense mesh
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

Labels:

- ``labels``: labels on faces: votes, boundaries, connected labels
"""

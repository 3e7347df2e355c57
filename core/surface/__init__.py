# SPDX-License-Identifier: GPL-3.0-or-later
"""The surface that the method works on: the mesh repaired and divided in components, and what is measured on it.

Made ready for a field:

- ``ordering``: an order of faces and vertices that the shape alone decides
- ``diagonals``: triangles of polygons that the shape alone decides
- ``preparation``: the caller's surface, repaired and refined, and its components
- ``stitching``: borders on whose edges the vertices of others lie, joined
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
"""

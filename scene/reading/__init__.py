# SPDX-License-Identifier: GPL-3.0-or-later
"""What is read of objects and their meshes: arrays, elements, hints, places.

- ``mesh_arrays``: the arrays of a mesh
- ``fingerprints``: what tells that a mesh was edited, or moved as a whole
- ``elements``: the elements of a mesh with all that they carry, some of them taken or others put on
- ``element_layers``: reads these from a mesh, and makes meshes of them
- ``mesh_groups``: the vertex groups of a mesh
- ``matrix_layers``: a BMesh with matrices, too
- ``half_models``: objects whose first modifier is a Mirror
- ``face_hints``: materials and such, for cuts to follow
- ``modified``: the mesh as it is seen, with its modifiers applied
- ``seen_points``: where the vertices of a mesh are seen
- ``placing``: where objects are in the world, and how long its unit is
"""

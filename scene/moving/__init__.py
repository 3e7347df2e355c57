# SPDX-License-Identifier: GPL-3.0-or-later
"""Parts that move: bones, rigid bodies, hulls to collide with.

- ``armature``: bones, and the weights with which they move the mesh
- ``skeleton``: where these bones are
- ``hulls``: convex hulls to collide with
- ``rigid_bodies``: pieces held together by joints of Blender's simulation
"""

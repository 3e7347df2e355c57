# SPDX-License-Identifier: GPL-3.0-or-later
"""The caller's mesh, from arrays to triangles and polygons whose tables are at hand, and labels on its faces.

Where data enters:

- ``arguments``: what a caller gives as arrays, taken or refused
- ``triangles``: the triangle mesh that every stage works on, and its checks
- ``polygons``: the caller's mesh with its polygons cut into triangles
- ``ears``: how polygons are cut into triangles
- ``copies``: faces that lie on others with the same corners
- ``interior``: faces within a solid, in its plane of symmetry
- ``pieces``: what hangs together by places, and what is nearest on another piece
- ``skins``: second skins, such as an outline
- ``cavities``: inner walls of hollow bodies
- ``walls``: the inner sides of thin walls around a hollow that is open
- ``grounds``: floors, plinths and backdrops, on which the rest stands
- ``terrain``: ground that is one surface with what stands on it, as in a scan
- ``borders``: border vertices that are one, apart at seams only

How polygons hang together:

- ``corners``: the caller's polygons, corner by corner
- ``cut_edges``: the edges between parts, looked at again and again
- ``half_edges``: the sides of polygons, and which lies across which edge

What lies on them:

- ``labels``: labels on faces: votes, boundaries, how far two labelings disagree
- ``face_graph``: the graph of faces across edges, and labels on it filled in, made connected, straightened
"""

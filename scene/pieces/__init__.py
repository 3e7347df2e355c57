# SPDX-License-Identifier: GPL-3.0-or-later
"""Parts as objects of their own, called pieces.

- ``separation``: makes the objects
- ``piece_objects``: knows them
- ``origins``: whose they are
- ``piece_checks``: measures them
- ``piece_repairs``: repairs what it can
- ``cut_list``: their cuts as a list on the object

Their meshes:

- ``part_meshes``: makes them
- ``mesh_replacement``: puts another in place of one
- ``sculpted_pieces``: makes those of a mesh with Multires
- ``by_extent``: modifiers that work by the extent of the whole mesh, and would shape a piece otherwise
- ``named_outputs``: vertex groups and attributes of ours that the user's modifiers work by
- ``welding``: joins seams before
- ``cut_curves``: curves that they are cut along
- ``smooth_faces``: divides faces along these
- ``box_fitting``: cuts what is longer than a box
- ``closing``: caps where they were cut
"""

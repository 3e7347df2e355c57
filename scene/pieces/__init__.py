# SPDX-License-Identifier: GPL-3.0-or-later
"""Parts as objects of their own, called pieces: their meshes, what closes them, and what is wrong with them.

``separation`` makes the objects, ``piece_objects`` knows them, ``origins`` whose they are; ``piece_checks`` measures
them and ``piece_repairs`` repairs what it can.

The meshes: ``part_meshes`` makes them, ``sculpted_pieces`` those of a mesh with Multires; ``welding`` joins seams
before, ``smooth_faces`` divides faces along smooth cuts, ``box_fitting`` cuts what is longer than a box.

Caps, the faces that close them: ``caps`` makes them in the holes of which ``cut_holes`` knows the whole, ``discs``
finds their surfaces (``disc``), ``disc_fitting`` keeps these inside the ``body_surface``, ``cap_junctions`` leads those
of several cuts to one middle, ``cap_looks`` gives them a place in UV maps and a material.
"""

# SPDX-License-Identifier: GPL-3.0-or-later
"""Caps: the faces that close pieces where they were cut.

- ``caps``: makes them
- ``hole_walks``: closed walks around the holes that they close
- ``new_vertices``: vertices inside them, with what those around have
- ``cut_holes``: which holes those are, and what has to be known of the whole for that
- ``discs``: finds their surfaces
- ``disc``: one of these surfaces
- ``disc_fitting``: keeps them inside the model
- ``body_surface``: the surface of the model, which they must not cross
- ``cap_junctions``: leads those of several cuts to one middle
- ``cap_looks``: gives them a place in UV maps and a material
"""

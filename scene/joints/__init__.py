# SPDX-License-Identifier: GPL-3.0-or-later
"""Joints between pieces: pegs and what they go into, dowels and holes for magnets, by Blender's own booleans.

A cut whose joint would leave a piece open, crossing itself or pierced stays without one.

- ``method``: the whole
- ``cuts``: what pieces share
- ``piece_surfaces``: how much room there is
- ``planning``: asks core.uses.joints.places where joints go and how large they are
- ``solids``: makes pegs and holes
- ``fitting``: puts them in and checks every result
"""

from .method import CutJoints, Dowel, JointedPieces, joining, wanted_joints

__all__ = ["CutJoints", "Dowel", "JointedPieces", "joining", "wanted_joints"]

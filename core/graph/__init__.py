# SPDX-License-Identifier: GPL-3.0-or-later
"""The Reeb graph of a field: from the values at the vertices to slab pieces, contours, nodes and arcs.

- ``level_sets``: the surface cut into slabs; their pieces, the slab pieces, and contours
- ``bridged_levels``: level sets that run on across bridges between loose parts
- ``critical``: minima, saddles and maxima among the vertices
- ``reeb``: slab pieces and contours contracted to a graph
- ``simplify``: ripples of the graph cancelled
"""

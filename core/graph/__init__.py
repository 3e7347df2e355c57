# SPDX-License-Identifier: GPL-3.0-or-later
"""The Reeb graph of a field: from the values at the vertices to pieces, contours, nodes and arcs.

``level_sets`` cuts the surface into slabs, ``critical`` classifies vertices, ``reeb`` contracts pieces and contours to
a graph, ``simplify`` cancels its ripples. ``contours`` finds a contour on the caller's own faces, to cut a part there.
"""

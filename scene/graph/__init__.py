# SPDX-License-Identifier: GPL-3.0-or-later
"""The Reeb graph in the scene.

- ``graph_finding``: which objects are those of a model's graph
- ``graph_objects``: makes and changes them
- ``graph_removal``: takes them away
- ``arc_curves``: the curve of the arcs among them
- ``graph_follow``: moves them along with a pose or an exploded view
- ``graph_visibility``: hides and shows them with the model
"""

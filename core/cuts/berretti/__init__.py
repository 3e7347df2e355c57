# SPDX-License-Identifier: GPL-3.0-or-later
"""The method of [Berretti2009]: from the level sets and the Reeb graph of a component to candidates.

- ``regions``: regions between events, fused and ranked
- ``fusion``: which regions are fused: small ones, and those that do not stick out
- ``contour_curves``: contours as curves, from edge to edge
- ``boundary_search``: each cut moved along its arc of the Reeb graph to a concavity
- ``method``: runs these steps
"""

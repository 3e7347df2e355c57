# SPDX-License-Identifier: GPL-3.0-or-later
"""The method of [Liu2007]: from the patches of a component to candidates, by one bisection after another.

- ``patch_graph``: a surface reduced to some hundred patches
- ``embedding``: a part of them laid into the plane
- ``outline``: its outline there judged, and points found in different parts
- ``row_cuts``: the best cut between two points
- ``method``: runs these steps
"""

# SPDX-License-Identifier: GPL-3.0-or-later
"""The method of [Liu2007]: from the patches of a component to candidates, by one bisection after another.

``patch_graph`` reduces a surface to some hundred patches, ``embedding`` lays a part of them into the plane, ``outline``
judges its outline there and finds points in different parts, ``row_cuts`` finds the best cut between two points,
``method`` runs these steps.
"""

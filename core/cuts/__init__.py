# SPDX-License-Identifier: GPL-3.0-or-later
"""Cutting a component into candidates, the finest parts, and deciding in which order they merge.

- ``methods``: chooses the method of cutting
- ``berretti``: by the rules of the paper [Berretti2009]
- ``perceptual``: where people cut
- ``lavoue``: where curvature changes [Lavoue2005]
- ``liu``: in two again and again [Liu2007]
- ``foundation``: what all of them begin with
- ``patches``: patches that end at creases, which several methods start from
- ``boosted_trees``: the regression trees that judge cuts and joints
- ``hierarchy``: what all methods give: candidates, and the order in which they merge
- ``minimum_cut``: cuts moved into creases, for the first two methods

What follows every method, on the caller's faces:

- ``joining``: one hierarchy of those of several pieces
- ``face_candidates``: what each of the next steps takes and gives
- ``swarms``: small pieces that are there in numbers and stand alone, such as leaves, are one part
- ``symmetric``: candidates made the same on all sides of a symmetric shape
- ``hinted``: heeds labels that the mesh brings along, such as materials
- ``settling``: lets merge only what touches
"""

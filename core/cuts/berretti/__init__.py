# SPDX-License-Identifier: GPL-3.0-or-later
"""The method of [Berretti2009]: from the level sets and the Reeb graph of a component to candidates.

``regions`` forms regions and ranks them, ``boundary_search`` moves the cuts between them along the Reeb graph to
concavities, ``method`` runs these steps.
"""

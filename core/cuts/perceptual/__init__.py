# SPDX-License-Identifier: GPL-3.0-or-later
"""Cuts where people cut: from the level sets and the field of a component to candidates, by a learned model.

``patches`` divides the surface between creases, ``measures`` and ``thickness`` measure every face once, ``features``
describes a cut by sums of measures, ``boosted_trees`` judges it, ``merging`` merges the weakest cuts first, ``method``
runs these steps.
"""

# SPDX-License-Identifier: GPL-3.0-or-later
"""The method of [Lavoue2005]: from the curvature of a component to candidates.

``clusters`` sorts vertices into classes of like curvature, ``regions`` grows regions of faces from them and ranks the
regions, ``method`` runs these steps.
"""

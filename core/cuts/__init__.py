# SPDX-License-Identifier: GPL-3.0-or-later
"""Cutting a component into candidates, the finest parts, and deciding in which order they merge.

``methods`` chooses the method: ``berretti`` follows the paper [Berretti2009], ``perceptual`` cuts where people cut,
``lavoue`` where curvature changes [Lavoue2005], ``liu`` in two again and again [Liu2007]. All give
``hierarchy.Candidates``; ``minimum_cut`` moves cuts into creases for the first two. What follows takes and gives
``face_candidates.FaceCandidates``, once the candidates are on the caller's faces.
"""

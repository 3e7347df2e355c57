# SPDX-License-Identifier: GPL-3.0-or-later
"""Cutting a component into candidates, the finest parts, and deciding in which order they merge.

``methods`` chooses the method: ``berretti`` follows the paper [Berretti2009], ``perceptual`` cuts where people cut.
Both give ``hierarchy.Candidates``; ``minimum_cut`` moves cuts into creases for both.
"""

# SPDX-License-Identifier: GPL-3.0-or-later
"""Candidates made the same on all sides of a symmetric shape: one side leads, the others get its mirror images.

- ``cells``: candidates of the side that leads, and their images
- ``linkage``: merges that happen together with their images
- ``method``: runs these steps, on each side that may lead, and takes the better result
- ``regions``: runs them on regions of the faces of a dense mesh
"""

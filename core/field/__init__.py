# SPDX-License-Identifier: GPL-3.0-or-later
"""The field of a component: its average geodesic distance (AGD), low on the body and high where the surface protrudes.

- ``geodesic``: distances along the surface
- ``sight``: what a vertex sees of the surface, along straight lines over unfolded triangles
- ``agd``: the distances averaged, normalized and equalized
"""

# SPDX-License-Identifier: GPL-3.0-or-later
"""The field of a component: its average geodesic distance (AGD), low on the body and high where the surface protrudes.

``geodesic`` measures distances along the surface, ``agd`` averages, normalizes and equalizes them.
"""

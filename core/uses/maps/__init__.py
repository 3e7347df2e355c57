# SPDX-License-Identifier: GPL-3.0-or-later
"""Maps of parts in the plane: seams along which they unfold, and how good the maps are.

- ``unfold``: seams along which parts can be unfolded
- ``conformal``: the scale of a map that keeps angles, without making it
- ``stacking``: parts that can lie over each other in a map
- ``distortion``: how much a map changes areas and angles
"""

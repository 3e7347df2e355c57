# SPDX-License-Identifier: GPL-3.0-or-later
"""Uses of a result.

``colors`` chooses colors for parts, ``report`` describes a result as JSON, ``pictures`` draws it, ``bones`` makes
bones for an armature and ``skinning`` their weights, ``clean_cuts`` smooth curves to cut along, ``cap_surfaces``
helps to close what is cut. ``unfold`` finds seams along which parts can be unfolded, by the scale that ``conformal``
predicts; ``stacking`` finds parts that can lie over each other in the map, and ``distortion`` measures it.
``descriptors`` finds parts that are alike, ``correspondence`` the same parts on another model. ``hulls`` makes convex
hulls, ``threemf`` writes parts for slicers, and ``options`` reads parameters from a command line.
"""

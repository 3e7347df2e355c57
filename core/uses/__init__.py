# SPDX-License-Identifier: GPL-3.0-or-later
"""Uses of a result.

``colors`` chooses colors for parts, ``report`` describes a result as JSON, ``pictures`` draws it, ``bones`` makes bones
for an armature, ``unfold`` finds seams along which parts can be unfolded, ``clean_cuts`` smooth curves to cut along,
and ``options`` reads parameters from a command line.
"""

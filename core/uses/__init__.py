# SPDX-License-Identifier: GPL-3.0-or-later
"""Uses of a result.

``colors`` chooses colors for parts, ``report`` describes a result as JSON, ``bones`` makes bones for an armature and
``unfold`` finds seams along which parts can be unfolded.
"""

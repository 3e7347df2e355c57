# SPDX-License-Identifier: GPL-3.0-or-later
"""Uses of a result: ``colors`` for parts, ``report`` as JSON, ``bones`` for an armature, and seams to ``unfold`` parts."""

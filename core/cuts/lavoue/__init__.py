# SPDX-License-Identifier: GPL-3.0-or-later
"""The method of [Lavoue2005]: from the curvature of a component to candidates.

- ``clusters``: vertices sorted into classes of like curvature
- ``regions``: regions of faces grown from them, and merged
- ``method``: runs these steps
"""

# SPDX-License-Identifier: GPL-3.0-or-later
"""Which parts of different pieces belong together: pairs are judged, then joined, surest first.

- ``part_shapes``: what a part looks like by itself
- ``pairs``: pairs of parts that are near each other, and what they look like together
- ``distant``: pairs of parts at any distance
- ``repetition``: what is there several times
- ``linkage``: groups joined in the order of how surely their members belong together
- ``method``: runs these steps
"""

# SPDX-License-Identifier: GPL-3.0-or-later
"""Names for parts that say what they are: a word where the shape is clear enough, else the place and the kind.

- ``touching``: which parts touch, and which is the body
- ``shapes``: where parts are and how large
- ``method``: the rules by which they get their names
"""

# SPDX-License-Identifier: GPL-3.0-or-later
"""What every stage does with whole arrays, and which knows of no mesh.

- ``int64``: whole numbers that have as many bits on every system
- ``indexing``: orders, sums by group, ranges, numbering
- ``hashes``: numbers that are equal for equal things, and hardly ever for others
- ``ties``: numbers that are equal but for rounding
- ``components``: what hangs together
- ``vectors``: products and lengths of many vectors
- ``pairs``: pairs of whole numbers
- ``systems``: sparse linear systems of surfaces
- ``nearest``: the search of many points for their nearest
- ``nearest_seeds``: the nearest of several seeds along the ways of a graph
"""

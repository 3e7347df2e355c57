# SPDX-License-Identifier: GPL-3.0-or-later
"""Uses of a result.

What is said and shown of it:

- ``colors``: colors for parts
- ``report``: the report as JSON
- ``pictures``: pictures without a renderer
- ``naming``: names for parts that say what they are
- ``graph_folding``: which nodes and arcs are worth showing beside some parts, and whether they would cover the model
- ``descriptors``: what a part is like, in numbers, to find parts that are alike
- ``correspondence``: the same parts on another model

What is made of it:

- ``moving``: parts that move: bones, rigid bodies, hulls
- ``maps``: parts in the plane: where they unfold, and how evenly

Parts as pieces:

- ``clean_cuts``: smooth curves to cut along
- ``caps``: what closes the pieces there
- ``joints``: what holds them together
- ``sections``: planes in which long pieces are cut, and what lies in them
- ``threemf``: parts in a file for slicers
"""

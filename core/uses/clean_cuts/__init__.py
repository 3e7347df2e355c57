# SPDX-License-Identifier: GPL-3.0-or-later
"""Smooth curves to cut along, in place of the saw teeth of the faces' edges.

Each part's share of the surface around a vertex is diffused a few edges far, so that a vertex knows how much of its
neighborhood is in which part. A vertex then is in the part with the largest share, and a curve between two parts runs
where their shares are equal: across faces, and through a point inside a face where three parts meet. Diffusing an
indicator and taking its middle level straightens a curve [Merriman1992]; the shares are shifted by what makes the
level pass through the middle of the border as it was, so that no part grows at the cost of another. Where a plane
fits the curve, the curve is the section with the plane. A curve goes through creases that the border follows.

A border that is smooth already stays along the edges of faces, and so does one whose curve would take a part away.

- ``band``: the faces near the borders
- ``shares``: each part's share of the surface around a vertex
- ``sides``: in which part each vertex is, and where curves cross edges
- ``pins``: vertices that curves go through, at creases
- ``planes``: planes in place of curves that they fit
- ``turning``: how much a curve turns
- ``judging``: which curves are used
- ``division``: faces divided where curves run
- ``curves``: the curves as lines to draw
- ``method``: runs these steps
"""

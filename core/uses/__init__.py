# SPDX-License-Identifier: GPL-3.0-or-later
"""Uses of a result.

What is said and shown of it:

- ``colors``: colors for parts
- ``report``: the report as JSON
- ``pictures``: pictures without a renderer
- ``naming``: names for parts that say what they are
- ``graph_folding``: which nodes and arcs are worth showing beside some parts
- ``groups``: where groups of parts that no cuts connect touch
- ``descriptors``: what a part is like, in numbers, to find parts that are alike
- ``correspondence``: the same parts on another model

Parts that move:

- ``bones``: bones for an armature
- ``skinning``: the weights with which bones move a surface
- ``motion``: how groups of points have moved
- ``body_joints``: joints between parts as rigid bodies
- ``hulls``: convex hulls to collide with

Maps:

- ``unfold``: seams along which parts can be unfolded
- ``conformal``: the scale of a map that keeps angles, without making it
- ``stacking``: parts that can lie over each other in a map
- ``distortion``: how much a map changes areas and angles

Parts as pieces:

- ``clean_cuts``: smooth curves to cut along
- ``networks``: networks of such curves, taken apart where few go across
- ``rims``: rims that lie within each other
- ``cap_surfaces``: surfaces across closed curves
- ``sleeves``: the faces beside a curve, which a cap may follow
- ``cap_maps``: caps in a UV map
- ``sections``: planes in which long pieces are cut, and what lies in them
- ``joint_shapes``: the solids of pegs, keys and dowels
- ``joint_places``: where two pieces can be joined
- ``threemf``: parts in a file for slicers
"""

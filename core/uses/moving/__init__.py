# SPDX-License-Identifier: GPL-3.0-or-later
"""Parts that move: bones and their weights, rigid bodies, hulls to collide with.

- ``groups``: where groups of parts that no cuts connect touch
- ``part_images``: which parts are mirror images of which
- ``bone_trees``: which bone hangs on which
- ``bones``: bones for an armature
- ``limbs``: bones for those parts alone that can be bent where they are cut
- ``skinning``: the weights with which bones move a surface
- ``motion``: how groups of points have moved
- ``body_joints``: joints between parts as rigid bodies
- ``hulls``: convex hulls to collide with
"""

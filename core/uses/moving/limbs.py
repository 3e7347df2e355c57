# SPDX-License-Identifier: GPL-3.0-or-later
"""Bones for limbs: a part that cannot be bent where it is cut moves with the part that it hangs on.

That is a part which is cut from the others at no neck, such as the belly of a vase: a bone of its own would fold the
surface there, or take of its volume.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ...arrays.int64 import arange
from ...mesh.cut_edges import CutEdges
from .bone_trees import following
from .bones import Bones, BoneSurface, border_of, part_bones
from .part_images import PartImages

# A cut is a neck if the middles of both sides are so many of its radii away from its middle, and if this share of all
# that divides the two sides is the cut between a part and the part that it hangs on, not one beside another part. In a
# ring, half is; it cannot be bent.
_AWAY, _OWN = 0.6, 0.51


def limb_bones(surface: BoneSurface) -> tuple[Bones, np.ndarray, np.ndarray]:
    """Make bones for parts that can be bent where they are cut; all other parts have that of the part they hang on.

    Parameters
    ----------
    surface : BoneSurface

    Returns
    -------
    bones : Bones
    bone_part : (k,) int64
        The part that each bone is of.
    part_bone : (count,) int64
        The bone that moves each part.
    """
    surface, owner = surface.joined(), arange(surface.count)
    while True:
        bone_part, part_bone = np.unique(owner, return_inverse=True)
        images = None if surface.images is None else surface.images.of_bones(bone_part, part_bone)
        in_limbs = replace(surface, labels=part_bone[surface.labels], images=images,
                           line_part=np.where(surface.line_part < 0, -1, part_bone[surface.line_part]),
                           ground=surface.grounds[bone_part])
        bones = part_bones(in_limbs)
        hangs = _hanging(bones, _necks(in_limbs, bones), images)
        if not hangs.any():
            return bones, bone_part, part_bone
        owner = np.where(hangs, bone_part[bones.parent], bone_part)[part_bone]


def _hanging(bones: Bones, neck: np.ndarray, images: PartImages | None) -> np.ndarray:
    """Which bones, (count,) bool, become one with those that they hang on, of those that begin at no neck.

    Each waits for all that follows it: once a leg of several parts is one, its cut may be a neck. And for its image.
    """
    hangs = ~neck if images is None else ~neck[images.first]
    last = hangs & ((following(bones.parent, bones.order) & hangs).sum(axis=1) == 1)
    return last if images is None else last & last[images.image]


def _necks(surface: BoneSurface, bones: Bones) -> np.ndarray:
    """Whether each bone begins at a neck, (count,) bool; true for roots. surface : joined."""
    table, labels, area = surface.off_ground, surface.labels, surface.area
    low, high = table.edge_labels(labels)
    center, standing = surface.table.face_means(table.vertices), ~surface.grounds[labels]
    beyond, neck, cuts = following(bones.parent, bones.order), bones.parent < 0, CutEdges.of(table, labels)
    for bone in np.flatnonzero(~neck).tolist():
        border, length, middle = border_of(table, cuts, beyond[bone])
        if not len(border):  # a piece of its own
            neck[bone] = True
            continue
        pair = sorted((bone, int(bones.parent[bone])))
        own = length[(low[border] == pair[0]) & (high[border] == pair[1])].sum()
        radius = np.linalg.norm(table.vertices[table.edges[border]].mean(axis=1) - middle, axis=1).max()
        away = [np.linalg.norm((area[side, None] * center[side]).sum(axis=0) / max(area[side].sum(), 1e-300) - middle)
                for side in (standing & beyond[bone][labels], standing & ~beyond[bone][labels])]
        neck[bone] = own >= _OWN * length.sum() and min(away) >= _AWAY * radius
    return neck

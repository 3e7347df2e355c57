# SPDX-License-Identifier: GPL-3.0-or-later
"""The group of symmetries of a shape: it is mapped onto itself by mirroring in planes and by turning about an axis."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from ..arrays.int64 import arange


@dataclass(frozen=True, eq=False)
class SymmetryGroup:
    """A group of g symmetries of a shape of p faces; the first element is the identity.

    Attributes
    ----------
    image : (g, p) int64
        The image of each face under each element; -1 for none.
    composition : (g, g) int64
        ``composition[u, v]`` is the element that applies v and then u.
    """

    image: np.ndarray
    composition: np.ndarray

    @classmethod
    def of_planes(cls, twin: np.ndarray) -> SymmetryGroup:
        """The group of the reflections in k planes at right angles; twin : (k, p) int64, images in each plane.

        The bits of an element say in which planes it mirrors: the composition of two is their exclusive or.
        """
        image = arange(twin.shape[1])[None]
        for mirrored in twin:
            image = np.concatenate([image, np.append(mirrored, -1)[image]])
        elements = arange(len(image))
        return cls(image, elements[:, None] ^ elements)

    @classmethod
    def generated(cls, generators: np.ndarray, most: int) -> SymmetryGroup | None:
        """The group that some exact symmetries generate; None if it is too large.

        What the first of them generate comes first: of several elements that take a face to a wedge, one that mirrors
        in planes at right angles.

        generators : (k, p) int64, the image of each face under each. most : upper bound of the number of elements.
        """
        image = [arange(generators.shape[1])]
        known = {image[0].tobytes(): 0}
        for count in range(1, len(generators) + 1):
            # The images grow while they are walked through.
            for further in (then[before] for before in image for then in generators[:count]):
                if known.setdefault(further.tobytes(), len(image)) < len(image):
                    continue
                image.append(further)
                if len(image) > most:
                    return None
        composition = [[known[u[v].tobytes()] for v in image] for u in image]
        return cls(np.array(image), np.array(composition))

    @property
    def elements(self) -> np.ndarray:
        """(g,) int64, the numbers of all elements."""
        return arange(len(self.image))

    @cached_property
    def inverse(self) -> np.ndarray:
        """(g,) int64, the inverse of each element."""
        return (self.composition == 0).argmax(axis=1)

    def first_onto(self, side: np.ndarray) -> np.ndarray:
        """The first element that takes each face to a side, (p,) int64; 0, the identity, where none does.

        side : (p,) bool.
        """
        return ((self.image >= 0) & side[self.image]).argmax(axis=0)

    def generated_subgroups(self, chosen: np.ndarray) -> np.ndarray:
        """For each row of ``chosen``, the smallest subgroup that contains it (the identity included), (c, g) bool.

        chosen : (c, g) bool, which elements each of c sets contains.
        """
        subgroup = chosen.copy()
        subgroup[:, 0] = True
        while True:
            before = subgroup.sum()
            for element in self.elements[1:]:
                subgroup |= subgroup[:, element, None] & subgroup[:, self.composition[self.inverse[element]]]
            if subgroup.sum() == before:
                return subgroup

    def cosets(self, subgroup: np.ndarray) -> np.ndarray:
        """The right coset of each element, (c, g) int64, by the least element in it.

        subgroup : (c, g) bool, c subgroups. The coset of an element holds what applies it and then one of the subgroup.
        """
        coset = np.tile(self.elements, (len(subgroup), 1))
        for element in self.elements[1:]:
            coset = np.where(subgroup[:, element, None], np.minimum(coset, self.composition[element]), coset)
        return coset

# SPDX-License-Identifier: GPL-3.0-or-later
"""The ways in which a symmetric shape is mapped onto itself: mirrored in planes, and turned about an axis."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np


@dataclass(frozen=True, eq=False)
class Ways:
    """A group of g ways of mapping a shape of p faces onto itself; the first leaves all as it is.

    Attributes
    ----------
    image : (g, p) int64
        The image of each face in each way; -1 for none.
    after : (g, g) int64
        ``after[u, v]`` is the way that is way v and then way u.
    """

    image: np.ndarray
    after: np.ndarray

    @classmethod
    def of_planes(cls, twin: np.ndarray) -> Ways:
        """All ways of mirroring in some of k planes across each other; twin : (k, p) int64, in each plane.

        Their bits say in which: one after the other is the exclusive or of both.
        """
        image = np.arange(twin.shape[1])[None]
        for mirrored in twin:
            image = np.concatenate([image, np.append(mirrored, -1)[image]])
        every = np.arange(len(image))
        return cls(image, every[:, None] ^ every)

    @classmethod
    def generated(cls, mirrored: np.ndarray, most: int) -> Ways | None:
        """All that some exact ways of mirroring make one after the other; None if there are too many.

        mirrored : (k, p) int64, the image of each face in each. most : upper bound of the number of ways.
        """
        image = [np.arange(mirrored.shape[1])]
        known = {image[0].tobytes(): 0}
        for before in image:  # grows while it is walked through
            for then in mirrored:
                further = then[before]
                if known.setdefault(further.tobytes(), len(image)) == len(image):
                    image.append(further)
                    if len(image) > most:
                        return None
        after = [[known[u[v].tobytes()] for v in image] for u in image]
        return cls(np.array(image), np.array(after))

    @property
    def every(self) -> np.ndarray:
        """(g,) int64, all ways."""
        return np.arange(len(self.image))

    @cached_property
    def back(self) -> np.ndarray:
        """(g,) int64, the way that undoes each."""
        return (self.after == 0).argmax(axis=1)

    def closed(self, chosen: np.ndarray) -> np.ndarray:
        """Sets of ways, (c, g) bool, with all that those of each make one after the other; the first is in all."""
        chosen = chosen.copy()
        chosen[:, 0] = True
        while True:
            before = chosen.sum()
            for way in self.every[1:]:
                chosen |= chosen[:, way, None] & chosen[:, self.after[self.back[way]]]
            if chosen.sum() == before:
                return chosen

# SPDX-License-Identifier: GPL-3.0-or-later
"""Which parts touch, which of them is the body, and what hangs on it; grounds are no part of that."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from ...arrays.int64 import arange, full
from ...arrays.pairs import partners_of
from ...result.parts import Parts

LOOSE = 10**6  # cuts from the body to a part that does not hang on it: more than a model has


@dataclass(frozen=True, eq=False)
class Touching:
    """Which parts touch, and which of them is the body; the same whichever way the model is turned.

    Attributes
    ----------
    parts : Parts
        With k parts.
    ground : (k,) bool
        The parts that are grounds, such as a floor: as if they touched nothing. Not all of them.
    """

    parts: Parts
    ground: np.ndarray

    @cached_property
    def neighbors(self) -> list[set[int]]:
        """Parts that each part touches."""
        cuts = self.parts.cuts[~self.ground[self.parts.cuts].any(axis=1)]
        return [set(others) for others in partners_of(cuts, self.parts.count)]

    @cached_property
    def body(self) -> int:
        """The part that most area hangs on: the one that leaves the smallest remainders when it is taken away."""
        largest = np.where(self.ground, np.inf, self._remainders())
        # Those were summed in another order. Of parts that are equal but for rounding, the sums below tell.
        near = np.flatnonzero(largest <= largest.min() + 1e-9 * self.parts.share.sum())
        return min(near.tolist(), key=self._remainder)

    def _remainder(self, part: int) -> float:
        """The largest share of what hangs together once a part is taken away, of what hung on it."""
        seen, largest = {part}, 0.0
        for start in self.neighbors[part]:
            if start in seen:
                continue
            waiting, total = [start], 0.0
            seen.add(start)
            while waiting:
                at = waiting.pop()
                total += self.parts.share[at]
                waiting += (new := self.neighbors[at] - seen)
                seen |= new
            largest = max(largest, total)
        return largest

    def _remainders(self) -> np.ndarray:
        """(k,) float64, what ``_remainder`` says of each part, but for rounding: all at once.

        In a depth-first search, what was reached from a part is cut off by it unless it touches what came before it.
        """
        order, above, place = self._depth_first()
        share, low, below, largest = self.parts.share, place.copy(), self.parts.share.copy(), np.zeros(len(place))
        cut_off = np.zeros(len(place))
        for part in reversed(order):
            low[part] = min([low[part], *(place[other] for other in self.neighbors[part])])
            parent = above[part]
            if parent < 0:
                continue
            if low[part] >= place[parent]:
                largest[parent] = max(largest[parent], below[part])
                cut_off[parent] += below[part]
            low[parent], below[parent] = min(low[parent], low[part]), below[parent] + below[part]
        root = arange(len(place))
        for part in order:
            root[part] = root[above[part]] if above[part] >= 0 else part
        return np.maximum(largest, np.where(above >= 0, below[root] - cut_off - share, 0.0))

    def _depth_first(self) -> tuple[list[int], np.ndarray, np.ndarray]:
        """Parts in the order of a depth-first search; what each is reached from, -1 for none; the place of each."""
        order: list[int] = []
        above, place = full(self.parts.count, -1), full(self.parts.count, -1)
        for root in range(self.parts.count):
            waiting = [(root, -1)]
            while waiting:
                part, parent = waiting.pop()
                if place[part] < 0:
                    place[part], above[part] = len(order), parent
                    order.append(part)
                    waiting += [(other, part) for other in self.neighbors[part] if place[other] < 0]
        return order, above, place

    @cached_property
    def steps(self) -> np.ndarray:
        """(k,) int64, over how many cuts each part hangs on the body; a large number for loose ones."""
        steps, at, reached = full(self.parts.count, LOOSE), [self.body], 0
        steps[self.body] = 0
        while at:
            reached += 1
            at = [part for part in {other for part in at for other in self.neighbors[part]} if steps[part] > reached]
            steps[at] = reached
        return steps

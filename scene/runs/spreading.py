# SPDX-License-Identifier: GPL-3.0-or-later
"""Which of several processes computes which shapes."""

from __future__ import annotations

# Vertices of the shapes that are in memory at a time, at most: a million take 2 GB.
MOST_AT_A_TIME = 500_000
# What the smallest mesh takes, as vertices that take as long: it is refined before it is cut.
LEAST = 25_000


def spread(sizes: list[int], processors: int) -> list[list[int]]:
    """Divide shapes among processes so that all have about as much to do.

    Parameters
    ----------
    sizes : list of int
        Number of vertices of each shape, one or more of them.
    processors : int
        There are at most so many processes, and fewer of large shapes, as each holds one at a time in memory.

    Returns
    -------
    groups : list of list of int
        Indices of the shapes of each process, none empty, each in order; the first shape is in the first.
    """
    count = max(min(len(sizes), processors, MOST_AT_A_TIME // max(*sizes, 1)), 1)
    work, groups = [0] * count, [[] for _ in range(count)]
    for index in sorted(range(len(sizes)), key=lambda index: -sizes[index]):  # the largest go first
        least = work.index(min(work))
        work[least] += sizes[index] + LEAST
        groups[least].append(index)
    return sorted(sorted(group) for group in groups)

# SPDX-License-Identifier: GPL-3.0-or-later
"""The edges between parts, looked at again and again."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..arrays.int64 import arange
from .corners import CornerTable, edge_labels


@dataclass(frozen=True, eq=False)
class CutEdges:
    """The edges at which faces of several parts meet: between two sets of parts there are no others.

    Attributes
    ----------
    edges : (k,) int64
        In the table, rising.
    place : (c,) int64
        For each corner there, the place of its edge in ``edges``.
    label : (c,) int64
        And the part of its face.
    """

    edges: np.ndarray
    place: np.ndarray
    label: np.ndarray

    @classmethod
    def of(cls, table: CornerTable, labels: np.ndarray) -> CutEdges:
        """Find those of a table. labels : (p,) int64, the part of each face."""
        low, high = table.edge_labels(labels)
        edges, corner = np.flatnonzero(low < high), np.flatnonzero((low < high)[table.corner_edge])
        return cls(edges, np.searchsorted(edges, table.corner_edge[corner]), labels[table.corner_face[corner]])

    def around(self, inside: np.ndarray) -> np.ndarray:
        """Edges between some parts, (count,) bool, and all others; (b,) int64, rising."""
        low, high = edge_labels(self.place, arange(len(self.place)), inside[self.label], len(self.edges))
        return self.edges[low < high]

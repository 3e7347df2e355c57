# SPDX-License-Identifier: GPL-3.0-or-later
"""What becomes of a model's positions in files: some formats have single precision, in others digits are counted."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from .core.sentence import Sentence
from .model_files import Model

# Positions that are written may be off by this share of the model's size.
_SHARE = 1e-5
# Digits after the point that trimesh writes without being asked for more.
_DIGITS = {"obj": 8, "off": 10}


@dataclass(frozen=True, eq=False)
class Rounding:
    """How a model has to be written.

    Attributes
    ----------
    error : float
        By how much single precision moves a vertex that has faces along an axis, at most.
    size : float
        Diagonal of the box around these vertices.
    middle : (3,) float64
        Of that box.
    """

    error: float
    size: float
    middle: np.ndarray

    @classmethod
    def of(cls, model: Model) -> Rounding:
        """Measure a model that has faces."""
        points = model.vertices[np.unique(model.faces)]
        with np.errstate(over="ignore"):  # what is too large for single precision is infinite in it
            error = np.abs(points.astype(np.float32) - points).max()
        extent = np.ptp(points, axis=0)
        return cls(float(error), float(np.linalg.norm(extent)), points.min(axis=0) + 0.5 * extent)

    @property
    def single(self) -> bool:
        """Whether single precision is enough."""
        return self.error <= _SHARE * self.size

    @property
    def origin(self) -> np.ndarray:
        """Origin, (3,), for objects whose positions have single precision and whose places have more; else 0."""
        return np.zeros(3) if self.single else self.middle

    def digits(self, kind: str) -> int:
        """Digits after the point in a text, "obj" or "off": more than usual for small models."""
        return max(_DIGITS[kind], 1 - math.floor(math.log10(_SHARE * self.size)))

    def notes(self, kind: str) -> tuple[Sentence, ...]:
        """A note where files of a kind, such as "stl", cannot have the positions."""
        if kind != "stl" or self.single:
            return ()
        return (Sentence("Files of the format .stl have positions in single precision, which is too coarse so far from "
                         "the origin: vertices of the parts are off by up to {error}. Choose another format.",
                         error=f"{self.error:.2g}"),)

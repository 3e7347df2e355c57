# SPDX-License-Identifier: GPL-3.0-or-later
"""Every parameter, its range, its default and what it does to the parts."""

from __future__ import annotations

import math
import warnings
from dataclasses import dataclass, field, fields, replace
from functools import wraps
from typing import ClassVar

from .errors import ParameterError
from .sentence import Sentence

PERCEPTUAL, BERRETTI = "perceptual", "berretti"
METHODS = (PERCEPTUAL, BERRETTI)


#: Names that version 0.1.0 had for parameters, and what they are called now. Its alpha was the weight of concavity in
#: one method and the width of a band in the other.
RENAMED = {"equalise": ("equalize",), "levels": ("n_slabs",), "alpha": ("concavity_weight", "band_ratio")}


def present_names(values: dict) -> tuple[dict, tuple[Sentence, ...]]:
    """Give values that a script or a file of version 0.1.0 names the names of today.

    Parameters
    ----------
    values : dict of str -> object
        By parameter, of then or of now.

    Returns
    -------
    values : dict of str -> object
        By parameter of now. A name of now wins over the name of then.
    notes : tuple of Sentence
        One for each name of then.
    """
    old = {name: values[name] for name in RENAMED if name in values}
    present = {new: value for name, value in old.items() for new in RENAMED[name]}
    present |= {name: value for name, value in values.items() if name not in RENAMED}
    return present, tuple(
        Sentence("The parameter {old} is called {new} now.", old=name, new=", ".join(RENAMED[name])) for name in old)


def _number(default, low, high, label, text):
    return field(default=default,
                 metadata={"range": (low, high), "label": label, "description": text})


def _with_warnings(values: dict) -> dict:
    """``present_names`` of keyword arguments, the notes as DeprecationWarnings to who gave them."""
    values, notes = present_names(values)
    for note in notes:
        warnings.warn(note, DeprecationWarning, stacklevel=3)
    return values


def _with_old_names(cls: type) -> type:
    """Let a class of parameters be made with names of version 0.1.0, too, which is noted as a DeprecationWarning."""
    made = cls.__init__  # type: ignore[misc]  # it is that of the class given, whatever inherits from it

    @wraps(made)
    def init(self, *args, **values):
        made(self, *args, **_with_warnings(values))

    cls.__init__ = init  # type: ignore[misc]
    return cls


@_with_old_names
@dataclass(frozen=True)
class Parameters:
    """What a decomposition may be asked for; ``Parameters.RANGES`` has the limits.

    Each field's metadata holds its range (None for switches and choices), a label and a
    sentence for tooltips, in the artist's words with the paper's symbol second.

    Raises
    ------
    ParameterError
        A value outside its range; ``error.name`` says which.
    """

    RANGES: ClassVar[dict[str, tuple[float, float]]]

    method: str = field(default=PERCEPTUAL, metadata={
        "choices": METHODS, "label": "Method",
        "description": "How cuts are chosen: as people would, or by the paper's rules"})
    detail: float = _number(
        0.5, 0.0, 1.0, "Detail",
        "How readily the surface is cut: 0 gives as few parts as possible, 1 every candidate")
    n_parts: int = _number(
        0, 0, 100_000, "Number of parts",
        "Exactly this many parts instead of a level of detail; 0 lets Detail decide")
    base_spacing: float = _number(
        0.005, 0.0005, 0.05, "Base spacing",
        "Share of the area around each point that distances are measured from; smaller is "
        "slower and finer (the paper's 0.005 S)")
    equalize: bool = field(default=True, metadata={
        "label": "Equalise",
        "description": "Give every range of distances the same area, so that long limbs do not "
                       "hide short ones (the paper's s(p))"})
    n_slabs: int = _number(
        100, 8, 1000, "Levels",
        "Number of slabs the surface is cut into before parts are formed (1 / epsilon)")
    small_region: float = _number(
        0.05, 0.0005, 0.5, "Small region",
        "Parts smaller than this share of the largest one join a neighbour; 0.01 keeps fingers")
    concavity_weight: float = _number(
        0.5, 0.0, 1.0, "Concavity",
        "How far a cut may slide to lie in a crease: 0 leaves it where it is (the paper's alpha)")
    band_ratio: float = _number(
        0.5, 0.0, 1.0, "Band",
        "How far to either side a cut may move into a crease, as a share of the radius of a circle "
        "as long as the cut; 0 leaves it where it is")
    sigma: float = _number(
        0.15, 0.0, 0.25, "Crease length",
        "How much of a cut's length must be concave to count (the paper's sigma)")
    smoothing: int = _number(
        10, 0, 100, "Smoothing",
        "Rounds that take saw teeth off the cuts, a face at a time; 0 leaves them as they fall")
    follow_level_sets: bool = field(default=False, metadata={
        "label": "Follow level sets",
        "description": "Keep cuts on level sets of the distance, as the paper does; off, they "
                       "follow creases"})
    loose_part: float = _number(
        0.01, 0.0, 1.0, "Small loose part",
        "Loose parts with less than this share of the whole area are one part each")

    def __post_init__(self):
        for item in fields(self):
            limits = item.metadata.get("range")
            value = getattr(self, item.name)
            if limits is not None:
                self._check_number(item.name, value, *limits, whole=item.type == "int")
            elif "choices" in item.metadata and value not in item.metadata["choices"]:
                choices = ", ".join(item.metadata["choices"])
                raise ParameterError(
                    Sentence("{name} must be one of {choices}, not {value!r}.",
                             name=item.name, choices=choices, value=value), item.name)

    @staticmethod
    def _check_number(name, value, low, high, whole):
        try:
            number = float(value)
        except (TypeError, ValueError):
            raise ParameterError(Sentence("{name} must be a number, not {value!r}.",
                                          name=name, value=value), name) from None
        if not math.isfinite(number) or not low <= number <= high or (whole and number % 1):
            limits = {"name": name, "low": low, "high": high, "value": value}
            raise ParameterError(
                Sentence("{name} must be a whole number from {low} to {high}, not {value!r}.", **limits)
                if whole else
                Sentence("{name} must be a number from {low} to {high}, not {value!r}.", **limits),
                name)

    @classmethod
    def preset(cls, name: str, **changes) -> Parameters:
        """The parameters of a preset of PRESETS, with some of them changed."""
        if name not in PRESETS:
            raise ParameterError(
                Sentence("There is no preset {name!r}. Choose one of: {presets}.",
                         name=name, presets=", ".join(PRESETS)), "preset")
        return replace(PRESETS[name], **_with_warnings(changes))


Parameters.RANGES = {f.name: f.metadata["range"] for f in fields(Parameters)
                     if "range" in f.metadata}

PERCEPTUAL_PRESET, BERRETTI_2009 = "Perceptual", "Berretti 2009"
PRESETS = {
    PERCEPTUAL_PRESET: Parameters(),
    BERRETTI_2009: Parameters(method=BERRETTI, follow_level_sets=True),
}

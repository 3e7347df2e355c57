# SPDX-License-Identifier: GPL-3.0-or-later
"""The parameters of a run: range, default, label and description of each; presets; parameter names of version 0.1.0."""

from __future__ import annotations

import math
import warnings
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, fields, replace
from functools import wraps
from typing import Any, ClassVar, TypeVar

import numpy as np

from .errors import ParameterError, UnknownParameterError
from .sentence import Sentence

PERCEPTUAL, BERRETTI, LAVOUE, LIU = "perceptual", "berretti", "lavoue", "liu"
TOGETHER, SEPARATE = "together", "separate"
PIECES = (TOGETHER, SEPARATE)
_Class = TypeVar("_Class")


@dataclass(frozen=True)
class Traits:
    """In what a method differs from others, for the stages before and after it.

    Attributes
    ----------
    heeds : tuple of str
        The parameters that it heeds though not all methods do.
    learned : bool
        Whether its saliences were learned from what people drew, and so can be weighed against other learned ones.
        Else it is as it was published, and so are its parts.
    small_candidates : bool
        Whether its candidates can be smaller than the caller's faces.
    """

    heeds: tuple[str, ...]
    learned: bool = False
    small_candidates: bool = False


TRAITS = {
    PERCEPTUAL: Traits(("follow_level_sets", "band_ratio"), learned=True, small_candidates=True),
    BERRETTI: Traits(("follow_level_sets", "band_ratio", "small_region", "concavity_weight", "sigma")),
    LAVOUE: Traits(("n_clusters",)),
    LIU: Traits(("outline_weight",)),
}
METHODS = tuple(TRAITS)

#: Names of parameters in version 0.1.0, and the names of today. The alpha of version 0.1.0 was the weight of concavity
#: in one method and the width of a band in the other.
RENAMED = {"equalise": ("equalize",), "levels": ("n_slabs",), "alpha": ("concavity_weight", "band_ratio")}


def present_names(values: dict) -> tuple[dict, tuple[Sentence, ...]]:
    """Rename parameters that a script or a file of version 0.1.0 names.

    Parameters
    ----------
    values : dict of str -> object
        Value of each parameter, by its name in version 0.1.0 or of today.

    Returns
    -------
    values : dict of str -> object
        Value of each parameter, by its name of today. Where both names were given, the value of today's name counts.
    notes : tuple of Sentence
        One for each name of version 0.1.0.
    """
    old = {name: values[name] for name in RENAMED if name in values}
    present = {new: value for name, value in old.items() for new in RENAMED[name]}
    present |= {name: value for name, value in values.items() if name not in RENAMED}
    return present, tuple(
        Sentence("The parameter {old} is called {new} now.", old=name, new=", ".join(RENAMED[name])) for name in old)


def _number_field(default: float, low: float, high: float, label: str, text: str) -> Any:
    """Field of a parameter that is a number from ``low`` to ``high``; a whole one if its default is an int."""
    return field(default=default, metadata={
        "range": (low, high), "whole": isinstance(default, int), "label": label, "description": text})


def _with_warnings(values: dict) -> dict:
    """Keyword arguments by today's names; a DeprecationWarning tells the caller of each name of version 0.1.0."""
    values, notes = present_names(values)
    for note in notes:
        warnings.warn(note, DeprecationWarning, stacklevel=3)
    for name in values:
        if name not in {known.name for known in fields(Parameters)}:
            raise UnknownParameterError(Sentence("There is no parameter {name}.", name=_shown(name)), str(name))
    return values


def _shown(value: object) -> str:
    """A value as a sentence names it: not longer than a line, and whatever it is."""
    text = repr(value)
    return text if len(text) <= 60 else f"{text[:50]}..."


def _with_old_names(cls: type[_Class]) -> type[_Class]:
    """Class decorator: the class also takes names of version 0.1.0, with a DeprecationWarning for each."""
    made = cls.__init__  # it is that of the class given, whatever inherits from it

    @wraps(made)
    def init(self: Any, *args: Any, **values: Any) -> None:
        made(self, *args, **_with_warnings(values))

    cls.__init__ = init  # type: ignore[method-assign]
    return cls


@_with_old_names
@dataclass(frozen=True)
class Parameters:
    """The parameters of a run, all optional; the description of each is in its field's metadata.

    The metadata of a field holds its "range", (lowest, highest), and whether it is "whole", if it is a number, its
    "choices" if it is one of several words, and always a "label" and a "description" for tooltips.
    ``Parameters.RANGES`` has all ranges by name.

    Names of version 0.1.0 are understood as well, with a DeprecationWarning. Values whose meaning is plain are taken
    and converted: "0.5" and NumPy's numbers, 2.0 for a whole number, 1 for true.

    Raises
    ------
    ParameterError
        A value is outside its range, or none of its kind; ``error.name`` says which.
    UnknownParameterError
        There is no parameter of a name; it is a TypeError, too.
    """

    RANGES: ClassVar[dict[str, tuple[float, float]]]

    method: str = field(default=PERCEPTUAL, metadata={
        "choices": METHODS, "label": "Method",
        "description": "How cuts are chosen: as people would, by the paper's rules on the Reeb graph, where curvature "
                       "changes, or by cutting in two again and again"})
    pieces: str = field(default=TOGETHER, metadata={
        "choices": PIECES, "label": "Pieces",
        "description": "Whether pieces that touch without being joined form parts together, like a sleeve and an arm, "
                       "or each piece is decomposed on its own"})
    detail: float = _number_field(
        0.5, 0.0, 1.0, "Detail",
        "How readily the surface is cut: 0 gives as few parts as possible, 1 every candidate")
    n_parts: int = _number_field(
        0, 0, 100_000, "Number of Parts",
        "Exactly this many parts instead of a level of detail; 0 lets Detail decide")
    base_spacing: float = _number_field(
        0.005, 0.0005, 0.05, "Base Spacing",
        "Share of the area around each point that distances are measured from; smaller is "
        "slower and finer (the paper's 0.005 S)")
    equalize: bool = field(default=True, metadata={
        "label": "Equalize",
        "description": "Give every range of distances the same area, so that long limbs do not "
                       "hide short ones (the paper's s(p))"})
    n_slabs: int = _number_field(
        100, 8, 1000, "Levels",
        "Number of slabs the surface is cut into before parts are formed (1 / epsilon)")
    small_region: float = _number_field(
        0.05, 0.0005, 0.5, "Small Region",
        "Berretti 2009: parts smaller than this share of the largest one join a neighbor; 0.01 keeps fingers")
    concavity_weight: float = _number_field(
        0.5, 0.0, 1.0, "Concavity",
        "Berretti 2009: how far a cut may slide to lie in a crease; 0 leaves it where it is (the paper's alpha)")
    band_ratio: float = _number_field(
        0.5, 0.0, 1.0, "Band",
        "How far to either side a cut may move into a crease, as a share of the radius of a circle "
        "as long as the cut; 0 leaves it where it is")
    sigma: float = _number_field(
        0.15, 0.0, 0.25, "Crease Length",
        "Berretti 2009: how much of a cut's length must be concave to count (the paper's sigma)")
    n_clusters: int = _number_field(
        0, 0, 32, "Curvature Classes",
        "Lavoue 2005: number of classes of curvature that the surface is sorted into; 0 chooses it from the data")
    outline_weight: float = _number_field(
        0.5, 0.0, 1.0, "Outline",
        "Liu 2007: how far the outline of a part, unfolded into the plane, counts when its cut is judged; 0 judges by "
        "the cut alone")
    smoothing: int = _number_field(
        10, 0, 100, "Smoothing",
        "Rounds that take saw teeth off the cuts, a face at a time; 0 leaves them as they fall")
    follow_level_sets: bool = field(default=False, metadata={
        "label": "Follow Level Sets",
        "description": "Keep cuts on level sets of the distance, as the paper does; off, they "
                       "follow creases"})
    symmetry: bool = field(default=True, metadata={
        "label": "Symmetry",
        "description": "Where the model is its own mirror image, or most of it is, make its parts so, too. Changes by "
                       "hand are made on both sides"})
    loose_part: float = _number_field(
        0.01, 0.0, 1.0, "Small Loose Part",
        "What touches nothing else, or with Pieces: Separate each loose piece, is one part if its share of the whole "
        "area is less than this")

    def __post_init__(self) -> None:
        """Convert the values; raise ParameterError if one is outside its range or not among its choices."""
        for item in fields(self):
            limits = item.metadata.get("range")
            value = getattr(self, item.name)
            if isinstance(value, np.ndarray) and value.ndim == 0:
                value = value.item()
            if limits is not None:
                value = self._as_number(item.name, value, limits, item.metadata["whole"])
            elif "choices" in item.metadata:
                value = self._as_choice(item.name, value, item.metadata["choices"])
            else:
                value = self._as_switch(item.name, value)
            object.__setattr__(self, item.name, value)

    @staticmethod
    def _as_number(name: str, value: Any, limits: tuple[float, float], whole: bool) -> float | int:
        """A value as a number, or a whole one, between two limits; raises ParameterError if it is none."""
        low, high = limits
        try:
            if isinstance(value, (bool, np.bool_, np.ndarray)):
                raise TypeError
            number = float(value)
        except OverflowError:
            number = math.inf
        except (TypeError, ValueError):
            raise ParameterError(Sentence("{name} must be a number, not {value}.",
                                          name=name, value=_shown(value)), name) from None
        if not math.isfinite(number) or not low <= number <= high or (whole and number % 1):
            words = {"name": name, "low": low, "high": high, "value": _shown(value)}
            raise ParameterError(
                Sentence("{name} must be a whole number from {low} to {high}, not {value}.", **words)
                if whole else
                Sentence("{name} must be a number from {low} to {high}, not {value}.", **words),
                name)
        return int(number) if whole else number

    @staticmethod
    def _as_choice(name: str, value: Any, choices: tuple[str, ...]) -> str:
        """A value as one of some words; raises ParameterError if it is none."""
        if not isinstance(value, str) or value not in choices:
            raise ParameterError(
                Sentence("{name} must be one of {choices}, not {value}.",
                         name=name, choices=", ".join(choices), value=_shown(value)), name)
        return str(value)

    @staticmethod
    def _as_switch(name: str, value: Any) -> bool:
        """A value as true or false; raises ParameterError if it is neither."""
        if not isinstance(value, (bool, np.bool_, int, np.integer)) or value not in (0, 1):
            raise ParameterError(
                Sentence("{name} must be true or false, not {value}.", name=name, value=_shown(value)), name)
        return bool(value)

    @property
    def traits(self) -> Traits:
        """The traits of the method."""
        return TRAITS[self.method]

    @classmethod
    def of(cls, values: Parameters | Mapping[str, Any] | None) -> Parameters:
        """Take parameters, a mapping of their values by name, or None for those of the first preset.

        values : Parameters, mapping or None. Returns Parameters. Raises ParameterError if it is something else, or as
        Parameters does.
        """
        if values is None or isinstance(values, cls):
            return values or cls()
        if not isinstance(values, Mapping) or not all(isinstance(name, str) for name in values):
            raise ParameterError(Sentence("Parameters are given by their names, not as {value}.",
                                          value=_shown(values)))
        return cls(**values)

    @classmethod
    def preset(cls, name: str, **changes: Any) -> Parameters:
        """Look up a preset and change some of its parameters.

        Parameters
        ----------
        name : str
            Name in PRESETS.
        **changes
            Values by parameter.

        Returns
        -------
        parameters : Parameters

        Raises
        ------
        ParameterError
            There is no such preset (``error.name`` is then "preset"), or a value is outside its range.
        UnknownParameterError
            There is no parameter of a name; it is a TypeError, too.
        """
        if not isinstance(name, str) or name not in PRESETS:
            raise ParameterError(
                Sentence("There is no preset {name}. Choose one of: {presets}.",
                         name=_shown(name), presets=", ".join(PRESETS)), "preset")
        return replace(PRESETS[name], **_with_warnings(changes))


Parameters.RANGES = {f.name: f.metadata["range"] for f in fields(Parameters)
                     if "range" in f.metadata}


def heeded(method: str, names: Sequence[str]) -> list[str]:
    """Choose the parameters that count with a method: those that it heeds, and those that every method does.

    method : str, one of METHODS. names : sequence of str, of parameters or other settings. Returns some of them, in
    their order.
    """
    not_by_all = {name for traits in TRAITS.values() for name in traits.heeds}
    return [name for name in names if name in TRAITS[method].heeds or name not in not_by_all]


PERCEPTUAL_PRESET, BERRETTI_2009, LAVOUE_2005, LIU_2007 = "Perceptual", "Berretti 2009", "Lavoue 2005", "Liu 2007"
PRESETS = {
    PERCEPTUAL_PRESET: Parameters(),
    # The paper takes a level at every vertex; more than these change little.
    BERRETTI_2009: Parameters(method=BERRETTI, n_slabs=200, follow_level_sets=True, symmetry=False),
    LAVOUE_2005: Parameters(method=LAVOUE, symmetry=False),
    LIU_2007: Parameters(method=LIU, symmetry=False),
}

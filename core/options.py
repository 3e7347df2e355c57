# SPDX-License-Identifier: GPL-3.0-or-later
"""What commands share: the options that set parameters, made from the definitions of these, the answer, the end."""

from __future__ import annotations

import argparse
import json
import math
import os
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import fields, replace
from pathlib import Path
from typing import Any

from .errors import ReebError
from .parameters import PRESETS, RENAMED, Parameters, present_names
from .sentence import Sentence

FAILED, WRONG_OPTION = 1, 2  # exit statuses of a command; the latter is argparse's
NO_WORKING_FOLDER = "The folder in which the command was started is gone. Change to one that is there."


@contextmanager
def in_working_folder() -> Iterator[None]:
    """What a command does: a ReebError says so where a file is missed because the working folder itself is gone."""
    try:
        yield
    except FileNotFoundError as error:
        try:
            os.getcwd()
        except FileNotFoundError:  # no relative name leads anywhere
            raise ReebError(NO_WORKING_FOLDER) from error
        raise


def answer_text(document: dict[str, Any]) -> str:
    """The JSON that a command answers with, or writes, as text."""
    return json.dumps(document, indent=2, allow_nan=False) + "\n"


def may_be_answer(path: Path) -> bool:
    """Whether a file may be an answer of an earlier run, by its name or by how it begins; raises OSError."""
    if path.suffix.lower() == ".json":
        return True
    with path.open("rb") as file:
        return file.read(1) == b"{"


def add_parameters(group: argparse._ArgumentGroup) -> None:
    """Add an option for each parameter and one for presets.

    Parameters
    ----------
    group : argument group of an ``argparse.ArgumentParser``
        Names of version 0.1.0 are added, too, and stay out of the help.
    """
    group.add_argument("--preset", choices=list(PRESETS),
                       help=f"start from the parameters of a preset (default {next(iter(PRESETS))})")
    for field in fields(Parameters):
        meta = field.metadata
        words = {"dest": field.name, "default": None, "help": meta["description"].replace("%", "%%")}
        name = f"--{dashed(field.name)}"
        if "choices" in meta:
            words["help"] += f" (default {field.default})"
            group.add_argument(name, choices=meta["choices"], **words)
        elif "range" in meta:
            low, high = meta["range"]
            words["help"] += limits_of(low, high, getattr(Parameters, field.name))
            group.add_argument(name, type=int if meta["whole"] else float, metavar="N", **words)
        else:
            words["help"] += f" (default {'on' if field.default else 'off'})"
            group.add_argument(name, action=argparse.BooleanOptionalAction, **words)
    for old in RENAMED:  # scripts of version 0.1.0
        kind = {"action": argparse.BooleanOptionalAction} if old == "equalise" else {"type": float}
        group.add_argument(f"--{old}", help=argparse.SUPPRESS, **kind)


def chosen_parameters(options: argparse.Namespace) -> tuple[Parameters, tuple[Sentence, ...]]:
    """Read the parameters that the options ask for.

    Parameters
    ----------
    options : argparse.Namespace
        Of a parser with ``add_parameters``.

    Returns
    -------
    parameters : Parameters
    notes : tuple of Sentence
        One for each former name of a parameter.

    Raises
    ------
    ParameterError
        A value is outside its range.
    """
    names = (*RENAMED, *(field.name for field in fields(Parameters)))
    values, notes = present_names(
        {name: value for name in names if (value := getattr(options, name)) is not None})
    return replace(PRESETS[options.preset] if options.preset else Parameters(), **values), notes


def dashed(name: str) -> str:
    """Name of the option for a name in Python: dashes for underscores."""
    return name.replace("_", "-")


def limits_of(low: float, high: float, default: float) -> str:
    """What the help says of the numbers that an option takes, such as " (0 to 1; default 0.5)"."""
    return f" ({low:g} to {high:g}; default {default:g})"


def number(low: float, high: float = math.inf, kind: type[float] | type[int] = float) -> Callable[[str], float]:
    """Make what reads a number of an option.

    Parameters
    ----------
    low, high : float
        The least and the largest number that it takes.
    kind : type
        float, or int for whole numbers.

    Returns
    -------
    read : callable(str) -> float
        Raises ``argparse.ArgumentTypeError``, of which argparse makes a sentence; neither infinity nor nan is a number.
    """
    name = "a whole number" if kind is int else "a number"
    limits = f"{name} from {low:g} to {high:g}" if math.isfinite(high) else f"{name}, {low:g} or more"

    def read(text: str) -> float:
        try:
            value = kind(text)
            if math.isfinite(value) and low <= value <= high:
                return value
        except (ValueError, OverflowError):
            pass
        raise argparse.ArgumentTypeError(f"must be {limits}, not {text}")

    return read


def named_file(text: str) -> Path:
    """Read the name of a file that an option gives.

    text : str. Returns Path. Raises ``argparse.ArgumentTypeError`` for - and for nothing, as of a variable that a
    script has not set; argparse makes a sentence of it.
    """
    if text == "-":
        raise argparse.ArgumentTypeError("- is no file; standard output has the JSON in any case")
    if not text:
        raise argparse.ArgumentTypeError("the name of the file is empty")
    return Path(text)


def named_folder(text: str) -> Path:
    """Read the name of a folder that an option gives; one without letters would be the working folder.

    text : str. Returns Path. Raises ``argparse.ArgumentTypeError`` for nothing, of which argparse makes a sentence.
    """
    if not text:
        raise argparse.ArgumentTypeError("the name of the folder is empty")
    return Path(text)

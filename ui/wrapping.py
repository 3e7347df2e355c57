# SPDX-License-Identifier: GPL-3.0-or-later
"""Text in lines of a width, in any script: Blender's labels have one line and leave out what does not fit."""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Callable

# What stays together: a word, or one letter of a script that has no spaces, each with the marks that open or close it.
_OPENING, _CLOSING = r"[“‘（《「【(]*", r"[”’），。；：、！？》」】….,;:!?)%]*"
_WIDE = r"[\u2e80-\u303f\u3040-\u9fff\uac00-\ud7af\uf900-\ufaff\uff00-\uff60]"
_COUNTED = rf"\d[\d.,]* {_WIDE}{_CLOSING}"  # as a number and the word that counts what follows
_TOKEN = re.compile(rf"\s*(?:{_COUNTED}|{_OPENING}{_WIDE}{_CLOSING}|(?:(?!{_OPENING}{_WIDE})\S)+{_CLOSING})")


def letters(text: str) -> int:
    """Letters that a text is wide; one of Chinese or Japanese is as wide as two."""
    return sum(2 if unicodedata.east_asian_width(letter) in "WF" else 1 for letter in text)


def lines(text: str, width: float, measure: Callable[[str], float] = letters) -> list[str]:
    """Break a text between words, or between letters where a script has no spaces.

    Parameters
    ----------
    text : str
    width : float
        Of a line.
    measure : callable
        The width of a text, in the unit of ``width``.

    Returns
    -------
    lines : list of str
        Of at most that width, unless a single word is wider.
    """
    found: list[str] = []
    for token in _TOKEN.findall(text):
        if found and measure(found[-1] + token) <= width:
            found[-1] += token
        else:
            found.append(token.lstrip())
    return found

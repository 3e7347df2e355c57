# SPDX-License-Identifier: GPL-3.0-or-later
"""Sentences for the user that can be translated.

This package writes its sentences in English, as ``Sentence("... {n} ...", n=3)`` and never as f-strings. The code that
shows a sentence can then look up the constant message in a dictionary and fill in the values afterwards.
"""

from __future__ import annotations

from numbers import Integral
from typing import Any


class Count(int):
    """A number in a message that chooses between words: ``"{n} {n:part is|parts are} named"`` for ``n=Count(1)``.

    Before the bar is what is said of one, behind it what is said of none and of several; a language may do without.
    """

    def __format__(self, spec: str) -> str:
        """The words for this number where ``spec`` has a bar; else the number."""
        one, bar, several = spec.partition("|")
        if bar:
            return one if self == 1 else several
        return super().__format__(spec)


class Sentence(str):
    """An English sentence, a str, that also keeps its message and values for translation.

    Parameters
    ----------
    message : str
        The sentence with the names of its values in braces, for ``str.format``.
    **values
        Value for each name. Whole numbers are kept as ``Count``.

    Attributes
    ----------
    message : str
    values : dict of str -> object

    Raises
    ------
    KeyError
        A name in ``message`` has no value.
    """

    message: str
    values: dict[str, Any]

    def __new__(cls, message: str, **values: Any) -> Sentence:
        """Fill the values into the message."""
        values = {name: Count(value) if isinstance(value, Integral) and not isinstance(value, bool) else value
                  for name, value in values.items()}
        self = super().__new__(cls, message.format(**values))
        self.message, self.values = message, values
        return self

    def __getnewargs_ex__(self) -> tuple[tuple[str], dict[str, object]]:
        """Arguments of ``__new__`` for pickling and copying, which would otherwise begin with the text."""
        return (self.message,), self.values

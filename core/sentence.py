# SPDX-License-Identifier: GPL-3.0-or-later
"""Sentences for the user that can be said in other languages.

This package speaks English. It writes each sentence as ``Sentence("... {n} ...", n=3)``, never as an
f-string, so that who shows it can look up the constant message and fill in the values afterwards.
"""

from __future__ import annotations


class Sentence(str):
    """A sentence that remembers what it was made of; the English text to everything else.

    Attributes
    ----------
    message : str
        With the names of values in braces, for ``str.format``.
    values : dict of str -> object
    """

    message: str
    values: dict[str, object]

    def __new__(cls, message: str, **values):
        self = super().__new__(cls, message.format(**values))
        self.message, self.values = message, values
        return self

    def __getnewargs_ex__(self):  # pickling and copying begin with the message, not with the text
        return (self.message,), self.values

# SPDX-License-Identifier: GPL-3.0-or-later
"""What Reeb Parts says in other languages than English: a file for each, named by Blender's code for it.

Such a file has three dictionaries from English to that language: OPERATORS for the names of operators and
what stands on buttons, TEXTS for all else, and TOOLS for short words by which Blender means something else:
where Blender has a translation of its own, it shows that one. Values in braces stay as they are; they may
change places.
tests/blender/ui/test_translations.py lists what a language still lacks and what it no longer needs.
"""

from __future__ import annotations

import bpy

from ... import __package__ as base_package
from . import de, zh_HANS

LANGUAGES = {"de": de, "zh_HANS": zh_HANS}


def dictionary() -> dict:
    """All languages as Blender takes them: a text by its context and its English, for each language."""
    return {
        code: {("Operator", english): text for english, text in language.OPERATORS.items()}
        | {("Reeb Parts", english): text for english, text in language.TOOLS.items()}
        | {("*", english): text for english, text in language.TEXTS.items()}
        for code, language in LANGUAGES.items()
    }


def register() -> None:
    bpy.app.translations.register(base_package, dictionary())


def unregister() -> None:
    bpy.app.translations.unregister(base_package)

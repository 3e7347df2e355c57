# SPDX-License-Identifier: GPL-3.0-or-later
"""Notes on a mesh, kept with its result: in English for JSON, and so that the panel can say them in any language."""

from __future__ import annotations

import json
from collections.abc import Iterable

import bpy
from bpy.app.translations import pgettext_rpt as rpt_

from ...core.sentence import Sentence


def keep(result: bpy.types.PropertyGroup, notes: Iterable[str]) -> None:
    """Keep the notes of a decomposition and of the object's shape."""
    result.notes = "\n".join(notes)
    # A note that was read from a stored result is plain text, which has no translation.
    words = [(note.message, note.values) if isinstance(note, Sentence) else ("{note}", {"note": note})
             for note in notes]
    result.note_words = json.dumps(words)


def spoken(result: bpy.types.PropertyGroup) -> list[str]:
    """The notes in the language of the interface; those of an earlier version as they are."""
    if not result.note_words:
        return result.notes.splitlines()
    try:
        return [rpt_(message).format(**values) for message, values in json.loads(result.note_words)]
    except (ValueError, TypeError, KeyError, IndexError, AttributeError, RecursionError):  # not written by us
        return result.notes.splitlines()

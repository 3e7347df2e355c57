# SPDX-License-Identifier: GPL-3.0-or-later
"""Notes on a mesh, kept with its result: in English for JSON, and so that the panel can say them in any language."""

from __future__ import annotations

import json
from collections.abc import Iterable

import bpy
from bpy.app.translations import pgettext_rpt as rpt_

from ..core.sentence import Sentence


def keep(result: bpy.types.PropertyGroup, notes: Iterable[Sentence]) -> None:
    """Keep the notes of a decomposition and of the object's shape. notes : tuple of core.sentence.Sentence"""
    result.notes = "\n".join(notes)
    result.note_words = json.dumps([[note.message, note.values] for note in notes])


def spoken(result: bpy.types.PropertyGroup) -> list[str]:
    """The notes in the language of the interface; those of an earlier version as they are."""
    if not result.note_words:
        return result.notes.splitlines()
    return [rpt_(message).format(**values) for message, values in json.loads(result.note_words)]

# SPDX-License-Identifier: GPL-3.0-or-later
"""What the scene can get wrong, what users are told of it, and the way into core."""

from __future__ import annotations

import importlib
from types import ModuleType
from typing import Any

from bpy.app.translations import pgettext_rpt as rpt_


class SceneError(Exception):
    """The scene does not allow what was asked; the message is the sentence the user reads, translated."""


def translated(words: str | Exception) -> str:
    """A sentence of core, or an error that carries one, in the language of the interface.

    What is in that language already, like a SceneError, stays as it is. An array for which there is no room says how
    large it would be, and nothing of what to do: all of it has been taken back when this is asked.
    """
    if isinstance(words, MemoryError):
        return rpt_("There is not enough memory; nothing was changed. Close other programs and try again.")
    sentence: Any = words.args[0] if isinstance(words, Exception) else words
    # By what it has, not by its type: Blender may have loaded the extension anew in the meantime.
    if not hasattr(sentence, "message"):
        return str(sentence)
    return rpt_(sentence.message).format(**sentence.values)


def load_core() -> ModuleType:
    """The package ``core`` with SciPy behind it.

    SciPy is imported as late as possible: another extension may have replaced the copy that came with
    this one, and then the panel should still be there to say so.

    Raises
    ------
    SceneError
        SciPy is missing or does not fit this Blender.
    """
    try:
        # The pipeline is what needs SciPy.
        importlib.import_module("..core.pipeline", __package__)
    except ImportError as error:
        raise SceneError(
            rpt_("SciPy, which Reeb Parts computes with, could not be imported ({error}). Install Reeb Parts "
                 "again; if that does not help, another extension brings a SciPy that does not fit this "
                 "Blender.").format(error=error)
        ) from error
    return importlib.import_module("..core", __package__)

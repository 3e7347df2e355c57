# SPDX-License-Identifier: GPL-3.0-or-later
"""What the scene can get wrong, and the way into core."""

import importlib


class SceneError(Exception):
    """The scene does not allow what was asked; the message is the sentence the user reads."""


def load_core():
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
            f"SciPy, which Reeb Parts computes with, could not be imported ({error}). Install Reeb Parts "
            "again; if that does not help, another extension brings a SciPy that does not fit this Blender."
        ) from error
    return importlib.import_module("..core", __package__)

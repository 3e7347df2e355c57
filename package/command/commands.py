# SPDX-License-Identifier: GPL-3.0-or-later
"""Cut meshes into the parts a person would name, without Blender.

    reeb-parts decompose model.glb --colored parts.glb --picture parts.png
"""

from __future__ import annotations

import argparse

from ..core.errors import ParameterError, ReebError
from ..core.options import FAILED, WRONG_OPTION, in_working_folder
from ..core.version import VERSION
from . import batch, decompose, similar
from .words import say

COMMANDS = {"decompose": decompose, "batch": batch, "similar": similar}


def parse(arguments: list[str] | None) -> argparse.Namespace:
    """Read what the command was given; ends the process if that is wrong, or asks for help.

    arguments : None for those of this process.
    """
    parser = argparse.ArgumentParser(prog="reeb-parts", description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--version", action="version", version=VERSION)
    commands = parser.add_subparsers(dest="command", required=True, metavar="COMMAND")
    for name, module in COMMANDS.items():
        summary = (module.__doc__ or "").partition("\n")[0]  # there is none with python -OO
        module.add_options(commands.add_parser(name, help=summary, description=module.__doc__,
                                               formatter_class=argparse.RawDescriptionHelpFormatter))
    return parser.parse_args(arguments)


def import_readers() -> None:
    """Import trimesh, which would take a Ctrl+C meanwhile for the lack of a package, and go on."""
    import trimesh  # noqa: F401


def run(options: argparse.Namespace) -> int:
    """Do it; returns the exit status: 0 only if all went well."""
    try:
        with in_working_folder():
            return COMMANDS[options.command].run(options)
    except ReebError as error:
        say(str(error))
        return WRONG_OPTION if isinstance(error, ParameterError) else FAILED
    except MemoryError:
        say("There is not enough memory.")
        return FAILED

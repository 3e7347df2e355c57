# SPDX-License-Identifier: GPL-3.0-or-later
"""Cut meshes into the parts a person would name, without Blender.

    reeb-parts decompose model.glb --colored parts.glb --picture parts.png
"""

from __future__ import annotations

import argparse
import signal
import sys

from ..core.errors import ReebError
from ..core.result.decomposition import VERSION
from . import batch, decompose, similar

COMMANDS = {"decompose": decompose, "batch": batch, "similar": similar}
FAILED, INTERRUPTED = 1, 130


def main(arguments: list[str] | None = None) -> int:
    """The command; returns the exit status: 0 only if all went well, 130 after Ctrl+C."""
    parser = argparse.ArgumentParser(prog="reeb-parts", description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--version", action="version", version=VERSION)
    commands = parser.add_subparsers(dest="command", required=True, metavar="COMMAND")
    for name, module in COMMANDS.items():
        summary = (module.__doc__ or "").splitlines()[0]
        module.add_options(commands.add_parser(name, help=summary, description=module.__doc__,
                                               formatter_class=argparse.RawDescriptionHelpFormatter))
    options = parser.parse_args(arguments)
    # The request of the system to end is heard as Ctrl+C is.
    signal.signal(signal.SIGTERM, signal.default_int_handler)
    try:
        return COMMANDS[options.command].run(options)
    except KeyboardInterrupt:
        say("Interrupted.")
        return INTERRUPTED
    except ReebError as error:
        say(str(error))
        return FAILED
    except MemoryError:
        say("There is not enough memory.")
        return FAILED


def say(text: str) -> None:
    """A line on standard error."""
    print(f"reeb-parts: {text}", file=sys.stderr, flush=True)

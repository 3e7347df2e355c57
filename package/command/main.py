# SPDX-License-Identifier: GPL-3.0-or-later
"""Cut meshes into the parts a person would name, without Blender.

    reeb-parts decompose model.glb --colored parts.glb --picture parts.png
"""

from __future__ import annotations

import argparse
import signal

from ..core.errors import ReebError
from ..core.result.decomposition import VERSION
from . import batch, decompose, similar
from .words import say

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
    _hear_signals()
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


def _hear_signals() -> None:
    """Hear the request of the system to end, and the end of the terminal, as Ctrl+C is heard."""
    signal.signal(signal.SIGTERM, signal.default_int_handler)
    if hasattr(signal, "SIGHUP") and signal.getsignal(signal.SIGHUP) is not signal.SIG_IGN:  # as it is after nohup
        signal.signal(signal.SIGHUP, signal.default_int_handler)

# SPDX-License-Identifier: GPL-3.0-or-later
"""How long the harness looks for faults, and the cases that it has found.

The environment variable REEB_PARTS_FUZZ is a number of seconds for each test of the harness; each run then goes other
ways. Without it a fixed slice is run, the same each time, with all cases that were found before.
"""

import json
import os
import time
import zlib
from collections.abc import Iterator
from pathlib import Path

CASES = Path(__file__).parent / "cases"
SECONDS = float(os.environ.get("REEB_PARTS_FUZZ", 0))


def rounds(fixed: int) -> Iterator[int]:
    """The seeds of the rounds: 0 to ``fixed`` - 1, or others for as long as there is time."""
    if not SECONDS:
        yield from range(fixed)
        return
    end, seed = time.monotonic() + SECONDS, time.time_ns() // 1000
    while time.monotonic() < end:
        yield seed
        seed += 1


def store(kind: str, case: dict) -> Path:
    """Keep a case that fails, so that it is tried each time from now on; only while looking for new ones."""
    path = CASES / f"{kind}-{zlib.crc32(json.dumps(case, sort_keys=True).encode()):08x}.json"
    if SECONDS:
        CASES.mkdir(exist_ok=True)
        path.write_text(json.dumps({"kind": kind, **case}, indent=1) + "\n")
    return path


def stored(kind: str) -> list[dict]:
    """The cases of a kind that were found before."""
    found = [json.loads(path.read_text()) for path in sorted(CASES.glob("*.json"))]
    return [case for case in found if case["kind"] == kind]


def count(what: str, number: int) -> None:
    """Say how much was tried; in the report of a long run."""
    if SECONDS and (path := os.environ.get("REEB_PARTS_FUZZ_COUNTS")):
        with open(path, "a") as file:
            file.write(f"{number} {what}\n")

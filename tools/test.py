# SPDX-License-Identifier: GPL-3.0-or-later
"""Set everything up and run the tests.

    ./test                                     the unit tests and the operator tests
    ./test unit-newest blender-5.2             only these
    ./test --blender PATH [--gui PATH]         also on the built extension, installed into a full Blender
    ./test unit-newest -- -k torus --pdb       everything after -- goes to pytest

The unit tests of core/ need no Blender and run with the oldest and the newest NumPy and SciPy that the
product supports. The operator tests run in Blender as a Python module, with the NumPy that each official
Blender comes with. What this machine has no Python for is left out, and said so.
"""

from __future__ import annotations

import argparse
import os
import subprocess
import sys
import tempfile
import time
import xml.etree.ElementTree as ElementTree
from dataclasses import dataclass
from pathlib import Path

import environments
from environments import JSONSCHEMA, PYTEST, ROOT, SCIPY, Environment, say

RUFF = Environment("lint", environments.any_python("lint").python, ("ruff==0.17.5",))
NEWEST = environments.any_python("unit-newest", "numpy", "scipy", PYTEST, JSONSCHEMA)
OLDEST = Environment("unit-oldest", "3.11", ("numpy==1.24.3", SCIPY, PYTEST, JSONSCHEMA))
SUITES = {
    "unit-oldest": (OLDEST, "tests/unit"),
    "unit-newest": (NEWEST, "tests/unit"),
    "blender-4.2": (environments.BLENDER_42, "tests/blender"),
    "blender-4.5": (environments.BLENDER_45, "tests/blender"),
    "blender-5.2": (environments.BLENDER_52, "tests/blender"),
}
# Blender as a module may crash or wait for ever while it is torn down at the end of Python: 4.2 as soon as anything
# has registered a callback (a command, a handler, an update function), 4.5 in a thread of its own. So it is left.
PYTEST_AND_LEAVE = "import os, sys, pytest; status = pytest.main(); sys.stdout.flush(); os._exit(status)"


@dataclass(frozen=True)
class Outcome:
    """What became of one step."""

    name: str
    passed: int
    failed: int
    seconds: float


def main() -> None:
    """Run the chosen suites, then print one line each and the sum."""
    words = sys.argv[1:]
    cut = words.index("--") if "--" in words else len(words)
    ours, for_pytest = words[:cut], words[cut + 1 :]
    parser = argparse.ArgumentParser(
        prog="./test", description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("suites", nargs="*", metavar="SUITE", help=", ".join(SUITES))
    parser.add_argument("--lint", action="store_true", help="also run ruff")
    parser.add_argument("--blender", metavar="PATH", help="also build, install and test in this full Blender")
    parser.add_argument("--gui", metavar="PATH", help="with --blender: also press the buttons in a real window")
    arguments = parser.parse_args(ours)
    if unknown := set(arguments.suites) - set(SUITES):
        parser.error(f"no such suite: {', '.join(sorted(unknown))} (there are {', '.join(SUITES)})")

    outcomes = []
    with tempfile.TemporaryDirectory() as scratch:
        if arguments.lint:
            outcomes.append(_lint())
        for name in arguments.suites or SUITES:
            environment, folder = SUITES[name]
            if environments.find_python(environment.python) is None:
                say(f"NOT RUN: {name} needs Python {environment.python}, which was not found here")
                continue
            outcomes.append(_pytest(name, environment, folder, Path(scratch), for_pytest))
        if arguments.blender:
            outcomes += _full_blender(arguments.blender, arguments.gui, Path(scratch))
    _summary(outcomes)


def _lint() -> Outcome:
    """Check the style of every Python file; one outcome for all."""
    start = time.perf_counter()
    python = environments.prepare(RUFF)
    say("lint: ruff check")
    status = subprocess.run([str(python), "-m", "ruff", "check", "--quiet", str(ROOT)], check=False).returncode
    return Outcome("lint", int(status == 0), int(status != 0), time.perf_counter() - start)


def _pytest(name: str, environment: Environment, folder: str, scratch: Path, extra: list[str]) -> Outcome:
    """Run one folder of tests in one environment."""
    start = time.perf_counter()
    python = environments.prepare(environment)
    say(f"{name}: pytest {folder} (Python {environment.python}; {', '.join(environment.packages)})")
    report = scratch / f"{name}.xml"
    # A settings folder of its own keeps the user's Blender preferences and extensions out of it.
    variables = {**os.environ, "BLENDER_USER_RESOURCES": str(scratch / name), "PYTHONDONTWRITEBYTECODE": "1"}
    variables.pop("PYTHONPATH", None)
    (scratch / name).mkdir()
    run = ["-c", PYTEST_AND_LEAVE] if environment.blender else ["-m", "pytest"]
    options = ["-q", f"--junitxml={report}", "-p", "no:cacheprovider", *extra]
    command = [str(python), *run, folder, *options]
    status = subprocess.run(command, cwd=ROOT, env=variables, check=False).returncode
    return _outcome(name, report, status, time.perf_counter() - start)


def _full_blender(blender: str, gui: str | None, scratch: Path) -> list[Outcome]:
    """Build the extension, install it into a full Blender and test it there, inside and from outside."""
    start = time.perf_counter()
    say("build: tools/build.py")
    command = [sys.executable, str(ROOT / "tools" / "build.py"), "--blender", blender]
    status = subprocess.run(command, check=False).returncode
    outcomes = [Outcome("build", int(status == 0), int(status != 0), time.perf_counter() - start)]
    if status:
        return outcomes

    python = environments.prepare(NEWEST)
    runner = [str(python), str(ROOT / "tests" / "run_in_blender.py"), "--blender", blender]
    runner += ["--gui", gui] if gui else []
    parts = ["inside", "command", *(["window"] if gui else [])]
    if not gui:
        say("NOT RUN: the real-window test, no --gui was given")
    for part in parts:
        start = time.perf_counter()
        report = scratch / f"{part}.xml"
        say(f"{part}: tests/run_in_blender.py --part {part}")
        command = [*runner, "--part", part, "--resources", str(scratch / "resources"), "--junit", str(report)]
        status = subprocess.run(command, cwd=ROOT, check=False).returncode
        outcomes.append(_outcome(f"installed, {part}", report, status, time.perf_counter() - start))
    return outcomes


def _outcome(name: str, report: Path, status: int, seconds: float) -> Outcome:
    """Count what pytest wrote; a run that failed without a failing test counts as one, a skipped test too."""
    passed = failed = 0
    if report.is_file():
        for suite in ElementTree.parse(report).iter("testsuite"):
            wrong = sum(int(suite.get(key, 0)) for key in ("failures", "errors", "skipped"))
            failed += wrong
            passed += int(suite.get("tests", 0)) - wrong
    if (status and not failed) or not passed + failed:
        say(f"{name}: ended with status {status} and {passed} passed tests, which counts as a failure")
        failed += 1
    return Outcome(name, passed, failed, seconds)


def _summary(outcomes: list[Outcome]) -> None:
    """One line per step, then the sum alone on a line; the exit status says whether all is well."""
    print(f"\n{'step':<22} {'passed':>7} {'failed':>7} {'seconds':>8}")
    for outcome in outcomes:
        print(f"{outcome.name:<22} {outcome.passed:>7} {outcome.failed:>7} {outcome.seconds:>8.1f}")
    passed = sum(outcome.passed for outcome in outcomes)
    failed = sum(outcome.failed for outcome in outcomes)
    print(f"{passed} passed, {failed} failed", flush=True)
    sys.exit(1 if failed or not passed else 0)


if __name__ == "__main__":
    main()

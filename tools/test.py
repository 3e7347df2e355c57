# SPDX-License-Identifier: GPL-3.0-or-later
"""Set everything up and run the tests.

    ./test                                     the unit tests, the operator tests, and the commands that the pages name
    ./test unit-newest blender-5.2             only these
    ./test --blender PATH [--gui PATH]         also on the built extension, installed into a full Blender
    ./test unit-newest -- -k torus --pdb       everything after -- goes to pytest
    ./test --brief                             each test in some of the versions, and half of many cases
    ./test --fuzz MINUTES                      look for faults, and store each as a case in tests/fuzz/cases

The unit tests of core/ need no Blender and run with the oldest and the newest NumPy and SciPy that the
product supports. The operator tests run in Blender as a Python module, with the NumPy that each official
Blender comes with. The newest of these tries every operator in every situation; each other Blender tries every operator
once and every situation at least once, on diagonals of this table that differ. What this machine has no Python for is
left out, and said so.

One step more runs at a time than there are processors, as those in a real window wait half of the time; what is timed
in the window runs alone. What each printed is shown when it ends. A single step, or --jobs 1, prints at once.
"""

from __future__ import annotations

import argparse
import os
import shutil
import subprocess
import sys
import tempfile
import threading
import time
import xml.etree.ElementTree as ElementTree
from collections.abc import Callable
from concurrent.futures import FIRST_COMPLETED, Future, ThreadPoolExecutor, wait
from dataclasses import dataclass
from functools import cache, partial
from pathlib import Path

import environments
from environments import HYPOTHESIS, JSONSCHEMA, PYTEST, PYTEST_AND_LEAVE, ROOT, SCIPY, Environment, say

LINT = environments.lint()
NEWEST = environments.any_python("unit-newest", "numpy", "scipy", PYTEST, HYPOTHESIS, JSONSCHEMA)
PACKAGE = environments.package()
OLDEST = Environment("unit-oldest", "3.11", ("numpy==1.24.3", SCIPY, PYTEST, JSONSCHEMA))


@dataclass(frozen=True)
class Suite:
    """A folder of tests, or a pattern of files, and where it runs."""

    environment: Environment
    folder: str
    words: str = ""  # what of it, as pytest -k understands


SUITES = {
    # About in the order of how long they take, so that a short one is the last to end.
    "fuzz-core": Suite(NEWEST, "tests/fuzz/core"),
    # Whole runs, but for what takes long; single stages are in unit-newest alone, and what is made of parts runs in
    # Blender 4.2 with the same NumPy. That the versions agree is held by the stored answers of test_everywhere.py.
    "unit-oldest": Suite(OLDEST, "tests/unit/test_*.py", "not 2005 and not 2007 and not test_cost and not huge and "
                         "not bag_of and not test_scale and not test_resolutions"),
    "fuzz-blender": Suite(environments.BLENDER_52, "tests/fuzz/blender"),
    "documents": Suite(NEWEST, "tests/documents"),
    "package": Suite(PACKAGE, "tests/package"),
    "blender-4.2": Suite(environments.BLENDER_42, "tests/blender"),
    "blender-4.5": Suite(environments.BLENDER_45, "tests/blender"),
    "blender-5.2": Suite(environments.BLENDER_52, "tests/blender"),
    "blender-5.3": Suite(environments.BLENDER_53, "tests/blender"),
    "unit-newest": Suite(NEWEST, "tests/unit"),
}
#: What of their tables the Blenders but the newest try, see tests/diagonal.py.
DIAGONAL = "REEB_PARTS_DIAGONAL"
#: Where time is short: what leaves sixths of the operator tests, see there, too, and which: each test is tried in one
#: Blender, as a module or in full.
SIXTHS = "REEB_PARTS_SIXTHS"
BRIEF_SIXTHS = {"blender-4.2": "15", "blender-4.5": "3", "blender-5.2": "2", "blender-5.3": "0", "inside": "4"}
#: And what leaves half of the cases of long tables, see there as well.
HALF = "REEB_PARTS_HALF"
HALVED = {*BRIEF_SIXTHS, "unit-newest", "unit-oldest", "fuzz-blender"}
#: Of the unit tests, which: the methods from papers are tried on models, by stored answers, and on any mesh by
#: tests/fuzz; an older processor with one version of NumPy.
BRIEF_WORDS = {"unit-oldest": "test_models or (test_everywhere and not older_processor)",
               "unit-newest": "test_models or not (test_pipeline or test_scale) or not (2005 or 2007 or 2009)",
               "inside": "not older_processor"}
#: The suites that can run for long, and how many tests in each share that time.
LONG = {"fuzz-core": 1, "fuzz-blender": 3}
COUNTS = "counts.txt"
NOT_RUN: list[str] = []
PREPARING = threading.Lock()  # two of pip and apt at a time would get in each other's way


@dataclass(frozen=True)
class Outcome:
    """What became of one step."""

    name: str
    passed: int
    failed: int
    seconds: float


@dataclass(frozen=True)
class Step:
    """Something to run: ``work`` is given where its output goes, and returns how many passed and failed."""

    name: str
    work: Callable[[Path | None], tuple[int, int]]
    after: str = ""  # the step that has to pass before
    alone: bool = False  # nothing else runs meanwhile


def main() -> None:
    """Run the chosen steps, then print one line each and the sum."""
    words = sys.argv[1:]
    cut = words.index("--") if "--" in words else len(words)
    ours, for_pytest = words[:cut], words[cut + 1 :]
    parser = argparse.ArgumentParser(
        prog="./test", description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("suites", nargs="*", metavar="SUITE", help=", ".join(SUITES))
    parser.add_argument("--lint", action="store_true", help="also check the style and the types")
    parser.add_argument("--blender", metavar="PATH", help="also build, install and test in this full Blender")
    parser.add_argument("--gui", metavar="PATH", help="with --blender: also press the buttons in a real window")
    parser.add_argument("--brief", action="store_true",
                        help="try each test in some of the versions, and half of many cases")
    parser.add_argument("--fuzz", type=float, metavar="MINUTES", help="run the harness of tests/fuzz for so long")
    jobs = (os.cpu_count() or 1) + 1
    parser.add_argument("--jobs", type=int, default=jobs, metavar="N", help=f"steps at a time, default {jobs}")
    arguments = parser.parse_args(ours)
    if unknown := set(arguments.suites) - set(SUITES):
        parser.error(f"no such suite: {', '.join(sorted(unknown))} (there are {', '.join(SUITES)})")
    if arguments.fuzz:
        arguments.suites = arguments.suites or LONG
    # Several processes whose NumPy takes every core wait for each other: a small product of matrices takes 100 times as
    # long then.
    os.environ.setdefault("OPENBLAS_NUM_THREADS", str(max(1, (os.cpu_count() or 1) // max(arguments.jobs, 1))))
    # Hundreds of processes import the same modules, which pip does not compile, see environments.prepare.
    os.environ.pop("PYTHONDONTWRITEBYTECODE", None)
    with tempfile.TemporaryDirectory() as scratch:
        outcomes = _run(_steps(arguments, for_pytest, Path(scratch)), arguments.jobs, Path(scratch))
        _tell_counts(Path(scratch) / COUNTS)
    _summary(outcomes)


def _steps(arguments: argparse.Namespace, for_pytest: list[str], scratch: Path) -> list[Step]:
    """What was asked for and can be run here; of those that are ready, the first is started first."""
    steps = [Step("lint", _lint)] if arguments.lint else []
    if arguments.blender:
        steps += _full_blender(arguments.blender, arguments.gui, scratch, arguments.brief)
    elif not arguments.suites:
        _left_out("the installed extension in a full Blender, no --blender was given")
    chosen = [name for name in arguments.suites or SUITES if _has_python(name)]
    in_blender = [name for name in SUITES if name in chosen and SUITES[name].folder == "tests/blender"]
    older = [] if arguments.brief else in_blender[:-1]
    for name in sorted(chosen, key=[*SUITES].index, reverse=True):  # the longest first
        after = "build" if name == "documents" and arguments.blender else ""
        steps.append(Step(name, _work(name, arguments, for_pytest, scratch, older), after))
    return sorted(steps, key=lambda step: step.alone)


def _has_python(name: str) -> bool:
    """Whether this machine has the Python of a suite; says so if not."""
    version = SUITES[name].environment.python
    if environments.find_python(version):
        return True
    _left_out(f"{name} needs Python {version}, which was not found here")
    return False


def _work(name: str, arguments: argparse.Namespace, for_pytest: list[str], scratch: Path,
          older: list[str]) -> Callable[[Path | None], tuple[int, int]]:
    """What runs a suite. older : the Blenders but the newest, each of which tries a diagonal of its own."""
    if name == "package":
        return partial(_package, arguments.blender, scratch, for_pytest)
    if name == "documents":
        return partial(_documents, arguments.blender, scratch, for_pytest)
    words, variables = [], {}
    if arguments.brief:
        variables |= _sixths(name, *(["inside"] if name == "blender-5.2" and not arguments.blender else []))
        variables |= _half(name)
        words = _words(name)
    if arguments.fuzz and name in LONG:
        variables |= {"REEB_PARTS_FUZZ": str(60 * arguments.fuzz / LONG[name]),
                      "REEB_PARTS_FUZZ_COUNTS": str(scratch / COUNTS)}
    diagonal = older.index(name) if name in older else None
    return partial(_pytest, name, diagonal, scratch, [*words, *for_pytest], **variables)


def _run(steps: list[Step], jobs: int, scratch: Path) -> list[Outcome]:
    """Run the steps, several at a time; what each printed is shown when it ends."""
    waiting, outcomes = list(steps), {}
    running: dict[Future, Step] = {}
    at_once = jobs <= 1 or len(steps) == 1
    with ThreadPoolExecutor(max(jobs, 1)) as pool:
        while waiting or running:
            for step in [step for step in waiting if not step.after or step.after in outcomes]:
                if step.after and outcomes[step.after].failed:
                    _left_out(f"{step.name}, because {step.after} failed")
                    waiting.remove(step)
                elif not running or (len(running) < jobs and not step.alone):
                    waiting.remove(step)
                    running[pool.submit(_timed, step, None if at_once else scratch / f"{step.name}.log")] = step
                if any(step.alone for step in running.values()):
                    break
            for future in wait(running, return_when=FIRST_COMPLETED).done:
                step, outcome = running.pop(future), future.result()
                outcomes[step.name] = outcome
                if not at_once:
                    _show(outcome, scratch / f"{step.name}.log")
    return [outcomes[step.name] for step in steps if step.name in outcomes]


def _timed(step: Step, log: Path | None) -> Outcome:
    """Run one step; an environment that cannot be made has said why, and is a failure of this step alone."""
    start = time.perf_counter()
    try:
        passed, failed = step.work(log)
    except SystemExit:
        passed, failed = 0, 1
    return Outcome(step.name, passed, failed, time.perf_counter() - start)


def _show(outcome: Outcome, log: Path) -> None:
    """What a step printed, in one piece."""
    text = log.read_text(encoding="utf-8", errors="replace") if log.exists() else ""
    print(f"\n=== {outcome.name}: {outcome.seconds:.1f} s\n{text}", flush=True)


def _left_out(what: str) -> None:
    """Say what is not run: now, and again at the end."""
    NOT_RUN.append(what)
    say(f"NOT RUN: {what}")


def _call(command: list[str], log: Path | None, **options) -> int:
    """Exit status of a command in the checkout; its output is added to the log, if there is one."""
    if log is None:
        return subprocess.run(command, cwd=ROOT, check=False, **options).returncode
    with log.open("ab") as sink:
        return subprocess.run(
            command, cwd=ROOT, check=False, stdin=subprocess.DEVNULL, stdout=sink, stderr=sink, **options
        ).returncode


def _prepare(environment: Environment) -> str:
    """The interpreter of an environment, made when missing."""
    with PREPARING:
        return str(environments.prepare(environment))


def _lint(log: Path | None) -> tuple[int, int]:
    """Check the style and the types of the code."""
    _prepare(LINT)
    say("lint: tools/lint.py, ruff and mypy")
    checks = [_call([sys.executable, str(ROOT / "tools" / "lint.py"), name], log) for name in ("ruff", "mypy")]
    return checks.count(0), len(checks) - checks.count(0)


def _pytest(name: str, diagonal: int | None, scratch: Path, extra: list[str], log: Path | None,
            **variables: str) -> tuple[int, int]:
    """Run one folder of tests in one environment."""
    environment, folder = SUITES[name].environment, SUITES[name].folder
    python = _prepare(environment)
    say(f"{name}: pytest {folder} (Python {environment.python}; {', '.join(environment.packages)})")
    report = scratch / f"{name}.xml"
    # A settings folder of its own keeps the user's Blender preferences and extensions out of it.
    variables = {**os.environ, "BLENDER_USER_RESOURCES": str(scratch / name), **variables}
    variables.pop("PYTHONPATH", None)
    if diagonal is not None:
        _left_out(f"{name}: all but one situation of each operator, and of what tests/diagonal.py names")
        variables[DIAGONAL] = str(diagonal)
    (scratch / name).mkdir(exist_ok=True)
    run = ["-c", PYTEST_AND_LEAVE] if environment.blender else ["-m", "pytest"]
    words = SUITES[name].words if "-k" not in extra else ""
    options = ["-q", f"--junitxml={report}", "-p", "no:cacheprovider", *(["-k", words] if words else []), *extra]
    paths = [str(path.relative_to(ROOT)) for path in sorted(ROOT.glob(folder))]
    return _count(name, report, _call([python, *run, *paths, *options], log, env=variables))


def _package(blender: str | None, scratch: Path, extra: list[str], log: Path | None) -> tuple[int, int]:
    """Run the tests of the Python package."""
    if not blender:
        _left_out("package: files that Blender reads, no --blender was given")
    return _pytest("package", None, scratch, extra, log, BLENDER=blender or "", BROWSER=_browser() or "")


@cache
def _browser() -> str | None:
    """A browser for the tests of pages, brought if that is possible; says so if there is none."""
    with PREPARING:
        browser = environments.browser()
    if not browser:
        _left_out("the tests of pages in a browser, there is no Chromium; as root, run: apt-get install chromium")
    return browser


def _documents(blender: str | None, scratch: Path, extra: list[str], log: Path | None) -> tuple[int, int]:
    """Run the commands that the pages name."""
    # Made here, under the lock, rather than by the commands.
    for environment in (environments.any_blender(), environments.benchmarks(), LINT):
        _prepare(environment)
    browser = _browser()
    if not blender:
        _left_out("the commands of a full Blender that the pages name, no --blender was given")
        return _pytest("documents", None, scratch, extra, log, BLENDER="", BROWSER=browser or "")
    shutil.copytree(scratch / "resources", scratch / "documents", symlinks=True)
    return _pytest("documents", None, scratch, extra, log, BLENDER=blender, BROWSER=browser or "")


def _sixths(name: str, *missing: str) -> dict[str, str]:
    """The variable that leaves sixths of the operator tests of a step, and says so; nothing for other steps.

    missing : steps that do not run, whose sixths this one takes over.
    """
    if name not in BRIEF_SIXTHS:
        return {}
    sixths = "".join(sorted(BRIEF_SIXTHS[step] for step in (name, *missing)))
    _left_out(f"{name}: of tests/blender all but the sixths {', '.join(sixths)} of 0 to 5 (--brief)")
    return {SIXTHS: sixths}


def _half(name: str) -> dict[str, str]:
    """The variable that leaves half of the cases of long tables, and says so; nothing for other steps."""
    if name not in HALVED:
        return {}
    _left_out(f"{name}: half of the cases of each test that has many (--brief)")
    return {HALF: "1"}


def _words(name: str) -> list[str]:
    """The options that leave those of the tests of a step that are tried where time is short, and says so."""
    if name not in BRIEF_WORDS:
        return []
    _left_out(f"{name}: all but \"{BRIEF_WORDS[name]}\" (--brief)")
    return ["-k", BRIEF_WORDS[name]]


def _full_blender(blender: str, gui: str | None, scratch: Path, brief: bool) -> list[Step]:
    """Build the extension, install it into a full Blender and test it there, inside and from outside."""
    resources = scratch / "resources"
    runner = [str(ROOT / "tests" / "run_in_blender.py"), "--blender", blender, *(["--gui", gui] if gui else [])]

    def build(log: Path | None) -> tuple[int, int]:
        say("build: tools/build.py, and into the full Blender")
        python = _prepare(NEWEST)
        commands = [[sys.executable, str(ROOT / "tools" / "build.py"), "--blender", blender],
                    [python, *runner, "--part", "install", "--resources", str(resources)]]
        failed = any(_call(command, log) for command in commands)
        return int(not failed), int(failed)

    def part(name: str, log: Path | None) -> tuple[int, int]:
        say(f"installed, {name}: tests/run_in_blender.py --part {name}")
        # Several Blenders run at a time: each has settings of its own.
        own, report = scratch / f"resources-{name}", scratch / f"{name}.xml"
        shutil.copytree(resources, own, symlinks=True)
        variables = {**os.environ, **({**_sixths(name), **_half(name)} if brief else {DIAGONAL: str(len(SUITES))})}
        if name == "inside":
            _left_out("installed, inside: the unit tests but for the stored answers" + ("" if brief else
                      "; all but one situation of each operator, and of what tests/diagonal.py names"))
        command = [_prepare(NEWEST), *runner, "--part", name, "--resources", str(own), "--junit", str(report),
                   *(_words(name) if brief else [])]
        return _count(name, report, _call(command, log, env=variables))

    if not gui:
        _left_out("the real-window tests, no --gui was given")
    # A window test measures how long a person waits, and draws in software: it needs both cores.
    parts = {**({"window": False, "speed": True} if gui else {}), "inside": False, "command": False}
    return [Step("build", build), *(Step(f"installed, {name}", partial(part, name), after="build", alone=alone)
                                    for name, alone in parts.items())]


def _tell_counts(path: Path) -> None:
    """How much the harness has tried, each kind on a line."""
    totals: dict[str, int] = {}
    for line in path.read_text(encoding="utf-8").splitlines() if path.is_file() else ():
        number, what = line.split(" ", 1)
        totals[what] = totals.get(what, 0) + int(number)
    for what, number in totals.items():
        print(f"tried: {number} {what}")


def _count(name: str, report: Path, status: int) -> tuple[int, int]:
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
    return passed, failed


def _summary(outcomes: list[Outcome]) -> None:
    """One line per step, then the sum alone on a line; the exit status says whether all is well."""
    print(f"\n{'step':<22} {'passed':>7} {'failed':>7} {'seconds':>8}")
    for outcome in outcomes:
        print(f"{outcome.name:<22} {outcome.passed:>7} {outcome.failed:>7} {outcome.seconds:>8.1f}")
    for what in NOT_RUN:
        print(f"NOT RUN: {what}")
    passed = sum(outcome.passed for outcome in outcomes)
    failed = sum(outcome.failed for outcome in outcomes)
    print(f"{passed} passed, {failed} failed", flush=True)
    sys.exit(1 if failed or not passed else 0)


if __name__ == "__main__":
    main()

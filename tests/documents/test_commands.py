# SPDX-License-Identifier: GPL-3.0-or-later
"""Every command that README.md, CONTRIBUTING.md and docs/ name runs, in a short form.

SHORT says how each program is made short. The commands of a full Blender are tried when the environment variable
BLENDER names one in which the extension is installed.
"""

import os
import re
import shlex
import subprocess
from pathlib import Path

import pytest
import shapes

ROOT = Path(__file__).resolve().parents[2]
PAGES = [ROOT / "README.md", ROOT / "CONTRIBUTING.md", *sorted((ROOT / "docs").glob("*.md"))]
COMMAND = re.compile(r"(python3 |\./test\b|\./demo\b|\.ci/run\b|blender |\.venv/\S+/bin/).*")
FENCED = re.compile(r"^```\w*\n(.*?)^```", re.MULTILINE | re.DOTALL)
MODEL = re.compile(r"\S+\.(obj|glb|ply|stl|fbx)")


def commands(text: str) -> list[str]:
    """Lines of indented and fenced blocks, and what stands in `backquotes`, if they begin like a command."""
    blocks = re.findall(r"^    (.+)$", text, re.MULTILINE)
    fenced = "\n".join(FENCED.findall(text)).splitlines()
    inline = [" ".join(code.split()) for code in re.findall(r"`([^`]+)`", FENCED.sub("", text))]
    found = [line.strip() for line in (*blocks, *fenced, *inline)]
    return [re.split(r"\s+#", line)[0] for line in found if COMMAND.fullmatch(line)]


def program(command: str) -> str:
    """What SHORT calls it: the script or the module that runs."""
    words = shlex.split(command)
    if words[0] == "python3" or words[0].startswith(".venv/"):
        return words[2] if words[1] == "-m" else words[1]
    return words[0]


# Short forms: from the words of a command and an empty folder to the words that are run.


def help_of(n_words):
    """Its own help, which has to name every option of the command."""
    return lambda words, folder: [*words[:n_words], "--help"]


def on_a_small_model(words, folder):
    """With every model replaced by a coarse tree, and the results in the empty folder."""
    vertices, faces = shapes.tube_tree(step=0.2)
    lines = [*(f"v {x} {y} {z}" for x, y, z in vertices), *(f"f {a} {b} {c}" for a, b, c in faces + 1)]
    for name in filter(MODEL.fullmatch, words):
        (folder / name).with_suffix(".obj").write_text("\n".join(lines))
    return [*(str((folder / word).with_suffix(".obj")) if MODEL.fullmatch(word) else word for word in words),
            "--out", str(folder)]


def at_a_small_size(words, folder):
    """One small refinement instead of all."""
    return [*words, "--size", "3000", "--repeat", "1"]


def only_collected(words, folder):
    """The tests are found."""
    return [*words, "--collect-only", "-p", "no:cacheprovider"]


def in_blender(words, folder):
    """The help of the installed command."""
    return [os.environ["BLENDER"], "--command", "reeb_parts", "--help"]


SHORT = {
    "./demo": on_a_small_model,
    "./test": help_of(1),
    ".ci/run": help_of(1),
    "tools/build.py": help_of(2),
    "tools/pictures.py": help_of(2),
    "tests/run_in_blender.py": help_of(2),
    "tools/lint.py": help_of(2),
    "benchmarks/timing.py": at_a_small_size,
    **{f"benchmarks/{name}.py": help_of(2) for name in (
        "again", "batch", "blender_io", "cgal", "crossvalidate", "detail", "growth", "hand_tools", "label", "paper",
        "princeton", "report", "robustness", "same_results", "separate", "surroundings", "train", "uses")},
    "pytest": only_collected,
    "blender": in_blender,
}
NAMED = sorted({command for page in PAGES for command in commands(page.read_text(encoding="utf-8"))})
HERE = [command for command in NAMED if program(command) in SHORT
        and (program(command) != "blender" or os.environ.get("BLENDER"))]


def test_the_commands_are_found():
    text = ("    ./demo  # on Spot\n\n```sh\npython3 tools/build.py\n```\n"
            "`./test --lint`, `blender\n--help`, `.ci/run`\n    not one\n`tests`\n")
    assert commands(text) == ["./demo", "python3 tools/build.py", "./test --lint", "blender --help", ".ci/run"]
    assert {"./demo", "./test", "blender", "tools/build.py"} <= {program(command) for command in NAMED}


def test_there_is_a_short_form_of_each():
    assert [command for command in NAMED if program(command) not in SHORT] == []


@pytest.mark.parametrize("command", HERE)
def test_it_runs(command, tmp_path):
    words = shlex.split(command)
    shortened = SHORT[program(command)](words, tmp_path)
    variables = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}
    done = subprocess.run(shortened, cwd=ROOT, env=variables, stdin=subprocess.DEVNULL, capture_output=True, text=True,
                          check=False, timeout=300)
    assert done.returncode == 0, done.stderr
    if shortened[-1] == "--help":
        after = words[words.index("--command"):] if "--command" in words else words
        options = {word for word in after if re.match(r"--?[a-z]", word)} - {"--command"}
        assert {option for option in options if not re.search(rf"{option}\b", done.stdout)} == set()

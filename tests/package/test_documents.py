# SPDX-License-Identifier: GPL-3.0-or-later
"""What the pages say of the package and of ``reeb-parts`` runs as it stands there, on small models."""

import json
import re
import shlex
from pathlib import Path

import pytest
import shapes
import trimesh

ROOT = Path(__file__).resolve().parents[2]
PAGES = [ROOT / "README.md", *sorted((ROOT / "docs").glob("*.md"))]
TEXTS = {page.name: page.read_text(encoding="utf-8") for page in PAGES}
COMMANDS = sorted({line for text in TEXTS.values()
                   for line in re.findall(r"^    (reeb-parts .+?)(?:\s+#.*)?$", text, re.M)}
                  | {code for text in TEXTS.values() for code in re.findall(r"`(reeb-parts [a-z]+ [^`\n]+)`", text)})
EXAMPLES = [(name, code) for name, text in TEXTS.items()
            for code in re.findall(r"^```python\n(.*?)^```", text, re.M | re.S)]


@pytest.fixture
def folder(tmp_path, monkeypatch):
    """A folder with the models that the pages name, in which the commands run."""
    mesh = trimesh.Trimesh(*shapes.tube_tree(step=0.2), process=False)
    mesh.export(tmp_path / "model.glb")
    (tmp_path / "models").symlink_to(ROOT / "models")
    monkeypatch.chdir(tmp_path)
    return tmp_path


def test_there_are_examples():
    assert {name for name, _ in EXAMPLES} >= {"README.md", "package.md"}
    assert len(COMMANDS) >= 3


@pytest.mark.parametrize("command", COMMANDS)
def test_commands_run(command, folder, reeb_parts_command):
    if "similar" in command:  # of what a batch has left
        (folder / "archive").mkdir()
        trimesh.Trimesh(*shapes.tube_tree(step=0.2), process=False).export(folder / "archive" / "cow.obj")
        reeb_parts_command("batch", "archive", "--out", "results", "--workers", 1, cwd=folder)
    command, _, file = command.partition(" > ")
    done = reeb_parts_command(*shlex.split(command)[1:], cwd=folder)
    assert done.returncode == 0, done.stderr
    assert not file.endswith(".json") or json.loads(done.stdout)


@pytest.mark.parametrize(("page", "code"), EXAMPLES, ids=[f"{name} {n}" for n, (name, _) in enumerate(EXAMPLES)])
def test_examples_in_python_run(page, code, folder):
    vertices, faces = shapes.tube_tree(step=0.2)
    names = {"vertices": vertices, "faces": faces}
    exec(code, names)
    assert names["nine"].count == min(9, names["result"].n_candidates)

# SPDX-License-Identifier: GPL-3.0-or-later
"""The command in a process of its own: of the checkout with Blender as a module, of what is installed in a full one."""

import os
import subprocess
import sys
from pathlib import Path

import bpy

TESTS = Path(__file__).resolve().parent
#: Files in the process end after so many bytes, as on a full disk: Python ignores the signal that comes with it.
FULL_DISK = "import resource; resource.setrlimit(resource.RLIMIT_FSIZE, ({size}, {size}))"
MODULE = """
import pathlib, sys, tempfile
sys.dont_write_bytecode = True
sys.path.insert(0, {tests!r})
import checkout
with tempfile.TemporaryDirectory() as folder:
    package = checkout.enable(pathlib.Path(folder))
    {before}
    checkout.leave(sys.modules[package + ".batch.command"].main(sys.argv[1:]))
"""


def start(*arguments, before="", stdout=subprocess.PIPE, stderr=subprocess.PIPE) -> subprocess.Popen:
    """Run the command with some arguments. before : Python that is run in the process first."""
    if bpy.app.binary_path:
        before = f"import sys; sys.dont_write_bytecode = True; {before}"
        words = [bpy.app.binary_path, "--background", "--python-expr", before, "--command", "reeb_parts"]
    else:
        words = [sys.executable, "-c", MODULE.format(tests=str(TESTS), before=before)]
    crashes_said = {**os.environ, "PYTHONFAULTHANDLER": "1"}
    return subprocess.Popen([*words, *map(str, arguments)], stdin=subprocess.DEVNULL, stdout=stdout,
                            stderr=stderr, text=True, env=crashes_said)


def run(*arguments, before="") -> subprocess.CompletedProcess:
    """Run the command to its end."""
    with start(*arguments, before=before) as process:
        out, err = process.communicate(timeout=300)
    return subprocess.CompletedProcess(arguments, process.returncode, out, err)


def write_obj(path, shape, name="Tree"):
    """A model file of vertices and triangles with an object of a name; returns the path."""
    vertices, faces = shape
    lines = [f"o {name}", *(f"v {x} {y} {z}" for x, y, z in vertices), *(f"f {a} {b} {c}" for a, b, c in faces + 1)]
    path.write_text("\n".join(lines) + "\n")
    return path


def content(folder) -> dict:
    """All files in a folder and below, with their bytes."""
    return {str(path.relative_to(folder)): path.read_bytes() for path in sorted(Path(folder).rglob("*"))
            if path.is_file() and not path.is_symlink()}

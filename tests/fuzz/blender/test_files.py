# SPDX-License-Identifier: GPL-3.0-or-later
"""Hostile files and command lines: one sentence or one JSON object, an honest exit status, and nothing half-written."""

import json
import re
from itertools import chain

import bpy
import numpy as np
import shapes
from blender.batch.conftest import run  # noqa: F401
from blender.scene.test_stored import DAMAGE
from fuzz import budget

WORDS = ("nan", "inf", "1e999", "-1", "0", "99999999", "", "x", "1e-320", "0x10", "--", "ä", "1/2/3", "2147483648")
OPTIONS = ("--object", "--detail", "--parts-count", "--n-parts", "--json", "--save", "--parts", "--preset", "--method",
           "--node-size", "--format", "--base-spacing", "--n-slabs", "--help", "--caps", "--no-graph", "--nonsense")
VALUES = ("Tree", "0.5", "7", "nan", "-1", "1e999", "", "obj", "perceptual", "OUT/x.json", "OUT/x.blend", "OUT/parts",
          "own.obj", "/dev/null", "OUT", "Berretti 2009", "\x00"[:0], "ä/ö")


def obj_lines(shape):
    """The text of a model, as lines."""
    vertices, faces = shape
    return [*(f"v {x:.6f} {y:.6f} {z:.6f}" for x, y, z in vertices),
            *(f"f {a} {b} {c}" for a, b, c in (faces + 1).tolist())]


def stl_bytes(shape):
    vertices, faces = shape
    record = np.zeros(len(faces), np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("more", "<u2")]))
    record["corners"] = vertices[faces]
    return b"solid of none".ljust(80) + np.uint32(len(faces)).tobytes() + record.tobytes()


def ply_lines(shape):
    vertices, faces = shape
    head = ["ply", "format ascii 1.0", f"element vertex {len(vertices)}", "property float x", "property float y",
            "property float z", f"element face {len(faces)}", "property list uchar int vertex_indices", "end_header"]
    return [*head, *(f"{x} {y} {z}" for x, y, z in vertices), *(f"3 {a} {b} {c}" for a, b, c in faces)]


def damaged_text(lines, rng):
    """Words replaced, lines dropped, doubled and cut."""
    lines = list(lines)
    for _ in range(int(rng.integers(0, 6))):
        at = int(rng.integers(len(lines)))
        words = lines[at].split(" ")
        kind = rng.integers(4)
        if kind == 0:
            words[int(rng.integers(len(words)))] = str(rng.choice(WORDS))
            lines[at] = " ".join(words)
        elif kind == 1:
            del lines[at : at + int(rng.integers(1, 30))]
        elif kind == 2:
            lines.insert(at, lines[int(rng.integers(len(lines)))])
        else:
            lines[at] = lines[at][: int(rng.integers(len(lines[at]) + 1))]
        if not lines:
            break
    return "\n".join(lines).encode()


def model(folder, rng):
    """A model file with damage; its path."""
    shape = shapes.tube_tree(int(rng.integers(1, 3)), 0.4)
    kind = str(rng.choice(["obj", "obj", "ply", "stl"]))
    head, body = ply_lines(shape)[:9], ply_lines(shape)[9:]  # a head that counts millions takes Blender's memory
    content = {"obj": lambda: damaged_text(obj_lines(shape), rng),
               "ply": lambda: "\n".join(head).encode() + b"\n" + damaged_text(body, rng),
               "stl": lambda: stl_bytes(shape)}[kind]()
    if rng.random() < 0.3:
        content = content[: int(rng.integers(len(content) + 1))]
    path = folder / f"own.{kind}"
    path.write_bytes(content)
    return path


def command_line(folder, path, rng):
    """Words of a command, some of them nonsense."""
    words = [str(path)] if rng.random() < 0.95 else []
    for _ in range(int(rng.integers(0, 4))):
        words.append(str(rng.choice(OPTIONS)))
        if rng.random() < 0.8:
            words.append(str(rng.choice(VALUES)).replace("OUT", str(folder)).replace("own.obj", str(path)))
    return words


def check(run, folder, seed):  # noqa: F811
    """Run the command once."""
    rng = np.random.default_rng(seed)
    folder.mkdir()
    path = model(folder, rng)
    words, content = command_line(folder, path, rng), path.read_bytes()
    bpy.ops.wm.read_homefile(use_empty=True)
    try:
        ended = run(*words)
    except SystemExit as end:  # --help, and what argparse refuses
        if end.code not in (0, 1, 2):
            pytest_fail(f"{words}: {end.code}")
        return
    told = f"seed {seed}: {words}\n{ended.err}\n{ended.out[:500]}"
    assert ended.status in (0, 1, 2), told
    assert "Traceback" not in ended.err + ended.out, told
    assert path.read_bytes() == content, told
    assert not [left for left in folder.rglob(".reeb_parts_*")], told
    if ended.out and "usage" not in ended.out:
        json.loads(ended.out, parse_constant=lambda word: pytest_fail(f"{word} in {told}"))
    if ended.status and not ended.out:
        assert re.search(r"\w", ended.err), told


def pytest_fail(text):
    raise AssertionError(text)


def test_any_file_and_command_line(run, tmp_path, monkeypatch):  # noqa: F811
    errors = []
    monkeypatch.chdir(tmp_path)  # some of the nonsense names files
    for seed in chain([case["seed"] for case in budget.stored("file")], budget.rounds(25)):
        try:
            check(run, tmp_path / f"s{seed}{len(errors)}", seed)
        except AssertionError as error:
            budget.store("file", {"seed": seed})
            if not budget.SECONDS:
                raise
            errors.append(error)
        budget.count("command lines", 1)
    assert errors == []


def test_any_damage_to_what_is_stored(make, tmp_path, capfd):
    """Several damages at a time, through a file; nothing says Traceback, Decompose and Clear work."""
    for seed in range(6) if not budget.SECONDS else ():
        rng = np.random.default_rng(seed)
        bpy.ops.wm.read_homefile(use_empty=True)
        make(shapes.tube_tree(2, 0.4))
        bpy.ops.reeb_parts.decompose()
        for name in rng.choice(sorted(DAMAGE), 2, replace=False):
            DAMAGE[name](bpy.context.object.data.reeb_parts)
        result = bpy.context.object.data.reeb_parts
        data = bytearray(result.data)
        for at in rng.integers(0, max(len(data), 1), 3).tolist() if data else ():
            data[at] = int(rng.integers(256))
        result.data = bytes(data)
        bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "x.blend"))
        bpy.ops.wm.open_mainfile(filepath=str(tmp_path / "x.blend"))
        obj = bpy.data.objects["Tree"]
        obj.data.reeb_parts.detail = 0.9
        obj.data.reeb_parts.n_parts = 2
        assert bpy.ops.reeb_parts.decompose() == {"FINISHED"}
        assert bpy.ops.reeb_parts.clear() == {"FINISHED"}
        assert "Traceback" not in "".join(capfd.readouterr()), seed

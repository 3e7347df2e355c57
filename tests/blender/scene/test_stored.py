# SPDX-License-Identifier: GPL-3.0-or-later
"""Files whose stored result is damaged or newer: one sentence from every button, and Decompose and Clear work."""

import io
import json
import time
from contextlib import suppress

import bpy
import numpy as np
import pytest

BUTTONS = ("merge", "split", "grow", "shrink", "merge_neighbour", "release", "assign", "from_face_sets", "separate",
           "select", "seams", "face_sets", "materials", "unwrap", "armature", "mark", "frame", "hide", "isolate",
           "find_similar", "slide")


def with_head(data, **changes):
    """The bytes of a result with other values in its head."""
    with np.load(io.BytesIO(data)) as stored:
        arrays = dict(stored)
    arrays["head"] = np.frombuffer(json.dumps(json.loads(arrays["head"].tobytes()) | changes).encode(), np.uint8)
    stream = io.BytesIO()
    np.savez_compressed(stream, **arrays)
    return stream.getvalue()


DAMAGE = {
    "garbage": lambda r: setattr(r, "data", b"garbage"),
    "cut": lambda r: setattr(r, "data", r.data[: len(r.data) // 2]),
    "flipped": lambda r: setattr(r, "data", r.data[:500] + b"xxxx" + r.data[504:]),
    "newer": lambda r: setattr(r, "data", with_head(r.data, version="9.0.0", format=7)),
    "unknown": lambda r: setattr(r, "data", with_head(r.data, parameters={"nonsense": 1})),
    "no numbers": lambda r: setattr(r, "numbers", b""),
    "odd numbers": lambda r: setattr(r, "numbers", r.numbers[:-3]),
    "huge numbers": lambda r: setattr(r, "numbers", np.full(len(r.numbers) // 4, 2**31 - 1, np.int32).tobytes()),
    "negative numbers": lambda r: setattr(r, "numbers", np.full(len(r.numbers) // 4, -5, np.int32).tobytes()),
    "wrong counts": lambda r: (setattr(r, "n_faces", 2**31 - 1), setattr(r, "n_vertices", -1)),
    "no stretch": lambda r: setattr(r, "stretch", [float("nan")] * 9),
    "notes": lambda r: (setattr(r, "note_words", "[[7], {"), setattr(r, "notes", "x")),
    "list": lambda r: [setattr(part, "number", number) for part, number in zip(r.parts, (2**31 - 1, -3), strict=False)],
    "shorter list": lambda r: r.parts.remove(0),
    "active part removed": lambda r: (setattr(r, "active", len(r.parts) - 1), r.parts.remove(0)),
    "no list": lambda r: r.parts.clear(),
}


@pytest.fixture
def damaged(obj, request):
    bpy.ops.reeb_parts.decompose()
    values = np.zeros(len(obj.data.polygons), np.int32)
    values[:] = np.random.default_rng(0).integers(-(2**31), 2**31 - 1, len(values))
    obj.data.attributes["reeb_part"].data.foreach_set("value", values)
    DAMAGE[request.param](obj.data.reeb_parts)
    return obj


@pytest.mark.parametrize("damaged", DAMAGE, indirect=True)
def test_every_button_says_one_sentence_and_decompose_works(damaged, capfd):
    mesh = damaged.data
    kept = mesh.reeb_parts.data
    for button in BUTTONS:
        with suppress(RuntimeError):
            getattr(bpy.ops.reeb_parts, button)()
        assert "Traceback" not in "".join(capfd.readouterr()), button
        assert mesh.reeb_parts.data == kept
    mesh.reeb_parts.detail = 0.9
    mesh.reeb_parts.n_parts = 3
    if mesh.reeb_parts.parts:
        mesh.reeb_parts.parts[0].locked = True
        mesh.reeb_parts.parts[0].color = (1, 0, 0)
        mesh.reeb_parts.parts[0].name = "Mine"
    assert bpy.ops.reeb_parts.decompose() == {"FINISHED"}
    numbers = np.empty(len(mesh.polygons), np.int32)
    mesh.attributes["reeb_part"].data.foreach_get("value", numbers)
    assert set(numbers.tolist()) == {part.number for part in mesh.reeb_parts.parts}
    assert 0 < numbers.min() <= numbers.max() < 1000
    out, err = capfd.readouterr()
    assert "Traceback" not in out + err


@pytest.mark.parametrize("damaged", DAMAGE, indirect=True)
def test_clear_works(damaged, capfd):
    assert bpy.ops.reeb_parts.clear() == {"FINISHED"}
    assert not damaged.data.reeb_parts.data
    assert "Traceback" not in "".join(capfd.readouterr())


@pytest.mark.parametrize("damaged", ["newer"], indirect=True)
def test_a_newer_result_is_kept_and_said_to_be_newer(damaged, tmp_path):
    kept = damaged.data.reeb_parts.data
    with pytest.raises(RuntimeError, match=r"Reeb Parts 9\.0\.0, which is newer than this one"):
        bpy.ops.reeb_parts.split()
    damaged.data.reeb_parts.detail = 0.2
    assert not damaged.data.reeb_parts.edited
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "kept.blend"))
    bpy.ops.wm.open_mainfile(filepath=str(tmp_path / "kept.blend"))
    assert bpy.data.objects["Tree"].data.reeb_parts.data == kept


def test_buttons_do_not_read_the_result_when_they_are_drawn(obj):
    """Of a million faces it is 10 MB: some forty buttons read it at each redraw, to know that there is one."""
    bpy.ops.reeb_parts.decompose()
    obj.data.reeb_parts.data = bytes(2**26)
    start = time.perf_counter()
    assert obj.data.reeb_parts.data
    middle = time.perf_counter()
    assert all(bpy.ops.reeb_parts.merge.poll() for _ in range(40))
    assert time.perf_counter() - middle < middle - start

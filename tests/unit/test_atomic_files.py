# SPDX-License-Identifier: GPL-3.0-or-later
"""Files that get to their places all together or not at all."""

import os
import sys
from contextlib import nullcontext
from pathlib import Path

import pytest

from core.atomic_files import FORMER, HIDDEN, hidden_place, put_in_place, restore_former, sync


def content(folder):
    """All that is in a folder: files with their text, folders with None."""
    return {path.relative_to(folder).as_posix(): path.read_text() if path.is_file() else None
            for path in sorted(folder.rglob("*"))}


def fill(folder, **files):
    """Files with their texts; the folder."""
    folder.mkdir(exist_ok=True)
    for name, text in files.items():
        (folder / name).write_text(text)
    return folder


@pytest.fixture
def moves(tmp_path):
    """Three new files and where they belong, the middle one a new name."""
    fill(tmp_path, a="old a", c="old c", new_a="new a", new_b="new b", new_c="new c")
    return {tmp_path / f"new_{name}": tmp_path / name for name in "abc"}


def failing(function, after):
    """A function that does as another does, so many times, and then finds no room."""
    calls = []

    def fails(*arguments):
        calls.append(arguments)
        if len(calls) == after + 1:
            raise OSError(28, "No space left on device")
        return function(*arguments)

    return fails


def unsupported(*arguments):
    """What a system call does that a file system has not."""
    raise OSError(95, "Operation not supported")


def test_files_are_all_put_in_place(moves, tmp_path):
    put_in_place(moves, nullcontext)
    assert content(tmp_path) == {"a": "new a", "b": "new b", "c": "new c"}


@pytest.mark.parametrize("links", [True, False], ids=["two names", "one name"])
@pytest.mark.parametrize("after", range(5))
def test_none_is_put_in_place_if_one_cannot_be(moves, tmp_path, monkeypatch, links, after):
    """Whichever move fails, those before are taken back, on file systems with and without second names."""
    before = content(tmp_path)
    n_moves = 3 if links else 5
    if not links:
        monkeypatch.setattr(os, "link", unsupported)
    monkeypatch.setattr(os, "replace", failing(os.replace, after))
    if after >= n_moves:
        put_in_place(moves, nullcontext)
        return
    with pytest.raises(OSError, match="No space left"):
        put_in_place(moves, nullcontext)
    assert content(tmp_path) == before


def test_a_folder_in_the_place_of_a_file_stays(moves, tmp_path):
    (tmp_path / "c").unlink()
    fill(tmp_path / "c", precious="mine")
    before = content(tmp_path)
    with pytest.raises(OSError, match="c"):
        put_in_place(moves, nullcontext)
    assert content(tmp_path) == before


def test_the_error_is_about_the_file_that_could_not_be_moved(moves, tmp_path):
    (tmp_path / "c").unlink()
    (tmp_path / "c").mkdir()
    asked = []

    def about(target):
        asked.append(target.name)
        return nullcontext()

    with pytest.raises(OSError, match="c"):
        put_in_place(moves, about)
    assert asked[-1] == "c"


@pytest.mark.parametrize("after", range(2))
def test_a_folder_is_replaced_or_as_it_was(tmp_path, monkeypatch, after):
    fill(tmp_path / "cow", record="old", gone="gone")
    fill(tmp_path / "new", record="new")
    before = content(tmp_path)
    with monkeypatch.context() as patched:
        patched.setattr(os, "replace", failing(os.replace, after))
        with pytest.raises(OSError, match="No space left"):
            put_in_place({tmp_path / "new": tmp_path / "cow"}, nullcontext)
    assert content(tmp_path) == before
    put_in_place({tmp_path / "new": tmp_path / "cow"}, nullcontext)
    assert content(tmp_path) == {"cow": None, "cow/record": "new"}


def interrupted_before(line, work):
    """Do something that Ctrl+C interrupts before one of the lines of the module; whether it came to that."""
    lines = 0

    def trace(frame, event, argument):
        nonlocal lines
        if frame.f_code.co_filename != put_in_place.__code__.co_filename:
            return None
        lines += event == "line"
        if event == "line" and lines == line:
            raise KeyboardInterrupt
        return trace

    before = sys.gettrace()
    sys.settrace(trace)
    try:
        work()
    except KeyboardInterrupt:
        return True
    finally:
        sys.settrace(before)
    return False


@pytest.mark.parametrize("kind", ["files", "folder"])
def test_an_interruption_at_any_time_leaves_all_old_or_all_new(tmp_path, kind):
    """Former files stay under hidden names only if it comes just before the first of them is removed."""
    interruptions, outcomes, n_left = 0, set(), 0
    while True:
        work = fill(tmp_path / str(interruptions))
        if kind == "files":
            fill(work, a="old", b="old", new_a="new", new_b="new")
            moves = {work / "new_a": work / "a", work / "new_b": work / "b"}
        else:
            fill(work / "a", record="old")
            fill(work / "new_a", record="new")
            moves = {work / "new_a": work / "a"}
        if not interrupted_before(interruptions + 1, lambda moves=moves: put_in_place(moves, nullcontext)):
            break
        shown = {name: text for name, text in content(work).items() if text and not name.startswith((HIDDEN, "new"))}
        assert len(set(shown.values())) == 1
        assert len(shown) == len(moves)
        outcomes |= set(shown.values())
        n_left += any(path.name.startswith(FORMER) for path in work.iterdir())
        interruptions += 1
    assert interruptions > 30
    assert outcomes == {"old", "new"}
    assert n_left <= 3


def test_what_a_killed_process_moved_away_is_brought_back_unless_something_took_its_place(tmp_path):
    former = hidden_place(tmp_path / "cow", beginning=FORMER)
    former.mkdir()
    fill(former / "cow", record="old")
    restore_former(former)
    assert content(tmp_path) == {"cow": None, "cow/record": "old"}
    former.mkdir()
    fill(former / "cow", record="older")
    restore_former(former)
    assert content(tmp_path) == {"cow": None, "cow/record": "old"}


@pytest.mark.parametrize("ending", [b"", b"\n", b"\r\n", b"\x1a", b"\0"])
def test_what_is_written_through_to_the_disk_stays(tmp_path, ending):
    """Windows took a last Ctrl+Z for the end of a text: one file of 256 lost a byte."""
    path = tmp_path / "model.glb"
    path.write_bytes(b"glTF" + ending)
    sync(path)
    assert path.read_bytes() == b"glTF" + ending


def test_hidden_places_cannot_be_guessed():
    target = Path("folder") / "x.json"
    first, second = hidden_place(target, ".json"), hidden_place(target, ".json")
    assert first != second
    assert first.parent == target.parent
    assert first.name.startswith(HIDDEN)
    assert first.suffix == ".json"

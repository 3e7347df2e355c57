# SPDX-License-Identifier: GPL-3.0-or-later
"""Files of the package appear whole or not at all, wherever they are written."""

import os
import shutil
import subprocess
import sys

import pytest
from reeb_parts.batch.tables import MODELS, PARTS, read_rows, write_tables
from reeb_parts.core.atomic_files import FORMER, HIDDEN
from reeb_parts.output_files import OutputFileError, SharedFolder, remove_leftovers, write_files, write_folder


def content(folder):
    """All files in a folder and below, with their bytes."""
    return {str(path.relative_to(folder)): path.read_bytes() for path in sorted(folder.rglob("*")) if path.is_file()}


@pytest.fixture
def full_at(monkeypatch):
    """A function that has the disk be full at one of the next moves."""

    def set_full(number):
        replace, calls = os.replace, []

        def fails(*names):
            calls.append(names)
            if len(calls) == number:
                raise OSError(28, "No space left on device")
            return replace(*names)

        monkeypatch.setattr(os, "replace", fails)

    return set_full


@pytest.mark.parametrize("number", [1, 2])
def test_a_folder_that_cannot_be_replaced_is_as_it_was(number, full_at, tmp_path):
    """The former results were left under a hidden name, and the next run removed them."""
    folder = tmp_path / "models" / "cow"
    write_folder(folder, {"record.json": b"old", "parts/1.ply": b"old"})
    before = content(tmp_path)
    full_at(number)
    with pytest.raises(OSError, match="No space left"):
        write_folder(folder, {"record.json": b"new"})
    assert content(tmp_path) == before
    remove_leftovers(tmp_path)
    assert content(tmp_path) == before
    write_folder(folder, {"record.json": b"new"})
    assert content(tmp_path) == {"models/cow/record.json": b"new"}


@pytest.mark.parametrize(("number", "here", "there"), [(1, False, True), (2, True, True), (1, True, False)])
def test_a_folder_that_another_run_replaces_in_the_same_moment_is_one_of_the_two(number, here, there, monkeypatch,
                                                                                tmp_path):
    """It was an error of the model, whose results were there: the other run had put its own there before one of the
    moves, or had just moved away what was there.
    """
    folder, replace, calls = tmp_path / "cow", os.replace, []
    if here:
        write_folder(folder, {"record.json": b"old", "parts/1.ply": b"old"})

    def comes_second(*names):
        calls.append(names)
        if len(calls) == number and there:
            write_folder(folder, {"record.json": b"other", "parts/1.ply": b"other"})
        elif len(calls) == number:
            shutil.rmtree(folder)
        replace(*names)

    monkeypatch.setattr(os, "replace", comes_second)
    write_folder(folder, {"record.json": b"new"})
    assert content(tmp_path) == {"cow/record.json": b"new"}
    assert list(tmp_path.iterdir()) == [folder]


def test_results_that_a_killed_run_moved_away_are_brought_back(tmp_path):
    write_folder(tmp_path / "models" / "cow", {"record.json": b"old"})
    former = tmp_path / "models" / f"{FORMER}0123"
    former.mkdir()
    (tmp_path / "models" / "cow").rename(former / "cow")
    write_folder(tmp_path / "models" / f"{HIDDEN}4567", {"record.json": b"new"})
    remove_leftovers(tmp_path)
    assert content(tmp_path) == {"models/cow/record.json": b"old"}
    assert [path.name for path in (tmp_path / "models").iterdir()] == ["cow"]


ANOTHER_RUN = """
import sys
from pathlib import Path
from reeb_parts.output_files import SharedFolder
with SharedFolder(Path(sys.argv[1])) as folder:
    folder.remove_leftovers()
    print("there", flush=True)
    sys.stdin.read()
"""


@pytest.mark.skipif(sys.platform == "win32", reason="a run takes itself to be alone there")
def test_what_another_run_is_writing_is_left_until_it_has_ended(tmp_path):
    """Of two runs on one folder either removed what the other one was about to move to its place."""
    with subprocess.Popen([sys.executable, "-c", ANOTHER_RUN, str(tmp_path)], stdin=subprocess.PIPE,
                          stdout=subprocess.PIPE) as other:
        assert other.stdout.readline() == b"there\n"
        written = tmp_path / "models" / f"{HIDDEN}4567"
        write_folder(written, {"record.json": b"new"})
        with SharedFolder(tmp_path) as folder:
            assert not folder.remove_leftovers()  # it is not alone
            assert written.exists()
            other.kill()
            other.wait()
            assert folder.remove_leftovers()
            assert not written.exists()


@pytest.mark.skipif(sys.platform == "win32", reason="a run takes itself to be alone there")
def test_a_run_that_asked_whether_it_is_alone_is_still_known_to_others(tmp_path):
    """To ask may cost the lock by which they know of it, be the answer no or yes."""
    with SharedFolder(tmp_path) as late:
        with SharedFolder(tmp_path) as first:
            with SharedFolder(tmp_path):
                assert not first.remove_leftovers()
            assert not late.remove_leftovers()  # the first is there
        assert late.remove_leftovers()
        with SharedFolder(tmp_path) as another:  # which is let in, and sees the one that was alone
            assert not another.remove_leftovers()
        assert late.remove_leftovers()


def test_tables_are_both_new_or_both_old(tmp_path):
    (tmp_path / "models.parquet").write_bytes(b"old")
    (tmp_path / "parts.parquet").mkdir()
    (tmp_path / "parts.parquet" / "mine").write_bytes(b"mine")
    with pytest.raises(OutputFileError, match="parts.parquet could not be written"):
        write_tables(tmp_path, [])
    assert content(tmp_path) == {"models.parquet": b"old", "parts.parquet/mine": b"mine"}


@pytest.mark.skipif(sys.platform != "linux", reason="other systems do not take such names")
def test_tables_are_in_a_folder_whose_name_is_no_utf8(tmp_path):
    """After all models were done, the run ended with a traceback of Arrow's."""
    out = tmp_path / os.fsdecode(b"m\xf6bel")
    out.mkdir()
    models, parts = write_tables(out, [])
    assert [*read_rows(models, MODELS), *read_rows(parts, PARTS)] == []


def test_files_are_all_new_or_all_old(full_at, tmp_path):
    (tmp_path / "a").write_bytes(b"old")
    full_at(2)
    with pytest.raises(OutputFileError, match="b could not be written: No space left"):
        write_files({tmp_path / "a": b"new", tmp_path / "b": b"new"}, tmp_path / "model")
    assert content(tmp_path) == {"a": b"old"}


def test_a_link_stays_one_and_its_file_is_written(tmp_path):
    (tmp_path / "file").write_bytes(b"old")
    (tmp_path / "link").symlink_to("file")
    write_files({tmp_path / "link": b"new"}, tmp_path / "model")
    assert (tmp_path / "link").is_symlink()
    assert content(tmp_path) == {"file": b"new", "link": b"new"}


def test_a_model_that_is_gone_keeps_no_file_from_being_written(tmp_path):
    (tmp_path / "page").write_bytes(b"old")
    write_files({tmp_path / "page": b"new"}, tmp_path / "gone")
    assert content(tmp_path) == {"page": b"new"}

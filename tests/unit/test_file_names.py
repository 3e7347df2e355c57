# SPDX-License-Identifier: GPL-3.0-or-later
"""Names of files: which characters stay."""

import os
import stat
import unicodedata

import pytest
from systems import unix

from core.file_names import file_name, kind_of, readable, spelled


@pytest.mark.parametrize(("text", "name"), [
    ("Spot", "Spot"), ("a/b:c*d", "a_b_c_d"), (" .. ", "part"), ("trailing. ", "trailing"), ("x" * 300, "x" * 200),
    ("CON", "_CON"), ("nul", "_nul"), ("Aux.L", "_Aux.L"), ("com1", "_com1"), ("LPT9 .x", "_LPT9 .x"),
    ("Console", "Console"), ("com", "com"), ("com10", "com10"), (unicodedata.normalize("NFD", "ähre"), "ähre"),
])
def test_names_are_such_as_every_file_system_takes(text, name):
    assert file_name(text, "part") == name


@unix
def test_names_that_are_no_utf8_are_readable():
    assert readable("plain ä") == "plain ä"
    assert readable(os.fsdecode(b"stra\xdfe.obj")) == "stra\\xdfe.obj"


@unix
def test_names_that_a_locale_can_spell_stay():
    for name in ("plain ä", os.fsdecode(b"stra\xdfe.obj")):
        assert spelled(name) == name


@unix
def test_what_is_behind_a_name_is_known_or_said_not_to_be(tmp_path):
    (tmp_path / "file").touch()
    assert kind_of(tmp_path) == stat.S_IFDIR
    assert kind_of(tmp_path / "file") == stat.S_IFREG
    assert [kind_of(tmp_path / name) for name in ("none", "file/below", "zero\0")] == [0, 0, 0]
    (tmp_path / "loop").symlink_to("loop")
    for name in ("x" * 300, "loop"):
        with pytest.raises(OSError, match="too long|Too many"):
            kind_of(tmp_path / name)

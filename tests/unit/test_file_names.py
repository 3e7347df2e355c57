# SPDX-License-Identifier: GPL-3.0-or-later
"""Names of files: which characters stay."""

import os
import unicodedata

import pytest

from core.file_names import file_name, readable


@pytest.mark.parametrize(("text", "name"), [
    ("Spot", "Spot"), ("a/b:c*d", "a_b_c_d"), (" .. ", "part"), ("trailing. ", "trailing"), ("x" * 300, "x" * 200),
    ("CON", "_CON"), ("nul", "_nul"), ("Aux.L", "_Aux.L"), ("com1", "_com1"), ("LPT9 .x", "_LPT9 .x"),
    ("Console", "Console"), ("com", "com"), ("com10", "com10"), (unicodedata.normalize("NFD", "ähre"), "ähre"),
])  # fmt: skip
def test_names_are_such_as_every_file_system_takes(text, name):
    assert file_name(text, "part") == name


def test_names_that_are_no_utf8_are_readable():
    assert readable("plain ä") == "plain ä"
    assert readable(os.fsdecode(b"stra\xdfe.obj")) == "stra\\xdfe.obj"

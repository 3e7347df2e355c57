# SPDX-License-Identifier: GPL-3.0-or-later
"""Text of any script is broken into lines that fit; nothing of it is lost."""

import importlib
import textwrap

import pytest


@pytest.fixture
def wrapping(package):
    return importlib.import_module(f"{package}.ui.wrapping")


def test_lines_of_words_are_those_of_textwrap(wrapping):
    for text in ("Select a mesh, then press Decompose.", "Ein Wort (so) und „Zitate“, 3.5 % davon!", "word", ""):
        for width in (8, 13, 20, 80):
            assert wrapping.lines(text, width) == textwrap.wrap(text, width, break_long_words=False,
                                                                break_on_hyphens=False)


def test_chinese_is_broken_between_letters_but_not_before_what_closes(wrapping):
    assert wrapping.lines("请选择一个网格，然后按“分解”。", 14) == ["请选择一个网", "格，然后按“分", "解”。"]
    assert wrapping.lines("部件 Part 01 已锁定", 10) == ["部件 Part", "01 已锁定"]


def test_a_number_stays_with_the_word_that_counts_in_chinese(wrapping):
    assert wrapping.lines("17 个节点，16 条弧，0 个环", 23) == ["17 个节点，16 条弧，", "0 个环"]
    assert wrapping.lines("用时 9.49 秒", 10) == ["用时", "9.49 秒"]


def test_every_message_fits_and_is_whole(wrapping, package):
    dictionary = importlib.import_module(f"{package}.ui.translations").dictionary()
    for texts in dictionary.values():
        for text in texts.values():
            lines = wrapping.lines(text, 24)
            assert "".join("".join(lines).split()) == "".join(text.split())
            assert not any(line[0] in "，。；：、！？）”" for line in lines if len(line) > 1)
            # A word of German may be longer than a line; Chinese has none.
            assert all(wrapping.letters(line) <= 26 or " " not in line for line in lines)

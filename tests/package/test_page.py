# SPDX-License-Identifier: GPL-3.0-or-later
"""The page of a batch in a real browser, where somebody types, chooses and scrolls."""

import re

import pytest
from browser import after, in_browser
from reeb_parts.batch.page import page

MODELS = [
    {"name": "cow.obj", "parts": 9, "faces": 5804, "loops": 0},
    {"name": "deep/bull </script>.ply", "parts": 11, "faces": 300, "loops": 0},
    {"name": "cup.stl", "parts": 2, "faces": 30000, "loops": 1, "notes": ["Holes at the rim of a cow's cup"]},
    {"name": "torn.ply", "status": "unreadable", "reason": "There is no mesh in it: <b>nothing</b>"},
]


@pytest.fixture
def shown(tmp_path):
    """A function that gives the names on the page, from above, after words and clicks; and what it counts."""
    path = tmp_path / "index.html"
    common = {"status": "done", "reason": "", "seconds": 0.5, "notes": [], "image": "", "link": "x/"}
    path.write_text(page("Models & more", [common | model for model in MODELS]), encoding="utf-8")

    def look(words="", key="", largest=False):
        dom = after(path, (f"words.value = {words!r}; words.dispatchEvent(new Event('input'));" if words else "")
                    + (f"key.value = {key!r}; key.dispatchEvent(new Event('change'));" if key else "")
                    + ("down.click();" if largest else ""))
        main = dom[dom.index("<main>"):dom.index("</main>")]
        found = re.search(r'id="found">(.*?)<', dom)
        return re.findall(r"<b>(.*?)</b>", main), found and found.group(1), main

    look.path = path
    return look


def test_models_are_sorted_by_what_is_chosen(shown):
    assert shown()[0] == ["cow.obj", "cup.stl", "deep/bull &lt;/script&gt;.ply", "torn.ply"]
    assert shown(key="faces")[0] == ["torn.ply", "deep/bull &lt;/script&gt;.ply", "cow.obj", "cup.stl"]
    assert shown(key="parts", largest=True)[0] == [
        "deep/bull &lt;/script&gt;.ply", "cow.obj", "cup.stl", "torn.ply"]
    assert shown(key="loops", largest=True)[0][0] == "cup.stl"


def test_every_word_is_looked_for_in_names_reasons_and_notes(shown):
    assert shown("COW")[:2] == (["cow.obj", "cup.stl"], "2 of 4")
    assert shown("cow rim")[:2] == (["cup.stl"], "1 of 4")
    assert shown("unreadable")[:2] == (["torn.ply"], "1 of 4")
    assert shown("camel")[:2] == ([], "0 of 4")


def test_a_model_says_its_parts_faces_and_seconds(tmp_path):
    path = tmp_path / "index.html"
    path.write_text(page("1 model", [
        {"name": f"{seconds}.obj", "parts": parts, "faces": 5804, "loops": 0, "status": "done", "reason": "",
         "notes": [], "seconds": seconds, "image": "", "link": "x/"}
        for parts, seconds in ((1, 0.4832), (2, 1.2345), (3, 345.6789))
    ]), encoding="utf-8")
    dom = after(path, "")
    for words in ("1 part, 5,804 faces, 0.48&nbsp;s", "2 parts, 5,804 faces, 1.2&nbsp;s",
                  "3 parts, 5,804 faces, 346&nbsp;s"):
        assert f"<br>{words}<" in dom


def test_what_models_say_is_text_and_not_part_of_the_page(shown):
    names, _, main = shown("nothing")
    assert names == ["torn.ply"]
    assert "unreadable: There is no mesh in it: &lt;b&gt;nothing&lt;/b&gt;" in main


def test_a_long_reason_ends_with_a_whole_line(tmp_path):
    """It was cut through the middle of one."""
    path = tmp_path / "index.html"
    path.write_text(page("1 model", [{"name": "torn.ply", "status": "unreadable", "reason": "no mesh in it " * 20,
                                      "notes": [], "image": "", "link": ""}]), encoding="utf-8")
    dom = after(path, "const reason = document.querySelector('.reason'), style = getComputedStyle(reason);"
                      "document.title = reason.clientHeight < reason.scrollHeight ? "
                      "parseFloat(style.maxHeight) / parseFloat(style.lineHeight) : 'all';")
    assert float(re.search("<title>(.*?)</title>", dom).group(1)) == pytest.approx(7, abs=0.01)


@pytest.mark.parametrize(("hash", "found"), [("cow", "2 of 4"), ("COW%20rim", "1 of 4"), ("50%", "0 of 4")])
def test_words_in_the_address_are_looked_for_when_they_change(hash, found, shown):
    """An open page did not follow them, and a percent sign left an empty one."""
    dom = after(shown.path, f"location.hash = {hash!r}; dispatchEvent(new Event('hashchange'));")
    assert f'id="found">{found}<' in dom


def test_a_window_that_200_models_do_not_fill_has_more(tmp_path):
    """It could not be scrolled, and so never showed the others."""
    path = tmp_path / "index.html"
    path.write_text(page("500 models", [
        {"name": f"{number}.obj", "status": "refused", "reason": "", "notes": [], "image": "", "link": ""}
        for number in range(500)]), encoding="utf-8")
    assert in_browser(path, "--dump-dom", "--window-size=5120,5120").count("<figure") == 500
    assert in_browser(path, "--dump-dom", "--window-size=900,500").count("<figure") == 200


def test_a_picture_of_it_can_be_taken(shown):
    shot = shown.path.with_name("page.png")
    in_browser(shown.path, f"--screenshot={shot}", "--window-size=900,500")
    assert shot.read_bytes()[:8] == b"\x89PNG\r\n\x1a\n"

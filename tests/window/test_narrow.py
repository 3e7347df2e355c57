# SPDX-License-Identifier: GPL-3.0-or-later
"""The sidebar dragged narrow, in Blender's real window; narrow.py says how.

The pictures stay in out/narrow, to be looked at.
"""

import pytest

WIDTHS = ("160", "126")


@pytest.fixture(scope="module")
def seen(drive):
    """What the driver saw at each width."""
    return drive("narrow.py", "narrow")


@pytest.mark.parametrize("width", WIDTHS)
def test_no_words_of_a_button_are_cut_off(seen, width):
    found, step = seen[width]["found"], seen[width]["step"]
    asked = 0
    for name, words in seen[width]["words"].items():
        for shown, wide in found.items():
            # A button that is too narrow for its words has an icon in their place, in a row of its own.
            if f"{name}(" in shown and wide < seen[width]["room"] - step:
                assert wide + 0.5 * step >= words, shown
            asked += f"{name}(" in shown
    assert asked >= 9


@pytest.mark.parametrize("width", WIDTHS)
def test_every_button_is_there_down_to_those_below_the_list(seen, width):
    ends = [shown.partition("(")[0].rpartition(".")[2] for shown in seen[width]["found"]]
    assert ends.count("step_detail") == ends.count("isolate") == 2
    assert {"decompose", "clear", "detail", "show_graph", "n_parts", "merge", "split", "grow", "shrink", "frame",
            "tool_set_by_id", "cut", "slide", "paint", "select"} <= set(ends)


def test_eleven_parts_need_no_scrolling(seen):
    rows = [shown for shown in seen["160"]["found"] if shown.endswith(".color")]
    assert len(rows) == seen["parts"] == 11


def test_shares_are_shown_wherever_they_fit_beside_the_name(seen):
    """The bar that scrolls the list was kept free where there was none. A wider name would be cut off."""
    assert seen["shares"] == {"all": ["front piece", "front pieces"], "scrolled": []}


def test_the_list_loses_its_locks_first_and_then_its_ticks(seen):
    ends = {width: {shown.rpartition(".")[2] for shown in seen[width]["found"]} for width in WIDTHS}
    assert "selected" in ends["160"]
    assert "locked" not in ends["160"]
    assert not {"selected", "locked"} & ends["126"]


def test_the_name_has_most_of_a_row_of_the_list(seen):
    for width in WIDTHS:
        active = next(wide for shown, wide in seen[width]["found"].items() if shown.endswith(".active"))
        assert active >= 0.5 * seen[width]["room"]

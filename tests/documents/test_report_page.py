# SPDX-License-Identifier: GPL-3.0-or-later
"""The report on three small meshes: its table, and its page in a real browser, where buttons are clicked."""

import csv
import os
import re
import subprocess
import sys
from pathlib import Path

import pytest
import shapes
from browser import after, in_browser

ROOT = Path(__file__).resolve().parents[2]
METHODS = ["Berretti 2009", "Liu 2007"]


@pytest.fixture(scope="module")
def report(tmp_path_factory, write_data):
    folder = tmp_path_factory.mktemp("report")
    out = folder / "out"
    data = write_data(folder / "data", {1: shapes.dumbbell(), 22: shapes.torus(), 381: shapes.tube_tree(step=0.2)})
    run_report(data, out)
    return data, out


def run_report(data, out):
    variables = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}
    done = subprocess.run([sys.executable, str(ROOT / "benchmarks" / "report.py"), str(data), "--methods", *METHODS,
                           "--jobs", "1", "--out", str(out)],
                          env=variables, capture_output=True, text=True, check=False, timeout=300)
    assert done.returncode == 0, done.stderr


def order_after(page, *clicks):
    """Meshes of the rows from above, after buttons were clicked and methods chosen in the browser."""
    script = "".join(
        f"document.querySelector('[data-key={key}]').click();" if key else
        f"method.selectedIndex = {METHODS.index(name)}; method.dispatchEvent(new Event('change'));"
        for key, name in clicks)
    dom = after(page, script)
    pressed = re.findall(r'data-key="(\w+)" aria-pressed="true"', dom)
    return pressed, [int(number) for number in re.findall(r'<tr data-mesh="(\d+)"', dom)]


def rows_of(out):
    with (out / "report.csv").open(encoding="utf-8") as file:
        return list(csv.DictReader(file))


def test_the_table_has_a_row_for_each_mesh_and_method(report):
    _, out = report
    rows = rows_of(out)
    assert [(row["mesh"], row["method"]) for row in rows] == [(n, m) for n in ("1", "22", "381") for m in METHODS]
    bell = {row["method"]: row for row in rows if row["mesh"] == "1"}
    # Of three people two cut a dumbbell as it is cut in two at its neck; against the third half of all pairs differ.
    assert float(bell["Liu 2007"]["told_error"]) == pytest.approx(1 / 6, abs=0.01)
    assert [row["loops"] for row in rows if row["mesh"] == "22"] == ["1", "1"]
    assert all(0 <= float(row[name]) <= 1 for row in rows for name in ("error", "agreement", "miou", "told_hamming"))


def test_a_second_run_reads_what_the_first_has_found(report):
    data, out = report
    page, stamp = (out / "report.html").read_text(encoding="utf-8"), (out / "liu_2007" / "1.npy").stat().st_mtime_ns
    (out / "berretti_2009" / "22.json").unlink()
    run_report(data, out)
    assert (out / "liu_2007" / "1.npy").stat().st_mtime_ns == stamp
    assert (out / "berretti_2009" / "22.json").is_file()
    without_seconds = [re.sub(r"<h2>Seconds.*?</svg>|<td[^>]*>[\d.]+</td>", "", text, flags=re.S)
                       for text in (page, (out / "report.html").read_text(encoding="utf-8"))]
    assert without_seconds[0] == without_seconds[1]


def test_the_page_is_sorted_in_the_browser(report):
    page, rows = report[1] / "report.html", rows_of(report[1])
    assert order_after(page) == (["category"], [22, 381, 1])  # cup, four legs, human

    def by(name, method, worst):
        mine = [row for row in rows if row["method"] == method]
        return [int(row["mesh"]) for row in sorted(mine, key=lambda row: worst * float(row[name]))]

    assert order_after(page, ("error", "")) == (["error"], by("error", METHODS[0], -1))
    assert order_after(page, ("error", ""), ("", METHODS[1])) == (["error"], by("error", METHODS[1], -1))
    assert order_after(page, ("", METHODS[1]), ("agreement", "")) == (["agreement"], by("agreement", METHODS[1], 1))
    assert order_after(page, ("error", ""), ("category", ""))[1] == [22, 381, 1]


def test_the_page_looks_as_it_should(report):
    page = report[1] / "report.html"
    text = page.read_text(encoding="utf-8")
    assert not re.search(r'(src|href)="(?!data:|#)', text)  # it needs no other file
    assert text.count("<img ") == 3 * (1 + len(METHODS))
    shot = page.with_name("page.png")
    in_browser(page, f"--screenshot={shot}", "--window-size=1200,2600")
    assert shot.read_bytes()[:8] == b"\x89PNG\r\n\x1a\n"
    assert shot.stat().st_size > 50_000  # tables, plots and pictures; an empty page has some 5,000 bytes

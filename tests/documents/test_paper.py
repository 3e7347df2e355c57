# SPDX-License-Identifier: GPL-3.0-or-later
"""The comparison with the paper, on a small mesh in place of each category."""

import os
import re
import subprocess
import sys
from pathlib import Path

import shapes

ROOT = Path(__file__).resolve().parents[2]
FIRST = (1, 21, 41, 61, 81, 121, 141, 181, 201, 221, 281, 301, 321, 361, 381)  # mesh of each category of the half


def test_the_page_has_every_table_and_a_number_in_every_cell(tmp_path, write_data):
    data = write_data(tmp_path / "data", dict.fromkeys(FIRST, shapes.tube_tree(step=0.3)))
    page = tmp_path / "comparison.md"
    variables = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}
    done = subprocess.run([sys.executable, str(ROOT / "benchmarks" / "paper.py"), str(data), "--jobs", "1",
                           "--report", str(tmp_path / "report"), "--page", str(page)],
                          env=variables, capture_output=True, text=True, check=False, timeout=300)
    assert done.returncode == 0, done.stderr
    made, shipped = page.read_text(encoding="utf-8"), (ROOT / "docs" / "comparison.md").read_text(encoding="utf-8")
    assert headings(made) == headings(shipped)
    assert "nan" not in made
    figures = (tmp_path / "images" / "comparison").glob("*.svg")
    assert {path.name for path in figures} == set(re.findall(r"images/comparison/(\S+?)\)", shipped))


def headings(text):
    """Titles, and the heads of tables."""
    return re.findall(r"^#.*|^\|.*(?=\n\| ---)", text, re.MULTILINE)

# SPDX-License-Identifier: GPL-3.0-or-later
"""The example in docs/ runs from top to bottom and gives what it shows."""

import re
from pathlib import Path

import nbformat
from nbclient import NotebookClient

DOCS = Path(__file__).resolve().parents[2] / "docs"


def outputs(notebook):
    """The kinds of what each cell gives."""
    return [sorted(output["data"]) for cell in notebook.cells for output in cell.get("outputs", ())]


def texts(notebook):
    """What each cell gives as a text; of long numbers nine digits, as the last ones depend on the processor."""
    return [re.sub(r"\d+\.\d{9,}", lambda number: f"{float(number[0]):.9f}", output["data"].get("text/plain", ""))
            for cell in notebook.cells for output in cell.get("outputs", ())]


def test_the_example_runs_and_shows_what_it_says():
    notebook = nbformat.read(DOCS / "example.ipynb", as_version=4)
    shown, said = outputs(notebook), texts(notebook)
    NotebookClient(notebook, timeout=300, kernel_name="python3", resources={"metadata": {"path": str(DOCS)}}).execute()
    assert outputs(notebook) == shown
    assert texts(notebook) == said
    assert ["image/png", "text/plain"] in shown
    # A model of three times the size has the same parts.
    (same,) = (cell for cell in notebook.cells if "again = " in cell.source)
    assert same.outputs[0]["data"]["text/plain"] == "True"

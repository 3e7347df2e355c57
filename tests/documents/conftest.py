# SPDX-License-Identifier: GPL-3.0-or-later
"""The page of a report is looked at in a browser, see browser.py; what benchmarks measure is made of small meshes."""

import numpy as np
import pytest
from browser import BROWSER

collect_ignore = [] if BROWSER else ["test_report_page.py"]


def pytest_report_header() -> str:
    """Say whether the page is looked at."""
    return f"browser: {BROWSER}" if BROWSER else "NOT RUN: test_report_page.py, there is no Chromium (set BROWSER=)"


@pytest.fixture(scope="session")
def write_data():
    """Writes shapes by number into a folder as the benchmark's meshes, as three people see them."""
    def write(folder, made):
        folder.mkdir()
        for number, shape in made.items():
            np.savez(folder / f"{number}.npz", vertices=shape.vertices, faces=shape.faces,
                     human=people_of(shape.vertices[shape.faces].mean(axis=1)))
        return folder

    return write


def people_of(center):
    """Three people: upper and lower, the same, and left and right."""
    upper = center[:, 2] > np.median(center[:, 2])
    return np.stack([upper, upper, center[:, 0] > np.median(center[:, 0])]).astype(np.uint8)

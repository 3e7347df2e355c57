# SPDX-License-Identifier: GPL-3.0-or-later
"""The page of a report is looked at in a browser, see browser.py."""

from browser import BROWSER

collect_ignore = [] if BROWSER else ["test_report_page.py"]


def pytest_report_header() -> str:
    """Say whether the page is looked at."""
    return f"browser: {BROWSER}" if BROWSER else "NOT RUN: test_report_page.py, there is no Chromium (set BROWSER=)"

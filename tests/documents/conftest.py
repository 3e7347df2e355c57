# SPDX-License-Identifier: GPL-3.0-or-later
"""The page of a report is looked at in a browser, the one that BROWSER names or a Chromium on the PATH."""

import os
import shutil

BROWSER = os.environ.get("BROWSER") or shutil.which("chromium")
# ./test brings the browser where it can, says so where it cannot, and counts a skipped test as a failure.
collect_ignore = [] if BROWSER else ["test_report_page.py"]


def pytest_report_header() -> str:
    """Say whether the page is looked at."""
    return f"browser: {BROWSER}" if BROWSER else "NOT RUN: test_report_page.py, there is no Chromium (set BROWSER=)"

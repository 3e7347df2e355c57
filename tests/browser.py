# SPDX-License-Identifier: GPL-3.0-or-later
"""Pages in a real browser: the one that BROWSER names, or a Chromium on the PATH."""

import os
import shutil
import subprocess

# ./test brings it where it can, says so where it cannot, and counts a skipped test as a failure.
BROWSER = os.environ.get("BROWSER") or shutil.which("chromium")


def in_browser(page, *options):
    """What the browser gives for a page; page : Path."""
    assert BROWSER is not None
    return subprocess.run([BROWSER, "--headless", "--no-sandbox", "--disable-gpu", "--hide-scrollbars", *options,
                           page.as_uri()], capture_output=True, text=True, check=True, timeout=120).stdout


def after(page, script):
    """The HTML of a page after a script has run in it, which clicks and types."""
    changed = page.with_name("changed.html")
    changed.write_text(page.read_text(encoding="utf-8").replace("</body>", f"<script>{script}</script></body>"),
                       encoding="utf-8")
    return in_browser(changed, "--dump-dom")

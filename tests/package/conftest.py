# SPDX-License-Identifier: GPL-3.0-or-later
"""The package as its users have it: a wheel, built from the checkout and installed into a folder of its own."""

import importlib
import os
import signal
import subprocess
import sys
from pathlib import Path

import pytest
from browser import BROWSER

ROOT = Path(__file__).resolve().parents[2]
# One thread per process: NumPy's own would get in each other's way.
os.environ.update(OMP_NUM_THREADS="1", OPENBLAS_NUM_THREADS="1")
# What runs in the background of a script ignores Ctrl+C, and so would all that it starts.
signal.signal(signal.SIGINT, signal.default_int_handler)
BLENDER = os.environ.get("BLENDER")
# ./test says so where there is no Blender or no browser, and counts a skipped test as a failure.
collect_ignore = [*([] if BLENDER else ["test_blender.py"]), *([] if BROWSER else ["test_page.py"])]


def pytest_configure(config):
    """Build and install once, before anything imports the package."""
    import tempfile

    config.site = tempfile.TemporaryDirectory(prefix="reeb_parts_site_")
    pip = [sys.executable, "-m", "pip", "--disable-pip-version-check", "--quiet"]
    built = Path(config.site.name) / "wheel"
    subprocess.run([*pip, "wheel", "--no-deps", "--no-build-isolation", "--wheel-dir", built, ROOT], check=True)
    (wheel,) = built.glob("*.whl")
    site = Path(config.site.name) / "site"
    subprocess.run([*pip, "install", "--no-deps", "--target", site, wheel], check=True)
    sys.path.insert(0, str(site))
    # Processes that tests start have it, too.
    os.environ["PYTHONPATH"] = str(site)
    importlib.invalidate_caches()
    config.wheel, config.command = wheel, site / "bin" / "reeb-parts"


def pytest_unconfigure(config):
    config.site.cleanup()


@pytest.fixture(scope="session")
def wheel(request):
    """The built wheel."""
    return request.config.wheel


@pytest.fixture(scope="session")
def reeb_parts_command(request):
    """Runs the installed command, in a process of its own, with some arguments."""

    def run(*arguments, **options):
        return subprocess.run([sys.executable, request.config.command, *map(str, arguments)], capture_output=True,
                              text=True, check=False, timeout=300, stdin=subprocess.DEVNULL, **options)

    return run


@pytest.fixture(scope="session")
def tree():
    """A small mesh with four branches."""
    import shapes

    return shapes.tube_tree(step=0.2)

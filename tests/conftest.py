# SPDX-License-Identifier: GPL-3.0-or-later
"""What all tests share: where time is short, half of the cases of a long table are tried, see diagonal.py.

And Blender, which is imported after this, has a settings folder of its own. In that of the user it unpacks the
libraries of extensions, and removes those of others: two runs at a time would take SciPy from each other, and from the
extension that the user has installed.
"""

import os
import tempfile

import pytest
from diagonal import in_tables

_SETTINGS = tempfile.TemporaryDirectory(prefix="reeb_parts_settings_")
os.environ.setdefault("BLENDER_USER_RESOURCES", _SETTINGS.name)


@pytest.hookimpl(tryfirst=True)  # a table is long or not whatever else is left out of it
def pytest_collection_modifyitems(config, items):
    """Leave out what is not asked for of long tables."""
    tried = in_tables([item.nodeid for item in items])
    config.hook.pytest_deselected(items=[item for item in items if item.nodeid not in tried])
    items[:] = [item for item in items if item.nodeid in tried]


def pytest_unconfigure(config):
    """Before tests/blender ends at once."""
    _SETTINGS.cleanup()

# SPDX-License-Identifier: GPL-3.0-or-later
"""What all tests share: where time is short, half of the cases of a long table are tried, see diagonal.py."""

import pytest
from diagonal import in_tables


@pytest.hookimpl(tryfirst=True)  # a table is long or not whatever else is left out of it
def pytest_collection_modifyitems(config, items):
    """Leave out what is not asked for of long tables."""
    tried = in_tables([item.nodeid for item in items])
    config.hook.pytest_deselected(items=[item for item in items if item.nodeid not in tried])
    items[:] = [item for item in items if item.nodeid in tried]

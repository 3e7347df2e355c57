# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests of what not every system has; see tools/windows.py for those that run on Windows."""

import os

import pytest

#: Signals, links, devices, and names that are bytes.
unix = pytest.mark.skipif(os.name != "posix", reason="Windows has no such thing")

# SPDX-License-Identifier: GPL-3.0-or-later
"""The fixtures of the operator tests, and how they end."""

from blender.conftest import (  # noqa: F401
    make,
    obj,
    package,
    pytest_sessionfinish,
    pytest_unconfigure,
    scene,
    tree,
)

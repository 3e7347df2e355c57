# SPDX-License-Identifier: GPL-3.0-or-later
"""What is drawn over the model and pointed at in the 3D viewport."""

from __future__ import annotations

from . import brush, follow_active, graph_overlay, highlight

MODULES = (brush, follow_active, highlight, graph_overlay)


def register() -> None:
    for module in MODULES:
        module.register()


def unregister() -> None:
    for module in reversed(MODULES):
        module.unregister()

# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs without a window: the command ``blender --command reeb_parts``."""

from __future__ import annotations

_handles: list[object] = []


def register() -> None:
    import bpy

    from . import command

    _handles.append(bpy.utils.register_cli_command("reeb_parts", command.main))


def unregister() -> None:
    import bpy

    while _handles:
        bpy.utils.unregister_cli_command(_handles.pop())

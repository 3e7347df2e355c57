# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs without a window: the command ``blender --command reeb_parts``."""

_handles = []


def register():
    import bpy

    from . import command

    _handles.append(bpy.utils.register_cli_command("reeb_parts", command.main))


def unregister():
    import bpy

    while _handles:
        bpy.utils.unregister_cli_command(_handles.pop())

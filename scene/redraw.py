# SPDX-License-Identifier: GPL-3.0-or-later
"""Let windows draw again what has changed, without waiting for the pointer."""

from __future__ import annotations

from collections.abc import Iterator

import bpy


def _viewports() -> Iterator[bpy.types.Area]:
    """The 3D viewports of all windows."""
    for window in bpy.context.window_manager.windows:
        yield from (area for area in window.screen.areas if area.type == "VIEW_3D")


def view_spaces() -> Iterator[bpy.types.SpaceView3D]:
    """What the 3D viewports of all windows show."""
    yield from (area.spaces.active for area in _viewports())


def viewports() -> None:
    """Draw all 3D viewports again, with their sidebars."""
    for area in _viewports():
        area.tag_redraw()


def clear_status() -> None:
    """Let the status bar be Blender's again, in all workspaces: there may be another one now than at the start."""
    for workspace in bpy.data.workspaces:
        workspace.status_text_set(None)


def sidebars() -> None:
    """Draw the sidebars of all 3D viewports again, and not the views, which may take long."""
    for area in _viewports():
        for region in area.regions:
            if region.type == "UI":
                region.tag_redraw()

# SPDX-License-Identifier: GPL-3.0-or-later
"""Let windows draw again what has changed, without waiting for the pointer."""

from __future__ import annotations

from collections.abc import Iterator

import bpy


def viewports_of(window: bpy.types.Window) -> list[bpy.types.Area]:
    """The 3D viewports of a window."""
    return [area for area in window.screen.areas if area.type == "VIEW_3D"]


def _viewports() -> Iterator[bpy.types.Area]:
    """The 3D viewports of all windows."""
    for window in bpy.context.window_manager.windows:
        yield from viewports_of(window)


def view_spaces() -> Iterator[bpy.types.SpaceView3D]:
    """What the 3D viewports of all windows show."""
    yield from (area.spaces.active for area in _viewports())


def viewports() -> None:
    """Draw all 3D viewports again, with their sidebars."""
    for area in _viewports():
        area.tag_redraw()


def show_status(text: str | None) -> None:
    """Say something in the status bar of all workspaces; None lets it be Blender's again.

    Another one may be shown by now than at the start. Blender's timers have none.
    """
    here, windows = bpy.context.window, bpy.context.window_manager.windows[:]
    if here is not None and here not in windows:  # it is being closed, which an override would have Blender forget
        bpy.context.workspace.status_text_set(text)
        return
    for window in windows:
        with bpy.context.temp_override(window=window):
            for workspace in bpy.data.workspaces:
                # Of whichever workspace it is called, Blender sets the text of the one in the context, and draws the
                # window there. Overridden together with the window, the workspace would be the window's.
                with bpy.context.temp_override(workspace=workspace):
                    workspace.status_text_set(text)


def sidebars() -> None:
    """Draw the sidebars of all 3D viewports again, and not the views, which may take long."""
    for area in _viewports():
        for region in area.regions:
            if region.type == "UI":
                region.tag_redraw()

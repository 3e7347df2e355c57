# SPDX-License-Identifier: GPL-3.0-or-later
"""The picture of how to install, for the README: the menu with "Install from Disk", and what it has installed.

Taken like those of driver.py, in a window of 1100x560.
"""

import bpy


def steps():
    """Make the whole window the preferences; open the menu, then the entry of the extension."""
    window = bpy.context.window
    area = next(area for area in window.screen.areas if area.type == "VIEW_3D")
    with bpy.context.temp_override(area=area):
        bpy.ops.screen.screen_full_area()
    yield 0.5
    preferences = bpy.context.preferences
    preferences.active_section = "ADDONS"
    window.screen.areas[0].type = "PREFERENCES"
    bpy.context.window_manager.addon_search = "Reeb"
    yield 1.0
    yield from press(188, 108)
    yield from press(window.width - 19, 72)
    shot("install.png")


def press(x, y):
    """A click that a button notices."""
    move(x, y)
    yield 0.3
    click(x, y)
    yield 1.0

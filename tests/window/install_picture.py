# SPDX-License-Identifier: GPL-3.0-or-later
"""The picture of how to install, for the README: the menu with "Install from Disk", and what it has installed.

Taken like those of driver.py, in a window of 1100x560.
"""

import os
import sys

import bpy

sys.path.append(os.path.dirname(__file__))
import pointer


def steps():
    """Make the whole window the preferences; open the menu, then the entry of the extension."""
    window = bpy.context.window
    with bpy.context.temp_override(area=pointer.view_area()):
        bpy.ops.screen.screen_full_area()
    yield 0.5
    preferences = bpy.context.preferences
    preferences.active_section = "ADDONS"
    window.screen.areas[0].type = "PREFERENCES"
    bpy.context.window_manager.addon_search = "Reeb"
    yield 1.0
    yield from pointer.press(188, 108)
    yield 0.8
    yield from pointer.press(window.width - 19, 72)
    yield 0.8
    pointer.shot("install.png", (0, 58, window.width, 261))  # without the menus above and the path below

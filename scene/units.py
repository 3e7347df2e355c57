# SPDX-License-Identifier: GPL-3.0-or-later
"""Lengths of the scene in millimeters."""

import bpy


def millimeters() -> float:
    """Length of a unit of the scene in millimeters; 1 in scenes without units."""
    units = bpy.context.scene.unit_settings
    return 1.0 if units.system == "NONE" else 1000.0 * units.scale_length

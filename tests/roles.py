# SPDX-License-Identifier: GPL-3.0-or-later
"""Objects that were made of parts, by what they are for."""

import bpy


def with_role(role):
    """All objects of a role, such as "node"."""
    return [item for item in bpy.data.objects if item.get("reeb_parts_role") == role]


def the_rig():
    """The one armature that was made."""
    (rig,) = with_role("armature")
    return rig

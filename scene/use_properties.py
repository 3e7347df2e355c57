# SPDX-License-Identifier: GPL-3.0-or-later
"""Settings of what is made from parts; and, on the object, what was made."""

import bpy
from bpy.props import BoolProperty, EnumProperty, FloatProperty, PointerProperty


class WhichProperties:
    """All parts or some; for operators and property groups to inherit."""

    which: EnumProperty(
        name="Parts", default="ALL",
        items=[("ALL", "All", "All parts of the mesh"),
               ("CHOSEN", "Chosen", "The parts ticked in the list, or else the active one")],
        description="Which parts to use",
    )


class SeparateProperties(WhichProperties):
    """How parts become objects; for operators and property groups to inherit."""

    caps: BoolProperty(
        name="Close holes", default=False,
        description="Close the holes where parts were joined, so that each piece is closed; borders that "
        "the mesh had before stay open. The faces are marked by the attribute reeb_cap",
    )
    center: BoolProperty(
        name="Origin in the middle", default=True,
        description="Put the origin of each piece to the middle of its surface; without it, all keep the "
        "origin of the object",
    )
    modifiers: BoolProperty(
        name="Keep modifiers", default=True,
        description="Copy the object's modifiers to each piece",
    )
    parent: BoolProperty(
        name="Parent to original", default=False,
        description="Make the pieces children of the object, so that they follow it; without it, they have "
        "the parent that the object has",
    )
    hide: BoolProperty(
        name="Hide original", default=True,
        description="Hide the object, which stays as it is, in the viewport and in renders",
    )


class ReebPartsUse(bpy.types.PropertyGroup, SeparateProperties):
    """What the buttons under Use Parts will do; on the scene."""


def _explode(self, context):
    from . import explode

    explode.changed(self, context)


class ReebPartsMade(bpy.types.PropertyGroup):
    """What was made from an object's parts; on the object."""

    pieces: PointerProperty(type=bpy.types.Collection, description="Where the separated parts are")
    explode: FloatProperty(
        name="Explode", default=0.0, min=0.0, soft_max=2.0, step=1, update=_explode,
        description="How far the parts drift apart, as a multiple of their distance from the middle. Only "
        "looks so: at 0 the mesh is as it was. Can be animated",
    )


CLASSES = (ReebPartsUse, ReebPartsMade)


def register():
    for cls in CLASSES:
        bpy.utils.register_class(cls)
    bpy.types.Scene.reeb_parts_use = PointerProperty(type=ReebPartsUse)
    bpy.types.Object.reeb_parts_made = PointerProperty(type=ReebPartsMade)


def unregister():
    del bpy.types.Object.reeb_parts_made
    del bpy.types.Scene.reeb_parts_use
    for cls in reversed(CLASSES):
        bpy.utils.unregister_class(cls)

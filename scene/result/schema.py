# SPDX-License-Identifier: GPL-3.0-or-later
"""What is stored in the file: settings on the scene, the result on its mesh, what was made of it on the object.

The names of the properties and of the pointers to them are those of files that exist: they never change.

What does something when it is set has ``options=set()``: it cannot be animated, as a frame that is shown sets nothing.
"""

from typing import Any

import bpy
from bpy.props import (
    BoolProperty,
    CollectionProperty,
    EnumProperty,
    FloatProperty,
    FloatVectorProperty,
    IntProperty,
    PointerProperty,
    StringProperty,
)

from ..changes import reactions, undo_steps
from ..changes.settled import Settled
from ..properties import JOINTS
from ..settings import ReebPartsSettings, ReebPartsUse
from ..showing import explode
from . import part_list, part_names


class ReebPart(bpy.types.PropertyGroup):
    """A part as the list shows it."""

    name: StringProperty(
        name="Name", update=reactions.rename, options=set(),  # Blender 4 would cut it off in the midst of a letter
        description="Name of the part and of its vertex group; double click to change it",
    )
    number: IntProperty(name="Number", description="What the part is known by; the value of reeb_part")
    color: FloatVectorProperty(
        name="Color", subtype="COLOR_GAMMA", size=3, min=0.0, max=1.0, update=reactions.recolor,
        options=set(), default=part_names.NO_COLOR,
        description="Color of the part; one that you choose stays with it",
    )
    share: FloatProperty(name="Share", subtype="FACTOR", description="Share of the surface's area")
    is_ground: BoolProperty()  # a floor, or what else the rest was decomposed without
    middle: FloatVectorProperty(size=3)  # of its surface, in the coordinates of the mesh
    own_name: StringProperty(description="The name of the part until the user gives it another")
    locked: BoolProperty(
        name="Locked", update=reactions.lock, options=set(),
        description="The part stays as it is, whatever the detail and whatever is done to its neighbors",
    )
    pinned: BoolProperty(name="Pinned", description="The part was changed by hand and stays whatever the detail")
    only_locked: BoolProperty(description="The part is pinned by its lock alone, and was not changed by hand")
    selected: BoolProperty(
        name="Selected", update=lambda _, context: undo_steps.keep_all(context), options=set(),
        description="Included in what is done to the chosen parts",
    )
    group: StringProperty(description="The vertex group made for the part")
    material: PointerProperty(type=bpy.types.Material, description="The material made for the part")


class ReebName(bpy.types.PropertyGroup):
    """A name or a color that the user gave to a part, kept while the part is not shown."""

    name: StringProperty(description="Empty: the part's own")
    given: BoolProperty()  # the name was suggested, or came with that of the mirror image; nobody typed it
    number: IntProperty()
    has_color: BoolProperty()
    color: FloatVectorProperty(subtype="COLOR_GAMMA", size=3)


class ReebSlot(bpy.types.PropertyGroup):
    """A material slot of the user, from before the parts had materials."""

    material: PointerProperty(type=bpy.types.Material)


class ReebPartsResult(bpy.types.PropertyGroup, Settled):
    """A decomposition and what was written of it; on the mesh."""

    # The result itself
    data: StringProperty(subtype="BYTE_STRING")
    numbers: StringProperty(subtype="BYTE_STRING")
    fingerprint: StringProperty()
    stretch: FloatVectorProperty(size=9)
    object_name: StringProperty()

    # What the panel shows of it
    seconds: FloatProperty()
    n_nodes: IntProperty()
    n_arcs: IntProperty()
    n_loops: IntProperty()
    n_vertices: IntProperty()
    n_faces: IntProperty()
    notes: StringProperty()
    note_words: StringProperty()
    edited: BoolProperty(description="The mesh was edited since")

    # What can be changed
    detail: FloatProperty(
        name="Detail", min=0.0, max=1.0, default=0.5, subtype="FACTOR", update=reactions.show_detail,
        options=set(),
        description="How readily the surface is cut: 0 gives as few parts as possible, 1 every candidate. "
        "Nothing is computed again",
    )
    n_parts: IntProperty(
        name="Number of Parts", min=1, update=reactions.show_number, options=set(),
        description="Exactly this many parts, whatever the detail. Nothing is computed again",
    )
    by_number: BoolProperty(description="The number of parts decides, not the detail")
    asked: IntProperty()  # the number of parts that was asked for and cannot be had; 0 for none
    fewest: IntProperty()  # parts that there can be, once a number was asked for
    most: IntProperty()
    parts: CollectionProperty(type=ReebPart)
    active: IntProperty(name="Active Part", update=part_list.on_list_click, options=set())
    names: CollectionProperty(type=ReebName)

    # What was written, under which name, and what was there before
    face_attribute: StringProperty()
    color_attribute: StringProperty()
    palette: StringProperty()
    color_places: StringProperty()
    field_attribute: StringProperty()
    has_groups: BoolProperty()
    has_face_sets: BoolProperty()
    has_materials: BoolProperty()
    has_seams: BoolProperty()
    by_button: StringProperty()  # names of outputs that their buttons have switched on, with spaces between
    former_color: StringProperty()
    former_render_color: StringProperty()
    had_face_sets: BoolProperty()
    had_material_index: BoolProperty()
    former_slots: CollectionProperty(type=ReebSlot)
    had_seams: BoolProperty()

    def watched(self) -> dict[str, Any]:
        return {"detail": self.detail, "n_parts": self.n_parts, "by_number": self.by_number, "active": self.active,
                "parts": [{"name": part.name, "color": part.color[:], "locked": part.locked} for part in self.parts]}


class ReebCut(bpy.types.PropertyGroup):
    """A cut between two parts that were separated, and what joins the pieces there; see cut_list."""

    low: IntProperty()  # numbers of the two parts
    high: IntProperty()
    place: IntProperty()  # among the cuts between these
    joint: EnumProperty(
        name="Joint", default="ALL", items=[("ALL", "As All", "What Joints says"), *JOINTS],
        translation_context="Reeb Parts",
        description="What joins these two pieces when the parts are separated the next time",
    )
    count: IntProperty()  # of joints
    width: FloatProperty()  # of these, in millimeters
    why: StringProperty()  # there are none, see joints.CutJoints


class ReebPartsMade(bpy.types.PropertyGroup, Settled):
    """What was made from an object's parts; on the object."""

    cuts: CollectionProperty(type=ReebCut)
    cut: IntProperty(options=set())  # the active one

    # Of what is hidden while something of ours is shown in its place: 1 if it was rendered before, 0 if not.
    rendered: IntProperty(default=-1, options=set())
    pieces: PointerProperty(type=bpy.types.Collection, description="Where the separated parts are")
    key: StringProperty()  # what pieces know the object by, wherever they are, see pieces.origins
    explode: FloatProperty(
        name="Explode", default=0.0, min=0.0, soft_max=2.0, step=1, update=explode.changed,
        description="How far the parts drift apart, as a multiple of their distance from the middle. Only "
        "looks so: at 0 the mesh is as it was. Can be animated",
    )

    settled: StringProperty(default='{"explode": 0.0}', options={"HIDDEN"})  # before the slider is first moved

    def watched(self) -> dict[str, Any]:
        return {"explode": self.explode}


CLASSES = (ReebPartsSettings, ReebPartsUse, ReebPart, ReebName, ReebSlot, ReebPartsResult, ReebCut, ReebPartsMade)
POINTERS = (
    (bpy.types.Scene, "reeb_parts", ReebPartsSettings),
    (bpy.types.Scene, "reeb_parts_use", ReebPartsUse),
    (bpy.types.Mesh, "reeb_parts", ReebPartsResult),
    (bpy.types.Object, "reeb_parts_made", ReebPartsMade),
)

_register_classes, _unregister_classes = bpy.utils.register_classes_factory(CLASSES)


def register() -> None:
    _register_classes()
    for owner, name, cls in POINTERS:
        setattr(owner, name, PointerProperty(type=cls))


def unregister() -> None:
    for owner, name, _ in reversed(POINTERS):
        delattr(owner, name)
    _unregister_classes()

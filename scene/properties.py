# SPDX-License-Identifier: GPL-3.0-or-later
"""What a run, and what is made of its parts, can be told: classes for operators and property groups to inherit.

The properties of the method are made from the fields of ``Parameters``: names, defaults, ranges and tooltips
are written down once.
"""

from collections.abc import Iterable
from dataclasses import Field, asdict, fields
from typing import Any

import bpy
from bpy.props import BoolProperty, EnumProperty, FloatProperty, FloatVectorProperty, IntProperty

from ..core.parameters import Parameters
from ..core.uses.colors import LABELS, PALETTES
from .reading import face_hints


def _property(field: Field) -> Any:
    """The Blender property of a field of Parameters."""
    meta = field.metadata
    words = {"name": meta["label"], "description": meta["description"], "default": field.default}
    if "choices" in meta:
        items = [(choice, choice.title(), "") for choice in meta["choices"]]
        return EnumProperty(items=items, translation_context="Reeb Parts", **words)  # to Blender, Separate is a verb
    if "range" not in meta:
        return BoolProperty(**words)
    low, high = meta["range"]
    if field.type == "int":
        return IntProperty(min=low, max=high, **words)
    # Enough digits to tell 0.005 from 0.0055.
    return FloatProperty(min=low, max=high, precision=4 if low and low < 0.01 else 3, step=1, **words)


class ParameterProperties:
    """One property for each field of Parameters."""

    __annotations__ = {field.name: _property(field) for field in fields(Parameters)}

    def parameters(self) -> Parameters:
        """The values as Parameters; raises ParameterError."""
        values = {field.name: getattr(self, field.name) for field in fields(Parameters)}
        for name, value in values.items():
            if isinstance(value, float):
                # Blender stores 0.05 as 0.05000000074505806.
                values[name] = float(f"{value:.6g}")
        return Parameters(**values)

    def use_parameters(self, parameters: Parameters) -> None:
        """Take over all values of a Parameters."""
        for name, value in asdict(parameters).items():
            setattr(self, name, value)


PARAMETERS = tuple(ParameterProperties.__annotations__)


def fill_in(operator: bpy.types.Operator, source: Any, names: Iterable[str]) -> None:
    """Give an operator what a source, such as the panel, has for those properties that its caller left out."""
    for name in names:
        if not operator.properties.is_property_set(name):
            setattr(operator, name, getattr(source, name))


class HintProperties:
    """What is read of the mesh besides its shape."""

    hints: EnumProperty(
        name="Hints", default=face_hints.NONE,
        items=[(kind, label, text) for kind, (label, text, _) in face_hints.KINDS.items()],
        description="What you have marked on the mesh yourself that parts should follow, besides its shape",
    )


HINTS = tuple(HintProperties.__annotations__)


class OutputProperties:
    """What is written to the object."""

    vertex_groups: BoolProperty(
        name="Vertex Groups", default=True,
        description="A vertex group for each part; vertices on a cut belong to every part that meets there",
    )
    face_attribute: BoolProperty(
        name="Face Attribute", default=True,
        description="The number of each face's part as the attribute reeb_part, for Geometry Nodes",
    )
    colors: BoolProperty(
        name="Colors", default=True,
        description="The parts' colors as the active color attribute Reeb Parts",
    )
    palette: EnumProperty(
        name="Palette", items=[(name, LABELS.get(name, name), "") for name in PALETTES],
        description="What the parts' colors are chosen from. A color that you give to a part in the list "
        "stays the part's own",
    )
    face_sets: BoolProperty(
        name="Face Sets", default=False,
        description="A face set for each part, for Sculpt Mode; Clear brings your own back",
    )
    materials: BoolProperty(
        name="Materials", default=False,
        description="A material for each part; Clear brings your own back",
    )
    seams: BoolProperty(
        name="Seams along Cuts", default=False,
        description="UV seams where parts meet, beside your own; Clear removes only these",
    )
    field: BoolProperty(
        name="Distance Field", default=False,
        description="The normalized average geodesic distance that the parts come from, as the vertex "
        "attribute reeb_agd: 0 in the middle of the body, 1 at the farthest tip",
    )
    graph: BoolProperty(
        name="Graph", default=True,
        description="The Reeb graph as objects: an empty for each node, a curve for the arcs",
    )


OUTPUTS = tuple(OutputProperties.__annotations__)


class OverlayProperties:
    """How the graph is drawn."""

    node_size: FloatProperty(
        name="Node Size", default=0.005, min=0.001, max=0.5, precision=3, step=0.1, options=set(),
        description="Size of the empties, as a share of the object's",
    )
    line_thickness: FloatProperty(
        name="Line Thickness", default=0.0, min=0.0, max=1.0, precision=3, step=1, options=set(),
        description="Thickness of the curve under the lines, as a share of the radius of the body around it",
    )
    in_front: BoolProperty(
        name="In Front", default=True, options=set(),
        description="Draw the graph over the model instead of hidden inside it",
    )


OVERLAY = tuple(OverlayProperties.__annotations__)


class WhichProperties:
    """All parts or some."""

    which: EnumProperty(
        name="Parts", default="ALL",
        items=[("ALL", "All", "All parts of the mesh"),
               ("CHOSEN", "Chosen", "The parts marked in the list, or else the active one")],
        description="Which parts to use",
    )


#: What can join two pieces.
JOINTS = (
    ("NONE", "None", "No joints; Close Holes decides whether pieces are closed"),
    ("ROUND", "Round Pegs", "The smaller piece has a round peg, the other a hole for it"),
    ("SQUARE", "Square Pegs", "Pegs that do not turn in their holes"),
    ("KEY", "Keys", "Pegs like the tail of a dove, which fit into their holes one way round only"),
    ("DOWEL", "Dowels", "Both pieces have a hole, and a loose dowel goes into both"),
    ("MAGNET", "Magnets", "Both pieces have a round hole for a magnet, as deep as Depth says"),
)


class JointProperties:
    """How pieces are joined."""

    joints: EnumProperty(
        name="Joints", default="NONE", items=JOINTS, translation_context="Reeb Parts",  # to Blender, of a skeleton
        description="What joins the pieces when they are printed, along the axis of each cut; holes are closed then. "
        "A cut without room for it stays without",
    )
    joint_count: IntProperty(
        name="Per Cut", default=1, min=1, max=3,
        description="How many joints a cut gets where there is room for them; two or more keep pieces from turning",
    )
    joint_size: FloatProperty(
        name="Width (mm)", default=0.0, min=0.0, max=1000.0, precision=2, step=10,
        description="Width of the joints in millimeters; 0 for a third of each cut's. Where there is no room, they are "
        "smaller",
    )
    joint_depth: FloatProperty(
        name="Depth (mm)", default=0.0, min=0.0, max=1000.0, precision=2, step=10,
        description="How deep joints go into a piece, in millimeters; 0 for what suits their width",
    )
    joint_clearance: FloatProperty(
        name="Clearance (mm)", default=0.15, min=0.0, max=10.0, precision=3, step=1,
        description="Gap between a joint and its hole all around, in millimeters",
    )
    joint_wall: FloatProperty(
        name="Wall (mm)", default=1.2, min=0.0, max=100.0, precision=2, step=10,
        description="The least thickness of what remains around a joint, in millimeters; at least a third of its "
        "radius",
    )


def closes_holes(style: Any) -> bool:
    """Whether the holes of pieces are closed. style : has the values of SeparateProperties."""
    return style.caps or style.fit_bed or style.joints != "NONE"


class SeparateProperties(WhichProperties, JointProperties):
    """How parts become objects."""

    @property
    def rows(self) -> list[str]:
        """Names of the settings in the order in which they are shown, without those that do not count now."""
        joint = list(JointProperties.__annotations__)
        material = ["cap_material"] if closes_holes(self) else []
        return ["which", "cut", "caps", *material, "center", "modifiers", "seen", "parent", "hide", "fit_bed",
                *(["bed"] if self.fit_bed else []), *(joint if self.joints != "NONE" else joint[:1])]

    fit_bed: BoolProperty(
        name="Fit the Bed", default=False,
        description="Cut parts that are longer than the printer's bed further, in planes across them",
    )
    bed: FloatVectorProperty(
        name="Bed (mm)", default=(220.0, 220.0, 250.0), size=3, min=1.0, max=100000.0, precision=1, step=1000,
        description="Width, depth and height that can be printed, in millimeters; pieces may be turned to fit",
    )

    cut: EnumProperty(
        name="Cuts", default="SMOOTH", translation_context="Reeb Parts",  # to Blender, the number of cuts
        items=[("SMOOTH", "Smooth", "Along a smooth curve, which lies in a plane where one fits: the faces there are "
                "divided in the pieces. Borders that are smooth already stay as they are"),
               ("PLANAR", "Planar", "In a plane, the one that fits best, wherever that tears no part; else as Smooth"),
               ("FACES", "Along Faces", "Along the edges of faces, all of which stay whole")],
        description="Where the pieces are cut from each other; the mesh itself stays as it is",
    )
    caps: BoolProperty(
        name="Close Holes", default=False,
        description="Close the holes where parts were joined, so that each piece is closed; borders that "
        "the mesh had before stay open. The faces are marked by the attribute reeb_cap",
    )
    cap_material: BoolProperty(
        name="Cap Material", default=False,
        description="Give the faces that close holes a material of their own, Cap, which all pieces share; without it, "
        "they have that of the faces beside them",
    )
    center: BoolProperty(
        name="Origin in the Middle", default=True,
        description="Put the origin of each piece to the middle of its surface; without it, all keep the "
        "origin of the object",
    )
    modifiers: BoolProperty(
        name="Keep Modifiers", default=True,
        description="Copy the object's modifiers to each piece. Where one works about the origin, as Mirror does, "
        "the pieces keep the origin of the object, so that all stays in its place",
    )
    seen: BoolProperty(
        name="Apply Modifiers", default=False,
        description="Cut the mesh as it is seen, with its modifiers applied, instead of the one that is stored; "
        "the pieces then have no modifiers",
    )
    parent: BoolProperty(
        name="Parent to Original", default=False,
        description="Make the pieces children of the object, so that they follow it; without it, they have "
        "the parent that the object has",
    )
    hide: BoolProperty(
        name="Hide Original", default=True,
        description="Hide the object, which stays as it is, in the viewport and in renders",
    )


#: All properties of SeparateProperties, by name.
SEPARATE: dict[str, Any] = {name: prop for cls in reversed(SeparateProperties.__mro__)
                            for name, prop in getattr(cls, "__annotations__", {}).items()}

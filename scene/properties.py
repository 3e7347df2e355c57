# SPDX-License-Identifier: GPL-3.0-or-later
"""Settings on the scene, and the result on the mesh it belongs to.

The properties of the method are made from the fields of ``Parameters``: names, defaults, ranges and
tooltips are written down once.
"""

from dataclasses import asdict, fields

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

from ..core.parameters import PRESETS, Parameters
from ..core.uses.colors import PALETTES


def _property(field):
    """The Blender property of a field of Parameters."""
    meta = field.metadata
    words = {"name": meta["label"], "description": meta["description"], "default": field.default}
    if "choices" in meta:
        items = [(choice, choice.title(), "") for choice in meta["choices"]]
        return EnumProperty(items=items, **words)
    if "range" not in meta:
        return BoolProperty(**words)
    low, high = meta["range"]
    if field.type == "int":
        return IntProperty(min=low, max=high, **words)
    # Enough digits to tell 0.005 from 0.0055.
    return FloatProperty(min=low, max=high, precision=4 if low and low < 0.01 else 3, step=1, **words)


class ParameterProperties:
    """One property for each field of Parameters; for operators and property groups to inherit."""

    __annotations__ = {field.name: _property(field) for field in fields(Parameters)}

    def parameters(self):
        """The values as Parameters; raises ParameterError."""
        values = {field.name: getattr(self, field.name) for field in fields(Parameters)}
        for name, value in values.items():
            if isinstance(value, float):
                # Blender stores 0.05 as 0.05000000074505806.
                values[name] = float(f"{value:.6g}")
        return Parameters(**values)

    def use_parameters(self, parameters):
        """Take over all values of a Parameters."""
        for name, value in asdict(parameters).items():
            setattr(self, name, value)


PARAMETERS = tuple(ParameterProperties.__annotations__)


class OutputProperties:
    """What is written to the object; for operators and property groups to inherit."""

    vertex_groups: BoolProperty(
        name="Vertex groups", default=True,
        description="A vertex group for each part; vertices on a cut belong to every part that meets there",
    )
    face_attribute: BoolProperty(
        name="Face attribute", default=True,
        description="The number of each face's part as the attribute reeb_part, for Geometry Nodes",
    )
    colors: BoolProperty(
        name="Colours", default=True,
        description="The parts' colours as the active colour attribute Reeb Parts",
    )
    palette: EnumProperty(
        name="Palette", items=[(name, name, "") for name in PALETTES],
        description="What the parts' colours are chosen from. A colour that you give to a part in the list "
        "stays the part's own",
    )
    face_sets: BoolProperty(
        name="Face sets", default=False,
        description="A face set for each part, for Sculpt Mode; Clear brings your own back",
    )
    materials: BoolProperty(
        name="Materials", default=False,
        description="A material for each part; Clear brings your own back",
    )
    seams: BoolProperty(
        name="Seams along cuts", default=False,
        description="UV seams where parts meet, beside your own; Clear removes only these",
    )
    field: BoolProperty(
        name="Distance field", default=False,
        description="The normalised average geodesic distance that the parts come from, as the vertex "
        "attribute reeb_agd: 0 in the middle of the body, 1 at the farthest tip",
    )
    graph: BoolProperty(
        name="Graph", default=True,
        description="The Reeb graph as objects: an empty for each node, a curve for the arcs",
    )


OUTPUTS = tuple(OutputProperties.__annotations__)


def _redraw_graph(self, context):
    from . import graph_objects, store

    if not store.is_quiet():
        graph_objects.restyle(context.object, self)


class OverlayProperties:
    """How the graph is drawn; for operators and property groups to inherit."""

    node_size: FloatProperty(
        name="Node size", default=0.01, min=0.001, max=0.5, precision=3, step=0.1, update=_redraw_graph,
        description="Size of the empties, as a share of the object's",
    )
    line_thickness: FloatProperty(
        name="Line thickness", default=0.04, min=0.0, max=1.0, precision=3, step=1, update=_redraw_graph,
        description="Thickness of the arcs, as a share of the radius of the body around them",
    )
    in_front: BoolProperty(
        name="In front", default=True, update=_redraw_graph,
        description="Draw the graph over the model instead of hidden inside it",
    )


OVERLAY = tuple(OverlayProperties.__annotations__)


def _use_preset(self, context):
    if self.preset != "CUSTOM":
        self.use_parameters(PRESETS[self.preset])


PRESET_ITEMS = [(name, name, "") for name in PRESETS]


def _repaint(self, context):
    from . import reactions

    if context.object is not None and context.object.type == "MESH":
        reactions.use_palette(context.object.data, self.palette, context)


def _show_graph(self, context):
    from . import reactions

    if context.object is not None and context.object.type == "MESH":
        reactions.show_graph(context.object, self.graph, context)


class ReebPartsSettings(bpy.types.PropertyGroup, ParameterProperties, OutputProperties, OverlayProperties):
    """What the next run will do; on the scene."""

    # Here, and only here, they are seen at once.
    graph: BoolProperty(**OutputProperties.__annotations__["graph"].keywords, update=_show_graph)
    palette: EnumProperty(**OutputProperties.__annotations__["palette"].keywords, update=_repaint)

    def differs_from_preset(self) -> bool:
        """Whether a parameter was changed since the preset was chosen; how many parts there are does not count."""
        preset = PRESETS[self.preset]
        return any(abs(getattr(self, name) - getattr(preset, name)) > 1e-6 * abs(getattr(preset, name))
                   if isinstance(getattr(preset, name), float) else getattr(self, name) != getattr(preset, name)
                   for name in PARAMETERS if name not in {"detail", "n_parts"})

    highlight: BoolProperty(
        name="Outline chosen parts", default=True,
        description="Draw a line around the parts that are chosen in the list",
    )
    preset: EnumProperty(
        name="Preset", items=PRESET_ITEMS, update=_use_preset,
        description="Set all parameters at once",
    )
    adopted: BoolProperty(description="The preferences were taken over")


def _rename(self, context):
    from . import reactions

    reactions.rename(self, context)


def _recolor(self, context):
    from . import reactions

    reactions.recolor(self, context)


def _lock(self, context):
    from . import reactions

    reactions.lock(self, context)


def _pick(self, context):
    from ..operators import parts

    parts.pick(self, context)


def _show_detail(self, context):
    from . import reactions

    reactions.show_detail(self, context)


def _show_number(self, context):
    from . import reactions

    reactions.show_number(self, context)


class ReebPart(bpy.types.PropertyGroup):
    """A part as the list shows it."""

    name: StringProperty(
        name="Name", update=_rename, maxlen=63,
        description="Name of the part and of its vertex group; double click to change it",
    )
    number: IntProperty(name="Number", description="What the part is known by; the value of reeb_part")
    color: FloatVectorProperty(
        name="Colour", subtype="COLOR_GAMMA", size=3, min=0.0, max=1.0, update=_recolor,
        description="Colour of the part; one that you choose stays with it",
    )
    share: FloatProperty(name="Share", subtype="FACTOR", description="Share of the surface's area")
    locked: BoolProperty(
        name="Locked", update=_lock,
        description="The part stays as it is, whatever the detail and whatever is done to its neighbours",
    )
    pinned: BoolProperty(name="Pinned", description="The part was changed by hand and stays whatever the detail")
    selected: BoolProperty(name="Selected", description="Included in what is done to the selected parts")
    group: StringProperty(description="The vertex group made for the part")
    material: PointerProperty(type=bpy.types.Material, description="The material made for the part")


class ReebName(bpy.types.PropertyGroup):
    """A name or a colour that somebody gave to a part, kept while the part is not shown."""

    name: StringProperty(description="Empty: the part's own")
    number: IntProperty()
    has_color: BoolProperty()
    color: FloatVectorProperty(subtype="COLOR_GAMMA", size=3)


class ReebPartsResult(bpy.types.PropertyGroup):
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
        name="Detail", min=0.0, max=1.0, default=0.5, subtype="FACTOR", update=_show_detail,
        description="How readily the surface is cut: 0 gives as few parts as possible, 1 every candidate. "
        "Nothing is computed again",
    )
    n_parts: IntProperty(
        name="Number of parts", min=1, update=_show_number,
        description="Exactly this many parts, whatever the detail. Nothing is computed again",
    )
    by_number: BoolProperty(description="The number of parts decides, not the detail")
    parts: CollectionProperty(type=ReebPart)
    active: IntProperty(name="Active part", update=_pick)
    names: CollectionProperty(type=ReebName)

    # What was written, under which name, and what was there before
    face_attribute: StringProperty()
    color_attribute: StringProperty()
    palette: StringProperty()
    field_attribute: StringProperty()
    has_groups: BoolProperty()
    has_face_sets: BoolProperty()
    has_materials: BoolProperty()
    has_seams: BoolProperty()
    former_color: StringProperty()
    former_render_color: StringProperty()
    had_face_sets: BoolProperty()
    had_material_index: BoolProperty()
    had_seams: BoolProperty()


CLASSES = (ReebPartsSettings, ReebPart, ReebName, ReebPartsResult)


def register():
    for cls in CLASSES:
        bpy.utils.register_class(cls)
    bpy.types.Scene.reeb_parts = PointerProperty(type=ReebPartsSettings)
    bpy.types.Mesh.reeb_parts = PointerProperty(type=ReebPartsResult)


def unregister():
    del bpy.types.Mesh.reeb_parts
    del bpy.types.Scene.reeb_parts
    for cls in reversed(CLASSES):
        bpy.utils.unregister_class(cls)

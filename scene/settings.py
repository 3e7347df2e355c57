# SPDX-License-Identifier: GPL-3.0-or-later
"""Settings: what the next run, and what is made of its parts, will be like; on the scene."""

from typing import Any

import bpy
from bpy.props import BoolProperty, EnumProperty, FloatProperty

from ..core.parameters import PRESETS
from . import targets
from .changes import reactions
from .changes.settled import Settled, reaction
from .former_names import FormerParameters
from .graph import graph_objects
from .properties import (
    OVERLAY,
    PARAMETERS,
    HintProperties,
    OutputProperties,
    OverlayProperties,
    ParameterProperties,
    SeparateProperties,
)

PRESET_ITEMS = [(name, name, "") for name in PRESETS]


@reaction
def _use_preset(self: bpy.types.PropertyGroup, context: bpy.types.Context) -> None:
    self.use_parameters(PRESETS[self.preset])


@reaction
def _repaint(self: bpy.types.PropertyGroup, context: bpy.types.Context) -> None:
    reactions.use_palette(targets.active_object(context), self.palette, context)


@reaction
def _show_graph(self: bpy.types.PropertyGroup, context: bpy.types.Context) -> None:
    reactions.show_graph(targets.active_object(context), self.graph, context)


@reaction
def _redraw_graph(self: bpy.types.PropertyGroup, context: bpy.types.Context) -> None:
    graph_objects.restyle(targets.active_object(context), self)


class ReebPartsSettings(
    bpy.types.PropertyGroup, FormerParameters, ParameterProperties, HintProperties, OutputProperties, OverlayProperties,
    Settled
):
    """What the next run will do; on the scene."""

    # Here, and only here, they are seen at once.
    graph: BoolProperty(**OutputProperties.__annotations__["graph"].keywords, update=_show_graph, options=set())
    palette: EnumProperty(**OutputProperties.__annotations__["palette"].keywords, update=_repaint, options=set())
    node_size: FloatProperty(**OverlayProperties.__annotations__["node_size"].keywords, update=_redraw_graph)
    line_thickness: FloatProperty(**OverlayProperties.__annotations__["line_thickness"].keywords, update=_redraw_graph)
    in_front: BoolProperty(**OverlayProperties.__annotations__["in_front"].keywords, update=_redraw_graph)

    def differs_from_preset(self) -> bool:
        """Whether a parameter was changed since the preset was chosen; how many parts there are does not count."""
        preset = PRESETS[self.preset]
        return any(abs(getattr(self, name) - getattr(preset, name)) > 1e-6 * abs(getattr(preset, name))
                   if isinstance(getattr(preset, name), float) else getattr(self, name) != getattr(preset, name)
                   for name in PARAMETERS if name not in {"detail", "n_parts"})

    def watched(self) -> dict[str, Any]:
        names = ("preset", "palette", *OVERLAY)
        return {"graph": self.graph, **{name: getattr(self, name) for name in names}}

    sort: EnumProperty(
        name="Sort", default="NUMBER",
        items=[("NUMBER", "Number", "In the order of their numbers: those of fewer parts first"),
               ("SIZE", "Size", "Largest first"), ("NAME", "Name", "By name"), ("PLACE", "Place", "Highest first")],
        description="The order of the parts in the list",
    )
    show_small: BoolProperty(
        name="Show Small Parts", default=False,
        description="List the parts, too, that are smaller than the share set under Advanced, Overlay",
    )
    small: FloatProperty(
        name="Small Below", default=1.0, min=0.0, max=100.0, subtype="PERCENTAGE",
        description="Parts of a smaller share of the surface are folded into one row where the list is long",
    )
    highlight: BoolProperty(
        name="Outline Chosen Parts", default=True,
        description="Draw a line around the parts that are chosen in the list",
    )
    show_cuts: BoolProperty(
        name="Show Cuts", default=False,
        description="Draw all borders between parts where Separate would cut them, by its setting Cuts",
    )
    preset: EnumProperty(
        name="Preset", items=PRESET_ITEMS, update=_use_preset, options=set(),
        description="Set all parameters at once",
    )
    adopted: BoolProperty(description="The preferences were taken over")


class ReebPartsUse(bpy.types.PropertyGroup, SeparateProperties):
    """What the buttons under Use Parts will do; on the scene."""

# SPDX-License-Identifier: GPL-3.0-or-later
"""The list of parts in the sidebar, with the buttons beside it, in a sidebar of any width."""

from __future__ import annotations

import bpy
from bpy.app.translations import pgettext_iface as iface_
from mathutils import Matrix

from ..core.sentence import Count
from ..scene.result import part_list
from .fitting import Room

ROWS, MOST_ROWS = 7, 12  # of the list, if it has so many parts and the sidebar is high enough
ROW, OTHER_ROWS = 20, 320  # heights of a row and of all but the list, in pixels of a screen without scaling

# Widths of panels, in pixels of a screen without scaling, below which something is left out or moves.
BUTTONS_BESIDE = 150  # the buttons beside the list stand below it
LOCKS = 150  # no locks in the list
WIDE_CHIPS = 120  # colors are stripes only
TICKS = 90  # no boxes to tick: parts are marked with the tool, or by the menu
# What a row of the list has besides a part's name and share: its frame, the bar that scrolls it, the buttons beside it.
FRAME, BAR, BESIDE = 12, 18, 28
# By the region, whether its list has a bar; Blender does not tell. Of one that the user dragged shorter it is unknown.
_scrolls: dict[int, bool] = {}


class REEB_PARTS_UL_parts(bpy.types.UIList):
    """Parts with color, name, share of the area, lock and mark; small ones are left out of a long list."""

    def draw_item(self, context: bpy.types.Context, layout: bpy.types.UILayout, data: bpy.types.PropertyGroup,
                  item: bpy.types.PropertyGroup, icon: int, active_data: bpy.types.PropertyGroup, active_property: str,
                  index: int) -> None:
        row = layout.row(align=True)
        room = Room(context)
        chip = row.row()
        chip.ui_units_x = 1.0 if room.width >= WIDE_CHIPS else 0.4
        chip.prop(item, "color", text="")
        row.prop(item, "name", text="", emboss=False)
        percent = f"{100 * item.share:.1f} %"
        if _has_share(room, item.name, percent, _scrolls.get(context.region.as_pointer(), True)):
            share = row.row()
            share.alignment = "RIGHT"
            share.label(text=percent)
        if room.width >= LOCKS:
            unlocked = "PINNED" if item.pinned else "UNLOCKED"
            row.prop(item, "locked", text="", emboss=False, icon="LOCKED" if item.locked else unlocked)
        if room.width >= TICKS:
            row.prop(item, "selected", text="", emboss=False,
                     icon="CHECKBOX_HLT" if item.selected else "CHECKBOX_DEHLT")

    def draw_filter(self, context: bpy.types.Context, layout: bpy.types.UILayout) -> None:
        row = layout.row(align=True)
        row.prop(self, "filter_name", text="", icon="VIEWZOOM")
        row.prop(context.scene.reeb_parts, "sort", text="")

    def filter_items(self, context: bpy.types.Context, data: bpy.types.PropertyGroup, property: str
                     ) -> tuple[list[int], list[int]]:
        parts, settings = getattr(data, property), context.scene.reeb_parts
        flags = [self.bitflag_filter_item] * len(parts)
        if self.filter_name:  # a small part that is looked for by its name is shown
            flags = bpy.types.UI_UL_list.filter_items_by_name(
                self.filter_name, self.bitflag_filter_item, parts, "name")
        elif left_out := part_list.folded(data.id_data):
            flags = [0 if part.number in left_out else self.bitflag_filter_item for part in parts]
        shown = sum(bool(flag) != self.use_filter_invert for flag in flags)
        _scrolls[context.region.as_pointer()] = shown > _most_rows(context)
        matrix = context.object.matrix_world if context.object is not None else Matrix()
        return flags, part_list.ordered(parts, settings.sort, matrix)


def draw(layout: bpy.types.UILayout, context: bpy.types.Context, room: Room,
         result: bpy.types.PropertyGroup) -> None:
    """The list with its buttons, beside it or below it; it grows with its parts as far as the sidebar is high."""
    beside = room.width >= BUTTONS_BESIDE
    row = layout.row() if beside else layout.column(align=True)
    row.template_list(
        "REEB_PARTS_UL_parts", "", result, "parts", result, "active", rows=ROWS, maxrows=_most_rows(context))
    column = row.column(align=True) if beside else row.grid_flow(
        row_major=True, columns=6 if room.width >= 6 * ROW else 3, even_columns=True, align=True)
    column.operator("reeb_parts.merge", text="", icon="AUTOMERGE_ON")
    column.operator("reeb_parts.split", text="", icon="MOD_EDGESPLIT")
    if beside:
        column.separator()
    column.operator("reeb_parts.grow", text="", icon="ADD")
    column.operator("reeb_parts.shrink", text="", icon="REMOVE")
    if beside:
        column.separator()
    column.operator("reeb_parts.frame", text="", icon="VIEWZOOM")
    # Where it is wider than an icon, Blender draws an arrow by itself.
    column.menu("REEB_PARTS_MT_parts", text="", icon="DOWNARROW_HLT" if beside else "NONE")


def draw_small(layout: bpy.types.UILayout, context: bpy.types.Context, room: Room,
               result: bpy.types.PropertyGroup) -> None:
    """One row for all small parts of a long list."""
    small = part_list.small_parts(result.id_data)
    if not small:
        return
    settings = context.scene.reeb_parts
    text = iface_("{n} Small {n:Part|Parts}").format(n=Count(len(small)))
    row = room.row(layout, text, iface_("Merge Small", "Operator"), icons=1)
    row.prop(settings, "show_small", text=text,
             icon="DOWNARROW_HLT" if settings.show_small else "RIGHTARROW", toggle=True)
    room.operator(row, "reeb_parts.merge_small", text="Merge Small", spare="AUTOMERGE_ON")


def _most_rows(context: bpy.types.Context) -> int:
    """How many rows the list has at most, unless the user drags it longer."""
    height = context.region.height / context.preferences.system.ui_scale
    return min(max(int((height - OTHER_ROWS) / ROW), ROWS), MOST_ROWS)


def _has_share(room: Room, name: str, percent: str, scrolls: bool) -> bool:
    """Whether the share of a part fits beside its name: the name is the last to be cut off."""
    buttons = BESIDE + FRAME + BAR * scrolls + 3 * ROW  # the color, the lock and the tick
    return room.width >= LOCKS and room.text(name) + room.text(percent) + 2 * 8 <= room.width - buttons


CLASSES = (REEB_PARTS_UL_parts,)

# SPDX-License-Identifier: GPL-3.0-or-later
"""What fits into a sidebar of any width, in any language: what does not fit beside each other stands below."""

from __future__ import annotations

from collections.abc import Collection, Iterable
from copy import copy
from typing import Any

import blf
import bpy
from bpy.app.translations import pgettext_iface as iface_

from . import wrapping

# In pixels of a screen without scaling.
_EDGES = 56.0  # of a sidebar: the tabs, and the margins of a panel
_BOX = 12.0  # margins of a box
_ICON = 20.0
_PADDING, _ALONE = 10.0, 3.0  # beside the text of a button in a row, and of one that has it for itself
_LABEL = 16.0  # beside the text of a label
_ARROWS = 14.0  # what a field of a number or of a choice has besides that
_FIELD = 56.0  # the narrowest that shows a number
_NAMES = 0.4  # share of a row that Blender gives to the names of properties


class Room:
    """How much fits beside each other in a panel of the sidebar.

    Parameters
    ----------
    context : bpy.types.Context
        Of a panel that is drawn.

    Attributes
    ----------
    width : float
        Of a row of buttons, in pixels of a screen without scaling.
    """

    def __init__(self, context: bpy.types.Context) -> None:
        system, view = context.preferences.system, context.region.view2d
        self._scale = system.ui_scale
        self._points = context.preferences.ui_styles[0].widget.points
        # A sidebar can be zoomed.
        seen = view.region_to_view(context.region.width, 0)[0] - view.region_to_view(0, 0)[0]
        self.width = seen / self._scale - _EDGES

    def less(self, width: float = _BOX) -> Room:
        """The room beside something of a width; in a box."""
        other = copy(self)
        other.width -= width
        return other

    def text(self, words: str) -> float:
        """Width of words, in pixels of a screen without scaling."""
        blf.size(0, self._points * self._scale)
        return float(blf.dimensions(0, words)[0]) / self._scale

    def has(self, *words: str, icons: int = 0, fields: int = 0) -> bool:
        """Whether buttons of some words and icons, and so many fields among them, fit beside each other."""
        needed = sum(self.text(word) + _PADDING for word in words) + _ICON * icons + _ARROWS * fields
        return needed <= self.width

    def share(self, words: str) -> float:
        """The share of a row that a button of some words needs."""
        return (self.text(words) + _PADDING) / self.width

    def row(self, layout: bpy.types.UILayout, *words: str, icons: int = 0, fields: int = 0) -> bpy.types.UILayout:
        """A row for buttons that fit beside each other, or else a column."""
        return layout.row(align=True) if self.has(*words, icons=icons, fields=fields) else layout.column(align=True)

    def grid(self, layout: bpy.types.UILayout, *words: str, icons: int = 0) -> bpy.types.UILayout:
        """Rows of two buttons each, or of one where the widest two of some words, each with icons, do not fit."""
        widest = max(words, key=self.text)
        columns = 2 if self.has(widest, widest, icons=2 * icons) else 1
        return layout.grid_flow(row_major=True, columns=columns, even_columns=True, align=True)

    def operator(self, layout: bpy.types.UILayout, name: str, *, text: str = "", text_ctxt: str = "Operator",
                 icon: str = "NONE", spare: str = "NONE", **options: Any) -> bpy.types.OperatorProperties:
        """A button of a whole row: of its words alone where its icon does not fit, of its icon where they do not.

        spare : an icon that is used only in the place of the words.
        """
        words = iface_(text or _label(name), text_ctxt)
        needed = self.text(words) + _ALONE
        if needed > self.width and (icon, spare) != ("NONE", "NONE"):
            return layout.operator(name, text="", icon=spare if icon == "NONE" else icon, **options)
        shown = icon if needed + _ICON <= self.width else "NONE"
        return layout.operator(name, text=words, translate=False, icon=shown, **options)

    def field(self, layout: bpy.types.UILayout, data: bpy.types.bpy_struct, name: str, words: str, value: str,
              icons: int = 0, enabled: bool = True, **options: Any) -> bpy.types.UILayout:
        """A field, whose name stands above it where it does not fit beside its value; the row, for some icons.

        enabled : whether the field is; what is added to the row is in any case.
        """
        beside = self.has(words, value, icons=icons, fields=1)
        if not beside:
            layout.label(text=words, translate=False)
        row = layout.row(align=True)
        cell = row.row(align=True)
        cell.enabled = enabled
        cell.prop(data, name, text=words if beside else "", translate=False, **options)
        return row

    def wrapped(self, column: bpy.types.UILayout, words: str, icon: str = "NONE") -> None:
        """Words in as many lines as they need, with an icon before the first one if there is room for it."""
        icons = icon != "NONE" and self.width > 6 * _ICON
        for index, line in enumerate(wrapping.lines(words, self.width - _LABEL - _ICON * icons, self.text)):
            column.label(text=line, translate=False, icon=("BLANK1" if index else icon) if icons else "NONE")

    def properties(self, layout: bpy.types.UILayout, data: bpy.types.bpy_struct, names: Iterable[str],
                   expanded: Collection[str] = ()) -> None:
        """Properties below each other, their names before them; above them where that is too narrow.

        expanded : those that show all their choices, if the words of these fit beside each other.
        """
        kinds = [data.bl_rna.properties[name] for name in names]
        words = {kind: iface_(kind.name, kind.translation_context) for kind in kinds}
        ticks = [self.text(words[kind]) + _ICON for kind in kinds if kind.type == "BOOLEAN"]
        named = [self.text(words[kind]) for kind in kinds if kind.type != "BOOLEAN"]
        above = max(named, default=0.0) > _NAMES * self.width or (1 - _NAMES) * self.width < _FIELD
        whole = above or max(ticks, default=0.0) + _ALONE > (1 - _NAMES) * self.width
        layout.use_property_decorate = False
        for kind in kinds:
            column = layout.column(align=True)
            if kind.type == "BOOLEAN" and self.text(words[kind]) + _ICON + _ALONE > self.width:
                row = column.row(align=True)
                row.prop(data, kind.identifier, text="")
                self.less(_ICON).wrapped(row.column(align=True), words[kind])
            elif above and kind.type != "BOOLEAN":
                self.wrapped(column, words[kind])
                column.prop(data, kind.identifier, text="")
            else:
                column.use_property_split = not (whole and kind.type == "BOOLEAN")
                expand = kind.identifier in expanded and self.less(_NAMES * self.width)._has_choices(kind)
                (column.row() if expand else column).prop(data, kind.identifier, expand=expand)

    def _has_choices(self, kind: bpy.types.EnumProperty) -> bool:
        """Whether all choices of a property fit beside each other, each as wide as the widest."""
        words = [iface_(item.name, kind.translation_context) for item in kind.enum_items]
        return self.has(*len(words) * [max(words, key=self.text)])


def _label(name: str) -> str:
    """The label of an operator, in English."""
    group, own = name.split(".")
    return str(getattr(getattr(bpy.ops, group), own).get_rna_type().name)

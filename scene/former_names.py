# SPDX-License-Identifier: GPL-3.0-or-later
"""The parameters by their names of version 0.1.0, which scenes of then have and scripts still give."""

from typing import Any

import bpy

from ..core.parameters import RENAMED, present_names
from .changes.settled import reaction
from .errors import translated
from .properties import ParameterProperties


def _former_property(present: str, **more: Any) -> Any:
    """The Blender property for the name that version 0.1.0 had for a parameter; shown nowhere."""
    prop = ParameterProperties.__annotations__[present]
    words = {key: value for key, value in prop.keywords.items() if key not in {"name", "description"}}
    return prop.function(**words, **more)


def take_over_former_names(holder: Any) -> list[str]:
    """Set parameters that are set by their names of version 0.1.0 by their names of today.

    Parameters
    ----------
    holder : bpy.types.OperatorProperties or bpy.types.PropertyGroup
        Has the properties of a ParameterProperties and of RENAMED. Present names that are set, too, win.

    Returns
    -------
    notes : list of str
        A sentence for each former name that was set, in the language of the interface.
    """
    former = {name: getattr(holder, name) for name in RENAMED if holder.is_property_set(name)}
    values, notes = present_names(former)
    for name, value in values.items():
        if not holder.is_property_set(name):
            setattr(holder, name, value)
    for name in former:
        holder.property_unset(name)
    return [translated(note) for note in notes]


@reaction
def _set_by_former_name(self: bpy.types.PropertyGroup, context: bpy.types.Context) -> None:
    for name in [name for name in RENAMED if self.is_property_set(name)]:
        for present in RENAMED[name]:  # what a script sets last counts
            self.property_unset(present)
    take_over_former_names(self)


class FormerParameters:
    """The parameters by their names of version 0.1.0, for scenes of then and scripts that set them."""

    __annotations__ = {name: _former_property(present[0], update=_set_by_former_name, options=set())
                       for name, present in RENAMED.items()}


class FormerArguments:
    """The parameters by their names of version 0.1.0, for scripts that call an operator with them."""

    __annotations__ = {name: _former_property(present[0], options={"HIDDEN", "SKIP_SAVE"})
                       for name, present in RENAMED.items()}

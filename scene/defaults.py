# SPDX-License-Identifier: GPL-3.0-or-later
"""What the preferences say, taken over by new scenes and by scripts.

A scene takes it over once, when it is first seen, at the latest with its first object. What the user sets
in it later is the scene's own, and a file looks the same whatever the preferences are where it is opened.
"""

from __future__ import annotations

from collections.abc import Iterable

import bpy
from bpy.app.handlers import persistent

from .. import __package__ as base_package
from ..core.parameters import PRESETS, RENAMED
from . import handlers, property_updates
from .former_names import take_over_former_names
from .properties import OUTPUTS, OVERLAY, PARAMETERS, fill_in
from .transaction import keep_group, transaction


def preferences() -> bpy.types.AddonPreferences | None:
    """The preferences of the extension; None when it runs without being listed in Blender's preferences."""
    addon = bpy.context.preferences.addons.get(base_package)
    return addon.preferences if addon else None


def adopt(scene: bpy.types.Scene) -> None:
    """Set a scene up as the preferences say, the first time it is seen."""
    if not scene.is_editable:
        return
    settings = scene.reeb_parts
    if settings.adopted and not any(settings.is_property_set(name) for name in RENAMED):
        return
    with transaction():
        keep_group(scene, "reeb_parts")
        _adopt(settings)


def _adopt(settings: bpy.types.PropertyGroup) -> None:
    take_over_former_names(settings)
    if not settings.adopted:
        names = [name for name in (*OUTPUTS, *OVERLAY) if not settings.is_property_set(name)]
        # In an empty scene the user may have chosen a preset already.
        if not any(settings.is_property_set(name) for name in ("preset", *PARAMETERS)):
            names.append("preset")
        use(settings, names)


def use(settings: bpy.types.PropertyGroup, names: Iterable[str]) -> None:
    """Take over some settings from the preferences."""
    chosen = preferences()
    if chosen is None:
        return
    # No graph is drawn anew by this.
    with property_updates.quiet():
        settings.adopted = True
        for name in names:
            if getattr(settings, name) != getattr(chosen, name):
                setattr(settings, name, getattr(chosen, name))
                if name == "preset":
                    settings.use_parameters(PRESETS[settings.preset])


def complete(operator: bpy.types.Operator) -> None:
    """Give an operator the preferences' value of every property that its caller left out."""
    chosen = preferences()
    if chosen is None:
        return
    fill_in(operator, PRESETS[chosen.preset], PARAMETERS)
    fill_in(operator, chosen, (*OUTPUTS, *OVERLAY))


@persistent
def _adopt_all(*_: object) -> None:
    for scene in bpy.data.scenes:
        adopt(scene)


@persistent
def _adopt_one(scene: bpy.types.Scene, depsgraph: bpy.types.Depsgraph) -> None:
    adopt(scene)


def register() -> None:
    bpy.app.handlers.load_post.append(_adopt_all)
    bpy.app.handlers.depsgraph_update_post.append(_adopt_one)
    # While an extension is switched on, Blender's data may be out of reach.
    bpy.app.timers.register(_adopt_all, first_interval=0.0)


def unregister() -> None:
    if bpy.app.timers.is_registered(_adopt_all):
        bpy.app.timers.unregister(_adopt_all)
    handlers.remove(bpy.app.handlers.depsgraph_update_post, _adopt_one)
    handlers.remove(bpy.app.handlers.load_post, _adopt_all)

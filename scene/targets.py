# SPDX-License-Identifier: GPL-3.0-or-later
"""Which objects can be worked on, and the sentence why one cannot."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import TypeVar

import bpy
from bpy.app.translations import pgettext_iface as iface_
from bpy.app.translations import pgettext_rpt as rpt_

from .errors import SceneError
from .modes import check_mode
from .ours.made_objects import ROLE

Report = Callable[[set[str], str], None]  # what reports: the kinds that Blender asks for, and the sentence
_Found = TypeVar("_Found")


def chosen_objects(
    context: bpy.types.Context, report: Report | None = None, one_per_mesh: bool = True
) -> list[bpy.types.Object]:
    """The objects to work on: the active mesh, then other selected meshes.

    Parameters
    ----------
    context : bpy.types.Context
    report : callable, optional
        Told of each selected mesh that is left out, such as one that is linked from another file, and why.
    one_per_mesh : bool
        Of objects that share a mesh take only one: what is written to the mesh is written to all.

    Raises
    ------
    SceneError
        The active object is none that can be decomposed.
    """
    active = active_object(context)
    check_object(active)
    assert active is not None
    # A script may override the active object; the mode that is left for writing is that of the view layer's.
    if active != context.view_layer.objects.active and active.mode != "OBJECT":
        raise SceneError(_in_another_mode(active))
    found, known = [active], {active.data if one_per_mesh else active}
    for obj in selected_objects(context):
        own = obj.data if one_per_mesh else obj
        if obj.type != "MESH" or own in known:
            continue
        try:
            check_object(obj)
            if obj.mode != active.mode:
                raise SceneError(_in_another_mode(obj))
        except SceneError as error:
            if report:
                report({"WARNING"}, str(error))
        else:
            found.append(obj)
            known.add(own)
    return found


def usable(objects: list[bpy.types.Object], look: Callable[[bpy.types.Object], _Found],
           report: Report) -> Iterator[tuple[bpy.types.Object, _Found]]:
    """Yield what is found of objects, each when its turn comes, the active one first.

    Others of which that cannot be are left out, and it is said why.

    Raises
    ------
    SceneError
        By ``look``, of the first object.
    """
    for index, obj in enumerate(objects):
        try:
            found = look(obj)
        except SceneError as error:
            if index == 0:
                raise
            report({"WARNING"}, str(error))
        else:
            yield obj, found


def _in_another_mode(obj: bpy.types.Object) -> str:
    return rpt_("{name} is in another mode than the active object. Go to Object Mode there first.").format(
        name=obj.name)


def active_object(context: bpy.types.Context) -> bpy.types.Object | None:
    """The active object; a script may give another one with ``temp_override``."""
    return getattr(context, "active_object", None) or context.view_layer.objects.active


def selected_objects(context: bpy.types.Context) -> list[bpy.types.Object]:
    """The selected objects; a script may give others with ``temp_override``."""
    found = getattr(context, "selected_objects", None)
    return list(context.view_layer.objects.selected if found is None else found)


def active_and_selected(context: bpy.types.Context) -> list[bpy.types.Object]:
    """The active object, if there is one, then the other selected ones."""
    every = dict.fromkeys([active_object(context), *selected_objects(context)])
    return [obj for obj in every if obj is not None]


def check_object(obj: bpy.types.Object | None) -> None:
    """Raise SceneError unless the object is a mesh that can be read and written."""
    if obj is None:
        raise SceneError(rpt_("There is no active object. Select a mesh and try again."))
    for data in (obj, obj.data):
        if data is not None and data.is_missing:  # Blender has an empty in the place of such an object
            raise SceneError(
                rpt_("{name} is linked from {source}, which is not there or does not have it any more. Bring it back "
                     "and open the file again.").format(name=data.name, source=_source(data))
            )
    if can_become_mesh(obj):
        raise SceneError(to_become_mesh(obj))
    if obj.type != "MESH":
        raise SceneError(rpt_("{name} is not a mesh but of the type {kind}. Select a mesh and try again.").format(
            name=obj.name, kind=_kind(obj)))
    for data in (obj, obj.data):
        if data.override_library:
            raise SceneError(
                rpt_("{name} is a library override and its mesh cannot be written. Make it local (Object > "
                     "Library Override > Make Local) and try again.").format(name=data.name)
            )
        if data.library or not data.is_editable:
            raise SceneError(
                rpt_("{name} is linked from {source} and cannot be written. Make it local (Object > "
                     "Relations > Make Local) and try again.").format(name=data.name, source=_source(data))
            )
    check_mode(obj)
    if obj.data.is_editmode and obj.mode != "EDIT":
        raise SceneError(
            rpt_("The mesh of {name} is being edited through another object. Leave Edit Mode there first.").format(
                name=obj.name)
        )


def why_not(obj: bpy.types.Object | None) -> str:
    """The sentence of ``check_object``, or nothing."""
    try:
        check_object(obj)
    except SceneError as error:
        return str(error)
    return ""


def check_at_rest(obj: bpy.types.Object) -> None:
    """As ``check_object``, and raise SceneError where the mesh is being edited, beside an active object that is not."""
    check_object(obj)
    if obj.data.is_editmode:
        raise SceneError(_in_another_mode(obj))


def is_foreign(obj: bpy.types.Object) -> bool:
    """Whether an object is linked from another file, be it overridden."""
    return obj.library is not None or obj.override_library is not None


def can_become_mesh(obj: bpy.types.Object) -> bool:
    """Whether Blender makes a mesh of an object that looks the same; not of the arcs of a graph."""
    return obj.type in {"CURVE", "SURFACE", "FONT", "META"} and ROLE not in obj


def to_become_mesh(obj: bpy.types.Object) -> str:
    """What to do with an object that can become a mesh."""
    return rpt_("{name} is not a mesh but of the type {kind}. Convert it (Object > Convert > Mesh) and try again."
                ).format(name=obj.name, kind=_kind(obj))


def to_be_active(context: bpy.types.Context) -> str:
    """What to do where meshes are selected and something else is the active object; nothing in other cases."""
    active = active_object(context)
    if active is None or active.type == "MESH" or all(obj.type != "MESH" for obj in selected_objects(context)):
        return ""
    return rpt_("{name} is the active object, and not a mesh. Hold Shift and click the mesh.").format(name=active.name)


def _source(data: bpy.types.ID) -> str:
    """The file that a data block is linked from."""
    return data.library.filepath if data.library else rpt_("another file")


def _kind(obj: bpy.types.Object) -> str:
    """What sort of object it is, in Blender's own word."""
    prop = obj.bl_rna.properties["type"]
    word = prop.enum_items[obj.type].name
    # Other languages may write nouns with a capital, and some words as English does: Text in German.
    english = bpy.app.translations.locale[:2] in {"", "C", "en"}
    return word.lower() if english else iface_(word, prop.translation_context)


def users(mesh: bpy.types.Mesh) -> list[bpy.types.Object]:
    """The objects of a mesh; vertex groups can be written through any of them."""
    return [obj for obj in bpy.data.objects if obj.data == mesh]


def name_of(mesh: bpy.types.Mesh) -> str:
    """What a person calls a mesh: the name of its object, of several that of the active one; its own without any."""
    names = [obj.name for obj in users(mesh)]
    active = bpy.context.view_layer.objects.active if bpy.context.view_layer else None
    if active is not None and active.name in names:
        return active.name
    return names[0] if names else mesh.name

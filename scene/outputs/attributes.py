# SPDX-License-Identifier: GPL-3.0-or-later
"""Parts written to a mesh: groups, attributes, colours, face sets, materials, seams; and taken back.

All functions want Object Mode. What was made is remembered in ``mesh.reeb_parts`` under the name that
Blender gave it, so that nothing of the user's is touched, not even under the same name. What stood there
before is kept in attributes whose names start with a dot, which Blender hides and carries through edits.
"""

import bpy
import numpy as np

from ...core.result.numbering import NumberedParts
from ...core.uses.colors import PALETTE, PALETTES
from .. import mesh_arrays, store
from . import vertex_groups

FACE_ATTRIBUTE = "reeb_part"
COLOR_ATTRIBUTE = "Reeb Parts"
FIELD_ATTRIBUTE = "reeb_agd"
FACE_SETS = ".sculpt_face_set"

# Up to this share of the faces, their corners one by one cost less than all corners at once: Blender sets
# byte colours slowly.
FEW = 0.01

# From so many corners on, Blender's operator that converts colours is worth calling.
MANY = 200_000

_MATERIAL_INDEX = "material_index"
_FORMER_FACE_SETS = ".reeb_former_face_set"
_FORMER_MATERIALS = ".reeb_former_material"
_FORMER_SEAMS = ".reeb_former_seam"


def write_outputs(obj, numbered: NumberedParts, field: np.ndarray, outputs):
    """Write the chosen outputs, and take back what an earlier run wrote and this one does not want.

    Parameters
    ----------
    obj : bpy.types.Object
    numbered : NumberedParts
    field : (n,) float64
    outputs
        Has the switches of ui.properties.OutputProperties.
    """
    mesh = obj.data
    vertex_groups.remove_groups(obj)
    for wanted, add, remove in (
        (outputs.vertex_groups, vertex_groups.plan_groups, vertex_groups.remove_groups),
        (outputs.face_attribute, add_face_attribute, remove_face_attribute),
        (outputs.colors, add_colors, remove_colors),
        (outputs.field, add_field, remove_field),
        (outputs.face_sets, add_face_sets, remove_face_sets),
        (outputs.materials, add_materials, remove_materials),
        (outputs.seams, add_seams, remove_seams),
    ):
        (add if wanted else remove)(obj)
    mesh.reeb_parts.palette = outputs.palette
    if outputs.field:
        attribute = mesh.attributes[mesh.reeb_parts.field_attribute]
        attribute.data.foreach_set("value", np.nan_to_num(field).astype(np.float32))
    update_outputs(obj, numbered)


def update_outputs(obj, numbered: NumberedParts, before: np.ndarray | None = None):
    """Bring the list and all that was written up to date with the parts.

    Parameters
    ----------
    obj : bpy.types.Object
    numbered : NumberedParts
    before : (c,) int64, optional
        Numbers of the candidates' parts as they are written now, so that only what differs is written
        where writing is slow.
    """
    mesh = obj.data
    result = mesh.reeb_parts
    numbers = numbered.face_numbers
    former = store.number_colors(mesh)
    gone = _list_parts(mesh, numbered)
    colors = store.number_colors(mesh)
    # Colours first: what evaluates the scene there finds nothing else changed yet.
    color_faces(mesh, numbers, colors, _recolored(numbered, before, former, colors))
    for _, _, group, material in gone:
        vertex_groups.remove_group(obj, group)
        _remove_material(mesh, material)
    if result.has_groups:
        vertex_groups.write_groups(obj, numbered, before)
    if attribute := mesh.attributes.get(result.face_attribute):
        attribute.data.foreach_set("value", numbers.astype(np.int32))
    if result.has_materials:
        _write_materials(mesh, numbered)
    if result.has_face_sets:
        mesh.attributes[FACE_SETS].data.foreach_set("value", numbers.astype(np.int32))
    if result.has_seams:
        _write_seams(mesh, numbers)
    mesh.update()


def update_colors(mesh, numbered: NumberedParts):
    """Bring the colour attribute and the materials up to date with the colours of the list, which stays."""
    color_faces(mesh, numbered.face_numbers, store.number_colors(mesh))
    if mesh.reeb_parts.has_materials:
        _write_materials(mesh, numbered)
    mesh.update()


def _recolored(numbered, before, old, new):
    """The faces whose colour changes, None if that is not known."""
    if before is None:
        return None
    same = np.zeros(len(new), bool)
    both = min(len(old), len(new))
    same[:both] = (old[:both] == new[:both]).all(axis=1)
    changed = (before != numbered.candidate_numbers) | ~same[numbered.candidate_numbers]
    return np.flatnonzero(changed[numbered.candidates])


def remove_outputs(obj):
    """Take back all that was written to the mesh; the result itself stays."""
    for remove in (vertex_groups.remove_groups, remove_face_attribute, remove_colors, remove_field, remove_face_sets,
                   remove_materials, remove_seams):
        remove(obj)
    obj.data.update()


def _list_parts(mesh, numbered) -> list:
    """Fill the list of parts; what is known of a number stays. Returns what was known of those that are gone."""
    result = mesh.reeb_parts
    active = result.parts[result.active].number if result.active < len(result.parts) else 0
    keys = ("locked", "selected", "group", "material")
    known = {part.number: [getattr(part, key) for key in keys] for part in result.parts}
    wanted = numbered.numbers.tolist()
    colors = _colors(mesh, numbered)
    with store.quiet():
        result.parts.clear()
        for label, number in enumerate(wanted):
            part = result.parts.add()
            part.number = number
            part.name = store.part_name(mesh, number)
            part.color = colors[label]
            part.share = numbered.parts.share[label]
            for key, value in zip(keys, known.get(number, ()), strict=False):
                setattr(part, key, value)
        result.active = wanted.index(active) if active in wanted else 0
        result.n_parts = len(wanted)
    return [values for number, values in known.items() if number not in wanted]


def palette_colors(mesh, numbered: NumberedParts) -> np.ndarray:
    """The colour of each part from the mesh's palette, (count, 3) float64 sRGB."""
    return numbered.colors(PALETTES.get(mesh.reeb_parts.palette, PALETTE))


def _colors(mesh, numbered) -> np.ndarray:
    """The colour of each part, (count, 3) float64 sRGB: somebody's choice, or from the palette."""
    colors = palette_colors(mesh, numbered)
    for number, color in store.kept_colors(mesh).items():
        colors[numbered.numbers == number] = color
    return colors


# Face attribute, colours, field


def _add(mesh, former, name, kind, domain):
    """The name of an attribute of ours: the former one, or a new one beside any of the user's."""
    attribute = mesh.attributes.get(former) if former else None
    if attribute is not None and attribute.data_type == kind and attribute.domain == domain:
        return former
    index = mesh.attributes.active_index
    name = mesh.attributes.new(name, kind, domain).name
    mesh.attributes.active_index = index
    return name


def _remove(mesh, name):
    attribute = mesh.attributes.get(name) if name else None
    if attribute is not None:
        active = mesh.attributes.active
        former = active.name if active else ""
        mesh.attributes.remove(attribute)
        if former in mesh.attributes:
            mesh.attributes.active = mesh.attributes[former]


def add_face_attribute(obj):
    """Make the attribute with each face's part number, unless it is there."""
    result = obj.data.reeb_parts
    result.face_attribute = _add(obj.data, result.face_attribute, FACE_ATTRIBUTE, "INT", "FACE")


def remove_face_attribute(obj):
    """Remove the attribute with each face's part number."""
    _remove(obj.data, obj.data.reeb_parts.face_attribute)
    obj.data.reeb_parts.face_attribute = ""


def add_field(obj):
    """Make the attribute with the distance field, unless it is there."""
    result = obj.data.reeb_parts
    result.field_attribute = _add(obj.data, result.field_attribute, FIELD_ATTRIBUTE, "FLOAT", "POINT")


def remove_field(obj):
    """Remove the attribute with the distance field."""
    _remove(obj.data, obj.data.reeb_parts.field_attribute)
    obj.data.reeb_parts.field_attribute = ""


def add_colors(obj):
    """Make the colour attribute active, for the viewport and for rendering; remember what was."""
    mesh = obj.data
    result = mesh.reeb_parts
    if result.color_attribute in mesh.color_attributes:
        return
    result.former_color = mesh.attributes.active_color_name or ""
    result.former_render_color = mesh.attributes.default_color_name or ""
    result.color_attribute = _add(mesh, "", COLOR_ATTRIBUTE, "BYTE_COLOR", "CORNER")
    mesh.attributes.active_color_name = result.color_attribute
    mesh.attributes.default_color_name = result.color_attribute


def remove_colors(obj):
    """Remove the colour attribute; what was active before is active again."""
    mesh = obj.data
    result = mesh.reeb_parts
    ours = result.color_attribute
    if ours in mesh.color_attributes:
        # Somebody may have chosen another one since: then that stays.
        if mesh.attributes.active_color_name == ours:
            mesh.attributes.active_color_name = result.former_color
        if mesh.attributes.default_color_name == ours:
            mesh.attributes.default_color_name = result.former_render_color
        _remove(mesh, ours)
    result.color_attribute = result.former_color = result.former_render_color = ""


def color_faces(mesh, numbers, colors, changed=None):
    """Write the colours of parts into our colour attribute, if it is there.

    Parameters
    ----------
    mesh : bpy.types.Mesh
    numbers : (p,) int64
        The part of each face.
    colors : (count, 4) float32
        By number, see store.number_colors.
    changed : (k,) int, optional
        The only faces that are coloured otherwise than before.
    """
    attribute = mesh.attributes.get(mesh.reeb_parts.color_attribute)
    if attribute is None:
        return
    _, face = mesh_arrays.face_corners(mesh)
    if changed is not None and len(changed) <= FEW * len(numbers):
        _color_few(attribute, face, changed, colors[numbers[changed]].tolist())
    elif len(face) < MANY or not _color_many(mesh, attribute, numbers, colors):
        attribute.data.foreach_set("color_srgb", _spread(colors, numbers[face]))


def _color_few(attribute, face, changed, shades):
    """Colour the corners of some faces one by one."""
    first, end = np.searchsorted(face, changed), np.searchsorted(face, changed, side="right")
    for low, high, shade in zip(first.tolist(), end.tolist(), shades, strict=True):
        for corner in range(low, high):
            attribute.data[corner].color_srgb = shade


def _color_many(mesh, attribute, numbers, colors) -> bool:
    """Colour faces, and let Blender make byte colours of the corners of that: three times as fast as to set them.

    Whether that was done: Blender's operator evaluates the scene, which modifiers make slow.
    """
    users = [obj for obj in bpy.data.objects if obj.data == mesh]
    if not users or any(obj.modifiers for obj in users):
        return False
    name, chosen = attribute.name, (mesh.attributes.active_color_name, mesh.attributes.default_color_name)
    active = mesh.attributes.active.name if mesh.attributes.active else ""
    exact = [(*linear(color), 1.0) for color in (np.floor(255.0 * colors[:, :3] + 0.5) / 255.0).tolist()]
    made = mesh.attributes.new(name, "FLOAT_COLOR", "FACE").name
    done = False
    try:
        mesh.attributes[made].data.foreach_set("color", _spread(exact, numbers))
        mesh.attributes.active = mesh.attributes[made]
        with bpy.context.temp_override(object=users[0], active_object=users[0]):
            done = "FINISHED" in bpy.ops.geometry.attribute_convert(
                mode="GENERIC", domain="CORNER", data_type="BYTE_COLOR")
    except RuntimeError:  # not in this context
        pass
    finally:
        mesh.attributes.remove(mesh.attributes[name if done else made])
        if done:
            mesh.attributes[made].name = name
        mesh.attributes.active = mesh.attributes.get(active)
        mesh.attributes.active_color_name, mesh.attributes.default_color_name = chosen
    return done


def _spread(colors, index) -> np.ndarray:
    """The colours of an index, four values each, in a row, float32."""
    # A colour as one number of sixteen bytes is copied four times as fast as a row.
    whole = np.ascontiguousarray(colors, np.float32).view(np.complex128)[:, 0]
    return whole[index].view(np.float32)


# Face sets


def add_face_sets(obj):
    """Put our face sets where the user's were; those are kept aside."""
    mesh = obj.data
    result = mesh.reeb_parts
    if result.has_face_sets and FACE_SETS in mesh.attributes:
        return
    result.had_face_sets = FACE_SETS in mesh.attributes
    if result.had_face_sets:
        _keep_aside(mesh, mesh.attributes[FACE_SETS].data, "value", _FORMER_FACE_SETS, "INT", "FACE")
    else:
        _add(mesh, "", FACE_SETS, "INT", "FACE")
    result.has_face_sets = True


def remove_face_sets(obj):
    """Bring the user's face sets back, or none."""
    mesh = obj.data
    result = mesh.reeb_parts
    if result.has_face_sets:
        if result.had_face_sets and _FORMER_FACE_SETS in mesh.attributes:
            _bring_back(mesh, lambda: mesh.attributes[FACE_SETS].data, "value", _FORMER_FACE_SETS)
        else:
            _remove(mesh, FACE_SETS)
    result.has_face_sets = result.had_face_sets = False


# Materials


def add_materials(obj):
    """Keep aside which material slot each face uses."""
    mesh = obj.data
    result = mesh.reeb_parts
    if not result.has_materials:
        result.had_material_index = _MATERIAL_INDEX in mesh.attributes
        _keep_aside(mesh, mesh.polygons, "material_index", _FORMER_MATERIALS, "INT", "FACE")
        result.has_materials = True


def remove_materials(obj):
    """Remove our materials and their slots; each face uses the slot it used before."""
    mesh = obj.data
    result = mesh.reeb_parts
    for part in result.parts:
        _remove_material(mesh, part.material)
    if result.has_materials and _FORMER_MATERIALS in mesh.attributes:
        _bring_back(mesh, lambda: mesh.polygons, "material_index", _FORMER_MATERIALS)
        if not result.had_material_index:
            _remove(mesh, _MATERIAL_INDEX)
    result.has_materials = result.had_material_index = False


def _remove_material(mesh, material):
    if material is None:
        return
    for index in reversed(range(len(mesh.materials))):
        if mesh.materials[index] == material:
            mesh.materials.pop(index=index)
    if not len(mesh.materials):
        mesh.materials.clear()  # popping the last one leaves an empty slot on the objects
    for part in mesh.reeb_parts.parts:
        if part.material == material:
            part.material = None
    if material.users == 0:
        bpy.data.materials.remove(material)


def _write_materials(mesh, numbered):
    """A material and a slot for each part, in the part's colour."""
    slots = np.zeros(numbered.parts.count, np.int32)
    for label, part in enumerate(mesh.reeb_parts.parts):
        if part.material is None:
            part.material = bpy.data.materials.new(part.name)
            if bpy.app.version < (5, 0):  # newer ones always do
                part.material.use_nodes = True
        _color_material(part.material, linear(part.color))
        if part.material not in mesh.materials[:]:
            mesh.materials.append(part.material)
        slots[label] = mesh.materials.find(part.material.name)
    mesh.polygons.foreach_set("material_index", slots[numbered.parts.labels])


def _color_material(material, color):
    material.diffuse_color = (*color, 1.0)
    for node in material.node_tree.nodes:
        if node.type == "BSDF_PRINCIPLED":
            node.inputs["Base Color"].default_value = (*color, 1.0)


def linear(color) -> list:
    """sRGB, which lists and vertex colours use, as what objects and materials are coloured with."""
    return [c / 12.92 if c <= 0.04045 else ((c + 0.055) / 1.055) ** 2.4 for c in color]


# Seams


def add_seams(obj):
    """Keep aside which seams the user has."""
    mesh = obj.data
    result = mesh.reeb_parts
    if not result.has_seams:
        result.had_seams = _seam_name(mesh) is not None
        _keep_aside(mesh, mesh.edges, "use_seam", _FORMER_SEAMS, "BOOLEAN", "EDGE")
        result.has_seams = True


def remove_seams(obj):
    """Leave the user's seams alone again."""
    mesh = obj.data
    result = mesh.reeb_parts
    if result.has_seams and _FORMER_SEAMS in mesh.attributes:
        _bring_back(mesh, lambda: mesh.edges, "use_seam", _FORMER_SEAMS)
        if not result.had_seams and (name := _seam_name(mesh)):
            _remove(mesh, name)
    result.has_seams = result.had_seams = False


def _seam_name(mesh):
    """The attribute that holds seams, None before there is one."""
    return next((name for name in (".uv_seam", "uv_seam") if name in mesh.attributes), None)


def _write_seams(mesh, numbers):
    seams = np.empty(len(mesh.edges), bool)
    mesh.attributes[_FORMER_SEAMS].data.foreach_get("value", seams)
    mesh.edges.foreach_set("use_seam", seams | mesh_arrays.cut_edges(mesh, numbers))


# What was there before


def _keep_aside(mesh, items, key, name, kind, domain):
    """Copy a value of each element into a hidden attribute."""
    values = np.empty(len(items), bool if kind == "BOOLEAN" else np.int32)
    items.foreach_get(key, values)
    _remove(mesh, name)
    name = _add(mesh, "", name, kind, domain)
    mesh.attributes[name].data.foreach_set("value", values)


def _bring_back(mesh, items, key, name):
    """Copy a hidden attribute back to where it came from, and remove it."""
    attribute = mesh.attributes[name]
    values = np.empty(len(attribute.data), bool if attribute.data_type == "BOOLEAN" else np.int32)
    attribute.data.foreach_get("value", values)
    items().foreach_set(key, values)
    _remove(mesh, name)

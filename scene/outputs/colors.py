# SPDX-License-Identifier: GPL-3.0-or-later
"""The colors of the parts as a color attribute."""

from __future__ import annotations

import bpy
import numpy as np

from ...core.uses.colors import linear
from .. import targets
from ..modes import call_with
from ..reading import mesh_arrays
from ..result import part_names
from .kept_aside import add_attribute, remove_attribute

NAME = "Reeb Parts"

# Up to this share of the faces, their corners one by one cost less than all corners at once: Blender sets
# byte colors slowly.
FEW = 0.01

# From so many corners on, Blender's operator that converts colors is worth calling.
MANY = 200_000


def find(mesh: bpy.types.Mesh) -> bpy.types.Attribute | None:
    """The color attribute; None if it is gone, or was converted since into something else than colors of corners."""
    attribute = mesh.color_attributes.get(mesh.reeb_parts.color_attribute)
    return attribute if attribute is not None and attribute.domain == "CORNER" else None


def add(obj: bpy.types.Object) -> None:
    """Make the color attribute active, for the viewport and for rendering; remember what was."""
    mesh = obj.data
    result = mesh.reeb_parts
    if find(mesh):
        return
    result.former_color = mesh.attributes.active_color_name or ""
    result.former_render_color = mesh.attributes.default_color_name or ""
    result.color_attribute = add_attribute(mesh, "", NAME, "BYTE_COLOR", "CORNER")
    mesh.attributes.active_color_name = result.color_attribute
    mesh.attributes.default_color_name = result.color_attribute


def remove(obj: bpy.types.Object) -> None:
    """Remove the color attribute; what was active before is active again."""
    mesh = obj.data
    result = mesh.reeb_parts
    ours = result.color_attribute
    if ours in mesh.color_attributes:
        # If the user has chosen another one since, that stays.
        if mesh.attributes.active_color_name == ours:
            mesh.attributes.active_color_name = result.former_color
        if mesh.attributes.default_color_name == ours:
            mesh.attributes.default_color_name = result.former_render_color
        remove_attribute(mesh, ours)
    result.color_attribute = result.former_color = result.former_render_color = ""


def hand_over_painted(mesh: bpy.types.Mesh) -> str:
    """Let our color attribute be the user's once it was painted on; Object Mode.

    Blender paints on it, as it is the active one. Of a mesh that has other counts than it was decomposed with it is not
    told: edits mix colors of neighbors, which looks like paint.

    Returns the name of the attribute that stays, or "".
    """
    attribute, result = find(mesh), mesh.reeb_parts
    if attribute is None or (len(mesh.vertices), len(mesh.polygons)) != (result.n_vertices, result.n_faces):
        return ""
    ours = _bytes(part_names.number_colors(mesh))
    if np.isin(_bytes(mesh_arrays.read(attribute.data, "color_srgb", np.float32, 4)), ours).all():
        return ""
    name = result.color_attribute
    result.color_attribute = result.former_color = result.former_render_color = ""
    return name


def _bytes(colors: np.ndarray) -> np.ndarray:
    """Colors as Blender stores them, each as one number, (k,) uint32. colors : (k, 4) float32."""
    stored = np.floor(255.0 * np.clip(colors, 0.0, 1.0) + 0.5).astype(np.uint8)
    return np.ascontiguousarray(stored).view(np.uint32)[:, 0]


def write(mesh: bpy.types.Mesh, numbers: np.ndarray, colors: np.ndarray, changed: np.ndarray | None = None) -> None:
    """Write the colors of parts into our color attribute, if it is there.

    Parameters
    ----------
    mesh : bpy.types.Mesh
    numbers : (p,) int64
        The part of each face.
    colors : (count, 4) float32
        By number, see part_names.number_colors.
    changed : (k,) int, optional
        The only faces that are colored otherwise than before.
    """
    attribute = find(mesh)
    if attribute is None:
        return
    _, face = mesh_arrays.face_corners(mesh)
    if changed is not None and len(changed) <= FEW * len(numbers):
        _write_few(attribute, face, changed, colors[numbers[changed]].tolist())
    elif len(face) < MANY or not _write_many(mesh, attribute, numbers, colors):
        attribute.data.foreach_set("color_srgb", _spread(colors, numbers[face]))


def _write_few(attribute: bpy.types.Attribute, face: np.ndarray, changed: np.ndarray,
               shades: list[list[float]]) -> None:
    """Color the corners of some faces one by one."""
    first, end = np.searchsorted(face, changed), np.searchsorted(face, changed, side="right")
    for low, high, shade in zip(first.tolist(), end.tolist(), shades, strict=True):
        for corner in range(low, high):
            attribute.data[corner].color_srgb = shade


def _write_many(mesh: bpy.types.Mesh, attribute: bpy.types.Attribute, numbers: np.ndarray, colors: np.ndarray) -> bool:
    """Color faces, and let Blender make byte colors of the corners of that: three times as fast as to set them.

    Whether that was done: Blender's operator evaluates the scene, which modifiers make slow.
    """
    users = targets.users(mesh)
    if not users or any(obj.modifiers for obj in users):
        return False
    name, chosen = attribute.name, (mesh.attributes.active_color_name, mesh.attributes.default_color_name)
    active = mesh.attributes.active.name if mesh.attributes.active else ""
    exact = np.column_stack([linear(np.floor(255.0 * colors[:, :3] + 0.5) / 255.0), np.ones(len(colors))])
    made = mesh.attributes.new(name, "FLOAT_COLOR", "FACE").name
    done = False
    try:
        mesh.attributes[made].data.foreach_set("color", _spread(exact, numbers))
        mesh.attributes.active = mesh.attributes[made]
        done = "FINISHED" in call_with(bpy.ops.geometry.attribute_convert, users[0], mode="GENERIC", domain="CORNER",
                                       data_type="BYTE_COLOR")
    except RuntimeError:  # not in this context
        pass
    finally:
        mesh.attributes.remove(mesh.attributes[name if done else made])
        if done:
            mesh.attributes[made].name = name
        mesh.attributes.active = mesh.attributes.get(active)
        mesh.attributes.active_color_name, mesh.attributes.default_color_name = chosen
    return done


def _spread(colors: np.ndarray, index: np.ndarray) -> np.ndarray:
    """The colors of an index, four values each, in a row, float32."""
    # A color as one number of sixteen bytes is copied four times as fast as a row.
    whole = np.ascontiguousarray(colors, np.float32).view(np.complex128)[:, 0]
    return whole[index].view(np.float32)

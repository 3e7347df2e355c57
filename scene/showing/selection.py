# SPDX-License-Identifier: GPL-3.0-or-later
"""Which faces are selected or hidden, and which objects are selected."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

import bpy
import numpy as np

from .. import transaction
from ..reading import mesh_arrays


def selected_faces(mesh: bpy.types.Mesh) -> np.ndarray:
    """Whether each face is selected, (p,) bool; Object Mode."""
    return mesh_arrays.element_values(mesh, "polygons", "select")


def select_faces(mesh: bpy.types.Mesh, mask: np.ndarray, mode: str = "SET") -> None:
    """Select faces with their edges and vertices, and nothing else; Object Mode.

    mask : (p,) bool. mode : "SET", "ADD" or "SUBTRACT".
    """
    if mode == "ADD":
        mask = selected_faces(mesh) | mask
    elif mode == "SUBTRACT":
        mask = selected_faces(mesh) & ~mask
    edges, vertices = _touched(mesh, mask)
    _set_flags(mesh, "select", mask, edges, vertices)


def hidden_faces(mesh: bpy.types.Mesh) -> np.ndarray:
    """Whether each face is hidden, (p,) bool; Object Mode."""
    return mesh_arrays.element_values(mesh, "polygons", "hide")


def hidden_parts(mesh: bpy.types.Mesh, face_numbers: np.ndarray) -> list[int]:
    """Numbers of the parts of which every face is hidden. face_numbers : (p,) int64, the part of each face."""
    hidden = hidden_faces(mesh)
    if len(hidden) != len(face_numbers) or not hidden.any():
        return []
    return np.setdiff1d(face_numbers[hidden], face_numbers[~hidden]).tolist()


def hides_faces(mesh: bpy.types.Mesh) -> bool:
    """Whether some of a mesh may be hidden, at no cost; Object Mode."""
    return ".hide_poly" in mesh.attributes


def hide_faces(mesh: bpy.types.Mesh, mask: np.ndarray) -> None:
    """Hide faces, and the edges and vertices of no other face; Object Mode. mask : (p,) bool."""
    edges, vertices = _touched(mesh, ~mask)
    some = bool(mask.any())  # else loose edges and vertices are shown, too
    _set_flags(mesh, "hide", mask, ~edges & some, ~vertices & some)


def hidden_elements(mesh: bpy.types.Mesh) -> dict[str, np.ndarray]:
    """Whether each face, edge and vertex is hidden, by the name of the collection; Object Mode."""
    return {items: mesh_arrays.element_values(mesh, items, "hide") for items in ("polygons", "edges", "vertices")}


def hide_elements(mesh: bpy.types.Mesh, hidden: dict[str, np.ndarray]) -> None:
    """Hide what was hidden when ``hidden_elements`` was asked; Object Mode."""
    _set_flags(mesh, "hide", hidden["polygons"], hidden["edges"], hidden["vertices"])


def _touched(mesh: bpy.types.Mesh, mask: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """The edges and the vertices of some faces, (e,) and (v,) bool."""
    vertex, face = mesh_arrays.face_corners(mesh)
    vertices = np.zeros(len(mesh.vertices), bool)
    vertices[vertex[mask[face]]] = True
    return mesh_arrays.edges_of(mesh, mask), vertices


def _set_flags(mesh: bpy.types.Mesh, flag: str, faces: np.ndarray, edges: np.ndarray, vertices: np.ndarray) -> None:
    transaction.keep_mesh(mesh)
    for items, values in (("edges", edges), ("vertices", vertices), ("polygons", faces)):
        mesh_arrays.set_element_values(mesh, items, flag, values)
    mesh.update()


def select_objects(context: bpy.types.Context, objects: list[bpy.types.Object],
                   active: bpy.types.Object | None) -> None:
    """Select these objects and no others, and make one of them the active one, if any is given.

    What the view layer does not have, such as objects of a collection that is excluded, is left out.
    """
    for other in list(context.view_layer.objects.selected):
        other.select_set(False)
    there = set(context.view_layer.objects)
    for obj in objects:
        if obj in there:
            obj.select_set(True)
    if active is not None and in_layer(context.view_layer, active):
        context.view_layer.objects.active = active


def in_layer(layer: bpy.types.ViewLayer, obj: bpy.types.Object) -> bool:
    """Whether a view layer has an object; of an excluded collection it has none."""
    objects = layer.objects
    # A linked object may have the same name: then each is looked at.
    return objects.get(obj.name) == obj or any(other == obj for other in objects)


@contextmanager
def nothing_selected(layer: bpy.types.ViewLayer) -> Iterator[None]:
    """No object is selected for a while; afterwards the selection and the active object are the user's again."""
    active, selected = layer.objects.active, list(layer.objects.selected)
    for obj in selected:
        obj.select_set(False)
    try:
        yield
    finally:
        for obj in selected:
            obj.select_set(True)
        layer.objects.active = active

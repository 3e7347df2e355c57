# SPDX-License-Identifier: GPL-3.0-or-later
"""What is made of a model and its parts, as the bytes of files: JSON, labels, colored models, parts, pictures."""

from __future__ import annotations

import io
import re
from typing import TYPE_CHECKING, Any

import numpy as np

from .core.arrays.indexing import renumbered, stable_order
from .core.arrays.int64 import arange, cumsum
from .core.arrays.pairs import distinct_pairs
from .core.errors import ParameterError
from .core.file_names import file_name
from .core.mesh.arguments import whole_numbers
from .core.mesh.triangles import TriMesh
from .core.options import answer_text
from .core.result.decomposition import Decomposition
from .core.result.parts import Parts
from .core.sentence import Sentence
from .core.uses.colors import linear, part_colors
from .core.uses.pictures import picture, png
from .core.uses.report import bounding_boxes, document, report
from .meshes import face_colors
from .model_files import Model
from .rounding import Rounding

if TYPE_CHECKING:
    import trimesh

#: Kinds of files for labels, colored models and parts, by their suffixes.
LABELS = (".npy", ".txt", ".seg")
COLORED = (".ply", ".glb", ".obj")
PARTS = ("obj", "ply", "stl", "glb", "off")
# Pixels of each side of a picture; in larger ones than LARGEST_FINE no edge is smoothed, which would take four times
# as long and is hardly seen.
LARGEST_PICTURE, LARGEST_FINE = 4096, 2000


def json_bytes(result: dict[str, Any]) -> bytes:
    """A document as the bytes of a JSON file, the same as Blender's command writes."""
    return answer_text(result).encode()


def model_document(
    model: Model, result: Decomposition, parts: Parts, files: dict[str, Any] | None = None
) -> dict[str, Any]:
    """The JSON document of one model, by the schema of docs/json.md.

    files : what is written, by kind. Returns a dict.
    """
    import trimesh

    corner = np.repeat(parts.labels[model.polygon], 3)
    boxes = bounding_boxes(corner, model.vertices[model.faces].reshape(-1, 3), parts.count)
    made = document([report(result, parts, model.name, boxes=boxes)], files=files)
    made["versions"]["trimesh"] = trimesh.__version__
    return made


def labels_bytes(parts: Parts, kind: str) -> bytes:
    """The part of each face as a file.

    kind : str, of LABELS: NumPy's own, or a line for each face. Returns bytes.
    """
    if kind == ".npy":
        stream = io.BytesIO()
        np.save(stream, parts.labels)
        return stream.getvalue()
    return ("\n".join(map(str, parts.labels.tolist())) + "\n").encode()


def colored_bytes(model: Model, parts: Parts, kind: str) -> bytes:
    """The model in the colors of its parts as a file.

    kind : str, of COLORED. A .ply has a color and the number ``reeb_part``, from 1, on each face; a .glb has an object
    with a material for each part; an .obj has colors of vertices, and vertices on cuts once for each part. Returns
    bytes.
    """
    import trimesh

    label, rounding = parts.labels[model.polygon], Rounding.of(model)
    if kind == ".glb":
        scene = trimesh.Scene()
        colors = part_colors(parts.count, parts.cuts)
        for part, (vertices, faces) in enumerate(part_arrays(model, parts)):
            # Colors of materials are linear in this format.
            material = trimesh.visual.material.PBRMaterial(
                name=parts.names[part], baseColorFactor=[*linear(colors[part]), 1.0], metallicFactor=0.0,
                roughnessFactor=0.8)
            mesh = trimesh.Trimesh(vertices - rounding.origin, faces, process=False,
                                   visual=trimesh.visual.TextureVisuals(material=material))
            scene.add_geometry(mesh, node_name=parts.names[part], geom_name=parts.names[part],
                               transform=trimesh.transformations.translation_matrix(rounding.origin))
        return scene.export(file_type="glb")
    if kind == ".ply":
        mesh = trimesh.Trimesh(model.vertices, model.faces, process=False,
                               face_colors=face_colors(parts)[model.polygon],
                               face_attributes={"reeb_part": label.astype(np.int32) + 1})
        return _ply_bytes(mesh, rounding)
    pairs, corner = distinct_pairs(np.repeat(label, 3), model.faces.ravel())
    first = np.unique(label, return_index=True)[1]
    colors = face_colors(parts)[model.polygon][first][pairs[:, 0]]
    mesh = trimesh.Trimesh(model.vertices[pairs[:, 1]], corner.reshape(-1, 3), process=False, vertex_colors=colors)
    return mesh.export(file_type="obj", header=None, digits=rounding.digits("obj")).encode()


def part_arrays(model: Model, parts: Parts) -> list[tuple[np.ndarray, np.ndarray]]:
    """Vertices, (k, 3), and triangles, (t, 3), of each part."""
    label = parts.labels[model.polygon]
    order = stable_order(label)
    arrays = []
    for own in np.split(order, cumsum(np.bincount(label, minlength=parts.count))[:-1]):
        used, faces = renumbered(model.faces[own])
        arrays.append((model.vertices[used], faces))
    return arrays


def part_files(model: Model, parts: Parts, kind: str) -> dict[str, bytes]:
    """Each part as a file of its own: name of the file and its bytes.

    kind : str, of PARTS. Returns a dict of str -> bytes.
    """
    files, stem, rounding = {}, file_name(model.name, "model"), Rounding.of(model)
    for name, (vertices, faces) in zip(parts.names, part_arrays(model, parts), strict=True):
        files[f"{stem} {name}.{kind}"] = _part_bytes(vertices, faces, kind, rounding)
    return files


def _part_bytes(vertices: np.ndarray, faces: np.ndarray, kind: str, rounding: Rounding) -> bytes:
    """A part, (k, 3) and (t, 3), as a file of a kind of PARTS; all of a model are rounded alike, so that they fit."""
    import trimesh

    mesh = trimesh.Trimesh(vertices, faces, process=False)
    if kind == "ply":
        return _ply_bytes(mesh, rounding)
    if kind == "glb":
        scene = trimesh.Scene()
        mesh.vertices = vertices - rounding.origin
        scene.add_geometry(mesh, transform=trimesh.transformations.translation_matrix(rounding.origin))
        return scene.export(file_type=kind)
    if kind == "stl":
        return mesh.export(file_type=kind)
    return mesh.export(file_type=kind, digits=rounding.digits(kind)).encode()


def _ply_bytes(mesh: trimesh.Trimesh, rounding: Rounding) -> bytes:
    """A .ply with positions in double precision where single, all that trimesh writes, is not enough."""
    data = mesh.export(file_type="ply", vertex_normal=False)
    if rounding.single:
        return data
    head, end, body = data.partition(b"end_header\n")
    head = re.sub(rb"property float ([xyz])\b", rb"property double \1", head)
    positions = np.ascontiguousarray(mesh.vertices, "<f8").tobytes()
    return head + end + positions + body[len(positions) // 2 :]  # vertices come first, and have nothing else


def picture_bytes(model: Any, result: Decomposition, parts: Parts, size: int, graph: bool = True) -> bytes:
    """A PNG of the model in the colors of its parts, with the Reeb graph over it.

    Parameters
    ----------
    model : Model, or what another library calls a mesh
        With ``vertices`` and triangles as ``faces``; what says nothing of its upward axis is seen from its widest side.
    result : Decomposition
        Of this model.
    parts : Parts
        Of this result.
    size : int
        Width and height in pixels, 1 to LARGEST_PICTURE.
    graph : bool
        Whether the graph is drawn.

    Returns
    -------
    data : bytes

    Raises
    ------
    MeshError
        There is no mesh, or its arrays are wrong.
    ParameterError
        There is no such size, or the parts are those of another number of faces.
    """
    given = whole_numbers(size)
    if given is None or given.ndim or not 1 <= given <= LARGEST_PICTURE:
        raise ParameterError(Sentence("The size of a picture is a whole number of pixels, 1 to {most}, not {size}.",
                                      most=LARGEST_PICTURE, size=size), "size")
    mesh = TriMesh.of(model)
    polygon = getattr(model, "polygon", arange(mesh.n_faces))
    if int(polygon.max(initial=-1)) + 1 != len(parts.labels):
        raise ParameterError(Sentence("The parts are of {n} faces, the model has {faces}.", n=len(parts.labels),
                                      faces=int(polygon.max(initial=-1)) + 1), "parts")
    colors = part_colors(parts.count, parts.cuts)[parts.labels[polygon]]
    fine = 2 if given <= LARGEST_FINE else 1
    return png(picture(mesh, colors, int(given), getattr(model, "up", ""), result.graph if graph else None, fine))

# SPDX-License-Identifier: GPL-3.0-or-later
"""A picture of objects in their part colors with their Reeb graphs drawn over them, for command-line runs.

Everything is set up in a scene of its own and removed afterwards; the objects' own scene, materials and
render settings are left alone. Cycles on the processor renders, since that works on any machine.
"""

from __future__ import annotations

import os
import sys
import tempfile
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

import bmesh
import bpy
import numpy as np
from mathutils import Matrix, Vector
from scipy.ndimage import zoom

from ..core.arrays.vectors import box_diagonal
from ..scene.reading import mesh_arrays, placing
from ..scene.saving import file_checks
from ..scene.temporary import freed, removed


@dataclass(frozen=True)
class Layer:
    """One of the renders that the picture is put together from."""

    there: tuple[str, ...]  # the collections that are there
    seen: str  # the one of them that the camera sees
    coarseness: int = 1  # pixels of the picture along each side of a rendered one
    opacity: float = 1.0


#: Where the camera stands: in front (Blender's front is -Y), to the left and above.
VIEW = (-0.62, -1.0, 0.48)
BACKGROUND = (0.955, 0.957, 0.962)
#: Radii of the graph's tubes and balls, as shares of the extent of the model.
TUBE_RADIUS, BALL_RADIUS = 0.0042, 0.0115
#: From back to front. A soft shadow needs few pixels, and is by far the dearest to render.
LAYERS = (
    Layer(("floor", "model"), "floor", coarseness=4, opacity=0.6),
    Layer(("model",), "model"),
    Layer(("graph",), "graph"),
)
#: Opacity that the denoiser leaves on an empty floor.
HAZE = 0.06
ARC_COLOR = (0.012, 0.012, 0.016)
NODE_COLORS = {"minimum": (0.02, 0.02, 0.025), "saddle": (1.0, 0.62, 0.02), "maximum": (1.0, 1.0, 1.0)}


def view_from(degrees: float) -> Vector:
    """Direction from the objects to a camera turned about the vertical, (3,) float."""
    return Matrix.Rotation(np.radians(degrees), 3, "Z") @ Vector(VIEW)


def render_parts(objects: list[tuple[bpy.types.Object, bpy.types.Collection | None]], path: str | Path, *,
                 size: tuple[int, int] = (960, 540), samples: int = 16, view: Sequence[float] = VIEW) -> None:
    """Render objects and their graphs into a PNG file.

    Parameters
    ----------
    objects : list of (bpy.types.Object, bpy.types.Collection or None)
        Meshes with the color attribute that the decomposition wrote, shown whether hidden or not, each with
        the collection of its graph's curves and empties; None leaves the graph out.
    path : str or Path
        Where to write; the folder must exist.
    size : (2,) int
        Width and height in pixels.
    samples : int
        Light paths per pixel, before denoising.
    view : (3,) float
        Direction from the objects to the camera, in the world.

    Raises
    ------
    RuntimeError
        There is no room for the pictures that it is put together from.
    """
    bpy.context.view_layer.update()  # objects made just now do not know where they are
    scene = bpy.data.scenes.new("Reeb Parts picture")
    made = [scene]
    try:
        parts = {name: _collection(scene, name, made) for name in ("floor", "model", "graph")}
        shapes = [_points(obj) for obj, _ in objects]
        points = np.concatenate(shapes)
        # Around the origin: single precision is finest there, and the camera stands before it.
        middle = 0.5 * (points.min(axis=0) + points.max(axis=0))
        to_middle, points = Matrix.Translation(-Vector(middle)), points - middle
        extent = box_diagonal(points)
        for (obj, graph), shape in zip(objects, shapes, strict=True):
            _add_model(obj, to_middle, parts["model"], made)
            if graph is not None:
                # By the size of this one: where several stand far apart, a share of all would bury each.
                own = box_diagonal(shape)
                _add_graph(graph, to_middle, own, parts["graph"], made)
        _add_floor(points, extent, parts["floor"], made)
        _add_light(scene, view, made)
        _add_camera(scene, points, view, size, made)
        _set_up_cycles(scene, size, samples)
        with tempfile.TemporaryDirectory() as folder:
            layers = [_render(scene, parts, layer, Path(folder)) for layer in LAYERS]
        _write_png(_over(layers), path)
    finally:
        bpy.data.batch_remove(made)


def _collection(scene: bpy.types.Scene, name: str, made: list[bpy.types.ID]) -> bpy.types.Collection:
    """A new collection in the scene."""
    collection = bpy.data.collections.new(name)
    scene.collection.children.link(collection)
    made.append(collection)
    return collection


def _place(data: bpy.types.ID, name: str, collection: bpy.types.Collection, made: list[bpy.types.ID],
           matrix: Matrix | None = None) -> bpy.types.Object:
    """A new object in the collection, rendered even if its like in the user's scene is not."""
    obj = bpy.data.objects.new(name, data)
    placing.put(obj, matrix or Matrix())
    collection.objects.link(obj)
    made += [obj, data]
    return obj


def _add_model(obj: bpy.types.Object, moved: Matrix, collection: bpy.types.Collection,
               made: list[bpy.types.ID]) -> None:
    """The object's mesh in its part colors, moved from where it is."""
    mesh = obj.data.copy()
    name = mesh.color_attributes.active_color_name
    mesh.shade_smooth()
    mesh.set_sharp_from_angle(angle=0.8)
    mesh.materials.clear()
    mesh.materials.append(_material("parts", made, attribute=name))
    _place(mesh, "model", collection, made, moved @ placing.world_matrix(obj))


def _add_graph(graph: bpy.types.Collection, moved: Matrix, extent: float, collection: bpy.types.Collection,
               made: list[bpy.types.ID]) -> None:
    """Arcs as tubes and nodes as balls, both of a size that shows on a model of this extent, moved with it."""
    arcs = _material("arcs", made, color=ARC_COLOR)
    for source in graph.all_objects:
        if source.type == "CURVE":
            tubes = _tubes(source.data, moved @ placing.world_matrix(source), TUBE_RADIUS * extent, arcs)
            _place(tubes, "arcs", collection, made)
    materials = {kind: _material(kind, made, color=color) for kind, color in NODE_COLORS.items()}
    for source in graph.all_objects:
        if source.type == "EMPTY" and source.get("kind") in materials:
            ball = _ball(BALL_RADIUS * extent, materials[source["kind"]])
            _place(ball, "node", collection, made, Matrix.Translation(moved @ placing.world_matrix(source).translation))


def _tubes(arcs: bpy.types.Curve, matrix: Matrix, radius: float, material: bpy.types.Material) -> bpy.types.Curve:
    """A copy of the curve of the arcs as tubes of one radius, in the unit of the scene."""
    curve = arcs.copy()
    curve.transform(matrix)  # or the tubes would be as thick as the object is scaled
    curve.bevel_depth, curve.bevel_resolution, curve.use_fill_caps = radius, 3, True
    for spline in curve.splines:
        spline.points.foreach_set("radius", np.ones(len(spline.points), np.float32))
    curve.materials.clear()
    curve.materials.append(material)
    return curve


def _ball(radius: float, material: bpy.types.Material) -> bpy.types.Mesh:
    """A smooth ball about the origin."""
    ball = bpy.data.meshes.new("node")
    with freed(bmesh.new()) as bm:
        bmesh.ops.create_icosphere(bm, subdivisions=3, radius=radius)
        for face in bm.faces:
            face.smooth = True
        bm.to_mesh(ball)
    ball.materials.append(material)
    return ball


def _material(name: str, made: list[bpy.types.ID], *, attribute: str | None = None,
              color: tuple[float, float, float] = (0.8, 0.8, 0.8)) -> bpy.types.Material:
    """A matt material of one color or of a color attribute."""
    material = bpy.data.materials.new(name)
    _use_nodes(material)
    made.append(material)
    nodes, links = material.node_tree.nodes, material.node_tree.links
    shader = next(node for node in nodes if node.type == "BSDF_PRINCIPLED")
    shader.inputs["Roughness"].default_value = 0.65
    if attribute is None:
        shader.inputs["Base Color"].default_value = (*color, 1.0)
    else:
        source = nodes.new("ShaderNodeVertexColor")
        source.layer_name = attribute
        links.new(source.outputs["Color"], shader.inputs["Base Color"])
    return material


def _use_nodes(data: bpy.types.Material | bpy.types.World) -> None:
    """Give a material or a world its nodes; from Blender 5.0 it always has them."""
    if bpy.app.version < (5, 0, 0):
        data.use_nodes = True


def _add_light(scene: bpy.types.Scene, view: Sequence[float], made: list[bpy.types.ID]) -> None:
    """Even light from all sides and a soft sun, over the left shoulder of who looks."""
    world = bpy.data.worlds.new("sky")
    _use_nodes(world)
    world.node_tree.nodes["Background"].inputs["Color"].default_value = (1.0, 1.0, 1.0, 1.0)
    world.node_tree.nodes["Background"].inputs["Strength"].default_value = 0.75
    scene.world = world
    made.append(world)
    sun = bpy.data.lights.new("sun", "SUN")
    sun.energy, sun.angle = 1.9, 0.35
    across = Vector((view[0], view[1], 0.0)) if view[0] or view[1] else Vector((0.0, -1.0, 0.0))
    across.normalize()
    toward = 0.55 * across + 0.45 * Vector((across.y, -across.x, 0.0)) + Vector((0.0, 0.0, 1.0))
    turn = toward.to_track_quat("Z", "Y").to_matrix().to_4x4()
    _place(sun, "sun", scene.collection, made, turn)


def _add_floor(points: np.ndarray, extent: float, collection: bpy.types.Collection, made: list[bpy.types.ID]) -> None:
    """A floor under the points that shows nothing but the shadow on it."""
    floor = bpy.data.meshes.new("floor")
    center, reach = points.mean(axis=0), 20.0 * extent
    square = [(x * reach + center[0], y * reach + center[1], points[:, 2].min())
              for x, y in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
    floor.from_pydata(square, [], [(0, 1, 2, 3)])
    _place(floor, "floor", collection, made).is_shadow_catcher = True


def _points(obj: bpy.types.Object) -> np.ndarray:
    """Vertices of the object in the world, (n, 3)."""
    return placing.transformed(mesh_arrays.shown_points(obj), placing.world_matrix(obj))


def _add_camera(scene: bpy.types.Scene, points: np.ndarray, view: Sequence[float], size: tuple[int, int],
                made: list[bpy.types.ID]) -> None:
    """A camera that sees all points, as near as it can."""
    camera = bpy.data.cameras.new("camera")
    camera.lens = 70.0
    turn = Vector(view).to_track_quat("Z", "Y").to_matrix()
    margin = 1.08
    x, y, z = (points @ np.array(turn)).T
    # tan of half the angle of view, along the width and the height of the picture
    wide = 0.5 * camera.sensor_width / camera.lens
    half = np.array([1.0, size[1] / size[0]]) * wide / margin
    middle = [(x.max() + x.min()) / 2, (y.max() + y.min()) / 2]
    distance = max((z + np.abs(across - at) / tangent).max()
                   for across, at, tangent in zip((x, y), middle, half, strict=True))
    camera.clip_start = 1e-3 * (distance - z.max())
    camera.clip_end = 1e4 * distance
    position = turn @ Vector((*middle, distance))
    scene.camera = _place(camera, "camera", scene.collection, made, Matrix.LocRotScale(position, turn, None))


def _set_up_cycles(scene: bpy.types.Scene, size: tuple[int, int], samples: int) -> None:
    """A few samples on the processor, denoised where this build can, with transparent background."""
    import _cycles

    scene.render.engine = "CYCLES"
    scene.cycles.device = "CPU"
    scene.cycles.samples = samples
    scene.cycles.use_adaptive_sampling = False
    scene.cycles.max_bounces = 2
    scene.cycles.use_denoising = _cycles.with_openimagedenoise
    if _cycles.with_openimagedenoise:
        scene.cycles.denoiser = "OPENIMAGEDENOISE"
        scene.cycles.denoising_input_passes = "RGB"
        scene.cycles.denoising_prefilter = "NONE"
        if hasattr(scene.cycles, "denoising_quality"):  # from Blender 4.3
            scene.cycles.denoising_quality = "FAST"
    scene.render.resolution_x, scene.render.resolution_y = size
    scene.render.film_transparent = True
    scene.render.image_settings.file_format = "PNG"
    scene.render.image_settings.color_mode = "RGBA"
    # The colors of the parts, as the panel shows them: no filmic look.
    scene.view_settings.view_transform = "Standard"


def _render(scene: bpy.types.Scene, parts: dict[str, bpy.types.Collection], layer: Layer, folder: Path) -> np.ndarray:
    """Pixels of one layer of the picture, (height, width, 4), bottom row first."""
    for name, collection in parts.items():
        collection.hide_render = name not in layer.there
        for obj in collection.objects:
            obj.visible_camera = name == layer.seen
    scene.render.resolution_percentage = 100 // layer.coarseness
    scene.render.filepath = str(folder / f"{layer.seen}.png")
    with _silence():
        bpy.ops.render.render(write_still=True, scene=scene.name)
    if not file_checks.png(Path(scene.render.filepath)):
        raise RuntimeError(f"a layer of it does not fit into {folder.parent}, the folder for temporary files.")
    pixels = _read_png(scene.render.filepath)
    if layer.coarseness > 1:
        scale = (scene.render.resolution_y / len(pixels), scene.render.resolution_x / pixels.shape[1], 1)
        pixels = zoom(pixels, scale, order=1, mode="nearest", grid_mode=True)
        pixels[..., 3] = np.maximum(pixels[..., 3] - HAZE, 0.0) / (1.0 - HAZE)
    pixels[..., 3] *= layer.opacity
    return pixels


@contextmanager
def _silence() -> Iterator[None]:
    """Without what the renderer prints, a line for each of its steps."""
    sys.stdout.flush()
    kept = os.dup(1)
    nowhere = os.open(os.devnull, os.O_WRONLY)
    try:
        os.dup2(nowhere, 1)
        yield
    finally:
        os.dup2(kept, 1)
        os.close(kept)
        os.close(nowhere)


def _read_png(path: str) -> np.ndarray:
    """Pixels of a PNG file, (height, width, 4), bottom row first."""
    image = bpy.data.images.load(path)
    with removed(bpy.data.images, image):
        pixels = np.empty(4 * image.size[0] * image.size[1], np.float32)
        image.pixels.foreach_get(pixels)
        return pixels.reshape(image.size[1], image.size[0], 4)


def _over(layers: list[np.ndarray]) -> np.ndarray:
    """Layers from back to front upon the background, (height, width, 4)."""
    result = np.empty_like(layers[0])
    result[...] = (*BACKGROUND, 1.0)
    for layer in layers:
        alpha = layer[..., 3:]
        result[..., :3] = alpha * layer[..., :3] + (1.0 - alpha) * result[..., :3]
    return result


def _write_png(pixels: np.ndarray, path: str | Path) -> None:
    """Write (height, width, 4) pixels, bottom row first, as a PNG file."""
    height, width, _ = pixels.shape
    image = bpy.data.images.new("Reeb Parts picture", width, height)
    with removed(bpy.data.images, image):
        image.pixels.foreach_set(pixels.ravel())
        image.filepath_raw = str(path)
        image.file_format = "PNG"
        image.save()

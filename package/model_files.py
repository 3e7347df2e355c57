# SPDX-License-Identifier: GPL-3.0-or-later
"""Models read from files: by trimesh, and what only Blender reads by Blender."""

from __future__ import annotations

import io
import re
import subprocess
import tempfile
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from .core.errors import ReebError
from .core.sentence import Sentence

#: Files that Blender alone can read, see ``blender_export``.
BY_BLENDER = (".blend", ".fbx")
#: Files in which z is up by custom; y is in all others.
Z_UP = (".stl", ".ply", ".3mf", *BY_BLENDER)
ARRAYS = ".npz"  # the arrays ``vertices`` and ``faces``, as NumPy stores them


class ModelFileError(ReebError, OSError):
    """A model cannot be read; the message says why."""


class NoReaderError(ModelFileError):
    """What reads files of this kind is not there, though it may be another time."""


@dataclass(frozen=True, eq=False)
class Model:
    """A model as it was read from a file: all its meshes, in the places that its scene gives them.

    Attributes
    ----------
    name : str
        Of the file, without its suffix.
    vertices : (n, 3) float64
        Positions, in the units and along the axes of the file.
    faces : (m, 3) int64
        Triangles; in the order of the file, polygons cut into triangles.
    polygon : (m,) int64
        Face to which each triangle belongs. Where the reader cuts polygons itself, each triangle is a face.
    up : str
        "y" or "z", the axis that is up in files of its kind.
    """

    name: str
    vertices: np.ndarray
    faces: np.ndarray
    polygon: np.ndarray
    up: str = "y"


def formats() -> tuple[str, ...]:
    """Suffixes of the files that can be read without Blender, with their dots."""
    from trimesh.exchange.load import mesh_formats

    return (*sorted(f".{name}" for name in mesh_formats() if name != "stl_ascii"), ARRAYS)


def read_model(path: str | Path, blender: str | Path | None = None) -> Model:
    """Read a model.

    Parameters
    ----------
    path : str or Path
        A file of a kind in ``formats()``, or one that Blender reads.
    blender : str or Path, optional
        A Blender, to read .blend and .fbx.

    Returns
    -------
    model : Model

    Raises
    ------
    ModelFileError
        There is no such file, it is damaged, or it has no faces.
    NoReaderError
        It is of a kind that nothing here reads; of those that Blender reads, without one.
    """
    path = Path(path)
    kind = path.suffix.lower()
    if not path.is_file():
        raise ModelFileError(Sentence("There is no file {path}.", path=path))
    if kind in BY_BLENDER:
        return _read_by_blender(path, blender)
    if kind not in formats():
        known = ", ".join((*formats(), *BY_BLENDER))
        raise NoReaderError(Sentence("{path} is none of {known}.", path=path, known=known))
    try:
        vertices, faces = _read_arrays(path) if kind == ARRAYS else _read_by_trimesh(path)
    except MemoryError:
        raise
    except Exception as error:  # noqa: BLE001 - whatever a reader of damaged files raises
        raise _unreadable(path, error) from error
    if not len(faces):
        raise ModelFileError(Sentence("There is no mesh in {path}.", path=path))
    return Model(path.stem, vertices, faces, np.arange(len(faces)), "z" if kind in Z_UP else "y")


def _read_arrays(path: Path) -> tuple[np.ndarray, np.ndarray]:
    """Vertices and triangles of NumPy's own file."""
    with np.load(path, allow_pickle=False) as data:
        return data["vertices"].astype(np.float64), data["faces"].astype(np.int64)


def _read_by_trimesh(path: Path) -> tuple[np.ndarray, np.ndarray]:
    """Vertices and triangles of all meshes of a file, in its order."""
    import trimesh

    # Neither cleaned nor split at texture seams: labels are for the faces that are in the file.
    options = {"process": False, "maintain_order": True}
    if path.suffix.lower() == ".obj":
        # Materials and groups would sort the faces.
        plain = re.sub(rb"(?m)^[ \t]*(usemtl|mtllib|g|o|s)\b.*$", b"", path.read_bytes())
        scene = trimesh.load_scene(io.BytesIO(plain), file_type="obj", **options)
    else:
        scene = trimesh.load_scene(path, **options)
    meshes = [mesh for mesh in scene.dump() if isinstance(mesh, trimesh.Trimesh)]
    first = np.cumsum([0, *(len(mesh.vertices) for mesh in meshes)])
    faces = [mesh.faces + start for mesh, start in zip(meshes, first, strict=False)]
    return (np.concatenate([np.empty((0, 3)), *(mesh.vertices for mesh in meshes)]),
            np.concatenate([np.empty((0, 3), np.int64), *faces]))


def _read_by_blender(path: Path, blender: str | Path | None) -> Model:
    """Model of a file that a Blender reads; z is up then."""
    if blender is None:
        raise NoReaderError(Sentence("{path} can be read by Blender only. Say where it is with --blender.", path=path))
    script = Path(__file__).with_name("blender_export.py")
    with tempfile.TemporaryDirectory(prefix="reeb_parts_") as folder:
        out = Path(folder) / "model.npz"
        command = [str(blender), "--background", "--factory-startup", "--python-exit-code", "1", "--python",
                   str(script), "--", str(path.resolve()), str(out)]
        try:
            try:
                done = subprocess.run(command, stdin=subprocess.DEVNULL, capture_output=True, text=True,
                                      errors="replace", check=False)
            except OSError as error:
                raise NoReaderError(Sentence("{path} could not be read, as {blender} could not be started: {reason}",
                                             path=path, blender=blender, reason=error.strerror or error)) from error
            if done.returncode or not out.is_file():
                raise RuntimeError((done.stderr.strip() or done.stdout.strip()).splitlines()[-1:])
            with np.load(out, allow_pickle=False) as data:
                return Model(path.stem, data["vertices"], data["triangles"], data["polygon"], "z")
        except NoReaderError:
            raise
        except (OSError, RuntimeError, ValueError, KeyError) as error:
            raise _unreadable(path, error) from error


def _unreadable(path: Path, error: Exception) -> ModelFileError:
    """The sentence that a file could not be read."""
    reason = " ".join(f"{type(error).__name__}: {error}".split())[:300]
    return ModelFileError(Sentence("{path} could not be read: {reason}", path=path, reason=reason))

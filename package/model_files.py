# SPDX-License-Identifier: GPL-3.0-or-later
"""Models read from files: .obj, .ply, .stl, .off and arrays here, by Blender what only it reads, others by trimesh."""

from __future__ import annotations

import io
import os
import re
import signal
import stat
import subprocess
import tempfile
from collections.abc import Callable
from dataclasses import dataclass
from importlib.resources import as_file, files
from pathlib import Path
from typing import Any
from urllib.parse import unquote

import numpy as np

from .core.arrays.int64 import arange, cumsum
from .core.atomic_files import HIDDEN
from .core.errors import ReebError, wrong_kind
from .core.fbx_nodes import is_believable
from .core.file_names import LONGEST_IN_BLENDER, is_too_long_for_blender, kind_of, readable
from .core.memory import lacks_memory
from .core.mesh.arguments import corners, positions
from .core.mesh.ears import fans, without_folds
from .core.mesh.triangles import check_corners
from .core.sentence import Sentence
from .damaged_files import DamagedFileError, read_by
from .gltf_checks import is_packed, read_header, unread
from .obj_files import parse_obj
from .off_files import parse_off
from .ply_files import ASCII, read_ply
from .polygons_in_files import NO_PLACES, NOT_THERE, plain_text
from .stl_files import parse_stl

#: Files that Blender alone can read, see ``blender_export``.
BY_BLENDER = (".blend", ".fbx", ".usd", ".usda", ".usdc", ".usdz", ".abc")
#: Files in which z is up by custom; y is in all others, but of .dae, which say it.
Z_UP = (".stl", ".ply", ".3mf", *BY_BLENDER)
ARRAYS = ".npz"  # the arrays ``vertices`` and ``faces``, as NumPy stores them
_NO_ARRAYS = Sentence("it has no arrays of numbers vertices and faces.")
# What trimesh counts among the files of meshes: another name for .stl, and points without faces.
_OTHERS = {"stl_ascii", "xyz"}
_UP_IS_Z = re.compile(rb"<up_axis>\s*Z_UP\s*</up_axis>")
_HEAD = 2**20  # bytes of a .dae in which it says so: before all numbers


class ModelFileError(ReebError, OSError):
    """A model cannot be read; the message says why."""


class NoReaderError(ModelFileError):
    """What reads files of this kind is not there, though it may be another time."""


class CrashedReaderError(ModelFileError):
    """A Blender that was to read a model ended in the middle of it."""


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
        Triangles, of vertices that are there; in the order of the file, polygons cut into triangles.
    polygon : (m,) int64
        Face of the file to which each triangle belongs; in files other than .obj, .ply, .off, .npz and those that
        Blender reads, whose readers cut polygons themselves, each triangle is a face.
    up : str
        "y" or "z", the axis that is up in files of its kind; of .dae, which say it, in the file.
    """

    name: str
    vertices: np.ndarray
    faces: np.ndarray
    polygon: np.ndarray
    up: str = "y"

    def __repr__(self) -> str:
        return f"<Model {self.name}: {len(self.vertices)} vertices, {len(self.faces)} triangles, {self.up} up>"


def formats() -> tuple[str, ...]:
    """Suffixes of the files that can be read without Blender, with their dots."""
    from trimesh.exchange.load import mesh_formats

    return (*sorted(f".{name}" for name in mesh_formats() if name not in _OTHERS), ARRAYS)


def read_model(path: str | Path, blender: str | Path | None = None, temporary: str | Path | None = None) -> Model:
    """Read a model.

    Parameters
    ----------
    path : str or Path
        A file of a kind in ``formats()``, or one that Blender reads.
    blender : str or Path, optional
        A Blender, to read what only it can: ``BY_BLENDER``.
    temporary : str or Path, optional
        Folder for the temporary files of that; the system's own without.

    Returns
    -------
    model : Model

    Raises
    ------
    ParameterError
        ``path`` is no path.
    ModelFileError
        There is no such file, it is damaged, or it has no faces.
    NoReaderError
        It is of a kind that nothing here reads; of those that Blender reads, without one that can.
    CrashedReaderError
        The Blender that read it crashed.
    MemoryError
        There is not enough memory, here or for that Blender.
    """
    try:
        path = Path(path)
    except TypeError:
        raise wrong_kind("path", "the name of a file", path) from None
    kind = path.suffix.lower()
    _check_is_file(path)
    if kind in BY_BLENDER:
        vertices, faces, polygon = _read_by_blender(path, blender, temporary)
    elif kind in formats():
        vertices, faces, polygon = _read_itself(path)
    else:
        known = ", ".join((*formats(), *BY_BLENDER))
        raise NoReaderError(Sentence("{path} is none of {known}.", path=path, known=known))
    if not len(faces):
        raise ModelFileError(Sentence("There is no mesh in {path}.", path=path))
    return Model(readable(path.stem), vertices, faces, polygon, "z" if kind in Z_UP or _says_z(path) else "y")


def _says_z(path: Path) -> bool:
    """Whether a file is a .dae that says of itself that z is up, as Blender writes them."""
    if path.suffix.lower() != ".dae":
        return False
    with path.open("rb") as file:
        return _UP_IS_Z.search(plain_text(file.read(_HEAD))) is not None


def _check_is_file(path: Path) -> None:
    """Raise ModelFileError unless there is a file."""
    try:
        kind = kind_of(path)
        check_ends(path)
    except ModelFileError:
        raise
    except OSError as error:  # such as a folder that one may not enter
        raise _unreadable(path, error.strerror or str(error)) from error
    if stat.S_ISDIR(kind):
        raise ModelFileError(Sentence("{path} is a folder, not a model.", path=path))
    if not kind:
        raise ModelFileError(Sentence("There is no file {path}.", path=path))


def check_ends(path: Path) -> None:
    """Raise ModelFileError for a pipe or a device: who opens one may wait for ever. OSError as ``kind_of``."""
    if kind_of(path) not in (0, stat.S_IFREG, stat.S_IFDIR):
        raise ModelFileError(Sentence("{path} is no file but a pipe or a device: write the model to a file first.",
                                      path=path))


def _read_itself(path: Path) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Vertices, triangles and their polygons of a file that needs no Blender; raises ModelFileError."""
    reader = _READERS.get(path.suffix.lower(), _read_by_trimesh)
    try:
        return reader(path)
    except (MemoryError, NoReaderError):
        raise
    except ReebError as error:  # of the arrays in it
        raise _unreadable(path, str(error)) from error
    except ImportError as error:
        raise NoReaderError(Sentence("{path} needs a package that is not there ({reason}). What most files need comes "
                                     'with pip install "reeb-parts[formats]".', path=path, reason=error)) from error
    except OSError as error:
        # Of a file that the model names, say which.
        other = error.filename and os.path.basename(error.filename) != path.name
        raise _unreadable(path, f"{error.strerror}: {error.filename}" if other else str(error.strerror)) from error


def _read_arrays(path: Path) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Vertices, triangles and their polygons of NumPy's own file, whose faces may have any one number of corners."""
    # NumPy would leave a damaged file open that it has opened itself.
    with path.open("rb") as file:
        if file.read(2) != b"PK":  # or it would be taken for Python's own objects
            raise ReebError(_NO_ARRAYS)
        file.seek(0)
        with read_by("NumPy"), np.load(file, allow_pickle=False) as data:
            try:
                vertices, faces = data["vertices"], data["faces"]
            except (KeyError, ValueError) as error:  # there are none, or they are Python's own objects
                raise ReebError(_NO_ARRAYS) from error
    points, (corner, sizes) = positions(vertices).astype(np.float64), corners(faces)
    if points.shape[1:] != (3,):
        raise ReebError(Sentence("vertices must have shape (n, 3), not {shape}.", shape=points.shape))
    if few := int((sizes < 3).sum()):
        raise ReebError(Sentence("{n} {n:face has|faces have} fewer than three corners.", n=few))
    triangles, polygon = fans(corner, sizes)
    check_corners(triangles, len(points), polygon)
    return points, without_folds(points, triangles, sizes), polygon


def _read_ply(path: Path) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Vertices, triangles and their polygons of a .ply."""
    from plyfile import PlyHeaderParseError

    try:
        return read_ply(path)
    except PlyHeaderParseError:  # trimesh knows more types of numbers
        return _read_by_trimesh(path)


def _read_gltf(path: Path) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Vertices, triangles and their polygons of a .glb or .gltf; raises NoReaderError where some would be missing."""
    header = read_header(path)
    try:
        name = unread(header)
    except (LookupError, TypeError, AttributeError) as error:
        raise DamagedFileError(Sentence("its description of a scene lacks something, or has something else in its "
                                        "place ({words})", words=f"{type(error).__name__}: {error}")) from error
    if name:
        raise NoReaderError(Sentence("{path} has {name}, which nothing here reads. Save it without, or as a .blend or "
                                     ".fbx, which Blender reads with --blender.", path=path, name=name))
    return _read_by_trimesh(path, is_packed(header))


def _read_dae(path: Path) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Vertices, triangles and their polygons of a .dae; raises DamagedFileError where some is.

    trimesh would leave out such meshes, and those whose materials are damaged, and keeps no list of them: the file is
    read twice.
    """
    import collada

    with path.open("rb") as file, read_by("pycollada"):
        read = collada.Collada(file, ignore=[collada.common.DaeError])
    for error in read.errors:
        if not isinstance(error, collada.common.DaeUnsupportedError):  # such as a kind of light
            raise DamagedFileError(Sentence("a part of it is damaged ({words})", words=error.msg))
    return _read_by_trimesh(path)


#: What reads vertices, triangles and their polygons of a file.
_Reader = Callable[[Path], tuple[np.ndarray, np.ndarray, np.ndarray]]


def _by_bytes(parse: Callable[[bytes], tuple[np.ndarray, np.ndarray, np.ndarray]]) -> _Reader:
    """What reads files by the function that parses their bytes."""
    return lambda path: parse(path.read_bytes())


#: What reads files of a kind; trimesh all others.
_READERS: dict[str, _Reader] = {
    ARRAYS: _read_arrays, ".dae": _read_dae, ".glb": _read_gltf, ".gltf": _read_gltf, ".obj": _by_bytes(parse_obj),
    ".off": _by_bytes(parse_off), ".ply": _read_ply, ".stl": _by_bytes(parse_stl)}


def _plain(data: bytes, kind: str) -> bytes:
    """The bytes of a file of a kind without what trimesh would stumble over, though it does not matter."""
    if kind == ".gltf":
        return plain_text(data)  # without the mark with which some editors begin a file
    return _plain_ply(data) if kind == ".ply" else data


def _plain_ply(data: bytes) -> bytes:
    """The bytes of a .ply; if its text is not UTF-8, with question marks for all of it that is not ASCII.

    Names and comments in the encoding of some country do not matter, but trimesh would not read on.
    """
    end = data.find(b"end_header")
    # All is text unless the second line says that the rest is binary.
    n_text = end if end > 0 and re.match(rb"[^\n]*\n[^\n]*binary", data) else len(data)
    try:
        data[:n_text].decode()
    except UnicodeDecodeError:
        return data[:n_text].translate(ASCII) + data[n_text:]
    return data


def _read_by_trimesh(path: Path, packed: bool = False) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Vertices and triangles of all meshes of a file, in its order, each a polygon.

    packed : whether some are compressed by Draco.
    """
    import trimesh

    class Resolver(trimesh.resolvers.FilePathResolver):
        """What finds the files that a file names: glTF has their names as addresses, with %20 for a space."""

        def get(self, name: str) -> Any:
            try:
                return super().get(name)
            except FileNotFoundError:
                return super().get(unquote(name))

    # It takes names of meshes from that of the file, and not every one is UTF-8.
    resolver = Resolver(path)
    resolver.file_name = readable(path.name)
    with io.BytesIO(_plain(path.read_bytes(), path.suffix.lower())) as stream, read_by("trimesh"):
        # Neither cleaned nor split at texture seams: labels are for the faces that are in the file.
        scene = trimesh.load_scene(stream, path.suffix[1:].lower(), resolver, process=False, maintain_order=True)
        meshes = [mesh for mesh in scene.dump() if isinstance(mesh, trimesh.Trimesh)]
    if any(mesh.vertices.shape[1:] != (3,) for mesh in meshes):
        raise DamagedFileError(NO_PLACES)
    # What is damaged, and with older versions of trimesh all of it, is zeros: only a warning says so.
    if packed and any(len(mesh.vertices) and not np.ptp(mesh.vertices, axis=0).any() for mesh in meshes):
        raise DamagedFileError(Sentence("what Draco has compressed in it cannot be unpacked: it is damaged, or the "
                                        "package trimesh is too old for it"))
    first = cumsum([0, *(len(mesh.vertices) for mesh in meshes)])
    # Some of its versions have none in one dimension.
    faces = [mesh.faces.reshape(-1, 3) + start for mesh, start in zip(meshes, first, strict=False)]
    vertices = np.concatenate([np.empty((0, 3)), *(mesh.vertices for mesh in meshes)])
    triangles = np.concatenate([np.empty((0, 3), np.int64), *faces])
    # Added to the number of its mesh's first vertex, one that is not there could be a vertex of the next mesh.
    if any(((mesh.faces < 0) | (mesh.faces >= len(mesh.vertices))).any() for mesh in meshes):
        raise DamagedFileError(NOT_THERE)
    return vertices, triangles, arange(len(triangles))


def _read_by_blender(path: Path, blender: str | Path | None,
                     temporary: str | Path | None) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Vertices, triangles and their polygons of a file that a Blender reads; raises ModelFileError."""
    if blender is None:
        raise NoReaderError(Sentence("{path} can be read by Blender only. Say where it is with --blender, in "
                                     "Python with blender=.", path=path))
    if is_too_long_for_blender(path):
        raise _unreadable(path, f"Blender takes names of up to {LONGEST_IN_BLENDER} bytes, with all folders")
    _check_nodes(path)
    exporter = files(__package__) / "blender_export.py"
    with tempfile.TemporaryDirectory(prefix=HIDDEN, dir=temporary) as folder, as_file(exporter) as script:
        out = Path(folder) / "model.npz"
        command = [str(blender), "--background", "--factory-startup", "--python-exit-code", "1", "--python",
                   str(script), "--", str(path.resolve()), str(out)]
        # What Blender itself leaves there, should it be killed, is found with the folder.
        variables = {**os.environ, **dict.fromkeys(("TMPDIR", "TEMP", "TMP"), folder)}
        try:
            done = subprocess.run(command, stdin=subprocess.DEVNULL, capture_output=True, text=True,
                                  errors="replace", check=False, env=variables)
        except OSError as error:
            raise NoReaderError(Sentence("{path} could not be read, as {blender} could not be started: {reason}",
                                         path=path, blender=blender, reason=error.strerror or error)) from error
        if done.returncode and lacks_memory(done.stderr + done.stdout):
            raise MemoryError
        if done.returncode < 0:
            raise CrashedReaderError(Sentence("{path} could not be read, as {blender} crashed: {reason}", path=path,
                                              blender=blender, reason=signal.strsignal(-done.returncode)))
        if (lacks := out.with_suffix(".none")).is_file():
            raise NoReaderError(Sentence("{path} could not be read: {reason}", path=path,
                                         reason=lacks.read_text(encoding="utf-8")))
        if done.returncode or not out.is_file():
            raise _unreadable(path, _complaint(out, done, blender))
        try:
            with np.load(out, allow_pickle=False) as data:
                return data["vertices"], data["triangles"], data["polygon"]
        except (OSError, ValueError, KeyError) as error:
            raise _unreadable(path, f"{type(error).__name__}: {error}") from error


def _check_nodes(path: Path) -> None:
    """Raise ModelFileError for an .fbx at which a Blender would take all memory."""
    try:
        damaged = path.suffix.lower() == ".fbx" and not is_believable(path)
    except OSError as error:
        raise _unreadable(path, error.strerror or str(error)) from error
    if damaged:
        raise _unreadable(path, "it is damaged or cut short")


def _complaint(out: Path, done: subprocess.CompletedProcess[str], blender: str | Path) -> str:
    """Why a Blender has written nothing: what its script says, else its last words."""
    said = out.with_suffix(".txt")
    words = said.read_text(encoding="utf-8") if said.is_file() else done.stderr.strip() or done.stdout.strip()
    lines = [line.strip() for line in words.splitlines() if line.strip() and not line.startswith("Location: ")]
    if not lines:
        return f"{blender} ended with status {done.returncode} and said nothing"
    # What its operators in Python report ends with the error itself.
    return lines[-1].removeprefix("Error: ").removesuffix(", see console for detail")


def _unreadable(path: Path, reason: str) -> ModelFileError:
    """The sentence that a file could not be read."""
    return ModelFileError(Sentence("{path} could not be read: {reason}", path=path,
                                   reason=" ".join(reason.split())[:300]))

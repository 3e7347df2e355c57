# SPDX-License-Identifier: GPL-3.0-or-later
"""A result as bytes, and back. A stored result is input like any other: bounded reading, checks of everything in it.

The bytes are an .npz file, which may be damaged, made by hand, or written by another version.
"""

from __future__ import annotations

import io
import json
import re
import zipfile
import zlib
from dataclasses import asdict, fields
from typing import Any, NamedTuple

import numpy as np

from ..arrays.components import components
from ..errors import ParameterError, ReebError
from ..graph.reeb import ReebGraph
from ..parameters import SEPARATE, Parameters, present_names
from ..sentence import Sentence
from ..version import VERSION

# Items that any other array has at most, per face and vertex, and on any mesh.
PER_ELEMENT, AT_LEAST = 200, 100_000
MAX_HEAD = 4_000_000  # bytes
FORMAT = 1  # version of the layout that ``write`` writes

#: The attributes of a ``Decomposition`` that are arrays.
TABLES = ("candidates", "vertex_candidates", "candidate_area", "candidate_pairs",
          "candidate_pair_length", "field", "node_candidate", "point_candidate", "contacts", "mirror",
          "face_twin", "face_side", "links", "junctions", "junction_length")
# All arrays that ``write`` writes.
_STORED = (*TABLES, "hierarchy.merges", "hierarchy.salience", *(f"graph.{f.name}" for f in fields(ReebGraph)))
_UNKNOWN_TO_0_1_0: dict[str, np.ndarray] = {
    "contacts": np.empty((0, 2), np.int64), "mirror": np.empty(0), "face_twin": np.empty(0, np.int64),
    "face_side": np.empty(0, np.int8), "links": np.empty((0, 2), np.int64),
    "junctions": np.empty((0, 2), np.int64), "junction_length": np.empty(0)}


class DamagedError(ReebError):
    """A stored result cannot be read, or its numbers do not fit each other."""

    def __init__(self, message: str = Sentence("The stored parts are damaged. Decompose again.")) -> None:
        super().__init__(message)


class NewerError(ReebError):
    """A stored result was written by a version that knows more than this one."""


class StoredResult(NamedTuple):
    """What is stored of a result, in the order in which ``Decomposition.from_arrays`` takes it.

    Attributes
    ----------
    arrays : dict of str -> array
        Those that ``Decomposition.to_arrays`` gives.
    parameters : Parameters
    notes : tuple of str
    seconds : dict of str -> float
    version : str
        Of the product that wrote it.
    """

    arrays: dict[str, np.ndarray]
    parameters: Parameters
    notes: tuple[str, ...]
    seconds: dict[str, float]
    version: str


def write(arrays: dict[str, np.ndarray], parameters: Parameters, notes: tuple[str, ...], seconds: dict[str, float],
          version: str) -> bytes:
    """Write a result, given as ``StoredResult`` has it: returns compressed bytes that ``read`` reads."""
    head = {"format": FORMAT, "parameters": asdict(parameters), "notes": notes, "seconds": seconds, "version": version}
    stream = io.BytesIO()
    # As np.savez_compressed would, but in a quarter of its time for a fourteenth more bytes.
    with zipfile.ZipFile(stream, "w", zipfile.ZIP_DEFLATED, compresslevel=1) as archive:
        for name, array in (arrays | {"head": np.frombuffer(json.dumps(head).encode(), np.uint8)}).items():
            with archive.open(f"{name}.npy", "w", force_zip64=True) as file:
                np.lib.format.write_array(file, array, allow_pickle=False)
    return stream.getvalue()


def read(data: bytes, counts: tuple[int, int] | None = None) -> StoredResult:
    """Read a result that ``write`` wrote, in this version or an earlier one.

    Parameters, and what is raised, are those of ``Decomposition.from_bytes``.
    """
    arrays = _read_archive(data, ("head", *_STORED), counts)
    head = _read_head(arrays.pop("head", None))
    for name, array in _UNKNOWN_TO_0_1_0.items():
        arrays.setdefault(name, array)
    _check(arrays, counts)
    arrays["graph.node_kind"] = arrays["graph.node_kind"].astype(np.int8)
    arrays["face_side"] = arrays["face_side"].astype(np.int8)
    arrays["candidate_pair_length"] = arrays["candidate_pair_length"].astype(np.float64)
    return StoredResult(arrays, _parameters(head["parameters"], head["version"]), tuple(head["notes"]),
                        head["seconds"], head["version"])


def _parameters(values: dict, version: str) -> Parameters:
    """Parameters of a stored result; version 0.1.0 had other names for some, and neither bodies nor symmetry."""
    try:
        return Parameters(**{"pieces": SEPARATE, "symmetry": False} | present_names(values)[0])
    except ParameterError as error:  # one that this version does not know, or a value that it does not
        raise (_newer(version) if is_newer(version, VERSION) else DamagedError()) from error


def _read_archive(data: bytes, names: tuple[str, ...], counts: tuple[int, int] | None) -> dict[str, np.ndarray]:
    """Read the arrays of an .npz file, none larger than such a result can have.

    Parameters
    ----------
    data : bytes
    names : tuple of str
        Arrays to read if they are there; others are left alone.
    counts : (int, int) or None
        Numbers of vertices and faces, if they are known.

    Returns
    -------
    arrays : dict of str -> array
        Of whole numbers as int64, of others as float64; "head" as uint8.

    Raises
    ------
    DamagedError
    """
    try:
        with zipfile.ZipFile(io.BytesIO(data)) as archive:
            infos = {info.filename.removesuffix(".npy"): info for info in archive.infolist()}
            n, p = counts or (_length(archive, infos["vertex_candidates"]), _length(archive, infos["candidates"]))
            most = 8 * (PER_ELEMENT * (n + p) + AT_LEAST)
            size = {"head": MAX_HEAD, "candidates": 8 * p, "vertex_candidates": 8 * n, "field": 8 * n}
            found = {name: _read_array(archive, infos[name], size.get(name, most)) for name in names if name in infos}
    except (zipfile.BadZipFile, zlib.error, EOFError, OSError, ValueError, KeyError, TypeError, NotImplementedError,
            RuntimeError, OverflowError, SyntaxError, MemoryError) as error:
        raise DamagedError from error
    return {name: _plain(array, name) for name, array in found.items()}


def _read_array(archive: zipfile.ZipFile, info: zipfile.ZipInfo, most: int) -> np.ndarray:
    """An array of an .npz file, of no more than so many bytes; raises what NumPy and zipfile do, or DamagedError."""
    if info.file_size > most + 1024:  # some bytes of a header come before the values
        raise DamagedError
    with archive.open(info) as file:
        return np.lib.format.read_array(io.BytesIO(file.read()), allow_pickle=False)


def _length(archive: zipfile.ZipFile, info: zipfile.ZipInfo) -> int:
    """Length of a stored array, by its header."""
    with archive.open(info) as file:
        version = np.lib.format.read_magic(file)
        read = np.lib.format.read_array_header_1_0 if version == (1, 0) else np.lib.format.read_array_header_2_0
        (length,), _, _ = read(file)
    return length


def _plain(array: np.ndarray, name: str) -> np.ndarray:
    """Whole numbers as int64, others as float64; raises DamagedError for what is neither."""
    if array.dtype.kind not in "iuf":
        raise DamagedError
    if name == "head":
        return array
    return array.astype(np.int64 if array.dtype.kind in "iu" else np.float64)


def _read_head(array: np.ndarray | None) -> dict[str, Any]:
    """Read what stands beside the arrays.

    Parameters
    ----------
    array : (k,) uint8 or None
        JSON.

    Returns
    -------
    head : dict
        With format, parameters, notes, seconds and version.

    Raises
    ------
    DamagedError
    NewerError
        The format is another one, and the version newer than this one.
    ReebError
        The format is another one.
    """
    try:
        if array is None or array.dtype != np.uint8:
            raise DamagedError
        head = json.loads(array.tobytes())
        version, layout = head["version"], head["format"]
        if type(layout) is not int or not isinstance(version, str):
            raise DamagedError
        if layout != FORMAT:
            if is_newer(version, VERSION):
                raise _newer(version)
            raise ReebError(Sentence("The stored parts were written by another version. Decompose again."))
        texts = all(isinstance(note, str) for note in head["notes"])
        times = all(isinstance(time, (int, float)) for time in head["seconds"].values())
        if not texts or not times or not isinstance(head["parameters"], dict):
            raise DamagedError
    except (ValueError, KeyError, TypeError, AttributeError, RecursionError) as error:
        raise DamagedError from error
    return head


def _newer(version: str) -> NewerError:
    """The error that says which version wrote a result."""
    return NewerError(Sentence("The stored parts were written by Reeb Parts {version}, which is newer than this one. "
                               "Install that version, or decompose again.", version=version[:20]))


def is_newer(version: str, than: str) -> bool:
    """Whether a version, three numbers, is newer than another one."""
    one, other = ([int(number) for number in re.findall(r"\d{1,9}", text)[:3]] for text in (version, than))
    return one > other


def _check(arrays: dict[str, np.ndarray], counts: tuple[int, int] | None) -> None:
    """Raise DamagedError unless the arrays of a result fit each other.

    arrays : as ``Decomposition.to_bytes`` stores them. counts : numbers of vertices and faces, if they are known.
    """
    try:
        fits = _fits(arrays, counts)
    except (KeyError, ValueError, IndexError, TypeError) as error:
        raise DamagedError from error
    if not fits:
        raise DamagedError


def _fits(a: dict[str, np.ndarray], counts: tuple[int, int] | None) -> bool:
    """Whether shapes, kinds, ranges and structure are those of a result."""
    (n,), (p,), (c,) = a["vertex_candidates"].shape, a["candidates"].shape, a["candidate_area"].shape
    return (
        counts in (None, (n, p)) and p > 0 and c > 0
        and all(_is_whole(a[name], *limits) for name, limits in _whole_numbers(a).items())
        and all(_is_real(a[name], shape, name != "field") for name, shape in _real_numbers(a).items())
        and bool(np.bincount(a["candidates"], minlength=c).all()) and bool((a["candidate_area"] >= 0).all())
        and 0 < a["candidate_area"].sum() < np.inf
        and bool((a["junctions"] < (len(a["junction_length"]), c)).all())
        # The merges are a forest, and the points of the arcs follow each other.
        and components(c, *a["hierarchy.merges"].T)[0] == c - len(a["hierarchy.merges"])
        and a["graph.arc_points"][0] == 0 and a["graph.arc_points"][-1] == len(a["graph.point_value"])
        and bool((np.diff(a["graph.arc_points"]) > 0).all())
    )


def _whole_numbers(a: dict[str, np.ndarray]) -> dict[str, tuple[tuple[int, ...], int, int]]:
    """Of each array of whole numbers the shape, the lowest value, and the first that is too high."""
    (n,), (p,), (c,) = a["vertex_candidates"].shape, a["candidates"].shape, a["candidate_area"].shape
    (k,), (r,) = a["graph.node_kind"].shape, a["graph.point_value"].shape
    s, q, e, t = (len(a[name]) for name in ("hierarchy.merges", "graph.arcs", "candidate_pairs", "contacts"))
    mirrored = p if len(a["mirror"]) or len(a["face_twin"]) else 0
    m, j = len(a["junctions"]), len(a["junction_length"])
    return {
        "candidates": ((p,), 0, c), "vertex_candidates": ((n,), -1, c), "candidate_pairs": ((e, 2), 0, c),
        "node_candidate": ((k,), 0, c), "point_candidate": ((r,), 0, c), "contacts": ((t, 2), 0, p),
        "links": ((len(a["links"]), 2), 0, p),
        "hierarchy.merges": ((s, 2), 0, c), "graph.node_kind": ((k,), 0, 3), "graph.arcs": ((q, 2), 0, k),
        "face_twin": ((mirrored,), -1, p), "face_side": ((mirrored,), -1, 2),
        "junctions": ((m, 2), 0, max(j, c)), "graph.arc_points": ((q + 1,), 0, r + 1),
        "graph.n_components": ((), 0, k + 1),
    }


def _real_numbers(a: dict[str, np.ndarray]) -> dict[str, tuple[int, ...]]:
    """The shape of each array of other numbers."""
    (n,), (c,) = a["vertex_candidates"].shape, a["candidate_area"].shape
    (k,), (r,) = a["graph.node_kind"].shape, a["graph.point_value"].shape
    return {
        "candidate_area": (c,), "candidate_pair_length": (len(a["candidate_pairs"]),),
        "hierarchy.salience": (len(a["hierarchy.merges"]),), "graph.node_value": (k,), "graph.node_position": (k, 3),
        "graph.point_position": (r, 3), "graph.point_radius": (r,), "graph.point_length": (r,),
        "graph.point_value": (r,), "field": (n,), "mirror": (4 if len(a["mirror"]) else 0,),
        "junction_length": (len(a["junction_length"]),),
    }


def _is_whole(array: np.ndarray, shape: tuple[int, ...], low: int, high: int) -> bool:
    """Whether an array has a shape and holds whole numbers from ``low`` on and below ``high``."""
    return array.shape == shape and array.dtype.kind == "i" and bool(((array >= low) & (array < high)).all())


def _is_real(array: np.ndarray, shape: tuple[int, ...], finite: bool) -> bool:
    """Whether an array has a shape and holds numbers that are finite, if they have to be, not all of them whole."""
    # Where nothing touches, 0.1.0 wrote the lengths, of which there are none, as whole numbers.
    real = array.dtype.kind == "f" or not array.size
    return array.shape == shape and real and (not finite or bool(np.isfinite(array).all()))

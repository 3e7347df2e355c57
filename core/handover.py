# SPDX-License-Identifier: GPL-3.0-or-later
"""What two processes hand each other: shapes one way, results or errors the other way.

Arrays go as files of NumPy in a folder that nobody else can read, all else as JSON; nothing is pickled, so reading runs
no code. A result arrives bit by bit as it was made.
"""

from __future__ import annotations

import json
import shutil
import time
import zipfile
from dataclasses import asdict
from pathlib import Path
from typing import Any

import numpy as np

from . import errors
from .errors import ReebError
from .parameters import Parameters
from .result.decomposition import Decomposition
from .sentence import Sentence

#: What errors carry besides their sentence, each as an attribute and as an argument of its class.
_CARRIED = ("vertices", "faces", "name")
#: Names of the arrays of a shape.
_SHAPE = ("vertices", "triangles", "polygon", "mirror", "hints")


def write_request(folder: Path, shapes: list[tuple[np.ndarray, ...]], parameters: Parameters) -> None:
    """Write what is to be decomposed.

    Parameters
    ----------
    folder : Path
    shapes : list of (vertices, triangles, polygon, mirror, hints)
        As ``decompose`` takes them; the last two are empty for none.
    parameters : Parameters

    Raises
    ------
    OSError
        The files cannot be written.
    """
    for number, arrays in enumerate(shapes):
        _write(folder / f"shape_{number}.npz", dict(zip(_SHAPE, arrays, strict=True)))
    request = {"shapes": len(shapes), "parameters": asdict(parameters)}
    (folder / "request.json").write_text(json.dumps(request), encoding="utf-8")


def read_request(folder: Path) -> tuple[int, Parameters]:
    """Number of shapes in the folder, and the parameters for all of them."""
    request = json.loads((folder / "request.json").read_text(encoding="utf-8"))
    return request["shapes"], Parameters(**request["parameters"])


def read_shape(folder: Path, number: int) -> tuple[np.ndarray, ...]:
    """Vertices, triangles, polygons, mirror plane and hints of a shape."""
    arrays = _arrays(folder / f"shape_{number}.npz")
    return tuple(arrays[name] for name in _SHAPE)


def arguments(shape: tuple[np.ndarray, ...]) -> dict[str, np.ndarray | None]:
    """What ``decompose`` is called with for a shape, of arrays as ``write_request`` takes them."""
    vertices, triangles, polygon, mirror, hints = shape
    return {"vertices": vertices, "faces": triangles, "polygon": polygon, "mirror": mirror if len(mirror) else None,
            "hints": hints if len(hints) else None}


def write_result(folder: Path, number: int, result: Decomposition) -> None:
    """Write the result for a shape; raises OSError if it cannot be written."""
    head = {"parameters": asdict(result.parameters), "notes": [plain_sentence(note) for note in result.notes],
            "seconds": result.seconds, "version": result.version}
    _write(folder / f"result_{number}.npz", result.to_arrays())
    (folder / f"result_{number}.json").write_text(json.dumps(head), encoding="utf-8")


def read_result(folder: Path, number: int) -> Decomposition:
    """Read the result for a shape.

    Raises
    ------
    OSError
        It is not there, or not all of it.
    """
    try:
        head = json.loads((folder / f"result_{number}.json").read_text(encoding="utf-8"))
        arrays = _arrays(folder / f"result_{number}.npz")
    except (zipfile.BadZipFile, EOFError, ValueError) as error:
        raise OSError(f"result {number} is damaged") from error
    notes = tuple(sentence_of(note) for note in head["notes"])
    return Decomposition.from_arrays(arrays, Parameters(**head["parameters"]), notes, head["seconds"], head["version"])


def remove(folder: Path) -> None:
    """Remove the folder of a request, if that can be done.

    On Windows a process that has just ended, or a virus scanner, may hold files a moment longer.
    """
    for pause in (0.02, 0.1, 0.5, 0.0):
        shutil.rmtree(folder, ignore_errors=True)
        if not folder.exists():
            return
        time.sleep(pause)


def _arrays(path: Path) -> dict[str, np.ndarray]:
    """All arrays of a file."""
    with np.load(path, allow_pickle=False) as file:
        return {name: file[name] for name in file.files}


def _write(path: Path, arrays: dict[str, np.ndarray]) -> None:
    """Write arrays by their names; raises OSError if they cannot be written."""
    np.savez(path, **arrays)  # type: ignore[arg-type]  # none of them is called as an option of savez is


def plain_error(error: ReebError) -> dict[str, Any]:
    """An error as what JSON can hold: its class, its sentence, and what else it carries."""
    carried = {name: np.asarray(getattr(error, name)).tolist() for name in _CARRIED if hasattr(error, name)}
    return {"kind": type(error).__name__, "sentence": plain_sentence(error.args[0]), "carried": carried}


def error_of(plain: dict[str, Any]) -> ReebError:
    """The error of ``plain_error``; one of a class that is not in ``errors`` comes back as a bare ReebError."""
    kind = getattr(errors, plain["kind"], None)
    sentence = sentence_of(plain["sentence"])
    return ReebError(sentence) if kind is None else kind(sentence, **plain["carried"])


def plain_sentence(text: str) -> dict[str, Any]:
    """A sentence as what JSON can hold; of its values, numbers and words as such, all else as its words."""
    if not isinstance(text, Sentence):
        return {"text": str(text)}
    return {"message": text.message, "values": {name: _plain_value(value) for name, value in text.values.items()}}


def _plain_value(value: object) -> object:
    """A value of a sentence that reads as before."""
    if isinstance(value, np.generic):
        value = value.item()
    return value if isinstance(value, (str, int, float)) else str(value)


def sentence_of(plain: dict[str, Any]) -> str:
    """The sentence of ``plain_sentence``, to be translated as before."""
    return Sentence(plain["message"], **plain["values"]) if "message" in plain else plain["text"]

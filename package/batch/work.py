# SPDX-License-Identifier: GPL-3.0-or-later
"""One model of a batch, from its file to the folder of its results."""

from __future__ import annotations

import time
import traceback
from contextlib import suppress
from pathlib import Path
from typing import Any

from ..core.errors import ReebError
from ..core.memory import lacks_memory
from ..core.result.decomposition import Decomposition
from ..core.result.parts import Parts
from ..core.sentence import Sentence
from ..core.uses.descriptors import part_descriptors
from ..meshes import decompose
from ..model_files import CrashedReaderError, Model, ModelFileError, NoReaderError, read_model
from ..output_files import OutputFileError, as_output_error
from ..outputs import colored_bytes, json_bytes, labels_bytes, model_document, part_files, picture_bytes
from ..rounding import Rounding
from .records import (
    CRASH,
    DONE,
    ERROR,
    FORMAT,
    READER,
    REFUSED,
    UNREADABLE,
    Settings,
    digest_of,
    failure,
    is_done,
    write_record,
)

#: What became of a model, by the first class here that an error is of.
_STATUS = {NoReaderError: READER, CrashedReaderError: CRASH, ModelFileError: UNREADABLE, ReebError: REFUSED}


def do_model(job: dict[str, Any]) -> dict[str, Any]:
    """Decompose a model and write its folder.

    Parameters
    ----------
    job : dict
        ``path`` of the model, its ``name``, the ``folder`` of its results, the ``settings``, ``blender``, the path of
        one or None, and ``retry``, see ``is_done``.

    Returns
    -------
    answer : dict
        ``status``, ``reason`` and ``seconds``; ``kept`` if it was done before: some time has passed since this job was
        given out, in which another run may have come to the model.

    Raises
    ------
    MemoryError
        There is not enough memory.
    """
    start = time.perf_counter()
    settings = Settings.from_dict(job["settings"])
    path, name = Path(job["path"]), job["name"]
    if is_done(path, Path(job["folder"]), settings, job["retry"], name):
        return {"status": DONE, "reason": "", "seconds": round(time.perf_counter() - start, 4), "kept": True}
    digest = ""
    try:
        digest = _digest(path)
        record, files = _results(job, settings)
    except MemoryError:
        raise
    except ReebError as error:
        status = next(status for kind, status in _STATUS.items() if isinstance(error, kind))
        record, files = failure(name, status, str(error), settings.digest), {}
    except Exception as error:  # it costs this model only, and its record says where it happened
        if lacks_memory(str(error)):
            raise MemoryError from error
        place = traceback.extract_tb(error.__traceback__)[-1]
        words = f"{type(error).__name__}: {error} ({Path(place.filename).name}, line {place.lineno})"
        record, files = failure(name, ERROR, words, settings.digest), {}
    record["digest"] = digest
    seconds = round(time.perf_counter() - start, 4)
    record["model"]["seconds"] = seconds
    try:
        with as_output_error(Path(job["folder"])):
            write_record(job, record, files)
    except OutputFileError as error:  # such as a full disk, which may have room for the record alone
        record = failure(name, ERROR, str(error), settings.digest, digest)
        with suppress(OSError):
            write_record(job, record)
    return {"status": record["status"], "reason": record["reason"], "seconds": seconds}


def _digest(path: Path) -> str:
    """The digest of a model's file; raises ModelFileError if there is none, as behind a link that leads nowhere."""
    try:
        return digest_of(path)
    except ModelFileError:
        raise
    except OSError as error:
        raise ModelFileError(Sentence("{path} could not be read: {reason}", path=path,
                                      reason=error.strerror or error)) from error


def _results(job: dict[str, Any], settings: Settings) -> tuple[dict[str, Any], dict[str, bytes]]:
    """The record of a model, and the files of its folder by name."""
    model = _model(job)
    result = decompose(model, parameters=settings.parameters)
    parts = result.parts()
    files = {"thumbnail.png": picture_bytes(model, result, parts, settings.thumbnail, graph=False)}
    if settings.labels:
        files[f"labels{settings.labels}"] = labels_bytes(parts, settings.labels)
    if settings.colored:
        files[f"colored{settings.colored}"] = colored_bytes(model, parts, settings.colored)
    if settings.parts:
        files |= {f"parts/{file}": data for file, data in part_files(model, parts, settings.parts).items()}
    document = model_document(model, result, parts)
    if settings.json:
        files["model.json"] = json_bytes(document)
    (entry,) = document["objects"]
    record = {"format": FORMAT, "name": job["name"], "status": DONE, "reason": "", "settings": settings.digest,
              "files": {file: len(files[file]) for file in sorted(files)},
              "model": _model_row(model, result, parts, settings), "parts": entry["parts"]}
    described = part_descriptors(model.vertices, model.faces, parts, model.polygon)
    for part, row in zip(record["parts"], described.round(6).tolist(), strict=True):
        part["descriptor"] = row
    return record, files


def _model(job: dict[str, Any]) -> Model:
    """The model of a job; raises ModelFileError."""
    if job["blender"] is None:
        return read_model(job["path"])
    # Below the folder of the results, where what a process leaves that is killed is removed.
    place = Path(job["folder"]).parent
    place.mkdir(parents=True, exist_ok=True)
    return read_model(job["path"], job["blender"], place)


def _model_row(model: Model, result: Decomposition, parts: Parts, settings: Settings) -> dict[str, Any]:
    """What the table of models has of one."""
    notes = result.notes + (Rounding.of(model).notes(settings.parts) if settings.parts else ())
    return {"vertices": result.n_vertices, "faces": result.n_faces, "n_parts": parts.count,
            "area": float(parts.area.sum()), "nodes": result.graph.n_nodes, "arcs": result.graph.n_arcs,
            "loops": int(result.graph.n_loops), "components": result.graph.n_components, "up": model.up,
            "notes": [str(note) for note in notes]}

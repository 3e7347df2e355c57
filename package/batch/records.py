# SPDX-License-Identifier: GPL-3.0-or-later
"""What is known of each model of a batch: a record in the folder of its results, which appears whole or not at all.

A model is done if its record is of the same bytes, of the same settings and of the same version of Reeb Parts.
"""

from __future__ import annotations

import hashlib
import json
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any
from urllib.parse import unquote

from ..core.file_names import readable, spelled
from ..core.parameters import Parameters
from ..core.version import VERSION
from ..gltf_checks import read_header
from ..model_files import check_ends
from ..output_files import write_folder

FORMAT = 1  # version of what a record holds
RECORD = "record.json"
KEYS = {"format", "name", "status", "reason", "settings", "digest", "files", "model", "parts"}  # of each record
#: What became of a model. The first three follow from the model: they would come out the same again.
DONE, REFUSED, UNREADABLE = "done", "refused", "unreadable"
READER, ERROR, MEMORY, TIME, CRASH, OPEN = "reader", "error", "memory", "time", "crash", "open"
FINAL = (DONE, REFUSED, UNREADABLE)


@dataclass(frozen=True)
class Settings:
    """What the results of a batch depend on besides the models.

    Attributes
    ----------
    parameters : Parameters
    json : bool
        Whether each model gets its JSON document.
    labels : str
        Suffix of the file of labels, "" for none.
    colored : str
        Suffix of the colored model, "" for none.
    parts : str
        Format of the files of single parts, "" for none.
    thumbnail : int
        Width and height of the picture in pixels.
    """

    parameters: Parameters
    json: bool = True
    labels: str = ".npy"
    colored: str = ""
    parts: str = ""
    thumbnail: int = 128

    def to_dict(self) -> dict[str, Any]:
        """As what JSON can hold."""
        return asdict(self)

    @classmethod
    def from_dict(cls, values: dict[str, Any]) -> Settings:
        """The settings of ``to_dict``."""
        return cls(**{**values, "parameters": Parameters(**values["parameters"])})

    @property
    def digest(self) -> str:
        """What two settings share only if all results are the same, the version of Reeb Parts included."""
        text = json.dumps([FORMAT, VERSION, self.to_dict()], sort_keys=True)
        return hashlib.sha256(text.encode()).hexdigest()


def digest_of(path: Path) -> str:
    """What two models share only if all their bytes are the same; raises OSError, for a pipe ModelFileError."""
    check_ends(path)
    total = hashlib.sha256()
    for file in files_of(path):
        with file.open("rb") as stream:
            total.update(hashlib.file_digest(stream, "sha256").digest())
    return total.hexdigest()


def files_of(path: Path) -> list[Path]:
    """A model's file, and those that it names: the numbers of a .gltf are in another."""
    if path.suffix.lower() != ".gltf":
        return [path]
    try:
        buffers = read_header(path).get("buffers", [])
        names = [unquote(buffer["uri"]) for buffer in buffers if not buffer.get("uri", "data:").startswith("data:")]
    except (ValueError, AttributeError, KeyError, TypeError):
        names = []  # whoever reads it will say so
    return [path, *(file for name in names if (file := path.parent / name).is_file())]


def read_record(folder: Path, name: str | None = None) -> dict[str, Any] | None:
    """The record in a folder; None if there is none, or none of the model of that name.

    Whoever renames a model, and the folder of its results with it, has a record of the former name there.
    """
    try:
        record = json.loads((folder / RECORD).read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return None
    known = isinstance(record, dict) and record.get("format") == FORMAT and record.keys() >= KEYS
    return record if known and isinstance(record["files"], dict) and name in (None, record["name"]) else None


def is_done(path: Path, folder: Path, settings: Settings, retry: bool = False, name: str | None = None) -> bool:
    """Whether the results of a model are there, all of them, of these bytes and settings.

    retry : bool, whether a model that failed is done only if it was decomposed. name : str, of the model in the batch.
    """
    record = read_record(folder, name)
    if record is None or record["status"] not in (FINAL[:1] if retry else FINAL):
        return False
    if record["settings"] != settings.digest or record["digest"] == "":
        return False
    try:
        # A power failure may leave a file without its end.
        whole = all((folder / spelled(name)).stat().st_size == size for name, size in record["files"].items())
        return whole and record["digest"] == digest_of(path)
    except OSError:
        return False


def failure(name: str, status: str, reason: str, settings: str, digest: str = "") -> dict[str, Any]:
    """The record of a model that could not be decomposed."""
    return {"format": FORMAT, "name": name, "status": status, "reason": readable(reason), "settings": settings,
            "digest": digest, "files": {}, "model": {}, "parts": []}


def write_record(job: dict[str, Any], record: dict[str, Any], files: dict[str, bytes] | None = None) -> None:
    """Write the folder of the model of a job: its record, and files by name; raises OSError."""
    write_folder(Path(job["folder"]), {**(files or {}), RECORD: json.dumps(record, allow_nan=False).encode()})


def record_of(name: str, folder: Path, settings: str) -> dict[str, Any]:
    """The record of a model, given its folder and the digest of the settings; one that says so if it is still open."""
    record = read_record(folder, name)
    if record is None:
        return failure(name, OPEN, "It was not reached.", settings)
    if record["settings"] != settings:  # of a run before, or of one at the same time
        return failure(name, OPEN, "What is there was made with other parameters or outputs, or by another version.",
                       settings)
    return record

# SPDX-License-Identifier: GPL-3.0-or-later
"""Parts of a batch that are like a given one, and a page of pictures of them."""

from __future__ import annotations

import html
import stat
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pyarrow as pa

from ..core.errors import ReebError
from ..core.file_names import kind_of, spelled
from ..core.mesh.triangles import TriMesh
from ..core.sentence import Sentence
from ..core.uses.descriptors import NAMES, distances
from ..core.uses.pictures import picture, png, png_address
from ..model_files import read_model
from ..outputs import LABELS
from .records import digest_of, read_record
from .sources import folder_of
from .tables import MODELS, PARTS, read_rows

COLUMNS = pa.schema([PARTS.field(name) for name in ("model", "number", "name", "share", "descriptor")])
PATHS = pa.schema([MODELS.field(name) for name in ("name", "path")])
FAR = 1e100  # no descriptor has such numbers
PART, REST = (0.9, 0.62, 0.0), (0.82, 0.83, 0.85)  # colors of the part and of the rest of its model

STYLE = """
body { font: 14px/1.4 system-ui, sans-serif; margin: 1.2em; color: #222; background: #fff }
main { display: grid; grid-template-columns: repeat(auto-fill, minmax(180px, 1fr)); gap: 12px }
figure { margin: 0; border: 1px solid #ddd; border-radius: 6px; padding: 8px }
figure img { display: block; margin: 0 auto } figcaption { font-size: 12px; overflow-wrap: anywhere }
figure:first-child { border-color: #0072b2; border-width: 2px }
"""


class PartError(ReebError):
    """There is no such part, or no table of parts."""


def similar_parts(out: Path, model: str, number: int, count: int, other_models: bool) -> list[dict[str, Any]]:
    """Find the parts of a batch that are most like one of them.

    Parameters
    ----------
    out : Path
        Folder of the results of a batch.
    model : str
        Name of a model there.
    number : int
        Number of one of its parts.
    count : int
        How many parts to find.
    other_models : bool
        Whether to leave out the other parts of the same model.

    Returns
    -------
    parts : list of dict
        ``model``, ``number``, ``name``, ``share`` and ``distance``, see ``core.uses.descriptors.distances``; the part
        itself first, with distance 0.

    Raises
    ------
    PartError
    """
    table = out / "parts.parquet"
    try:
        kind = kind_of(table)
    except OSError as error:  # such as a folder that one may not enter
        raise _unread(table, error) from error
    if not stat.S_ISREG(kind):
        raise PartError(Sentence("There is no table of parts in {out}: run reeb-parts batch first.", out=out))
    one = next((row for row in _rows(table, COLUMNS) if (row["model"], row["number"]) == (model, number)), None)
    if one is None:
        raise PartError(Sentence("There is no part {number} of a model {model} in {table}.", number=number,
                                 model=model, table=table))
    found: list[dict[str, Any]] = []
    rows: list[dict[str, Any]] = []
    for row in _rows(table, COLUMNS):
        if not (other_models and row["model"] == model) and (row["model"], row["number"]) != (model, number):
            rows.append(row)
        if len(rows) >= 10_000:  # a table can be larger than memory
            found, rows = _nearest(one, found, rows, count), []
    return [{**_plain(one), "distance": 0.0}, *_nearest(one, found, rows, count)]


def _rows(table: Path, columns: pa.Schema) -> Iterator[dict[str, Any]]:
    """Rows of a table; raises PartError where it is damaged, or of a version that had other columns."""
    try:
        for row in read_rows(table, columns):
            descriptor = row.get("descriptor", [0.0] * len(NAMES))
            if row.keys() != set(columns.names) or None in row.values() or len(descriptor) != len(NAMES):
                raise PartError(Sentence("{table} is of another version of Reeb Parts: run reeb-parts batch again.",
                                         table=table))
            if None in descriptor or not sum(map(abs, [*descriptor, row.get("share", 0.0)])) < FAR:
                raise PartError(Sentence("{table} is damaged: run reeb-parts batch again.", table=table))
            yield row
    except (OSError, pa.ArrowException, ValueError) as error:  # the latter of names that are no text
        raise _unread(table, error) from error


def _unread(table: Path, error: Exception) -> PartError:
    """The sentence that a table could not be read."""
    return PartError(Sentence("{table} could not be read: {reason}", table=table,
                              reason=getattr(error, "strerror", None) or error))


def _nearest(one: dict[str, Any], found: list[dict[str, Any]], rows: list[dict[str, Any]],
             count: int) -> list[dict[str, Any]]:
    """The nearest of those that were found before and of some rows."""
    if not rows:
        return found
    distance = distances(np.array(one["descriptor"]), np.array([row["descriptor"] for row in rows]))
    more = [{**_plain(row), "distance": float(value)} for row, value in zip(rows, distance, strict=True)]
    return sorted(found + more, key=lambda row: (row["distance"], row["model"], row["number"]))[:count]


def _plain(row: dict[str, Any]) -> dict[str, Any]:
    """A row without what nobody reads."""
    return {key: row[key] for key in ("model", "number", "name", "share")}


def page(out: Path, parts: list[dict[str, Any]]) -> str:
    """A page with a picture of each part in its model, the one that was asked for first."""
    paths = {row["name"]: row["path"] for row in _rows(out / "models.parquet", PATHS)}
    cards = "".join(
        f"<figure>{_image(out, paths.get(part['model'], ''), part)}<figcaption><b>{html.escape(part['model'])}</b><br>"
        f"{html.escape(part['name'])}, {part['share']:.1%} of the area<br>distance {part['distance']:.2f}</figcaption>"
        "</figure>" for part in parts)
    title = html.escape(f"Parts like {parts[0]['name']} of {parts[0]['model']}")
    return (f'<!DOCTYPE html>\n<html lang="en"><head><meta charset="utf-8"><title>{title}</title><style>{STYLE}</style>'
            f"</head><body><h1>{title}</h1><main>{cards}</main></body></html>\n")


def _image(out: Path, path: str, part: dict[str, Any]) -> str:
    """A picture of a part as an element of the page; the thumbnail of its model where that has gone or changed.

    path : str, of the model; empty where the tables are not of one run, as after a power failure between the two.
    """
    folder, place = folder_of(out, part["model"]), Path(spelled(path))
    try:
        record = read_record(folder)
        if record is None or record["digest"] != digest_of(place):  # its faces may be others by now
            raise PartError(Sentence("{path} has changed since the batch.", path=place))
        model, labels = read_model(place), _labels(folder)
        color = np.where((labels[model.polygon] == part["number"] - 1)[:, None], PART, REST)
        data = png(picture(TriMesh(model.vertices, model.faces), color, 160, model.up, fine=2))
    except (ReebError, OSError, ValueError, IndexError):
        try:
            data = (folder / "thumbnail.png").read_bytes()
        except OSError:
            return ""
    return f'<img alt="" src="{png_address(data)}">'


def _labels(folder: Path) -> np.ndarray:
    """The part of each face of a model, (p,) int64, whatever kind of file its run made; raises OSError, ValueError."""
    binary, *texts = (folder / f"labels{kind}" for kind in LABELS)
    for text in texts:
        if text.is_file():
            return np.loadtxt(text, np.int64, ndmin=1)
    return np.load(binary)

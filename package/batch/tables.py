# SPDX-License-Identifier: GPL-3.0-or-later
"""Tables of all models and of all parts, as Parquet."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from contextlib import ExitStack
from pathlib import Path
from typing import Any

import pyarrow as pa
from pyarrow import parquet

from ..core.atomic_files import hidden_place, put_in_place
from ..core.file_names import readable
from ..output_files import as_output_error
from .records import RECORD

ROWS = 5_000  # rows that are kept in memory before they are written

MODELS = pa.schema([
    ("name", pa.string()), ("path", pa.string()), ("folder", pa.string()), ("status", pa.string()),
    ("reason", pa.string()), ("vertices", pa.int64()), ("faces", pa.int64()), ("n_parts", pa.int64()),
    ("area", pa.float64()), ("nodes", pa.int64()), ("arcs", pa.int64()), ("loops", pa.int64()),
    ("components", pa.int64()), ("up", pa.string()), ("seconds", pa.float64()), ("notes", pa.list_(pa.string())),
    ("files", pa.list_(pa.string())), ("digest", pa.string()), ("settings", pa.string()),
])
PARTS = pa.schema([
    ("model", pa.string()), ("index", pa.int64()), ("number", pa.int64()), ("name", pa.string()),
    ("faces", pa.int64()), ("area", pa.float64()), ("share", pa.float64()), ("color", pa.list_(pa.float64())),
    ("bounding_box", pa.list_(pa.list_(pa.float64()))), ("neighbours", pa.list_(pa.int64())), ("twin", pa.int64()),
    ("descriptor", pa.list_(pa.float64())),
])


#: What they are called, in the folder of the results.
MODELS_TABLE, PARTS_TABLE = "models.parquet", "parts.parquet"


def write_tables(out: Path, rows: Iterable[tuple[dict[str, Any], Path, Path]]) -> tuple[Path, Path]:
    """Write models.parquet and parts.parquet, both or none.

    Parameters
    ----------
    out : Path
        Where.
    rows : iterable of (record, path, folder)
        Of each model: its record, its file and the folder of its results. Taken one after the other.

    Returns
    -------
    models, parts : Path

    Raises
    ------
    OSError
        One of them cannot be written; both are then as they were.
    """
    targets = [out / MODELS_TABLE, out / PARTS_TABLE]
    places = [hidden_place(path) for path in targets]
    with ExitStack() as stack:
        for place in places:
            stack.callback(place.unlink, missing_ok=True)
        with (_Table(places[0], MODELS) as models, _Table(places[1], PARTS) as parts):
            for record, path, folder in rows:
                models.add(_model_row(record, path, folder))
                for part in record["parts"]:
                    parts.add({"model": record["name"], **part})
        put_in_place(dict(zip(places, targets, strict=True)), as_output_error)
    return targets[0], targets[1]


def _model_row(record: dict[str, Any], path: Path, folder: Path) -> dict[str, Any]:
    """The row of a model."""
    return {**record["model"], "name": record["name"], "path": readable(path), "folder": readable(folder),
            "status": record["status"], "reason": record["reason"],
            "files": [name for name in record["files"] if name != RECORD], "digest": record["digest"],
            "settings": record["settings"]}


class _Table:
    """A file that takes rows one by one."""

    def __init__(self, path: Path, schema: pa.Schema) -> None:
        self._schema, self._rows = schema, list[dict[str, Any]]()
        # Arrow itself opens only files whose names are UTF-8.
        self._file = path.open("wb")
        self._writer = parquet.ParquetWriter(self._file, schema, compression="zstd")

    def add(self, row: dict[str, Any]) -> None:
        """Add a row; a column that it lacks is empty."""
        self._rows.append(row)
        if len(self._rows) >= ROWS:
            self._flush()

    def _flush(self) -> None:
        self._writer.write_table(pa.Table.from_pylist(self._rows, self._schema))
        self._rows.clear()

    def __enter__(self) -> _Table:
        return self

    def __exit__(self, *_: object) -> None:
        try:
            with self._file:
                self._flush()
                self._writer.close()
        finally:
            self._writer.is_open = False  # or it would write on, to a closed file, when it is collected


def read_rows(path: Path, schema: pa.Schema) -> Iterator[dict[str, Any]]:
    """Rows of a table, as dicts.

    schema : of the columns to read, of MODELS or PARTS; those that the table does not have are in no row. Raises
    OSError and ArrowException for a damaged table and for columns of other types, ValueError for names that are no
    text.
    """
    with path.open("rb") as data, parquet.ParquetFile(data) as file:
        for batch in file.iter_batches(columns=schema.names):
            there = pa.schema([schema.field(name) for name in batch.schema.names])
            yield from pa.Table.from_batches([batch]).cast(there).to_pylist()

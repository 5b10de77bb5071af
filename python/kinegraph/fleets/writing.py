"""Writes results to a folder of Parquet files as they arrive; an interrupted run can continue."""

from __future__ import annotations

import fcntl
import json
import os
import pickle
import time
from pathlib import Path
from typing import Any

import numpy as np

from ..errors import ArgumentError, FileError
from .reading import parts, pyarrow
from .results import ItemFailure

PART_SECONDS = 10.0  # s of work at most lost if the machine fails
PART_ROWS = 1_000_000  # approximate largest number of rows of a file


class ResultFolder:
    """A folder for the results of one run, in the order of the items.

    A file `part-FIRST-END.parquet` holds the results of the items from FIRST to before END. Files appear atomically.
    Their columns are `item`, `error` (a text for failed items), and the function's result: the keys of a dict, the
    columns of a table (several rows per item), `value` for a number, a text or an array, `pickle` for everything else.
    """

    def __init__(self, folder: Path, run: dict[str, Any]):
        """Args:
        folder: Created if it is missing.
        run: Description of the run; a continuation must have the same.
        """
        self._arrow = pyarrow()
        self.folder = folder
        folder.mkdir(parents=True, exist_ok=True)
        self._lock = (folder / ".lock").open("w")
        try:
            fcntl.flock(self._lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except OSError:
            self._lock.close()
            raise FileError(f"the folder '{folder}' is in use by another run") from None
        try:
            self._check(run)
            self.finished = parts(folder)[-1][1] if parts(folder) else 0
        except BaseException:
            self._lock.close()
            raise
        self._first = self.finished
        self._tables: list[Any] = []
        self._rows: list[dict[str, Any]] = []
        self._row_count = 0
        self._has_tables = False
        self._written = time.monotonic()

    def _check(self, run: dict[str, Any]) -> None:
        file = self.folder / "_run.json"
        if not file.exists():
            if any(self.folder.glob("part-*.parquet")):
                raise FileError(f"'{self.folder}' has results, but no _run.json that describes their run")
            _writeWhole(file, json.dumps(run).encode())
            return
        before = json.loads(file.read_text())
        for key, value in run.items():
            if before.get(key, value) == value:  # folders of version 0.2.0 have fewer keys
                continue
            change = {
                "code": f"the code of {run.get('function')}, or something that it refers to, has changed",
                "first item": "the first item is another one",
            }.get(key, f"{key} was {before[key]!r} and is {value!r}")
            raise ArgumentError(
                f"the folder '{self.folder}' has results of another run: {change}; "
                "use another folder, or remove this one"
            )

    def add(self, value: Any) -> None:
        """Adds the result of the next item."""
        arrow, index, rows = self._arrow, self.finished, 1
        if isinstance(value, arrow.RecordBatch):
            value = arrow.Table.from_batches([value])
        if isinstance(value, arrow.Table):
            rows = value.num_rows
            table = value.add_column(0, "item", arrow.array(np.full(rows, index)))
            self._addRows()
            self._tables.append(table)
            self._has_tables = True
        else:
            self._rows.append({"item": index, **_columns(value)})
        self.finished += 1
        self._row_count += rows
        if self._row_count >= PART_ROWS or time.monotonic() - self._written >= PART_SECONDS:
            self.write()

    def write(self) -> None:
        """Writes the results since the last call."""
        self._written = time.monotonic()
        if self._first == self.finished:
            return
        self._addRows()
        table = self._arrow.concat_tables(self._tables, promote_options="permissive")
        if "error" not in table.column_names:
            table = table.append_column("error", self._arrow.nulls(table.num_rows, self._arrow.string()))
        if self._has_tables:
            table = table.replace_schema_metadata({"tables": ""})
        sink = self._arrow.BufferOutputStream()
        self._arrow.parquet.write_table(table, sink, compression="zstd", compression_level=1)
        _writeWhole(self.folder / f"part-{self._first:012}-{self.finished:012}.parquet", sink.getvalue())
        self._first, self._tables, self._row_count = self.finished, [], 0

    def _addRows(self) -> None:
        if self._rows:
            names = dict.fromkeys(name for row in self._rows for name in row)
            columns = {name: self._column(name) for name in names}
            self._tables.append(self._arrow.table(columns))
            self._rows = []

    def _column(self, name: str) -> Any:
        try:
            return self._arrow.array([row.get(name) for row in self._rows])
        except self._arrow.ArrowException as error:
            raise ArgumentError(f"the results '{name}' do not fit into one column: {error}") from error

    def close(self) -> None:
        """Writes the remaining results."""
        try:
            self.write()
        finally:
            self._lock.close()


def _columns(value: Any) -> dict[str, Any]:
    """Converts a result to a row."""
    if isinstance(value, ItemFailure):
        return {"error": value.message}
    if isinstance(value, dict) and all(isinstance(key, str) for key in value):
        taken = {"item", "error"} & value.keys()
        if taken:
            raise ArgumentError(f"the result has the key '{min(taken)}', which is reserved")
        return {key: _cell(part) for key, part in value.items()}
    if isinstance(value, (bool, int, float, str, np.ndarray, np.generic)):
        return {"value": _cell(value)}
    return {"pickle": pickle.dumps(value)}


def _cell(value: Any) -> Any:
    return value.tolist() if isinstance(value, np.ndarray) and value.ndim != 1 else value


def _writeWhole(file: Path, content: Any) -> None:
    """Writes a file atomically, even if the machine stops."""
    unfinished = file.with_name(f".{file.name}.unfinished")
    with unfinished.open("wb") as out:
        out.write(content)
        out.flush()
        os.fsync(out.fileno())
    unfinished.rename(file)

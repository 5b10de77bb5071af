"""Reads results from a folder."""

from __future__ import annotations

import os
import pickle
import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np

from ..errors import FileError, NotFound
from .results import ItemFailure


def readResults(folder: str | os.PathLike[str]) -> Iterator[Any]:
    """Reads the results of `map(..., out=folder)`, with one file in memory at a time.

    Args:
        folder: The folder. While a run still writes to it, the present results are read.
    Returns:
        An iterator over the items, in order, with the function's results: a dict, a value, a table; numpy arrays for
        arrays; an `ItemFailure` for failed items.
    Raises:
        FileError: The folder or a file is missing.
        NotFound: The package pyarrow (extra `fleets`) is not installed.
    """
    arrow = pyarrow()
    path = Path(folder)
    if not path.is_dir():
        raise FileError(f"folder '{path}' does not exist")
    return (value for first, end, file in parts(path) for value in _read(arrow, first, end, file))


def _read(arrow: Any, first: int, end: int, file: Path) -> Iterator[Any]:
    table = arrow.parquet.read_table(file)
    names = [name for name in table.column_names if name not in ("item", "error")]
    items, errors = table["item"].to_numpy(), table["error"].to_pylist()
    starts = np.searchsorted(items, np.arange(first, end + 1))
    if b"tables" in (table.schema.metadata or {}):
        for index in range(first, end):
            begin, count = starts[index - first], starts[index - first + 1] - starts[index - first]
            failed = count == 1 and errors[begin] is not None
            yield ItemFailure(index, errors[begin]) if failed else table.select(names).slice(begin, count)
        return
    columns = {name: [_value(cell) for cell in table[name].to_pylist()] for name in names}
    for i, error in enumerate(errors):
        row = {name: columns[name][i] for name in names}
        if error is not None:
            yield ItemFailure(first + i, error)
        elif row.get("pickle") is not None:
            yield pickle.loads(row["pickle"])
        else:
            yield row["value"] if names == ["value"] else row


def _value(cell: Any) -> Any:
    return np.array(cell) if isinstance(cell, list) else cell


def pyarrow() -> Any:
    """Imports the package pyarrow."""
    try:
        import pyarrow
        import pyarrow.parquet
    except ModuleNotFoundError:
        raise NotFound("results in Parquet need the package pyarrow: pip install 'kinegraph[fleets]'") from None
    return pyarrow


def parts(folder: Path) -> list[tuple[int, int, Path]]:
    """Returns the files of a folder in order: index of the first item, index after the last, and path."""
    found = []
    for file in sorted(folder.glob("part-*.parquet")):
        numbers = re.fullmatch(r"part-(\d+)-(\d+)\.parquet", file.name)
        if numbers:
            found.append((int(numbers[1]), int(numbers[2]), file))
    at = 0
    for first, end, file in found:
        if first != at:
            raise FileError(
                f"the folder '{folder}' has no results of the items {at} to {first - 1}; {file.name} comes next"
            )
        at = end
    return found

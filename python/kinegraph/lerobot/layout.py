"""Files and fields of a data set of LeRobot, format v3.0."""

from __future__ import annotations

import contextlib
import json
import os
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from ..errors import FileError, NotFound

VERSION = "v3.0"
CHUNK = 1000  # files per folder
DATA_PATH = "data/chunk-{chunk_index:03d}/file-{file_index:03d}.parquet"
VIDEO_PATH = "videos/{video_key}/chunk-{chunk_index:03d}/file-{file_index:03d}.mp4"
INDICES = {
    "timestamp": "float32",
    "frame_index": "int64",
    "episode_index": "int64",
    "index": "int64",
    "task_index": "int64",
}
SHARDS = "shards"  # folder of the finished shards, which LeRobot ignores


def needed(name: str) -> Any:
    """Imports a module of the extra `lerobot`.

    Raises:
        NotFound: It is not installed.
    """
    import importlib

    try:
        return importlib.import_module(name)
    except ImportError as error:
        raise NotFound(f"{name} is not installed; pip install kinegraph[lerobot] ({error})") from None


def videoKey(camera: str) -> str:
    """Returns the feature of a camera."""
    return f"observation.images.{camera}"


def dataFile(shard: int) -> str:
    """Returns the path of the frames of a shard in the data set."""
    return DATA_PATH.format(chunk_index=shard // CHUNK, file_index=shard % CHUNK)


def videoFile(key: str, shard: int) -> str:
    """Returns the path of the film of a camera and a shard in the data set."""
    return VIDEO_PATH.format(video_key=key, chunk_index=shard // CHUNK, file_index=shard % CHUNK)


def shardFolder(folder: Path, shard: int) -> Path:
    """Returns the folder of a finished shard."""
    return folder / SHARDS / f"{shard:06d}"


@contextlib.contextmanager
def _wholeFile(path: Path) -> Iterator[Path]:
    """Gives the name of a file to write, and then its own name to it; without a trace if that fails.

    Raises:
        FileError: The file cannot be written.
    """
    part = path.with_name(path.name + ".part")
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        yield part
        part.replace(path)
    except OSError as error:
        with contextlib.suppress(OSError):
            part.unlink(missing_ok=True)
        reason = os.strerror(error.errno) if error.errno else str(error)
        raise FileError(f"LeRobotWriter: cannot write '{path}': {reason}") from None


def writeText(path: Path, text: str) -> None:
    """Writes a file completely or not at all."""
    with _wholeFile(path) as part, part.open("w") as file:
        file.write(text)
        file.flush()
        os.fsync(file.fileno())


def writeTable(path: Path, table: Any) -> None:
    """Writes a Parquet file completely or not at all."""
    with _wholeFile(path) as part:
        needed("pyarrow.parquet").write_table(table, part)


def column(values: Any, dtype: str, shape: list[int]) -> Any:
    """Returns a column of a table: numbers, or lists of a fixed size."""
    import numpy as np

    pa = needed("pyarrow")
    x = np.ascontiguousarray(np.asarray(values, dtype))
    if shape == [1]:
        return pa.array(x.reshape(-1))
    return pa.FixedSizeListArray.from_arrays(pa.array(x.reshape(-1)), int(np.prod(shape)))


def taskTable(tasks: list[str]) -> Any:
    """Returns the table of tasks, whose index is the task for pandas."""
    pa = needed("pyarrow")

    def described(name: str, pandas: str, numpy: str) -> dict[str, Any]:
        return {"name": name, "field_name": name, "pandas_type": pandas, "numpy_type": numpy, "metadata": None}

    names = described("x", "unicode", "object") | {"name": None, "field_name": None, "metadata": {"encoding": "UTF-8"}}
    pandas = {
        "index_columns": ["task"],
        "column_indexes": [names],
        "columns": [described("task_index", "int64", "int64"), described("task", "unicode", "object")],
        "creator": {"library": "pyarrow", "version": pa.__version__},
        "pandas_version": "2.3.3",
    }
    table = pa.table({"task_index": pa.array(range(len(tasks)), pa.int64()), "task": pa.array(tasks, pa.string())})
    return table.replace_schema_metadata({"pandas": json.dumps(pandas)})

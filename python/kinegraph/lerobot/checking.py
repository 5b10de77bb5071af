"""Checks a data set of LeRobot without LeRobot."""

from __future__ import annotations

import json
import os
from pathlib import Path
from typing import Any

import numpy as np

from .layout import INDICES, VERSION, needed
from .statistics import QUANTILES

FIELDS = ("codebase_version", "robot_type", "total_episodes", "total_frames", "total_tasks", "chunks_size", "fps")
FIELDS += ("splits", "data_path", "features")


def checkDataset(folder: str | os.PathLike[str]) -> list[str]:
    """Checks a data set of LeRobot, format v3.0: files, columns, numbers, times, films and statistics.

    Args:
        folder: Folder of the data set.
    Returns:
        A sentence per fault; empty without faults.
    Raises:
        NotFound: pyarrow or av is not installed.
    """
    root = Path(folder)
    try:
        info = json.loads((root / "meta/info.json").read_text())
        pq = needed("pyarrow.parquet")
        episodes = pq.read_table(root / "meta/episodes").to_pylist()
        tasks = pq.read_table(root / "meta/tasks.parquet")
        stats = json.loads((root / "meta/stats.json").read_text())
    except (OSError, json.JSONDecodeError) as error:
        return [f"a file of meta is missing or damaged: {error}"]
    faults = [f"info.json has no {field}" for field in FIELDS if field not in info]
    if faults:
        return faults
    if info["codebase_version"] != VERSION:
        faults.append(f"codebase_version is {info['codebase_version']}; expected {VERSION}")
    if b"pandas" not in (tasks.schema.metadata or {}):
        faults.append("tasks.parquet names no index for pandas")
    for field, count in {"total_episodes": len(episodes), "total_tasks": tasks.num_rows}.items():
        if info[field] != count:
            faults.append(f"{field} is {info[field]}; the tables have {count}")
    texts = "task" if "task" in tasks.column_names else "__index_level_0__"  # an index of pandas without a name
    if texts not in tasks.column_names:
        return [*faults, f"tasks.parquet has the columns {', '.join(tasks.column_names)}; expected task_index and task"]
    named = {row["task_index"]: row[texts] for row in tasks.to_pylist()}
    faults += _frameFaults(root, info, episodes, named)
    for key, feature in info["features"].items():
        if feature["dtype"] == "video":
            faults += _filmFaults(root, info, episodes, key)
        faults += _statisticsFaults(key, feature, stats.get(key), "stats.json")
        for row in episodes:
            found = {k.rsplit("/", 1)[1]: v for k, v in row.items() if k.startswith(f"stats/{key}/")}
            faults += _statisticsFaults(key, feature, found, f"episode {row['episode_index']}")
    return faults


def _statisticsFaults(key: str, feature: Any, stats: Any, where: str) -> list[str]:
    names = ["min", "max", "mean", "std", "count", *QUANTILES]
    missing = [name for name in names if name not in (stats or {})]
    if missing:
        return [f"the statistics of {key} in {where} have no {missing[0]}"]
    shape = (3, 1, 1) if feature["dtype"] == "video" else tuple(feature["shape"])
    for name in names:
        value = np.array(stats[name], float)
        if value.shape != ((1,) if name == "count" else shape) or not np.isfinite(value).all():
            return [f"{name} of {key} in {where} has shape {value.shape}; expected {shape} and finite numbers"]
    if feature["dtype"] == "video" and (np.min(stats["min"]) < 0 or np.max(stats["max"]) > 1):
        return [f"the statistics of {key} in {where} are not between 0 and 1"]
    return []


def _frameFaults(root: Path, info: Any, episodes: Any, tasks: Any) -> list[str]:
    pq = needed("pyarrow.parquet")
    faults: list[str] = []
    files: dict[tuple[int, int], Any] = {}
    begin = 0
    for number, row in enumerate(episodes):
        name = f"episode {number}"
        if row["episode_index"] != number or row["dataset_from_index"] != begin:
            return [*faults, f"{name} has number {row['episode_index']} and begins at {row['dataset_from_index']}"]
        place = row["data/chunk_index"], row["data/file_index"]
        if place not in files:
            path = root / info["data_path"].format(chunk_index=place[0], file_index=place[1])
            if not path.exists():
                return [*faults, f"'{path}' is missing"]
            files[place] = pq.read_table(path)
            faults += _columnFaults(files[place], info, str(path))
            if faults:
                return faults
        table = files[place]
        start = begin - int(table["index"][0].as_py())
        part = table.slice(start, row["length"])
        frames = np.arange(row["length"])
        expected = {
            "frame_index": frames,
            "index": begin + frames,
            "episode_index": np.full(len(frames), number),
            "timestamp": (frames / info["fps"]).astype(np.float32),
        }
        for key, values in expected.items():
            if not np.array_equal(part[key].to_numpy(), values):
                faults.append(f"{key} of {name} does not fit its frames")
        for key in ("observation.state", "action"):
            if not np.isfinite(np.array(part[key].to_pylist(), float)).all():
                faults.append(f"{key} of {name} has numbers that are not finite")
        if [tasks.get(i) for i in sorted(set(part["task_index"].to_pylist()))] != row["tasks"]:
            faults.append(f"{name} has other tasks in its frames than in its description")
        begin += row["length"]
    if begin != info["total_frames"]:
        faults.append(f"total_frames is {info['total_frames']}; the episodes have {begin}")
    return faults


def _columnFaults(table: Any, info: Any, path: str) -> list[str]:
    faults = []
    kinds = {"float32": "float", "int64": "int64", "bool": "bool"}
    columns = {key: feature for key, feature in info["features"].items() if feature["dtype"] != "video"}
    if set(table.column_names) != set(columns):
        return [f"'{path}' has the columns {table.column_names}; expected {list(columns)}"]
    for key, feature in columns.items():
        size = int(np.prod(feature["shape"]))
        kind = kinds[feature["dtype"]]
        vector = f"fixed_size_list<element: {kind}>[{size}]"
        found = str(table.schema.field(key).type).replace("item:", "element:")
        if found != (kind if feature["shape"] == [1] else vector):
            faults.append(f"column {key} of '{path}' has type {found}; expected {vector if size > 1 else kind}")
        if key in INDICES and INDICES[key] != feature["dtype"]:
            faults.append(f"feature {key} has type {feature['dtype']}; expected {INDICES[key]}")
    return faults


def _filmFaults(root: Path, info: Any, episodes: Any, key: str) -> list[str]:
    av = needed("av")
    faults = []
    ends: dict[Path, float] = {}
    for row in episodes:
        path = root / info["video_path"].format(
            video_key=key, chunk_index=row[f"videos/{key}/chunk_index"], file_index=row[f"videos/{key}/file_index"]
        )
        begin, end = row[f"videos/{key}/from_timestamp"], row[f"videos/{key}/to_timestamp"]
        if abs(begin - ends.get(path, 0.0)) > 1e-9 or abs((end - begin) * info["fps"] - row["length"]) > 1e-6:
            faults.append(
                f"episode {row['episode_index']} has {row['length']} frames and {key} from {begin} to {end} s"
            )
        ends[path] = end
    for path, end in ends.items():
        try:
            with av.open(str(path)) as film:
                stream = film.streams.video[0]
                size = [stream.height, stream.width]
                times = [frame.time for frame in film.decode(stream)]
        except (OSError, av.error.FFmpegError) as error:
            faults.append(f"'{path}' cannot be read: {error}")
            continue
        if size != info["features"][key]["shape"][:2]:
            faults.append(f"'{path}' has {size} pixels; expected {info['features'][key]['shape'][:2]}")
        if len(times) != round(end * info["fps"]) or np.abs(times - np.arange(len(times)) / info["fps"]).max() > 1e-4:
            faults.append(f"'{path}' has {len(times)} images at other times than k / fps; expected {end * info['fps']}")
    return faults

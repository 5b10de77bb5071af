"""Writes episodes as a data set of LeRobot."""

from __future__ import annotations

import json
import os
import shutil
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from ..errors import ArgumentError, FileError, NotFound
from .layout import (
    CHUNK,
    DATA_PATH,
    INDICES,
    SHARDS,
    VERSION,
    VIDEO_PATH,
    column,
    dataFile,
    needed,
    shardFolder,
    taskTable,
    videoFile,
    videoKey,
    writeTable,
    writeText,
)
from .statistics import Statistics, imageStatistics, merged, statisticsOf
from .video import CODECS, Film

Names = Sequence[str]


class LeRobotWriter:
    """Writes episodes as a data set of LeRobot, format v3.0.

    Each writer makes one shard: one Parquet file and one film per camera. `close` finishes it and describes all
    finished shards of the folder by `mergeShards`. Several writers, on several machines, write into one folder if their
    shards have different numbers. A shard that was not closed, as after a crash, is not part of the data
    set, and a new writer of its number replaces it.
    """

    def __init__(
        self,
        folder: str | os.PathLike[str],
        fps: int,
        state: Names,
        action: Names | None = None,
        cameras: Mapping[str, tuple[int, int]] | None = None,
        robot_type: str = "kinegraph",
        codec: str = "h264",
        shard: int = 0,
        merge: bool = True,
    ):
        """Begins a shard.

        Args:
            folder: Folder of the data set; it is made if it does not exist.
            fps: Frames per second.
            state: Names of the entries of `observation.state`.
            action: Names of the entries of `action`; by default those of the state.
            cameras: Height and width (pixels, even) of the images of each camera, `observation.images.NAME`.
            robot_type: Name of the robot.
            codec: Codec of films, "h264" or "av1".
            shard: Number of the shard.
            merge: Whether `close` merges the shards of the folder. Else call `mergeShards` after all writers.
        Raises:
            ArgumentError: An argument is invalid.
            NotFound: pyarrow or av is not installed.
            FileError: The shard exists, or the folder cannot be written.
        """
        needed("pyarrow")
        needed("av")
        if int(fps) != fps or fps < 1:
            raise ArgumentError(f"LeRobotWriter: fps is {fps}; expected an integer above 0")
        if codec not in CODECS:
            raise ArgumentError(f"LeRobotWriter: codec is {codec!r}; expected one of {', '.join(CODECS)}")
        self.folder, self.fps, self.codec, self.shard = Path(folder), int(fps), codec, int(shard)
        self.state, self.action = list(state), list(state if action is None else action)
        self.cameras = {name: (int(size[0]), int(size[1])) for name, size in (cameras or {}).items()}
        """Height and width of the images of each camera, pixels."""
        for name, size in self.cameras.items():
            if min(size) < 2 or size[0] % 2 or size[1] % 2:
                raise ArgumentError(
                    f"LeRobotWriter: camera '{name}' has images of {size[0]} x {size[1]} pixels; expected even numbers"
                )
        self.robot_type, self._merge = robot_type, merge
        self._own = shardFolder(self.folder, self.shard)
        if self._own.exists():
            raise FileError(f"LeRobotWriter: '{self.folder}' has a finished shard {self.shard}; choose another number")
        try:
            self.folder.mkdir(parents=True, exist_ok=True)
        except OSError as error:
            raise FileError(f"LeRobotWriter: cannot write '{self.folder}': {error}") from None
        self._films: dict[str, Film] = {}
        self._tables: list[Any] = []
        self._rows: list[dict[str, Any]] = []
        self._frames = 0
        self._closed = False
        self.report: dict[str, Any] = {}
        """The report of demonstrate, which is stored with the shard."""

    def features(self) -> dict[str, Any]:
        """Returns the features of the data set, as in its info.json."""
        features: dict[str, Any] = {
            "observation.state": {"dtype": "float32", "shape": [len(self.state)], "names": self.state},
            "action": {"dtype": "float32", "shape": [len(self.action)], "names": self.action},
            "next.success": {"dtype": "bool", "shape": [1], "names": None},
        }
        for name, (height, width) in self.cameras.items():
            features[videoKey(name)] = {
                "dtype": "video",
                "shape": [height, width, 3],
                "names": ["height", "width", "channels"],
                "info": {
                    "video.height": height,
                    "video.width": width,
                    "video.codec": self.codec,
                    "video.pix_fmt": "yuv420p",
                    "video.is_depth_map": False,
                    "video.fps": self.fps,
                    "video.channels": 3,
                    "has_audio": False,
                },
            }
        for name, dtype in INDICES.items():
            features[name] = {"dtype": dtype, "shape": [1], "names": None}
        return features

    def addEpisode(
        self,
        state: Any,
        action: Any,
        images: Mapping[str, Sequence[np.ndarray]] | None = None,
        task: str = "",
        success: bool = True,
    ) -> None:
        """Adds an episode. Frame k has the time k / fps.

        Args:
            state: (K, number of names of the state) numbers.
            action: (K, number of names of the action) commands.
            images: K images (height, width, 3) of type uint8 for each camera.
            task: A sentence.
            success: Whether the last frame reaches the goal.
        Raises:
            ArgumentError: A shape does not fit, a number is not finite, or the writer is closed.
            FileError: The film cannot be written.
        """
        if self._closed:
            raise ArgumentError("LeRobotWriter.addEpisode: the writer is closed")
        if not task.strip():
            raise ArgumentError("LeRobotWriter.addEpisode: task is empty; expected a sentence")
        states = self._numbers("state", state, len(self.state))
        actions = self._numbers("action", action, len(self.action))
        count = len(states)
        if len(actions) != count:
            raise ArgumentError(f"LeRobotWriter.addEpisode: {count} states and {len(actions)} actions")
        films = self._checkedImages(images or {}, count)
        done = np.zeros(count, bool)
        done[-1] = bool(success)
        frames = {
            "observation.state": states,
            "action": actions,
            "next.success": done,
            "timestamp": (np.arange(count) / self.fps).astype(np.float32),
            "frame_index": np.arange(count),
            "episode_index": np.full(count, len(self._rows)),
            "index": self._frames + np.arange(count),
            "task_index": np.zeros(count, int),
        }
        statistics = {name: statisticsOf(values) for name, values in frames.items()}
        features = self.features()
        pa = needed("pyarrow")
        columns = {
            name: column(values, features[name]["dtype"], features[name]["shape"]) for name, values in frames.items()
        }
        row: dict[str, Any] = {"task": task, "length": count, "videos": {}}
        for name, list_of_images in films.items():
            key = videoKey(name)
            if name not in self._films:
                path = self.folder / videoFile(key, self.shard)
                self._films[name] = Film(path, self.fps, self.cameras[name], self.codec)
            row["videos"][key] = self._films[name].add(list_of_images)
            statistics[key] = imageStatistics(list_of_images)
        row["stats"] = {name: {k: v.tolist() for k, v in part.items()} for name, part in statistics.items()}
        self._tables.append(pa.table(columns))
        self._rows.append(row)
        self._frames += count

    def _numbers(self, what: str, values: Any, size: int) -> np.ndarray:
        x = np.asarray(values, float)
        if x.ndim != 2 or x.shape[1] != size or len(x) == 0:
            raise ArgumentError(
                f"LeRobotWriter.addEpisode: {what} has shape {x.shape}; expected (K, {size}) with K > 0"
            )
        if not np.isfinite(x).all():
            k, i = np.argwhere(~np.isfinite(x))[0]
            raise ArgumentError(f"LeRobotWriter.addEpisode: {what} of frame {k} has {x[k, i]} at entry {i}")
        return x

    def _checkedImages(self, images: Mapping[str, Sequence[np.ndarray]], count: int) -> dict[str, list[np.ndarray]]:
        if set(images) != set(self.cameras):
            raise ArgumentError(
                f"LeRobotWriter.addEpisode: images of {sorted(images)}; expected the cameras {sorted(self.cameras)}"
            )
        films = {name: list(images[name]) for name in self.cameras}
        for name, size in self.cameras.items():
            if len(films[name]) != count:
                raise ArgumentError(
                    f"LeRobotWriter.addEpisode: camera '{name}' has {len(films[name])} images; expected {count}"
                )
            for k, image in enumerate(films[name]):
                if np.shape(image) != (*size, 3) or np.asarray(image).dtype != np.uint8:
                    raise ArgumentError(
                        f"LeRobotWriter.addEpisode: image {k} of camera '{name}' has shape {np.shape(image)} and type "
                        f"{np.asarray(image).dtype}; expected {(*size, 3)} and uint8"
                    )
        return films

    def close(self) -> None:
        """Finishes the shard, and merges the shards of the folder. Without episodes nothing is written."""
        if self._closed:
            return
        self._closed = True
        for film in self._films.values():
            film.close()
        if self._rows:
            part = self._own.with_name(self._own.name + ".part")
            shutil.rmtree(part, ignore_errors=True)
            writeTable(part / "frames.parquet", needed("pyarrow").concat_tables(self._tables))
            header = {"fps": self.fps, "robot_type": self.robot_type, "features": self.features()}
            writeText(part / "episodes.json", json.dumps(header | {"episodes": self._rows}))
            if self.report:
                writeText(part / "attempts.json", json.dumps(self.report))
            part.rename(self._own)
        if self._merge and self._rows:
            mergeShards(self.folder)

    def __enter__(self) -> LeRobotWriter:
        return self

    def __exit__(self, kind: Any, *rest: Any) -> None:
        if kind is None:
            self.close()


def finishedShards(folder: Path) -> list[int]:
    """Returns the numbers of the finished shards of a folder."""
    return sorted(int(path.name) for path in (folder / SHARDS).glob("*") if path.name.isdigit())


def mergeShards(folder: str | os.PathLike[str]) -> dict[str, Any]:
    """Describes all finished shards of a folder as one data set: numbers of episodes, frames and tasks, statistics.

    Films are not touched. A repeated call, after more shards, extends the data set.

    Args:
        folder: Folder of the data set.
    Returns:
        The content of meta/info.json.
    Raises:
        NotFound: There is no finished shard.
        ArgumentError: The shards have different features.
    """
    root = Path(folder)
    shards = finishedShards(root)
    if not shards:
        raise NotFound(f"mergeShards: '{folder}' has no finished shard; LeRobotWriter.close() finishes one")
    headers = {shard: json.loads((shardFolder(root, shard) / "episodes.json").read_text()) for shard in shards}
    first = headers[shards[0]]
    for shard, header in headers.items():
        for field in ("fps", "robot_type", "features"):
            if header[field] != first[field]:
                raise ArgumentError(
                    f"mergeShards: {field} of shard {shard} differs from that of shard {shards[0]}; a data set has one"
                )
    tasks = list(dict.fromkeys(row["task"] for header in headers.values() for row in header["episodes"]))
    number = {task: i for i, task in enumerate(tasks)}
    rows: list[dict[str, Any]] = []
    frames = 0
    for shard, header in headers.items():
        _writeFrames(root, shard, header, frames, len(rows), number)
        for row in header["episodes"]:
            rows.append(_episode(row, shard, frames, len(rows), number))
            frames += row["length"]
    pa = needed("pyarrow")
    writeTable(root / "meta/episodes/chunk-000/file-000.parquet", pa.Table.from_pylist([_flat(row) for row in rows]))
    writeTable(root / "meta/tasks.parquet", taskTable(tasks))
    total = {name: merged([row["stats"][name] for row in rows]) for name in rows[0]["stats"]}
    writeText(root / "meta/stats.json", json.dumps({k: _lists(v) for k, v in total.items()}, indent=4))
    info = {
        "codebase_version": VERSION,
        "robot_type": first["robot_type"],
        "total_episodes": len(rows),
        "total_frames": frames,
        "total_tasks": len(tasks),
        "chunks_size": CHUNK,
        "data_files_size_in_mb": 100,
        "video_files_size_in_mb": 200,
        "fps": first["fps"],
        "splits": {"train": f"0:{len(rows)}"},
        "data_path": DATA_PATH,
        "video_path": VIDEO_PATH if any(f["dtype"] == "video" for f in first["features"].values()) else None,
        "features": first["features"],
    }
    writeText(root / "meta/info.json", json.dumps(info, indent=4))
    return info


def _writeFrames(root: Path, shard: int, header: Any, frame: int, episode: int, number: Mapping[str, int]) -> None:
    """Writes the frames of a shard with their numbers in the data set."""
    pa = needed("pyarrow")
    table = needed("pyarrow.parquet").read_table(shardFolder(root, shard) / "frames.parquet")
    lengths = [row["length"] for row in header["episodes"]]
    columns = {
        "episode_index": np.repeat(episode + np.arange(len(lengths)), lengths),
        "index": frame + np.arange(sum(lengths)),
        "task_index": np.repeat([number[row["task"]] for row in header["episodes"]], lengths),
    }
    for name, values in columns.items():
        table = table.set_column(table.schema.get_field_index(name), name, pa.array(values, pa.int64()))
    writeTable(root / dataFile(shard), table)


def _episode(row: Any, shard: int, frame: int, episode: int, number: Mapping[str, int]) -> dict[str, Any]:
    """Returns the description of an episode, with its numbers in the data set."""
    statistics = {name: {k: np.array(v) for k, v in part.items()} for name, part in row["stats"].items()}
    count = row["length"]
    for name, values in {
        "episode_index": np.full(count, episode),
        "index": frame + np.arange(count),
        "task_index": np.full(count, number[row["task"]]),
    }.items():
        statistics[name] = statisticsOf(values)
    place = {"chunk_index": shard // CHUNK, "file_index": shard % CHUNK}
    described: dict[str, Any] = {"episode_index": episode, "tasks": [row["task"]], "length": count}
    described |= {f"data/{name}": value for name, value in place.items()}
    described |= {"dataset_from_index": frame, "dataset_to_index": frame + count}
    for key, (begin, end) in row["videos"].items():
        described |= {f"videos/{key}/{name}": value for name, value in place.items()}
        described |= {f"videos/{key}/from_timestamp": begin, f"videos/{key}/to_timestamp": end}
    described["stats"] = statistics
    return described


def _lists(statistics: Statistics) -> dict[str, Any]:
    return {name: value.tolist() for name, value in statistics.items()}


def _flat(row: Mapping[str, Any]) -> dict[str, Any]:
    flat = {name: value for name, value in row.items() if name != "stats"}
    for feature, statistics in row["stats"].items():
        flat |= {f"stats/{feature}/{name}": value for name, value in _lists(statistics).items()}
    return flat | {"meta/episodes/chunk_index": 0, "meta/episodes/file_index": 0}

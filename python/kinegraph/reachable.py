"""Where a robot can reach, and from how many directions."""

from __future__ import annotations

import os
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from ._core import FS, Config, solveIk
from .errors import ArgumentError

CHUNK = 512  # targets in one item of a map: some milliseconds


@dataclass(frozen=True)
class Reachability:
    """The cells of a grid that a frame reaches.

    Attributes:
        frame: The frame's name.
        spacing: The size of a cell, m.
        points: The cells' middles, shape (N, 3), m.
        share: Of the directions that were tried, how many the frame has an answer for at each point, shape (N,), 0 to 1.
        directions: The directions of the frame's z axis that were tried, shape (k, 3); (0, 3) if any orientation would do.
    """

    frame: str
    spacing: float
    points: np.ndarray
    share: np.ndarray
    directions: np.ndarray

    @property
    def volume(self) -> float:
        """The volume of the cells that are reached from any direction, m³."""
        return float(np.count_nonzero(self.share) * self.spacing**3)

    def __str__(self) -> str:
        how = f"from {len(self.directions)} directions" if len(self.directions) else "in any orientation"
        reached = np.count_nonzero(self.share)
        text = f"'{self.frame}' reaches {reached} of {len(self.share)} cells of {self.spacing:g} m {how}: {self.volume:.3g} m³"
        if len(self.directions) and reached:
            text += f"; {np.count_nonzero(self.share == 1) * self.spacing**3:.3g} m³ from all"
        return text

    def addTo(self, config: Config, name: str = "reachability") -> None:
        """Shows the cells in a scene, as a cloud of points: red where few directions are possible, blue where all are.

        Args:
            config: The scene.
            name: Of the frame that is added.
        """
        reached = self.share > 0
        share = self.share[reached, None]
        colors = 255 * np.hstack([1 - share, 0.5 * np.ones_like(share), share])
        config.addFrame(name).setPointCloud(self.points[reached], colors)

    def save(self, file: str | os.PathLike[str]) -> Path:
        """Writes a row for each cell: x, y, z (m) and share.

        Args:
            file: A name that ends in .csv, or in .parquet (extra `fleets`).
        Returns:
            The file's path.
        Raises:
            ArgumentError: Another ending.
            NotFound: The package pyarrow is not installed.
        """
        path = Path(file)
        if path.suffix == ".csv":
            rows = np.column_stack([self.points, self.share])
            np.savetxt(path, rows, fmt="%.6g", delimiter=",", header="x,y,z,share", comments="")
            return path
        if path.suffix != ".parquet":
            raise ArgumentError(f"the file is '{path}'; expected a name that ends in .csv or .parquet")
        from .fleets.reading import pyarrow

        arrow = pyarrow()
        columns = {**dict(zip("xyz", self.points.T)), "share": self.share}
        arrow.parquet.write_table(arrow.table(columns), path)
        return path


def reachability(
    config: Config,
    frame: str | None = None,
    spacing: float = 0.1,
    directions: int = 0,
    *,
    engine: str = "threads",
    workers: int | None = None,
    seed: int = 0,
    progress: bool = True,
    **options: Any,
) -> Reachability:
    """Finds where a frame can be, cell by cell of a grid, by inverse kinematics with limits and without collisions.

    The grid fills the box around the places that 4096 random postures reach. The scene stays as it is.

    Args:
        config: The scene.
        frame: The frame's name; by default the last one that the last joint moves.
        spacing: Of the grid, m.
        directions: How many directions of the frame's z axis are tried at each cell, spread evenly over all; 0: only the position
            counts.
        engine: Who computes: "threads", "processes" or "ray", as for `map`.
        workers: How many.
        seed: Of the random postures.
        progress: Whether to draw a bar on a terminal.
        options: Of `solveIk`: collisions, attempts, margin ...
    Returns:
        The cells. After Ctrl-C those that are done; the others count as not reached.
    Raises:
        FrameNotFound: There is no such frame.
        ArgumentError: Nothing moves the frame, or a number makes no sense.
    """
    from .fleets import map

    if not 0 < spacing < float("inf") or directions < 0:
        raise ArgumentError(f"reachability: spacing is {spacing} and directions is {directions}; expected > 0 and >= 0")
    frame = frame if frame is not None else _lastFrame(config)
    points = _grid(config, frame, spacing, seed)
    axes = _spread(directions)
    targets = np.repeat(points, max(directions, 1), axis=0)
    turns = np.tile(axes, (len(points), 1)) if directions else targets
    items = [(targets[i : i + CHUNK], turns[i : i + CHUNK]) for i in range(0, len(targets), CHUNK)]
    chosen = {"attempts": 20, **options}

    def reach(item: tuple[np.ndarray, np.ndarray]) -> np.ndarray:
        goal = {"position": item[0], **({"z": item[1]} if directions else {})}
        feasible: np.ndarray = solveIk(config, {frame: goal}, **chosen).feasible
        return feasible

    results = map(reach, items, engine=engine, workers=workers, progress=progress, errors="raise")
    reached = np.zeros(len(targets), bool)
    for i, feasible in enumerate(results):
        if feasible is not None:
            reached[i * CHUNK : (i + 1) * CHUNK] = feasible
    return Reachability(frame, spacing, points, reached.reshape(len(points), -1).mean(axis=1), axes)


def _lastFrame(config: Config) -> str:
    """The last frame below the last joint that has a name of its own."""
    moved = [f.name for f in config.getFrames() if np.any(config.eval(FS.position, [f.name])[1])]
    if not moved:
        raise ArgumentError("reachability: no joint moves a frame of this scene")
    return str(moved[-1])


def _grid(config: Config, frame: str, spacing: float, seed: int) -> np.ndarray:
    """The middles of the cells around what random postures reach."""
    low, high = np.asarray(config.getJointLimits(), float)
    if not (np.isfinite(low).all() and np.isfinite(high).all()):
        endless = [name for name, a, b in zip(config.getJointNames(), low, high) if not np.isfinite(b - a)]
        raise ArgumentError(
            f"reachability: the joints {', '.join(endless)} have no limits; set them with setJointLimits"
        )
    configurations = np.random.default_rng(seed).uniform(low, high, (4096, len(low)))
    places = np.asarray(config.getFramePoses(configurations, frame))[:, 0, :3]
    if np.ptp(places, axis=0).max() < 1e-9:
        raise ArgumentError(f"reachability: no joint moves frame '{frame}'")
    first = np.floor(places.min(axis=0) / spacing - 0.5).astype(int)
    last = np.ceil(places.max(axis=0) / spacing + 0.5).astype(int)
    axes = [spacing * np.arange(a, b + 1) for a, b in zip(first, last)]
    return np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1).reshape(-1, 3)


def _spread(count: int) -> np.ndarray:
    """Directions spread evenly over the sphere: points of a Fibonacci lattice (Swinbank and Purser 2006), shape (count, 3)."""
    i = np.arange(count) + 0.5
    z = 1 - 2 * i / max(count, 1)
    turn = np.pi * (3 - np.sqrt(5)) * i
    return np.column_stack([np.sqrt(1 - z * z) * np.cos(turn), np.sqrt(1 - z * z) * np.sin(turn), z])

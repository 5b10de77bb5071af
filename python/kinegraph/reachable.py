"""Computes the reachable positions of a robot, and the directions from which it reaches them."""

from __future__ import annotations

import os
from dataclasses import dataclass
from numbers import Integral, Real
from pathlib import Path
from typing import Any

import numpy as np

from ._core import FS, Config, solveIk
from .errors import ArgumentError

CHUNK = 512  # targets per item of a map: some milliseconds


@dataclass(frozen=True)
class Reachability:
    """The cells of a grid with their reachability by a frame.

    Attributes:
        frame: The frame's name.
        spacing: The size of a cell, m.
        points: Centers of the cells, shape (N, 3), m.
        share: Share of the tried directions that the frame reaches at each point, shape (N,), 0 to 1.
        directions: Tried directions of the frame's z axis, shape (k, 3); (0, 3) for any orientation.
    """

    frame: str
    spacing: float
    points: np.ndarray
    share: np.ndarray
    directions: np.ndarray

    @property
    def volume(self) -> float:
        """The volume of the cells reached from at least one direction, m³."""
        return float(np.count_nonzero(self.share) * self.spacing**3)

    def __str__(self) -> str:
        how = f"from {len(self.directions)} directions" if len(self.directions) else "in any orientation"
        reached = np.count_nonzero(self.share)
        text = f"'{self.frame}' reaches {reached} of {len(self.share)} cells of {self.spacing:g} m {how}: {self.volume:.3g} m³"
        if len(self.directions) and reached:
            text += f"; {np.count_nonzero(self.share == 1) * self.spacing**3:.3g} m³ from all"
        return text

    def addTo(self, config: Config, name: str = "reachability") -> None:
        """Adds the cells to a scene as a point cloud: from red for few directions to blue for all.

        Args:
            config: The scene.
            name: Name of the added frame.
        """
        reached = self.share > 0
        share = self.share[reached, None]
        colors = 255 * np.hstack([1 - share, 0.5 * np.ones_like(share), share])
        config.addFrame(name).setPointCloud(self.points[reached], colors)

    def save(self, file: str | os.PathLike[str]) -> Path:
        """Writes one row per cell: x, y, z (m) and share.

        Args:
            file: A name that ends in .csv, or in .parquet (extra `fleets`).
        Returns:
            The file's path.
        Raises:
            ArgumentError: The name has another ending.
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
    """Computes the cells of a grid that a frame reaches, by inverse kinematics with limits and without collisions.

    The grid fills the bounding box of the frame's positions in 4096 random configurations. Hinges without limits take
    any angle. The scene is not modified.

    Args:
        config: The scene.
        frame: The frame's name; by default the last one moved by the last joint.
        spacing: Spacing of the grid, m.
        directions: Number of directions of the frame's z axis tried at each cell, evenly spread over the sphere; 0:
            position only.
        engine: "threads", "processes" or "ray", see `map`.
        workers: Number of workers.
        seed: Seed of the random configurations.
        progress: Whether to draw a progress bar on a terminal.
        options: Options of `solveIk`: collisions, attempts, margin ...
    Returns:
        The cells. After Ctrl-C, unfinished cells count as not reached.
    Raises:
        FrameNotFound: There is no such frame.
        ArgumentError: No joint moves the frame, a sliding or free joint has no limits, or a number is out of range.
    """
    from .fleets import map

    if not isinstance(spacing, Real) or not 0 < spacing < float("inf"):
        raise ArgumentError(f"reachability: spacing is {spacing!r}; expected a number > 0, in m")
    for name, number in (("directions", directions), ("seed", seed)):
        if not isinstance(number, Integral) or number < 0:
            raise ArgumentError(f"reachability: {name} is {number!r}; expected a whole number >= 0")
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
    """Returns the last named frame below the last joint."""
    moved = [f.name for f in config.getFrames() if np.any(config.eval(FS.position, [f.name])[1])]
    if not moved:
        raise ArgumentError("reachability: no joint moves a frame of this scene")
    return str(moved[-1])


def _grid(config: Config, frame: str, spacing: float, seed: int) -> np.ndarray:
    """Returns the centers of the cells around the positions in random configurations."""
    configurations = _configurations(config, np.random.default_rng(seed), 4096)
    places = np.asarray(config.getFramePoses(configurations, frame))[:, 0, :3]
    if np.ptp(places, axis=0).max() < 1e-9:
        raise ArgumentError(f"reachability: no joint moves frame '{frame}'")
    first = np.floor(places.min(axis=0) / spacing - 0.5).astype(int)
    last = np.ceil(places.max(axis=0) / spacing + 0.5).astype(int)
    axes = [spacing * np.arange(a, b + 1) for a, b in zip(first, last)]
    return np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1).reshape(-1, 3)


def _configurations(config: Config, rng: np.random.Generator, count: int) -> np.ndarray:
    """Returns random configurations within the limits, shape (count, n). Hinges without limits take any angle, balls
    any orientation."""
    low, high = np.array(config.getJointLimits(), float)
    names = config.getJointNames()[: len(low)]
    kinds = [str(config.getFrame(name.rsplit(":", 1)[0]).getJointType()).rsplit(".")[-1] for name in names]
    endless = ~(np.isfinite(low) & np.isfinite(high))
    hinge = endless & [kind.startswith("hinge") for kind in kinds]
    ball = endless & [kind == "quatBall" for kind in kinds]
    if (endless & ~hinge & ~ball).any():
        joints = dict.fromkeys(names[i].rsplit(":", 1)[0] for i in np.flatnonzero(endless & ~hinge & ~ball))
        raise ArgumentError(
            f"reachability: the joints {', '.join(joints)} have no limits, so that the grid has no end; "
            f"give them some: C.getFrame('{next(iter(joints))}').setAttributes({{'limits': [...]}})"
        )
    low[endless], high[endless] = -np.pi, np.pi
    configurations = rng.uniform(low, high, (count, len(low)))
    configurations[:, ball] = rng.normal(size=(count, int(ball.sum())))
    return configurations


def _spread(count: int) -> np.ndarray:
    """Returns directions spread evenly over the sphere: points of a Fibonacci lattice (Swinbank and Purser 2006), shape
    (count, 3)."""
    i = np.arange(count) + 0.5
    z = 1 - 2 * i / max(count, 1)
    turn = np.pi * (3 - np.sqrt(5)) * i
    return np.column_stack([np.sqrt(1 - z * z) * np.cos(turn), np.sqrt(1 - z * z) * np.sin(turn), z])

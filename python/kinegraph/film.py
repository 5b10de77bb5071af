"""Saves motions as films (mp4, webm), without a display."""

from __future__ import annotations

import os
import time
from concurrent.futures import Future, ThreadPoolExecutor
from fractions import Fraction
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ._core import Config, TaskPlan, Trajectory
from .errors import ArgumentError, ArgumentTypeError, NotFound
from .progress import drawProgress
from .recording.reading import Recording

_CODECS = {  # with their speed settings
    ".mp4": ("h264", {"preset": "veryfast"}),
    ".webm": ("libvpx-vp9", {"deadline": "realtime", "cpu-used": "6", "row-mt": "1"}),
}


def _encoder() -> Any:
    try:
        import av
    except ModuleNotFoundError:
        raise NotFound("saveFilm needs the package av: pip install 'kinegraph[film]'") from None
    return av


def _states(config: Config, path: np.ndarray, count: int) -> np.ndarray:
    """Interpolates `count` states linearly at equal steps along the path."""
    numbers = path.shape[1:]
    dofs, frames = config.getJointDimension(), config.getFrameDimension()
    if path.ndim not in (2, 3) or len(path) == 0 or numbers not in ((dofs,), (frames, 7)):
        raise ArgumentError(
            f"saveFilm: the path has shape {path.shape}; expected (T, {dofs}), joint vectors, or (T, {frames}, 7), poses "
            "of all frames"
        )
    at = np.linspace(0, len(path) - 1, count)
    before = np.minimum(at.astype(int), max(len(path) - 2, 0))
    share = (at - before).reshape(-1, *[1] * (path.ndim - 1))
    after = path[np.minimum(before + 1, len(path) - 1)]
    if path.ndim == 3:  # uses the nearer of the two quaternions of a rotation
        turned = np.sum(path[before][..., 3:] * after[..., 3:], axis=-1, keepdims=True) < 0
        after = np.concatenate([after[..., :3], np.where(turned, -after[..., 3:], after[..., 3:])], axis=-1)
    return np.asarray((1 - share) * path[before] + share * after)


def _rows(config: Config, motion: Trajectory | Recording, count: int) -> Any:
    """Evaluates a motion at equal steps; plans of tasks and recordings give poses of frames, with their objects."""
    if isinstance(motion, Recording):
        return motion.frames(config, (count - 1) / motion.times[-1])
    if isinstance(motion, TaskPlan):
        return motion.frames(config, max(25.0, count / motion.duration))
    return [motion.eval(t)[0] for t in np.linspace(0, motion.duration, count)]


def _duration(motion: Trajectory | Recording) -> float:
    if isinstance(motion, Recording):
        return float(motion.times[-1]) if len(motion.times) else 0.0
    return float(motion.duration)


def _require(file: Any, config: Any, size: Any) -> None:
    """Raises ArgumentTypeError for arguments in another order or of another kind."""
    if not isinstance(file, (str, os.PathLike)):
        raise ArgumentTypeError(f"saveFilm: file is {file!r}; expected a file's name; write saveFilm(file, C, path)")
    if not isinstance(config, Config):
        raise ArgumentTypeError(f"saveFilm: config is {config!r}; expected Config; write saveFilm(file, C, path)")
    if size is not None and (np.shape(size) != (2,) or not np.all(np.greater(size, 0))):
        raise ArgumentTypeError(f"saveFilm: size is {size!r}; expected width and height in pixels, as in (1280, 720)")


def saveFilm(
    file: str | os.PathLike[str],
    config: Config,
    path: ArrayLike | Trajectory | Recording,
    seconds: float | None = None,
    rate: float = 25.0,
    size: tuple[int, int] | None = None,
) -> Path:
    """Renders a motion and saves it as a film, without a display. The camera is that of `config.viewer()`.

    A terminal shows a progress bar. Ctrl-C ends the call and leaves no file. The joint state does not change.

    Args:
        file: The file's name, which ends in .mp4 or .webm. A missing folder is created.
        config: The scene.
        path: A plan or another Trajectory; a `Recording` of a robot; joint vectors, shape (T, n), or poses of all
            frames, shape (T, frames, 7), like `komo.getPathFrames()`, at equal time steps. In a TaskPlan and in a
            Recording, objects move along.
        seconds: Duration of the film, s; None: that of the Trajectory or Recording, or 3.
        rate: Pictures per second.
        size: Width and height, pixels; by default those of the viewer's camera. Odd numbers are made even.
    Returns:
        The file's path.
    Raises:
        ArgumentError: The path, the name or a number is invalid, or a plan has no motion.
        ArgumentTypeError: The file's name, the scene or the size is of another type.
        NotFound: The package av (extra `film`) is not installed.
        OSError: The file cannot be written.
    """
    _require(file, config, size)
    motion = path if isinstance(path, (Trajectory, Recording)) else None
    duration = 3.0 if motion is None else _duration(motion)
    if duration <= 0:
        raise ArgumentError(f"saveFilm: {motion!r} has no motion")
    if seconds is None:
        seconds = duration
    target = Path(file)
    if target.suffix not in _CODECS:
        raise ArgumentError(f"saveFilm: the file is '{target}'; expected a name that ends in {' or '.join(_CODECS)}")
    if not (0 < seconds < float("inf") and 0 < rate < float("inf")):
        raise ArgumentError(f"saveFilm: seconds is {seconds} and rate is {rate}; expected numbers > 0")
    av = _encoder()
    count = max(2, round(seconds * rate))
    states = _states(config, np.asarray(path if motion is None else _rows(config, motion, count), float), count)
    viewer = config.viewer()
    config.view(False, None, offscreen=True)
    if size is not None:
        viewer.setWindow("", *size)
    target.parent.mkdir(parents=True, exist_ok=True)
    unfinished = target.with_name(target.name + ".part" + target.suffix)
    before = config.getFrameState() if states.ndim == 3 else config.getJointState()
    set_state = config.setFrameState if states.ndim == 3 else config.setJointState
    try:
        _write(av, unfinished, states, set_state, viewer, rate)
        unfinished.replace(target)
    finally:
        set_state(before)
        unfinished.unlink(missing_ok=True)
    return target


def _write(av: Any, file: Path, states: np.ndarray, set_state: Any, viewer: Any, rate: float) -> None:
    """Renders each picture while the previous one is encoded."""
    codec, options = _CODECS[file.suffix]
    began = time.monotonic()
    encoded: Future[None] | None = None
    with av.open(str(file), "w") as film, ThreadPoolExecutor(1) as encoder:
        stream = film.add_stream(codec, rate=Fraction(rate).limit_denominator(1000), options=options)
        stream.pix_fmt = "yuv420p"

        def encode(picture: np.ndarray) -> None:
            film.mux(stream.encode(av.VideoFrame.from_ndarray(picture, format="rgb24")))

        for done, state in enumerate(states):
            set_state(state)
            picture = viewer.getRgb()
            picture = np.ascontiguousarray(picture[: picture.shape[0] // 2 * 2, : picture.shape[1] // 2 * 2])
            if encoded is None:
                stream.height, stream.width = picture.shape[:2]
            else:
                encoded.result()
            encoded = encoder.submit(encode, picture)
            drawProgress(f"film {file.name.split('.part')[0]}", done + 1, len(states), time.monotonic() - began)
        if encoded is not None:
            encoded.result()
        film.mux(stream.encode())

"""Compares the page with reference pictures in `pictures/`.

Means of 8 x 8 pixels are compared, because machines draw edges and shadows slightly differently: they may differ by 6
of 255 on average over the picture, and by 40 in one place of a hundred. KINEGRAPH_RECORD=1 writes the pictures again.
"""

from __future__ import annotations

import os
import struct
import zlib
from pathlib import Path

import numpy as np

from kinegraph.png import writePng

PICTURES = Path(__file__).parent / "pictures"
CELL = 8  # pixels
MEAN, LARGE, SHARE = 6.0, 40, 0.01


def read_png(file: Path) -> np.ndarray:
    """A picture that writePng has written."""
    data = file.read_bytes()
    width, height = struct.unpack(">II", data[16:24])
    start = data.index(b"IDAT") + 4
    (length,) = struct.unpack(">I", data[start - 8 : start - 4])
    lines = np.frombuffer(zlib.decompress(data[start : start + length]), np.uint8).reshape(height, 1 + 3 * width)
    return lines[:, 1:].reshape(height, width, 3)


def shrink(picture: np.ndarray) -> np.ndarray:
    height, width, _ = picture.shape
    cells = picture.reshape(height // CELL, CELL, width // CELL, CELL, 3)
    return cells.mean(axis=(1, 3)).round().astype(np.uint8)


def difference(picture: np.ndarray, name: str, folder: Path) -> str:
    """Describes the difference from the reference picture, with pictures in `folder`; empty without one."""
    small, file = shrink(picture), PICTURES / f"{name}.png"
    apart = np.abs(small.astype(int) - read_png(file)).max(axis=2)
    mean, share = apart.mean(), (apart > LARGE).mean()
    if mean <= MEAN and share <= SHARE:
        return ""
    writePng(folder / f"{name}_is.png", picture)
    writePng(folder / f"{name}_difference.png", np.repeat(apart[..., None], 3, axis=2).clip(0, 255).astype(np.uint8))
    return f"{name}: {mean:.1f} on average, {100 * share:.1f} % far off; see {folder / name}_difference.png"


def check(picture: np.ndarray, name: str, folder: Path) -> None:
    """Fails if the picture is not the one of that name."""
    if os.environ.get("KINEGRAPH_RECORD"):
        writePng(PICTURES / f"{name}.png", shrink(picture))
    assert difference(picture, name, folder) == ""

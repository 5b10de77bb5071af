"""Writes pictures as PNG files, with the standard library only."""

from __future__ import annotations

import os
import struct
import zlib
from pathlib import Path

import numpy as np

from .errors import ArgumentError


def _chunk(kind: bytes, data: bytes) -> bytes:
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))


def encodePng(rgb: np.ndarray) -> bytes:
    """Encodes a picture, uint8 (height, width, 3), as PNG."""
    rgb = np.ascontiguousarray(rgb)
    if rgb.dtype != np.uint8 or rgb.ndim != 3 or rgb.shape[2] != 3 or rgb.size == 0:
        raise ArgumentError(f"writePng: the picture is {rgb.dtype} {rgb.shape}; expected uint8 (height, width, 3)")
    height, width, _ = rgb.shape
    lines = np.zeros((height, 1 + 3 * width), np.uint8)  # each starts with its filter: none
    lines[:, 1:] = rgb.reshape(height, -1)
    header = struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)
    parts = _chunk(b"IHDR", header) + _chunk(b"IDAT", zlib.compress(lines.tobytes(), 6)) + _chunk(b"IEND", b"")
    return b"\x89PNG\r\n\x1a\n" + parts


def writePng(path: str | os.PathLike[str], rgb: np.ndarray) -> None:
    """Writes a picture, uint8 (height, width, 3), as a PNG file. A missing folder is created."""
    png = encodePng(rgb)
    Path(path).parent.mkdir(parents=True, exist_ok=True)
    Path(path).write_bytes(png)


def removeNumbered(prefix: str) -> None:
    """Removes the pictures of `savePng` with that prefix: <prefix> and six digits."""
    folder, start = os.path.split(prefix)
    for file in Path(folder or ".").glob("*.png"):
        number = file.name.removeprefix(start).removesuffix(".png")
        if file.name.startswith(start) and len(number) == 6 and number.isdigit():
            file.unlink()

"""Reduces saved pages of the viewer such that they can be part of a notebook."""

from __future__ import annotations

import json
import re
import struct
import zlib
from base64 import b64decode, b64encode
from typing import Any

import numpy as np
from numpy.typing import NDArray

LARGEST = 900_000  # bytes of a page, if achievable
_MESH, _MOTION = 2, 4  # kinds of binary messages
_WORTH_IT = 1000  # smallest message that is packed, bytes
_FINEST = 2048  # grid cells along the largest mesh at the first merging of vertices
_COARSENINGS = 7  # each by a factor of two

_Words = NDArray[np.uint32]


def embeddedPage(page: str, largest: int = LARGEST) -> str:
    """Reduces a page: packs its script and messages, which browsers unpack. If that is not enough, merges close
    vertices of meshes.

    Args:
        page: A page saved by the viewer.
        largest: Target size, bytes.
    Returns:
        The smaller page.
    """
    recording = re.search(r'<script type="application/json" id="recording">(.*?)</script>', page, re.DOTALL)
    begin, end = page.rfind("<script>"), page.rfind("</script>")
    unpack = re.search(r'<script type="text/plain" id="unpack">(.*?)</script>', page, re.DOTALL)
    if not recording or not unpack:
        return page
    script = page[begin + len("<script>") : end]
    client = f'<script type="text/plain" id="client">{_base64(script.encode())}</script><script>{unpack[1]}</script>'
    before, after = page[: recording.start(1)], page[recording.end(1) : begin] + client + page[end + len("</script>") :]
    entries = json.loads(recording[1])
    binary = {i: b64decode(entry["binary"]) for i, entry in enumerate(entries) if "binary" in entry}
    meshes = {i: mesh for i, data in binary.items() if (mesh := _Mesh.read(data))}
    coarsest = max((mesh.extent for mesh in meshes.values()), default=0.0) / _FINEST * 2**_COARSENINGS
    small = before + after
    for step in range(_COARSENINGS + 2):
        cell = 0.0 if step == 0 else coarsest * 2.0 ** (step - 1 - _COARSENINGS)
        for i, data in binary.items():
            entries[i] = _packed(meshes[i].merged(cell) if i in meshes and cell > 0 else data)
        small = before + json.dumps(entries).replace("<", "\\u003c") + after
        if len(small) <= largest or not meshes:
            break
    return small


def _base64(data: bytes) -> str:
    return b64encode(zlib.compress(data, 9)).decode()


def _packed(data: bytes) -> dict[str, Any]:
    """Packs data in the smallest of several forms: differences of words at some distance, split into byte planes,
    deflated."""
    if len(data) < _WORTH_IT:
        return {"binary": b64encode(data).decode()}
    words = np.frombuffer(data + bytes(-len(data) % 4), np.uint32)
    strides = [3, 7 * struct.unpack_from("<I", data, 8)[0]] if words[0] == _MOTION else [3, 8]
    best = min(
        ((_base64(_differences(words, stride)), stride) for stride in strides), key=lambda packed: len(packed[0])
    )
    return {"packed": best[0], "bytes": len(data), "stride": best[1]}


def _differences(words: _Words, stride: int) -> bytes:
    change = words.copy()
    change[stride:] -= words[:-stride]
    signed = change.view(np.int32)
    code = (signed << 1) ^ (signed >> 31)
    return code.view(np.uint8).reshape(-1, 4).T.tobytes()


class _Mesh:
    """A mesh message: kind, number, and the counts of vertices, triangles, colors, texture coordinates and textured
    ranges."""

    def __init__(self, data: bytes, counts: tuple[int, ...]) -> None:
        self._number, vertices, triangles, colors = counts[:4]
        self._points = np.frombuffer(data, np.float32, 3 * vertices, 28).reshape(-1, 3).astype(float)
        self._triangles = np.frombuffer(data, np.uint32, 3 * triangles, 28 + 12 * vertices).reshape(-1, 3)
        self._colors = np.frombuffer(data, np.uint32, colors, 28 + 12 * (vertices + triangles))
        self.extent = float(np.linalg.norm(np.ptp(self._points, axis=0)))

    @classmethod
    def read(cls, data: bytes) -> _Mesh | None:
        """Returns None for other messages, point clouds, and textured meshes."""
        if len(data) < 28 or struct.unpack_from("<I", data)[0] != _MESH:
            return None
        counts = struct.unpack_from("<6I", data, 4)
        is_plain = counts[1] > 0 and counts[2] > 0 and counts[3] in (0, counts[1]) and counts[4] == counts[5] == 0
        return cls(data, counts) if is_plain else None

    def merged(self, cell: float) -> bytes:
        """Merges all vertices of one color in a cube of size `cell`, m, to their mean."""
        cells = np.floor((self._points - self._points.min(axis=0)) / cell).astype(np.int64)
        sizes = cells.max(axis=0) + 1
        key = (cells[:, 0] * sizes[1] + cells[:, 1]) * sizes[2] + cells[:, 2]
        if len(self._colors):
            key = key * len(self._colors) + np.unique(self._colors, return_inverse=True)[1].reshape(-1)
        _, first, cluster = np.unique(key, return_index=True, return_inverse=True)
        cluster = cluster.reshape(-1)
        count = np.bincount(cluster)
        mean = np.stack([np.bincount(cluster, self._points[:, k]) / count for k in range(3)], axis=1)
        triangles = _distinct(cluster[self._triangles])
        used, places = np.unique(triangles, return_index=True)
        used = used[np.argsort(places)]  # in the order of their use in triangles
        number = np.zeros(len(count), np.uint32)
        number[used] = np.arange(len(used), dtype=np.uint32)
        step = 2.0 ** np.floor(np.log2(cell / 4))  # multiples of a power of two have few bits
        points = (np.round(mean[used] / step) * step).astype(np.float32)
        colors = self._colors[first[used]] if len(self._colors) else self._colors
        head = struct.pack("<7I", _MESH, self._number, len(points), len(triangles), len(colors), 0, 0)
        return head + points.tobytes() + number[triangles].tobytes() + colors.tobytes()


def _distinct(triangles: NDArray[np.int64]) -> NDArray[np.int64]:
    """Removes repeated and degenerate triangles, and keeps the order."""
    a, b, c = triangles.T
    triangles = triangles[(a != b) & (b != c) & (c != a)]
    if len(triangles) == 0:
        return triangles
    turn = triangles.argmin(axis=1)
    turned = np.stack(
        [np.take_along_axis(triangles, ((turn + k) % 3)[:, None], axis=1)[:, 0] for k in range(3)], axis=1
    )
    return triangles[np.sort(np.unique(turned, axis=0, return_index=True)[1])]

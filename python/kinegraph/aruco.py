"""Marker images, drawn by OpenCV if it is installed."""

from __future__ import annotations

from typing import Any

import numpy as np

from .errors import ArgumentError, Error

_MARKERS = 50
_CELLS = 7  # 5 x 5 bits and a black border


def getArucoImage(id: int) -> np.ndarray[Any, np.dtype[np.uint8]]:
    """Draws one of the 50 ArUco markers with 5 x 5 bits.

    Args:
        id: Number of the marker, 0 .. 49.
    Returns:
        (9, 9) uint8, one pixel per cell: 0 black, 255 white; with a black border and a white one around it.
    Raises:
        ArgumentError: There is no such marker.
        Error: The package opencv-python-headless (or opencv-python) is not installed.
    """
    if not 0 <= id < _MARKERS:
        raise ArgumentError(f"getArucoImage: there is no marker {id}; expected 0 .. {_MARKERS - 1}")
    try:
        import cv2
    except ImportError as error:
        raise Error("getArucoImage needs OpenCV: pip install opencv-python-headless") from error
    markers = cv2.aruco.getPredefinedDictionary(cv2.aruco.DICT_5X5_50)
    image: np.ndarray[Any, np.dtype[np.uint8]] = np.full((_CELLS + 2, _CELLS + 2), 255, dtype=np.uint8)
    image[1:-1, 1:-1] = cv2.aruco.generateImageMarker(markers, int(id), _CELLS)
    return image

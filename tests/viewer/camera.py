"""Projects points of the scene to the page, independently of the page."""

from __future__ import annotations

import numpy as np

WIDTH, HEIGHT = 640, 480  # of the page, pixels
FOCAL_LENGTH = np.sqrt(3)  # heights of the page


class Camera:
    """An upright camera at `position` that faces `target`."""

    def __init__(self, position: list[float], target: list[float]) -> None:
        self.position, self.target = np.array(position, float), np.array(target, float)
        forward = self.target - self.position
        self._forward = forward / np.linalg.norm(forward)
        right = np.cross(self._forward, [0.0, 0.0, 1.0])
        self._right = right / np.linalg.norm(right)
        self._up = np.cross(self._right, self._forward)
        self.focal_length = FOCAL_LENGTH * HEIGHT

    def pixel(self, point: np.ndarray) -> tuple[int, int]:
        """Row and column."""
        ray = np.asarray(point) - self.position
        scale = self.focal_length / (ray @ self._forward)
        return round(HEIGHT / 2 - scale * (ray @ self._up)), round(WIDTH / 2 + scale * (ray @ self._right))

"""The structural similarity of two pictures."""

from __future__ import annotations

import numpy as np


def _blurred(image: np.ndarray) -> np.ndarray:
    """Averages with Gaussian weights (sigma 1.5) over 11 x 11 pixels; the border of 5 pixels is dropped."""
    weights = np.exp(-0.5 * (np.arange(-5, 6) / 1.5) ** 2)
    weights /= weights.sum()
    for axis in (0, 1):
        image = np.apply_along_axis(np.convolve, axis, image, weights, "valid")
    return image


def ssim(a: np.ndarray, b: np.ndarray) -> float:
    """Returns the mean structural similarity of two pictures, uint8 (h, w, 3): 1 if they are equal.

    Source: Wang, Bovik, Sheikh, Simoncelli: Image quality assessment, IEEE Trans. Image Processing 13(4), 2004; of the
    mean of the colors, with the paper's constants.
    """
    x, y = (np.asarray(image, float).mean(axis=2) for image in (a, b))
    c1, c2 = (0.01 * 255) ** 2, (0.03 * 255) ** 2
    mx, my = _blurred(x), _blurred(y)
    vx, vy, vxy = _blurred(x * x) - mx * mx, _blurred(y * y) - my * my, _blurred(x * y) - mx * my
    quality = (2 * mx * my + c1) * (2 * vxy + c2) / ((mx * mx + my * my + c1) * (vx + vy + c2))
    return float(quality.mean())

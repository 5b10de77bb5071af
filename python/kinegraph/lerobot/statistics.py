"""Statistics of features, as LeRobot normalizes by them."""

from __future__ import annotations

from typing import Any

import numpy as np

QUANTILES = {"q01": 0.01, "q10": 0.1, "q50": 0.5, "q90": 0.9, "q99": 0.99}
IMAGES = 100  # of an episode, at most, for the statistics of a camera
STRIDE = 2  # of their pixels

Statistics = dict[str, np.ndarray]


def statisticsOf(values: np.ndarray) -> Statistics:
    """Returns min, max, mean, std, count and quantiles over the first axis."""
    x = np.asarray(values, float).reshape(len(values), -1)
    result = {"min": x.min(0), "max": x.max(0), "mean": x.mean(0), "std": x.std(0), "count": np.array([len(x)])}
    for name, share in QUANTILES.items():
        result[name] = np.quantile(x, share, axis=0)
    return result


def imageStatistics(frames: list[np.ndarray]) -> Statistics:
    """Returns the statistics of the channels of images, (3, 1, 1) each, from 0 to 1; count is the number of images."""
    picked = np.unique(np.linspace(0, len(frames) - 1, min(len(frames), IMAGES)).astype(int))
    pixels = np.concatenate([frames[i][::STRIDE, ::STRIDE].reshape(-1, 3) for i in picked]) / 255.0
    result = {name: value.reshape(-1, 1, 1) for name, value in statisticsOf(pixels).items()}
    result["count"] = np.array([len(frames)])
    return result


def merged(parts: list[Statistics]) -> Statistics:
    """Returns the statistics of all parts together; quantiles are means of the parts', weighted by their counts."""
    count = np.array([part["count"][0] for part in parts], float)
    weights = (count / count.sum()).reshape((-1,) + (1,) * parts[0]["mean"].ndim)

    def mean(values: Any) -> np.ndarray:
        return np.asarray((weights * np.stack(list(values))).sum(0))

    center = mean(part["mean"] for part in parts)
    variance = mean(part["std"] ** 2 + (part["mean"] - center) ** 2 for part in parts)
    result = {
        "min": np.min([part["min"] for part in parts], 0),
        "max": np.max([part["max"] for part in parts], 0),
        "mean": center,
        "std": np.sqrt(variance),
        "count": np.array([int(count.sum())]),
    }
    for name in QUANTILES:
        result[name] = mean(part[name] for part in parts)
    return result

"""Common base of kinegraph.torch and kinegraph.jax: solutions as functions of arrays, with vector-Jacobian products, in
numpy."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._core import KOMO, Config, IkOptions, IkResults, Sensitivity, solveAll, solveIk
from .errors import ArgumentError

Numbers = NDArray[np.float64]


def _pose_gradient(pose: Numbers, tangent: Numbers) -> Numbers:
    """Converts a gradient by position and rotation vector to one by x y z qw qx qy qz, with a normalized quaternion.

    exp(r) q is q + 1/2 (0, r) q to first order, hence r = 2 vec(dq q*); changes of the norm of q have no effect.
    """
    norm = np.linalg.norm(pose[..., 3:], axis=-1, keepdims=True)
    w, x, y, z = np.moveaxis(pose[..., 3:] / norm, -1, 0)
    a, b, c = np.moveaxis(tangent[..., 3:], -1, 0)
    quaternion = np.stack(
        [-x * a - y * b - z * c, w * a + z * b - y * c, w * b - z * a + x * c, w * c + y * a - x * b], axis=-1
    )
    return np.concatenate([tangent[..., :3], 2 * quaternion / norm], axis=-1)


class IkSolutions:
    """The solution q (N, n) of solveIk for N targets, and gradients through it."""

    def __init__(
        self,
        config: Config,
        frames: Sequence[Any],
        options: IkOptions | None,
        threads: int,
        unsolved: str,
        **fields: float,
    ) -> None:
        if unsolved not in ("raise", "zero"):
            raise ArgumentError(f"unsolved is {unsolved!r}; expected 'raise' or 'zero'")
        self.config = config
        self.frames = list(frames)
        self.options = options
        self.threads = threads
        self.unsolved = unsolved
        self.fields = fields

    @property
    def size(self) -> int:
        return self.config.getJointDimension()

    def solve(self, values: Sequence[Numbers]) -> tuple[Numbers, IkResults]:
        targets: Mapping[Any, Any] = dict(zip(self.frames, values))
        for frame, value in targets.items():
            if value.ndim != 2:
                raise ArgumentError(f"targets[{frame!r}] has shape {value.shape}; expected (N, 3) or (N, 7)")
        results = solveIk(self.config, targets, self.options, threads=self.threads, **self.fields)
        failed = np.flatnonzero(~results.feasible)
        if len(failed) and self.unsolved == "raise":
            i = int(failed[0])
            raise ArgumentError(
                f"{len(failed)} of {len(results)} targets are unsolved and have no derivative; problem {i}: "
                f"{results[i].message}; unsolved='zero' sets their gradients to zero"
            )
        return results.q, results

    def gradients(self, values: Sequence[Numbers], results: IkResults, v: Numbers) -> list[Numbers]:
        by_numbers = np.nan_to_num(results.gradients(v, threads=self.threads), nan=0.0)
        if by_numbers.shape[1] == 0:
            return [np.zeros_like(value) for value in values]
        found, column = [], 0
        for value in values:
            width = 6 if value.shape[1] == 7 else value.shape[1]
            part = by_numbers[:, column : column + width]
            found.append(_pose_gradient(value, part) if value.shape[1] == 7 else part)
            column += width
        return found


class KomoSolutions:
    """The exact solutions x (N, n) of N motion problems made from arrays, and gradients through them."""

    def __init__(self, make: Callable[..., KOMO], parameters: Sequence[Any], threads: int) -> None:
        self.make = make
        self.parameters = list(parameters)
        self.threads = threads

    def solve(self, values: Sequence[Numbers]) -> tuple[Numbers, list[Sensitivity]]:
        if len(values) != len(self.parameters):
            raise ArgumentError(
                f"{len(values)} arrays for {len(self.parameters)} parameters; expected one per parameter"
            )
        counts = {len(value) for value in values}
        if len(counts) != 1:
            raise ArgumentError(f"the arrays have {sorted(counts)} rows; expected one row per problem in each")
        komos = [self.make(*row) for row in zip(*values)]
        results = solveAll(komos, threads=self.threads)
        exact = []
        for i in range(len(komos)):
            try:
                exact.append(results[i].sensitivity(*self.parameters))
            except ArgumentError as error:
                raise ArgumentError(f"problem {i}: {error}") from None
        return np.stack([one.x for one in exact]), exact

    def gradients(self, values: Sequence[Numbers], exact: Sequence[Sensitivity], v: Numbers) -> list[Numbers]:
        rows = [one.gradient(row) for one, row in zip(exact, v)]
        found: list[Numbers] = []
        for k, value in enumerate(values):
            parts = np.stack([row[one.columns(k)] for row, one in zip(rows, exact)])
            flat = value.reshape(len(value), -1)
            if flat.shape[1] == 7 and parts.shape[1] == 6:
                parts = _pose_gradient(flat, parts)
            if parts.shape[1] != flat.shape[1]:
                raise ArgumentError(
                    f"array {k} has {flat.shape[1]} entries per problem; {self.parameters[k]!r} has {parts.shape[1]}"
                )
            found.append(parts.reshape(value.shape))
        return found


def numbers(array: ArrayLike) -> Numbers:
    return np.ascontiguousarray(array, dtype=np.float64)

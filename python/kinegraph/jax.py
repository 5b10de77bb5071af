"""Solutions as functions in JAX, with gradients (`pip install 'kinegraph[jax]'`).

    from kinegraph.jax import solveIk
    reach = solveIk(C, ["l_gripper"])
    gradient = jax.grad(lambda positions: loss(reach(positions)))

They run on the host, in jit as well. Inputs are batches, a row per problem: they are solved by `threads` threads without the
interpreter lock. Set `jax_enable_x64` for more than six digits.
"""

from __future__ import annotations

from collections import OrderedDict
from collections.abc import Callable, Sequence
from typing import Any

import jax
import jax.numpy as jnp
import numpy as np

from ._core import KOMO, Config, IkOptions
from .solution_layers import IkSolutions, KomoSolutions, Numbers, numbers

_KEPT = 16  # solutions whose gradients may be asked for without solving again


def _function(problem: Any, size: Callable[..., int]) -> Callable[..., jax.Array]:
    """The solution as a function of arrays. Solutions are kept by their inputs: the same ones give the same bits."""
    kept: OrderedDict[bytes, Any] = OrderedDict()

    def solved(values: Sequence[Numbers]) -> Any:
        key = b"".join(value.tobytes() for value in values)
        if key not in kept:
            kept[key] = problem.solve(values)
            if len(kept) > _KEPT:
                kept.popitem(last=False)
        return kept[key]

    def onHost(*inputs: Any) -> Any:
        values = [numbers(value) for value in inputs]
        return np.asarray(solved(values)[0], dtype=inputs[0].dtype)

    def gradientsOnHost(v: Any, *inputs: Any) -> Any:
        values = [numbers(value) for value in inputs]
        found = problem.gradients(values, solved(values)[1], numbers(v))
        return tuple(np.asarray(g, dtype=value.dtype) for g, value in zip(found, inputs))

    def shapeOf(*inputs: Any) -> jax.ShapeDtypeStruct:
        return jax.ShapeDtypeStruct((inputs[0].shape[0], size(*inputs)), inputs[0].dtype)

    @jax.custom_vjp
    def solution(*inputs: Any) -> Any:
        return jax.pure_callback(onHost, shapeOf(*inputs), *inputs, vmap_method="sequential")

    def forward(*inputs: Any) -> tuple[Any, Any]:
        return solution(*inputs), inputs

    def backward(inputs: Any, v: Any) -> Any:
        shapes = tuple(jax.ShapeDtypeStruct(value.shape, value.dtype) for value in inputs)
        return jax.pure_callback(gradientsOnHost, shapes, v, *inputs, vmap_method="sequential")

    solution.defvjp(forward, backward)
    return lambda *inputs: solution(*(jnp.asarray(value, dtype=float) for value in inputs))


def solveIk(
    config: Config,
    frames: Sequence[Any],
    options: IkOptions | None = None,
    *,
    threads: int = 1,
    unsolved: str = "raise",
    **fields: float,
) -> Callable[..., jax.Array]:
    """Joint values as a function of batches of targets.

    Args:
        config: Scene; not modified, and to stay as it is.
        frames: Names of the frames that targets are for.
        options: IkOptions; fields of it by name override.
        threads: Threads to share the work.
        unsolved: What becomes of problems without an answer: "raise", or "zero" for a gradient of zero.
        fields: Fields of IkOptions.
    Returns:
        A function of an array per frame, positions (N, 3) or poses (N, 7), to q, shape (N, n), rad or m.
    Raises:
        ArgumentError: Shapes do not fit, or a problem has no answer; when the function is called.
    """
    problem = IkSolutions(config, frames, options, threads, unsolved, **fields)
    return _function(problem, lambda *_: problem.size)


def solve(
    make: Callable[..., KOMO], parameters: Sequence[Any], size: int, *, threads: int = 1
) -> Callable[..., jax.Array]:
    """Solutions of motion problems as a function of what they are made of.

    Args:
        make: Called with a row of each of the arrays (numpy), returns a KOMO; the same one for the same rows.
        parameters: What each array is in the problem, as `SolverReturn.sensitivity` takes it: ("box", "pose") for rows x y
            z qw qx qy qz, "box" for positions, an objective for its target, ...
        size: Number of variables of the problems.
        threads: Threads to share the work.
    Returns:
        A function of arrays with a row per problem to x, shape (N, size), to rounding.
    Raises:
        ArgumentError: A problem is not solved, or numbers do not fit; when the function is called.
    """
    return _function(KomoSolutions(make, parameters, threads), lambda *_: size)

"""Solutions as functions in JAX, with gradients (`pip install 'kinegraph[jax]'`).

    from kinegraph.jax import solveIk
    reach = solveIk(C, ["l_gripper"])
    gradient = jax.grad(lambda positions: loss(reach(positions)))

They run on the host, also within jit. Inputs are batches, one row per problem: `threads` threads solve them without the
interpreter lock. Set `jax_enable_x64` for more than six digits.
"""

from __future__ import annotations

from collections import OrderedDict
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from ._core import KOMO, Config, IkOptions
from .solution_layers import IkSolutions, KomoSolutions, Numbers, numbers

try:
    import jax
    import jax.numpy as jnp
except ModuleNotFoundError as error:
    raise ModuleNotFoundError(
        "kinegraph.jax needs the package jax: pip install 'kinegraph[jax]'", name=error.name
    ) from None

_CACHE_SIZE = 16  # cached solutions, whose gradients need no further solve


def _function(problem: Any, size: Callable[..., int]) -> Callable[..., jax.Array]:
    """Returns the solution as a function of arrays. Solutions are cached by their inputs: equal ones give equal
    bits."""
    cached: OrderedDict[bytes, Any] = OrderedDict()

    def solved(values: Sequence[Numbers]) -> Any:
        key = b"".join(value.tobytes() for value in values)
        if key not in cached:
            cached[key] = problem.solve(values)
            if len(cached) > _CACHE_SIZE:
                cached.popitem(last=False)
        return cached[key]

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
    """Returns joint values as a function of batches of targets.

    Args:
        config: Scene. Not modified; it must not change later.
        frames: Names of the frames with targets.
        options: IkOptions; fields of it by name override.
        threads: Number of threads.
        unsolved: Handling of unsolved problems: "raise", or "zero" for a gradient of zero.
        fields: Fields of IkOptions.
    Returns:
        A function from one array per frame, positions (N, 3) or poses (N, 7), to q, shape (N, n), rad or m.
    Raises:
        ArgumentError: A shape is wrong, or a problem is unsolved; when the function is called.
    """
    problem = IkSolutions(config, frames, options, threads, unsolved, **fields)
    return _function(problem, lambda *_: problem.size)


def solve(
    make: Callable[..., KOMO], parameters: Sequence[Any], size: int, *, threads: int = 1
) -> Callable[..., jax.Array]:
    """Returns solutions of motion problems as a function of their parameters.

    Args:
        make: Called with a row of each array (numpy), returns a KOMO; always the same one for the same rows.
        parameters: The role of each array in the problem, as for `SolverReturn.sensitivity`: ("box", "pose") for rows x
            y z qw qx qy qz, "box" for positions, an objective for its target, ...
        size: Number of variables of the problems.
        threads: Number of threads.
    Returns:
        A function from arrays with a row per problem to x, shape (N, size), exact to rounding.
    Raises:
        ArgumentError: A problem is unsolved, or a size is wrong; when the function is called.
    """
    return _function(KomoSolutions(make, parameters, threads), lambda *_: size)

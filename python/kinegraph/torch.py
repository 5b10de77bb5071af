"""Solutions as functions in PyTorch, with gradients (`pip install 'kinegraph[torch]'`).

    from kinegraph.torch import solveIk
    q = solveIk(C, {"l_gripper": positions})  # (N, 3), may require gradients
    loss(q).backward()

Inputs are batches, one row per problem: `threads` threads solve them without the interpreter lock. Gradients are those
of `result.sensitivity`: one linear solve per problem.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np

from ._core import KOMO, Config, IkOptions
from .solution_layers import IkSolutions, KomoSolutions, numbers

try:
    import torch
except ModuleNotFoundError as error:
    raise ModuleNotFoundError(
        "kinegraph.torch needs the package torch: pip install 'kinegraph[torch]'", name=error.name
    ) from None


class _Solution(torch.autograd.Function):
    @staticmethod
    def forward(ctx: Any, problem: Any, *inputs: torch.Tensor) -> torch.Tensor:
        ctx.problem = problem
        ctx.inputs = inputs
        ctx.values = [numbers(tensor.detach().cpu().numpy()) for tensor in inputs]
        x, ctx.found = problem.solve(ctx.values)
        return torch.from_numpy(np.array(x)).to(inputs[0])

    @staticmethod
    def backward(ctx: Any, *outputs: torch.Tensor) -> tuple[Any, ...]:
        v = numbers(outputs[0].detach().cpu().numpy())
        gradients = ctx.problem.gradients(ctx.values, ctx.found, v)
        return (None, *(torch.from_numpy(g).to(tensor) for g, tensor in zip(gradients, ctx.inputs)))


def solveIk(
    config: Config,
    targets: Mapping[Any, torch.Tensor],
    options: IkOptions | None = None,
    *,
    threads: int = 1,
    unsolved: str = "raise",
    **fields: float,
) -> torch.Tensor:
    """Returns joint values for batches of targets, differentiable by the targets.

    Args:
        config: Scene. Not modified.
        targets: Frame name -> positions (N, 3) or poses (N, 7), x y z qw qx qy qz, in the world.
        options: IkOptions; fields of it by name override.
        threads: Number of threads.
        unsolved: Handling of unsolved problems: "raise", or "zero" for a gradient of zero.
        fields: Fields of IkOptions.
    Returns:
        q, shape (N, n), rad or m; redundant joints move as little as possible.
    Raises:
        ArgumentError: A shape is wrong, or a problem is unsolved.
        NotFound: There is no such frame.
    """
    problem = IkSolutions(config, list(targets), options, threads, unsolved, **fields)
    q: torch.Tensor = _Solution.apply(problem, *targets.values())
    return q


def solve(
    make: Callable[..., KOMO], values: Sequence[torch.Tensor], parameters: Sequence[Any], *, threads: int = 1
) -> torch.Tensor:
    """Returns solutions of motion problems, differentiable by their parameters.

    Args:
        make: Called with a row of each array (numpy), returns a KOMO.
        values: Arrays with a row per problem.
        parameters: The role of each array in the problem, as for `SolverReturn.sensitivity`: ("box", "pose") for rows x
            y z qw qx qy qz, "box" for positions, an objective for its target, ...
        threads: Number of threads.
    Returns:
        x, shape (N, n), exact to rounding: joint values of the slices, one after the other.
    Raises:
        ArgumentError: A problem is unsolved, or a size is wrong.
    """
    x: torch.Tensor = _Solution.apply(KomoSolutions(make, parameters, threads), *values)
    return x

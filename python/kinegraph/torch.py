"""Solutions as functions in PyTorch, with gradients (`pip install 'kinegraph[torch]'`).

    from kinegraph.torch import solveIk
    q = solveIk(C, {"l_gripper": positions})  # (N, 3), may require gradients
    loss(q).backward()

Inputs are batches, a row per problem: they are solved by `threads` threads without the interpreter lock. Gradients are those
of `result.sensitivity`: one solution of a linear system per problem.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np
import torch

from ._core import KOMO, Config, IkOptions
from .solution_layers import IkSolutions, KomoSolutions, numbers


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
    """Joint values for batches of targets, differentiable by the targets.

    Args:
        config: Scene; not modified.
        targets: Frame name -> positions (N, 3) or poses (N, 7), x y z qw qx qy qz, in the world.
        options: IkOptions; fields of it by name override.
        threads: Threads to share the work.
        unsolved: What becomes of problems without an answer: "raise", or "zero" for a gradient of zero.
        fields: Fields of IkOptions.
    Returns:
        q, shape (N, n), rad or m; along the shortest way where the targets leave joints free.
    Raises:
        ArgumentError: Shapes do not fit, or a problem has no answer.
        NotFound: A frame is not there.
    """
    problem = IkSolutions(config, list(targets), options, threads, unsolved, **fields)
    q: torch.Tensor = _Solution.apply(problem, *targets.values())
    return q


def solve(
    make: Callable[..., KOMO], values: Sequence[torch.Tensor], parameters: Sequence[Any], *, threads: int = 1
) -> torch.Tensor:
    """Solutions of motion problems, differentiable by what they are made of.

    Args:
        make: Called with a row of each of the values (numpy), returns a KOMO.
        values: Arrays with a row per problem.
        parameters: What each of the values is in the problem, as `SolverReturn.sensitivity` takes it: ("box", "pose") for
            rows x y z qw qx qy qz, "box" for positions, an objective for its target, ...
        threads: Threads to share the work.
    Returns:
        x, shape (N, n), to rounding: joint values of the slices, one after the other.
    Raises:
        ArgumentError: A problem is not solved, or numbers do not fit.
    """
    x: torch.Tensor = _Solution.apply(KomoSolutions(make, parameters, threads), *values)
    return x

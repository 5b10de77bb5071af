"""Solvers of other packages behind `OptMethod.Ipopt` and `OptMethod.NLopt`: `pip install kinegraph[ipopt]`,
`[nlopt]`."""

from __future__ import annotations

import importlib
from collections.abc import Callable
from typing import Any

import numpy as np

from ._core import OT
from .errors import Error

_CONSTRAINTS = (OT.eq, OT.ineq, OT.ineqB)


class _Stopped(Exception):
    """The caller cancelled."""


def _require(module: str, method: str, extra: str) -> Any:
    try:
        return importlib.import_module(module)
    except ImportError as error:
        raise Error(
            f"OptMethod.{method} needs the package {module}, which is not installed: pip install 'kinegraph[{extra}]'"
        ) from error


class _Functions:
    """The problem as cost, constraints and their derivatives. The last point is cached: solvers query them one after
    another."""

    def __init__(self, problem: dict[str, Any]):
        self.evaluate: Callable = problem["evaluate"]
        types = problem["types"]
        self.f = [i for i, t in enumerate(types) if t == OT.f]
        self.sos = [i for i, t in enumerate(types) if t == OT.sos]
        self.penalties = [i for i, t in enumerate(types) if t == OT.ineqP]
        self.rows = [i for i, t in enumerate(types) if t in _CONSTRAINTS]
        self.equality = np.array([types[i] == OT.eq for i in self.rows], dtype=bool)
        self.max_evals, self.evals, self.stopped = problem["max_evals"], 0, ""
        self.x: np.ndarray | None = None
        self.best: tuple[float, float, np.ndarray] | None = None
        self.tolerance = problem["constraint_tolerance"]

    def at(self, x: np.ndarray) -> _Functions:
        if self.x is not None and np.array_equal(x, self.x):
            return self
        if self.evals >= self.max_evals:
            self.stopped = "limit"
            raise _Stopped
        answer = self.evaluate(x)
        self.evals += 1
        if answer is False:
            self.stopped = "cancelled"
            raise _Stopped
        self.phi, self.J = answer
        self.x = np.array(x)
        missed = np.where(self.equality, abs(self.constraints()), np.maximum(0.0, self.constraints()))
        violation = max(missed.max(initial=0.0), self.tolerance)
        if self.best is None or (violation, self.cost()) < self.best[:2]:
            self.best = (violation, self.cost(), self.x)
        return self

    def cost(self) -> float:
        p = np.maximum(0.0, self.phi[self.penalties])
        return float(self.phi[self.f].sum() + (self.phi[self.sos] ** 2).sum() + (p**2).sum())

    def gradient(self) -> np.ndarray:
        p = np.maximum(0.0, self.phi[self.penalties])
        return self.J[self.f].sum(0) + 2 * self.phi[self.sos] @ self.J[self.sos] + 2 * p @ self.J[self.penalties]

    def constraints(self) -> np.ndarray:
        return self.phi[self.rows]

    def jacobian(self) -> np.ndarray:
        return self.J[self.rows]

    def answer(self, x: np.ndarray | None, status: str, message: str) -> dict[str, Any]:
        if self.stopped:
            status = self.stopped
            message = f"limit of {self.max_evals} evaluations" if status == "limit" else "cancelled by the caller"
        if x is None or self.stopped:
            x = self.best[2] if self.best else self.x
        return {"x": x, "status": status, "message": message}


def ipopt(problem: dict[str, Any]) -> dict[str, Any]:
    """Solves by IPOPT with a limited-memory Hessian."""
    ipyopt = _require("ipyopt", "Ipopt", "ipopt")
    functions = _Functions(problem)
    x0 = problem["x0"]
    functions.at(x0)
    n, m = len(x0), len(functions.rows)

    def evaluate(x: np.ndarray) -> _Functions | None:
        try:
            return functions.at(x)
        except _Stopped:
            return None  # the callback between iterations ends the solve; exceptions would be lost in C

    def cost(x: np.ndarray) -> float:
        return functions.cost() if evaluate(x) else np.inf

    def gradient(x: np.ndarray, out: np.ndarray) -> np.ndarray:
        evaluate(x)
        out[:] = functions.gradient()
        return out

    def constraints(x: np.ndarray, out: np.ndarray) -> np.ndarray:
        evaluate(x)
        out[:] = functions.constraints()
        return out

    def jacobian(x: np.ndarray, out: np.ndarray) -> np.ndarray:
        evaluate(x)
        out[:] = functions.jacobian().ravel()
        return out

    rows, columns = np.divmod(np.arange(n * m), n)
    solver = ipyopt.Problem(
        n=n,
        x_l=problem["lower"],
        x_u=problem["upper"],
        m=m,
        g_l=np.where(functions.equality, 0.0, -2e19),
        g_u=np.zeros(m),
        sparsity_indices_jac_g=(rows, columns),
        sparsity_indices_h=(np.array([], dtype=int), np.array([], dtype=int)),
        eval_f=cost,
        eval_grad_f=gradient,
        eval_g=constraints,
        eval_jac_g=jacobian,
        intermediate_callback=lambda *_: not functions.stopped,
        ipopt_options={
            "hessian_approximation": "limited-memory",
            "tol": problem["tolerance"],
            "constr_viol_tol": problem["constraint_tolerance"],
            "bound_relax_factor": 0.0,
            "print_level": 5 if problem["verbose"] > 2 else 0,
            "sb": "yes",
            "max_iter": problem["max_evals"],
        },
    )
    x, _, code = solver.solve(x0.copy())
    status = {0: "converged", 1: "converged", 2: "infeasible", -1: "limit"}.get(int(code), "stalled")
    return functions.answer(
        np.clip(x, problem["lower"], problem["upper"]), status, f"Ipopt ended with code {int(code)}"
    )


def nlopt(problem: dict[str, Any]) -> dict[str, Any]:
    """Solves by NLopt's SLSQP."""
    library = _require("nlopt", "NLopt", "nlopt")
    functions = _Functions(problem)
    x0 = problem["x0"]
    optimizer = library.opt(library.LD_SLSQP, len(x0))
    optimizer.set_lower_bounds(problem["lower"])
    optimizer.set_upper_bounds(problem["upper"])
    optimizer.set_xtol_abs(0.1 * problem["tolerance"])

    def cost(x: np.ndarray, gradient: np.ndarray) -> float:
        functions.at(x)
        if gradient.size:
            gradient[:] = functions.gradient()
        return functions.cost()

    def rows(wanted: np.ndarray) -> Callable:
        def constraints(result: np.ndarray, x: np.ndarray, gradient: np.ndarray) -> None:
            functions.at(x)
            if gradient.size:
                gradient[:] = functions.jacobian()[wanted]
            result[:] = functions.constraints()[wanted]

        return constraints

    optimizer.set_min_objective(cost)
    for wanted, add in (
        (functions.equality, optimizer.add_equality_mconstraint),
        (~functions.equality, optimizer.add_inequality_mconstraint),
    ):
        if wanted.any():
            add(rows(wanted), np.full(int(wanted.sum()), problem["constraint_tolerance"]))
    x, status, message = None, "stalled", ""
    try:
        x = optimizer.optimize(x0)
        status = "converged" if optimizer.last_optimize_result() > 0 else "stalled"
        message = f"NLopt ended with code {optimizer.last_optimize_result()}"
    except _Stopped:
        pass
    except (library.RoundoffLimited, RuntimeError) as error:
        message = f"NLopt: {error}"
    return functions.answer(x, status, message)

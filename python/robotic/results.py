"""Solver results by the reference's feasibility rule: summed violations, while Kinegraph checks each constraint."""

from __future__ import annotations

from typing import Any

import kinegraph

from .nlp import NLP

BOUND = 0.1
FORMER_OPTIONS = {"maxLambda": "lambdaMax", "maxStep": "stepMax"}


class SolverReturn(kinegraph.SolverReturn):
    """How a solve ended.

    evals counts all solves of the solver, as in the reference. feasible: the violations of all equalities sum up to
    less than 0.1, and so do those of all inequalities. If kinegraph's rule disagrees, message gives the violation of
    the worst constraint. explain() has details.
    """

    @property
    def evals(self) -> int:
        """Number of evaluations of all solves of the solver so far, this one included."""
        return self.totalEvals

    @property
    def feasible(self) -> bool:
        """The summed violations of equalities, and those of inequalities, are below 0.1."""
        return bool(self.done and self.eq < BOUND and self.ineq < BOUND)

    @property
    def message(self) -> str:
        """Why the solver stopped, in one line, and the violations if some constraints do not hold."""
        text = super().message
        if super().feasible or not self.done:
            return text
        verdict = "feasible" if self.feasible else "not feasible"
        return (
            f"{text}; {verdict} by the rule of robotic (eq and ineq below {BOUND}): "
            f"eq {self.eq:.3g}, ineq {self.ineq:.3g}; the worst constraint is violated by {self.violation:.3g}"
        )

    def dict(self) -> dict[str, Any]:
        """Returns evals, time, done, feasible, f, sos, ineq, eq."""
        return {**super().dict(), "evals": self.evals, "feasible": self.feasible}

    def __str__(self) -> str:
        text = super().__str__().replace(f"evals: {super().evals}", f"evals: {self.evals}", 1)
        return text.replace(f"feasible: {int(super().feasible)}", f"feasible: {int(self.feasible)}", 1)

    def __repr__(self) -> str:
        return f"<SolverReturn {self.status.name}: {self}>"


def _named(problem: Any) -> Any:
    """Returns a problem with the attributes that the solver reads; older ones have methods instead."""
    if all(hasattr(problem, name) for name in ("dimension", "bounds")) and not _overrides(problem):
        return problem
    return _Methods(problem)


def _overrides(problem: Any) -> bool:
    """Whether a subclass of nlp.NLP describes itself by methods."""
    base = NLP
    return isinstance(problem, base) and any(
        getattr(type(problem), name) is not getattr(base, name)
        for name in ("getDimension", "getFeatureTypes", "getBounds")
    )


class _Methods:
    """A problem whose dimension, types and bounds come from methods."""

    def __init__(self, problem: Any) -> None:
        self._problem = problem

    def _value(self, method: str, *names: str) -> Any:
        if hasattr(self._problem, method):
            return getattr(self._problem, method)()
        found = [name for name in names if hasattr(self._problem, name)]
        return getattr(self._problem, (found or names)[0])

    @property
    def dimension(self) -> int:
        return int(self._value("getDimension", "dimension"))

    @property
    def types(self) -> Any:
        return self._value("getFeatureTypes", "types", "featureTypes")

    @property
    def bounds(self) -> Any:
        return self._value("getBounds", "bounds")

    def __getattr__(self, name: str) -> Any:
        return getattr(self._problem, name)


class NLP_Solver(kinegraph.NLP_Solver):
    """Solves an NLP, as kinegraph.NLP_Solver; feasibility of results follows the reference's rule.

    Variables and errors of each evaluation are recorded without setTracing.
    """

    def __init__(self, *args: Any, **kwargs: Any) -> None:
        super().__init__(*args, **kwargs)
        super().setTracing(True, True)

    def setPyProblem(self, problem: object) -> NLP_Solver:
        """Sets a Python object as the problem, with attributes or with getDimension, getFeatureTypes and getBounds.

        Args:
            problem: Object with dimension, types, bounds, or these methods, and evaluate(x) -> (phi, J).
        Returns:
            The solver.
        Raises:
            ArgumentError: The problem lacks something, or a size is wrong.
        """
        super().setPyProblem(_named(problem))
        return self

    def solve(self, resampleInitialization: int = -1, verbose: int = -100) -> SolverReturn:
        """Solves from the last x or the problem's initial point. Ctrl-C ends the solve and returns the best x so far.

        Args:
            resampleInitialization: 1: from a new initial point; 0: from the last x; -1: from the last x, if any.
            verbose: Overrides the option, if given.
        Returns:
            The outcome; not converging is not an error.
        """
        return SolverReturn(super().solve(resampleInitialization, verbose))

    def setOptions(self, **options: Any) -> NLP_Solver:
        """Sets options by name, including former names (maxLambda, maxStep).

        Args:
            options: The fields of NLP_SolverOptions.
        Raises:
            ArgumentError: An option does not exist, or its value is out of range.
        """
        super().setOptions(**{FORMER_OPTIONS.get(name, name): value for name, value in options.items()})
        return self

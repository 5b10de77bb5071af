#pragma once

/// The manual of what bind_solvers.cpp binds.
namespace kinegraph::python::docs::solvers {

inline constexpr char copy[] = R"(A copy.

Args:
    other: What is copied.)";

inline constexpr char explain[] =
    R"(Says which objectives and limits contradict each other where this ended, in which slices, by how many m or rad, and
which single one helps most if it gives way. Solves small problems; leaves a KOMO at this solution.

Args:
    tolerance: Largest violation that counts as none.
Returns:
    A few lines.
Raises:
    Error: Nothing was solved.)";

inline constexpr char conflicts[] = R"(What explain says.

Args:
    tolerance: Largest violation that counts as none.
Returns:
    A dict per constraint: name, type, frames, slices, meters, radians, scaled, details, pull, and of giving way:
    suffices, by_meters, by_radians, by_scaled, best. Empty if all constraints hold.
Raises:
    Error: Nothing was solved.)";

inline constexpr char makeSolver[] = R"(A solver of a problem.

Args:
    problem: The problem.
    verbose: 1 prints a line at the end, more prints steps.)";

inline constexpr char setProblem[] = R"(Sets the problem to solve; once.

Args:
    problem: The problem.
Returns:
    The solver itself.
Raises:
    Error: There is a problem already.)";

inline constexpr char setPyProblem[] = R"(Sets the problem to solve, a Python object.

Args:
    problem: With dimension, types, bounds and evaluate(x) -> (phi, J).
Returns:
    The solver itself.
Raises:
    ArgumentError: It lacks one of these.)";

inline constexpr char setSolver[] = R"(Sets the method.

Args:
    method: Of OptMethod.
Returns:
    The solver itself.)";

inline constexpr char setInitialization[] = R"(Sets where to start.

Args:
    x: Shape (n,); clipped to the bounds.
Returns:
    The solver itself.
Raises:
    ArgumentError: x has another size.)";

inline constexpr char setProgress[] = R"(Sets a function that is called while it solves, and can end it.

Args:
    function: Called with a dict of evals (of this solve), x, f, sos, ineq, eq; False as its answer ends the solve. None: no more
        calls.
    seconds: Least time cancellation two calls, s.
Returns:
    The solver itself.
Raises:
    ArgumentError: A negative time.)";

inline constexpr char setTracing[] = R"(Sets what is recorded of each evaluation.

Args:
    trace_x: The variables.
    trace_errs: The sums of f, sos, ineq and eq.
    trace_phi: The residuals.
    trace_J: The Jacobians.
Returns:
    The solver itself.)";

inline constexpr char solve[] =
    R"(Solves, from the last x or the problem's initial point. Ctrl-C ends it: the result is then the best so far, with
status cancelled.

Args:
    resampleInitialization: 1: from a new initial point of the problem.
    verbose: As that of the options; -100 leaves it as it is.
Returns:
    The SolverReturn. Not converging is a status of it, not an error.
Raises:
    Error: There is no problem.)";

inline constexpr char reportLagrangeGradients[] = R"(What each objective does where this ended.

Args:
    featureNames: A name per residual; [] for those of the problem.
Returns:
    A dict from the objective's name to err (its error), grad (length of its part of the Lagrangian's gradient) and
    type, the largest grad first, without those whose error is 0.
Raises:
    Error: Nothing was solved.)";

}  // namespace kinegraph::python::docs::solvers

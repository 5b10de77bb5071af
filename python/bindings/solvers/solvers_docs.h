#pragma once

/// The manual of what bind_solvers.cpp binds.
namespace kinegraph::python::docs::solvers {

inline constexpr char copy[] = R"(Copies a result.

Args:
    other: The result.)";

inline constexpr char explain[] =
    R"(Explains which objectives and limits contradict each other at this solution: in which slices, by how many m or
rad, and which single relaxation helps most. Solves small problems; leaves a KOMO at this solution.

Args:
    tolerance: Largest accepted violation.
Returns:
    A few lines.
Raises:
    Error: Nothing was solved.)";

inline constexpr char conflicts[] = R"(Returns the content of explain as data.

Args:
    tolerance: Largest accepted violation.
Returns:
    A dict per constraint: name, type, frames, slices, meters, radians, scaled, details, pull, and of its relaxation:
    suffices, by_meters, by_radians, by_scaled, best. Empty if all constraints hold.
Raises:
    Error: Nothing was solved.)";

inline constexpr char makeSolver[] = R"(Creates a solver of a problem.

Args:
    problem: The problem.
    verbose: 1 logs a line at the end; larger values log steps.)";

inline constexpr char setProblem[] = R"(Sets the problem. Only one call is allowed.

Args:
    problem: The problem.
Returns:
    The solver itself.
Raises:
    Error: The solver has a problem already.)";

inline constexpr char setPyProblem[] = R"(Sets a Python object as the problem.

Args:
    problem: Object with dimension, types, bounds and evaluate(x) -> (phi, J).
Returns:
    The solver itself.
Raises:
    ArgumentError: The object lacks one of these.)";

inline constexpr char setSolver[] = R"(Sets the method.

Args:
    method: An OptMethod.
Returns:
    The solver itself.)";

inline constexpr char setInitialization[] = R"(Sets the initial point.

Args:
    x: Shape (n,); clipped to the bounds.
Returns:
    The solver itself.
Raises:
    ArgumentError: x has another size.)";

inline constexpr char setProgress[] = R"(Sets a function that observes the solve and can end it.

Args:
    function: Called with a dict of evals (of this solve), x, f, sos, ineq, eq; the solve ends if it returns False. None
        removes the function.
    seconds: Least time between two calls, s.
Returns:
    The solver itself.
Raises:
    ArgumentError: A negative time.)";

inline constexpr char setTracing[] = R"(Selects the records of each evaluation.

Args:
    trace_x: Records the variables.
    trace_errs: Records the sums of f, sos, ineq and eq.
    trace_phi: Records the residuals.
    trace_J: Records the Jacobians.
Returns:
    The solver itself.)";

inline constexpr char solve[] =
    R"(Solves the problem from the last x or its initial point. After Ctrl-C the result is the best point so far, with
status cancelled.

Args:
    resampleInitialization: 1 starts from a new initial point of the problem.
    verbose: Replaces that of the options; -100 keeps it.
Returns:
    The SolverReturn. Not converging is a status, not an error.
Raises:
    Error: There is no problem.)";

inline constexpr char reportLagrangeGradients[] =
    R"(Reports the contribution of each objective to the gradient of the Lagrangian at the solution.

Args:
    featureNames: One name per residual; [] for those of the problem.
Returns:
    A dict from the objective's name to err (its error), grad (norm of its part of the gradient of the Lagrangian)
    and type, the largest grad first. Objectives without an error and without a multiplier are omitted.
Raises:
    Error: Nothing was solved.)";

}  // namespace kinegraph::python::docs::solvers

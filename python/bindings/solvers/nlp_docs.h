#pragma once

/// The manual of what bind_nlp.cpp binds.
namespace kinegraph::python::docs::nlp {

inline constexpr char evaluate[] = R"(Evaluates the residuals and their Jacobian.

Args:
    x: Variables, shape (n,).
Returns:
    phi, shape (d,), and J: shape (d, n), or for motion problems triplets (row, column, value), shape (k, 3).
Raises:
    ArgumentError: x has another size.)";

inline constexpr char eval_scalar[] =
    R"(Evaluates sum f + sum sos^2 with gradient and Hessian, for problems without constraints.

Args:
    x: Variables, shape (n,).
Returns:
    The value, the gradient (n,), and the Hessian (n, n), of sos as 2 J^T J.
Raises:
    ArgumentError: x has another size.)";

inline constexpr char getFHessian[] = R"(Evaluates the Hessian of sum f.

Args:
    x: Variables, shape (n,).
Returns:
    Shape (n, n); (0, 0) if the problem does not know it.
Raises:
    ArgumentError: x has another size.)";

inline constexpr char checkJacobian[] =
    R"(Compares the Jacobian with central differences, and prints the ten worst entries.

Args:
    x: Variables, shape (n,); another size selects a random point.
    tolerance: Largest accepted difference.
    featureNames: One name per residual.
Returns:
    True if no difference is larger.
Raises:
    ArgumentError: Another number of names.)";

inline constexpr char checkHessian[] = R"(Compares getFHessian with central differences, and prints the worst entry.

Args:
    x: Variables, shape (n,); another size selects a random point.
    tolerance: Largest accepted difference.
Returns:
    True if no difference is larger.
Raises:
    ArgumentError: The Hessian has another size.)";

inline constexpr char aug_lag[] =
    R"(Returns this problem with costs instead of its constraints. A weight below 0 keeps the constraints.

Args:
    muSquaredPenalty: Weight of the costs phi^2 (for inequalities: of violations only).
    muLogBarrier: Weight of the costs -log(-phi) of inequalities.
Returns:
    The new problem.)";

inline constexpr char summarizeErrors[] = R"(Sums residuals by type.

Args:
    phi: Residuals, shape (d,).
Returns:
    Sums of f, sos, ineq and eq, shape (4,).
Raises:
    ArgumentError: phi has another size.)";

inline constexpr char explain[] =
    R"(Explains which constraints contradict each other around a point, by how much, and which relaxation helps.

Args:
    x: Variables, shape (n,).
    tolerance: Largest accepted violation.
Returns:
    A few lines.
Raises:
    ArgumentError: x has another size.)";

inline constexpr char conflicts[] = R"(Returns the content of explain as data.

Args:
    x: Variables, shape (n,).
    tolerance: Largest accepted violation.
Returns:
    One dict per constraint, as SolverReturn.conflicts.
Raises:
    ArgumentError: x has another size.)";

inline constexpr char report[] = R"(Describes the problem in a line.

Args:
    verbose: Amount of detail.
Returns:
    The line.)";

inline constexpr char setDimension[] = R"(Sets the number of variables.

Args:
    dim: The number n.
Raises:
    ArgumentError: A negative number.)";

inline constexpr char setTypes[] = R"(Sets the types of the residuals.

Args:
    featureTypes: One OT per residual.
Raises:
    TypeError: A type is not an OT.)";

inline constexpr char setBounds[] = R"(Sets bounds of the variables.

Args:
    lower: Shape (n,).
    upper: Shape (n,); a value below lower means no bound.
Raises:
    ArgumentError: The bounds have another size.)";

inline constexpr char setEvalCallback[] = R"(Sets the function that computes residuals and Jacobian.

Args:
    fct: function(x) -> (phi, J), with phi of shape (d,) and J of shape (d, n).)";

inline constexpr char testCallingEvalCallback[] = R"(Evaluates the function once.

Args:
    x: Variables, shape (n,).
Returns:
    phi, shape (d,), and J, shape (d, n).
Raises:
    ArgumentError: The function returned something of another shape.
    Error: There is no function yet.)";

}  // namespace kinegraph::python::docs::nlp

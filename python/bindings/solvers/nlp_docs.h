#pragma once

/// The manual of what bind_nlp.cpp binds.
namespace kinegraph::python::docs::nlp {

inline constexpr char evaluate[] = R"(The residuals and their Jacobian.

Args:
    x: Variables, shape (n,).
Returns:
    phi, shape (d,), and J: shape (d, n), or for motion problems triplets (row, column, value), shape (k, 3).
Raises:
    ArgumentError: x has another size.)";

inline constexpr char eval_scalar[] =
    R"(The value, gradient and Hessian of sum f + sum sos^2, for problems without constraints.

Args:
    x: Variables, shape (n,).
Returns:
    The value, the gradient (n,), and the Hessian (n, n), of sos as 2 J^T J.
Raises:
    ArgumentError: x has another size.)";

inline constexpr char getFHessian[] = R"(The Hessian of sum f.

Args:
    x: Variables, shape (n,).
Returns:
    Shape (n, n); (0, 0) if the problem has none to offer.
Raises:
    ArgumentError: x has another size.)";

inline constexpr char checkJacobian[] =
    R"(Compares the Jacobian with central differences, and prints the ten worst entries.

Args:
    x: Variables, shape (n,); where the size does not fit, a sample is taken.
    tolerance: Largest difference that is no failure.
    featureNames: A name per residual.
Returns:
    True if no difference is larger.
Raises:
    ArgumentError: Another number of names.)";

inline constexpr char checkHessian[] = R"(Compares getFHessian with central differences, and prints the worst entry.

Args:
    x: Variables, shape (n,); where the size does not fit, a sample is taken.
    tolerance: Largest difference that is no failure.
Returns:
    True if no difference is larger.
Raises:
    ArgumentError: The Hessian has another size.)";

inline constexpr char aug_lag[] =
    R"(This problem with its constraints as costs. A weight below 0 leaves them as they are.

Args:
    muSquaredPenalty: Costs are this weight times phi^2 (of inequalities, where they are violated).
    muLogBarrier: Costs of inequalities are -log(-phi) times this weight.
Returns:
    The other problem.)";

inline constexpr char summarizeErrors[] = R"(Sums of residuals by type.

Args:
    phi: Residuals, shape (d,).
Returns:
    Sums of f, sos, ineq and eq, shape (4,).
Raises:
    ArgumentError: phi has another size.)";

inline constexpr char explain[] =
    R"(Says which constraints contradict each other around a point, by how much, and what helps.

Args:
    x: Variables, shape (n,).
    tolerance: Largest violation that counts as none.
Returns:
    A few lines.
Raises:
    ArgumentError: x has another size.)";

inline constexpr char conflicts[] = R"(What explain says.

Args:
    x: Variables, shape (n,).
    tolerance: Largest violation that counts as none.
Returns:
    A dict per constraint, as of SolverReturn.conflicts.
Raises:
    ArgumentError: x has another size.)";

inline constexpr char report[] = R"(A line about the problem.

Args:
    verbose: How much it says.
Returns:
    The line.)";

inline constexpr char setDimension[] = R"(Sets the number of variables.

Args:
    dim: The number n.
Raises:
    ArgumentError: A negative number.)";

inline constexpr char setTypes[] = R"(Sets what the residuals are.

Args:
    featureTypes: The OT of each residual, d of them.
Raises:
    TypeError: They are not of OT.)";

inline constexpr char setBounds[] = R"(Sets bounds of the variables.

Args:
    lower: Shape (n,).
    upper: Shape (n,); where it is below lower there is no bound.
Raises:
    ArgumentError: Another size.)";

inline constexpr char setEvalCallback[] = R"(Sets the function.

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

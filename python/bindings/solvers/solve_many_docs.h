#pragma once

/// The manual of what bind_solve_many.cpp binds.
namespace kinegraph::python::docs::solve_many {

inline constexpr char solveAll[] =
    R"(Solves independent problems, such as the options of a discrete decision, on several threads. The number of
threads does not change the results. After Ctrl-C the call returns the results so far.

Args:
    problems: KOMO, NLP or NLP_Solver objects, all different. A KOMO is left at its solution.
    threads: Number of threads.
    best: True solves all problems; False ends with the first feasible one in the list.
    verbose: 1 logs a line at the end, and shows a progress bar if it takes long.
    options: Options of the solvers, except for NLP_Solver objects, which have their own; None for the defaults.
Returns:
    SolverReturns: results in the order of the problems, chosen (the index of the best), best.
Raises:
    ArgumentError: An object of another class, or two problems of one KOMO.)";

inline constexpr char solveFromMany[] =
    R"(Solves from several initial guesses, and leaves the KOMO at the best solution. After Ctrl-C the call returns the
results so far.

Args:
    starts: Number of guesses (the current path, then random ones), or paths, shape (K, T, n), rad or m.
    best: True solves from all, for the feasible solution of least cost; False ends with the first feasible one.
    threads: Number of threads; the result does not depend on it.
    seed: Seed of the random guesses.
    verbose: 1 logs a line at the end, and shows a progress bar if it takes long.
    options: Options of the solver; None for the defaults.
Returns:
    SolverReturns: best, chosen (its index), results.
Raises:
    ArgumentError: Paths of another shape.
    Error: The KOMO has no configuration and timing yet.)";

}  // namespace kinegraph::python::docs::solve_many

#pragma once

/// The manual of what bind_solve_many.cpp binds.
namespace kinegraph::python::docs::solve_many {

inline constexpr char solveAll[] =
    R"(Solves independent problems, such as the choices of a discrete decision, on several threads, which do not change the
answers. Ctrl-C ends it with what there is.

Args:
    problems: KOMO, NLP or NLP_Solver objects, all different. A KOMO is left at its solution.
    threads: How many share the problems.
    best: Solves all of them; if False, the first one in the list that is feasible ends it.
    verbose: 1 prints a line at the end, and shows a progress bar on the way if it takes long.
    options: Of all but the NLP_Solver objects, which have their own; None for the defaults.
Returns:
    SolverReturns: results in the order of the problems, chosen (the index of the best), best.
Raises:
    ArgumentError: An object of another class, or two problems of one KOMO.)";

inline constexpr char solveFromMany[] =
    R"(Solves from several starting points, and leaves the KOMO at the best solution. Ctrl-C ends it with what there is.

Args:
    starts: How many (the present path, then random ones), or paths, shape (K, T, n), rad or m.
    best: Solves from all, for the feasible solution of least cost; False: for the first feasible one.
    threads: How many share the starts; the answer does not depend on it.
    seed: Of the random starts.
    verbose: 1 prints a line at the end, and shows a progress bar on the way if it takes long.
    options: Of the solver; None for the defaults.
Returns:
    SolverReturns: best, chosen (its index), results.
Raises:
    ArgumentError: Paths of another shape.
    Error: The KOMO has no configuration and no timing yet.)";

}  // namespace kinegraph::python::docs::solve_many

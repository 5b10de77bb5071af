#pragma once

#include <chrono>
#include <functional>

#include "bindings.h"
#include "kinegraph/solvers/nlp_solver.h"

namespace kinegraph::python {

/// Asks for Ctrl-C while a solver runs without the interpreter lock, every 20 ms. It then ends the solver, which gives the
/// best so far; a Ctrl-C that reaches a user's function while it runs is kept in `pending`.
class Interruption {
 public:
  bool operator()(const VectorXd&, const VectorXd&);  ///< false: stop

  static bool& pending();
  static bool& solving();  ///< there is a solver to be told

 private:
  std::chrono::steady_clock::time_point asked_ = std::chrono::steady_clock::now();
};

/// Calls a user's function with the interpreter lock. False if Ctrl-C ended it while a solver runs, which then ends as well.
bool callUser(const std::function<void()>& call);

/// Solves without the interpreter lock. Ctrl-C ends it with status cancelled.
SolverResult solveInterruptibly(NlpSolver& solver, bool resample);

/// Solvers of other packages: OptMethod.Ipopt and NLopt, by kinegraph.external_solvers.
void addExternalMethods(NlpSolver& solver);

}  // namespace kinegraph::python

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
  Interruption(const char* what, const Nlp& nlp, int verbose) : what_(what), nlp_(nlp), verbose_(verbose) {}
  ~Interruption();
  bool operator()(const VectorXd&, const VectorXd&);  ///< false: stop

  static bool& pending();
  static bool& solving();  ///< there is a solver to be told

 private:
  using Clock = std::chrono::steady_clock;
  void draw(const VectorXd& phi, double seconds);

  const char* what_;
  const Nlp& nlp_;
  int verbose_, evals_ = 0;
  double drawn_at_ = 0.;  ///< seconds after the start; 0: not yet
  Clock::time_point start_ = Clock::now(), asked_ = start_;
};

/// Calls a user's function with the interpreter lock. False if Ctrl-C ended it while a solver runs, which then ends as well.
bool callUser(const std::function<void()>& call);

/// Runs what solves, without the interpreter lock. Ctrl-C ends it with status cancelled. From verbose 1 on, a terminal shows a line
/// of how far it is, if it takes long; `what` is its first word.
SolverResult runInterruptibly(const char* what, const Nlp& nlp, int verbose, const std::function<SolverResult(const EvaluationHook&)>& run);

/// The same for a solver.
SolverResult solveInterruptibly(NlpSolver& solver, bool resample);

/// Solvers of other packages: OptMethod.Ipopt and NLopt, by kinegraph.external_solvers.
void addExternalMethods(NlpSolver& solver);

/// Asks for Ctrl-C on the calling thread while others solve; true once it was pressed.
bool pressedCtrlC();

}  // namespace kinegraph::python

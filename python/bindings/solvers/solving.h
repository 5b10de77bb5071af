#pragma once

#include <chrono>
#include <functional>

#include "bindings.h"
#include "kinegraph/solvers/explanation.h"
#include "kinegraph/solvers/nlp_solver.h"

namespace kinegraph::python {

/// A solver runs on this thread, and wants to know of Ctrl-C. What was pressed before does not count.
class SolvingHere {
 public:
  SolvingHere();
  ~SolvingHere();
  SolvingHere(const SolvingHere&) = delete;
  SolvingHere& operator=(const SolvingHere&) = delete;

  /// Is this exception what Ctrl-C raises, or was it pressed already?
  bool isPressedBy(const nb::python_error& error);

  /// Ctrl-C was pressed: it reached a user's function, or the interpreter has it since. Takes the interpreter lock.
  bool pressedCtrlC();

  bool wasPressed() const { return pressed_; }  ///< as far as it is known

  /// The innermost one of this thread; null where none runs, or a user's function does.
  static SolvingHere*& current();

 private:
  SolvingHere* before_;
  bool pressed_ = false;
};

/// Calls a user's function with the interpreter lock. False where Ctrl-C ended it, or came meanwhile, while a solver
/// runs: what the function gave is then no value, and the solver is to end.
bool callUser(const std::function<void()>& call);

/// Asks for Ctrl-C while a solver runs without the interpreter lock, every 20 ms. It then ends the solver, which gives
/// the best so far.
class Interruption {
 public:
  Interruption(SolvingHere& here, const char* what, const Nlp& nlp, int verbose)
      : here_(here), what_(what), nlp_(nlp), verbose_(verbose) {}
  ~Interruption();
  bool operator()(const VectorXd&, const VectorXd&);  ///< false: stop

 private:
  using Clock = std::chrono::steady_clock;
  static constexpr int kSeldom = 4;  ///< reading the clock takes a tenth of a small evaluation
  void draw(const VectorXd& phi, double seconds);

  SolvingHere& here_;
  const char* what_;
  const Nlp& nlp_;
  int verbose_, evals_ = 0, next_look_ = kSeldom;
  double drawn_at_ = 0.;  ///< seconds after the start; 0: not yet
  Clock::time_point start_ = Clock::now(), asked_ = start_, looked_ = start_;
};

/// Says that Ctrl-C ended it.
void markInterrupted(SolverResult& result);

[[noreturn]] void throwKeyboardInterrupt();

/// Runs what solves, without the interpreter lock. Ctrl-C ends it with status cancelled. From verbose 1 on, a terminal
/// shows a line of how far it is, if it takes long; `what` is its first word.
SolverResult runInterruptibly(const char* what, const Nlp& nlp, int verbose,
                              const std::function<SolverResult(const EvaluationHook&)>& run);

/// The same for a solver.
SolverResult solveInterruptibly(NlpSolver& solver, bool resample);

/// Why constraints do not hold at x, found without the interpreter lock. Ctrl-C is a KeyboardInterrupt.
Explanation explainInterruptibly(Nlp& nlp, const VectorXd& x, double tolerance);

/// Solvers of other packages: OptMethod.Ipopt and NLopt, by kinegraph.external_solvers.
void addExternalMethods(NlpSolver& solver);

}  // namespace kinegraph::python

#pragma once

#include <chrono>
#include <functional>

#include "bindings.h"
#include "kinegraph/solvers/nlp_solver.h"

namespace kinegraph::python {

/// Marks that a solver runs on this thread and observes Ctrl-C from now on.
class SolveScope {
 public:
  SolveScope();
  ~SolveScope();
  SolveScope(const SolveScope&) = delete;
  SolveScope& operator=(const SolveScope&) = delete;

  /// Whether this exception is the one of Ctrl-C, or Ctrl-C was pressed before.
  bool isPressedBy(const nb::python_error& error);

  /// Whether Ctrl-C was pressed, in a function of the user or later. Takes the interpreter lock.
  bool pressedCtrlC();

  bool wasPressed() const { return pressed_; }  ///< without asking the interpreter

  /// Returns the innermost scope of this thread; null outside of solvers and in functions of the user.
  static SolveScope*& current();

 private:
  SolveScope* before_;
  bool pressed_ = false;
};

/// Calls a function of the user with the interpreter lock. False if Ctrl-C was pressed while a solver runs: the value
/// of the function is then invalid, and the solver shall end.
bool callUser(const std::function<void()>& call);

/// An evaluation callback that checks for Ctrl-C every 20 ms while a solver runs without the interpreter lock. The
/// solver then ends with the best point so far.
class Interruption {
 public:
  Interruption(SolveScope& here, const char* what, const Nlp& nlp, int verbose)
      : here_(here), what_(what), nlp_(nlp), verbose_(verbose) {}
  ~Interruption();
  bool operator()(const VectorXd&, const VectorXd&);  ///< false: the solver shall end

 private:
  using Clock = std::chrono::steady_clock;
  static constexpr int kSkippedEvals = 4;  ///< reading the clock takes a tenth of a small evaluation
  void draw(const VectorXd& phi, double seconds);

  SolveScope& here_;
  const char* what_;
  const Nlp& nlp_;
  int verbose_, evals_ = 0, next_check_ = kSkippedEvals;
  double drawn_at_ = 0.;  ///< seconds after the start; 0: never
  Clock::time_point start_ = Clock::now(), asked_ = start_, checked_ = start_;
};

/// Marks a result that Ctrl-C interrupted.
void markInterrupted(SolverResult& result);

[[noreturn]] void throwKeyboardInterrupt();

/// Runs a solve without the interpreter lock. Ctrl-C ends it with status cancelled. If `verbose` is at least 1, a
/// terminal shows the progress of long solves in a line that starts with `what`.
SolverResult runInterruptibly(const char* what, const Nlp& nlp, int verbose,
                              const std::function<SolverResult(const EvaluationCallback&)>& run);

/// Runs NlpSolver::solve as `runInterruptibly` does.
SolverResult solveInterruptibly(NlpSolver& solver, bool resample);

/// Explains violated constraints at x, without the interpreter lock. Ctrl-C raises KeyboardInterrupt.
Explanation explainInterruptibly(Nlp& nlp, const VectorXd& x, double tolerance);

/// Adds the solvers of other packages, OptMethod.Ipopt and NLopt, from kinegraph.external_solvers.
void addExternalMethods(NlpSolver& solver);

}  // namespace kinegraph::python

#pragma once

#include <memory>
#include <vector>

#include "kinegraph/solvers/augmented_lagrangian.h"

namespace kinegraph {

/// A problem, options, and what is known of the solution so far: a second `solve` goes on from x and the multipliers.
class NlpSolver {
 public:
  NlpSolver() = default;
  explicit NlpSolver(std::shared_ptr<Nlp> problem, int verbose = 1);

  /// Throws Error if there is a problem already.
  void setProblem(std::shared_ptr<Nlp> problem);
  void setInitialization(const VectorXd& x);
  void setTracing(bool x, bool errors, bool phi);
  void clearTracing();

  /// Solves from x, or from the problem's initial point if there is none yet or `resample` is set. `should_stop` is asked at
  /// every evaluation. Throws Error without a problem or for a method that is not available.
  SolverResult solve(bool resample, Rng& rng, const std::function<bool()>& should_stop = {});

  const std::shared_ptr<Nlp>& problem() const { return problem_; }
  const std::vector<VectorXd>& traceX() const { return trace_x_; }
  const std::vector<VectorXd>& tracePhi() const { return trace_phi_; }
  const std::vector<ErrorSums>& traceErrors() const { return trace_errors_; }

  SolverOptions options;
  VectorXd x, dual;  ///< empty until known

 private:
  std::shared_ptr<Nlp> problem_;
  bool tracing_x_ = false, tracing_errors_ = false, tracing_phi_ = false;
  std::vector<VectorXd> trace_x_, trace_phi_;
  std::vector<ErrorSums> trace_errors_;
  int evals_ = 0;
};

}  // namespace kinegraph

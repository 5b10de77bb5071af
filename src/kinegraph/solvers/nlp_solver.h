#pragma once

#include <map>
#include <memory>
#include <vector>

#include "kinegraph/solvers/methods/augmented_lagrangian.h"

namespace kinegraph {

/// A problem, options, and what is known of the solution so far: a second `solve` goes on from x and the multipliers.
class NlpSolver {
 public:
  NlpSolver() = default;
  explicit NlpSolver(std::shared_ptr<Nlp> problem, int verbose = 1);

  /// Throws Error if there is a problem already.
  void setProblem(std::shared_ptr<Nlp> problem);
  void setInitialization(const VectorXd& x);
  void setTracing(bool x, bool errors, bool phi, bool jacobian = false);
  void clearTracing();

  /// Called during solve with the number of its evaluations and the point, at most once in `seconds`; returning false stops
  /// it.
  using Progress = std::function<bool(int evals, const VectorXd& x, const ErrorSums& errors)>;
  void setProgress(Progress progress, double seconds);

  /// A method that is not among availableMethods(), as for solvers of other packages.
  using Method = std::function<SolverResult(Nlp& nlp, const VectorXd& x0, const SolverOptions& options,
                                            const EvaluationHook& hook)>;
  void addMethod(OptMethod name, Method method) { methods_[name] = std::move(method); }

  /// Solves from x, or from the problem's initial point if there is none yet or `resample` is set. `hook` is asked at
  /// every evaluation. Throws Error without a problem or for a method that is not available, EvaluationCancelled where
  /// that came before the first value; later, the result is the best point seen.
  SolverResult solve(bool resample, Rng& rng, const EvaluationHook& hook = {});
  SolverResult solve();  ///< from x, or from the initial point that a generator with seed 0 gives

  const std::shared_ptr<Nlp>& problem() const { return problem_; }
  const std::vector<VectorXd>& traceX() const { return trace_x_; }
  const std::vector<VectorXd>& tracePhi() const { return trace_phi_; }
  const std::vector<MatrixXd>& traceJacobian() const { return trace_jacobian_; }
  const std::vector<ErrorSums>& traceErrors() const { return trace_errors_; }

  SolverOptions options;
  VectorXd x, dual;          ///< empty until known
  bool keeps_memory = true;  ///< for the next solve; else it is given back at the end

 private:
  SolverResult runRefining(Separation& separation, const EvaluationHook& watch, const EvaluationHook& seen);
  SolverResult runMethod(const Separation& separation, const EvaluationHook& watch, const EvaluationHook& seen);
  void releaseMemory();
  void forget();
  void reduceViolation(SolverResult& result, const Separation& separation, const EvaluationHook& hook);

  std::shared_ptr<Nlp> problem_;
  bool tracing_x_ = false, tracing_errors_ = false, tracing_phi_ = false, tracing_jacobian_ = false;
  std::vector<VectorXd> trace_x_, trace_phi_;
  std::vector<MatrixXd> trace_jacobian_;
  std::vector<ErrorSums> trace_errors_;
  Progress progress_;
  double progress_seconds_ = 0.;
  std::map<OptMethod, Method> methods_;
  std::unique_ptr<AugmentedLagrangianMemory> memory_;  ///< for the problem, or the form of it, that was solved last
  const Nlp* memory_of_ = nullptr;
  VectorXd solved_dual_;  ///< of the form of the problem that was solved
  int evals_ = 0;
};

}  // namespace kinegraph

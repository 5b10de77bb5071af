#pragma once

#include <map>
#include <memory>
#include <vector>

#include "kinegraph/solvers/methods/augmented_lagrangian.h"

namespace kinegraph {

/// A problem, options, and the current solution. Another call of `solve` continues from x and the multipliers.
class NlpSolver {
 public:
  NlpSolver() = default;
  explicit NlpSolver(std::shared_ptr<Nlp> problem, int verbose = 1);

  /// Throws Error if the solver has a problem already, and ValueError for null.
  void setProblem(std::shared_ptr<Nlp> problem);
  void setInitialization(const VectorXd& x);
  void setTracing(bool x, bool errors, bool phi, bool jacobian = false);
  void clearTracing();

  /// Receives the number of evaluations, the point and its errors during `solve`, at most once in `seconds`. The solve
  /// ends if it returns false.
  using Progress = std::function<bool(int evals, const VectorXd& x, const ErrorSums& errors)>;
  void setProgress(Progress progress, double seconds);

  /// A method that is not among availableMethods(), such as a solver of another package.
  using Method = std::function<SolverResult(Nlp& nlp, const VectorXd& x0, const SolverOptions& options,
                                            const EvaluationCallback& callback)>;
  void addMethod(OptMethod name, Method method) { methods_[name] = std::move(method); }

  /// Solves from x, or from the initial point of the problem if there is none yet or `resample` is set. Calls
  /// `callback` at every evaluation. Throws Error without a problem or for an unavailable method. Throws
  /// EvaluationCancelled if an evaluation does so before the first value; later the result is the best point so far.
  SolverResult solve(bool resample, Rng& rng, const EvaluationCallback& callback = {});
  SolverResult solve();  ///< from x, or from the initial point of a generator with seed 0

  const std::shared_ptr<Nlp>& problem() const { return problem_; }
  const std::vector<VectorXd>& traceX() const { return trace_x_; }
  const std::vector<VectorXd>& tracePhi() const { return trace_phi_; }
  const std::vector<MatrixXd>& traceJacobian() const { return trace_jacobian_; }
  const std::vector<ErrorSums>& traceErrors() const { return trace_errors_; }

  SolverOptions options;
  VectorXd x, dual;          ///< empty until known
  bool keeps_memory = true;  ///< for the next solve; false: frees the memory after each solve

 private:
  SolverResult runRefining(Separation& separation, const EvaluationCallback& callback,
                           const EvaluationCallback& joined_callback);
  SolverResult runMethod(const Separation& separation, const EvaluationCallback& callback,
                         const EvaluationCallback& joined_callback);
  void releaseMemory();
  void forget();
  void reduceViolation(SolverResult& result, const Separation& separation, const EvaluationCallback& callback);

  std::shared_ptr<Nlp> problem_;
  bool tracing_x_ = false, tracing_errors_ = false, tracing_phi_ = false, tracing_jacobian_ = false;
  std::vector<VectorXd> trace_x_, trace_phi_;
  std::vector<MatrixXd> trace_jacobian_;
  std::vector<ErrorSums> trace_errors_;
  Progress progress_;
  double progress_seconds_ = 0.;
  std::map<OptMethod, Method> methods_;
  std::unique_ptr<AugmentedLagrangianMemory> memory_;  ///< of the problem or separate form that was solved last
  const Nlp* memory_of_ = nullptr;
  VectorXd solved_dual_;  ///< multipliers of the form that was solved
  int evals_ = 0;
};

}  // namespace kinegraph

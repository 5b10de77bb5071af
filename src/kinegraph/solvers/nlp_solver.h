#pragma once

#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "kinegraph/common/cancellation.h"
#include "kinegraph/nlp/nlp.h"
#include "kinegraph/solvers/methods/augmented_lagrangian.h"

namespace kinegraph {

/// Solves a problem by `options.method`. The header of each method describes the problems that it supports; methods
/// without support for constraints throw ValueError if there are any. OptMethod::Ipopt and NLopt are external packages,
/// which only Python offers. `memory` must belong to this problem.
SolverResult solve(Nlp& nlp, const VectorXd& x0, const SolverOptions& options, const VectorXd& dual = {},
                   const EvaluationCallback& callback = {}, AugmentedLagrangianMemory* memory = nullptr);

/// Makes status and feasibility consistent: a feasible result cannot be `infeasible`, and an infeasible one cannot be
/// `converged`. In both cases the status becomes `stalled`.
void agreeOnFeasibility(SolverResult& result);

/// Returns the methods that `solve` supports.
const std::vector<OptMethod>& availableMethods();

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

struct SolveManyOptions {
  bool best = true;  ///< solves all problems; false: ends with the feasible result of the lowest index
  int threads = 1;
};

/// The results of several problems.
struct SolveManyResult {
  std::vector<SolverResult> results;  ///< per problem; not `done` if an earlier one sufficed
  int chosen = -1;  ///< the best: feasible before infeasible, then the least cost, or the least violation

  /// The chosen result. Throws ValueError if there are none.
  const SolverResult& best() const;
};

/// Solves several problems: calls solve(worker, i, callback) for i = 0 .. count-1 and collects the results.
///
/// Workers 0 .. threads-1 share the problems; worker 0 is the calling thread. `solve` passes `callback` on to a solver.
/// Before each of its problems, every 20 ms and at the end, the calling thread calls `progress` with the number of
/// solved problems and asks `cancellation`. If that is cancelled, running problems are cancelled, and the others stay
/// not `done`, as does a problem whose solve throws EvaluationCancelled. Neither the results nor the choice depend on
/// the number of threads. If several problems throw an Error, that of the lowest index is passed on. Throws ValueError
/// if there are no problems or threads.
using SolveOne = std::function<SolverResult(int worker, int i, const EvaluationCallback& callback)>;
SolveManyResult solveMany(int count, const SolveManyOptions& options, const SolveOne& solve,
                          const ProgressCallback& progress = {}, const CancellationToken& cancellation = {});

/// Solves independent problems, each from the x of its solver or, if there is none yet, from the initial point of a
/// generator with this seed. Throws ValueError if a solver or a problem occurs twice.
SolveManyResult solveAll(const std::vector<NlpSolver*>& solvers, const SolveManyOptions& options = {},
                         std::uint64_t seed = 0, const ProgressCallback& progress = {},
                         const CancellationToken& cancellation = {});

/// The size of a violation or relaxation, with units.
struct Amount {
  double scaled = 0.;                                         ///< the largest scaled entry
  double meters = std::numeric_limits<double>::quiet_NaN();   ///< nan if no entry is a length; per s^time_order
  double radians = std::numeric_limits<double>::quiet_NaN();  ///< nan if no entry is an angle; per s^time_order
  int time_order = 0;

  std::string str() const;  ///< "3.1 cm", "0.2 rad", "3.1 cm and 0.2 rad", "0.5 (scaled)"
};

/// One of several requirements that contradict each other: an objective, or a bound of a variable.
struct Conflict {
  std::string name;  ///< of the objective, or of the variable of a bound
  bool is_bound = false;
  ObjectiveType type = ObjectiveType::ineq;
  std::vector<std::string> frames;
  std::vector<int> slices;  ///< slices with violations
  std::vector<int> rows;    ///< violated residuals; empty for a bound
  int variable = -1;        ///< variable of a bound; else -1
  double bound = 0.;
  std::vector<std::string> details;  ///< "box and camera overlap by 3 mm"
  Amount violation;                  ///< at the point of least violation; zero for a bound
  double pull = 0.;                  ///< its multiplier there: decrease of the sum of squares per unit of relaxation

  bool suffices = false;  ///< whether its relaxation alone lets all others hold
  Amount relaxation;      ///< the smallest one that was found nearby
  double remaining = 0.;  ///< the largest (scaled) violation of the others after it
};

/// The reason why constraints do not hold at a point.
struct Explanation {
  enum class Verdict {
    holds,        ///< all constraints hold
    not_reached,  ///< a feasible point is nearby: the problem is not solved yet
    conflict,     ///< the constraints contradict each other near this point
  };
  Verdict verdict = Verdict::holds;
  double tolerance = 0.;
  double violation = 0.;            ///< the largest (scaled) at the given point
  double least_violation = 0.;      ///< the largest (scaled) at the point of least sum of squares
  VectorXd x;                       ///< the point of least violation
  std::vector<Conflict> conflicts;  ///< violated objectives, the worst first, then active bounds
  std::string reason;               ///< why a query was refused before anything was solved; "" otherwise
  int best = -1;                    ///< the conflict whose relaxation helps most; -1 if none helps

  std::string str(int at_most = 10) const;
};

/// Finds the constraints that contradict each other around `x`. The function first minimizes the violation from `x`;
/// the constraints that are violated at that minimum, and the bounds that are active there, form the conflict. Then it
/// relaxes each of them in turn, to find whether the others can hold and how much relaxation that takes. Leaves the
/// problem at `x`. `cancellation` is asked at every evaluation; the function throws if it is cancelled.
Explanation explain(Nlp& nlp, const VectorXd& x, double tolerance = 1e-3, const CancellationToken& cancellation = {});

}  // namespace kinegraph

#include "kinegraph/solvers/nlp_solver.h"

#include <algorithm>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/log.h"
#include "kinegraph/common/stopwatch.h"
#include "kinegraph/common/text.h"
#include "kinegraph/solvers/interface/best_so_far.h"
#include "kinegraph/solvers/interface/requirements.h"
#include "kinegraph/solvers/problems/relaxed_nlp.h"

namespace kinegraph {

namespace {

constexpr int kMaxReductionEvals = 50;

}  // namespace

NlpSolver::NlpSolver(std::shared_ptr<Nlp> problem, int verbose) {
  options.verbose = verbose;
  setProblem(std::move(problem));
}

void NlpSolver::setProblem(std::shared_ptr<Nlp> problem) {
  if (!problem) throw ValueError("NlpSolver: the problem is null");
  if (problem_) throw Error("NlpSolver: the solver has a problem already; make a new solver for another one");
  problem_ = std::move(problem);
}

void NlpSolver::setInitialization(const VectorXd& given) {
  if (problem_ && given.size() != problem_->dimension()) {
    throw ValueError(cat("setInitialization: got ", given.size(), " entries; the problem has ", problem_->dimension(),
                         " variables"));
  }
  x = given;
  dual.resize(0);
}

void NlpSolver::setTracing(bool trace_x, bool errors, bool phi, bool jacobian) {
  tracing_x_ = trace_x;
  tracing_errors_ = errors;
  tracing_phi_ = phi;
  tracing_jacobian_ = jacobian;
}

void NlpSolver::setProgress(Progress progress, double seconds) {
  progress_ = std::move(progress);
  progress_seconds_ = seconds;
}

void NlpSolver::clearTracing() {
  trace_x_.clear();
  trace_phi_.clear();
  trace_jacobian_.clear();
  trace_errors_.clear();
}

/// Minimizes the violation of the original form, with sums: first that of the sums while all other constraints hold,
/// then that of all constraints together.
void NlpSolver::reduceViolation(SolverResult& result, const Separation& separation,
                                const EvaluationCallback& callback) {
  const std::size_t rows = problem_->types().size();
  std::vector<bool> sums(rows, false);
  for (std::size_t i = 0; i < separation.row_of.size(); ++i)
    sums[std::size_t(separation.row_of[i])] = separation.is_term[i];
  SolverOptions brief = options;
  brief.verbose = 0;
  brief.stopEvals = kMaxReductionEvals;
  VectorXd phi((Eigen::Index(rows)));
  const EvaluationCallback relay = [&](const VectorXd& at, const VectorXd&) {
    problem_->evaluate(at, phi, nullptr);
    return callback(at, phi);
  };
  const VectorXd end = result.x;
  problem_->evaluate(end, phi, nullptr);
  double least = largestViolation(problem_->types(), phi);
  for (const std::vector<bool>& relaxed : {sums, std::vector<bool>(rows, true)}) {
    RelaxedNlp problem(*problem_, relaxed);
    const SolverResult found =
        solveAugmentedLagrangian(problem, end, brief, {}, callback ? relay : EvaluationCallback());
    result.evals += found.evals;
    problem_->evaluate(found.x, phi, nullptr);
    const double violation = largestViolation(problem_->types(), phi);
    if (violation < least) {
      least = violation;
      result.x = found.x;
      result.message = cat("the constraints contradict each other locally; the least violation found is ", violation);
    }
    if (found.status == SolverStatus::cancelled) return;
  }
}

/// Solves the separate form of the problem, if the method uses it, and converts the result to the original form.
SolverResult NlpSolver::runMethod(const Separation& separation, const EvaluationCallback& callback,
                                  const EvaluationCallback& joined_callback) {
  const auto method = methods_.find(options.method);
  if (method != methods_.end()) {
    options.validate();
    requireStart(*problem_, x);
    return method->second(*problem_, x, options, callback);
  }
  Nlp& solved = separation.problem ? *separation.problem : *problem_;
  if (dual.size() == 0) solved_dual_.resize(0);
  if (memory_of_ != &solved) memory_ = std::make_unique<AugmentedLagrangianMemory>();
  memory_of_ = &solved;
  SolverResult result =
      kinegraph::solve(solved, x, options, separation.problem ? solved_dual_ : dual, callback, memory_.get());
  solved_dual_ = result.dual;
  if (!separation.problem) return result;
  const auto rows = Eigen::Index(problem_->types().size());
  VectorXd phi(rows);
  // Residuals that are feasible one by one may be infeasible as sums.
  const bool left_violated =
      result.status == SolverStatus::stalled && result.feasible && result.violation > options.constraintTolerance();
  if (result.status == SolverStatus::infeasible || left_violated) reduceViolation(result, separation, joined_callback);
  problem_->evaluate(result.x, phi, nullptr);
  result.dual = separation.joinedDual(result.dual, rows);
  result.setSums(problem_->types(), phi, options.constraintTolerance());
  return result;
}

void NlpSolver::releaseMemory() {
  memory_.reset();
  memory_of_ = nullptr;
}

/// Drops the state that an exception left incomplete.
void NlpSolver::forget() {
  releaseMemory();
  solved_dual_.resize(0);
}

SolverResult NlpSolver::solve() {
  Rng rng(0);
  return solve(false, rng);
}

SolverResult NlpSolver::solve(bool resample, Rng& rng, const EvaluationCallback& callback) {
  if (!problem_) throw Error("NlpSolver: there is no problem to solve; call setProblem first");
  if (resample || x.size() == 0) {
    x = problem_->initialPoint(rng);
    dual.resize(0);
  }
  const Stopwatch stopwatch;
  Stopwatch since_progress;
  int calls = 0;
  const bool is_own = !methods_.contains(options.method);
  Separation separation = is_own && options.method == OptMethod::augmentedLag ? problem_->separation() : Separation();
  const auto rows = Eigen::Index(problem_->types().size());
  const bool may_be_cancelled = problem_->mayBeCancelled();
  BestSoFar best(*problem_, options.constraintTolerance());
  const EvaluationCallback seen = [&](const VectorXd& at, const VectorXd& phi) {
    ++calls;
    if (may_be_cancelled) best.see(at, phi);
    if (tracing_x_) trace_x_.push_back(at);
    if (tracing_phi_) trace_phi_.push_back(phi);
    if (tracing_errors_) trace_errors_.push_back(sumErrors(problem_->types(), phi));
    if (tracing_jacobian_) {
      Jacobian J = problem_->makeJacobian();
      VectorXd again = phi;
      problem_->evaluate(at, again, &J);
      trace_jacobian_.push_back(J.toDense());
    }
    if (callback && !callback(at, phi)) return false;
    if (!progress_ || since_progress.seconds() < progress_seconds_) return true;
    since_progress.restart();
    return progress_(calls, at, sumErrors(problem_->types(), phi));
  };
  EvaluationCallback joined;
  if (separation.problem)
    joined = [&](const VectorXd& at, const VectorXd& phi) { return seen(at, separation.joined(phi, rows)); };
  const bool needs_callback =
      tracing_x_ || tracing_phi_ || tracing_errors_ || tracing_jacobian_ || progress_ || callback || may_be_cancelled;
  const EvaluationCallback form_callback = !needs_callback ? EvaluationCallback() : separation.problem ? joined : seen;
  SolverResult result;
  try {
    result = runRefining(separation, form_callback, needs_callback ? seen : EvaluationCallback());
  } catch (const EvaluationCancelled&) {
    forget();
    if (!best.isKnown()) throw;
    result = best.result(calls);
    problem_->leaveAt(result.x);
  } catch (...) {
    forget();
    throw;
  }
  if (!is_own || result.time == 0.) result.time = stopwatch.seconds();
  if (!keeps_memory) releaseMemory();
  agreeOnFeasibility(result);
  x = result.x;
  dual = result.dual;
  if (result.status == SolverStatus::limit && evals_ > 0)
    result.message += cat(" in this solve; ", evals_ + result.evals, " evaluations in all");
  evals_ += result.evals;
  result.totalEvals = evals_;
  result.problem = problem_;
  result.validity = problem_->validity(result.x);
  if (options.verbose > 0)
    logMessage(LogLevel::info,
               cat("==nlp== ", solverStatusName(result.status), ": ", result.summary(), "  ", result.str()));
  return result;
}

}  // namespace kinegraph

#include "kinegraph/solvers/nlp_solver.h"

#include <cstdio>

#include "kinegraph/base/errors.h"
#include "kinegraph/base/text.h"
#include "kinegraph/solvers/methods.h"

namespace kinegraph {

NlpSolver::NlpSolver(std::shared_ptr<Nlp> problem, int verbose) {
  options.verbose = verbose;
  setProblem(std::move(problem));
}

void NlpSolver::setProblem(std::shared_ptr<Nlp> problem) {
  if (problem_) throw Error("NLP_Solver: a problem has been set already; make a new solver for another one");
  problem_ = std::move(problem);
}

void NlpSolver::setInitialization(const VectorXd& given) {
  if (problem_ && given.size() != problem_->dimension()) {
    throw ValueError(cat("setInitialization: got ", given.size(), " numbers; the problem has ", problem_->dimension(), " variables"));
  }
  x = given;
  dual.resize(0);
}

void NlpSolver::setTracing(bool trace_x, bool errors, bool phi) {
  tracing_x_ = trace_x;
  tracing_errors_ = errors;
  tracing_phi_ = phi;
}

void NlpSolver::clearTracing() {
  trace_x_.clear();
  trace_phi_.clear();
  trace_errors_.clear();
}

SolverResult NlpSolver::solve(bool resample, Rng& rng, const std::function<bool()>& should_stop) {
  if (!problem_) throw Error("NLP_Solver: there is no problem to solve; call setProblem first");
  if (resample || x.size() == 0) {
    x = problem_->initialPoint(rng);
    dual.resize(0);
  }
  const auto hook = [&](const VectorXd& at, const VectorXd& phi) {
    if (tracing_x_) trace_x_.push_back(at);
    if (tracing_phi_) trace_phi_.push_back(phi);
    if (tracing_errors_) trace_errors_.push_back(sumErrors(problem_->types(), phi));
    return !should_stop || !should_stop();
  };
  const bool needs_hook = tracing_x_ || tracing_phi_ || tracing_errors_ || should_stop;
  SolverResult result = kinegraph::solve(*problem_, x, options, dual, needs_hook ? EvaluationHook(hook) : EvaluationHook());
  x = result.x;
  dual = result.dual;
  evals_ += result.evals;
  result.evals = evals_;
  result.problem = problem_;
  if (options.verbose > 0) std::printf("==nlp== %s: %s  %s\n", solverStatusName(result.status).c_str(), result.message.c_str(), result.str().c_str());
  return result;
}

}  // namespace kinegraph

#include <algorithm>

#include "kinegraph/base/text.h"
#include "kinegraph/nlp/other_ways.h"
#include "kinegraph/solvers/nlp_solver.h"

namespace kinegraph {

namespace {

constexpr int kMostRefinements = 40;
constexpr int kMostFromStart = 2;  // beginnings from where the first one began; the next ones go other ways
constexpr int kMostBeginnings = 12;
constexpr int kMostEvalsOfOne = 120;                         // beginning, unless it is the first
constexpr double kCarefulStep = .1, kCarefulPenalty = 100.;  // of solves that begin anew

/// Tells what the constraints of the last refinement say of the result.
void giveUp(Nlp& nlp, double tolerance, int rounds, SolverResult& result) {
  VectorXd phi(Eigen::Index(nlp.types().size()));
  nlp.evaluate(result.x, phi, nullptr);
  result.setSums(nlp.types(), phi, tolerance);
  result.status = SolverStatus::limit;
  result.message = cat("after ", rounds, " refinements and ", result.evals,
                       " evaluations constraints are still violated between slices");
}

}  // namespace

/// Solves; and where constraints are to hold at all times of a motion, again with those that the solution violates: from
/// there; where the solution is no place to go on from, from the beginning, in short steps; and where that does not help,
/// from beginnings that the problem offers. All of it together takes no more than the evaluations that are allowed.
SolverResult NlpSolver::runRefining(Separation& separation, const EvaluationHook& watch, const EvaluationHook& seen) {
  SolverResult result = runMethod(separation, watch, seen);
  if (result.status == SolverStatus::cancelled) return result;
  Refinement found = problem_->refine(result.x, solved_dual_);
  if (found == Refinement::none) return result;
  const VectorXd start = x;
  struct Restore {
    SolverOptions& options;
    const SolverOptions given = options;
    ~Restore() { options = given; }
  } restore{options};
  auto* ways = dynamic_cast<OtherWays*>(problem_.get());
  const VectorXd first = result.feasible ? result.x : start;
  int beginnings = 1, of_this = result.evals;
  for (int rounds = 1; found != Refinement::none || !result.feasible; ++rounds) {
    bool is_lost = found == Refinement::much || !result.feasible || result.status == SolverStatus::limit;
    const int left = restore.given.stopEvals - result.evals;
    if (left <= 0 || rounds > kMostRefinements || (is_lost && beginnings == kMostBeginnings)) {
      // where there is nothing to refine, the constraints that are known contradict
      if (found != Refinement::none) giveUp(*problem_, options.constraintTolerance(), rounds - 1, result);
      break;
    }
    releaseMemory();
    x = result.x;
    dual = result.dual;
    if (is_lost) {  // in short steps, so that it does not leave the way that it begins with
      options.stepMax = std::min(options.stepMax, kCarefulStep);
      options.muInit = kCarefulPenalty * restore.given.muInit;
      x = start;
      dual.resize(0);
      if (++beginnings > kMostFromStart && ways) {
        const int number = beginnings - kMostFromStart;
        const std::optional<VectorXd> other = ways->otherWay(number % 2 == 1 ? start : first, number);
        if (other) x = *other;
      }
      of_this = 0;
    }
    options.stopEvals = std::min(left, std::max(1, kMostEvalsOfOne - of_this));
    if (separation.problem) separation = problem_->separation();
    const int evals = result.evals;
    result = runMethod(separation, watch, seen);
    of_this += result.evals;
    result.evals += evals;
    if (result.status == SolverStatus::cancelled) break;
    found = problem_->refine(result.x, solved_dual_);
  }
  return result;
}

}  // namespace kinegraph

#include <algorithm>

#include "kinegraph/common/text.h"
#include "kinegraph/nlp/initial_guesses.h"
#include "kinegraph/nlp/lazy_constraints.h"
#include "kinegraph/solvers/nlp_solver.h"

namespace kinegraph {

namespace {

constexpr int kMostRefinements = 40;
constexpr int kMostBeginnings = 12;
constexpr int kMostEvalsOfBlocked = 40;                      // of the first beginning, where it leads through something
constexpr int kMostEvalsOfOne = 120;                         // of each other one
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

/// The form of a problem that takes up constraints while a solver is at work; else null.
LazyConstraints* roomIn(const Separation& separation) {
  auto* room = dynamic_cast<LazyConstraints*>(separation.problem.get());
  return room && room->hasRoom() ? room : nullptr;
}

/// Beginnings after the first one, which has ended at `first`.
class NextBeginnings {
 public:
  NextBeginnings(InitialGuesses* ways, GuessKind kind, const VectorXd& start, const VectorXd& first)
      : ways_(ways), again_(kind == GuessKind::free ? 2 : 3), start_(start), first_(first) {
    if (kind == GuessKind::still) start_ = first;  // what leads nowhere has no detours
    from_start_ = start;
  }

  /// The second one, 3, ... From the start again: of a way that is free at once, so that it is kept; else after a detour.
  VectorXd at(int number) const {
    if (!ways_ || number == again_) return from_start_;
    const int detour = number - (number > again_ ? 2 : 1);
    return ways_->initialGuess(detour % 2 == 1 ? start_ : first_, detour).value_or(from_start_);
  }

 private:
  InitialGuesses* ways_;
  int again_;
  VectorXd start_, first_, from_start_;
};

}  // namespace

/// Solves; and where constraints are to hold at all times of a motion, again with those that the solution violates: from
/// there, or, where the solution is no place to go on from, in short steps from other beginnings. A way that is free is
/// tried once more before others that the problem offers. One that leads through something is given up soon, and they come
/// first. All of it together takes no more than the evaluations that are allowed.
SolverResult NlpSolver::runRefining(Separation& separation, const EvaluationHook& watch, const EvaluationHook& seen) {
  struct Restore {
    SolverOptions& options;
    const SolverOptions given = options;
    ~Restore() { options = given; }
  } restore{options};
  const VectorXd start = x;
  InitialGuesses* const ways = roomIn(separation) ? dynamic_cast<InitialGuesses*>(problem_.get()) : nullptr;
  const GuessKind kind = ways ? ways->guessKind(start) : GuessKind::free;
  const bool may_be_cut_off = kind == GuessKind::blocked && options.stopEvals > kMostEvalsOfBlocked;
  if (may_be_cut_off) options.stopEvals = kMostEvalsOfBlocked;
  SolverResult result = runMethod(separation, watch, seen);
  if (result.status == SolverStatus::cancelled) return result;
  Refinement found = problem_->refine(result.x, solved_dual_);
  const bool was_cut_off =
      may_be_cut_off && result.status == SolverStatus::limit && result.evals >= kMostEvalsOfBlocked;
  if (found == Refinement::none && !was_cut_off) return result;
  const NextBeginnings next(ways, kind, start, result.feasible ? result.x : start);
  bool is_first = true;
  int beginnings = 1, of_this = result.evals;
  for (int rounds = 1; found != Refinement::none || !result.feasible || (is_first && was_cut_off); ++rounds) {
    const bool is_at_limit = result.status == SolverStatus::limit && !(is_first && was_cut_off);
    const bool is_lost = found == Refinement::much || !result.feasible || is_at_limit;
    is_first = false;
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
      x = next.at(++beginnings);
      dual.resize(0);
      of_this = 0;
    }
    options.stopEvals = std::min(left, std::max(1, kMostEvalsOfOne - of_this));
    if (separation.problem) separation = problem_->separation();
    if (LazyConstraints* room = roomIn(separation)) room->askAtEachStep(beginnings > 1);
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

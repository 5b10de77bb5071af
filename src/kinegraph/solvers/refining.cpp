#include <algorithm>

#include "kinegraph/common/text.h"
#include "kinegraph/nlp/initial_guesses.h"
#include "kinegraph/nlp/lazy_constraints.h"
#include "kinegraph/solvers/nlp_solver.h"

namespace kinegraph {

namespace {

constexpr int kMaxRefinements = 40;
constexpr int kMaxGuesses = 12;
constexpr int kMaxEvalsOfInvalidGuess = 40;                          // of the first guess, if it is invalid
constexpr int kMaxEvalsOfGuess = 120;                                // of each further guess
constexpr double kCautiousStep = .1, kCautiousPenaltyFactor = 100.;  // of solves from further guesses

/// Writes the residuals at the last result, including the constraints of the last refinement, to the result.
void reportViolations(Nlp& nlp, double tolerance, int rounds, SolverResult& result) {
  VectorXd phi(Eigen::Index(nlp.types().size()));
  nlp.evaluate(result.x, phi, nullptr);
  result.setSums(nlp.types(), phi, tolerance);
  result.status = SolverStatus::limit;
  result.message = cat("after ", rounds, " refinements and ", result.evals,
                       " evaluations constraints are still violated between slices");
}

/// Returns the lazy constraints of a separate form, or null if it has no capacity for them.
LazyConstraints* lazyConstraintsOf(const Separation& separation) {
  LazyConstraints* lazy = separation.problem ? separation.problem->lazyConstraints() : nullptr;
  return lazy && lazy->hasCapacity() ? lazy : nullptr;
}

/// Provides the initial guesses after the first one, whose solve ended at `first`.
class FurtherGuesses {
 public:
  FurtherGuesses(InitialGuesses* guesses, GuessKind kind, const VectorXd& start, const VectorXd& first)
      : guesses_(guesses), repeated_(kind == GuessKind::valid ? 2 : 3), start_(start), first_(first) {
    if (kind == GuessKind::stationary) start_ = first;  // a stationary point has no alternatives
    from_start_ = start;
  }

  /// Returns guess 2, 3, ... One of them is the start itself: the second if the start is valid, so that the solver
  /// keeps its basin; else the third, after an alternative.
  VectorXd at(int number) const {
    if (!guesses_ || number == repeated_) return from_start_;
    const int alternative = number - (number > repeated_ ? 2 : 1);
    return guesses_->initialGuess(alternative % 2 == 1 ? start_ : first_, alternative).value_or(from_start_);
  }

 private:
  InitialGuesses* guesses_;
  int repeated_;
  VectorXd start_, first_, from_start_;
};

}  // namespace

/// Solves the problem, and solves it again as long as the solution violates lazy constraints (constraint generation).
///
/// A further solve starts at the last solution, or in short steps at another initial guess if that solution is too far
/// from a valid one. A valid start is tried once more before alternatives. An invalid start gets few evaluations, and
/// alternatives come first. All solves share the evaluations of the options.
SolverResult NlpSolver::runRefining(Separation& separation, const EvaluationCallback& callback,
                                    const EvaluationCallback& joined_callback) {
  struct Restore {
    SolverOptions& options;
    const SolverOptions given = options;
    ~Restore() { options = given; }
  } restore{options};
  const VectorXd start = x;
  InitialGuesses* const guesses = lazyConstraintsOf(separation) ? problem_->initialGuesses() : nullptr;
  const GuessKind kind = guesses ? guesses->guessKind(start) : GuessKind::valid;
  const bool limits_first = kind == GuessKind::invalid && options.stopEvals > kMaxEvalsOfInvalidGuess;
  if (limits_first) options.stopEvals = kMaxEvalsOfInvalidGuess;
  SolverResult result = runMethod(separation, callback, joined_callback);
  if (result.status == SolverStatus::cancelled) return result;
  Refinement found = problem_->refine(result.x, solved_dual_);
  const bool first_was_limited =
      limits_first && result.status == SolverStatus::limit && result.evals >= kMaxEvalsOfInvalidGuess;
  if (found == Refinement::none && !first_was_limited) return result;
  const FurtherGuesses further(guesses, kind, start, result.feasible ? result.x : start);
  bool is_first = true;
  int guess = 1, guess_evals = result.evals;
  for (int rounds = 1; found != Refinement::none || !result.feasible || (is_first && first_was_limited); ++rounds) {
    const bool is_at_limit = result.status == SolverStatus::limit && !(is_first && first_was_limited);
    const bool needs_guess = found == Refinement::much || !result.feasible || is_at_limit;
    is_first = false;
    const int left = restore.given.stopEvals - result.evals;
    if (left <= 0 || rounds > kMaxRefinements || (needs_guess && guess == kMaxGuesses)) {
      // without violated lazy constraints, the active ones contradict each other
      if (found != Refinement::none) reportViolations(*problem_, options.constraintTolerance(), rounds - 1, result);
      break;
    }
    releaseMemory();
    x = result.x;
    dual = result.dual;
    if (needs_guess) {  // short steps do not leave the basin of the guess
      options.stepMax = std::min(options.stepMax, kCautiousStep);
      options.muInit = kCautiousPenaltyFactor * restore.given.muInit;
      x = further.at(++guess);
      dual.resize(0);
      guess_evals = 0;
    }
    options.stopEvals = std::min(left, std::max(1, kMaxEvalsOfGuess - guess_evals));
    if (separation.problem) separation = problem_->separation();
    if (LazyConstraints* lazy = lazyConstraintsOf(separation)) lazy->setActivationAtEachStep(guess > 1);
    const int evals = result.evals;
    result = runMethod(separation, callback, joined_callback);
    guess_evals += result.evals;
    result.evals += evals;
    if (result.status == SolverStatus::cancelled) break;
    found = problem_->refine(result.x, solved_dual_);
  }
  return result;
}

}  // namespace kinegraph

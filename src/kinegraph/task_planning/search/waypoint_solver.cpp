#include "kinegraph/task_planning/search/waypoint_solver.h"

#include <algorithm>
#include <atomic>
#include <limits>
#include <mutex>

#include "kinegraph/common/text.h"
#include "kinegraph/komo/path/path.h"
#include "kinegraph/solvers/nlp_solver.h"
#include "kinegraph/task_planning/grasps.h"
#include "kinegraph/task_planning/violated_constraint.h"

namespace kinegraph::inline task_planning_internal {

namespace {

constexpr std::size_t kGuesses = 3;  ///< initial guesses of a waypoint problem, for each choice of variants
constexpr std::size_t kChoices = 6;  ///< maximum number of choices of variants

/// Hashes several numbers to one seed.
std::uint64_t combined(std::initializer_list<std::uint64_t> numbers) {
  std::uint64_t seed = 0;
  for (const std::uint64_t number : numbers) seed = Rng(seed ^ number).bits();
  return seed;
}

std::shared_ptr<NlpSolver> solverOf(std::shared_ptr<Komo> komo) {
  return std::make_shared<NlpSolver>(makeNlp(std::move(komo)), 0);
}

/// Returns violatedConstraint, or "" if `stopped` ends it.
std::string violatedConstraintUnless(const std::shared_ptr<Komo>& komo, const CancellationToken& stopped) {
  struct Stop {};
  try {
    return violatedConstraint(komo, [&] {
      if (stopped()) throw Stop();
    });
  } catch (const Stop&) {
    return "";
  }
}

/// Describes a failed action by the constraint that its waypoint violates. If a pose would jump when a hand takes or
/// releases an object, the hand misses it.
std::string causeOf(const Config& C, const TaskAction& action, const std::string& violated) {
  if (violated.empty()) return "the waypoints violate a constraint";
  constexpr std::string_view kMissed = " is missed by ";
  const bool takes = isPick(action) || action[0] == "handover";
  std::string cause = violated;
  const std::size_t by = violated.find(kMissed);
  if (violated.starts_with("pose") && by != std::string::npos && (takes || isPlace(action))) {
    const std::string amount = violated.substr(by + kMissed.size());
    cause = takes ? cat("'", action[3], "' misses its grasp of '", action[1], "' by ", amount)
                  : cat("'", action[1], "' misses its place on '", action[3], "' by ", amount);
  }
  if ((isPick(action) || isPlace(action)) && violated.starts_with("pos") && violated.find(" while ") == violated.npos)
    cause += cat(", with nothing in the way: '", isPick(action) ? action[3] : action[2], "' does not reach '",
                 isPick(action) ? action[1] : action[3], "' in the orientation that this takes");
  const std::string flaw = isPick(action) ? graspFlaw(C, action[1], action[2], action[3]) : "";
  return flaw.empty() ? cause : flaw;
}

}  // namespace

/// The result of the solver from one initial guess.
struct WaypointSolver::Solution {
  bool is_feasible = false;
  long evaluations = 0;
  VectorXd x;
};

/// Shared by all guesses.
struct WaypointSolver::Problem {
  const Settings& settings;
  const std::shared_ptr<const Config> scene;
  const std::vector<TaskAction> actions, later;
  const int seed;
  const CancellationToken stopped;
  mutable std::atomic<int> first_feasible = std::numeric_limits<int>::max();  ///< the first guess known to be feasible

  bool isLate() const { return settings.is_late && settings.is_late(); }
};

/// One choice of variants. Its waypoint problem is built, and its guesses are sampled, when they are first needed.
struct WaypointSolver::Choice {
  Choice(std::vector<std::string> names, Rng rng) : variants(std::move(names)), rng_(rng) {}

  /// Builds the problem at the first call.
  void make(const Problem& problem) {
    if (waypoints) return;
    const Settings& settings = problem.settings;
    waypoints = makeTaskWaypoints(*problem.scene, problem.actions, variants, settings.rules,
                                  settings.helper ? settings.helper() : nullptr, settings.margin, problem.later);
    unsolved_ = waypoints->m->komo->path().variables();
    if (settings.threads == 1) solver_ = solverOf(waypoints->m->komo);
  }

  /// A solver that no other guess uses at the same time.
  std::shared_ptr<NlpSolver> solver() const {
    return solver_ ? solver_ : solverOf(std::make_shared<Komo>(waypoints->m->komo->clone()));
  }

  /// Guesses are sampled in order, each for the unsolved problem, so that they do not depend on the order of solving.
  const VectorXd& guess(std::size_t number, int seed) {
    while (guesses_.size() <= number) {
      const bool is_first = guesses_.empty();  // only the others sample grasps
      waypoints->m->komo->path().setVariables(unsolved_);
      guesses_.push_back(waypoints->start(is_first && seed == 0 ? nullptr : &rng_, !is_first));
    }
    return guesses_[number];
  }

  const std::vector<std::string> variants;
  std::mutex mutex;  ///< guards all members below
  std::shared_ptr<TaskWaypoints> waypoints;

 private:
  std::shared_ptr<NlpSolver> solver_;  ///< shared by all guesses if there is one thread
  Rng rng_;
  VectorXd unsolved_;
  std::vector<VectorXd> guesses_;
};

WaypointSolver::WaypointSolver(SpeculativeExecutor& executor, const Settings& settings,
                               std::shared_ptr<const Config> scene, std::vector<TaskAction> actions, int seed,
                               CancellationToken stopped, std::vector<TaskAction> later)
    : executor_(executor),
      problem_(
          new Problem{settings, std::move(scene), std::move(actions), std::move(later), seed, std::move(stopped)}) {
  const Config own = *problem_->scene;  // rules may query it while others copy the scene
  const auto variants = allVariants(own, problem_->actions, settings.rules, kChoices);
  for (std::size_t i = 0; i < variants.size(); ++i) {
    const Rng rng(combined({settings.seed, std::uint64_t(seed), problem_->actions.size(), std::uint64_t(i)}));
    choices_.push_back(std::make_shared<Choice>(variants[i], rng));
    for (std::size_t guess = 0; guess < kGuesses; ++guess)
      solutions_.push_back(executor.defer<Solution>(
          [problem = problem_, choice = choices_.back(), guess, number = int(solutions_.size())](
              const CancellationToken& stopped) { return solveFrom(*problem, *choice, guess, number, stopped); }));
  }
}

WaypointSolver::~WaypointSolver() = default;

void WaypointSolver::begin(Priority first, Priority others) const {
  for (std::size_t i = 0; i < solutions_.size(); ++i) solutions_[i].begin(i == 0 ? first : others);
}

WaypointSolver::Solution WaypointSolver::solveFrom(const Problem& problem, Choice& choice, std::size_t guess,
                                                   int number, const CancellationToken& stopped) {
  const auto is_needed = [&] {
    return number <= problem.first_feasible && !stopped() && !(problem.stopped && problem.stopped());
  };
  std::unique_lock lock(choice.mutex);
  if (!is_needed()) return {};
  choice.make(problem);
  const VectorXd x = choice.guess(guess, problem.seed);
  const std::shared_ptr<NlpSolver> solver = choice.solver();
  lock.unlock();
  solver->setInitialization(x);
  Rng rng;  // not used: the initialization is set
  const SolverResult solved = solver->solve(false, rng, [&](const VectorXd&, const VectorXd&) { return is_needed(); });
  if (solved.feasible)
    for (int known = problem.first_feasible;
         number < known && !problem.first_feasible.compare_exchange_weak(known, number);) {
    }
  return {solved.feasible, solved.evals, solved.x};
}

WaypointSolver::Result WaypointSolver::solve(Priority priority, const std::function<void()>& at_first_failure,
                                             bool only_first) {
  Result result;
  if (!only_first) begin(priority, std::max(priority, Priority::normal));
  for (; next_ < solutions_.size(); ++next_) {
    const std::size_t i = next_;
    if (i > 0 && (only_first || problem_->isLate())) break;
    Solution solution = solutions_[i].get();
    result.evaluations += solution.evaluations;
    if (solution.is_feasible) {
      solutions_.clear();  // stops those that run
      Choice& choice = *choices_[i / kGuesses];
      const std::scoped_lock lock(choice.mutex);
      choice.waypoints->m->komo->path().setVariables(solution.x);
      result.waypoints = choice.waypoints;
      return result;
    }
    if (i > 0) continue;
    first_ = std::move(solution.x);
    if (!only_first) begin(priority, priority);
    if (at_first_failure) at_first_failure();
  }
  result.failure = failureAt(first_);
  return result;
}

/// Names the constraint that the first choice of variants violates at x; the other choices were tried after it failed.
FutureFailure WaypointSolver::failureAt(VectorXd x) const {
  const std::string text = planText({problem_->actions.back()});
  if (choices_.empty())
    return std::make_shared<FutureFailure::element_type>(executor_.defer<TaskFailure>([text](const CancellationToken&) {
      return TaskFailure{cat(text, ": the hand cannot hold it"), nullptr};
    }));
  const TaskAction& action = problem_->actions.back();
  return std::make_shared<FutureFailure::element_type>(
      executor_.defer<TaskFailure>([text, action, choice = choices_[0], slice = int(problem_->actions.size()) - 1,
                                    x = std::move(x)](const CancellationToken& stopped) {
        const std::scoped_lock lock(choice->mutex);
        const std::shared_ptr<Komo>& komo = choice->waypoints->m->komo;
        komo->path().setVariables(x);
        TaskFailure failure;
        failure.configuration = std::make_shared<const Config>(komo->configuration(slice));
        const std::string violated = violatedConstraintUnless(komo, stopped);
        failure.cause = cat(text, ": ", causeOf(choice->waypoints->C, action, violated));
        return failure;
      }));
}

}  // namespace kinegraph::inline task_planning_internal

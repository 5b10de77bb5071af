#include "kinegraph/task_planning/search/task_attempts.h"

#include <algorithm>
#include <atomic>
#include <limits>
#include <mutex>

#include "kinegraph/common/text.h"
#include "kinegraph/solvers/nlp_solver.h"
#include "kinegraph/task_planning/violated_constraint.h"

namespace kinegraph {

namespace {

constexpr std::size_t kStarts = 3;   ///< of a waypoint problem, for each choice of variants
constexpr std::size_t kChoices = 6;  ///< of variants, at most

/// One seed of several numbers.
std::uint64_t combined(std::initializer_list<std::uint64_t> numbers) {
  std::uint64_t seed = 0;
  for (const std::uint64_t number : numbers) seed = Rng(seed ^ number).bits();
  return seed;
}

std::shared_ptr<NlpSolver> solverOf(std::shared_ptr<Komo> komo) {
  return std::make_shared<NlpSolver>(makeNlp(std::move(komo)), 0);
}

/// The same as violatedConstraint; "" where it is stopped.
std::string missed(const std::shared_ptr<Komo>& komo, const CancellationToken& stopped) {
  struct Stop {};
  try {
    return violatedConstraint(komo, [&] {
      if (stopped()) throw Stop();
    });
  } catch (const Stop&) {
    return "";
  }
}

}  // namespace

/// How the solver ended that began at a start.
struct TaskAttempt::Start {
  bool is_feasible = false;
  long evaluations = 0;
  VectorXd end;
};

/// What all starts share.
struct TaskAttempt::Problem {
  const Settings& settings;
  const std::shared_ptr<const Config> scene;
  const std::vector<TaskAction> actions;
  const int seed;
  const CancellationToken stopped;
  mutable std::atomic<int> first_feasible = std::numeric_limits<int>::max();  ///< of all starts, as far as is known

  bool isLate() const { return settings.is_late && settings.is_late(); }
};

/// One choice of variants. Its waypoint problem is made, and its starts are drawn, one after the other, when they are
/// needed.
struct TaskAttempt::Choice {
  Choice(std::vector<std::string> names, Rng draws) : variants(std::move(names)), rng_(draws) {}

  /// With the problem, where it was not made yet.
  void make(const Problem& problem) {
    if (waypoints) return;
    const Settings& settings = problem.settings;
    waypoints = makeTaskWaypoints(*problem.scene, problem.actions, variants, settings.rules,
                                  settings.helper ? settings.helper() : nullptr);
    unsolved_ = waypoints->m->komo->path().variables();
    if (settings.threads == 1) solver_ = solverOf(waypoints->m->komo);
  }

  /// One that no other start uses at the same time.
  std::shared_ptr<NlpSolver> solver() const {
    return solver_ ? solver_ : solverOf(std::make_shared<Komo>(waypoints->m->komo->clone()));
  }

  /// The starts are drawn one after the other, each for a problem where nothing was solved yet.
  const VectorXd& drawn(std::size_t start, int seed) {
    while (drawn_.size() <= start) {
      const bool is_first = drawn_.empty();  // the others go farther
      waypoints->m->komo->path().setVariables(unsolved_);
      drawn_.push_back(waypoints->start(is_first && seed == 0 ? nullptr : &rng_, !is_first));
    }
    return drawn_[start];
  }

  const std::vector<std::string> variants;
  std::mutex mutex;  ///< of all else
  std::shared_ptr<TaskWaypoints> waypoints;

 private:
  std::shared_ptr<NlpSolver> solver_;  ///< where one thread does all
  Rng rng_;
  VectorXd unsolved_;
  std::vector<VectorXd> drawn_;
};

TaskAttempt::TaskAttempt(SpeculativeExecutor& ahead, const Settings& settings, std::shared_ptr<const Config> scene,
                         std::vector<TaskAction> actions, int seed, CancellationToken stopped)
    : ahead_(ahead), problem_(new Problem{settings, std::move(scene), std::move(actions), seed, std::move(stopped)}) {
  const Config own = *problem_->scene;  // which rules may ask while others copy the scene
  const auto variants = allVariants(own, problem_->actions, settings.rules, kChoices);
  for (std::size_t i = 0; i < variants.size(); ++i) {
    const Rng rng(combined({settings.seed, std::uint64_t(seed), problem_->actions.size(), std::uint64_t(i)}));
    choices_.push_back(std::make_shared<Choice>(variants[i], rng));
    for (std::size_t start = 0; start < kStarts; ++start)
      starts_.push_back(ahead.defer<Start>([problem = problem_, choice = choices_.back(), start,
                                            number = int(starts_.size())](const CancellationToken& stopped) {
        return solve(*problem, *choice, start, number, stopped);
      }));
  }
}

TaskAttempt::~TaskAttempt() = default;

void TaskAttempt::begin(Priority first, Priority others) const {
  for (std::size_t i = 0; i < starts_.size(); ++i) starts_[i].begin(i == 0 ? first : others);
}

TaskAttempt::Start TaskAttempt::solve(const Problem& problem, Choice& choice, std::size_t start, int number,
                                      const CancellationToken& stopped) {
  const auto is_wanted = [&] {
    return number <= problem.first_feasible && !stopped() && !(problem.stopped && problem.stopped());
  };
  std::unique_lock lock(choice.mutex);
  if (!is_wanted()) return {};
  choice.make(problem);
  const VectorXd x = choice.drawn(start, problem.seed);
  const std::shared_ptr<NlpSolver> solver = choice.solver();
  lock.unlock();
  solver->setInitialization(x);
  Rng rng;  // of which nothing is drawn
  const SolverResult solved = solver->solve(false, rng, [&](const VectorXd&, const VectorXd&) { return is_wanted(); });
  if (solved.feasible)
    for (int known = problem.first_feasible;
         number < known && !problem.first_feasible.compare_exchange_weak(known, number);) {
    }
  return {solved.feasible, solved.evals, solved.x};
}

TaskAttempt::Found TaskAttempt::find(Priority wanted, const std::function<void()>& at_first_failure) {
  Found found;
  begin(wanted, std::max(wanted, Priority::normal));
  VectorXd first;  // where the first start ended
  for (std::size_t i = 0; i < starts_.size(); ++i) {
    if (i > 0 && problem_->isLate()) break;
    Start start = starts_[i].get();
    found.evaluations += start.evaluations;
    if (start.is_feasible) {
      starts_.clear();  // which stops those that run
      Choice& choice = *choices_[i / kStarts];
      const std::scoped_lock lock(choice.mutex);
      choice.waypoints->m->komo->path().setVariables(start.end);
      found.waypoints = choice.waypoints;
      return found;
    }
    if (i > 0) continue;
    first = std::move(start.end);
    begin(wanted, wanted);
    if (at_first_failure) at_first_failure();
  }
  found.cause = causeOf(std::move(first));
  return found;
}

/// Of the first choice: the others were tried as that one failed.
TaskCause TaskAttempt::causeOf(VectorXd x) const {
  const std::string text = planText({problem_->actions.back()});
  if (choices_.empty())
    return std::make_shared<TaskCause::element_type>(ahead_.defer<TaskFailure>([text](const CancellationToken&) {
      return TaskFailure{cat(text, ": the hand cannot hold it"), nullptr};
    }));
  return std::make_shared<TaskCause::element_type>(
      ahead_.defer<TaskFailure>([text, choice = choices_[0], slice = int(problem_->actions.size()) - 1,
                                 x = std::move(x)](const CancellationToken& stopped) {
        const std::scoped_lock lock(choice->mutex);
        const std::shared_ptr<Komo>& komo = choice->waypoints->m->komo;
        komo->path().setVariables(x);
        TaskFailure failure;
        failure.ghost = std::make_shared<const Config>(komo->configuration(slice));
        const std::string cause = missed(komo, stopped);
        failure.why = cat(text, ": ", cause.empty() ? "the waypoints miss what the actions ask" : cause);
        return failure;
      }));
}

}  // namespace kinegraph

#include "kinegraph/tasks/search/task_attempts.h"

#include "kinegraph/base/text.h"
#include "kinegraph/solvers/nlp_solver.h"
#include "kinegraph/tasks/missed_demand.h"

namespace kinegraph {

namespace {

constexpr int kStarts = 3;           ///< of a waypoint problem, for each choice of variants
constexpr std::size_t kChoices = 6;  ///< of variants, at most

/// One seed of several numbers.
std::uint64_t combined(std::initializer_list<std::uint64_t> numbers) {
  std::uint64_t seed = 0;
  for (const std::uint64_t number : numbers) seed = Rng(seed ^ number).bits();
  return seed;
}

std::string last(const std::vector<TaskAction>& actions) { return planText({actions.back()}); }

}  // namespace

TaskAttempts::Found TaskAttempts::find(const Config& C, const std::vector<TaskAction>& actions, int seed) {
  const auto choices = allVariants(C, actions, settings_.rules, kChoices);
  std::vector<Attempt> attempts(choices.size());
  std::optional<Found> found, failed;
  inOrder(
      int(choices.size()), settings_.threads,
      [&](int i, const JobStopped& stopped) {
        attempts[std::size_t(i)] = attempt(C, actions, choices[std::size_t(i)], seed, i, stopped);
      },
      [&](int i) {
        Attempt& one = attempts[std::size_t(i)];
        evaluations += one.evaluations;
        if (one.waypoints) {
          found = std::move(one);
          return false;
        }
        if (!failed) failed = std::move(one);
        return !isLate();
      },
      settings_.between);
  if (found) return *found;
  return failed.value_or(Found{nullptr, {cat(last(actions), ": the hand cannot hold it"), nullptr}});
}

/// One choice of variants, from several starts.
TaskAttempts::Attempt TaskAttempts::attempt(const Config& C, const std::vector<TaskAction>& actions,
                                            const std::vector<std::string>& variants, int seed, int index,
                                            const JobStopped& stopped) const {
  Attempt result;
  if (stopped()) return result;
  const auto waypoints =
      makeTaskWaypoints(C, actions, variants, settings_.rules, settings_.helper ? settings_.helper() : nullptr);
  const std::shared_ptr<Komo>& komo = waypoints->m->komo;
  NlpSolver solver(makeNlp(komo), 0);
  Rng rng(combined({settings_.seed, std::uint64_t(seed), actions.size(), std::uint64_t(index)}));
  VectorXd first;  // where the first start ended
  for (int start = 0; start < kStarts && (start == 0 || !(stopped() || isLate())); ++start) {
    const bool is_first = start == 0;  // the others go farther
    solver.setInitialization(waypoints->start(is_first && seed == 0 ? nullptr : &rng, !is_first));
    const SolverResult solved = solver.solve(false, rng, [&](const VectorXd&, const VectorXd&) { return !stopped(); });
    result.evaluations += solved.evals;
    if (solved.feasible) {
      result.waypoints = waypoints;
      return result;
    }
    if (is_first) first = komo->path().variables();
  }
  if (index > 0 || stopped()) return result;  // it is the first choice of which it is told why
  komo->path().setVariables(first);
  result.failure.ghost = std::make_shared<const Config>(komo->configuration(int(actions.size()) - 1));
  const std::string cause = missedDemand(komo, [&] { (void)stopped(); });
  result.failure.why = cat(last(actions), ": ", cause.empty() ? "the waypoints miss what the actions ask" : cause);
  return result;
}

}  // namespace kinegraph

#include "kinegraph/tasks/lgp/lgp_waypoints.h"

#include <algorithm>

#include "kinegraph/base/text.h"
#include "kinegraph/tasks/missed_demand.h"

namespace kinegraph {

namespace {

constexpr int kStarts = 4;     ///< of a waypoint problem before another plan is tried
constexpr double kNoise = .3;  ///< each further one is that much farther away

}  // namespace

std::optional<std::size_t> LgpWaypoints::failing(const Plan& plan) {
  if (isFeasible(plan)) return std::nullopt;
  for (std::size_t count = 1; count < plan.size(); ++count)
    if (!isFeasible({plan.begin(), plan.begin() + std::ptrdiff_t(count)})) return count;
  return plan.size();
}

bool LgpWaypoints::isFeasible(const Plan& plan) {
  const auto known = known_.find(plan);
  if (known != known_.end()) return known->second;
  return known_[plan] = solve(plan, 0);
}

bool LgpWaypoints::solve(const Plan& plan, int round) {
  const std::shared_ptr<Komo> problem = tamp_.setup_sequence(C_, int(plan.size()));
  tamp_.add_all(problem, plan, false);
  const LgpSolve solved = solveFrom(problem, starts(problem, round), options_);
  solves += solved.solves;
  evaluations += solved.evaluations;
  if (solved.is_solved) {
    komo = problem;
    x = solved.result.x;
  } else if (round == 0) {
    const std::string missed = missedDemand(problem, options_.between);
    const std::string cause =
        cat(planText({plan.back()}), ": ", missed.empty() ? options_.describe(solved.result) : missed);
    const auto known = std::find_if(causes_.begin(), causes_.end(), [&](const auto& c) { return c.first == cause; });
    if (known == causes_.end())
      causes_.emplace_back(cause, 1);
    else
      ++known->second;
  }
  return solved.is_solved;
}

std::vector<VectorXd> LgpWaypoints::starts(const std::shared_ptr<Komo>& problem, int round) const {
  const auto nlp = makeNlp(problem);
  const VectorXd given = problem->path().variables(), lower = nlp->lower(), upper = nlp->upper();
  Rng rng(options_.seed ^ std::uint64_t(round) << 32);
  std::vector<VectorXd> starts;
  for (int start = 0; start < kStarts; ++start) {
    const double noise = kNoise * (round > 0 ? start + 1 : start);
    VectorXd& at = starts.emplace_back(given);
    for (Eigen::Index i = 0; i < at.size(); ++i) {
      at[i] += noise * rng.normal();
      if (lower[i] < upper[i]) at[i] = std::clamp(at[i], lower[i], upper[i]);
    }
  }
  return starts;
}

std::vector<std::pair<std::string, int>> LgpWaypoints::causes() const {
  auto sorted = causes_;
  std::stable_sort(sorted.begin(), sorted.end(), [](const auto& a, const auto& b) { return a.second > b.second; });
  return sorted;
}

}  // namespace kinegraph

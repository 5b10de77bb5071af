#include "kinegraph/task_planning/lgp/lgp_waypoints.h"

#include <algorithm>
#include <cmath>

#include "kinegraph/common/random.h"
#include "kinegraph/common/text.h"
#include "kinegraph/komo/path/path.h"
#include "kinegraph/task_planning/violated_constraint.h"

namespace kinegraph {

namespace {

constexpr int kStarts = 4;                    ///< guesses of a waypoint problem before another plan is tried
constexpr double kNoise = .3;                 ///< increase of the standard deviation per further guess
constexpr std::uint64_t kSeedStep = 1000003;  ///< between problems, so that their guesses differ

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
    const std::string missed = violatedConstraint(problem, options_.cancellation);
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

/// The first guess is the current path. The others sample the dofs shared by all slices, grasps and placements; in
/// further rounds also joints.
std::vector<VectorXd> LgpWaypoints::starts(const std::shared_ptr<Komo>& problem, int round) {
  const auto nlp = makeNlp(problem);
  const Path& path = problem->path();
  const VectorXd given = path.variables(), lower = nlp->lower(), upper = nlp->upper();
  Eigen::Index shared = given.size();
  for (int t = 0; t < path.grid().slices(); ++t) shared -= path.ownDofs(t).size();
  Rng rng(options_.seed + kSeedStep * std::uint64_t(++problems_));
  std::vector<VectorXd> starts;
  for (int start = 0; start < kStarts; ++start) {
    VectorXd& x = starts.emplace_back(given);
    if (start == 0 && round == 0) continue;
    for (Eigen::Index i = 0; i < (round > 0 ? x.size() : shared); ++i) {
      if (i < shared && std::isfinite(lower[i]) && lower[i] < upper[i] && std::isfinite(upper[i]))
        x[i] = rng.uniform(lower[i], upper[i]);
      else
        x[i] += kNoise * std::max(start, 1) * rng.normal();
      if (lower[i] < upper[i]) x[i] = std::clamp(x[i], lower[i], upper[i]);
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

#include "kinegraph/task_planning/lgp/lgp_waypoints.h"

#include <algorithm>
#include <cmath>

#include "kinegraph/common/random.h"
#include "kinegraph/common/text.h"
#include "kinegraph/komo/path/path.h"
#include "kinegraph/scene/tree/frame_cycle.h"
#include "kinegraph/task_planning/lgp/lgp_overlaps.h"
#include "kinegraph/task_planning/violated_constraint.h"

namespace kinegraph::inline task_planning_internal {

namespace {

constexpr int kStarts = 4;                    ///< guesses of a waypoint problem before another plan is tried
constexpr int kAttemptsApart = 3;             ///< to keep objects apart that overlap in waypoints
constexpr double kApart = .002;               ///< m: distance of these objects
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

std::shared_ptr<Komo> LgpWaypoints::problemOf(const Plan& plan) const {
  const std::shared_ptr<Komo> problem = tamp_.setup_sequence(C_, int(plan.size()));
  tamp_.add_all(problem, plan, false);
  return problem;
}

LgpSolve LgpWaypoints::count(LgpSolve solved) {
  solves += solved.solves;
  evaluations += solved.evaluations;
  return solved;
}

void LgpWaypoints::addCause(const Plan& plan, const std::string& why) {
  const std::string cause = cat(planText({plan.back()}), ": ", why);
  const auto known = std::find_if(causes_.begin(), causes_.end(), [&](const auto& c) { return c.first == cause; });
  if (known == causes_.end())
    causes_.emplace_back(cause, 1);
  else
    ++known->second;
}

/// Solves the problem again if objects overlap that no action brings together, with constraints for these pairs. Sets
/// the path to the result. Returns the overlap that remains, or an empty text.
std::string LgpWaypoints::avoidOthers(const Plan& plan, const std::shared_ptr<Komo>& problem, int round) {
  std::vector<WaypointOverlap> overlaps = overlapsWithOthers(C_, *problem, plan);
  if (overlaps.empty()) return {};
  const std::shared_ptr<Komo> apart = problemOf(plan);
  for (int attempt = 0; attempt < kAttemptsApart && !overlaps.empty(); ++attempt) {
    for (const WaypointOverlap& overlap : overlaps) {
      apart->addObjective({overlap.slice + 1.}, FeatureSymbol::distance, {overlap.a, overlap.b}, ObjectiveType::ineq,
                          1e1, -kApart);
    }
    std::vector<VectorXd> guesses = starts(apart, round);
    guesses.insert(guesses.begin(), problem->path().variables());
    if (!count(solveFrom(apart, guesses, options_)).is_solved) break;
    overlaps = overlapsWithOthers(C_, *apart, plan);
  }
  if (!overlaps.empty()) return overlaps.front().str();
  problem->path().setVariables(apart->path().variables());
  return {};
}

bool LgpWaypoints::solve(const Plan& plan, int round) {
  std::shared_ptr<Komo> problem;
  try {
    problem = problemOf(plan);
  } catch (const FrameCycle& error) {  // an object on top of itself
    if (round == 0) addCause(plan, error.what());
    return false;
  }
  const LgpSolve solved = count(solveFrom(problem, starts(problem, round), options_));
  const std::string overlap = solved.is_solved ? avoidOthers(plan, problem, round) : std::string();
  if (solved.is_solved && overlap.empty()) {
    komo = problem;
    x = problem->path().variables();
    return true;
  }
  if (round == 0) {
    const std::string missed = solved.is_solved ? overlap : violatedConstraint(problem, options_.cancellation);
    addCause(plan, missed.empty() ? options_.describe(solved.result) : missed);
  }
  return false;
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

}  // namespace kinegraph::inline task_planning_internal
